# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots of what reproduce.py has measured; needs matplotlib.

plots.py DATA.json FOLDER
"""

import json
import pathlib
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def figure_11(runs, path):
    """The four plots of the paper's Figure 11: Q_min, theta_min, iterations and time over gamma."""
    panels = (("q_min", "$Q_{min}$"), ("theta_min", "$\\theta_{min}$ (degrees)"),
              ("constructions", "constructions"), ("cpu", "CPU time (s)"))
    figure, axes = plt.subplots(2, 2, figsize=(7.5, 5.2), layout="constrained")
    for axis, (key, label) in zip(axes.flat, panels):
        for n, marker in zip(sorted({run["n"] for run in runs}), "osD^"):
            points = sorted((100 * run["gamma"], run[key]) for run in runs if run["n"] == n)
            axis.plot(*zip(*points), marker=marker, label=f"n = {n}")
        axis.set_xlabel("γ (%)")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[0, 0].legend()
    figure.savefig(path, dpi=110)


def figure_peers(runs, path):
    """Quality of the worst triangle, all triangles, distance and CPU time, a group per model."""
    panels = (("q_min", "$Q_{min}$", False), ("q_avg", "$Q_{avg}$", False),
              ("distance_rms", "$d_H$ (% of the diagonal)", False), ("cpu", "CPU time (s)", True))
    cases = sorted({(run["model"], run["density"]) for run in runs})
    methods = list(dict.fromkeys(run["method"] for run in runs))
    colors = plt.get_cmap("tab10")
    figure, axes = plt.subplots(2, 2, figsize=(14, 7), layout="constrained")
    for axis, (key, label, logarithmic) in zip(axes.flat, panels):
        for m, method in enumerate(methods):
            values = {(run["model"], run["density"]): run[key] for run in runs
                      if run["method"] == method}
            places = [c + (m - len(methods) / 2) * 0.8 / len(methods)
                      for c, case in enumerate(cases) if case in values]
            axis.bar(places, [values[case] for case in cases if case in values],
                     0.8 / len(methods), align="edge", color=colors(m % 10), label=method)
        axis.set_ylabel(label)
        axis.set_yscale("log" if logarithmic else "linear")
        axis.set_xticks(range(len(cases)), [f"{model}\n{density}" for model, density in cases],
                        fontsize=8)
        axis.grid(axis="y", alpha=0.3)
        if key == "q_avg":
            axis.set_ylim(0.7, 1)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center",
                  ncols=min(len(methods), 5), fontsize=8)
    figure.savefig(path, dpi=110)


def figure_time(runs, path):
    """Quality over CPU time: a point per run, and larger ones in the middle of each method's."""
    panels = (("q_min", "$Q_{min}$"), ("q_avg", "$Q_{avg}$"),
              ("theta_min", "$\\theta_{min}$ (degrees)"))
    methods = list(dict.fromkeys(run["method"] for run in runs))
    colors = plt.get_cmap("tab10")
    figure, axes = plt.subplots(1, 3, figsize=(14, 4.5), layout="constrained")
    for axis, (key, label) in zip(axes, panels):
        for m, method in enumerate(methods):
            points = [(run["cpu"], run[key]) for run in runs if run["method"] == method]
            axis.scatter(*zip(*points), s=12, color=colors(m % 10), alpha=0.4)
            axis.scatter(*map(statistics.median, zip(*points)), s=70, color=colors(m % 10),
                         marker="os^"[m // 10], edgecolors="black", label=method)
        axis.set_xlabel("CPU time (s)")
        axis.set_ylabel(label)
        axis.set_xscale("log")
        axis.grid(alpha=0.3)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center",
                  ncols=min(len(methods), 5), fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    data = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    folder = pathlib.Path(sys.argv[2])
    if data.get("figures_10_11"):
        figure_11(data["figures_10_11"], folder / "figure_11.png")
    if data.get("peers"):
        figure_peers(data["peers"], folder / "peers.png")
        figure_time(data["peers"], folder / "peers_time.png")


if __name__ == "__main__":
    main()
