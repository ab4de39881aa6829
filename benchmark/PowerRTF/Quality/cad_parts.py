#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mechanical parts: this project's program and other remeshers with the same number of vertices, and
the tetrahedra that Gmsh makes inside their surfaces.

cad_parts.py                    on CGAL's fandisk and the parts that are built in code, at n = 3000
cad_parts.py --models FOLDER    also on your fandisk.obj

Makes an environment in the output folder with the packages from PyPI. Results: cad_parts.md and
.csv.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import (BUILD, DATA, ROOT, build, made_by, markdown, notice,  # noqa: E402
                    python_environment, write_csv)
import figures  # noqa: E402
import peers as other  # noqa: E402
from models import Models  # noqa: E402
from reproduce import CREASE_ANGLE, PARTS  # noqa: E402
from runs import Failed, Runner  # noqa: E402

TARGETS = ("power_rtf_remesh", "judge", "shape_models", "peers")
COLUMNS = ("model", "vertices", "tool", *figures.MEASURES, "d<sub>max</sub>", "tetrahedra",
           "mean γ", "least γ", "CPU (s)", "topology")
TEXT = """Uniform, {n} vertices (within 1 %, or else the nearest within 10 %, by a search over the tool's \
length or tolerance), creases of {angle}° and more asked for where the tool can keep them: see \
[results.md](results.md) for the judge, the columns and what the tools are. Distances in % of the diagonal. \
The tetrahedra are those of Gmsh {gmsh}, with its own settings, inside the tool's surface, which it keeps \
as it is; γ: 3 times the inscribed over the circumscribed radius. No tetrahedra: Gmsh cannot fill the \
surface, as it has borders or intersects itself. Tools that are .5 % away and more cut creases off, which \
leaves room for rounder triangles, and tetrahedra in no wedges; with `--features 180` PowerRTF does, too. \
The smallest angle between two creases of Fandisk is \
19.4°: whoever keeps it has a triangle with about that angle.
"""


def tetrahedra(python, folder, mesh):
    """What tetrahedra.py says of a mesh, kept in its folder; empty where Gmsh gives none."""
    kept = folder / "tetrahedra.json"
    if not kept.exists():
        script = pathlib.Path(__file__).with_name("tetrahedra.py")
        try:
            result = subprocess.run([python, script, folder / mesh], capture_output=True, text=True,
                                    check=False, timeout=300)
            filled = result.returncode == 0
        except subprocess.TimeoutExpired:
            filled = False
        kept.write_text(result.stdout.splitlines()[-1] if filled else "{}", encoding="utf-8")
    return json.loads(kept.read_text(encoding="utf-8"))


def row(model, tool, python, mesh, future):
    try:
        result, folder = future.result()
    except Failed as error:
        notice(f"  {tool}, {model}: {error}")
        return [model, "", tool, *[""] * (len(COLUMNS) - 4), f"failed: {error}"]
    inside = tetrahedra(python, folder, mesh)
    gammas = [str(inside["tetrahedra"]), f"{inside['gamma_avg']:.3f}", f"{inside['gamma_min']:.3f}"] \
        if inside else [""] * 3
    return [model, result["vertices"], tool, *figures.cells(result), f"{result['distance_max']:.3f}",
            *gammas, f"{result['cpu']:.1f}", figures.topology(result)]


def compare(runner, models, peers, python, n):
    """The rows of the table."""
    runs = []
    for model in PARTS:
        path = models.get(model)
        if path is None:
            notice(f"There is no {model}")
            continue
        runs += [(model, f"PowerRTF, {tool}", "mesh.off", runner.later(
            runner.power_rtf, model, path, n, "--density", "uniform", "--preset", "quality", *more))
                 for tool, more in (("preset quality", ()),
                                    ("creases cut off", ("--features", "180")))]
        runs += [(model, f"{peer.name} {peer.version}".strip(), f"mesh{peer.ending}", runner.later(
            peer.run, runner, model, path, "uniform", n, CREASE_ANGLE)) for peer in peers]
    return [row(model, tool, python, mesh, future) for model, tool, mesh, future in runs]


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", type=int, default=3000, help="vertices (default: 3000)")
    parser.add_argument("--models", type=pathlib.Path, action="append", default=[], metavar="FOLDER",
                        help="of meshes, named like the parts")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "output/cad_parts",
                        metavar="FOLDER", help="default: output/cad_parts")
    parser.add_argument("--results", type=pathlib.Path, metavar="FOLDER",
                        help="of the tables (default: the output's)")
    parser.add_argument("--binaries", type=pathlib.Path,
                        help="folder of built programs; default: build them")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), metavar="N",
                        help="runs at a time (default: one per core)")
    return parser.parse_args()


def main():
    options = parse()
    results = options.results or options.output
    parts = options.output / "parts"
    parts.mkdir(parents=True, exist_ok=True)
    if not options.binaries:
        build(TARGETS)
        options.binaries = BUILD / "bin"
    packages = ["pyvista", "gmsh", *(peer[0] for peer in other.PYTHON_PEERS), "geogram"]
    python, missing = python_environment(options.output / "environment", packages)
    if python is None or "gmsh" in missing or "pyvista" in missing:
        return 77
    subprocess.run([options.binaries / "shape_models", "cad", parts], check=True)
    data = os.environ.get("POWER_RTF_DATA", DATA)
    models = Models([*options.models, data, parts], options.output / "models")
    runner = Runner(options.output / "runs", options.binaries / "power_rtf_remesh",
                    options.binaries / "judge", "cpu", options.jobs, 900)
    rows = compare(runner, models, other.find(options.binaries, python, missing), python, options.n)
    write_csv(results / "cad_parts.csv", COLUMNS, rows)
    text = TEXT.format(n=options.n, angle=CREASE_ANGLE,
                       gmsh=other.python_package(python, "gmsh")["version"])
    footer = made_by(__file__, ["--models FOLDER"] if options.models else [])
    (results / "cad_parts.md").write_text("# Mechanical parts\n\n" + text + "\n" +
                                          markdown(COLUMNS, rows, 3) + "\n" + footer + "\n",
                                          encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
