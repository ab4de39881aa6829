#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""How wrong the values of a smooth function are that have come over from a ball to its remeshing: at the new
vertices, over the length of the input's edges; and between them, linear on the new triangles, over the length
of these. Writes a table and a plot. Needs NumPy and matplotlib.

transfer_error.py PROGRAM FOLDER
"""

import pathlib
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

FINEST = 7  # subdivisions: 163842 vertices


def ball(subdivisions):
    """Vertices on the unit sphere and triangles: an icosahedron whose edges are halved again and again."""
    g = (1 + 5 ** 0.5) / 2
    points = np.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g],
                       [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]])
    faces = np.array([[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4],
                      [11, 10, 2], [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8],
                      [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]])
    for _ in range(subdivisions):
        edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        ends, middle = np.unique(edges, axis=0, return_inverse=True)
        a, b, c = faces.T
        ab, bc, ca = (len(points) + middle.reshape(-1, 3)).T
        points = np.concatenate([points, points[ends].mean(axis=1)])
        faces = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (b, bc, ab), (c, ca, bc),
                                                              (ab, bc, ca))])
    return points / np.linalg.norm(points, axis=1, keepdims=True), faces


def function(points):
    """Of the direction to a point."""
    x, y, z = (points / np.linalg.norm(points, axis=1, keepdims=True)).T
    return np.sin(5 * x) * np.cos(4 * y) + y * z


def write_ply(file, points, faces, values):
    rows = np.column_stack([points, values])
    file.write_text(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\n"
                    "property double y\nproperty double z\nproperty double value\n"
                    f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
                    + "".join("%.17g %.17g %.17g %.17g\n" % tuple(row) for row in rows)
                    + "".join("3 %d %d %d\n" % tuple(face) for face in faces), encoding="ascii")


def read_ply(file):
    head, body = file.read_text(encoding="ascii").split("end_header\n")
    count = int(head.split("element vertex ")[1].split()[0])
    lines = body.splitlines()
    rows = np.array([line.split() for line in lines[:count]], dtype=float)
    return rows[:, :3], np.array([line.split()[1:] for line in lines[count:]], dtype=int), rows[:, 3]


def edge_length(points, faces):
    return np.linalg.norm(points[faces] - points[np.roll(faces, 1, axis=1)], axis=2).mean()


def errors(program, folder, subdivisions, n):
    """The mean edge lengths of input and output, the largest errors at vertices and at the centers of faces."""
    points, faces = ball(subdivisions)
    write_ply(folder / "input.ply", points, faces, function(points))
    subprocess.run([program, folder / "input.ply", folder / "output.ply", "--samples", str(n), "--ascii",
                    "--quiet"], check=True)
    new_points, new_faces, values = read_ply(folder / "output.ply")
    centers = new_points[new_faces].mean(axis=1)
    return (edge_length(points, faces), edge_length(new_points, new_faces),
            np.abs(values - function(new_points)).max(),
            np.abs(values[new_faces].mean(axis=1) - function(centers)).max())


def main():
    program, target = sys.argv[1], pathlib.Path(sys.argv[2])
    text = ["# Values that have come over", "",
            "Largest error of a smooth function from -1.5 to 1.5 on the unit ball; lengths of edges are means.",
            "Made by `benchmark/PowerRTF/Quality/transfer_error.py PROGRAM FOLDER`."]
    figure, axis = plt.subplots(figsize=(5.2, 4.2), layout="constrained")
    with tempfile.TemporaryDirectory() as name:
        for label, runs, over, error in (
                ("at vertices, over the input's edges", [(s, 3000) for s in range(2, FINEST + 1)], 0, 2),
                ("at centers of faces, over the output's edges",
                 [(FINEST, n) for n in (200, 800, 3200, 12800, 51200)], 1, 3)):
            found = [errors(program, pathlib.Path(name), *run) for run in runs]
            h, e = [row[over] for row in found], [row[error] for row in found]
            order = np.polyfit(np.log(h), np.log(e), 1)[0]
            axis.loglog(h, e, "o-", label=f"{label}: order {order:.2f}")
            text += ["", f"Errors {label}: order {order:.2f}", "",
                     "| input: vertices | edges | output: vertices | edges | at vertices | at centers |",
                     "| ---: | ---: | ---: | ---: | ---: | ---: |"]
            text += [f"| {10 * 4 ** s + 2} | {row[0]:.4f} | {n} | {row[1]:.4f} | {row[2]:.2e} | {row[3]:.2e} |"
                     for (s, n), row in zip(runs, found)]
    h = np.array(axis.get_xlim())
    axis.loglog(h, 0.5 * h ** 2, "k--", linewidth=0.8, label="$h^2 / 2$")
    axis.set_xlabel("mean length of edges h")
    axis.set_ylabel("largest error")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    target.mkdir(parents=True, exist_ok=True)
    figure.savefig(target / "transfer_error.png", dpi=110)
    (target / "transfer_error.md").write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
