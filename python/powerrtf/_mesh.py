# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run."""

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from . import _core
from ._cells import Cells
from ._input import to_host
from ._page import Page, html_page
from ._sources import Sources


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
    """The result of a run: triangles. Unpacks as ``vertices, faces = mesh``.

    Attributes: ``vertices`` (n, 3) and ``faces`` (m, 3), counter-clockwise seen from outside, arrays of
    the input's kind; ``labels`` of the faces and ``uv`` of their corners, (m, 3, 2), of the kind and type of
    those given, and ``patches``, where they are wanted, or None; and ``report``, the :class:`Report`. Can be
    pickled.

    >>> import powerrtf
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> mesh = powerrtf.remesh(square, [[0, 1, 2, 3]], 100, density="uniform")
    >>> mesh
    Mesh(100 vertices, 166 faces)
    >>> vertices, faces = mesh
    >>> mesh.report.vertices, mesh.report["faces"], mesh.report.to_dict()["euler_characteristic"]
    (100, 166, 1)
    """

    def __init__(self, vertices, faces, patches, report, sites, sources, given):
        self.vertices = vertices
        self.faces = faces
        self.labels = None
        self.uv = None
        self.patches = patches
        self.report = report
        self._sites = sites
        self._given = given
        self._found_sources = sources and Sources(sources, given)

    def __iter__(self):
        return iter((self.vertices, self.faces))

    def __repr__(self):
        return f"Mesh({len(self.vertices)} vertices, {len(self.faces)} faces)"

    @property
    def missed_guarantees(self):
        """What the result lacks, in words; empty: nothing."""
        return self.report["missed_guarantees"]

    def cells(self):
        """The :class:`Cells` of the samples. They are made when they are asked for, in double
        precision, whatever has placed the samples.

        >>> import powerrtf
        >>> tetrahedron = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
        >>> cells = powerrtf.remesh(tetrahedron, faces, 100).cells()
        >>> cells[0].shape[1], len(cells) == len(cells.area)
        (3, True)
        """
        return Cells(_core.cells(self._sites))

    @cached_property
    def _face_shares(self):
        """The input's faces under 16 points of each face, its center first. Faces that have stayed are
        themselves, and no share of a face comes from beyond a line between labels."""
        found = _core.face_shares(*self._given[:3], *self._arrays(), self._sites)
        own = self._sources.of_faces[:, np.newaxis]
        new = self.report["faces"] + self.report.to_dict().get("changed_faces", 0)
        found[:len(found) - new] = own[:len(found) - new]
        labels = self._given[3]["labels"]
        return found if labels is None else np.where(labels[found] == labels[own], found, own)

    @property
    def _sources(self):
        if self._found_sources is None:
            found = _core.sources(*self._given[:3], *self._arrays(), self._sites)
            self._found_sources = Sources(found, self._given)
        return self._found_sources

    @property
    def source_face(self):
        """The input's face that each vertex lies on, (n,): that of the nearest place that faces the
        same way. Found when it is asked for; the input's arrays must not have been changed since."""
        return self._sources.face

    @property
    def source_vertices(self):
        """The input's vertices at the corners of a triangle of that face, (n, 3): of a triangle all
        of its corners."""
        return self._sources.vertices

    @property
    def barycentric(self):
        """The barycentric coordinates of that place in that triangle, (n, 3)."""
        return self._sources.weights

    def transfer(self, values, of="vertices"):
        """Values of the input's vertices on the result's, interpolated linearly; those that are not
        floating-point numbers, as labels, are those of the nearest corner. Or values of the input's
        faces on the result's, each that which the largest share of it comes from, as seen from 16 points of it.
        Or values of the corners of faces, which jump at the seams of the ``uv`` that :func:`remesh` has had:
        each corner's are those on its own side.

        :param values: a row for each vertex, face or corner of the input; of corners also (faces, corners of
            each, ...)
        :param of: "vertices", "faces" or "corners", of which the result has (m, 3, ...)
        :returns: an array of the same kind and type

        >>> import powerrtf
        >>> square = [[0., 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> mesh = powerrtf.remesh(square, [[0, 1, 2, 3]], 100)
        >>> bool(abs(mesh.transfer(square) - mesh.vertices).max() < 1e-12)
        True
        >>> str(mesh.transfer(["green"], of="faces")[7])
        'green'
        """
        return self._sources.transfer(values, of, lambda: self._face_shares)

    def show(self, height=900):
        """The page of :func:`report_html` in a notebook, where it is the cell's value."""
        return Page(html_page(self), height)

    def _arrays(self):
        return to_host(self.vertices, "vertices"), to_host(self.faces, "faces")

    def to_trimesh(self):
        """A ``trimesh.Trimesh``."""
        import trimesh
        return trimesh.Trimesh(*self._arrays(), process=False)

    def to_pyvista(self):
        """A ``pyvista.PolyData``."""
        import pyvista
        return pyvista.PolyData.from_regular_faces(*self._arrays())

    def to_meshio(self):
        """A ``meshio.Mesh``, which writes many formats."""
        import meshio
        vertices, faces = self._arrays()
        return meshio.Mesh(vertices, [("triangle", faces)])

    def to_open3d(self):
        """An ``open3d.geometry.TriangleMesh``."""
        import open3d
        vertices, faces = self._arrays()
        return open3d.geometry.TriangleMesh(
            open3d.utility.Vector3dVector(vertices.astype(float)),
            open3d.utility.Vector3iVector(faces.astype(np.int32)))
