#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures whole runs of the program on the CPU, stage by stage, over threads and over n.

scaling.py --model MESH.ply                 1, 2, 4 ... threads at a million samples, then
                                            100000, 300000, 1000000 and 3000000 with all threads
scaling.py --plot FILE.csv                  only the table and the plot of what was measured before

Results: scaling.csv, scaling.md and, where matplotlib can be fetched, scaling.png. `speed-up`: over
one thread; `growth`: the exponent a of time = c n^a, by least squares on logarithms.
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import (BUILD, ROOT, build, made_by, markdown, notice,  # noqa: E402
                    python_environment, write_csv)
from performance import growth  # noqa: E402

STAGES = ("surface", "sampling", "optimization", "extraction", "improvement", "quality")
COLUMNS = ("threads", "n", *STAGES, "total", "bytes_per_sample")


def measure(program, model, threads, n):
    """One run: the columns of a row."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        process = subprocess.Popen([program, model, pathlib.Path(folder) / "mesh.ply", "--samples",
                                    str(n), "--threads", str(threads), "--traits", "cpu",
                                    "--report", report], stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{program} failed with {threads} threads and {n} samples")
        seconds = json.loads(report.read_text(encoding="utf-8"))["seconds"]
    notice(f"  {threads} threads, {n} samples: {seconds['total']:.2f} s")
    return [threads, n, *(round(seconds[stage], 4) for stage in (*STAGES, "total")),
            round(usage.ru_maxrss * 1024 / n)]


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [[int(row["threads"]), int(row["n"]), *(float(row[s]) for s in (*STAGES, "total")),
             int(row["bytes_per_sample"])] for row in rows]


def over_threads(rows):
    """The rows of the n that was run with the most different numbers of threads."""
    sizes = [row[1] for row in rows]
    n = max(set(sizes), key=lambda size: (sizes.count(size), size))
    return sorted(row for row in rows if row[1] == n)


def over_n(rows):
    """The rows of the largest number of threads."""
    return sorted(row for row in rows if row[0] == max(row[0] for row in rows))


def table(rows):
    threads, sizes = over_threads(rows), over_n(rows)
    first, last = threads[0], threads[-1]
    text = f"n = {first[1]}, seconds:\n\n"
    shown = [[row[0], *(f"{value:.2f}" for value in row[2:-1]), row[-1]] for row in threads]
    shown.append(["speed-up", *(f"{a / b:.1f}" if b > 0 else "" for a, b in
                                zip(first[2:-1], last[2:-1])), ""])
    text += markdown(["threads", *STAGES, "total", "bytes per sample"], shown)
    text += f"\n{last[0]} threads, seconds:\n\n"
    shown = [[row[1], *(f"{value:.2f}" for value in row[2:-1]), row[-1]] for row in sizes]
    exponents = [growth([(row[1], row[k]) for row in sizes]) for k in range(2, len(COLUMNS) - 1)]
    shown.append(["growth", *("" if a is None else f"{a:.2f}" for a in exponents), ""])
    return text + markdown(["n", *STAGES, "total", "bytes per sample"], shown)


def plot(python, folder):
    """scaling.png, in the environment that has matplotlib. Returns whether there is one."""
    return subprocess.run([python, pathlib.Path(__file__).with_name("plot_scaling.py"),
                           folder / "scaling.csv", folder / "scaling.png"],
                          check=False).returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", type=pathlib.Path)
    parser.add_argument("--threads", type=int, nargs="+", help="default: 1, 2, 4 ... all")
    parser.add_argument("--samples", type=int, nargs="+",
                        default=[1000000, 100000, 300000, 3000000],
                        help="the first with each number of threads, the others with the last")
    parser.add_argument("--plot", type=pathlib.Path, metavar="FILE.csv")
    parser.add_argument("--origin", help="program, day and machine of FILE.csv")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "output/scaling",
                        metavar="FOLDER")
    parser.add_argument("--program", type=pathlib.Path, help="default: build it")
    parser.add_argument("--no-network", dest="network", action="store_false",
                        help="nothing is fetched from PyPI: no plot")
    options = parser.parse_args()
    options.output = options.output.resolve()
    options.output.mkdir(parents=True, exist_ok=True)
    target = options.output / "scaling.csv"
    if options.plot:
        rows = read(options.plot)
    else:
        if not options.model:
            parser.error("--model is needed")
        if not options.program:
            build(("power_rtf_remesh",))
            options.program = BUILD / "bin/power_rtf_remesh"
        cores = os.cpu_count() or 1
        counts = options.threads or sorted({*(2**k for k in range(cores.bit_length())
                                              if 2**k <= cores), cores})
        runs = [(count, options.samples[0]) for count in counts]
        runs += [(counts[-1], n) for n in options.samples[1:]]
        rows = []
        for run in runs:
            rows.append(measure(options.program, options.model, *run))
            write_csv(target, COLUMNS, rows)
    write_csv(target, COLUMNS, rows)
    footer = made_by(__file__, [], options.origin)
    text = "# PowerRTF: its stages over threads and n\n\n" + footer + "\n\n" + table(rows)
    if options.network:
        python, missing = python_environment(options.output / "environment", ["matplotlib"])
        if python and not missing and plot(python, options.output):
            text += "\n![](scaling.png)\n"
    (options.output / "scaling.md").write_text(text, encoding="utf-8")
    notice(f"See {options.output}/scaling.md")


if __name__ == "__main__":
    main()
