#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which reading of the paper's Algorithms 2 and 3 gives the paper's numbers.

readings.py --models FOLDER [--seeds 0 1 2 3 4] [--jobs N]

Where the paper leaves something open there are several readings. Each is run alone, everything else
as in the base, and then some of them together, over several seeds, beside the rows of Tables 1
and 2 whose models can be had. FOLDER needs Kitten, Homer and Rocker; what is missing is skipped.
Result: readings.md. Runs are kept in the output's folder and not repeated, as by reproduce.py.
"""

import argparse
import os
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import BUILD, ROOT, build, made_by, markdown, notice  # noqa: E402
import paper  # noqa: E402
from models import Models  # noqa: E402
from runs import Failed, Runner  # noqa: E402

SAMPLES = 3000
# What is varied, and the reading that the others are compared with.
BASE = {"preset": "paper", "weights-end": "rest", "max-weight-iterations": 30,
        "weight-operator": "ceiling", "weight-step": 1, "relaxation-iterations": 10,
        "iterations": 100, "sampling": "elimination", "normal-angle": 60, "guard-factor": 1.5,
        "attributes": "nearest-vertices", "gradation": 0.2, "centroid-density-power": 0}

UNIFORM, ADAPTIVE = "uniform", "curvature"
# Readings of one thing each: (factor, [(reading, options)], the densities that it matters for)
FACTORS = [
    ("base", [("as above", {})], (UNIFORM, ADAPTIVE)),
    ("end of the loop", [
        ("inside γ before the samples move, not after", {"weights-end": "inside"}),
        ("30 iterations", {"iterations": 30}),
        ("400 iterations", {"iterations": 400})], (UNIFORM, ADAPTIVE)),
    ("weight steps per position step", [
        (f"at most {steps}", {"max-weight-iterations": steps}) for steps in (1, 2, 3, 5, 10)],
     (UNIFORM, ADAPTIVE)),
    ("α", [("rounded down, as printed", {"weight-operator": "floor"})], (UNIFORM, ADAPTIVE)),
    ("Δs", [("0.05 γ D<sub>i</sub>", {"weight-step": 0.2}),
            ("0.125 γ D<sub>i</sub>", {"weight-step": 0.5}),
            ("0.20 γ D<sub>i</sub>", {"weight-step": 0.8}),
            ("0.50 γ D<sub>i</sub>", {"weight-step": 2})], (UNIFORM, ADAPTIVE)),
    ("relaxation", [(f"{steps} steps", {"relaxation-iterations": steps}) for steps in (0, 50)],
     (UNIFORM, ADAPTIVE)),
    ("initial samples", [("random, as printed", {"sampling": "random"}),
                         ("stratified", {"sampling": "stratified"}),
                         ("lattice", {"sampling": "lattice"})], (UNIFORM, ADAPTIVE)),
    ("Θ", [(f"{angle}°", {"normal-angle": angle}) for angle in (80, 100, 140, 180)],
     (UNIFORM, ADAPTIVE)),
    ("guard", [("3 distances to the 6th neighbor", {"guard-factor": 3})], (UNIFORM, ADAPTIVE)),
    ("k", [("16", {"neighbors": 16})], (UNIFORM, ADAPTIVE)),
    ("normals and densities", [
        ("interpolated over the facet", {"attributes": "facet"}),
        ("normals of the 3 nearest vertices", {"normal-neighbors": 3})], (UNIFORM, ADAPTIVE)),
    ("density", [("of the nearest vertex", {"density-neighbors": 1}),
                 ("smoothed over 3 spacings", {"density-smoothing": 3}),
                 ("gradation 0.1", {"gradation": 0.1}),
                 ("no gradation, as printed", {"gradation": 0})], (ADAPTIVE,)),
    ("centroids", [("weighted by ρ", {"centroid-density-power": 1}),
                   ("weighted by ρ²", {"centroid-density-power": 2})], (ADAPTIVE,)),
    ("projection", [("nearest facet of all", {"projection": "nearest-facet"})],
     (UNIFORM, ADAPTIVE)),
    ("extraction", [("restricted Delaunay", {"extraction": "restricted-delaunay"})],
     (UNIFORM, ADAPTIVE)),
]
WIDE, INSIDE = {"normal-angle": 100}, {"weights-end": "inside"}
LATTICE, FEW = {"sampling": "lattice"}, {"max-weight-iterations": 3}
FACET, SMOOTH = {"attributes": "facet"}, {"density-smoothing": 3, "gradation": 0.1}
RHO = {"centroid-density-power": 1}
# Of the above: (what, options, densities)
COMBINED = [
    ("Θ = 100°, until inside γ", {**WIDE, **INSIDE}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, until inside γ, lattice", {**WIDE, **INSIDE, **LATTICE}, (UNIFORM, ADAPTIVE)),
    ("Θ = 180°, until inside γ, lattice", {**INSIDE, **LATTICE, "normal-angle": 180},
     (UNIFORM, ADAPTIVE)),
    ("until inside γ, lattice", {**INSIDE, **LATTICE}, (UNIFORM, ADAPTIVE)),
    *((f"Θ = 100°, until inside γ, lattice, {steps} relaxation steps",
       {**WIDE, **INSIDE, **LATTICE, "relaxation-iterations": steps}, (UNIFORM, ADAPTIVE))
      for steps in (30, 50, 100)),
    *((f"Θ = 100°, until inside γ, {steps} relaxation steps",
       {**WIDE, **INSIDE, "relaxation-iterations": steps}, (UNIFORM, ADAPTIVE))
      for steps in (50, 100, 200)),
    *((f"Θ = 100°, until inside γ, 100 relaxation steps, guard 3, N_m = {steps}",
       {**WIDE, **INSIDE, "relaxation-iterations": 100, "guard-factor": 3, "iterations": steps},
       (UNIFORM, ADAPTIVE)) for steps in (100, 200)),
    ("until inside γ, facets", {**INSIDE, **FACET}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, until inside γ, facets", {**WIDE, **INSIDE, **FACET}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, until inside γ, lattice, facets", {**WIDE, **INSIDE, **LATTICE, **FACET},
     (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, until inside γ, 3 weight steps", {**WIDE, **INSIDE, **FEW}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, until inside γ, random", {**WIDE, **INSIDE, "sampling": "random"},
     (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, until inside γ, 0.125 γ D<sub>i</sub>", {**WIDE, **INSIDE, "weight-step": 0.5},
     (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, 3 weight steps", {**WIDE, **FEW}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, 3 weight steps, lattice", {**WIDE, **FEW, **LATTICE}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, lattice", {**WIDE, **LATTICE}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, facets", {**WIDE, **FACET}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, guard 3", {**WIDE, "guard-factor": 3}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, nearest facet of all", {**WIDE, "projection": "nearest-facet"},
     (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, facets, nearest facet of all",
     {**WIDE, **FACET, "projection": "nearest-facet"}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, α rounded down", {**WIDE, "weight-operator": "floor"}, (UNIFORM, ADAPTIVE)),
    ("Θ = 100°, until inside γ, smooth density", {**WIDE, **INSIDE, **SMOOTH}, (ADAPTIVE,)),
    ("Θ = 100°, until inside γ, lattice, smooth density",
     {**WIDE, **INSIDE, **LATTICE, **SMOOTH}, (ADAPTIVE,)),
    ("Θ = 100°, until inside γ, no gradation", {**WIDE, **INSIDE, "gradation": 0}, (ADAPTIVE,)),
    ("Θ = 100°, until inside γ, centroids by ρ", {**WIDE, **INSIDE, **RHO}, (ADAPTIVE,)),
    ("Θ = 100°, smooth density", {**WIDE, **SMOOTH}, (ADAPTIVE,)),
]
NO_WEIGHTS = {"weight-method": "none"}
NO_OPTIMIZATION = {**NO_WEIGHTS, "relaxation-iterations": 0, "iterations": 0}
# The methods that the paper compares with, as far as options give them; RVC and D-RVC do not.
METHODS = [
    ("MPS (Poisson-disk samples, by elimination)", NO_OPTIMIZATION, (UNIFORM,)),
    ("random samples", {**NO_OPTIMIZATION, "sampling": "random"}, (UNIFORM,)),
    ("RTF (no weights)", NO_WEIGHTS, (UNIFORM, ADAPTIVE)),
    ("RTF, random samples", {**NO_WEIGHTS, "sampling": "random"}, (UNIFORM, ADAPTIVE)),
    ("RTF without NVISPC", {**NO_WEIGHTS, "normal-angle": 180}, (UNIFORM, ADAPTIVE)),
]
COLUMNS = ("what", "reading", "Q<sub>min</sub>", "Q<sub>avg</sub>", "θ<sub>min</sub>", "> 90°",
           "all inside γ", "inside γ", "iterations", "constructions", "T (s)", "misses by")
FIGURES = {"q_min": 0.03, "q_avg": 0.03, "theta_min": 2}  # within which they are the paper's


class Case:
    """A row of the paper's tables. `others`: rows of other methods, (name, numbers)."""

    def __init__(self, model, density, printed, others):
        self.model, self.density, self.printed, self.others = model, density, printed, others


def cases():
    for density in (UNIFORM, ADAPTIVE):
        rows = paper.table_1("Kitten", density)
        yield Case("Kitten", density, dict(rows)["PowerRTF"],
                   [row for row in rows if row[0] != "PowerRTF"])
    for model in ("Homer", "Rocker"):
        rows = {what: values for _, what, _, values in paper.table_2("14", model)}
        yield Case(model, ADAPTIVE, rows["with weights"],
                   [("RTF (without weights)", rows["without weights"])])


def miss(printed, values):
    """How far the worst of the figures stays below the paper's, in units of what is allowed."""
    parts = [0]
    for key, allowed in FIGURES.items():
        if printed[key] is not None:
            scale = printed[key] if key.startswith("q_") else 1
            parts.append((printed[key] - values[key]) / (allowed * scale))
    return max(parts)


def start(runner, models, case, options, seeds):
    words = [word for key, value in {**BASE, **options}.items()
             for word in (f"--{key}", str(value))]
    return [runner.later(runner.power_rtf, case.model, models.get(case.model), SAMPLES, *words,
                         "--density", case.density, "--seed", str(seed)) for seed in seeds]


def means(futures):
    """Of the runs; None when one has failed."""
    try:
        runs = [future.result()[0] for future in futures]
    except Failed as error:
        notice(f"  failed: {error}")
        return None
    keys = (*FIGURES, "above_90", "inside", "iterations", "constructions", "cpu")
    values = {key: statistics.mean(run[key] for run in runs) for key in keys}
    values["all_inside"] = statistics.mean(run["inside"] == 1 for run in runs)
    return values


def printed_row(what, values):
    def text(key, form):
        return "?" if values[key] is None else format(values[key], form)

    seconds = values.get("seconds")
    return ["paper", what, text("q_min", ".3f"), text("q_avg", ".3f"), text("theta_min", ".1f"),
            text("above_90", ".3f"), *[""] * 4, "" if seconds is None else f"{seconds:.2f}", ""]


def row(what, reading, values, shortfall):
    if values is None:
        return [what, reading, *[""] * (len(COLUMNS) - 3), "failed"]
    return [what, reading, f"{values['q_min']:.3f}", f"{values['q_avg']:.3f}",
            f"{values['theta_min']:.1f}", f"{values['above_90']:.3f}",
            f"{100 * values['all_inside']:.0f} %", f"{100 * values['inside']:.1f} %",
            f"{values['iterations']:.0f}", f"{values['constructions']:.0f}",
            f"{values['cpu']:.1f}", shortfall]


def wanted():
    """All readings: (what, reading, options, densities, whether it is a reading of PowerRTF)."""
    for what, readings, densities in FACTORS:
        for reading, options in readings:
            yield what, reading, options, densities, True
    for reading, options, densities in COMBINED:
        yield "combined", reading, options, densities, True
    for reading, options, densities in METHODS:
        yield "other method", reading, options, densities, False


def study(runner, models, seeds, only):
    """A table for each case, and {reading: {case: miss}}."""
    found = [case for case in cases() if models.get(case.model)]
    readings = [reading for reading in wanted() if only is None or reading[0] in only]
    started = [(case, [(reading, start(runner, models, case, reading[2], seeds))
                       for reading in readings if case.density in reading[3]]) for case in found]
    tables, misses = [], {}
    for case, runs in started:
        title = f"{case.model}, {case.density}"
        rows = [printed_row("PowerRTF", case.printed)]
        rows += [printed_row(name, values) for name, values in case.others]
        for (what, reading, _, _, is_reading), futures in runs:
            values, shortfall = means(futures), ""
            if values and is_reading:
                size = miss(case.printed, values)
                misses.setdefault((what, reading), {})[title] = size
                shortfall = f"{size:.1f}"
            rows.append(row(what, reading, values, shortfall))
        tables.append((title, rows))
    return tables, misses


def summary(titles, misses):
    """The readings by their worst case, and in each; only those of all cases."""
    complete = [(max(of.values()), key, of) for key, of in misses.items()
                if len(of) == len(titles)]
    return [[*key, *(f"{of[title]:.1f}" for title in titles), f"{worst:.1f}"]
            for worst, key, of in sorted(complete, key=lambda entry: entry[0])]


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=pathlib.Path, action="append", default=[],
                        metavar="FOLDER", help="of meshes, named like the paper's models")
    parser.add_argument("--seeds", nargs="+", type=int, default=[0, 1, 2, 3, 4], metavar="N")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), metavar="N",
                        help="runs at a time, of one thread each (default: one per core)")
    parser.add_argument("--only", nargs="+", metavar="WHAT",
                        help="readings of these alone: base, α, combined, ...")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "output/readings",
                        metavar="FOLDER", help="of the runs that are kept")
    parser.add_argument("--results", type=pathlib.Path, metavar="FOLDER",
                        help="of readings.md (default: the output's)")
    parser.add_argument("--program", type=pathlib.Path, help="power_rtf_remesh; default: build it")
    parser.add_argument("--judge", type=pathlib.Path, help="default: beside the program")
    return parser.parse_args()


def main():
    options = parse()
    if not options.program:
        build(("power_rtf_remesh", "judge"))
        options.program = BUILD / "bin/power_rtf_remesh"
    judge = options.judge or options.program.with_name("judge")
    results = options.results or options.output
    results.mkdir(parents=True, exist_ok=True)
    models = Models(options.models, options.output / "models")
    runner = Runner(options.output / "runs", options.program.resolve(), judge.resolve(), "cpu",
                    options.jobs, 300)
    tables, misses = study(runner, models, options.seeds, options.only)

    titles = [title for title, _ in tables]
    words = ["--models FOLDER", "--seeds", *map(str, options.seeds)]
    if options.only:
        words += ["--only", *options.only]
    text = ["# Readings of the paper's algorithms\n", made_by(__file__, words) + "\n",
            f"n = {SAMPLES}; means over {len(options.seeds)} random seeds. `paper` rows: the "
            "printed numbers (T: on a GeForce RTX 2080 Ti); ? where they are not legible. Each "
            "reading differs from the base in what it names: "
            f"`{' '.join(f'{key} {value}' for key, value in BASE.items())}`. "
            "misses by: how far the worst of Q<sub>min</sub>, Q<sub>avg</sub> and θ<sub>min</sub> "
            "stays below the printed one, in units of 3 % and 2°: up to 1.0 is within. all inside "
            "γ: share of the runs that end so; inside γ: share of the cells. T: CPU time of the "
            "program with one thread. RVC and D-RVC are quoted only.\n",
            "## How far each reading misses\n",
            markdown(("what", "reading", *titles, "worst"), summary(titles, misses), 2)]
    for title, rows in tables:
        text += [f"## {title}\n", markdown(COLUMNS, rows, 2)]
    (results / "readings.md").write_text("\n".join(text), encoding="utf-8")
    notice(f"{runner.done} runs, {runner.kept} kept from earlier; see {results}/readings.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
