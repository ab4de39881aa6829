# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fills a closed surface with tetrahedra by Gmsh, in an environment that has it and pyvista.

tetrahedra.py SURFACE

The triangles stay as they are, all settings are Gmsh's own. Prints JSON: how many tetrahedra, the
mean and the least of their gamma (inscribed over circumscribed radius, times 3).
"""

import json
import sys

import gmsh
import numpy
from peer_python import read


def main():
    mesh = read(sys.argv[1])
    points = numpy.asarray(mesh.points, dtype=float)
    triangles = mesh.regular_faces + 1
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    surface = gmsh.model.addDiscreteEntity(2)
    gmsh.model.mesh.addNodes(2, surface, range(1, len(points) + 1), points.ravel())
    gmsh.model.mesh.addElementsByType(surface, 2, [], triangles.ravel())
    gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop([surface])])
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    tetrahedra, _ = gmsh.model.mesh.getElementsByType(4)
    gamma = gmsh.model.mesh.getElementQualities(tetrahedra, "gamma")
    if len(gamma) == 0:
        sys.exit("no tetrahedra")
    print(json.dumps({"tetrahedra": len(gamma), "gamma_avg": float(numpy.mean(gamma)),
                      "gamma_min": float(numpy.min(gamma))}))


if __name__ == "__main__":
    main()
