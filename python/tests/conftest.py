# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
import os
import sys

sys.path.insert(0, os.path.dirname(__file__))  # shapes

collect_ignore = ["faults"]  # of processes that the tests start
