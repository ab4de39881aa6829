#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reproduces the paper table by table and figure by figure, and runs other remeshers beside.

reproduce.py                      all, on the models that CGAL has and those made here
reproduce.py --quick              a small form of all of it, in a few minutes
reproduce.py --models FOLDER      also your files (kitten.obj, rocker_arm.obj, fertility.off, ...)

Installs and builds what is missing, as ./run_tests does. Results: results.md with a table for each
figure, the same as CSV, plots and renderings. The paper's printed numbers stand beside. Runs are
kept in FOLDER/runs (FOLDER: the output's) and not repeated, so a stopped driver goes on where it
was; a program that has changed runs anew. Peers and plots need packages from PyPI, which go into
an environment of their own in FOLDER; what cannot be had is skipped with a notice. The exit code is
1 when a run of this project's program has failed or, in the preset `quality`, missed a guarantee.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import (BUILD, DATA, ROOT, build, made_by, markdown, notice,  # noqa: E402
                    python_environment, update_block, write_csv)
import figures  # noqa: E402
import peers as other  # noqa: E402
from models import Models  # noqa: E402
from runs import Failed, Runner  # noqa: E402

TARGETS = ("power_rtf_remesh", "judge", "shape_models", "peers")
PEER_COLUMNS = ("model", "density", "vertices", "tool", *figures.MEASURES, "d<sub>max</sub>",
                "d<sub>max</sub>, absolute", "edge length", "CPU (s)", "MiB", "topology")
# What the README shows, and under which heads.
MODELS_IN_SHORT = ("Kitten", "Gear")
TOOLS_IN_SHORT = ("PowerRTF, preset quality", "CGAL isotropic_remeshing", "Instant Meshes")
PEERS_IN_SHORT = {"model": "model", "tool": "tool", "Q<sub>min</sub>": "Q<sub>min</sub>",
                  "Q<sub>avg</sub>": "Q<sub>avg</sub>", "θ<sub>min</sub>": "θ<sub>min</sub>",
                  "θ<sub>max</sub>": "θ<sub>max</sub>", "d<sub>max</sub>": "distance",
                  "CPU (s)": "time (s)"}
VIEWS = {"Disc": ["--up", "z", "--elevation", "40"],
         "Three Holes": ["--up", "z", "--elevation", "50"],
         "Close Hemisphere": ["--up", "z", "--elevation", "30"], "Armadillo": ["--azimuth", "240"]}
PEER_MODELS = ("Kitten", "Homer", "Rocker", "Elk", "Armadillo", "Bunny")
PARTS = ("Fandisk", "Gear", "Plate", "Bracket")  # mechanical ones
CREASE_ANGLE = 40  # of the parts, for the tools that can keep creases: the default of our own


def compare_peers(reproduction, runner, peers, quick):
    """The same models and numbers of vertices for all tools."""
    table = figures.Table("peers", "Other remeshers", (
        "The same judge, the same number of vertices (within 1 %, or else the nearest within 10 %, "
        "by a search over the tool's length or tolerance; its cost is not counted). CPU time and "
        "peak memory of the process, with files read and written, for the program of this project "
        "with its own assessment, too (no memory below the driver's own shows, which is the least "
        "of the programs'); for Python packages without the interpreter and their import. Adaptive "
        "means what each tool offers for it, so the spacing differs between tools. On the "
        f"mechanical parts ({', '.join(PARTS)}) the other tools are asked to keep creases of "
        f"{CREASE_ANGLE}° and more (pyacvd cannot, and vorpalite smooths them, as its distances "
        "show: beside these there is a row of this project's program without creases), on the "
        "other models not; the presets quality and fast look for such creases on all, the preset "
        "paper on none. The edge length (mean, least and largest) and the absolute distance are in "
        "the model's own unit (Gear, Plate, Bracket: mm), all other distances in % of the diagonal."),
        PEER_COLUMNS)
    wanted = ("Retinal",) if quick else PEER_MODELS
    models = [m for m in wanted if reproduction.models.get(m)][:4] or ["Three Holes"]
    parts = [m for m in (PARTS[-1:] if quick else PARTS) if reproduction.models.get(m)]
    for model in models + parts:
        n, path = reproduction.size["n"], reproduction.models.get(model)
        crease_angle = CREASE_ANGLE if model in PARTS else 180
        for density in ("uniform",) if model in PARTS else ("uniform", "curvature"):
            ways = {f"preset {preset}": ("--preset", preset)
                    for preset in ("quality", "fast", "paper")}
            if model in PARTS:
                ways["no creases"] = ("--features", "180")
            for way, options in ways.items():
                add_peer(table, model, density, f"PowerRTF, {way}",
                         runner.later(runner.power_rtf, model, path, n, "--density", density,
                                      *options))
            for peer in peers:
                if density in peer.densities:
                    add_peer(table, model, density, f"{peer.name} {peer.version}".strip(),
                             runner.later(peer.run, runner, model, path, density, n,
                                          crease_angle))
    return table


def add_peer(table, model, density, tool, future):
    def row():
        try:
            result, _ = future.result()
        except Failed as error:
            notice(f"  {tool}, {model}: {error}")
            return [model, density, "", tool, *[""] * (len(figures.MEASURES) + 5),
                    f"failed: {error}"]
        table.data.append({"model": model, "density": density, "method": tool, **result})
        return [model, density, result["vertices"], tool, *figures.cells(result),
                f"{result['distance_max']:.2f}", f"{result['absolute_distance_max']:.2g}",
                figures.edge_lengths(result), f"{result['cpu']:.1f}", f"{result['memory']:.0f}",
                figures.topology(result)]

    table.rows.append(row)


def draw(python, table, folder):
    """Cells and mesh of the table's pictures, as lines of a Markdown table."""
    lines = []
    render = ROOT / "doc/PowerRTF/fig/render.py"
    for number, (source, model, caption) in enumerate(table.pictures, 1):
        files = []
        for kind, mesh, options in (("cells", "cells.vtp", ["--color-by", "sides"]),
                                    ("mesh", "mesh.off", [])):
            kept = source / f"{kind}.png"
            if not kept.exists():
                result = subprocess.run([python, render, source / mesh, kept, "--edges",
                                         "--height", "360", "--edge-width", "0.6", "--palette", "96",
                                         *options, *VIEWS.get(model, [])],
                                        capture_output=True, text=True, check=False)
                if result.returncode != 0:
                    notice(f"No picture of {caption}: {result.stderr.strip().splitlines()[-1:]}")
                    return lines
            files.append(f"{table.name}_{number}_{kind}.png")
            shutil.copyfile(kept, folder / files[-1])
        lines.append(f"| {caption} | " + " | ".join(f"![]({file})" for file in files) + " |")
    return lines


def write(tables, options, python, footer):
    """results.md, the CSV files, plots and renderings."""
    folder = options.results
    plots = {table.name: table.data for table in tables}
    data = options.output / "data.json"
    data.write_text(json.dumps(plots), encoding="utf-8")
    drawn = False
    if python:
        drawn = subprocess.run([python, pathlib.Path(__file__).with_name("plots.py"),
                                data, folder], check=False).returncode == 0
    text = ["# PowerRTF: the paper's tables and figures, and other remeshers\n", footer + "\n",
            "`paper:` rows are the paper's printed numbers (its T on a GeForce RTX 2080 Ti). Q, θ "
            "and shares as in the paper's Table 1; d<sub>H</sub>: RMS distance, two-sided, in % of "
            "the diagonal; T: CPU time of the whole program with one thread.\n"]
    for table in tables:
        write_csv(folder / f"{table.name}.csv", table.columns, table.rows)
        text += [f"## {table.title}\n", table.text + "\n",
                 markdown(table.columns, table.rows, 4)]
        for name, file in (("figures_10_11", "figure_11.png"), ("peers", "peers.png"),
                           ("peers", "peers_time.png")):
            if drawn and table.name == name and (folder / file).exists():
                text.append(f"![]({file})\n")
        if python and options.render:
            lines = draw(python, table, folder)
            if lines:
                text += ["| run | cells | mesh |\n| --- | --- | --- |\n" + "\n".join(lines) + "\n"]
    (folder / "results.md").write_text("\n".join(text), encoding="utf-8")


def results_in_short(tables, footer):
    """The README's block: some of the uniform runs of some tools; None without the table `peers`."""
    for table in tables:
        if table.name == "peers" and table.rows:
            column = {name: table.columns.index(name) for name in (*PEERS_IN_SHORT, "density")}
            rows = [[row[column[name]].replace(", preset quality", "") for name in PEERS_IN_SHORT]
                    for row in table.rows
                    if row[column["model"]] in MODELS_IN_SHORT
                    and row[column["density"]] == "uniform"
                    and row[column["tool"]].startswith(TOOLS_IN_SHORT)]
            return markdown(PEERS_IN_SHORT.values(), rows, 2) + "\n" + footer + "\n"
    return None


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--models", type=pathlib.Path, action="append", default=[],
                        metavar="FOLDER", help="of meshes, named like the paper's models")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "output/quality",
                        metavar="FOLDER", help="default: output/quality (with --quick: -quick)")
    parser.add_argument("--results", type=pathlib.Path, metavar="FOLDER",
                        help="of tables and pictures (default: the output's)")
    parser.add_argument("--traits", choices=("cpu", "exact", "cuda"), default="cpu")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), metavar="N",
                        help="runs at a time, of one thread each (default: one per core)")
    parser.add_argument("--only", nargs="+", metavar="NAME",
                        help="table_1, figures_7_8, figure_9, ..., peers")
    parser.add_argument("--no-peers", dest="peers", action="store_false")
    parser.add_argument("--no-render", dest="render", action="store_false", help="no renderings")
    parser.add_argument("--no-network", dest="network", action="store_false",
                        help="nothing is fetched from PyPI: no plots, no Python peers")
    parser.add_argument("--binaries", type=pathlib.Path,
                        help="folder of built programs; default: build them")
    parser.add_argument("--update", type=pathlib.Path, metavar="FILE",
                        help="replace the block `results` of this file")
    options = parser.parse_args()
    if options.quick and options.output == parser.get_default("output"):
        options.output = ROOT / "output/quality-quick"
    options.output = options.output.resolve()
    options.results = (options.results or options.output).resolve()
    return options


def main():
    options = parse()
    options.output.mkdir(parents=True, exist_ok=True)
    options.results.mkdir(parents=True, exist_ok=True)
    if not options.binaries:
        build(TARGETS)
        options.binaries = BUILD / "bin"
    python, missing = None, []
    if options.network:
        packages = ["matplotlib", "pyvista"]
        packages += [*(peer[0] for peer in other.PYTHON_PEERS), "geogram"] if options.peers else []
        python, missing = python_environment(options.output / "environment", packages)
    data = os.environ.get("POWER_RTF_DATA", DATA)
    parts = options.output / "parts"
    parts.mkdir(exist_ok=True)
    subprocess.run([options.binaries / "shape_models", "cad", parts], check=True)
    models = Models([*options.models, data, parts], options.output / "models")
    runner = Runner(options.output / "runs", options.binaries / "power_rtf_remesh",
                    options.binaries / "judge", options.traits, options.jobs,
                    120 if options.quick else 900)
    reproduction = figures.Reproduction(runner, models, "quick" if options.quick else "full")

    tables = []
    for name, make in reproduction.all():
        if options.only is None or name in options.only:
            tables.append(make())
    if options.peers and (options.only is None or "peers" in options.only):
        found = other.find(options.binaries, python, missing)
        tables.append(compare_peers(reproduction, runner, found, options.quick))

    tables = [table.resolve() for table in tables]

    words = [word for word, given in (("--quick", options.quick),
                                      ("--models FOLDER", options.models),
                                      (f"--traits {options.traits}", options.traits != "cpu"),
                                      ("--no-peers", not options.peers),
                                      ("--no-network", not options.network)) if given]
    footer = made_by(__file__, words)
    can_draw = python if "matplotlib" not in missing else None
    write(tables, options, can_draw, footer)
    short = results_in_short(tables, footer)
    if options.update and short:
        update_block(options.update, "results", short)
    missed = [f"{run['model']}, {run['density']}: {run['missed']}" for table in tables
              for run in table.data if run.get("missed") and "quality" in run.get("method", "")]
    for text in missed:
        notice(f"A guarantee is missed: {text}")
    notice(f"{runner.done} runs, {runner.kept} kept from earlier; see {options.results}/results.md")
    return 1 if reproduction.failed or missed else 0


if __name__ == "__main__":
    sys.exit(main())
