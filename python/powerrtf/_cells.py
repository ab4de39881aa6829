# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The cells of a run."""

import numpy as np


class Cells:
    """The cells of the samples: polygons in the samples' tangent planes. ``cells[i]`` has the corners
    of cell i, (k, 3), counter-clockwise seen from outside. Cell i is that of vertex i, before the
    triangles' improvement has moved it; samples on creases and borders, which are the last vertices,
    have none.

    Attributes, in the input's units: ``points`` (p, 3), all corners; ``first`` (c + 1,), where those of
    each cell begin; ``area``, ``mass`` (area times density), ``density``, ``weight`` and ``status``
    (0: ok, 1: guarded, 2: empty, 3: incomplete), (c,).
    """

    def __init__(self, arrays):
        for name, values in arrays.items():
            setattr(self, name, values)

    def __len__(self):
        return len(self.area)

    def __getitem__(self, i):
        i = range(len(self))[i]
        return self.points[self.first[i]:self.first[i + 1]]

    def __repr__(self):
        return f"Cells({len(self)} cells)"

    @property
    def sides(self):
        """The number of sides of each cell; of an empty one 0."""
        return np.diff(self.first)

    def to_pyvista(self):
        """A ``pyvista.PolyData`` with the cells that are not empty, and their values."""
        import pyvista
        sides = self.sides
        kept = np.flatnonzero(sides)
        packed = np.insert(np.arange(len(self.points)), self.first[kept], sides[kept])
        mesh = pyvista.PolyData(self.points, packed)
        mesh.cell_data["sample"] = kept
        mesh.cell_data["sides"] = sides[kept]
        for name in ("area", "mass", "density", "weight", "status"):
            mesh.cell_data[name] = getattr(self, name)[kept]
        return mesh
