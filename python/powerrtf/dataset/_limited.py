# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program with limits: python -m powerrtf.dataset._limited SECONDS BYTES INPUT OUTPUT [options]

Too slow, the process is ended by SIGALRM, even where the one that has started it is gone. BYTES of
address space; no core is dumped.
"""

import resource
import signal
import sys

from .._core import run_program


def main(seconds, size, *arguments):
    signal.setitimer(signal.ITIMER_REAL, float(seconds))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    size, most = int(size), resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS,
                       (size if most == resource.RLIM_INFINITY else min(size, most), most))
    return run_program(["power_rtf_remesh", *arguments])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
