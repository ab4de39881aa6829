# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program power_rtf_remesh: python -m powerrtf INPUT OUTPUT [options]"""

import sys

from ._core import run_program

if __name__ == "__main__":
    sys.exit(run_program(["power_rtf_remesh", *sys.argv[1:]]))
