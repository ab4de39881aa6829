# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""From what users have to the arrays that the compiled part reads: native float32 or float64,
int32 or int64, of any strides."""

import sys

import numpy as np

from ._core import InvalidInputError

_DLPACK_CPU = 1
_ARRAY_INTERFACES = ("__array__", "__array_interface__", "__dlpack__")


def to_host(values, name):
    """`values` as a NumPy array; shares their memory where that can be had. Those of a device (a tensor
    of torch or an array of cupy on a GPU) are copied to the host."""
    if hasattr(values, "detach"):  # torch: a tensor that records gradients exports nothing
        values = values.detach()
    try:
        if hasattr(values, "__dlpack__") and not isinstance(values, np.ndarray):
            return np.from_dlpack(_on_host(values))
        return np.asarray(values)
    except (BufferError, RuntimeError, TypeError, ValueError) as error:
        raise InvalidInputError(f"{name} cannot be read as an array: {error}") from error


def _on_host(values):
    """`values`, or a copy on the host: the libraries differ in its name."""
    if values.__dlpack_device__()[0] == _DLPACK_CPU:
        return values
    for name in ("cpu", "get", "numpy"):  # torch; cupy; TensorFlow
        if hasattr(values, name):
            return getattr(values, name)()
    return np.asarray(values)  # jax


def _with_type(array, name, kinds, types, what):
    if array.size == 0:
        return array.astype(types[-1])
    if array.dtype.kind not in kinds:
        raise InvalidInputError(f"{name} must be {what}, not of type {array.dtype}")
    native = array.dtype.newbyteorder("=")
    return array.astype(native if native in types else types[-1], copy=False)


def real_array(values, name, columns=None):
    array = to_host(values, name)
    check_shape(array, name, columns)
    return _with_type(array, name, "fiu", (np.dtype("f4"), np.dtype("f8")), "numbers")


def index_array(values, name, columns=None):
    array = to_host(values, name)
    check_shape(array, name, columns)
    if array.dtype == np.uint64 and array.size and array.max() > np.iinfo(np.int64).max:
        raise InvalidInputError(f"{name} has an entry that is too large: {array.max()}")
    return _with_type(array, name, "iu", (np.dtype("i4"), np.dtype("i8")), "whole numbers")


def check_shape(array, name, columns):
    """`columns`: how many there may be; none: the array has one dimension."""
    if columns is None:
        fits, wanted = array.ndim == 1, "(m,)"
    else:
        fits = array.ndim == 2 and array.shape[1] in columns
        wanted = f"(m, {columns[0]})" + (" or more columns" if len(columns) > 1 else "")
    if not fits:
        raise InvalidInputError(f"{name} must have the shape {wanted}, not {array.shape}")


class Polygons:
    """Faces of any sizes: all their corners, and how many each has."""

    def __init__(self, corners, sizes):
        self.corners = corners
        self.sizes = sizes

    @classmethod
    def of_packed(cls, packed):
        """From VTK's rows: the size of each face before its corners."""
        packed = np.asarray(packed)
        places, place = [], 0
        while place < len(packed):
            places.append(place)
            place += 1 + int(packed[place])
        is_corner = np.ones(len(packed), dtype=bool)
        is_corner[places] = False
        return cls(packed[is_corner], packed[places])


def face_arrays(faces):
    """Corners, a row for each face, and no sizes; or all corners and the faces' sizes."""
    if isinstance(faces, Polygons):
        if len(faces.sizes) and (faces.sizes == faces.sizes[0]).all():
            return index_array(faces.corners.reshape(-1, faces.sizes[0]), "faces",
                               range(3, 1 << 16)), None
        return index_array(faces.corners, "faces"), faces.sizes
    if not any(hasattr(faces, name) for name in _ARRAY_INTERFACES):
        faces = list(faces)
        try:
            sizes = [len(face) for face in faces]
        except TypeError:
            raise InvalidInputError("faces must be rows of vertices' numbers") from None
        if len(set(sizes)) > 1:
            corners = [v for face in faces for v in face]
            return index_array(corners, "faces"), np.array(sizes)
    return index_array(faces, "faces", range(3, 1 << 16)), None


def unpack_mesh(mesh):
    """Vertices and faces of an object of trimesh, pyvista, Open3D or meshio."""
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh
        return np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # Open3D
        return np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):  # pyvista
        return np.asarray(mesh.points), Polygons.of_packed(mesh.faces)
    if hasattr(mesh, "points") and hasattr(mesh, "cells"):  # meshio
        return mesh.points, [face for block in mesh.cells for face in block.data if len(face) > 2]
    raise InvalidInputError(f"faces are missing, and {type(mesh).__name__} is no mesh")


def like(array, original):
    """`array` as an array of the library that `original` is from, on its device."""
    if isinstance(original, np.ndarray) or not hasattr(original, "__dlpack__"):
        return array
    library = sys.modules.get(type(original).__module__.partition(".")[0])
    if hasattr(original, "__array_namespace__"):
        library = original.__array_namespace__()
    if original.__dlpack_device__()[0] != _DLPACK_CPU and hasattr(library, "asarray"):
        device = {"device": original.device} if hasattr(original, "detach") else {}
        return library.asarray(array, **device)  # cupy's is that in use
    return library.from_dlpack(array) if hasattr(library, "from_dlpack") else array
