# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np


def sphere(rings=12, dtype=float):
    """A sphere of about 2 rings^2 vertices."""
    angles = np.linspace(0, np.pi, rings + 1)[1:-1]
    around = np.arange(2 * rings) * np.pi / rings
    a, b = np.meshgrid(angles, around, indexing="ij")
    grid = np.stack([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)], -1).reshape(-1, 3)
    points = np.vstack([grid, [[0, 0, 1], [0, 0, -1]]]).astype(dtype)
    m, top, faces = 2 * rings, len(grid), []
    for j in range(m):
        k = (j + 1) % m
        faces += [[top, j, k], [top + 1, (rings - 2) * m + k, (rings - 2) * m + j]]
        for i in range(rings - 2):
            faces += [[i * m + j, (i + 1) * m + j, (i + 1) * m + k],
                      [i * m + j, (i + 1) * m + k, i * m + k]]
    return points, np.array(faces)


POINTS, FACES = sphere()
