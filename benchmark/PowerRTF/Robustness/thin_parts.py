#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run power_rtf_remesh on surfaces with thin parts, with --thin keep and --thin refine.

thin_parts.py                       the shapes of thin_shapes.py, each .2 to 1 spacings thick
thin_parts.py FOLDER_OR_FILE ...    meshes
thin_parts.py --samples 10000       instead of 3000
thin_parts.py --quick               the short form: one thickness, 1000 samples

What is asked of each run with --thin refine: every guarantee, and round triangles, that is, none
with a quality below .6 or an angle below 30 degrees, by what this driver finds in the mesh that was
written. Runs are shown, but not counted, where the report of --thin keep says that more than twice as
many samples are needed, and on shapes that are thin all over or pointed. The table goes to summary.md in the folder --results. The exit code is 1 where a counted run
with refine is not as asked, else 0.
"""

import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import robustness  # noqa: E402
import thin_shapes  # noqa: E402
from common import BUILD, ROOT, build, made_by, markdown  # noqa: E402

THICKNESSES = [0.2, 0.28, 0.35, 0.42, 0.5, 0.6, 0.7, 0.85, 1]
TOO_FEW = 2  # as many samples would do, times those there are


def roundness(file):
    """Least quality and least angle of the triangles of an OFF file, as Q_t and in degrees."""
    words = iter(pathlib.Path(file).read_text(encoding="ascii").split())
    next(words)
    vertices, facets, _ = (int(next(words)) for _ in range(3))
    points = [tuple(float(next(words)) for _ in range(3)) for _ in range(vertices)]
    q_min, angle_min = math.inf, math.inf
    for _ in range(facets):
        next(words)
        corners = [points[int(next(words))] for _ in range(3)]
        a, b, c = sorted(math.dist(corners[i - 1], corners[i]) for i in range(3))
        if a == 0:
            return 0, 0
        cosine = min(1, max(-1, (b * b + c * c - a * a) / (2 * b * c)))
        area = b * c * math.sqrt(1 - cosine * cosine) / 2
        q_min = min(q_min, 6 / math.sqrt(3) * area / ((a + b + c) / 2 * c))
        angle_min = min(angle_min, math.degrees(math.acos(cosine)))
    return q_min, angle_min


def run(options, model, thin):
    """What one run was worth."""
    with tempfile.TemporaryDirectory() as folder:
        mesh, report = pathlib.Path(folder, "mesh.off"), pathlib.Path(folder, "report.json")
        code, errors, seconds, _ = robustness.execute(
            [options.program, str(model), str(mesh), "--samples", str(options.samples),
             "--density", options.density, "--thin", thin, "--report", str(report), "--quiet"],
            options.seconds, 4096)
        result = {"seconds": seconds, "missed": errors or f"exit code {code}", "q": 0, "angle": 0,
                  "thin": {}}
        if code not in (0, 3):
            return result
        found = json.loads(report.read_text(encoding="utf-8"))
        result["missed"] = "; ".join(found["missed_guarantees"]) or robustness.broken_promise(
            mesh, found)
        result["q"], result["angle"] = roundness(mesh)
        result["thin"] = found["thin_parts"]
    return result


def is_round(result):
    return result["q"] >= 0.6 and result["angle"] >= 30


def write_shapes(options, folder):
    """The shapes as OFF files."""
    files = []
    for make in thin_shapes.SHAPES + thin_shapes.WITHOUT_ROOM:
        for thickness in options.thicknesses:
            points, triangles = thin_shapes.with_spacing(make, thickness, options.samples)
            lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
            lines += [" ".join(repr(float(x)) for x in p) for p in points]
            lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
            files.append(pathlib.Path(folder, f"{make.__name__}_{thickness:g}.off"))
            files[-1].write_text("\n".join(lines) + "\n", encoding="ascii")
    return files


def compare(options, model):
    keep, refine = run(options, model, "keep"), run(options, model, "refine")
    has_room = model.stem.split("_")[0] not in (make.__name__ for make in thin_shapes.WITHOUT_ROOM)
    is_counted = has_room and keep["thin"].get("samples", 0) <= TOO_FEW * options.samples
    is_as_asked = is_round(refine) and not refine["missed"]
    thin = keep["thin"]
    row = [model.stem, thin.get("places") or "", f"{100 * thin['area_share']:.2f}" if thin.get(
        "places") else "", thin.get("samples") or ""]
    for result in (keep, refine):
        row += [f"{result['q']:.2f}", f"{result['angle']:.0f}", f"{result['seconds']:.1f}"]
    verdict = "as asked" if is_as_asked else refine["missed"] or "not round"
    row.append(verdict if is_counted else f"not counted: {verdict}")
    print(*row, flush=True)
    return row, is_counted, is_as_asked


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="FOLDER_OR_FILE", help="OFF, OBJ, PLY, STL")
    parser.add_argument("--samples", type=int, metavar="N")
    parser.add_argument("--density", choices=["uniform", "curvature"], default="uniform")
    parser.add_argument("--seconds", type=float, default=120, help="limit of each run (120)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (1)")
    parser.add_argument("--results", default=str(ROOT / "build/thin_parts"), metavar="FOLDER",
                        help="of summary.md (build/thin_parts)")
    parser.add_argument("--program", help="power_rtf_remesh; default: built here")
    parser.add_argument("--quick", action="store_true", help="1000 samples, .35 spacings thick")
    options = parser.parse_args()
    options.samples = options.samples or (1000 if options.quick else 3000)
    options.thicknesses = [0.35] if options.quick else THICKNESSES
    return options


def main():
    options = parse_arguments()
    if not options.program:
        build(["power_rtf_remesh"])
        options.program = BUILD / "bin/power_rtf_remesh"
    options.program = str(pathlib.Path(options.program).resolve())
    with tempfile.TemporaryDirectory() as folder, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        models = (robustness.meshes(options.meshes, math.inf) if options.meshes
                  else write_shapes(options, folder))
        rows = list(pool.map(lambda model: compare(options, model), models))
    counted = [is_as_asked for _, is_counted, is_as_asked in rows if is_counted]
    text = "# Thin parts\n\n" + made_by(
        __file__, [os.path.basename(argument.rstrip("/")) for argument in sys.argv[1:]]) + "\n\n" + markdown(
        ["mesh", "places", "% of the area", "samples that do", "keep: Q", "angle", "seconds",
         "refine: Q", "angle", "seconds", "refine is"], [row for row, _, _ in rows])
    text += f"\n{sum(counted)} of {len(counted)} as asked with refine.\n"
    results = pathlib.Path(options.results)
    results.mkdir(parents=True, exist_ok=True)
    (results / "summary.md").write_text(text, encoding="utf-8")
    print(text, end="")
    return 0 if all(counted) else 1


if __name__ == "__main__":
    sys.exit(main())
