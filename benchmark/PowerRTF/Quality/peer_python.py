# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one of the peers that are Python packages, in an environment that has it.

peer_python.py pymeshlab|pyacvd INPUT OUTPUT.ply SIZE

SIZE: pymeshlab: the length of the edges in units of the diagonal of the bounding box; pyacvd: the
number of clusters. Prints JSON: CPU seconds and MiB of memory without the packages' import.
"""

import json
import resource
import sys
import time


def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def with_pymeshlab(source, target, size):
    import pymeshlab

    def remesh():
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(source)
        length = size * meshes.current_mesh().bounding_box().diagonal()
        meshes.meshing_isotropic_explicit_remeshing(
            targetlen=pymeshlab.PureValue(length), iterations=10)
        meshes.save_current_mesh(target)

    return remesh


def with_pyacvd(source, target, size):
    import numpy
    import pyacvd
    import pyvista

    def read():
        if not source.lower().endswith(".off"):
            mesh = pyvista.read(source)
            # only the geometry: data that came with the file would not survive the subdivision
            return pyvista.PolyData(mesh.points, mesh.faces).clean()
        with open(source, encoding="ascii") as file:
            words = " ".join(line.split("#")[0] for line in file).split()[1:]
        points, faces = int(words[0]), int(words[1])
        positions = numpy.array(words[3:3 + 3 * points], dtype=float).reshape(-1, 3)
        corners = numpy.array(words[3 + 3 * points:3 + 3 * points + 4 * faces], dtype=int)
        return pyvista.PolyData(positions, corners)

    def remesh():
        mesh = read()
        while mesh.n_points < 20 * size:  # as its documentation asks for
            mesh = mesh.subdivide(1, "linear")
        clustering = pyacvd.Clustering(mesh)
        clustering.cluster(round(size))
        clustering.create_mesh().save(target)

    return remesh


def main():
    name, source, target, size = sys.argv[1:]
    prepare = {"pymeshlab": with_pymeshlab, "pyacvd": with_pyacvd}[name]
    remesh = prepare(source, target, float(size))
    before, start = memory(), time.process_time()
    remesh()
    print(json.dumps({"cpu": time.process_time() - start, "memory": memory() - before}))


if __name__ == "__main__":
    main()
