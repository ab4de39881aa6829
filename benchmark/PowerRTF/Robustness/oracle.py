#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare the cells of many optimizations with the exact ones: is any certified and wrong?

oracle.py                              CGAL's models, 100 million cells of the CPU's engine
oracle.py --traits cuda                of the GPU's
oracle.py --cells 1e6 FOLDER_OR_FILE   fewer, of other models

After each iteration of each run all cells are compared (`power_rtf_remesh --check --check-every`):
of uniform and curvature-adapted sampling with the preset quality, and of the preset paper, whose
weights are large; with more seeds until there are enough cells, so that the speed of the runs
decides which are the last. Results: runs.csv and a table, oracle.md, in the folder --results. Runs
are written one by one: a driver that was stopped goes on where it was when it is called again. The
exit code is 1 when a cell was certified and wrong or a run crashed; 77 when there is no mesh.
"""

import argparse
import collections
import concurrent.futures
import csv
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import BUILD, DATA, ROOT, build, made_by, markdown  # noqa: E402
from robustness import meshes  # noqa: E402

COUNTS = ("cells", "equal_cycles", "certified_wrong", "uncertified_right", "uncertified_wrong",
          "differing_edges", "predicates_filtered", "predicates_exact")
ERRORS = ("area_error", "centroid_error")
KEY = ("model", "family", "samples", "seed")
FIELDS = (*KEY, "status", *COUNTS, *ERRORS)
TYPES = {**dict.fromkeys(FIELDS, int), "model": str, "family": str, **dict.fromkeys(ERRORS, float)}
FAMILIES = {"uniform": ["--density", "uniform"], "curvature": ["--density", "curvature"],
            "paper": ["--preset", "paper", "--iterations", "10"]}
ENDED = (0, 4)  # exit codes of the program: all right, and a certified cell is wrong
REJECTED = 1


def run(options, model, family, samples, seed):
    """One row of runs.csv."""
    row = dict.fromkeys(FIELDS, 0)
    row.update(model=model.name, family=family, samples=samples, seed=seed)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "report.json"
        row["status"] = subprocess.run(
            [options.program, model, "--no-mesh", "--check", "--check-every", "1", "--quiet",
             "--threads", "1", "--traits", options.traits, "--samples", str(samples), "--seed",
             str(seed), "--report", file, *FAMILIES[family]],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode
        if row["status"] not in ENDED:
            return row
        checks = json.loads(file.read_text(encoding="utf-8"))["checks"]
    for check in checks:
        for name in COUNTS:
            row[name] += check[name]
        for name in ERRORS:
            row[name] = max(row[name], check[name]["max"])
    return row


def total(rows):
    return [len(rows), *(sum(row[name] for row in rows) for name in COUNTS),
            *(f"{max((row[name] for row in rows), default=0):.1e}" for name in ERRORS)]


def summary(options, rows, arguments):
    ended = [row for row in rows if row["status"] in ENDED]
    rejected = sum(row["status"] == REJECTED for row in rows)
    groups = collections.defaultdict(list)
    for row in ended:
        groups[row["family"], row["samples"]].append(row)
    shown = [[*key, *total(of_key)] for key, of_key in sorted(groups.items())]
    shown.append(["all", "", *total(ended)])
    names = [name.replace("_", " ") for name in (*COUNTS, *ERRORS)]
    return (f"# The cells of the traits {options.traits} and the exact ones\n\n"
            f"{len({row['model'] for row in ended})} meshes; {rejected} runs were rejected with a "
            f"reason, {len(rows) - len(ended) - rejected} crashed. Errors: the largest, relative. "
            f"{made_by(__file__, arguments, options.origin)}\n\n"
            + markdown(["family", "samples", "runs", *names], shown, left=2))


def tasks(options, models):
    for seed in itertools.count():
        for samples in options.samples:
            for model in models:
                for family in FAMILIES:
                    yield model, family, samples, seed


def key(row):
    return tuple(row[name] for name in KEY)


def runs_before(file):
    """The rows of a driver that was stopped, whose last one may be cut off."""
    if not file.exists():
        return []
    with open(file, encoding="utf-8", newline="") as lines:
        return [{name: TYPES[name](value) for name, value in row.items()}
                for row in csv.DictReader(lines) if None not in row.values()]


def measure(options, models, rows, note):
    """Adds rows until there are enough cells; `note(row)` is called for each."""
    done, lock = set(map(key, rows)), threading.Lock()
    todo = (task for task in tasks(options, models) if (task[0].name, *task[1:]) not in done)
    first_round = len(FAMILIES) * len(models) * len(options.samples)

    def work():
        while True:
            with lock:
                cells = sum(row["cells"] for row in rows)
                if cells >= options.cells or (len(rows) >= first_round and cells == 0):
                    return
                task = next(todo)
            row = run(options, *task)
            with lock:
                rows.append(row)
                note(row)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for job in [pool.submit(work) for _ in range(options.jobs)]:
            job.result()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="FOLDER_OR_FILE",
                        default=[os.environ.get("POWER_RTF_DATA", str(DATA))])
    parser.add_argument("--traits", choices=["cpu", "cuda"], default="cpu")
    parser.add_argument("--cells", type=float, default=1e8, help="at least (1e8)")
    parser.add_argument("--samples", nargs="+", type=int, default=[1000, 3000, 10000], metavar="N")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time (all cores)")
    parser.add_argument("--results", default=str(ROOT / "build/oracle"), metavar="FOLDER")
    parser.add_argument("--program", help="power_rtf_remesh; default: built here")
    parser.add_argument("--origin", help="commit, day and machine, if they are not these")
    options = parser.parse_args()
    if not options.program:
        build(["power_rtf_remesh"])
        options.program = BUILD / "bin/power_rtf_remesh"
    models = meshes(options.meshes, float("inf"))
    if not models:
        print("no mesh in " + ", ".join(map(str, options.meshes)), file=sys.stderr)
        return 77
    results = pathlib.Path(options.results)
    results.mkdir(parents=True, exist_ok=True)
    rows = runs_before(results / "runs.csv")
    with open(results / "runs.csv", "w", newline="", encoding="utf-8", buffering=1) as file:
        writer = csv.DictWriter(file, FIELDS)
        writer.writeheader()
        writer.writerows(rows)
        measure(options, models, rows, writer.writerow)
    rows.sort(key=key)
    text = summary(options, rows, [os.path.basename(a.rstrip("/")) for a in sys.argv[1:]])
    (results / "oracle.md").write_text(text, encoding="utf-8")
    print(text, end="")
    failed = any(row["status"] not in (0, REJECTED) for row in rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
