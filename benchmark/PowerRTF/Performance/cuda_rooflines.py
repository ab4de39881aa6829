#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of the GPU's cells, and beside each what the hardware would take at least.

cuda_rooflines.py PROGRAM [SITES ...] > results/cuda_cells.md      (default: 1000000 10000000)

PROGRAM is the built cuda_cells. Its table of medians is copied; then each step is run once under
Nsight Compute (ncu) at the clocks that the GPU chooses, and its warp instructions and the bytes of
device memory are counted. `issue`: the time for these instructions if every scheduler issued one in
every cycle; `DRAM`: for these bytes at the rate of a large copy (bytes read and written) in the same
run. The larger one over the measured time is how near the step is to what it counts could allow.
"""

import csv
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import made_by  # noqa: E402

COUNTERS = {
    "time": "gpu__time_duration.sum",
    "instructions": "smsp__inst_executed.sum",
    "read": "dram__bytes_read.sum",
    "write": "dram__bytes_write.sum",
    "clock": "smsp__cycles_elapsed.avg.per_second",
    "processors": "device__attribute_multiprocessor_count",
}
UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1, "nsecond": 1e-9, "usecond": 1e-6,
         "msecond": 1e-3, "second": 1, "byte": 1, "Kbyte": 1e3, "Mbyte": 1e6, "Gbyte": 1e9,
         "hz": 1, "Khz": 1e3, "Mhz": 1e6, "Ghz": 1e9}
REST = ("clip_lists_kernel", "open_groups_kernel", "deferred_cells_kernel")
# Name, and the kernels of it, from the n-th occurrence of the first one on.
STEPS = (
    ("take the sites, tree", 1, ("gather_sites_kernel",)),
    ("search for a construction", 1, ("search_lists_kernel",)),
    ("construction: area, mass, centroid", 1, REST),
    ("search for weight passes", 2, ("search_lists_kernel",)),
    ("construction: area, new weights", 3, REST),
    ("weight pass", 2, ("grid_team_kernel", "for_each_kernel", "gather_sites_kernel") + REST),
)


def profile(program, sites):
    """The kernels in their order, and the rate of a copy in bytes per second."""
    out = subprocess.run(
        ["ncu", "--clock-control", "none", "--profile-from-start", "off", "--csv", "--page", "raw",
         "--metrics", ",".join(COUNTERS.values()), program, "--profile", str(sites)],
        check=True, capture_output=True, text=True).stdout.splitlines()
    copy = next(float(line.split()[-2]) * 1e12 for line in out if "copies at" in line)
    rows = list(csv.reader(line for line in out if line.startswith('"')))
    names, units = rows[0], rows[1]
    kernels = []
    for row in rows[2:]:
        kernel = {"name": row[names.index("Kernel Name")]}
        for key, counter in COUNTERS.items():
            at = names.index(counter)
            kernel[key] = float(row[at].replace(",", "")) * UNITS.get(units[at], 1)
        kernels.append(kernel)
    return kernels, copy


def select(kernels, occurrence, wanted):
    """One after another, from the n-th of the first name on."""
    first = [k for k, kernel in enumerate(kernels) if wanted[0] in kernel["name"]]
    chosen, at = [], first[occurrence - 1]
    for name in wanted:
        at = next(k for k in range(at, len(kernels)) if name in kernels[k]["name"])
        chosen.append(kernels[at])
        at += 1
    return chosen


def main():
    program = sys.argv[1]
    sizes = [int(n) for n in sys.argv[2:]] or [1000000, 10000000]
    footer = made_by(__file__, ["PROGRAM", *sys.argv[2:]])
    print(f"# The cells on a GPU\n\n{footer}\nIt says what the columns mean; those of the first table "
          "are explained in cuda_cells.cu.\n\n```")
    print(subprocess.run([program, str(max(sizes))], check=True, capture_output=True,
                         text=True).stdout.rstrip())
    print("```\n\n| sites | step | ms | G cells/s | instructions per 32 cells | issue, ms | bytes "
          "per cell | DRAM, ms | larger / measured |\n"
          "| ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for n in sizes:
        kernels, copy = profile(program, n)
        for name, occurrence, wanted in STEPS:
            chosen = select(kernels, occurrence, wanted)
            total = {key: sum(k[key] for k in chosen) for key in COUNTERS}
            issue = sum(k["instructions"] / (4 * k["processors"] * k["clock"]) for k in chosen)
            moved = total["read"] + total["write"]
            print(f"| {n} | {name} | {total['time'] * 1e3:.3f} | {n / total['time'] * 1e-9:.2f} | "
                  f"{total['instructions'] * 32 / n:.0f} | {issue * 1e3:.3f} | {moved / n:.0f} | "
                  f"{moved / copy * 1e3:.3f} | "
                  f"{100 * max(issue, moved / copy) / total['time']:.0f} % |")


if __name__ == "__main__":
    main()
