# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a run, by its text and in a browser without a network."""
import json
import os
import re
import shutil
import subprocess

import numpy as np
import pytest

import powerrtf
from shapes import FACES, POINTS

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@pytest.fixture(scope="module")
def mesh():
    return powerrtf.remesh(POINTS, FACES, 200, seed=1)


@pytest.fixture(scope="module")
def page(mesh, tmp_path_factory):
    file = tmp_path_factory.mktemp("page") / "page.html"
    powerrtf.report_html(mesh, file)
    return file


def data_of(file):
    text = file.read_text()
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text,
                                re.S).group(1))


def decoded(text, kind):
    import base64
    return np.frombuffer(base64.b64decode(text), kind)


def test_page_has_both_meshes_and_needs_nothing_else(page):
    data = data_of(page)
    assert decoded(data["output"]["points"], "<f4").shape == (600,)
    assert decoded(data["input"]["faces"], "<i4").shape == (3 * len(FACES),)
    assert decoded(data["output"]["distance"], "<f4").max() < .1
    assert data["report"]["vertices"] == 200
    assert not re.search(r"(src|href)=|https?://", page.read_text())
    assert page.stat().st_size < 200000


def test_page_has_the_cells(mesh, page):
    data = data_of(page)
    assert np.array_equal(decoded(data["cells"]["sides"], "<i4"), mesh.cells().sides)
    corners = data["unit"] * decoded(data["cells"]["points"], "<f4").reshape(-1, 3)
    expected = mesh.cells().points - (POINTS.min(0) + POINTS.max(0)) / 2
    assert np.abs(corners - expected).max() < 1e-6


def test_page_of_the_program(mesh, tmp_path):
    program = os.environ.get("POWER_RTF_REMESH")
    if not program:
        pytest.skip("POWER_RTF_REMESH does not name the program")
    source = tmp_path / "in.off"
    powerrtf._core.write_mesh(str(source), POINTS, FACES.astype(np.int64), False)
    subprocess.run([program, source, tmp_path / "out.off", "-n", "200", "--seed", "1", "--quiet",
                    "--html", tmp_path / "page.html"], check=True)
    data = data_of(tmp_path / "page.html")
    assert decoded(data["output"]["faces"], "<i4").shape == (3 * 396,)
    assert np.array_equal(decoded(data["cells"]["sides"], "<i4"), mesh.cells().sides)


def test_notebook_shows_the_page():
    shown = powerrtf.remesh(POINTS, FACES, 200).show(height=500)._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and 'height="500"' in shown


def browse(address, folder, *arguments):
    # profile and all else in the test's folder; software rendering: there need not be a GPU
    return subprocess.run(
        [BROWSER, "--headless", "--no-sandbox", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--window-size=1000,1200", "--virtual-time-budget=5000",
         f"--user-data-dir={folder}", *arguments, address],
        check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=120, text=True).stdout


def colorful(address, folder):
    """Which pixels of the view's halves have color; the background is gray, a surface has color."""
    browse(address, folder / "profile", f"--screenshot={folder / 'page.png'}")
    image = pytest.importorskip("matplotlib.image").imread(str(folder / "page.png"))
    return [np.ptp(half[..., :3], axis=2) > .2 for half in (image[120:700, 30:480], image[120:700, 520:970])]


@pytest.mark.skipif(not BROWSER, reason="no Chromium here")
def test_browser_shows_the_page(page, tmp_path):
    shown = browse(page.as_uri(), tmp_path / "profile", "--dump-dom")
    # four charts, and the script that makes them
    assert shown.count("<figure>") == 5 and shown.count("Q 0.") == 15
    assert "Every guarantee is met." in shown and 'id="no-view" hidden' in shown
    for half in colorful(page.as_uri(), tmp_path):
        assert half.mean() > .1


@pytest.mark.skipif(not BROWSER, reason="no Chromium here")
def test_browser_shows_the_cells(page, tmp_path):
    left, right = colorful(page.as_uri() + "#cells", tmp_path)
    assert not left.any() and .02 < right.mean() < .2  # the input is gray, and most cells are hexagons
