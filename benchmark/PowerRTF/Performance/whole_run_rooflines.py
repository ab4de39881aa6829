#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the GPU's time of a whole run goes, and what limits it there.

whole_run_rooflines.py PROGRAM MODEL [ARGUMENT ...] > results/gpu_stages.md

PROGRAM is the built whole_runs; one run of it on MODEL, with the arguments, is watched by Nsight
Compute (ncu) at the clocks that the GPU chooses, with caches as the kernels before have left them.
Or PROGRAM is a file NAME.csv with what ncu has printed (see `profile()`), on a machine without
Python. The kernels count to the part of the library whose folder has their source: the first name
in theirs that is defined in one. Percentages are means over the time of what a part, or a kernel,
reaches of the most that the GPU could: `issue`, instructions of the schedulers; `DRAM`, bytes of
device memory. What is above 60 per cent limits; where neither is, latency does: too few warps, or
threads that wait for caches and for one another.
"""

import collections
import csv
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import ROOT, made_by  # noqa: E402

TIME = "gpu__time_duration.sum"
SHARES = {
    "issue": "smsp__issue_active.avg.pct_of_peak_sustained_elapsed",
    "DRAM": "dram__throughput.avg.pct_of_peak_sustained_elapsed",
}
MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1, "s": 1e3}
LIMIT = 60  # per cent
KERNELS = 24  # of the second table
WRAPPERS = {"In_order", "Sweep"}  # of others, which count


def definitions():
    """The folder of each class and function of the library, by its name."""
    folders = {}
    pattern = re.compile(r"(?:struct|class|void|int|bool|auto|double)\s+(\w+)\s*(?:final\s*)?"
                         r"[({:\n]|\b(?=(\w+_kernel)\()")
    for top, suffixes in (("include/CGAL/PowerRTF", (".h",)), ("cuda", (".h", ".cuh", ".cu"))):
        for file in sorted((ROOT / top).rglob("*")):
            if file.suffix in suffixes and "test" not in file.parts:
                folder = file.parent.relative_to(ROOT / top).as_posix().replace(".", "backend")
                for one, other in pattern.findall(file.read_text()):
                    folders.setdefault(one or other, folder)
    return folders


def profile(command):
    """Name, milliseconds and shares of each kernel."""
    if command[0].endswith(".csv"):
        out = pathlib.Path(command[0]).read_text()
    else:
        out = subprocess.run(["ncu", "--clock-control", "none", "--cache-control", "none", "--csv",
                              "--page", "raw", "--metrics", ",".join([TIME, *SHARES.values()]),
                              *command, "--runs", "0"],
                             check=True, capture_output=True, text=True).stdout
    rows = list(csv.reader(line for line in out.splitlines() if line.startswith('"')))
    names, units = rows[0], rows[1]

    def number(row, metric):
        return float(row[names.index(metric)].replace(",", "") or 0)

    unit = MILLISECONDS[units[names.index(TIME)]]
    return [(row[names.index("Kernel Name")], unit * number(row, TIME),
             [number(row, metric) for metric in SHARES.values()]) for row in rows[2:]]


def place(name, folders):
    """The part of the library that a kernel belongs to, and a short name."""
    if "cub::" in name:
        return "backend", "CUB: " + re.search(r"Device\w+|\w+Kernel", name)[0]
    for word in re.findall(r"\w+", name):
        if word not in WRAPPERS and folders.get(word, "backend") != "backend":
            return folders[word], word
    return "backend", re.search(r"(\w+)\s*[<(]", name)[1]


def table(groups, heading):
    print(f"\n| {heading} | kernels | ms | {' | '.join(SHARES)} | limited by |\n"
          f"| --- | ---: | ---: | {' | '.join(['---:'] * len(SHARES))} | --- |")
    for name, kernels in groups:
        total = sum(ms for ms, _ in kernels)
        means = [sum(ms * shares[k] for ms, shares in kernels) / total for k in range(len(SHARES))]
        share, limit = max(zip(means, SHARES))
        print(f"| {name} | {len(kernels)} | {total:.2f} | "
              f"{' | '.join(f'{mean:.0f} %' for mean in means)} | "
              f"{limit if share > LIMIT else 'latency'} |")


def main():
    folders = definitions()
    parts, names = collections.defaultdict(list), collections.defaultdict(list)
    everything = []
    for name, ms, shares in profile(sys.argv[1:]):
        part, short = place(name, folders)
        parts[part].append((ms, shares))
        names[f"{part}: {short}"].append((ms, shares))
        everything.append((ms, shares))

    def by_time(groups):
        return sorted(groups.items(), key=lambda group: -sum(ms for ms, _ in group[1]))

    print(f"# The GPU's time of a whole run\n\n"
          f"{made_by(__file__, ['PROGRAM', 'MODEL', *sys.argv[3:]])}\n"
          "It says what the columns mean.")
    table([*by_time(parts), ("all", everything)], "part")
    table(by_time(names)[:KERNELS], "kernel")


if __name__ == "__main__":
    main()
