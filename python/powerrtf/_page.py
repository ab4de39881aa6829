# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A run as a page to look at."""

import html
import json
import os

from . import _core
from ._options import merged


def html_page(mesh):
    """The page as bytes."""
    *given, options = mesh._given
    options = merged(options, {"n": len(mesh.vertices)})
    return _core.html_page(*given, options, *mesh._arrays(), mesh._sites,
                           json.dumps(mesh.report.to_dict()))


def report_html(mesh, file):
    """Writes a page about a result that any browser shows without a network: input and output side by
    side, turned together, colored by quality, distance, area or density, or the cells by their sides;
    histograms of angles, quality, lengths and distances; the report; and the worst triangles, to jump to.
    ``#cells`` or the like after the page's address chooses the color.

    :param mesh: the :class:`Mesh`; the arrays it was made of must not have been changed since
    :param file: the file's name

    >>> import powerrtf, os, tempfile
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> mesh = powerrtf.remesh(square, [[0, 1, 2, 3]], 100)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     powerrtf.report_html(mesh, os.path.join(folder, "square.html"))
    ...     os.listdir(folder)
    ['square.html']
    """
    page = html_page(mesh)
    with open(os.fspath(file), "wb") as out:
        out.write(page)


class Page:
    """What a notebook shows, in a frame of its own."""

    def __init__(self, page, height):
        self._page = page
        self._height = height

    def _repr_html_(self):
        text = html.escape(self._page.decode(), quote=True)
        return (f'<iframe srcdoc="{text}" width="100%" height="{self._height}" '
                'style="border: 0"></iframe>')
