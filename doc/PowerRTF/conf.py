# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package's pages, made by Sphinx: sphinx-build doc/PowerRTF FOLDER"""

import powerrtf

project = "PowerRTF in Python"
author = "The PowerRTF authors"
copyright = "2026 The PowerRTF authors"
release = powerrtf.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc"]
include_patterns = ["index.rst", "python.md"]
myst_enable_extensions = ["html_image"]
myst_heading_anchors = 3
autodoc_member_order = "bysource"
html_title = project
html_theme = "furo"
html_show_sphinx = False
