#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much the areas of labels change: the largest error of any label, and of those that have at least
200 triangles in the result.

label_areas.py PROGRAM MODELS [N [NAME.off ...]]

MODELS: the folder of CGAL's meshes. The labels are bands across each axis, octants, a board of squares, and
the parts that are nearest to eight random points; each is a label of its own.
"""

import pathlib
import random
import subprocess
import sys
import tempfile

LARGE = 200  # triangles


def read_off(file):
    """Points and faces, as the file has them."""
    words = file.read_text(encoding="ascii").split()
    points, faces = int(words[1]), int(words[2])
    corners = words[4 + 3 * points:]
    return ([words[4 + 3 * v:7 + 3 * v] for v in range(points)],
            [[int(v) for v in corners[4 * f + 1:4 * f + 4]] for f in range(faces)])


def fields():
    """The names of some ways to label, and functions of a place in a box of size 1 around the origin."""
    for axis, name in enumerate("xyz"):
        yield f"bands across {name}", lambda *p, axis=axis: int(6 * (p[axis] + .5))
    yield "octants", lambda x, y, z: (x > 0) + 2 * (y > 0) + 4 * (z > 0)
    yield "board", lambda x, y, z: sum(int(4 * (t + 1)) for t in (x, y, z)) % 3
    source = random.Random(8)
    seeds = [[source.uniform(-.5, .5), source.uniform(-.5, .5), source.uniform(-.3, .3)] for _ in range(8)]
    yield "nearest points", lambda *p: min(
        range(8), key=lambda k: sum((a - b) ** 2 for a, b in zip(seeds[k], p)))


def write_ply(file, points, faces, labels):
    file.write_text(
        f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
        f"property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\n"
        "property int part\nend_header\n" + "".join(" ".join(p) + "\n" for p in points)
        + "".join(f"3 {a} {b} {c} {k}\n" for (a, b, c), k in zip(faces, labels)), encoding="ascii")


def areas(file):
    """The area of each label of a PLY file as text, and how many triangles have it."""
    header, body = file.read_text(encoding="ascii").split("end_header\n")
    points = int(header.split("element vertex ")[1].split()[0])
    rows = [line.split() for line in body.splitlines()]
    xyz = [[float(x) for x in row] for row in rows[:points]]
    result = {}
    for _, *corners, label in rows[points:]:
        a, b, c = (xyz[int(v)] for v in corners)
        u, v = [s - t for s, t in zip(b, a)], [s - t for s, t in zip(c, a)]
        normal = [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]
        area, count = result.get(label, (0, 0))
        result[label] = area + sum(x * x for x in normal) ** .5 / 2, count + 1
    return result


def main():
    program, models, *rest = sys.argv[1:]
    n, *names = rest or ["3000"]
    print("| model | labels | density | largest error | triangles | of large labels |\n"
          "| --- | --- | --- | ---: | ---: | ---: |")
    for name in names or ["elk.off", "bunny00.off", "fandisk.off"]:
        points, faces = read_off(pathlib.Path(models) / name)
        xyz = [[float(x) for x in p] for p in points]
        low, high = [min(x) for x in zip(*xyz)], [max(x) for x in zip(*xyz)]
        size = max(b - a for a, b in zip(low, high))
        centers = [[(sum(xyz[v][k] for v in f) / 3 - (low[k] + high[k]) / 2) / size for k in range(3)]
                   for f in faces]
        for labels, field in fields():
            for density in "curvature", "uniform":
                with tempfile.TemporaryDirectory() as folder:
                    before, after = pathlib.Path(folder) / "in.ply", pathlib.Path(folder) / "out.ply"
                    write_ply(before, points, faces, [field(*c) for c in centers])
                    subprocess.run([program, before, after, "-n", n, "--density", density, "--labels", "part",
                                    "--ascii", "--quiet"], check=False, stderr=subprocess.DEVNULL)
                    old, new = areas(before), areas(after)
                errors = {k: 100 * abs(new.get(k, (0, 0))[0] / old[k][0] - 1) for k in old}
                worst = max(errors, key=errors.get)
                large = max((errors[k] for k in new if new[k][1] >= LARGE), default=0)
                print(f"| {name} | {labels} | {density} | {errors[worst]:.2f} % | "
                      f"{new.get(worst, (0, 0))[1]} | {large:.2f} % |", flush=True)


if __name__ == "__main__":
    main()
