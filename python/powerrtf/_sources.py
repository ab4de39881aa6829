# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a result comes from, and values of the input on it."""

import numpy as np

from ._core import InvalidInputError
from ._input import like, to_host


class Sources:
    """Arrays: the input's face that each vertex lies on, the corners of a triangle of it and the
    barycentric coordinates in that; the input's face that each face's center lies on; and how many
    vertices and faces the input has."""

    def __init__(self, found, given):
        self.face, self.vertices, self.weights, self.of_faces = found
        points, corners, sizes, *_ = given
        self.counts = {"vertices": len(points), "faces": len(corners if sizes is None else sizes)}

    def transfer(self, values, of):
        if of not in self.counts:
            raise InvalidInputError(f"of is {of!r}, but must be one of {'|'.join(self.counts)}")
        array = to_host(values, "values")
        if array.ndim == 0 or len(array) != self.counts[of]:
            raise InvalidInputError(f"values must be a row for each of the input's {self.counts[of]} "
                                    f"{of}, not of the shape {array.shape}")
        if of == "faces":
            result = array[self.of_faces]
        elif array.dtype.kind in "fc":
            result = np.einsum("nk,nk...->n...", self.weights, array[self.vertices])
        else:
            nearest = self.weights.argmax(axis=1)
            result = array[self.vertices[np.arange(len(nearest)), nearest]]
        return like(result.astype(array.dtype, copy=False), values)
