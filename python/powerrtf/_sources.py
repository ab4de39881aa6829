# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a result comes from, and values of the input on it."""

import numpy as np

from ._core import InvalidInputError
from ._input import like, to_host


class Sources:
    """Arrays: the input's face that each vertex lies on, the corners of a triangle of it and the
    barycentric coordinates in that; the input's face that each face's center lies on; three corners of the
    input for each corner, in a row, and their weights, or None; and how many vertices, faces and corners the
    input has."""

    def __init__(self, found, given):
        self.face, self.vertices, self.weights, self.of_faces, self.corners, self.corner_weights = found
        points, corners, sizes, *_ = given
        self.counts = {"vertices": len(points), "faces": len(corners if sizes is None else sizes),
                       "corners": corners.size}

    def transfer(self, values, of, face_shares=None):
        """`face_shares()`: the input's faces under several points of each face; None: the centers count."""
        if of not in self.counts:
            raise InvalidInputError(f"of is {of!r}, but must be one of {'|'.join(self.counts)}")
        if of == "corners" and self.corners is None:
            raise InvalidInputError("of is 'corners', but where their values jump is told by uv only, and "
                                    "remesh() has had none")
        array = to_host(values, "values")
        if of == "corners":
            array = corner_rows(array, self.counts["faces"], self.counts[of])
        if array.ndim == 0 or len(array) != self.counts[of]:
            raise InvalidInputError(f"values must be a row for each of the input's {self.counts[of]} "
                                    f"{of}, not of the shape {array.shape}")
        if of == "faces":
            result = _most_frequent(array, face_shares()) if face_shares else array[self.of_faces]
        elif of == "corners":
            result = _mixed(array, self.corners, self.corner_weights)
            result = result.reshape(-1, 3, *array.shape[1:])
        else:
            result = _mixed(array, self.vertices, self.weights)
        return like(result.astype(array.dtype, copy=False), values)


def corner_rows(array, faces, corners):
    """A row for each corner: faces of equal size may have a dimension of their own."""
    if array.ndim > 1 and array.shape[0] == faces and faces * array.shape[1] == corners:
        return array.reshape(corners, *array.shape[2:])
    return array


def _most_frequent(array, rows):
    """For each of `rows` the row of `array` that is equal to most of those there; the first of such."""
    flat = array.reshape(len(array), -1)
    if array.dtype == object:  # NumPy sorts no such rows
        numbers = {}
        values = np.array([numbers.setdefault(tuple(row), len(numbers)) for row in flat])
    else:
        values = np.unique(flat, axis=0, return_inverse=True)[1].reshape(-1)
    found = values[rows]
    equal = np.zeros(found.shape, dtype=np.int8)
    for column in found.T:
        equal += found == column[:, np.newaxis]
    return array[rows[np.arange(len(rows)), equal.argmax(axis=1)]]


def _mixed(array, rows, weights):
    """Three rows of `array` for each of `rows`, interpolated; of what is no floating-point number that with the
    largest weight."""
    if array.dtype.kind in "fc":
        return np.einsum("nk,nk...->n...", weights, array[rows])
    return array[rows[np.arange(len(rows)), weights.argmax(axis=1)]]
