#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a call from Python takes beyond the C++ that it calls, and whether calls leak.

python_overhead.py [MODEL]   default: CGAL's bunny, as ./run_tests fetches it

Needs a Python that has powerrtf. Overhead: the time of `powerrtf.remesh()` with arrays, less the total
of its report, which has all from the surface on; so the arrays' way in and out, the report and the
options are in it. The least of some calls by one thread, as all else is what other programs take.
Memory: what 1000 further calls add to the resident set. The exit code is 1 when the overhead at 3000
vertices is over 3 ms or the calls add more than 1 MB, and 77 without a model.
"""

import gc
import pathlib
import resource
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import DATA, made_by, markdown  # noqa: E402

SIZES, RUNS = (300, 3000, 10000), 11
CALLS = 1000
MAX_OVERHEAD, MAX_GROWTH = 3.0, 1.0  # ms, MB


def overhead(powerrtf, vertices, faces, n):
    """Milliseconds of C++ and on top of it."""
    inside, beyond = [], []
    for seed in range(RUNS):
        begin = time.perf_counter()
        mesh = powerrtf.remesh(vertices, faces, n, seed=seed, threads=1)
        seconds = time.perf_counter() - begin
        inside.append(1e3 * mesh.report.seconds.total)
        beyond.append(1e3 * seconds - inside[-1])
    return min(inside), min(beyond)


def resident():
    """Of this process, in MB."""
    gc.collect()
    pages = int(pathlib.Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize() / 1e6


def growth(call):
    """MB that the calls add, after as many to warm up."""
    sizes = []
    for _ in range(2):
        for _ in range(CALLS):
            call()
        sizes.append(resident())
    return sizes[1] - sizes[0]


def main():
    import powerrtf
    model = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else DATA / "bunny00.off"
    if not model.exists():
        print(f"{model}: no model", file=sys.stderr)
        return 77
    vertices, corners, _ = powerrtf._core.read_mesh(str(model))
    faces = corners.reshape(-1, 3)
    rows = [[n, *overhead(powerrtf, vertices, faces, n)] for n in SIZES]
    small, triangles = powerrtf.remesh(vertices, faces, 300)
    added = growth(lambda: powerrtf.remesh(small, triangles, 100, threads=1))
    print(f"{model.name}, {len(vertices)} vertices; the least of {RUNS} calls by one thread:\n")
    print(markdown(["n", "C++, ms", "Python on top, ms"],
                   [[n, f"{inside:.1f}", f"{beyond:.2f}"] for n, inside, beyond in rows]))
    print(f"{CALLS} calls after {CALLS} others add {added:.2f} MB.\n")
    print(made_by(__file__, []))
    return 0 if rows[SIZES.index(3000)][2] <= MAX_OVERHEAD and added <= MAX_GROWTH else 1


if __name__ == "__main__":
    sys.exit(main())
