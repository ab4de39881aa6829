# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of the processes in which powerrtf.dataset remeshes crash.off, hang.off and hog.off. Python runs
this at its start where the folder is in PYTHONPATH. Those processes alone limit their memory, after their
time: then they fail."""
import os
import resource
import signal
import sys
import time

set_limit = resource.setrlimit


def set_limit_and_fail(which, limits):
    set_limit(which, limits)
    if which == resource.RLIMIT_AS:
        name = os.path.basename(sys.argv[3])
        if name == "crash.off":
            os.kill(os.getpid(), signal.SIGSEGV)
        if name == "hang.off":
            time.sleep(1000)
        if name == "hog.off":
            bytearray(limits[0])


resource.setrlimit = set_limit_and_fail
