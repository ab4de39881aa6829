# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's tables and figures, each as a table of the paper's numbers and ours."""

import paper
from common import notice
from runs import Failed

MEASURES = ("Q<sub>min</sub>", "Q<sub>avg</sub>", "θ<sub>min</sub>", "mean θ<sub>min</sub>",
            "θ<sub>max</sub>", "< 30°", "> 90°", "d<sub>H</sub>")
COLUMNS = ("model", "density", "n", "method", *MEASURES, "T (s)", "inside γ", "constructions",
           "topology", "what differs, and why")
SIZES = {"full": {"n": 3000, "elk": 6000, "large": 30000, "large_adaptive": 10000,
                  "figure_11": paper.FIGURE_11_SAMPLES, "tolerances": paper.FIGURE_11_TOLERANCES},
         "quick": {"n": 1000, "elk": 2000, "large": 5000, "large_adaptive": 3000,
                   "figure_11": (1000,), "tolerances": (0.04, 0.10)}}
PAPER = ("--preset", "paper")
QUALITY = ("--preset", "quality")
FLOOR = (*PAPER, "--weight-operator", "floor")
SHORT = ("--iterations", "30")  # N_m where the paper prints no numbers: 200 take minutes
NO_WEIGHTS = (*PAPER, "--weight-method", "none", "--relaxation-iterations", "0")
NO_OPTIMIZATION = (*NO_WEIGHTS, "--iterations", "0")
NO_NVISPC = (*PAPER, "--normal-angle", "180")
DELAUNAY = ("--extraction", "restricted-delaunay")

WHY = {
    FLOOR: "α rounded down, as the paper prints it: cells park outside γ, so the run goes on to N_m "
           "and Lloyd's method makes the triangles better meanwhile",
    NO_WEIGHTS: "Lloyd's method alone for N_m iterations, from a better start (sample elimination)",
    NO_OPTIMIZATION: "samples by elimination (Poisson disks) and no optimization; the paper's MPS "
                     "is another program",
    QUALITY: "L-BFGS, Newton's method for the weights, improved triangles nearer to the surface",
}


def why(options, r, samples):
    """What differs between a run of ours and the paper's, and why."""
    if options[:2] == QUALITY:
        return WHY[QUALITY]
    parts = [WHY[options]] if options in WHY else []
    if options[:2] == PAPER and options not in WHY:
        angle = "" if "--normal-angle" in options else "Θ = 100° for 60°, "
        parts.append(f"{angle}100 iterations without weights for ten, α rounded up (see readings.md)")
        if r["inside"] < 1:
            parts.append("not all cells come inside γ, so all N_m iterations are made")
        if DELAUNAY[1] in options:
            parts.append("extracted the paper's way; dual edges reach the other sheet of a thin "
                         "part")
        elif NO_NVISPC[-2:] == options[2:4]:
            parts.append("extraction by insertion keeps the topology even so")
    if samples > r["input_vertices"] / 4:
        parts.append(f"the input has only {r['input_vertices']} vertices, and means over the 12 "
                     "nearest of them are a coarse normal")
    return "; ".join(parts)


def topology(r):
    """What is wrong with the mesh's topology, or "kept"."""
    wrong = [f"χ {r['euler']} for {r['input_euler']}" if r["euler"] != r["input_euler"] else "",
             f"{r['components']} components for {r['input_components']}"
             if r["components"] != r["input_components"] else "",
             f"{r['border_loops']} borders for {r['input_border_loops']}"
             if r["border_loops"] != r["input_border_loops"] else "",
             f"{r['non_manifold_edges']} non-manifold edges" if r["non_manifold_edges"] else "",
             f"{r['non_manifold_vertices']} non-manifold vertices"
             if r["non_manifold_vertices"] else "",
             "not oriented" if not r["oriented"] else "",
             f"{r['self_intersections']} self-intersections" if r["self_intersections"] else ""]
    return "; ".join(text for text in wrong if text) or "kept"


def cells(values):
    """The columns MEASURES, as the paper prints them; shares as shares, d_H in % of the diagonal.
    ?: not legible; nothing: not printed."""
    formats = (("q_min", ".3f"), ("q_avg", ".3f"), ("theta_min", ".2f"), ("theta_min_avg", ".2f"),
               ("theta_max", ".2f"), ("below_30", ".3f"), ("above_90", ".3f"),
               ("distance_rms", ".3f"))
    return ["" if key not in values else "?" if values[key] is None else format(values[key], form)
            for key, form in formats]


def edge_lengths(r):
    """Mean, least and largest."""
    return f"{r['edge_length_mean']:.3g} ({r['edge_length_min']:.2g} to {r['edge_length_max']:.2g})"


class Table:
    """`name`: of its files; `rows` are lists of texts; `pictures`: meshes and cells to draw."""

    def __init__(self, name, title, text, columns=COLUMNS):
        self.name, self.title, self.text, self.columns = name, title, text, columns
        self.rows, self.pictures, self.data = [], [], []

    def add_paper(self, model, density, n, method, values, differs="as printed"):
        seconds = values.get("seconds")
        self.rows.append([model, density, n, f"paper: {method}", *cells(values),
                          "" if seconds is None else f"{seconds:.2f}", "", "", "", differs])

    def resolve(self):
        """Waits for the runs: rows that are functions become what they return."""
        self.rows = [row() if callable(row) else row for row in self.rows]
        return self


class Reproduction:
    """Makes the tables; their runs go on after that (`Table.resolve()`). `size`: "full" or
    "quick"."""

    def __init__(self, runner, models, size):
        self.runner, self.models, self.size = runner, models, SIZES[size]
        self.quick, self.failed = size == "quick", 0

    def run(self, table, model, density, n, method, options, picture=False, differs=None,
            **more):
        """One run, and its row; a failure is a row, too. `more`: for the plots."""
        asked = options
        if self.quick and options[:2] == PAPER and "--iterations" not in options:
            options = (*options, *SHORT)
        future = self.runner.later(self.runner.power_rtf, model, self.models.get(model), n,
                                   "--density", density, *options)

        def row():
            try:
                r, folder = future.result()
            except Failed as error:
                notice(f"  {model}: {error}")
                self.failed += 1
                return [model, density, n, method, *[""] * (len(MEASURES) + 3), "failed",
                        str(error)]
            table.data.append({"model": model, "density": density, "n": n, "method": method,
                               **more, **r})
            if picture:
                table.pictures.append((folder, model, f"{model}, {density}, n = {n}, {method}"))
            return [model, density, n, method, *cells(r), f"{r['cpu']:.2f}",
                    f"{100 * r['inside']:.1f} %", r["constructions"], topology(r),
                    why(asked, r, n) if differs is None else differs]

        table.rows.append(row)

    def both_presets(self, table, model, density, n, picture=False, floor=False, short=False):
        paper_options, name = ((*PAPER, *SHORT), "preset paper, N_m = 30") if short else \
            (PAPER, "preset paper")
        self.run(table, model, density, n, name, paper_options, picture)
        if floor:
            self.run(table, model, density, n, "preset paper, α as printed", FLOOR)
        self.run(table, model, density, n, "preset quality", QUALITY, picture)

    def table_1(self):
        names = ("Kitten", "Armchair", "StandingCat")
        missing = [m for m in names if not self.models.get(m)]
        table = Table("table_1", "Table 1 and Figure 12: uniform and adaptive remeshing", (
            "The paper's rows and ours on the same model. d_H: the paper's fits an RMS distance, "
            "which ours is (two-sided, in % of the diagonal). MPS and RTF of the paper are other "
            "programs; ours are this one without optimization and without weights. RVC and D-RVC "
            "are quoted only." +
            (f" Not to be had here: {', '.join(missing)}." if missing else "")))
        n = self.size["n"]
        models = [m for m in names if self.models.get(m)]
        for model in models or [self.models.first("Retinal")]:
            for density in ("uniform", "curvature"):
                for method, values in paper.table_1(model, density):
                    table.add_paper(model, density, 3000, method, values)
                if density == "uniform":
                    self.run(table, model, density, n, "MPS (no optimization)", NO_OPTIMIZATION)
                    self.run(table, model, density, n, "RTF (no weights)", NO_WEIGHTS)
                self.both_presets(table, model, density, n, picture=True, floor=True)
        return table

    def figures_7_8(self):
        table = Table("figures_7_8", "Figures 7 and 8: uniform and adaptive remeshing of many models",
                      "The paper shows pictures of these without printing numbers in its text.")
        names = ("Three Holes", "Bunny", "Armadillo", "Dragon", "Eight", "Close Hemisphere",
                 "Retinal", "Elk", "Homer", "Rocker", "Fertility", "Kitten")
        for model in names[:1] if self.quick else names:
            if self.models.get(model):
                for density in ("uniform", "curvature"):
                    if model in names[:6]:
                        self.both_presets(table, model, density, self.size["n"],
                                          picture=model == names[0], short=True)
                    else:
                        self.run(table, model, density, self.size["n"], "preset quality", QUALITY)
        return table

    def figure_9(self):
        table = Table("figure_9", "Figure 9: densities f, f² and f³",
                      "Retinal; the paper shows pictures without numbers. The contrast grows with "
                      "the power: fewer and larger cells where the surface is flat.")
        model = self.models.first("Retinal")
        for power in (1, 2, 3):
            for options, method in ((PAPER, "preset paper"), (QUALITY, "preset quality")):
                self.run(table, model, "curvature", self.size["n"], f"{method}, f^{power}",
                         (*options, "--density-power", str(power)), options is PAPER)
        return table

    def figures_10_11(self):
        table = Table("figures_10_11", "Figures 10 and 11: γ and n",
                      paper.FIGURE_11_CLAIM + " `constructions` counts all weight passes.")
        model = self.models.first("Fertility", "Retinal")
        differs = "the copy of the model" if model == "Fertility" else "another model"
        for n in self.size["figure_11"]:
            for gamma in self.size["tolerances"]:
                options = (*PAPER, "--capacity-tolerance", str(gamma))
                self.run(table, model, "curvature", n, f"γ = {100 * gamma:.0f} %", options,
                         n == self.size["figure_11"][0] and gamma in (0.02, 0.10), differs,
                         gamma=gamma)
        return table

    def figure_13(self):
        table = Table("figure_13", "Figure 13: close sheets", (
            "Elk, adaptive. The paper prints no numbers; it says that D-RVC leaves outliers and "
            "wrong topology and that its own method does not."))
        model = "Elk" if self.models.get("Elk") else "Close Hemisphere"
        self.both_presets(table, model, "curvature", self.size["elk"], picture=True,
                          short=True)
        self.run(table, model, "curvature", self.size["elk"],
                 "preset paper, N_m = 30, restricted Delaunay", (*PAPER, *SHORT, *DELAUNAY))
        return table

    def figure_14(self):
        table = Table("figure_14", "Figure 14 and Table 2: with and without weights",
                      "Adaptive; all else the same. A ? is not legible in the copy of the paper.")
        for model in ("Homer", "Rocker"):
            if not self.models.get(model):
                notice(f"Figure 14: {model} is not to be had here")
                continue
            for _, what, n, values in paper.table_2("14", model):
                table.add_paper(model, "curvature", n, what, values)
            n = self.size["n"]
            self.run(table, model, "curvature", n, "without weights", NO_WEIGHTS, model == "Homer")
            self.run(table, model, "curvature", n, "with weights", PAPER, model == "Homer")
            self.run(table, model, "curvature", n, "preset quality", QUALITY)
        return table

    def figure_15(self):
        table = Table("figure_15", "Figure 15 and Table 2: with and without NVISPC", (
            "Uniform samples on a thin disc. The paper's Disc is not public: this one is made by "
            "the driver (radius 1, thickness 0.02, round rim), so only the differences between the "
            "rows compare; N_m = 30. Fish cannot be had; Close Hemisphere (Figure 6) is made here, too."))
        for _, what, n, values in paper.table_2("15", "Disc"):
            table.add_paper("Disc", "uniform", n, what, values, "another disc")
        n = self.size["n"]
        for model in ("Disc",) if self.quick else ("Disc", "Close Hemisphere"):
            for options, name in (((*NO_NVISPC, *SHORT), "without NVISPC"),
                                  ((*PAPER, *SHORT), "with NVISPC")):
                self.run(table, model, "uniform", n, name, options, model == "Disc")
                self.run(table, model, "uniform", n, f"{name}, restricted Delaunay",
                         (*options, *DELAUNAY), model == "Disc")
            self.run(table, model, "uniform", n, "preset quality", QUALITY)
        return table

    def figure_16(self):
        table = Table("figure_16", "Figure 16 and Table 2: many samples",
                      "David Head and Gargoyle are no public models: Bunny and Armadillo of CGAL's "
                      "in their place, so the models differ.")
        for model, what, n, values in paper.table_2("16"):
            table.add_paper(model, what, n, "PowerRTF", values, "another model")
        for model in ("Bunny",) if self.quick else ("Bunny", "Armadillo"):
            if self.models.get(model):
                for density, key in (("uniform", "large"), ("curvature", "large_adaptive")):
                    if model == "Bunny":
                        self.both_presets(table, model, density, self.size[key], True, short=True)
                    else:
                        self.run(table, model, density, self.size[key], "preset quality", QUALITY)
        return table

    def all(self):
        return [("table_1", self.table_1), ("figures_7_8", self.figures_7_8),
                ("figure_9", self.figure_9), ("figures_10_11", self.figures_10_11),
                ("figure_13", self.figure_13), ("figure_14", self.figure_14),
                ("figure_15", self.figure_15), ("figure_16", self.figure_16)]
