#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run power_rtf_remesh on meshes that intersect themselves: are its meshes free of that?

intersections.py                      the tests' shapes and CGAL's models; programs are built
intersections.py --samples 300 3000   instead of 1000
intersections.py FOLDER_OR_FILE ...   of others, those that intersect themselves

Each mesh is resolved and wrapped. A judge that shares no code with the package counts in the files,
by exact predicates. Results: runs.csv and summary.md in the folder --results.

What became of a run:
clean      the program ended with 0, and the judge found no facets that intersect, the number of
           vertices that was asked for, and what the report calls the topology of the cured input:
           its sheets, components, and Euler characteristic, edges of more than two facets only
           where it has some
missed     the program ended with 3 and said which guarantees were missed
rejected   the program ended with 1 and said why
silent     the program ended with 0, but the judge found something else
crash, time limit, memory limit
The exit code is 1 when a mesh has no clean run, or a run was silent, a crash or met a limit.
"""

import argparse
import concurrent.futures
import csv
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import BUILD, DATA, ROOT, build, made_by, markdown  # noqa: E402
from robustness import exact_counts, execute, meshes  # noqa: E402

CURES = ["resolve", "wrap"]
KEY = ["model", "intersections", "samples", "density"]
FIELDS = KEY + ["result", "reason", "input_pairs", "vertices", "sheets", "non_manifold_edges", "q_min",
                "theta_min", "distance_max", "seconds", "megabytes"]
BAD = ["silent", "crash", "time limit", "memory limit"]
RESULTS = ["clean", "missed", "rejected"] + BAD


def defects(found, report):
    """In what the file differs from what was promised, or nothing."""
    expected = {"vertices": report["samples"], "unused_vertices": 0, "degenerate_facets": 0,
                "self_intersections": 0}
    is_network = report["input_non_manifold_edges"] > 0
    for name in ("components", "euler_characteristic", *(["sheets"] if is_network else [])):
        expected[name] = report["input_" + name]
    if not is_network:
        expected["non_manifold_edges"] = 0
        expected["non_manifold_vertices"] = report["input_non_manifold_vertices"]
    elif found["non_manifold_edges"] == 0:
        expected["non_manifold_edges"] = "some"
    return "; ".join(f"{name}: {found[name]} instead of {value}"
                     for name, value in expected.items() if found[name] != value)


def run(options, model, pairs, cure, samples, density):
    """One row of runs.csv."""
    row = dict.fromkeys(FIELDS, "")
    row.update(model=model.name, intersections=cure, samples=samples, density=density,
               input_pairs=pairs)
    with tempfile.TemporaryDirectory() as folder:
        mesh, report_file = os.path.join(folder, "mesh.off"), os.path.join(folder, "report.json")
        code, errors, seconds, usage = execute(
            [options.program, str(model), mesh, "--samples", str(samples), "--density", density,
             "--intersections", cure, "--report", report_file, "--quiet"],
            options.seconds, options.megabytes)
        row.update(seconds=f"{seconds:.2f}", megabytes=usage.ru_maxrss // 1024)
        row["reason"] = errors.replace(str(model), model.name).replace("power_rtf_remesh: ", "")
        if code is None:
            row["result"] = "time limit"
        elif code == 1:
            row["result"] = "memory limit" if "memory" in errors else "rejected"
        elif code not in (0, 3):
            row.update(result="crash", reason=f"exit code {code}; " + row["reason"])
        else:
            report = json.loads(pathlib.Path(report_file).read_text(encoding="utf-8"))
            found = exact_counts(options.judge, mesh)
            row.update(vertices=found["vertices"], sheets=found["sheets"],
                       non_manifold_edges=found["non_manifold_edges"],
                       q_min=f"{report['q_min']:.3f}", theta_min=f"{report['theta_min']:.1f}",
                       distance_max=f"{report['distance_max']:.3f}")
            row.update(result="missed", reason="; ".join(report["missed_guarantees"]))
            if code == 0:
                row["reason"] = defects(found, report)
                row["result"] = "silent" if row["reason"] else "clean"
    return row


def summary(rows, arguments):
    """The tables of all runs, as Markdown."""
    models = {row["model"] for row in rows}
    lines = [f"# Inputs that intersect themselves\n\n{len(rows)} runs on {len(models)} meshes. "
             + made_by(__file__, arguments) + " The words are explained there.\n"]
    shown = [r for r in RESULTS if any(row["result"] == r for row in rows)]
    groups = sorted({(row["intersections"], int(row["samples"]), row["density"]) for row in rows})
    body = []
    for cure, samples, density in groups:
        of_group = [row["result"] for row in rows
                    if (row["intersections"], row["density"]) == (cure, density)
                    and int(row["samples"]) == samples]
        body.append([cure, samples, density, len(of_group), *map(of_group.count, shown)])
    lines.append(markdown(["intersections", "samples", "density", "runs", *shown], body, left=3))
    rest = [row for row in rows if row["result"] != "clean"]
    if rest:
        columns = [*KEY, "result", "reason"]
        lines.append(markdown(columns, [[str(row[name]).replace("|", "\\|") for name in columns]
                                        for row in rest], left=6))
    return "\n".join(lines)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="FOLDER_OR_FILE",
                        help="default: the tests' shapes and CGAL's models (in POWER_RTF_DATA)")
    parser.add_argument("--samples", nargs="+", type=int, default=[1000], metavar="N")
    parser.add_argument("--density", nargs="+", choices=["uniform", "curvature"],
                        default=["uniform", "curvature"])
    parser.add_argument("--intersections", nargs="+", choices=CURES, default=CURES)
    parser.add_argument("--seconds", type=float, default=60, help="limit of each run (60)")
    parser.add_argument("--megabytes", type=int, default=4096, help="limit of each run (4096)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (1)")
    parser.add_argument("--results", default=str(ROOT / "build/intersections"), metavar="FOLDER",
                        help="of runs.csv and summary.md (build/intersections)")
    parser.add_argument("--binaries", type=pathlib.Path,
                        help="folder of the programs; default: built here")
    return parser.parse_args()


def main():
    options = parse_arguments()
    if not options.binaries:
        build(["power_rtf_remesh", "shape_models", "exact_counts"])
        options.binaries = BUILD / "bin"
    options.program = str((options.binaries / "power_rtf_remesh").resolve())
    options.judge = str(options.binaries / "exact_counts")
    results = pathlib.Path(options.results)
    results.mkdir(parents=True, exist_ok=True)
    if not options.meshes:
        shapes = results / "shapes"
        shapes.mkdir(exist_ok=True)
        subprocess.run([options.binaries / "shape_models", "crossing", shapes], check=True)
        options.meshes = [shapes, os.environ.get("POWER_RTF_DATA", str(DATA))]
    crossing = []
    for model in meshes(options.meshes, float("inf")):
        found = exact_counts(options.judge, model)
        if found and found["self_intersections"] > 0:
            crossing.append((model, found["self_intersections"]))
    if not crossing:
        print("no mesh that intersects itself", file=sys.stderr)
        return 77
    rows = []
    with open(results / "runs.csv", "w", encoding="utf-8", newline="") as file, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        writer = csv.DictWriter(file, FIELDS)
        writer.writeheader()
        todo = itertools.product(crossing, options.intersections, options.samples, options.density)
        for row in pool.map(lambda t: run(options, *t[0], *t[1:]), todo):
            writer.writerow(row)
            file.flush()
            rows.append(row)
            print(*(row[name] for name in KEY), row["result"], row["reason"], flush=True)
    text = summary(rows, [os.path.basename(argument.rstrip("/")) for argument in sys.argv[1:]])
    (results / "summary.md").write_text(text, encoding="utf-8")
    print(text, end="")
    clean = {row["model"] for row in rows if row["result"] == "clean"}
    is_bad = any(row["result"] in BAD for row in rows)
    return 1 if is_bad or len(clean) < len(crossing) else 0


if __name__ == "__main__":
    sys.exit(main())
