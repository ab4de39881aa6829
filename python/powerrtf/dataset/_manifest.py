# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists of meshes: Parquet files with a column ``path``, and one for each option that differs."""

import os
from collections import namedtuple

from .._options import DEFAULTS, merged
from ._options import arguments
from ._tables import arrow, read_tables, write_table

_ENDINGS = (".off", ".obj", ".ply", ".stl")

# path: as the manifest has it; file: the absolute one; arguments: those of the program
Entry = namedtuple("Entry", "path file arguments")


def write_manifest(manifest, meshes, **options):
    """Writes a manifest.

    :param manifest: the Parquet file; paths in it are relative to its folder, so that both may be moved
    :param meshes: a folder, whose OFF, OBJ, PLY and STL files are taken, those of its folders, too, by
        their names; or a list of files
    :param options: lists with a value for each mesh, or None: the options of :func:`powerrtf.remesh`
        that are not the same for all
    :raises ValueError: the folder has no mesh, or a list has another length
    :raises TypeError: there is no such option
    """
    folder = os.path.dirname(os.path.abspath(manifest))
    files = _files_in(meshes) if isinstance(meshes, (str, os.PathLike)) else list(meshes)
    columns = {"path": [os.path.relpath(file, folder) for file in files], **options}
    _check_names(options)
    for name, values in options.items():
        if len(values) != len(files):
            raise ValueError(f"{name} has {len(values)} values, but there are {len(files)} meshes")
    write_table(arrow().table(columns), manifest)


def _files_in(folder):
    files = sorted(os.path.join(place, name) for place, _, names in os.walk(folder) for name in names
                   if name.lower().endswith(_ENDINGS))
    if not files:
        raise ValueError(f"{os.fspath(folder)}: there is no mesh in this folder")
    return files


def _check_names(names, where=""):
    for name in names:
        if name not in DEFAULTS:
            raise TypeError(f"{where}{name!r} is no option of a mesh")


def read_manifest(manifest, common):
    """The entries of a manifest.

    :param common: options of all meshes that the manifest says nothing else about
    :raises ValueError: what is wrong with the manifest, or with `common`
    :raises TypeError: a column is no option
    """
    arguments(common)
    manifest = os.path.abspath(manifest)
    rows = read_tables([manifest])
    if "path" not in rows.column_names:
        raise ValueError(f"{manifest}: there is no column 'path'")
    _check_names(set(rows.column_names) - {"path"}, f"{manifest}: the column ")
    entries = []
    for number, row in enumerate(rows.to_pylist()):
        path = row.pop("path")
        if not path:
            raise ValueError(f"{manifest}: row {number} has no path")
        own = {name: value for name, value in row.items() if value is not None}
        try:
            given = arguments(merged(common, own))
        except ValueError as error:
            raise ValueError(f"{manifest}: row {number}: {error}") from error
        entries.append(Entry(path, os.path.normpath(os.path.join(os.path.dirname(manifest), path)), given))
    return entries
