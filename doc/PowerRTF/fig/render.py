#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw a polygon mesh (OFF, OBJ, PLY, STL, VTP) to a PNG, without a display.

render.py mesh.off mesh.png --edges
render.py cells.vtp cells.png --edges --color-by sides
render.py mesh.off lattice.png --lattice fields.vtp

Needs PyVista (python3 -m venv venv; venv/bin/pip install pyvista) and, where there is no display,
Mesa's EGL (Debian, Ubuntu: apt-get install libegl1 libgl1-mesa-dri).
"""

import argparse
import math
import os
import sys

if sys.platform == "linux" and not os.environ.get("DISPLAY"):
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

import numpy
import PIL.Image
import pyvista


def read_off(path):
    """The mesh of an OFF file of any of its dialects that start with points (OFF, COFF, NOFF)."""
    with open(path, encoding="ascii") as file:
        lines = (line.split("#")[0].split() for line in file)
        lines = [line for line in lines if line]
    if lines[0][0].upper().endswith("OFF"):
        lines[0] = lines[0][1:]
        if not lines[0]:
            del lines[0]
    points, faces = int(lines[0][0]), int(lines[0][1])
    positions = numpy.array([line[:3] for line in lines[1 : 1 + points]], dtype=float)
    flat = []
    for line in lines[1 + points : 1 + points + faces]:
        flat.extend(int(index) for index in line[: int(line[0]) + 1])
    return pyvista.PolyData(positions, faces=numpy.array(flat))


def read(path):
    mesh = read_off(path) if path.lower().endswith(".off") else pyvista.read(path)
    mesh = mesh if isinstance(mesh, pyvista.PolyData) else mesh.extract_surface()
    if mesh.n_cells == 0:
        sys.exit(f"{path}: no facet to draw")
    return mesh


def sides(mesh):
    """The number of sides of each polygon, at most 8 and at least 4."""
    return numpy.clip(numpy.diff(mesh.GetPolys().GetOffsetsArray()), 4, 8)


def camera(mesh, azimuth, elevation, up, zoom):
    """A view from outside, `azimuth` degrees around the axis `up`, `elevation` degrees above."""
    axis = "xyz".index(up)
    a, e = math.radians(azimuth), math.radians(elevation)
    direction, upwards = numpy.zeros(3), numpy.zeros(3)
    direction[axis] = math.sin(e)
    direction[(axis + 1) % 3] = math.cos(e) * math.cos(a)
    direction[(axis + 2) % 3] = math.cos(e) * math.sin(a)
    upwards[axis] = math.cos(e)
    upwards[(axis + 1) % 3] = -math.sin(e) * math.cos(a)
    upwards[(axis + 2) % 3] = -math.sin(e) * math.sin(a)

    right = numpy.cross(upwards, direction)
    positions = numpy.asarray(mesh.points)
    center = numpy.zeros(3)
    extent = []
    for along in (right, upwards, direction):
        s = positions @ along
        center += along * (s.min() + s.max()) / 2
        extent.append((s.max() - s.min()) / 2)
    result = pyvista.Camera()
    result.focal_point = center
    result.position = center + direction * (3 * max(extent))
    result.up = upwards
    result.parallel_projection = True
    return result, extent[0] / zoom, extent[1] / zoom


def draw_lattice(plotter, path, view):
    """What the program's --fields wrote: its lines and points, and on them where rows end."""
    towards_viewer = -numpy.asarray(view.direction)
    fields = pyvista.read(path)
    fields = fields.extract_cells(fields["normal"] @ towards_viewer > 0.1)
    # What, the radius of its discs in spacings (0: its lines), color; from below to above.
    layers = [(fields["dislocation"] > 0, 0.3, "#f5a300"),
              (fields["index"] > 0, 0.3, "#1f5fd0"),
              (fields["index"] < 0, 0.3, "#d01c1c"),
              (fields["is_point"] == 0, 0, "#6b737e"),
              (fields["is_point"] == 1, 0.13, "#101010")]
    for level, (which, radius, color) in enumerate(layers, start=2):
        if not which.any():
            continue
        layer = fields.extract_cells(which)
        if radius:
            disc = pyvista.Disc(inner=0, outer=radius, normal=(1, 0, 0), c_res=24)
            layer = layer.cell_centers().glyph(orient="normal", scale="spacing", geom=disc)
        # Nearer to the viewer than the mesh: in a parallel projection nothing else changes.
        layer.points += 0.04 * level * fields["spacing"].mean() * towards_viewer
        plotter.add_mesh(layer, color=color, lighting=False, line_width=1.3)


def board():
    """A texture of four by four squares, of other colors along both sides."""
    u, v = numpy.meshgrid(numpy.arange(512) / 512, numpy.arange(512) / 512)
    dark = (numpy.floor(4 * u) + numpy.floor(4 * v)) % 2
    image = numpy.stack([0.95 - 0.5 * u, 0.8 - 0.2 * v, 0.4 + 0.5 * u], axis=-1)
    return pyvista.Texture(numpy.uint8(255 * image * (1 - 0.35 * dark[..., None])))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("mesh")
    parser.add_argument("image")
    parser.add_argument("--edges", action="store_true", help="draw the edges")
    parser.add_argument("--edge-width", type=float, default=1.0, help="in pixels (default: 1)")
    parser.add_argument("--color-by", metavar="FIELD",
                        help="a value per facet or vertex in a VTP file, or: sides (of the polygon)")
    parser.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"),
                        help="of the colors; default: the 2nd to the 98th percentile")
    parser.add_argument("--color", default="#e9dcc3", help="where there is no --color-by")
    parser.add_argument("--texture", action="store_true",
                        help="draw a board of squares by the mesh's texture coordinates")
    parser.add_argument("--dots", metavar="FILE", help="red dots at the points of a mesh's file")
    parser.add_argument("--lattice", metavar="FILE",
                        help="drawn on the mesh, which is smooth then: the program's --fields")
    parser.add_argument("--up", choices="xyz", default="y", help="the model's axis (default: y)")
    parser.add_argument("--azimuth", type=float, default=60, help="degrees around it (default: 60)")
    parser.add_argument("--elevation", type=float, default=15, help="degrees above (default: 15)")
    parser.add_argument("--zoom", type=float, default=1, help="1: all of it (default)")
    parser.add_argument("--height", type=int, default=900, help="in pixels (default: 900)")
    parser.add_argument("--aspect", type=float, help="width / height; default: the model's own")
    parser.add_argument("--palette", type=int, metavar="N",
                        help="at most N colors, which makes a smaller file (default: all)")
    options = parser.parse_args()

    mesh = read(options.mesh)
    view, half_width, half_height = camera(mesh, options.azimuth, options.elevation, options.up,
                                           options.zoom)
    # A whole model gets a margin, and a picture of its own shape unless another one is asked for.
    aspect = options.aspect or half_width / half_height
    view.parallel_scale = 1.03 * max(half_height, half_width / aspect)
    plotter = pyvista.Plotter(off_screen=True, lighting="light kit",
                              window_size=(round(options.height * aspect), options.height))
    plotter.set_background("white")

    appearance = {"color": options.color}
    if options.color_by == "sides":
        appearance = {"scalars": sides(mesh), "clim": (3.5, 8.5), "n_colors": 5,
                      "cmap": ["#7b3294", "#5b8fd6", "#f2ead7", "#e9845f", "#a50f15"]}
    elif options.color_by:
        if options.color_by not in mesh.array_names:
            sys.exit(f"{options.mesh}: no value {options.color_by}; there are: "
                     + ", ".join(["sides", *mesh.array_names]))
        values = numpy.asarray(mesh[options.color_by], dtype=float)
        appearance = {"scalars": values, "cmap": "viridis",
                      "clim": options.range or numpy.nanpercentile(values, (2, 98))}
    if options.texture:
        appearance = {"texture": board()}
    plotter.add_mesh(mesh, show_edges=options.edges, edge_color="#202020",
                     line_width=options.edge_width, show_scalar_bar=False, ambient=0.3,
                     diffuse=0.8, specular=0.1, smooth_shading=bool(options.lattice), **appearance)
    if options.lattice:
        draw_lattice(plotter, options.lattice, view)
    if options.dots:
        dots = pyvista.PolyData(numpy.asarray(pyvista.read(options.dots).points))
        plotter.add_mesh(dots.glyph(geom=pyvista.Sphere(radius=0.007 * mesh.length), scale=False,
                                    orient=False), color="#d01c1c")
    plotter.camera = view
    plotter.enable_anti_aliasing("ssaa")
    plotter.reset_camera_clipping_range()
    picture = PIL.Image.fromarray(plotter.screenshot(return_img=True))
    if options.palette:
        picture = picture.quantize(options.palette, kmeans=1)
    picture.save(options.image, optimize=True)


if __name__ == "__main__":
    main()
