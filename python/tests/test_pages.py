# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide and the reference as HTML pages."""
import re
import subprocess
import sys
from pathlib import Path

import pytest

import powerrtf
import powerrtf.dataset

SOURCE = Path(__file__).resolve().parents[2] / "doc" / "PowerRTF"


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    if not (SOURCE / "conf.py").exists():
        pytest.skip("the repository is not here")
    for module in ("sphinx", "myst_parser", "furo", "pyvista"):
        pytest.importorskip(module)
    folder = tmp_path_factory.mktemp("pages")
    run = subprocess.run([sys.executable, "-B", "-m", "sphinx", "-W", "--keep-going", SOURCE, folder],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert run.returncode == 0, run.stdout
    return {file.name: file.read_text() for file in folder.glob("*.html")}, folder


def test_reference_has_all_that_is_public(pages):
    reference = pages[0]["index.html"]
    anchors = set(re.findall(r'id="(powerrtf[\w.]*)"', reference))
    names = set(powerrtf.__all__) | {f"dataset.{name}" for name in powerrtf.dataset.__all__}
    assert {f"powerrtf.{name}" for name in names} <= anchors
    assert "largest growth of the spacing" in reference  # an option of the library's table


def test_pictures_are_there_and_nothing_comes_from_a_network(pages):
    texts, folder = pages
    pictures = re.findall(r'<img [^>]*src="([^"]*)"', texts["index.html"] + texts["python.html"])
    assert len(pictures) >= 4 and all((folder / picture).is_file() for picture in pictures)
    for text in texts.values():
        assert not re.search(r'<(?:img|script|link|iframe)\b[^>]*(?:src|href)="(?:https?:)?//', text)
