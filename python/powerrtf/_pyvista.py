# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The accessor ``mesh.powerrtf`` of pyvista's surfaces, which finds it by the package's entry point."""

import pyvista

from ._remesh import remesh


@pyvista.register_dataset_accessor("powerrtf", pyvista.PolyData)
class PowerRTFAccessor:
    """``mesh.powerrtf.remesh(n)``: :func:`powerrtf.remesh` of a ``pyvista.PolyData``."""

    def __init__(self, mesh):
        self._mesh = mesh

    def remesh(self, n=None, **options):
        """Returns a ``pyvista.PolyData``; the report's numbers are in its ``user_dict``."""
        result = remesh(self._mesh, None, n, **options)
        mesh = result.to_pyvista()
        mesh.user_dict["powerrtf"] = {name: value for name, value in result.report.items()
                                      if isinstance(value, (bool, int, float, str))}
        return mesh
