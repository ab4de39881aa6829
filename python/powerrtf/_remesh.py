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
from ._options import DEFAULTS, PRESETS, RESOLUTIONS, ROWS, check_traits, given_options
from ._sources import corner_rows


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


def _labels(face_labels, count):
    face_labels = index_array(face_labels, "face_labels")
    if len(face_labels) != count:
        raise InvalidInputError(f"face_labels has {len(face_labels)} entries, but there are {count} faces")
    if len(face_labels) and np.abs(face_labels).max() > np.iinfo(np.int32).max:
        raise InvalidInputError("face_labels has an entry that is too large")
    return face_labels


def _uv(uv, faces, corners):
    array = to_host(uv, "uv")
    rows = corner_rows(array, faces, corners)
    if rows.shape != (corners, 2):
        raise InvalidInputError(f"uv has the shape {array.shape}, but must have two numbers for each of the "
                                f"{corners} corners of {faces} faces")
    rows = real_array(rows, "uv", (2,))
    if not np.isfinite(rows).all():
        raise InvalidInputError("uv has an entry that is not a finite number")
    return rows


def _chosen(values, name, count, kind):
    """The numbers of those faces or vertices, of `count`, that a mask or an array of numbers names."""
    array = to_host(values, name)
    if array.dtype == bool:
        if array.shape != (count,):
            raise InvalidInputError(f"{name} has the shape {array.shape}, but there are {count} {kind}")
        return np.flatnonzero(array)
    array = index_array(array, name)
    if len(array) and not 0 <= array.min() <= array.max() < count:
        raise InvalidInputError(f"{name} has an entry that is none of the numbers of {count} {kind}")
    return array


def _run(vertices, faces, options, *, size_field=None, refine=(), constrained_edges=None,
         constrained_vertices=None, face_labels=None, region=None, uv=None, patches=False, threads=0,
         progress=None, coordinates="double"):
    resolutions = [name for name in RESOLUTIONS if name in options and (options[name] or name == "n")]
    if size_field is not None and not resolutions:
        options = {**options, "size_factor": 1.0}
    elif len(resolutions) != 1:
        raise InvalidInputError(f"one of {', '.join(RESOLUTIONS)} must be given, not "
                                f"{len(resolutions)} of them")
    traits = options.pop("traits", "auto")
    check_traits(traits)
    if not isinstance(threads, int) or not 0 <= threads <= 4096:
        raise InvalidInputError(f"threads is {threads!r}, but must be a number from 0 to 4096")
    options["coordinates"] = coordinates
    fields = {"density": None, "sizing": None, "constrained_edges": None, "constrained_vertices": None,
              "labels": None, "region": None, "uv": None, "refine": list(refine), "patches": bool(patches)}
    if not isinstance(options.get("density", ""), str):
        fields["density"] = _vertex_values(options.pop("density"), "density", len(vertices))
    if size_field is not None:
        fields["sizing"] = _vertex_values(size_field, "size_field", len(vertices))
    if constrained_edges is not None:
        fields["constrained_edges"] = index_array(constrained_edges, "constrained_edges", (2,))
    if constrained_vertices is not None:
        fields["constrained_vertices"] = _chosen(constrained_vertices, "constrained_vertices", len(vertices),
                                                 "vertices")
    corners, sizes = faces
    count = len(corners) if sizes is None else len(sizes)
    if face_labels is not None:
        fields["labels"] = _labels(face_labels, count)
    if uv is not None:
        if options.get("symmetry", "none") != "none":
            raise InvalidInputError("uv and symmetry exclude each other: the seams have no mirror images")
        fields["uv"] = _uv(uv, count, corners.size)
    if region is not None:
        if patches:
            raise InvalidInputError("patches is about whole meshes: what region leaves has none")
        fields["region"] = _chosen(region, "region", count, "faces")
    elif options.get("region_border", "keep") != "keep":
        raise InvalidInputError("region_border is about the border of a region, but there is none")
    given = (vertices, corners, sizes, fields, options)
    show, close = _bar() if progress is True else (progress or None, lambda: None)
    try:
        points, triangles, report, sites, numbers, sources = _core.remesh(*given, traits, threads, show)
    finally:
        close()
    mesh = Mesh(points, triangles, numbers if patches else None, Report(json.loads(report)), sites, sources,
                given)
    if face_labels is not None:
        mesh.labels = mesh._sources.transfer(face_labels, "faces")  # each on its own side of a line
    if uv is not None:
        mesh.uv = mesh.transfer(uv, of="corners")
    return mesh


def _warn(mesh):
    for missed in mesh.missed_guarantees:
        warnings.warn(f"a guarantee is missed: {missed}", MissedGuaranteeWarning, stacklevel=3)
    return mesh


def remesh(vertices, faces=None, n=None, *, size_field=None, refine=(), constrained_edges=None,
           constrained_vertices=None, face_labels=None, region=None, uv=None, patches=False, threads=0,
           progress=None, options=None, **single):
    if faces is None:
        vertices, faces = unpack_mesh(vertices)
    points = real_array(vertices, "vertices", (3,))
    corners, sizes = face_arrays(faces)
    mesh = _run(points, (corners, sizes), given_options(options, n, single), size_field=size_field,
                refine=refine, constrained_edges=constrained_edges, constrained_vertices=constrained_vertices,
                face_labels=face_labels, region=region, uv=uv, patches=patches, threads=threads,
                progress=progress, coordinates=_precision(points.dtype == np.float32))
    mesh.vertices = like(mesh.vertices, vertices)
    mesh.faces = like(mesh.faces.astype(corners.dtype, copy=False), faces)
    return _warn(mesh)


def remesh_file(input, output, n=None, *, ascii=False, refine=(), threads=0, progress=None, options=None,
                **single):
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
    mesh = _run(points, (corners, sizes), given_options(options, n, single), refine=refine, threads=threads,
                progress=progress, coordinates=_precision(_core.holds_floats(output, ascii)))
    _core.write_mesh(output, mesh.vertices, mesh.faces, ascii)
    return _warn(mesh)


def _precision(is_single):
    """Of the result's coordinates."""
    return "single" if is_single else "double"


def remesh_trimesh(mesh, n=None, **options):
    """:func:`remesh` of a ``trimesh.Trimesh``. Returns one."""
    return remesh(mesh, None, n, **options).to_trimesh()


def remesh_open3d(mesh, n=None, **options):
    """:func:`remesh` of an ``open3d.geometry.TriangleMesh``. Returns one."""
    return remesh(mesh, None, n, **options).to_open3d()


_DOC = """Remeshes a surface with `n` well-distributed vertices. A :class:`MissedGuaranteeWarning` tells of
what the result lacks, if it does.

:param vertices: (k, 3) numbers; or a mesh of trimesh, pyvista, Open3D or meshio, without `faces`
:param faces: (m, 3) or more columns, or polygons of different sizes: vertices, numbered from 0
:param n: the number of vertices asked for; or instead ``edge_length``, ``max_distance``, one of them
    relative to the diagonal, or ``vertex_share``
:param size_field: a positive number for each vertex: the edge length that is wanted there. Without `n` or
    what else gives it, the number of vertices comes from it
:param refine: regions where edges are to be short: "sphere:x,y,z,r,h" or
    "box:x0,y0,z0,x1,y1,z1,h", with the length h
:param constrained_edges: (e, 2) vertices: the creases to keep, instead of those by `feature_angle`
:param constrained_vertices: the vertices that stay exactly where they are, as a mask, (k,) bool, or by number;
    `n` counts them, too. Not with ``symmetry``
:param face_labels: (m,) whole numbers, one for each face: creases are kept between different ones, and
    the result has them as ``labels``
:param region: the faces to be remeshed, as a mask, (m,) bool, or by number: `n` is then the number of
    their vertices, those on their border included. The other faces, their vertices and the edges
    between stay as they are and come first in the result (polygons in triangles); the report is
    about the new ones. With ``region_border="remesh"`` the edges between get the region's spacing, and
    those faces beside them that change come last
:param uv: texture coordinates of the corners of faces, (m, 3, 2), or in a row, (corners, 2). Seams, the edges at
    an end of which they jump, are kept as creases, and the result has ``uv``, (m, 3, 2), on each side of a
    seam its own. Not with ``symmetry``
:param patches: whether the result has ``patches``: for each face the number of its patch between
    creases and borders
:param threads: 0: all. The result is the same for any number
:param progress: is called with the share of the stage that is done and the stage's name, about
    every 50 ms; or True: a bar by tqdm. What it raises stops the run
:param options: an :class:`Options`, with what the call does not give itself
:param preset: "quality", "fast" or "paper": whose values the other options have
:param traits: "auto", "cpu", "exact" or, where it is built in, "cuda": what runs the algorithm
{options}
:returns: :class:`Mesh`, which unpacks as ``vertices, faces``. Its arrays are of the input's kind
    and precision
:raises InvalidInputError: the message says what cannot be used (a :class:`ValueError`)
:raises RuntimeError: ``traits`` is "cuda", and the GPU cannot be used

>>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
>>> mesh = remesh(square, [[0, 1, 2, 3]], 100, density="uniform")
>>> len(mesh.vertices), mesh.missed_guarantees
(100, [])
"""


def _describe():
    """Gives `remesh` the signature and the documentation that the library's table has."""
    lines = []
    for name, (meaning, values) in ROWS.items():
        default = values["quality"]
        others = "".join(f"; {preset}: {values[preset]!r}" for preset in PRESETS[1:]
                         if values[preset] != default)
        if name == "density":
            meaning += "; or a positive number for each vertex, of which only ratios matter"
        if name != "n":
            lines.append(f":param {name}: {meaning} ({default!r}{others})")
    signature = inspect.signature(remesh)
    own = [p for p in signature.parameters.values() if p.kind != p.VAR_KEYWORD]
    added = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default)
             for name, default in DEFAULTS.items() if name != "n"]
    remesh.__signature__ = signature.replace(parameters=own + added)
    remesh.__doc__ = _DOC.format(options="\n".join(lines))


_describe()
