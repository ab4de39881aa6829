#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshers that are Python packages side by side: what one call gives to a user who asks for n
vertices, without a search.

python_peers.py                     on some of CGAL's models, with 3000 vertices
python_peers.py --powerrtf WHEEL    with this wheel, instead of building the package

Makes an environment in the output folder with all packages that pip installs. Results:
python_peers.md and .csv.
"""

import argparse
import ast
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import (BUILD, DATA, ROOT, build, made_by, markdown, notice,  # noqa: E402
                    python_environment, update_block, write_csv)
import figures  # noqa: E402
import peers as other  # noqa: E402
from models import Models  # noqa: E402
from runs import Failed, Runner  # noqa: E402

# As in peers.PYTHON_PEERS.
OURS = "powerrtf", "PowerRTF, powerrtf", ("uniform",), other.number
PACKAGES = (OURS, *(peer[:4] for peer in other.PYTHON_PEERS),
            # reproduce.py has these two by other bindings
            ("compas_cgal", "CGAL isotropic_remeshing, compas_cgal", ("uniform",), other.edge_length),
            ("pynanoinstantmeshes", "Instant Meshes, pynanoinstantmeshes", ("uniform",), other.number))
CREASE_ANGLES = {"Bunny": 180, "Homer": 180, "Elk": 180, "Fandisk": 40}  # 180: no creases are asked for
MODEL_IN_SHORT = "Elk"
COLUMNS = ("model", "package", "n asked", "got", "Q<sub>min</sub>", "Q<sub>avg</sub>", "θ<sub>min</sub>",
           "intersections", "d<sub>H</sub>", "d<sub>max</sub>", "CPU (s)", "lines", "topology")
TEXT = """Each package is asked once for {n} vertices: by their number, or else ("length") by the length \
that edges of so many evenly spread vertices have, from the area of the surface. Where that is all that a \
package takes, a search for n is left to its user. The judge is that of [results.md](results.md), and so \
are the columns; intersections: pairs of triangles that intersect. CPU seconds: of the calls, with files \
read and written, without the interpreter and the packages' import. Lines: those of the code that calls \
the package, in `peer_python.py`, where arrays are read and written for all that take them. On Fandisk \
creases of 40° are asked for where the package can keep them. Not here: libigl 2.6.3 and geogram 0.0.7 \
offer no remeshing, and pymmg 1.0.0 is a program without calls from Python.
"""


def lines_of_code(package):
    """Of what uses the package in peer_python.py: all lines of `with_PACKAGE` but its head, those of
    functions in it, and blank ones."""
    tree = ast.parse(pathlib.Path(__file__).with_name("peer_python.py").read_text(encoding="utf-8"))
    function = next(node for node in tree.body if getattr(node, "name", "") == f"with_{package}")
    lines = set()
    for node in ast.walk(function):
        if isinstance(node, (ast.stmt, ast.expr)) and not isinstance(node, ast.FunctionDef):
            lines.update(range(node.lineno, node.end_lineno + 1))
    return len(lines)


def compare(runner, models, peers, n):
    """The rows of the table."""
    futures = [(model, peer, package, start,
                runner.later(run, runner, model, models.get(model), peer, n))
               for model in CREASE_ANGLES if models.get(model)
               for peer, package, start in peers]
    rows = []
    for model, peer, package, start, future in futures:
        asked = str(n) if start is other.number else "length"
        row = [model, f"{peer.name} {peer.version}", asked]
        try:
            result = future.result()
            row += [result["vertices"], f"{result['q_min']:.3f}", f"{result['q_avg']:.3f}",
                    f"{result['theta_min']:.2f}", result["self_intersections"],
                    f"{result['distance_rms']:.3f}", f"{result['distance_max']:.2f}",
                    f"{result['cpu']:.2f}", lines_of_code(package), figures.topology(result)]
        except Failed as error:
            notice(f"  {peer.name}, {model}: {error}")
            row += [*[""] * 8, lines_of_code(package), f"failed: {error}"]
        rows.append(row)
    return rows


def run(runner, name, model, peer, n):
    crease_angle = CREASE_ANGLES[name]
    return runner.keep(
        f"{peer.name} {name}", f"{peer.name} {peer.version} {crease_angle} {other.digest(model)}",
        model, "mesh.ply", lambda folder: peer.once(
            runner, peer.call(model, folder / "mesh.ply", "uniform", n, crease_angle)))[0]


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--powerrtf", type=pathlib.Path, default=ROOT, metavar="WHEEL",
                        help="default: build it")
    parser.add_argument("-n", type=int, default=3000, help="vertices (default: 3000)")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "output/python_peers",
                        metavar="FOLDER", help="default: output/python_peers")
    parser.add_argument("--results", type=pathlib.Path, metavar="FOLDER",
                        help="of the tables (default: the output's)")
    parser.add_argument("--binaries", type=pathlib.Path,
                        help="folder of the built program judge; default: build it")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), metavar="N",
                        help="runs at a time (default: one per core)")
    parser.add_argument("--update", type=pathlib.Path, metavar="FILE",
                        help="replace the block `python peers` of this file")
    return parser.parse_args()


def main():
    options = parse()
    options.output.mkdir(parents=True, exist_ok=True)
    results = options.results or options.output
    if not options.binaries:
        build(("judge",))
        options.binaries = BUILD / "bin"
    python, missing = python_environment(options.output / "environment",
                                         ["pyvista", *(package[0] for package in PACKAGES[1:])])
    if python is None:
        return 77
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps",
                    options.powerrtf], check=True)
    peers = [(peer, description[0], description[3]) for description in PACKAGES
             for peer in other.python_peer(python, missing, *description)]
    models = Models([os.environ.get("POWER_RTF_DATA", DATA)], options.output / "models")
    judge = options.binaries / "judge"
    with tempfile.TemporaryDirectory() as folder:  # judge, too, for the program, which does not run
        rows = compare(Runner(folder, judge, judge, "", options.jobs, 900), models, peers, options.n)
    footer = made_by(__file__, [])
    write_csv(results / "python_peers.csv", COLUMNS, rows)
    (results / "python_peers.md").write_text(
        "# Remeshers that are Python packages, by one call each\n\n" + TEXT.format(n=options.n) + "\n" +
        markdown(COLUMNS, rows, 2) + "\n" + footer + "\n", encoding="utf-8")
    if options.update:
        short = [row[1:] for row in rows if row[0] == MODEL_IN_SHORT]
        update_block(options.update, "python peers", markdown(COLUMNS[1:], short) + "\n" + footer + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
