#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the README's picture and animation: an input, the cells of its samples and the new mesh.

hero.py [MODEL [FOLDER]]   hero.png, hero.webp

The defaults are CGAL's bull, as ./run_tests fetches it, and this folder. Needs powerrtf, PyVista and
what render.py needs.
"""

import math
import pathlib
import sys

import render  # first: it chooses how to draw without a display
import numpy
from matplotlib.colors import LinearSegmentedColormap
import PIL.Image
import pyvista

import powerrtf

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE.parents[2] / "build/data/meshes/bull.off"
SAMPLES = 5000
AZIMUTH, SWING, ELEVATION = 12, 25, 12  # degrees
COLORS = "#f6efe0", "#f3c98b", "#e9845f", "#b5344a", "#5d1a52"  # from few samples to many
PICTURE = 1500, 800
ANIMATION = 720, 384
FRAMES, MILLISECONDS = 72, 80
SLOPE = 0.25  # of the lines between the three: so much to the left for each pixel down


def stages(surface):
    """What is drawn, one after the other: each a list of meshes with the arguments of `add_mesh`."""
    result = powerrtf.remesh(surface, n=SAMPLES, seed=1)
    mesh, cells = result.to_pyvista(), result.cells().to_pyvista()
    cells = cells.extract_cells(cells["status"] == 0)
    density = numpy.log(cells["density"])
    edges = {"show_edges": True, "edge_color": "#202020"}
    plain = {"color": "#e9dcc3", **edges}
    colored = {"scalars": density, "clim": numpy.percentile(density, (2, 98)), "show_scalar_bar": False,
               "cmap": LinearSegmentedColormap.from_list("density", COLORS), **edges}
    # between the cells, which are flat, the surface inside is seen
    inside = mesh.compute_normals(cell_normals=False, auto_orient_normals=False, split_vertices=False)
    inside.points -= 0.004 * mesh.length * inside["Normals"]
    return [(surface, plain)], [(cells, colored), (inside, {"color": "#8c5a4a"})], [(mesh, plain)]


def draw(stage, view, size, line_width):
    plotter = pyvista.Plotter(off_screen=True, lighting="light kit", window_size=size)
    plotter.set_background("white")
    for mesh, appearance in stage:
        plotter.add_mesh(mesh, line_width=line_width, ambient=0.3, diffuse=0.8, specular=0.1, **appearance)
    plotter.camera = view
    plotter.enable_anti_aliasing("ssaa")
    plotter.reset_camera_clipping_range()
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    return picture


def side_by_side(pictures, first, second):
    """The first picture up to the line `first`, the second from there to `second`, then the third. The
    lines are where they cross half the height, in widths."""
    height, width = pictures[0].shape[:2]
    x = numpy.arange(width) + SLOPE * (numpy.arange(height)[:, None] - height / 2)
    result = pictures[0].astype(float)
    for picture, line in zip(pictures[1:], (first, second)):
        share = numpy.clip(x - line * width, 0, 1)[..., None]
        result += share * (picture - result)
    return PIL.Image.fromarray(result.round().astype(numpy.uint8))


def main():
    model, folder = (pathlib.Path(a) for a in (sys.argv[1:] + [MODEL, HERE][len(sys.argv) - 1:]))
    surface = render.read(str(model))
    drawn = stages(surface)
    _, half_width, half_height = render.camera(surface, AZIMUTH, ELEVATION, "y", 1)

    def pictures(azimuth, size, line_width):
        view, *_ = render.camera(surface, azimuth, ELEVATION, "y", 1)
        view.parallel_scale = 1.08 * max(half_height, half_width * size[1] / size[0])
        return [draw(stage, view, size, line_width) for stage in drawn]

    picture = side_by_side(pictures(AZIMUTH, PICTURE, 1.2), 0.36, 0.64)
    picture.quantize(256, kmeans=1).save(folder / "hero.png", optimize=True)

    # The lines come in from the right and go back while the model swings.
    frames = []
    for frame in range(FRAMES):
        turn = 2 * math.pi * frame / FRAMES
        middle = 0.5 + 0.8 * math.cos(turn)
        frames.append(side_by_side(pictures(AZIMUTH + SWING * math.sin(turn), ANIMATION, 0.7),
                                   middle - 0.14, middle + 0.14))
    frames[0].save(folder / "hero.webp", save_all=True, append_images=frames[1:], loop=0,
                   duration=MILLISECONDS, quality=60, method=6)


if __name__ == "__main__":
    main()
