# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one of the peers that are Python packages, in an environment that has it and pyvista.

peer_python.py PACKAGE INPUT OUTPUT.ply uniform|curvature SIZE CREASE_ANGLE

SIZE: powerrtf, pyacvd, pyinstantmeshes, pynanoinstantmeshes: the number of vertices; else the length
of the edges in units of the diagonal of the bounding box (mmgpy with `curvature`: the largest distance
to the surface), or, written as an integer, the number of vertices that it is to give: of n vertices
spread evenly over the area of the surface the edges have the length sqrt(2 area / sqrt(3) / n). Edges are
kept where the normals turn by more than CREASE_ANGLE degrees (180: none) by the packages that can.
Prints JSON: CPU seconds and MiB of memory without the packages' import.
"""

import json
import math
import resource
import sys
import time


def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def read(source):
    import numpy
    import pyvista

    if not source.lower().endswith(".off"):
        mesh = pyvista.read(source)
        # only the geometry: data that came with the file would not survive a subdivision
        return pyvista.PolyData(mesh.points, mesh.faces).clean()
    with open(source, encoding="ascii") as file:
        words = " ".join(line.split("#")[0] for line in file).split()[1:]
    points, faces = int(words[0]), int(words[1])
    positions = numpy.array(words[3:3 + 3 * points], dtype=float).reshape(-1, 3)
    corners = numpy.array(words[3 + 3 * points:3 + 3 * points + 4 * faces], dtype=int)
    return pyvista.PolyData(positions, corners)


def with_arrays(remesh):
    """For a package that maps points, triangles and the diagonal to new points and triangles."""
    import numpy
    import pyvista

    def run(source, target):
        mesh = read(source)
        points = numpy.asarray(mesh.points, dtype=float)
        triangles = mesh.regular_faces.astype(numpy.int32)
        pyvista.PolyData.from_regular_faces(*remesh(points, triangles, mesh.length)).save(target)

    return run


def with_pymeshlab(density, size, crease_angle):
    import pymeshlab

    def run(source, target):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(source)
        length = size * meshes.current_mesh().bounding_box().diagonal()
        meshes.meshing_isotropic_explicit_remeshing(
            targetlen=pymeshlab.PureValue(length), iterations=10, featuredeg=crease_angle)
        meshes.save_current_mesh(target)

    return run


def with_pyacvd(density, size, crease_angle):
    import pyacvd

    def run(source, target):
        mesh = read(source)
        clustering = pyacvd.Clustering(mesh)
        levels = 3  # as in its documentation; more for 20 points to a cluster, as it asks for
        while mesh.n_points * 4 ** levels < 20 * size:
            levels += 1
        clustering.subdivide(levels)
        clustering.cluster(round(size))
        clustering.create_mesh().save(target)

    return run


def with_gpytoolbox(density, size, crease_angle):
    import gpytoolbox

    return with_arrays(lambda points, triangles, diagonal: gpytoolbox.remesh_botsch(
        points, triangles, i=10, h=size * diagonal, detect_feature_edges=crease_angle < 180,
        feature_dihedral_threshold=crease_angle))


def with_powerrtf(density, size, crease_angle):
    import powerrtf

    return with_arrays(lambda points, triangles, diagonal: powerrtf.remesh(
        points, triangles, round(size), density=density, feature_angle=crease_angle, threads=1))


def with_pyinstantmeshes(density, size, crease_angle):
    import pyinstantmeshes

    return with_arrays(lambda points, triangles, diagonal: pyinstantmeshes.remesh(
        points.astype("float32"), triangles, target_vertex_count=round(size), rosy=6, posy=3,
        crease_angle=crease_angle if crease_angle < 180 else -1, deterministic=True))


def with_pynanoinstantmeshes(density, size, crease_angle):
    import pynanoinstantmeshes

    return with_arrays(lambda points, triangles, diagonal: pynanoinstantmeshes.remesh(
        points.astype("float32"), triangles.astype("uint32"), round(size), rosy=6, posy=3,
        creaseAngle=crease_angle if crease_angle < 180 else -1, deterministic=True))


def with_compas_cgal(density, size, crease_angle):
    from compas_cgal.meshing import trimesh_remesh

    return with_arrays(lambda points, triangles, diagonal: trimesh_remesh(
        (points, triangles), size * diagonal,
        protect_sharp_edges_angle_deg=crease_angle if crease_angle < 180 else 0))


def with_mmgpy(density, size, crease_angle):
    import mmgpy

    def remesh(points, triangles, diagonal):
        mesh = mmgpy.MmgMeshS(points, triangles)
        bounds = {"hausd": size * diagonal} if density == "curvature" else \
            {"hsiz": size * diagonal, "hausd": 0.01 * diagonal}
        mesh.remesh(ar=crease_angle, verbose=-1, **bounds)
        return mesh.get_vertices(), mesh.get_triangles()

    return with_arrays(remesh)


def with_meshlib(density, size, crease_angle):
    import meshlib.mrmeshpy as meshlib

    def run(source, target):
        mesh = meshlib.loadMesh(source)
        settings = meshlib.RemeshSettings()
        settings.targetEdgeLen = size * mesh.computeBoundingBox().diagonal()
        if crease_angle < 180:
            settings.notFlippable = mesh.findCreaseEdges(math.radians(crease_angle))
        settings.projectOnOriginalMesh = True
        settings.packMesh = True
        meshlib.remesh(mesh, settings)
        meshlib.saveMesh(mesh, target)

    return run


PACKAGES = {"pymeshlab": with_pymeshlab, "pyacvd": with_pyacvd, "gpytoolbox": with_gpytoolbox,
            "powerrtf": with_powerrtf, "pyinstantmeshes": with_pyinstantmeshes,
            "pynanoinstantmeshes": with_pynanoinstantmeshes, "compas_cgal": with_compas_cgal,
            "mmgpy": with_mmgpy, "meshlib": with_meshlib}
ASKED_FOR_A_NUMBER = ("powerrtf", "pyacvd", "pyinstantmeshes", "pynanoinstantmeshes")


def main():
    package, source, target, density, size, crease_angle = sys.argv[1:]
    if size.isdigit() and package not in ASKED_FOR_A_NUMBER:
        mesh = read(source)
        size = math.sqrt(2 / math.sqrt(3) * mesh.area / int(size)) / mesh.length
    run = PACKAGES[package](density, float(size), float(crease_angle))
    before, start = memory(), time.process_time()
    run(source, target)
    print(json.dumps({"cpu": time.process_time() - start, "memory": memory() - before}))


if __name__ == "__main__":
    main()
