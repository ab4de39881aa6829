#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures every stage of the remesher and makes tables and plots of it.

performance.py            n = 1000 ... 100000; a million (cuda: 10 and 30, too) for the stages on
                          regular, uniform samples
performance.py --quick    n = 1000 and 10000
performance.py --all      everything, whole runs of a million too: an hour or so
performance.py --traits cuda          only these traits (cpu, exact, cuda)

Installs and builds what is missing, as ./run_tests does, and runs the program `stages` (Google
Benchmark). Results: results.md, stages.csv, stages.json (Google Benchmark's own) and, where
matplotlib can be fetched, plots. `growth` is the exponent a of time = c n^a, by least squares on
logarithms: 1 is linear.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import (BUILD, ROOT, build, made_by, markdown, notice,  # noqa: E402
                    python_environment, update_block, write_csv)

# {all}: the traits that are asked for; {fast}: without the exact ones
FILTERS = {
    "quick": "^[^/]*/({all})/.*/(1000|10000)(/|$)",
    # whole runs of a million, and 100000 exact ones, take minutes each
    "default": "(^[^/]*/({all})/.*/(1000|10000)(/|$)|^[^/]*/({fast})/.*/100000(/|$)|"
               "^([^w]|weight)[^/]*/({fast})/[^/]*/regular/uniform/(1|10|30)000000(/|$))",
    "all": "^[^/]*/({all})/",
}
TRAITS = ["cpu", "exact", "cuda"]
ORDER = ("neighbor_search", "construction", "weight_pass", "newton_step", "position_step",
         "projection", "sampling", "extraction", "improvement", "whole_run")


def measure(program, target, which, traits, min_time):
    fast = [t for t in traits if t != "exact"]
    names = FILTERS[which].format(all="|".join(traits), fast="|".join(fast))
    command = [program, f"--benchmark_filter={names}", f"--benchmark_out={target}",
               "--benchmark_out_format=json", f"--benchmark_min_time={min_time}"]
    with subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE,
                          text=True) as process:
        for line in process.stdout:
            if "/" in line:
                notice("  " + line.split("  ")[0])
    if process.returncode != 0:
        sys.exit(f"{program} failed")


def series(document):
    """{(stage, traits, threads, samples, density): [(n, seconds, per second, bytes), ...]}"""
    result, wrong = {}, []
    for run in document["benchmarks"]:
        stage, traits, threads, samples, density, n = run["name"].split("/")[:6]
        if run.get("error_occurred"):
            wrong.append(f"{run['name']}: {run['error_message']}")
            continue
        key = "cpu_time" if threads == "1" else "real_time"
        unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}[run["time_unit"]]
        result.setdefault((stage, traits, threads, samples, density), []).append(
            (int(n), run[key] * unit, int(n) / (run[key] * unit), run.get("bytes_per_sample")))
    return {key: sorted(points) for key, points in result.items()}, wrong


def growth(points):
    """The exponent a of time = c n^a; None for a single point."""
    if len(points) < 2:
        return None
    x = [math.log(p[0]) for p in points]
    y = [math.log(p[1]) for p in points]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def rate(per_second):
    unit, name = next((unit, name) for least, unit, name in
                      ((1e9, 1e9, "G"), (1e5, 1e6, "M"), (0, 1e3, "k")) if per_second >= least)
    return f"{per_second / unit:.2f} {name}"


def table(data):
    """One row per series, a column per n: samples per second."""
    sizes = sorted({p[0] for points in data.values() for p in points})
    columns = ["stage", "traits", "threads", "samples", "density",
               *[f"n = {n}" for n in sizes], "growth", "bytes per sample"]
    rows = []
    for key in sorted(data, key=lambda k: (ORDER.index(k[0]), k[1:3], k[3] == "random", k[4])):
        points = {p[0]: p for p in data[key]}
        a = growth(data[key])
        # the pages of an almost empty heap would count at small n
        memory = [p[3] for p in data[key] if p[3] is not None and p[0] >= 10000]
        rows.append([*key, *[rate(points[n][2]) if n in points else "" for n in sizes],
                     "" if a is None else f"{a:.2f}", f"{memory[-1]:.0f}" if memory else ""])
    return columns, rows


def plot(python, data, folder):
    """stages.png, in the environment that has matplotlib. Returns whether there is one."""
    file = folder / "series.json"
    file.write_text(json.dumps([[[list(key), points] for key, points in data.items()], ORDER]),
                    encoding="utf-8")
    done = subprocess.run([python, pathlib.Path(__file__).with_name("plot_stages.py"), file,
                           folder / "stages.png"], check=False)
    file.unlink()
    return done.returncode == 0


def short(columns, rows):
    """The manual's form: the fast path on regular samples, and the exact one beside it."""
    keep = [k for k, c in enumerate(columns) if c not in ("samples",)]
    chosen = [row for row in rows if row[3] == "regular" and row[4] == "uniform"]
    return markdown([columns[k] for k in keep if columns[k] != "density"],
                    [[row[k] for k in keep if columns[k] != "density"] for row in chosen], 3)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--traits", nargs="+", choices=TRAITS, default=TRAITS)
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "output/performance",
                        metavar="FOLDER")
    parser.add_argument("--results", type=pathlib.Path, metavar="FOLDER",
                        help="of tables and plots (default: the output's)")
    parser.add_argument("--binaries", type=pathlib.Path,
                        help="folder of built programs; default: build them")
    parser.add_argument("--min-time", default="0.2", metavar="SECONDS",
                        help="that each measurement takes (default: 0.2)")
    parser.add_argument("--no-network", dest="network", action="store_false",
                        help="nothing is fetched from PyPI: no plots")
    parser.add_argument("--update", type=pathlib.Path, metavar="FILE",
                        help="replace the block `performance` of this file")
    options = parser.parse_args()
    options.output = options.output.resolve()
    options.results = (options.results or options.output).resolve()
    for folder in (options.output, options.results):
        folder.mkdir(parents=True, exist_ok=True)
    if not options.binaries:
        build(("stages",))
        options.binaries = BUILD / "bin"
    load = os.getloadavg()[0]
    which = "quick" if options.quick else "all" if options.all else "default"
    target = options.output / "stages.json"
    measure(options.binaries / "stages", target, which, options.traits, options.min_time)
    data, wrong = series(json.loads(target.read_text(encoding="utf-8")))
    columns, rows = table(data)
    write_csv(options.results / "stages.csv", columns, rows)
    arguments = [f"--{which}"] if which != "default" else []
    if options.traits != TRAITS:
        arguments += ["--traits", *options.traits]
    footer = made_by(__file__, arguments)
    footer += f" Other work at the start: a load of {load:.1f}."
    text = ("# PowerRTF: the speed of its stages\n\n" + footer + "\n\nSamples per second (k: "
            "10^3, M: 10^6, G: 10^9); by CPU time for one thread, by real time for all. `samples`: "
            "where the stage starts from. `growth`: the exponent a of time = c n^a. `bytes per "
            "sample`: memory at the largest n, surface and samples not counted. The surface has "
            "81920 facets, on which sampling, extraction and improvement depend, too: a small n "
            "pays for them. More than a million regular samples begin as stratified random ones "
            "instead of those of an elimination, and are less regular.\n\n"
            + markdown(columns, rows, 5))
    if options.network:
        python, missing = python_environment(options.output / "environment", ["matplotlib"])
        if python and not missing and plot(python, data, options.results):
            text += "\n![](stages.png)\n"
    (options.results / "results.md").write_text(text, encoding="utf-8")
    if options.update:
        update_block(options.update, "performance", short(columns, rows) + "\n" + footer + "\n")
    for line in wrong:
        notice(line)
    notice(f"See {options.results}/results.md")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
