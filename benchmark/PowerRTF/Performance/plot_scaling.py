#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots the seconds of each stage over threads and over n; needs matplotlib.

plot_scaling.py SCALING.csv PICTURE
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from scaling import COLUMNS, STAGES, over_n, over_threads, read  # noqa: E402


def draw(axis, rows, column, label):
    x = [row[column] for row in rows]
    for stage in (*STAGES, "total"):
        y = [row[COLUMNS.index(stage)] for row in rows]
        axis.loglog(x, y, label=stage, marker="o", markersize=4,
                    color="black" if stage == "total" else None)
    total = rows[0][COLUMNS.index("total")]
    ideal = [total * (value / x[0]) ** (-1 if label == "threads" else 1) for value in x]
    axis.loglog(x, ideal, linestyle=":", color="gray", label="linear")
    axis.set_xlabel(label)
    axis.set_ylabel("seconds")
    axis.grid(alpha=0.3)


def main():
    source, target = sys.argv[1:]
    rows = read(source)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    threads, sizes = over_threads(rows), over_n(rows)
    draw(left, threads, COLUMNS.index("threads"), "threads")
    left.set_title(f"n = {threads[0][1]}", fontsize=10)
    draw(right, sizes, COLUMNS.index("n"), "n")
    right.set_title(f"{sizes[0][0]} threads", fontsize=10)
    right.legend(fontsize=8)
    figure.savefig(target, dpi=100)


if __name__ == "__main__":
    main()
