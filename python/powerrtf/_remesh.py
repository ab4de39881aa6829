# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The package's functions."""

import inspect
import json
import os
import warnings

import numpy as np

from . import _core
from ._core import InvalidInputError
from ._input import face_arrays, index_array, like, real_array, to_host, unpack_mesh
from ._mesh import Mesh, MissedGuaranteeWarning, Report
from ._page import RESOLUTIONS

_FULL_NAMES = {"n": "number_of_samples", "seed": "random_seed"}
_TRAITS = ("auto", "cpu", "exact", "cuda")


def _bar():
    from tqdm.auto import tqdm
    bar = tqdm(total=1, bar_format="{desc:12} {percentage:3.0f}%|{bar}| {elapsed}")

    def show(fraction, stage):
        bar.set_description_str(stage, refresh=False)
        bar.n = fraction
        bar.refresh()
    return show, bar.close


def _vertex_values(values, name, count):
    values = real_array(values, name)
    if len(values) != count:
        raise InvalidInputError(f"{name} has {len(values)} entries, but there are {count} vertices")
    return values


def _labels(labels, count):
    labels = index_array(labels, "labels")
    if len(labels) != count:
        raise InvalidInputError(f"labels has {len(labels)} entries, but there are {count} faces")
    if len(labels) and np.abs(labels).max() > np.iinfo(np.int32).max:
        raise InvalidInputError("labels has an entry that is too large")
    return labels


def _region(region, count):
    """The numbers of the faces that a mask or an array of numbers names."""
    array = to_host(region, "region")
    if array.dtype == bool:
        if array.shape != (count,):
            raise InvalidInputError(f"region has the shape {array.shape}, but there are {count} faces")
        return np.flatnonzero(array)
    array = index_array(array, "region")
    if len(array) and not 0 <= array.min() <= array.max() < count:
        raise InvalidInputError(f"region has an entry that is no face's number: there are {count}")
    return array


def _run(vertices, faces, n, density, sizing, refine, constrained_edges, labels, region, patches, traits,
         threads, progress, options):
    if sizing is not None and n is None and not any(map(options.get, RESOLUTIONS)):
        options = {**options, "size_factor": 1.0}
    resolutions = [name for name in RESOLUTIONS if options.get(name)]
    if (n is not None) + len(resolutions) != 1:
        raise InvalidInputError(f"one of n, {', '.join(RESOLUTIONS)} must be given, not "
                                f"{(n is not None) + len(resolutions)} of them")
    if traits not in _TRAITS:
        raise InvalidInputError(f"traits is {traits!r}, but must be one of {'|'.join(_TRAITS)}")
    if not isinstance(threads, int) or not 0 <= threads <= 4096:
        raise InvalidInputError(f"threads is {threads!r}, but must be a number from 0 to 4096")
    options = {_FULL_NAMES.get(name, name): value for name, value in options.items()}
    for name in options.keys() - _OPTION_NAMES - {"preset", "coordinates"}:
        raise TypeError(f"remesh() got an unexpected keyword argument {name!r}")
    if n is not None:
        options["number_of_samples"] = n
    fields = {"density": None, "sizing": None, "constrained_edges": None, "labels": None, "region": None,
              "refine": list(refine), "patches": bool(patches)}
    if isinstance(density, str):
        options["density"] = density
    else:
        fields["density"] = _vertex_values(density, "density", len(vertices))
    if sizing is not None:
        fields["sizing"] = _vertex_values(sizing, "sizing", len(vertices))
    if constrained_edges is not None:
        fields["constrained_edges"] = index_array(constrained_edges, "constrained_edges", (2,))
    corners, sizes = faces
    count = len(corners) if sizes is None else len(sizes)
    if labels is not None:
        fields["labels"] = _labels(labels, count)
    if region is not None:
        if patches:
            raise InvalidInputError("patches is about whole meshes: what region leaves has none")
        fields["region"] = _region(region, count)
    given = (vertices, corners, sizes, fields, options)
    show, close = _bar() if progress is True else (progress or None, lambda: None)
    try:
        points, triangles, report, sites, numbers, sources = _core.remesh(*given, traits, threads, show)
    finally:
        close()
    mesh = Mesh(points, triangles, numbers if patches else None, Report(json.loads(report)), sites, sources,
                given)
    if labels is not None:
        mesh.labels = mesh.transfer(labels, of="faces")
    return mesh


def _warn(mesh):
    for missed in mesh.missed_guarantees:
        warnings.warn(f"a guarantee is missed: {missed}", MissedGuaranteeWarning, stacklevel=3)
    return mesh


def remesh(vertices, faces=None, n=None, *, density="curvature", sizing=None, refine=(),
           constrained_edges=None, labels=None, region=None, patches=False, traits="auto", threads=0,
           progress=None, **options):
    if faces is None:
        vertices, faces = unpack_mesh(vertices)
    points = real_array(vertices, "vertices", (3,))
    corners, sizes = face_arrays(faces)
    if points.dtype == np.float32:
        options["coordinates"] = "single"
    mesh = _run(points, (corners, sizes), n, density, sizing, refine, constrained_edges, labels, region,
                patches, traits, threads, progress, options)
    mesh.vertices = like(mesh.vertices, vertices)
    mesh.faces = like(mesh.faces.astype(corners.dtype, copy=False), faces)
    return _warn(mesh)


def remesh_file(input, output, n=None, *, ascii=False, density="curvature", refine=(), traits="auto",
                threads=0, progress=None, **options):
    """Remeshes from file to file.

    :param input: OFF, OBJ, PLY, STL, VTP or glTF
    :param output: OFF, OBJ, PLY, STL, VTP, glTF, VTU or MSH; it is written whole or not at all
    :param ascii: PLY and STL are written as text
    :returns: the :class:`Mesh`; the other parameters are those of :func:`remesh`
    :raises OutputError: `output` cannot be written
    """
    input, output = os.fspath(input), os.fspath(output)
    _core.check_output(output)
    points, corners, sizes = _core.read_mesh(input)
    if _core.holds_floats(output, ascii):
        options["coordinates"] = "single"
    mesh = _run(points, (corners, sizes), n, density, None, refine, None, None, None, False, traits,
                threads, progress, options)
    _core.write_mesh(output, mesh.vertices, mesh.faces, ascii)
    return _warn(mesh)


def remesh_trimesh(mesh, n=None, **options):
    """:func:`remesh` of a ``trimesh.Trimesh``. Returns one."""
    return remesh(mesh, None, n, **options).to_trimesh()


def remesh_open3d(mesh, n=None, **options):
    """:func:`remesh` of an ``open3d.geometry.TriangleMesh``. Returns one."""
    return remesh(mesh, None, n, **options).to_open3d()


_DOC = """Remeshes a surface with `n` well-distributed vertices.

:param vertices: (k, 3) numbers; or a mesh of trimesh, pyvista, Open3D or meshio, without `faces`
:param faces: (m, 3) or more columns, or polygons of different sizes: vertices, numbered from 0
:param n: the number of vertices asked for; or instead ``edge_length``, ``max_distance``, one of them
    relative to the diagonal, or ``vertex_share``
:param density: "curvature", "uniform", or a positive number for each vertex; only ratios matter
:param sizing: a positive number for each vertex: the edge length that is wanted there. Without `n` or
    what else gives it, the number of vertices comes from it
:param refine: regions where edges are to be short: "sphere:x,y,z,r,h" or
    "box:x0,y0,z0,x1,y1,z1,h", with the length h
:param constrained_edges: (e, 2) vertices: the creases to keep, instead of those by `feature_angle`
:param labels: (m,) whole numbers, one for each face: creases are kept between different ones, and
    the result has them as ``labels``
:param region: the faces to be remeshed, as a mask, (m,) bool, or by number: `n` is then the number of
    their vertices, those on their border included. The other faces, their vertices and the edges
    between stay as they are and come first in the result (polygons in triangles); the report is
    about the new ones
:param patches: whether the result has ``patches``: for each face the number of its patch between
    creases and borders
:param traits: "auto", "cpu", "exact" or "cuda": what runs the algorithm
:param threads: 0: all. The result is the same for any number
:param progress: is called with the share of the stage that is done and the stage's name, about
    every 50 ms; or True: a bar by tqdm. What it raises stops the run
:param preset: "quality", "fast" or "paper": whose values the other options have
{options}
:returns: :class:`Mesh`, which unpacks as ``vertices, faces``. Its arrays are of the input's kind
    and precision
:raises InvalidInputError: the message says what cannot be used (a :class:`ValueError`)
:warns MissedGuaranteeWarning: the result lacks something that is promised

>>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
>>> mesh = remesh(square, [[0, 1, 2, 3]], 100, density="uniform")
>>> len(mesh.vertices), mesh.missed_guarantees
(100, [])
"""


def _describe():
    """Gives `remesh` the signature and the documentation that the library's table has."""
    short = {full: name for name, full in _FULL_NAMES.items()}
    rows = [row for row in _core.options() if row[0] not in ("number_of_samples", "density",
                                                             "coordinates")]
    lines, added = [], [inspect.Parameter("preset", inspect.Parameter.KEYWORD_ONLY,
                                          default="quality")]
    for full_name, default, fast, paper, meaning, allowed in rows:
        name = short.get(full_name, full_name)
        others = "".join(f"; {preset}: {value!r}" for preset, value in
                         (("fast", fast), ("paper", paper)) if value != default)
        lines.append(f":param {name}: {meaning}; {allowed} ({default!r}{others})")
        added.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default))
    signature = inspect.signature(remesh)
    own = [p for p in signature.parameters.values() if p.kind != p.VAR_KEYWORD]
    remesh.__signature__ = signature.replace(parameters=own + added)
    remesh.__doc__ = _DOC.format(options="\n".join(lines))
    return {row[0] for row in rows}


_OPTION_NAMES = _describe()
