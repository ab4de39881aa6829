#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What power_rtf_remesh makes of --max-distance and --edge-length.

resolution.py FOLDER ...            on the models there of MODELS
resolution.py --jobs 16 FOLDER ...  16 runs at a time

--relative-max-distance: the number of vertices, against the fewest samples that do, by runs
as those of its search (distance_runs) with a factor of .5 to 1 of that number, in steps of 2 %; the
distance that the judge finds. With --density curvature vertices are taken out after the search.
--relative-edge-length: the median edge against the length that was asked for. Results:
resolution.md in the folder --results. The exit code is 1 where a distance is larger than asked, else
0.
"""

import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import BUILD, ROOT, build, made_by, markdown  # noqa: E402
from models import Models  # noqa: E402

MODELS = ("Kitten", "Homer", "Fertility", "Rocker", "Elk", "Bunny", "Armadillo", "Fandisk")
DISTANCES = (0.01, 0.003, 0.001)  # of the diagonal
LENGTHS = (0.04, 0.02, 0.01)
FACTORS = [0.5 + 0.02 * k for k in range(25)]
TEXT = """# Distances and lengths that are asked for

Distances: `--relative-max-distance X` chooses n; the certified bound of the distance both ways, by the \
report and by the judge from the file as written, in % of the diagonal; the fewest samples of runs with .5 n \
to .98 n, in steps of 2 % of n, as those of the search, of which the bound is no larger than asked; and n over \
it. Those runs may be lucky, as the next column says: the share of those that do, of all from the fewest on. The last \
one is the time of the search, in runs with n samples.

"""


def run(options, model, *arguments, judged=False):
    """The report, and what the judge says, its bound of the distance too, where that is asked for."""
    with tempfile.TemporaryDirectory() as folder:
        mesh, report = pathlib.Path(folder, "mesh.off"), pathlib.Path(folder, "report.json")
        start = time.perf_counter()
        process = subprocess.run(
            [options.program, model, mesh, *map(str, arguments), "--density", options.density,
             "--report", report, "--threads", "1", "--quiet"],
            capture_output=True, text=True, check=False)
        wall = time.perf_counter() - start
        if process.returncode not in (0, 3):
            sys.exit(process.stderr)
        result = json.loads(report.read_text(encoding="utf-8"))
        result["wall"] = wall
        if judged:
            process = subprocess.run([options.judge, model, mesh, "--bound"], capture_output=True,
                                     text=True, check=True)
            result["judged"] = json.loads(process.stdout)
        return result


def bound_of_run(options, model, distance, samples):
    """Of a run as those of the search, in % of the diagonal; infinite where the samples are too few."""
    process = subprocess.run([options.distance_runs, model, str(distance), options.density,
                              str(samples)], capture_output=True, text=True, check=True)
    return json.loads(process.stdout)["distance_bound"] if process.stdout else math.inf


def distance_row(options, pool, name, model, distance):
    report = run(options, model, "--relative-max-distance", distance, judged=True)
    n = report["vertices"]
    start = time.perf_counter()
    bound_of_run(options, model, distance, n)
    search_time = report["wall"] / (time.perf_counter() - start)
    numbers = [round(factor * n) for factor in FACTORS]
    bounds = pool.map(lambda m: bound_of_run(options, model, distance, m), numbers)
    does = [bound <= 100 * distance for bound in bounds]
    fewest = numbers[does.index(True)] if any(does) else n
    after = does[does.index(True):] if any(does) else [True]
    found = report["judged"]["distance_bound"]
    is_met = not report["missed_guarantees"] and found <= 100 * distance
    row = [name, f"{100 * distance:g}", n, f"{report['distance_bound']:.4f}", f"{found:.4f}",
           "yes" if is_met else "no", fewest, f"{n / fewest:.2f}", f"{sum(after) / len(after):.2f}",
           f"{search_time:.1f}"]
    print(*row, "".join(".x"[d] for d in does), flush=True)
    return row, is_met


def length_row(options, name, model, length):
    report = run(options, model, "--relative-edge-length", length)
    ratio = report["edge_length_median"] / (length * report["diagonal"])
    row = [name, f"{100 * length:g}", report["vertices"], f"{ratio:.4f}"]
    print(*row, flush=True)
    return row


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="FOLDER", help="of models")
    parser.add_argument("--density", choices=["uniform", "curvature"], default="uniform")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (1)")
    parser.add_argument("--results", default=str(ROOT / "build/resolution"), metavar="FOLDER",
                        help="of resolution.md (build/resolution)")
    parser.add_argument("--programs", metavar="FOLDER",
                        help="of power_rtf_remesh, judge and distance_runs; default: built here")
    options = parser.parse_args()
    if not options.programs:
        build(["power_rtf_remesh", "judge", "distance_runs"])
        options.programs = BUILD / "bin"
    options.program = pathlib.Path(options.programs, "power_rtf_remesh").resolve()
    options.judge = pathlib.Path(options.programs, "judge").resolve()
    options.distance_runs = pathlib.Path(options.programs, "distance_runs").resolve()
    return options


def main():
    options = parse_arguments()
    results = pathlib.Path(options.results)
    models = Models(options.folders, results / "models")
    there = [(name, models.get(name)) for name in MODELS if models.get(name)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, \
            concurrent.futures.ThreadPoolExecutor(len(there) * len(DISTANCES)) as rows:
        distances = list(rows.map(lambda row: distance_row(options, pool, *row),
                                  [(*m, d) for m in there for d in DISTANCES]))
        lengths = list(pool.map(lambda row: length_row(options, *row),
                                [(*m, length) for m in there for length in LENGTHS]))
    text = TEXT + markdown(["model", "asked", "n", "bound", "judge", "kept", "fewest", "n / fewest",
                            "of more", "runs"], [row for row, _ in distances])
    text += "\nLengths: `--relative-edge-length X`, in % of the diagonal; the median edge over it.\n\n"
    text += markdown(["model", "asked", "n", "median / asked"], lengths)
    text += "\n" + made_by(__file__, [os.path.basename(argument.rstrip("/"))
                                      for argument in sys.argv[1:]]) + "\n"
    results.mkdir(parents=True, exist_ok=True)
    (results / "resolution.md").write_text(text, encoding="utf-8")
    return 0 if all(is_met for _, is_met in distances) else 1


if __name__ == "__main__":
    sys.exit(main())
