#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots samples per second over n, a panel for each stage; needs matplotlib.

plot_stages.py SERIES.json PICTURE

SERIES.json: the series, [[stage, traits, threads, samples, density], [[n, seconds, per second,
bytes], ...]], and the stages in the order of their panels.
"""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def draw(axis, stage, series, styles):
    """The series of one stage; a label has the same style in every panel."""
    for key, points in series:
        if key[0] != stage or len(points) < 2:
            continue
        label = f"{key[1]}, {key[2]} thread(s), {key[3]}, {key[4]}"
        style = styles.setdefault(label, {"color": plt.get_cmap("tab20")(len(styles) % 20),
                                          "marker": "os^vDP"[len(styles) % 6]})
        axis.loglog([p[0] for p in points], [p[2] for p in points], label=label, markersize=4,
                    linewidth=1, **style)
    axis.set_title(stage.replace("_", " "), fontsize=10)
    axis.set_xlabel("n", fontsize=8)
    axis.set_ylabel("samples per second", fontsize=8)
    axis.grid(alpha=0.3)


def main():
    source, target = sys.argv[1:]
    series, order = json.loads(pathlib.Path(source).read_text(encoding="utf-8"))
    stages = [s for s in order if any(key[0] == s for key, _ in series)]
    rows = (len(stages) + 3) // 4
    figure, axes = plt.subplots(rows, 4, figsize=(14, 3.1 * rows), layout="constrained",
                                squeeze=False)
    for axis in axes.flat[len(stages):]:
        axis.axis("off")
    styles = {}
    for axis, stage in zip(axes.flat, stages):
        draw(axis, stage, series, styles)
    handles = {}
    for axis in axes.flat:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            handles[label] = handle
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=4, fontsize=7)
    figure.savefig(target, dpi=100)


if __name__ == "__main__":
    main()
