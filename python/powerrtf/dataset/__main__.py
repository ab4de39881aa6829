# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshes the meshes of a manifest.

Each mesh has a process of its own. What is finished is not done again, so the same command goes on after
a kill. An array of jobs has --world, the number of jobs; then the same command without it does what they
have left undone and writes OUT/summary.parquet. The exit code is 0 when each mesh has a row, whatever it
says, 1 when the run cannot go on, 130 after Ctrl-C.
"""

import argparse
import importlib.util
import os
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

from .._options import DEFAULTS
from ._mesh import FAILURES
from ._plots import plot_summary
from ._run import remesh_dataset


def _parser():
    parser = argparse.ArgumentParser(prog="python -m powerrtf.dataset", description=__doc__,
                                     argument_default=argparse.SUPPRESS,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("manifest", metavar="MANIFEST", help="a Parquet file with a column path")
    add("out", metavar="OUT", help="a folder")
    add("--world", type=int, metavar="W", help="the number of jobs that share the meshes (1)")
    add("--rank", type=int, metavar="R",
        help="which of them this is, from 0 on ($SLURM_ARRAY_TASK_ID or $SLURM_PROCID)")
    add("--workers", type=int, metavar="K", help="meshes at a time (the cores that this job may use)")
    add("--format", help="off, obj, ply, stl, vtp, vtu or msh (ply)")
    add("--time-limit", type=float, metavar="S", help="seconds for a mesh (600)")
    add("--memory-limit", type=float, metavar="GIB", help="GiB of address space for a mesh (4)")
    add("--plot", metavar="FILE", help="draw the summary (with matplotlib)")
    options = parser.add_argument_group("options of powerrtf.remesh(), as --edge-length 0.1 or --seed 1")
    options.add_argument("-n", metavar="N", type=int, help="the number of vertices")
    for name, default in DEFAULTS.items():
        if name != "n":
            options.add_argument("--" + name.replace("_", "-"), type=_reader(default), help=argparse.SUPPRESS)
    return parser


def _reader(default):
    """What makes an option's value of its text."""
    return _switch if isinstance(default, bool) else type(default)


def _switch(text):
    if text not in ("no", "yes"):
        raise argparse.ArgumentTypeError(f"{text!r} is neither yes nor no")
    return text == "yes"


def main():
    given = vars(_parser().parse_args())
    workers, plot = given.pop("workers", None), given.pop("plot", None)
    if given.get("world", 1) > 1:
        rank = os.environ.get("SLURM_ARRAY_TASK_ID", os.environ.get("SLURM_PROCID", -1))
        given.setdefault("rank", int(rank))
    try:
        table = remesh_dataset(**given, executor=ThreadPoolExecutor(workers) if workers else None,
                               progress=importlib.util.find_spec("tqdm") is not None)
        if plot:
            plot_summary(table, plot)
    except (ImportError, OSError, ValueError) as error:
        print(f"powerrtf.dataset: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("powerrtf.dataset: stopped; the same command goes on", file=sys.stderr)
        return 130
    for row in table.select(["path", "status", "message"]).to_pylist():
        if row["status"] in FAILURES:
            print("{path}: {status}: {message}".format(**row), file=sys.stderr)
    for status, count in Counter(table["status"].to_pylist()).most_common():
        print(f"{count} {status}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
