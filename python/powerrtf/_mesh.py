# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run."""

from collections.abc import Mapping

import numpy as np


class MissedGuaranteeWarning(UserWarning):
    """The result lacks something that the library promises; the message says what."""


class Report(Mapping):
    """What was done and what the result is worth, by the names of the program's JSON report: as
    attributes and as a dictionary."""

    def __init__(self, values):
        self._values = values

    def __getitem__(self, name):
        return self._values[name]

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __getattr__(self, name):
        if name.startswith("_") or name not in self._values:
            raise AttributeError(f"the report has no {name!r}")
        value = self._values[name]
        return Report(value) if isinstance(value, dict) else value

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def __repr__(self):
        return f"Report({self._values!r})"

    def to_dict(self):
        return dict(self._values)


class Mesh:
    """Triangles. Unpacks as ``vertices, faces = mesh``.

    Attributes: ``vertices`` (n, 3), ``faces`` (m, 3), counter-clockwise seen from outside, and
    ``report``."""

    def __init__(self, vertices, faces, report):
        self.vertices = vertices
        self.faces = faces
        self.report = report

    def __iter__(self):
        return iter((self.vertices, self.faces))

    def __repr__(self):
        return f"Mesh({len(self.vertices)} vertices, {len(self.faces)} faces)"

    @property
    def missed_guarantees(self):
        """What the result lacks, in words; empty: nothing."""
        return self.report["missed_guarantees"]

    def to_trimesh(self):
        import trimesh
        return trimesh.Trimesh(np.asarray(self.vertices), np.asarray(self.faces), process=False)

    def to_pyvista(self):
        import pyvista
        return pyvista.PolyData.from_regular_faces(np.asarray(self.vertices), np.asarray(self.faces))

    def to_meshio(self):
        import meshio
        return meshio.Mesh(np.asarray(self.vertices), [("triangle", np.asarray(self.faces))])

    def to_open3d(self):
        import open3d
        return open3d.geometry.TriangleMesh(
            open3d.utility.Vector3dVector(np.asarray(self.vertices, dtype=float)),
            open3d.utility.Vector3iVector(np.asarray(self.faces, dtype=np.int32)))
