#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What does a mesh of a data set cost? CPU seconds, disk and memory of powerrtf.dataset, on one core;
and how many meshes a second do more cores make?

dataset_costs.py           of 16 of CGAL's models of 20 to 200 kB, or those in POWER_RTF_DATA
dataset_costs.py workers   the last table alone

Needs a Python that has powerrtf[dataset]; 77 without models.
"""

import concurrent.futures
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import DATA, made_by, markdown  # noqa: E402
from robustness import meshes  # noqa: E402

ROWS = 100_000
WORKERS = ("workers", "meshes of 1000 vertices a second", "efficiency")


def cpu_seconds(command, times):
    """The mean of so many runs."""
    begin = resource.getrusage(resource.RUSAGE_CHILDREN)
    for _ in range(times):
        subprocess.run(command, check=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    end = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime) / times


def meshes_cost(models, folder):
    """Rows of a table: vertices, mean CPU seconds, kB of PLY, and MB of memory of the largest so far."""
    from powerrtf.dataset._mesh import remesh_one
    for samples in (200, 1000, 5000, 20000):
        begin = resource.getrusage(resource.RUSAGE_CHILDREN)
        sizes = []
        for model in models:
            output = folder / "mesh.ply"
            row = remesh_one(str(model), str(output), ("--samples", str(samples), "--traits", "cpu"),
                             600, 4)
            if row["status"] in ("met", "missed guarantees"):
                sizes.append(output.stat().st_size)
        end = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = (end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime) / len(models)
        yield [samples, f"{seconds:.2f}", f"{sum(sizes) / len(sizes) / 1e3:.0f}",
               f"{end.ru_maxrss / 1e3:.0f}"]


def timed(function, *arguments):
    """CPU seconds of this process."""
    begin = time.process_time()
    function(*arguments)
    return time.process_time() - begin


def rows_cost(folder):
    """Rows of a table, for the process that leads: what, and how much."""
    from powerrtf.dataset._manifest import Entry
    from powerrtf.dataset._mesh import key_of
    from powerrtf.dataset._results import Results
    entry = Entry("models/mesh-123456.off", "/data/models/mesh-123456.off", ("--samples", "5000"))
    limits = {"time_limit": 600.0, "memory_limit": 4.0}
    found = {"status": "met", "message": "", "missed_guarantees": [], "vertices": 5000, "faces": 9996,
             "seed": 0, **{name: 0.123456789 for name in (
                 "seconds", "q_min", "q_avg", "theta_min", "distance_mean", "distance_rms", "distance_max")}}
    keys = [f"{i:064x}" for i in range(ROWS)]
    results = Results(folder, "ply")
    add = timed(lambda: [results.add(key, entry, limits, found) for key in keys])
    results = Results(folder, "ply")
    read = timed(results.read, keys)
    table = [entry] * ROWS, [(key, None) for key in keys]
    write = timed(lambda: results.write_summary(results.table(*table)))
    data = folder / "data.off"
    data.write_bytes(os.urandom(1 << 28))
    return [["to keep a row, ms", f"{add / ROWS * 1e3:.2f}"],
            [f"to read {ROWS} rows, s", f"{read:.1f}"],
            ["to write them as a summary, s", f"{write:.1f}"],
            ["memory then, MB", f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3:.0f}"],
            ["to hash a GB, s", f"{timed(key_of, str(data), [], 'ply') * 1e9 / 2**28:.2f}"]]


def throughput(models, folder):
    """Rows of a table: workers, meshes a second, and that over what so many single ones would make."""
    from powerrtf.dataset import remesh_dataset, write_manifest
    cores, workers, alone = len(os.sched_getaffinity(0)), 1, None
    while workers <= cores:
        files = [model for model in models for _ in range(4 * workers)]
        manifest = folder / f"manifest-{workers}.parquet"
        write_manifest(manifest, files, seed=[i % (4 * workers) for i in range(len(files))])
        with concurrent.futures.ThreadPoolExecutor(workers) as executor:
            begin = time.perf_counter()
            remesh_dataset(manifest, folder / str(workers), 1000, executor=executor)
            rate = len(files) / (time.perf_counter() - begin)
        alone = alone or rate
        yield [workers, f"{rate:.1f}", f"{rate / (workers * alone):.2f}"]
        workers *= 2


def main():
    models = [file for file in meshes([os.environ.get("POWER_RTF_DATA", str(DATA))], 200_000)
              if file.suffix == ".off" and file.stat().st_size > 20_000][:16]
    if not models:
        print("no models", file=sys.stderr)
        return 77
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        if sys.argv[1:] != ["workers"]:
            start = cpu_seconds([sys.executable, "-c", "import powerrtf.dataset"], 10)
            print(markdown(["vertices", "CPU seconds", "kB of PLY", "MB of memory"],
                           meshes_cost(models, folder)))
            print(markdown(["the process that leads", ""], [["to start Python, s", f"{start:.2f}"],
                                                            *rows_cost(folder)]))
        print(markdown(WORKERS, throughput(models, folder)))
    print(made_by(__file__, []))
    return 0


if __name__ == "__main__":
    sys.exit(main())
