# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The models of the paper, and mechanical parts: found in folders by their file's name, or made
here.

models.py FOLDER    writes those made here: disc.off, close_hemisphere.off, three_holes.off
"""

import math
import pathlib
import sys

ENDINGS = (".off", ".obj", ".ply", ".stl")

# The file names (without ending, lower case) that each model goes by.
NAMES = {
    "Kitten": ("kitten",),
    "Armchair": ("armchair",),
    "StandingCat": ("standingcat", "standing_cat"),
    "Homer": ("homer",),
    "Rocker": ("rocker_arm", "rocker-arm", "rockerarm", "rocker"),
    "Retinal": ("retinal",),
    "Fertility": ("fertility",),
    "Elk": ("elk",),
    "Armadillo": ("armadillo",),
    "Bunny": ("bunny", "bunny00"),
    "Dragon": ("dragon", "chinesedragon-10kv"),
    "Eight": ("eight",),
    "Fish": ("fish",),
    "David Head": ("david_head", "davidhead", "david"),
    "Gargoyle": ("gargoyle",),
    "Fandisk": ("fandisk",),
    "Gear": ("gear_chamfered",),
    "Bracket": ("bracket",),
    "Plate": ("plate",),
}


class Models:
    """Paths of models by their names in the paper. The first folder that has one wins."""

    def __init__(self, folders, generated_folder):
        self.generated = pathlib.Path(generated_folder)
        self.generated.mkdir(parents=True, exist_ok=True)
        self.paths = {}
        found = {}
        for folder in folders:
            for path in sorted(pathlib.Path(folder).glob("*")):
                if path.suffix.lower() in ENDINGS:
                    found.setdefault(path.stem.lower(), path)
        for model, names in NAMES.items():
            for name in names:
                if name in found:
                    self.paths.setdefault(model, found[name])
        for model, make in GENERATED.items():
            path = self.generated / (model.lower().replace(" ", "_") + ".off")
            if not path.exists():
                write_off(path, *make())
            self.paths[model] = path

    def get(self, name):
        return self.paths.get(name)

    def first(self, *names):
        """The first of these that can be had, or else one that always can."""
        return next((name for name in names if name in self.paths), "Three Holes")


def write_off(path, points, faces):
    lines = [f"OFF\n{len(points)} {len(faces)} 0"]
    lines += [" ".join(repr(x) for x in point) for point in points]
    lines += [f"{len(face)} " + " ".join(map(str, face)) for face in faces]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def lathe(profile, spacing):
    """A closed surface of revolution around the z axis. `profile`: (radius, z) from pole to pole,
    counter-clockwise seen with the axis on the left; the facets' size is about `spacing`."""
    points, rings = [], []
    for radius, z in profile:
        count = 1 if radius == 0 else max(6, round(2 * math.pi * radius / spacing))
        rings.append(range(len(points), len(points) + count))
        for k in range(count):
            angle = 2 * math.pi * k / count
            points.append((radius * math.cos(angle), radius * math.sin(angle), z))
    faces = []
    for low, high in zip(rings, rings[1:]):
        i = j = 0
        while i < len(low) or j < len(high):
            a, b = low[i % len(low)], high[j % len(high)]
            step_low = len(high) == 1 or (len(low) > 1 and i < len(low) and
                                          (i + 1) * len(high) <= (j + 1) * len(low))
            if step_low:
                faces.append((a, low[(i + 1) % len(low)], b))
                i += 1
            else:
                faces.append((a, high[(j + 1) % len(high)], b))
                j += 1
            if (len(low) == 1 and j == len(high)) or (len(high) == 1 and i == len(low)):
                break
    return points, faces


def arc(center, radius, start, stop, steps):
    """Points of an arc in the (radius, z) plane, angles in degrees, both ends included."""
    angles = [math.radians(start + (stop - start) * k / steps) for k in range(steps + 1)]
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]


def disc():
    """A disc of radius 1 and thickness 0.02 with a round rim: two close sheets."""
    half, rings = 0.01, 50
    flat = [k * (1 - half) / rings for k in range(rings)]
    profile = [(r, -half) for r in flat] + arc((1 - half, 0), half, -90, 90, 8)
    return lathe(profile + [(r, half) for r in reversed(flat)], 1 / rings)


def hemisphere():
    """Half of a spherical shell of radius 1 and thickness 0.02 with a round rim."""
    half, steps = 0.01, 80
    outer = arc((0, 0), 1 + half, -90, 0, steps)
    inner = arc((0, 0), 1 - half, 0, -90, steps)
    rim = arc((1, 0), half, 0, 180, 8)
    profile = [(0.0, -1 - half)] + outer[1:-1] + rim + inner[1:-1] + [(0.0, -1 + half)]
    return lathe(profile, 1 / 50)


def three_holes():
    """A smooth plate with three holes (genus 3): Catmull-Clark's limit of 7 x 3 cubes."""
    cells = {(x, y) for x in range(7) for y in range(3)} - {(1, 1), (3, 1), (5, 1)}
    index, points, faces = {}, [], []

    def vertex(*p):
        if p not in index:
            index[p] = len(points)
            points.append(tuple(map(float, p)))
        return index[p]

    for x, y in sorted(cells):
        faces.append(tuple(vertex(x + a, y + b, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))))
        faces.append(tuple(vertex(x + a, y + b, 0) for a, b in ((0, 0), (0, 1), (1, 1), (1, 0))))
        for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            if (x + dx, y + dy) in cells:
                continue
            cx, cy = x + (1 + dx) / 2, y + (1 + dy) / 2  # middle of the side, which runs to the left
            a = (round(cx + dy / 2), round(cy - dx / 2))
            b = (round(cx - dy / 2), round(cy + dx / 2))
            faces.append((vertex(*a, 0), vertex(*b, 0), vertex(*b, 1), vertex(*a, 1)))
    for _ in range(4):
        points, faces = catmull_clark(points, faces)
    return points, [t for f in faces for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]


def catmull_clark(points, faces):
    """One step on a closed mesh."""

    def mean(items):
        return tuple(sum(c) / len(items) for c in zip(*items))

    centers = [mean([points[v] for v in f]) for f in faces]
    edge_faces, of_vertex = {}, [[] for _ in points]
    for k, f in enumerate(faces):
        for a, b in zip(f, f[1:] + f[:1]):
            edge_faces.setdefault((min(a, b), max(a, b)), []).append(k)
            of_vertex[a].append(k)
    middles = [[] for _ in points]
    result, edge_index = [], {}
    for (a, b) in edge_faces:
        middle = mean([points[a], points[b]])
        middles[a].append(middle)
        middles[b].append(middle)
    for v, p in enumerate(points):
        n = len(of_vertex[v])
        q, r = mean([centers[k] for k in of_vertex[v]]), mean(middles[v])
        result.append(tuple((q[c] + 2 * r[c] + (n - 3) * p[c]) / n for c in range(3)))
    for edge, around in edge_faces.items():
        edge_index[edge] = len(result)
        result.append(mean([points[edge[0]], points[edge[1]], *[centers[k] for k in around]]))
    first = len(result)
    result += centers
    quads = []
    for k, f in enumerate(faces):
        for p, a, b in zip(f[-1:] + f[:-1], f, f[1:] + f[:1]):
            quads.append((a, edge_index[min(a, b), max(a, b)], first + k,
                          edge_index[min(a, p), max(a, p)]))
    return result, quads


GENERATED = {"Disc": disc, "Close Hemisphere": hemisphere, "Three Holes": three_holes}


if __name__ == "__main__":
    Models([], sys.argv[1])
