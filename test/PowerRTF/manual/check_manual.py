#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the manual, and checks the pages as a reader without a network would find them.

check_manual.py --source FOLDER --scratch FOLDER [--program FILE] [options of cmake]

No warnings; no markup, and no formula as plain text, in what is shown; nothing from a network; all
links, anchors and pictures are there; what is public stands in the reference; the bibliography has
all that the code cites; the table of parameters is that of the program's --help; the manual is
installed. The exit code is 77 where the manual cannot be built (no Doxygen, no MathJax).
"""

import argparse
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

MARKUP = re.compile(r"\w\*\s|\*\*|&#|&\w+;|\\[a-zA-Z]+|`")
# s_i, n^v, sqrt(3), rho: what LaTeX should have set
FORMULA = re.compile(r"\b[A-Za-z]_\w\b|\^|\bsqrt\(|\b(?:alpha|gamma|kappa|rho|tau|Theta)\b")
PUBLIC = {
    "Ref": "CGAL::power_rtf_remeshing CGAL::PowerRTF_remesher Remeshing_default_visitor "
           "Invalid_input_error",
    "Concepts": "PowerRTFTraits_3 PowerRTFEngine PowerRTFDensityMap PowerRTFVisitor "
                "TangentCellTraits_3",
    "Parameters": "density_map remeshing_options repair symmetry vertex_point_map edge_is_constrained_map "
                  "geom_traits visitor random_seed number_of_iterations combine "
                  "vertex_source_map face_source_map corner_source_map sizing_map sizing_field refinements "
                  "face_patch_map vertex_is_constrained_map",
    "Transfer": "Mesh_source interpolated transfer_vertex_values transfer_face_values "
                "transfer_corner_values",
    "Options": "Remeshing_options Resolution Refinement Preset Density Sampling Attributes Projection "
               "Position_method Weight_method Weight_operator Extraction_method Improvement "
               "Dislocations Repair Symmetry Option "
               "for_each_option validate",
    "Report": "Remeshing_report Iteration_report Quality_statistics Repair_counts "
              "Symmetry_report",
    "Surface": "Surface Samples Cell_polygon Extracted_mesh prepare_surface import_surface "
               "import_soup set_creases set_density Surface_fields",
    "Traits": "PowerRTF_traits_3 PowerRTF_exact_traits_3 PowerRTF_cuda_traits_3 Cpu_engine "
              "Exact_engine Cuda_engine Cuda_error",
    "Exact": "Exact_cells check_cells Cell_comparison",
}


class Page(html.parser.HTMLParser):
    """The text that is shown, without code and formulas; links, anchors, and what is loaded."""

    def __init__(self, text):
        super().__init__()
        self.text, self.links, self.anchors, self.loaded = "", [], set(), []
        self._code = []  # the elements of code that are open
        self.feed(text)
        self.text = re.sub(r"\\\(.*?\\\)|\\\[.*?\\\]", "", self.text, flags=re.DOTALL)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        is_code = tag in ("code", "pre", "script", "style") or attributes.get("class") == "fragment"
        if is_code or tag in self._code[-1:]:
            self._code.append(tag)
        self.anchors |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        elif tag in ("img", "script") and attributes.get("src"):
            self.loaded.append(attributes["src"])
        elif tag == "link" and attributes.get("href"):
            self.loaded.append(attributes["href"])

    def handle_endtag(self, tag):
        if tag in self._code[-1:]:
            self._code.pop()

    def handle_data(self, data):
        if not self._code:
            self.text += data


def run(*command, **options):
    return subprocess.run([str(c) for c in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, **options)


def faults_of_page(folder, name, pages):
    page = pages[name]
    for pattern, what in ((MARKUP, "markup"), (FORMULA, "a formula as plain text")):
        for match in pattern.finditer(page.text):
            shown = page.text[max(0, match.start() - 30):match.end() + 30]
            yield f"{what}, {match[0]!r}, is shown: {shown!r}"
    for address in page.loaded:
        if re.match(r"(\w+:)?//", address):
            yield f"{address} is loaded from a network"
        elif not (folder / urllib.parse.unquote(address).split("?")[0]).exists():
            yield f"{address} is missing"
    for link in page.links:
        parts = urllib.parse.urlsplit(link)
        if parts.scheme:
            continue
        target = urllib.parse.unquote(parts.path) or name
        if target not in pages and not (folder / target).exists():
            yield f"a link leads to {target}, which is missing"
        elif target in pages and parts.fragment and parts.fragment not in pages[target].anchors:
            yield f"a link leads to {link}, an anchor that is missing"


def faults_of_reference(pages):
    for group, names in PUBLIC.items():
        page = pages.get(f"group__PkgPowerRTF{group}.html")
        text = page.text if page else ""
        for name in names.split():
            if not re.search(rf"\b{name}\b", text):
                yield f"{name} is missing in the group {group} of the reference"


def faults_of_bibliography(source, pages):
    """Each year in a comment needs an entry of that year with an author who is named nearby."""
    page = pages.get("power_rtf_bibliography.html")
    entries = re.findall(r"bib_(\w+?)(\d{4})", " ".join(page.anchors)) if page else []
    for folder in ("include", "cuda"):
        for file in sorted((source / folder).rglob("*.*h")):
            lines = file.read_text(encoding="utf-8").splitlines()
            for k, line in enumerate(lines):
                comment = line.partition("//")[2]
                for year in re.findall(r"\b(1[89]\d\d|20\d\d)\b(?=[,;.)]|$)", comment):
                    near = " ".join(lines[max(0, k - 2):k + 1])
                    if not any(y == year and author in near for author, y in entries):
                        yield f"{file.name}: {comment.strip()!r} is not in the bibliography"


def faults_of_parameters(source, program):
    shown = run(sys.executable, source / "doc/PowerRTF/parameters.py", "--program", program).stdout
    if shown not in (source / "doc/PowerRTF/PowerRTF.txt").read_text(encoding="utf-8"):
        yield "the table of parameters differs from --help: call doc/PowerRTF/parameters.py --update"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--scratch", type=pathlib.Path, required=True)
    parser.add_argument("--program", help="power_rtf_remesh")
    arguments, options = parser.parse_known_args()
    build, prefix = arguments.scratch / "build", arguments.scratch / "prefix"
    shutil.rmtree(arguments.scratch, ignore_errors=True)
    configured = run("cmake", "--preset", "headers", "-S", arguments.source, "-B", build, *options)
    if configured.returncode != 0:
        sys.exit(configured.stdout)
    if "No target doc" in configured.stdout:
        print("skipped:", re.search("No target doc.*", configured.stdout)[0])
        sys.exit(77)
    built = run("cmake", "--build", build, "--target", "doc")
    if built.returncode != 0 or "warning:" in built.stdout:
        sys.exit(built.stdout)

    folder = build / "doc/html"
    texts = {f.name: f.read_text(encoding="utf-8") for f in sorted(folder.glob("*.html"))}
    pages = {name: Page(text) for name, text in texts.items()}
    faults = [f"{name}: {fault}" for name in pages for fault in faults_of_page(folder, name, pages)]
    faults += [f"{name}: it holds the path of the sources" for name, text in texts.items()
               if str(arguments.source) in text]
    faults += faults_of_reference(pages)
    faults += faults_of_bibliography(arguments.source, pages)
    if arguments.program:
        faults += faults_of_parameters(arguments.source, arguments.program)
    if "mathjax/MathJax.js" not in pages["index.html"].loaded:
        faults.append("no MathJax beside the manual sets the formulas")
    installed = run("cmake", "--install", build, "--prefix", prefix)
    if installed.returncode != 0 or not list(prefix.glob("share/doc/*/html/index.html")):
        faults.append("the manual is not installed: " + installed.stdout)

    print("\n".join(dict.fromkeys(faults)))
    print(f"{len(pages)} pages, {len(faults)} faults")
    sys.exit(1 if faults or len(pages) < 50 else 0)


if __name__ == "__main__":
    main()
