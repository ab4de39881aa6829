# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The summary as a picture."""


def plot_summary(table, file):
    """Draws how many meshes have which status, and the distributions of the least and the mean quality, the
    least angle, the largest distance and the time. Needs matplotlib.

    :param table: what :func:`remesh_dataset` returns
    :param file: the picture, as "summary.png" or "summary.svg"
    """
    from matplotlib.figure import Figure
    figure = Figure(figsize=(12, 7), layout="constrained")
    axes = figure.subplots(2, 3).flat
    counts = table["status"].value_counts().to_pylist()
    bars = axes[0].barh([count["values"] for count in counts], [count["counts"] for count in counts])
    axes[0].bar_label(bars)
    axes[0].set_xlabel("meshes")
    for axis, (name, label) in zip(axes[1:], (
            ("q_min", "least quality"), ("q_avg", "mean quality"), ("theta_min", "least angle, degrees"),
            ("distance_max", "largest distance, % of the diagonal"), ("seconds", "seconds a mesh"))):
        axis.hist(table[name].drop_null().to_numpy(), bins=50)
        axis.set_xlabel(label)
    figure.savefig(file)
