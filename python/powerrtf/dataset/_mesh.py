# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done with one mesh, in a process of its own."""

import hashlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

from .._core import OutputError, __version__

MET, MISSED, REFUSED = "met", "missed guarantees", "refused"
CRASHED, TIMED_OUT, OUT_OF_MEMORY = "crashed", "timed out", "out of memory"
WRITTEN = (MET, MISSED)
FAILURES = (CRASHED, TIMED_OUT, OUT_OF_MEMORY)  # those that larger limits may help

_UNWRITABLE = 5  # exit code of the program
_CANCELLED = (128 + signal.SIGINT, 128 + signal.SIGTERM, -signal.SIGINT, -signal.SIGTERM)
_SHORT_OF_MEMORY = ("the memory does not suffice", "Cannot allocate memory", "MemoryError")
_VALUES = ("q_min", "q_avg", "theta_min", "distance_mean", "distance_rms", "distance_max", "vertices",
           "faces", "seed", "missed_guarantees")


def key_of(file, arguments, ending):
    """What the result depends on, hashed: the bytes of the file and how its name ends, the arguments, the
    output's format and the version. The second value is why there is none, or None."""
    given = [__version__, os.path.splitext(file)[1].lower(), ending, arguments]
    digest = hashlib.sha256(json.dumps(given).encode())
    try:
        with open(file, "rb") as data:
            for block in iter(lambda: data.read(1 << 20), b""):
                digest.update(block)
    except OSError as error:
        return None, f"cannot be read: {error.strerror}"
    return digest.hexdigest(), None


def remesh_one(file, output, arguments, time_limit, memory_limit):
    """Remeshes a file with one thread, in a process with limits. Returns what is found, by the names of
    the summary's columns.

    :param time_limit: seconds
    :param memory_limit: GiB of address space
    :raises OutputError: the output cannot be written
    :raises RuntimeError: SIGINT or SIGTERM has stopped it
    """
    os.makedirs(os.path.dirname(output), exist_ok=True)
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        run = subprocess.run(
            [sys.executable, "-m", "powerrtf.dataset._limited", str(time_limit),
             str(int(memory_limit * 2**30)), file, output, "--report", report, "--quiet", "--threads", "1",
             *arguments],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},  # else its threads take address space
            encoding="utf-8", errors="replace")
        row = {"seconds": time.monotonic() - begin}
        row["status"], row["message"] = _outcome(run.returncode, run.stderr, file, time_limit, memory_limit)
        if row["status"] in WRITTEN:
            with open(report, encoding="utf-8") as text:
                values = json.load(text)
            row.update((name, values[name]) for name in _VALUES)
    return row


def _outcome(code, errors, file, time_limit, memory_limit):
    """The status and a message."""
    errors = errors.strip()
    own = errors.startswith("power_rtf_remesh: ")
    lines = errors.splitlines() or [""]
    message = lines[0].replace("power_rtf_remesh: ", "", 1).replace(f"{file}: ", "", 1)
    if code == 0:
        return MET, ""
    if code == 3:
        return MISSED, ""
    if code == _UNWRITABLE:
        raise OutputError(message)
    if code in _CANCELLED:
        raise RuntimeError(f"{file}: cancelled")
    if code == -signal.SIGALRM:
        return TIMED_OUT, f"after {time_limit:g} s"
    if any(words in errors for words in _SHORT_OF_MEMORY):
        return OUT_OF_MEMORY, f"{memory_limit:g} GiB do not suffice"
    if code > 0 and own:
        return REFUSED, message
    reason = signal.strsignal(-code) if code < 0 else f"exit code {code}"
    return CRASHED, f"{reason}: {lines[-1]}" if lines[-1] else reason
