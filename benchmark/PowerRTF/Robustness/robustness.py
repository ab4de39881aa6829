#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run power_rtf_remesh on every mesh of some folders; which guarantees are met, and which missed?

robustness.py                                    CGAL's models; the program is built when needed
robustness.py FOLDER_OR_FILE ...                 others
robustness.py --samples 300 30000 --seeds 0 1 2  instead of 100, 1000 and 3000, and of seed 0
robustness.py --quick                            the short form: 200 samples, even, small files

Every run has a limit of time and of memory. Runs are written one by one to runs.csv in the folder
--results: a driver that was stopped goes on where it was when it is called again. At its end
summary.md is made from that file, with the command, the commit and the date.

What became of a run:
met            the program ended with 0: it promises all guarantees. The mesh that it wrote is
               counted again here (vertices, 2-manifold, orientation, Euler characteristic,
               components, border loops), its self-intersections by the tests' judge, with exact
               predicates and no code of the package, and was found as promised
missed         the program ended with 3 and said which guarantees were missed
bad input      the same, but all that was missed are self-intersections, and the input has some
rejected       the program ended with 1 and said why: the input cannot be used, or not with so
               few samples
broken promise the program ended with 0, but the mesh is not as promised
time limit, memory limit, crash
The exit code is 1 when there was a broken promise, a crash or a limit was met, else 0; with
--all-met also when anything was missed; 77 when there is no mesh. Needs nothing beside Python and
the programs.
"""

import argparse
import collections
import concurrent.futures
import csv
import json
import os
import pathlib
import re
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import BUILD, DATA, ROOT, build, made_by, markdown  # noqa: E402

FORMATS = {".off", ".obj", ".ply", ".stl"}
KEY = ["model", "samples", "density", "seed"]
FIELDS = KEY + ["result", "reason", "vertices", "euler", "components", "border_loops",
                "self_intersections", "q_min", "theta_min", "distance_max", "repairs", "seconds",
                "cpu_seconds", "megabytes"]
BAD = ["broken promise", "crash", "time limit", "memory limit"]
RESULTS = ["met", "missed", "bad input", "rejected"] + BAD


def meshes(paths, largest):
    """The mesh files among `paths` and in the folders among them, up to `largest` bytes."""
    files = []
    for path in map(pathlib.Path, paths):
        found = path.iterdir() if path.is_dir() else [path] if path.exists() else []
        files += [f for f in found if f.suffix.lower() in FORMATS and f.stat().st_size <= largest]
    return sorted(files, key=lambda f: (f.name, str(f)))


def count_topology(file):
    """Counts of a triangle mesh in an OFF file, independent of the program that wrote it."""
    words = iter(pathlib.Path(file).read_text(encoding="ascii").split())
    next(words)
    vertices, facets, _ = (int(next(words)) for _ in range(3))
    for _ in range(3 * vertices):
        next(words)
    triangles = []
    for _ in range(facets):
        if next(words) != "3":
            raise ValueError("a facet is no triangle")
        triangles.append(tuple(int(next(words)) for _ in range(3)))
    halfedges = collections.Counter()
    parent = list(range(vertices))

    def root(v):
        while parent[v] != v:
            parent[v] = v = parent[parent[v]]
        return v

    links = [{} for _ in range(vertices)]  # around each vertex: from one neighbor to the next
    oriented = True
    for a, b, c in triangles:
        for u, v, w in ((a, b, c), (b, c, a), (c, a, b)):
            halfedges[u, v] += 1
            oriented = oriented and v not in links[u]
            links[u][v] = w
        parent[root(a)] = parent[root(b)] = root(c)
    edges = {(min(e), max(e)) for e in halfedges}
    manifold = oriented and all(count == 1 for count in halfedges.values())
    for link in links:  # the facets around a vertex: one fan or one disk
        ends = set(link) - set(link.values())
        start = next(iter(ends), next(iter(link), None))
        length, v = 0, start
        while v in link and length <= len(link):
            v = link[v]
            length += 1
            if v == start:
                break
        manifold = manifold and length == len(link) > 0 and len(ends) <= 1
    border = {u: v for v, u in halfedges if (u, v) not in halfedges}
    loops, left = 0, set(border)
    while left:
        loops += 1
        v = next(iter(left))
        while v in left:
            left.remove(v)
            v = border[v]
    return {"vertices": vertices, "manifold": manifold,
            "euler_characteristic": vertices - len(edges) + facets,
            "components": len({root(v) for v in range(vertices)}), "border_loops": loops}


def exact_counts(judge, file):
    """What the tests' judge counts in a file, or nothing if it has polygons."""
    done = subprocess.run([judge, file], capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else None


def broken_promise(file, report, judge=None):
    """In what the mesh differs from what was promised, or nothing; without a judge its
    self-intersections are not counted."""
    found = count_topology(file)
    expected = {"vertices": report["samples"]}
    for name in ("euler_characteristic", "components", "border_loops"):
        expected[name] = report["input_" + name]
    is_network = report["input_non_manifold_edges"] + report["input_non_manifold_vertices"] > 0
    if report["oriented"]:
        expected["manifold"] = not is_network
    if judge:
        found["self_intersections"] = exact_counts(judge, file)["self_intersections"]
        expected["self_intersections"] = 0
    if is_network or not report["oriented"]:
        # the facets' directions do not tell the borders where sheets meet, or of a one-sided one
        del expected["border_loops"]
    return "; ".join(f"{name}: {found[name]} instead of {value}"
                     for name, value in expected.items() if found[name] != value)


def execute(command, seconds, megabytes):
    """Exit code (negative: signal; None: stopped at the time limit), stderr and the usage."""
    def limit():
        size = megabytes * 2**20
        resource.setrlimit(resource.RLIMIT_AS, (size, size))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with tempfile.TemporaryFile() as errors:
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors,
                                   preexec_fn=limit)
        late = threading.Event()

        def stop():
            late.set()
            os.kill(process.pid, signal.SIGKILL)

        timer = threading.Timer(seconds, stop)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)  # the usage of this process alone
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        elapsed = time.monotonic() - start
        errors.seek(0)
        text = errors.read().decode(errors="replace").strip()
    return None if late.is_set() else process.returncode, text, elapsed, usage


def run(options, model, samples, density, seed):
    """One row of runs.csv."""
    row = dict.fromkeys(FIELDS, "")
    row.update(model=model.name, samples=samples, density=density, seed=seed)
    with tempfile.TemporaryDirectory() as folder:
        mesh, report_file = os.path.join(folder, "mesh.off"), os.path.join(folder, "report.json")
        command = [options.program, str(model), mesh, "--samples", str(samples), "--density",
                   density, "--seed", str(seed), "--report", report_file, "--quiet",
                   *shlex.split(options.options)]
        code, errors, seconds, usage = execute(command, options.seconds, options.megabytes)
        row.update(seconds=f"{seconds:.2f}", megabytes=usage.ru_maxrss // 1024,
                   cpu_seconds=f"{usage.ru_utime + usage.ru_stime:.2f}")
        lines = [re.sub(r"^power_rtf_remesh: ", "", line).replace(str(model) + ": ", "")
                 for line in errors.splitlines()]
        row["reason"] = "; ".join(lines)
        if code is None:
            row["result"], row["reason"] = "time limit", f"{options.seconds:g} s"
        elif code == 1 and "memory" in errors:
            row["result"], row["reason"] = "memory limit", f"{options.megabytes} MiB"
        elif code == 1:
            row["result"] = "rejected"
        elif code not in (0, 3):
            row["result"] = "crash"
            row["reason"] = f"exit code {code}; " + row["reason"]
        else:
            with open(report_file, encoding="utf-8") as file:
                report = json.load(file)
            row.update(vertices=report["vertices"], euler=report["euler_characteristic"],
                       components=report["components"], border_loops=report["border_loops"],
                       self_intersections=report["self_intersections"],
                       q_min=f"{report['q_min']:.3f}", theta_min=f"{report['theta_min']:.1f}",
                       distance_max=f"{report['distance_max']:.3f}",
                       repairs="; ".join(f"{name.replace('_', ' ')}: {count}"
                                         for name, count in report["repairs"].items() if count))
            missed = report["missed_guarantees"]
            row["result"], row["reason"] = "missed", "; ".join(missed)
            if len(missed) == 1 and report["input_self_intersections"] > 0:
                row["result"] = "bad input"
            if code == 0:
                row["reason"] = broken_promise(mesh, report, options.judge)
                row["result"] = "broken promise" if row["reason"] else "met"
    return row


def kind_of(reason):
    """Reasons that differ in numbers only are of one kind."""
    return re.sub(r"\d+", "N", reason)


def table(columns, rows):
    """Rows of anything as Markdown."""
    return markdown(columns, [[str(cell).replace("|", "\\|") for cell in row]
                              for row in rows]).rstrip("\n")


def summary(rows, arguments):
    """The tables of all runs, as Markdown."""
    counts = collections.Counter((row["samples"], row["density"], row["result"]) for row in rows)
    groups = sorted({(int(row["samples"]), row["density"]) for row in rows})
    shown = [r for r in RESULTS if any(row["result"] == r for row in rows)]
    lines = ["# Robustness", "",
             f"{len(rows)} runs on {len({row['model'] for row in rows})} meshes. "
             + made_by(__file__, arguments) + " The words are explained there.", ""]
    body = [[n, density, sum(counts[str(n), density, r] for r in RESULTS),
             *(counts[str(n), density, r] for r in shown)] for n, density in groups]
    body.append(["all", "", len(rows), *(sum(row["result"] == r for row in rows) for r in shown)])
    lines.append(table(["samples", "density", "runs", *shown], body))
    for result in RESULTS[1:]:
        of_kind = collections.defaultdict(list)
        for row in rows:
            if row["result"] == result:
                of_kind[kind_of(row["reason"])].append(row)
        if not of_kind:
            continue
        lines += ["", f"## {result.capitalize()}", ""]
        body = []
        for reason, those in sorted(of_kind.items(), key=lambda item: (-len(item[1]), item[0])):
            runs = collections.defaultdict(list)
            for row in those:
                runs[row["model"]].append(int(row["samples"]))
            body.append([reason, len(those), ", ".join(
                f"{model} ({', '.join(map(str, sorted(set(n))))})" for model, n in runs.items())])
        lines.append(table(["reason", "runs", "meshes (samples)"], body))
    return "\n".join(lines) + "\n"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="FOLDER_OR_FILE",
                        default=[os.environ.get("POWER_RTF_DATA", str(DATA))],
                        help="OFF, OBJ, PLY, STL; default: CGAL's models (in POWER_RTF_DATA)")
    parser.add_argument("--samples", nargs="+", type=int, metavar="N")
    parser.add_argument("--density", nargs="+", choices=["uniform", "curvature"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[0], metavar="N")
    parser.add_argument("--seconds", type=float, default=60, help="limit of each run (60)")
    parser.add_argument("--megabytes", type=int, default=4096, help="limit of each run (4096)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (1)")
    parser.add_argument("--results", default=str(ROOT / "build/robustness"), metavar="FOLDER",
                        help="of runs.csv and summary.md (build/robustness)")
    parser.add_argument("--program", help="power_rtf_remesh; default: built here")
    parser.add_argument("--judge", help="exact_counts; default: beside the program")
    parser.add_argument("--options", default="", help="more options for the program, as one word")
    parser.add_argument("--quick", action="store_true",
                        help="200 samples, even, files up to 300 kB, 20 s")
    parser.add_argument("--again", action="store_true", help="forget the runs in --results")
    parser.add_argument("--all-met", action="store_true",
                        help="a missed guarantee is a failure, too")
    options = parser.parse_args()
    options.largest = 300_000 if options.quick else float("inf")
    if options.quick:
        options.seconds = min(options.seconds, 20)
    options.samples = options.samples or ([200] if options.quick else [100, 1000, 3000])
    options.density = options.density or (["uniform"] if options.quick
                                          else ["uniform", "curvature"])
    return options


def main():
    options = parse_arguments()
    if not options.program:
        build(["power_rtf_remesh", "exact_counts"])
        options.program = BUILD / "bin/power_rtf_remesh"
    options.program = str(pathlib.Path(options.program).resolve())
    options.judge = options.judge or str(pathlib.Path(options.program).with_name("exact_counts"))
    results = pathlib.Path(options.results)
    results.mkdir(parents=True, exist_ok=True)
    runs_file = results / "runs.csv"
    rows = []
    if runs_file.exists() and not options.again:
        with open(runs_file, encoding="utf-8", newline="") as file:
            rows = [row for row in csv.DictReader(file) if None not in row.values()]
    done = {tuple(row[name] for name in KEY) for row in rows}
    models = meshes(options.meshes, options.largest)
    if not models:
        print("no mesh in " + ", ".join(options.meshes), file=sys.stderr)
        return 77
    todo = [(model, n, density, seed) for n in options.samples for model in models
            for density in options.density for seed in options.seeds
            if (model.name, str(n), density, str(seed)) not in done]

    with open(runs_file, "w", encoding="utf-8", newline="") as file, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        writer = csv.DictWriter(file, FIELDS)
        writer.writeheader()
        writer.writerows(rows)  # without a row that was cut off
        file.flush()
        try:
            for row in pool.map(lambda task: run(options, *task), todo):
                row = {name: str(value) for name, value in row.items()}
                writer.writerow(row)
                file.flush()
                rows.append(row)
                print(f"{len(rows)}/{len(done) + len(todo)}", *(row[name] for name in KEY),
                      row["result"], row["reason"], flush=True)
        except KeyboardInterrupt:  # what is done can be seen in summary.md
            pool.shutdown(cancel_futures=True)
    text = summary(rows, [os.path.basename(argument.rstrip("/")) for argument in sys.argv[1:]])
    (results / "summary.md").write_text(text, encoding="utf-8")
    print(text, end="")
    failures = BAD + (["missed"] if options.all_met else [])
    return 1 if any(row["result"] in failures for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
