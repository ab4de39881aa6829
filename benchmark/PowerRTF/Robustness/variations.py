#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write what may become of meshes on their way to a user, as meshes for robustness.py.

variations.py FOLDER                       of CGAL's models: each with each defect
variations.py FOLDER FOLDER_OR_FILE ...    of others
variations.py FOLDER --defects noise fins  these defects alone
variations.py FOLDER --seed 1              other choices, by chance as all of them

Files that are no OFF files are left out, and what a defect leaves no facet of. The names are
MODEL-DEFECT.off. Needs nothing beside Python.
"""

import argparse
import math
import os
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import DATA  # noqa: E402
from robustness import meshes  # noqa: E402


def read_off(file):
    """Points and facets of an OFF file; None if it is none."""
    lines = (line.split("#")[0].split() for line in
             file.read_text(encoding="utf-8", errors="replace").splitlines())
    words = iter([word for line in lines for word in line])
    try:
        if next(words) != "OFF":
            return None
        vertices, facets, _ = (int(next(words)) for _ in range(3))
        points = [tuple(float(next(words)) for _ in range(3)) for _ in range(vertices)]
        return points, [[int(next(words)) for _ in range(int(next(words)))]
                        for _ in range(facets)]
    except (StopIteration, ValueError):  # it ends too early, or has more than points and facets
        return None


def write_off(file, points, facets):
    with open(file, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(points)} {len(facets)} 0\n")
        out.writelines("{!r} {!r} {!r}\n".format(*p) for p in points)
        out.writelines(" ".join(map(str, [len(f), *f])) + "\n" for f in facets)


def diagonal(points):
    return math.dist(*(tuple(best(p[k] for p in points) for k in range(3)) for best in (min, max)))


def mean_edge(points, facets):
    lengths = [math.dist(points[f[k - 1]], points[f[k]]) for f in facets for k in range(len(f))]
    return sum(lengths) / len(lengths)


def some(facets, share, chance):
    """The numbers of so many facets, at least one."""
    return chance.sample(range(len(facets)), max(1, int(share * len(facets))))


# The defects: functions of points, facets and a source of random numbers.


def noise(points, facets, chance, share=0.1):
    """The vertices are moved by some of an edge, as in a scan."""
    size = share * mean_edge(points, facets)
    return [tuple(x + chance.gauss(0, size) for x in p) for p in points], facets


def strong_noise(points, facets, chance):
    return noise(points, facets, chance, 0.3)


def holes(points, facets, chance):
    """Single facets are missing."""
    missing = set(some(facets, 0.01, chance))
    return points, [f for i, f in enumerate(facets) if i not in missing]


def cut_out(points, facets, chance):
    """What is in a ball is missing."""
    center = chance.choice(points)
    radius = chance.uniform(0.1, 0.3) * diagonal(points)
    return points, [f for f in facets if math.dist(points[f[0]], center) > radius]


def copies(points, facets, chance):
    """A second copy of all of it, shifted by less than its size: both intersect."""
    shift = [chance.uniform(-0.2, 0.2) * diagonal(points) for _ in range(3)]
    moved = [tuple(x + d for x, d in zip(p, shift)) for p in points]
    return points + moved, facets + [[v + len(points) for v in f] for f in facets]


def flipped(points, facets, chance):
    """Some facets have the other direction."""
    turned = set(some(facets, 0.05, chance))
    return points, [f[::-1] if i in turned else f for i, f in enumerate(facets)]


def doubled(points, facets, chance):
    """Some facets are there twice."""
    return points, facets + [facets[i] for i in some(facets, 0.05, chance)]


def fins(points, facets, chance):
    """Triangles stand on some edges, outside."""
    size, points, facets = mean_edge(points, facets), list(points), list(facets)
    for i in chance.sample(range(len(facets)), min(20, len(facets))):
        a, b, c = (points[v] for v in facets[i][:3])
        u, w = ([q - p for p, q in zip(a, end)] for end in (b, c))
        normal = [u[k - 2] * w[k - 1] - u[k - 1] * w[k - 2] for k in range(3)]
        scale = size * chance.uniform(0.5, 1.5) / (math.hypot(*normal) or 1)
        points.append(tuple((x + y) / 2 + scale * d for x, y, d in zip(a, b, normal)))
        facets.append([*facets[i][:2], len(points) - 1])
    return points, facets


def soup(points, facets, _):
    """Each facet has vertices of its own."""
    return ([points[v] for f in facets for v in f],
            [list(range(begin, begin + len(f)))
             for begin, f in zip(_sums(map(len, facets)), facets)])


def _sums(sizes):
    total = 0
    for size in sizes:
        yield total
        total += size


def rounded(points, facets, _):
    """The coordinates have few digits: facets without area, and folds."""
    step = diagonal(points) / 200
    return [tuple(round(x / step) * step for x in p) for p in points], facets


def stretched(points, facets, _):
    """Thin, and in no axis of the coordinates."""
    return [(x + y, y - x, 0.05 * (z + x)) for x, y, z in points], facets


def slivers(points, facets, chance):
    """Some vertices lie upon a neighbor."""
    points = list(points)
    for i in some(facets, 0.02, chance):
        points[facets[i][0]] = points[facets[i][1]]
    return points, facets


DEFECTS = {f.__name__: f for f in (noise, strong_noise, holes, cut_out, copies, flipped, doubled, fins,
                                   soup, rounded, stretched, slivers)}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("meshes", nargs="*", metavar="FOLDER_OR_FILE",
                        default=[os.environ.get("POWER_RTF_DATA", str(DATA))])
    parser.add_argument("--defects", nargs="+", choices=DEFECTS, default=list(DEFECTS))
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    written = 0
    for file in meshes(options.meshes, float("inf")):
        mesh = read_off(file)
        if not mesh or not mesh[1]:
            continue
        for name in options.defects:
            # by name: the choices are the same whatever else is made
            chance = random.Random(f"{file.stem} {name} {options.seed}")
            points, facets = DEFECTS[name](*mesh, chance)
            if facets:
                write_off(options.folder / f"{file.stem}-{name}.off", points, facets)
                written += 1
    print(f"{written} meshes in {options.folder}")
    return 0 if written else 77


if __name__ == "__main__":
    sys.exit(main())
