# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surface remeshing by power diagrams restricted to tangent planes.

>>> import powerrtf
>>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
>>> faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
>>> vertices, faces = powerrtf.remesh(vertices, faces, 50)
>>> vertices.shape, faces.shape
((50, 3), (96, 3))
"""

from ._cells import Cells
from ._core import InvalidInputError, OutputError, __version__
from ._mesh import Mesh, MissedGuaranteeWarning, Report
from ._options import Options
from ._page import report_html
from ._remesh import remesh, remesh_file, remesh_open3d, remesh_trimesh

__all__ = ["Cells", "InvalidInputError", "Mesh", "MissedGuaranteeWarning", "Options", "OutputError", "Report",
           "remesh", "remesh_file", "remesh_open3d", "remesh_trimesh", "report_html"]
