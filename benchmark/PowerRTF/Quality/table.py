#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run power_rtf_remesh on models, uniform and by curvature, and print a Markdown table.

table.py                                       elk, armadillo, bunny00 and retinal of CGAL's data
table.py kitten.off elk.off:6000               your own files; the number after : is that of samples
table.py --preset paper --update README.md     put the table into README.md's block of that preset

The figures are those of the program's own JSON reports, but for the CPU time, which is the
operating system's (user time of the whole program, files read and written included). A block to
update lies between the lines
<!-- generated: quality table, preset NAME --> and <!-- end of generated -->.
The exit code is 1 when a run fails; a missed guarantee (exit code 3) shows in the table.
"""

import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import resource
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
DEFAULT_MODELS = ["elk.off:6000", "armadillo.off", "bunny00.off", "retinal.off"]
COLUMNS = ["model", "density", "n", "Q<sub>min</sub>", "Q<sub>avg</sub>", "θ<sub>min</sub>",
           "mean θ<sub>min</sub>", "< 30°", "> 90°", "RMS distance", "max distance", "inside 4 %",
           "constructions", "CPU s", "guarantees"]


def run(program, model, samples, density, preset):
    """The JSON report and the seconds of user time of one run."""
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        result = subprocess.run(
            [program, model, os.path.join(folder, "mesh.off"), "--samples", str(samples),
             "--density", density, "--preset", preset, "--report", report, "--quiet"],
            stderr=subprocess.PIPE, text=True, check=False)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if result.returncode not in (0, 3):
            raise RuntimeError(result.stderr.strip() or f"exit code {result.returncode}")
        with open(report, encoding="utf-8") as file:
            return json.load(file), seconds


def row(name, density, r, seconds):
    missed = "; ".join(r["missed_guarantees"]) or "met"
    return [name, density, str(r["samples"]), f"{r['q_min']:.3f}", f"{r['q_avg']:.3f}",
            f"{r['theta_min']:.1f}°", f"{r['theta_min_avg']:.1f}°", f"{100 * r['below_30']:.2f} %",
            f"{100 * r['above_90']:.2f} %", f"{r['distance_rms']:.4f}",
            f"{r['distance_max']:.3f}", f"{100 * r['inside_capacity_interval']:.1f} %",
            str(r["constructions"]), f"{seconds:.1f}", missed]


def machine():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def commit():
    try:
        text = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT,
                              capture_output=True, text=True, check=True).stdout.strip()
        return f"commit {text}"
    except (OSError, subprocess.CalledProcessError):
        return "no commit"


def update(path, preset, text):
    """Replaces the block of `preset` in the file; fails when there is none."""
    begin, end = f"<!-- generated: quality table, preset {preset} -->", "<!-- end of generated -->"
    pattern = re.escape(begin) + r"\n.*?" + re.escape(end)
    content, count = re.subn(pattern, lambda _: f"{begin}\n{text}{end}",
                             pathlib.Path(path).read_text(encoding="utf-8"), flags=re.DOTALL)
    if count != 1:
        sys.exit(f"{path}: {count} blocks for the preset {preset} instead of 1")
    pathlib.Path(path).write_text(content, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", default=DEFAULT_MODELS, metavar="FILE[:SAMPLES]")
    parser.add_argument("--samples", type=int, default=3000, help="where FILE has none (3000)")
    parser.add_argument("--preset", choices=["quality", "paper"], default="quality")
    parser.add_argument("--density", nargs="+", choices=["uniform", "curvature"],
                        default=["uniform", "curvature"])
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/power_rtf_remesh"))
    parser.add_argument("--folder", default=str(ROOT / "build/data/meshes"),
                        help="of the files named without one; ./run_tests fills the default")
    parser.add_argument("--update", metavar="FILE", help="replace the table in this file, too")
    options = parser.parse_args()

    lines = ["| " + " | ".join(COLUMNS) + " |",
             "| --- | --- |" + " ---: |" * (len(COLUMNS) - 3) + " --- |"]
    failed = False
    for entry in options.models:
        file, _, samples = entry.partition(":")
        model = file if os.path.dirname(file) else os.path.join(options.folder, file)
        for density in options.density:
            try:
                report, seconds = run(options.program, model, samples or options.samples, density,
                                      options.preset)
            except (OSError, RuntimeError) as error:
                print(error, file=sys.stderr)
                failed = True
                continue
            lines.append("| " + " | ".join(row(pathlib.Path(file).stem, density, report, seconds))
                         + " |")
    names = [entry if not os.path.dirname(entry) else os.path.basename(entry)
             for entry in options.models]
    command = shlex.join(["benchmark/PowerRTF/Quality/table.py", "--preset", options.preset, *names])
    text = "\n".join(lines) + (f"\n\nMade by `{command}`; {commit()}, "
                               f"{datetime.date.today().isoformat()}, {machine()}.\n")
    print(text, end="")
    if options.update and not failed:
        update(options.update, options.preset, text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
