# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Other remeshers on the same models with the same number of vertices."""

import json
import math
import pathlib
import re
import shutil
import subprocess

from common import digest, notice
from runs import Failed, measured

HERE = pathlib.Path(__file__).resolve().parent
WITHIN = 0.01  # of the number of vertices asked for, where the search gets there
TOLERATED = 0.1  # else; beyond it, a mesh does not compare


class Peer:
    """A remesher with one knob `size`, of which the number of vertices is about a power. `call`:
    (model, target, density, size, crease_angle) -> command; `start`: (density, n) -> size."""

    def __init__(self, name, version, call, densities, start, ending=".off", inner=False):
        self.name, self.version, self.call = name, version, call
        self.densities, self.start = densities, start
        self.ending, self.inner = ending, inner

    def run(self, runner, name, model, density, n, crease_angle):
        """The run whose number of vertices is within 1 % of n, or the nearest one within 10 %."""
        identity = f"{self.name} {self.version} {density} {crease_angle} {digest(model)}"
        mesh = f"mesh{self.ending}"
        size, slope, last, best = self.start(density, n), None, None, None
        for attempt in range(12):
            result, folder = runner.keep(
                f"{self.name} {name} {density}, size {size:.6g}", f"{identity} {size!r}",
                model, mesh,
                lambda folder, size=size: self.once(
                    runner, self.call(model, folder / mesh, density, size, crease_angle)))
            vertices = max(result["vertices"], 1)
            if best is None or abs(vertices - n) < abs(best[0]["vertices"] - n):
                best = {**result, "attempts": attempt + 1}, folder
            if abs(vertices - n) <= WITHIN * n:
                break
            if last and vertices != last[1] and size != last[0]:
                slope = math.log(vertices / last[1]) / math.log(size / last[0])
            if slope is None or not 0.3 < abs(slope) < 4:
                slope = 1 if self.start("uniform", 2 * n) > self.start("uniform", n) else -2
            last = size, vertices
            size *= min(max((n / vertices) ** (1 / slope), 0.2), 5)
        nearest = best[0]["vertices"]
        if abs(nearest - n) > TOLERATED * n:
            raise Failed(f"no size gives about {n} vertices; the nearest: {nearest}")
        return best

    def once(self, runner, command):
        code, out, error, cpu, memory = measured(command, runner.limit)
        if code != 0:
            raise Failed(error.splitlines()[-1] if error else f"exit code {code}")
        if self.inner:
            inside = json.loads(out.splitlines()[-1])
            cpu, memory = inside["cpu"], inside["memory"]
        return {"cpu": cpu, "memory": memory}


def edge_length(density, n):
    """Of n vertices on a sphere, in units of its box's diagonal; or a first distance to it."""
    length = math.sqrt(2 / math.sqrt(3) * math.pi / n / 3)
    return length if density == "uniform" else 0.25 * length ** 2


def number(density, n):
    """For a tool that is asked for a number of vertices."""
    return n


# Peers that are Python packages: package, name, densities and why not both, first size.
PYTHON_PEERS = (
    ("pymeshlab", "pymeshlab", ("uniform",), edge_length,
     "its adaptive mode follows creases and gives smooth models the same mesh"),
    ("pyacvd", "pyacvd", ("uniform",), number,
     "its weights move the centroids (as of 0.4.0) instead of weighting the areas"),
    ("gpytoolbox", "gpytoolbox remesh_botsch", ("uniform",), edge_length, "it takes one length"),
    ("pyinstantmeshes", "Instant Meshes, pyinstantmeshes", ("uniform",), number,
     "it takes one length"),
    ("mmgpy", "mmgs, mmgpy", ("uniform", "curvature"), edge_length, ""),
    ("meshlib", "MeshLib", ("uniform",), edge_length, "it takes one length"),
)


def find(binaries, python, missing):
    """The peers that are there; says which are not and why."""
    peers = []
    version = cgal_version()
    for program, name, start, densities in (
            ("cgal_isotropic_remeshing", "CGAL isotropic_remeshing", edge_length,
             ("uniform", "curvature") if version and int(version.split(".")[0]) >= 6
             else ("uniform",)),
            ("cgal_mesh_3", "CGAL Mesh_3", edge_length, ("uniform", "curvature")),
            ("pmp_remeshing", "pmp-library", edge_length, ("uniform", "curvature"))):
        path = binaries / program
        if not path.exists():
            notice(f"Peer skipped: {name}: {path} is not built")
            continue
        peers.append(Peer(name, version if program.startswith("cgal") else "",
                          lambda model, target, density, size, crease_angle, path=path:
                          [path, model, target, density, repr(size), crease_angle],
                          densities, start))
        if "curvature" not in densities:
            notice(f"{name}: uniform only, an adaptive sizing needs CGAL 6 (here: {version})")
    for *description, why in PYTHON_PEERS:
        peers += python_peer(python, missing, *description)
        if why and description[0] not in missing:
            notice(f"{description[1]}: uniform only, {why}")
    skipped_bindings(python, missing)
    if vorpalite := shutil.which("vorpalite"):
        # The number of samples is asked for, so there is nothing to search. Its default profile
        # would stretch triangles along the curvature and close borders.
        peers.append(Peer("Geogram vorpalite", "",
                          lambda model, target, density, size, crease_angle:
                          [vorpalite, "remesh=true", "remesh:anisotropy=0",
                           "pre:max_hole_area=0", f"remesh:nb_pts={round(size)}",
                           f"remesh:gradation={0 if density == 'uniform' else 1}", model, target],
                          ("uniform", "curvature"), number, ".obj"))
    else:
        notice("Peer skipped: Geogram: there is no vorpalite in PATH")
    return peers


def python_peer(python, missing, package, name, densities, start):
    """The peer that is a Python package, as a list; empty, with a notice, where it is missing."""
    if python is None or package in missing:
        notice(f"Peer skipped: {package}: it cannot be installed here")
        return []
    return [Peer(name, python_package(python, package)["version"],
                 lambda model, target, density, size, crease_angle:
                 [python, HERE / "peer_python.py", package, model, target, density, repr(size),
                  crease_angle],
                 densities, start, ".ply", inner=True)]


def skipped_bindings(python, missing):
    """Geogram's Python bindings are a peer from the day on when they offer remeshing."""
    if python is None or "geogram" in missing:
        notice("Peer skipped: geogram (Python): it cannot be installed here")
        return
    package = python_package(python, "geogram", "--names")
    notice("Peer skipped: geogram (Python): " +
           ("its remeshing is not known to this driver yet"
            if any("remesh" in name for name in package["names"]) else
            f"version {package['version']} offers no remeshing"))


def python_package(python, *arguments):
    result = subprocess.run([python, HERE / "python_package.py", *arguments], capture_output=True,
                            text=True, check=True)
    return json.loads(result.stdout)


def cgal_version():
    """Of the headers that the compiler finds, which is what the peers are built with."""
    result = subprocess.run(["c++", "-E", "-dM", "-include", "CGAL/version.h", "-x", "c++", "-"],
                            capture_output=True, text=True, check=False, input="")
    found = re.search(r"#define CGAL_VERSION (\S+)", result.stdout)
    return found[1] if found else ""
