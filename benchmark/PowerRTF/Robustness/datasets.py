#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remesh thousands of files by powerrtf.dataset, killed on the way: has each mesh its row, and are the
meshes the same whoever makes them?

datasets.py                             2000 meshes, by all executors
datasets.py --meshes 200 --samples 100  fewer, coarser ones
datasets.py --executors threads dask    by these alone

Needs a Python that has powerrtf[dataset], dask[distributed] and ray, and CGAL's models. The meshes are
variations of those models that have at most 200 kB (see variations.py); five more are broken: a text, a
file that is not there, one whose process crashes, one that hangs and one that takes too much memory. For
each executor, the run is killed by SIGKILL when 20, 50 and 80 % of the rows are there, and goes on. Then
there has to be one row for each mesh, in the order of the manifest; all rows but for the seconds, and
all meshes, bit by bit, have to be those of the first executor. The table goes to datasets.md in the
folder --results. The exit code is 1 when anything is not so, else 0; 77 without models.
"""

import argparse
import itertools
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import DATA, ROOT, made_by, markdown  # noqa: E402
from robustness import meshes  # noqa: E402
from variations import DEFECTS, read_off, write_off  # noqa: E402

KILLED_AT = (0.2, 0.5, 0.8)
LIMITS = {"time_limit": 15, "memory_limit": 1}
FAULTS = ROOT / "python/tests/faults"


def make_meshes(folder, number, models):
    """Writes `number` meshes and their manifest."""
    from powerrtf.dataset import write_manifest
    files = []
    broken = ["text.off", "missing.off", "crash.off", "hang.off", "hog.off"]
    small = [(file.stem, read_off(file)) for file in meshes(models, 200_000)]
    small = [(name, mesh) for name, mesh in small if mesh and mesh[1]]
    for seed, (name, mesh), defect in itertools.product(range(number), small, DEFECTS):
        if len(files) == number - len(broken):
            break
        points, facets = DEFECTS[defect](*mesh, random.Random(f"{name} {defect} {seed}"))
        if facets:
            files.append(folder / f"{name}-{defect}-{seed}.off")
            write_off(files[-1], points, facets)
    (folder / "text.off").write_text("OFF\nbroken text\n", encoding="ascii")
    for name, file in zip(broken[2:], files):
        (folder / name).write_text(file.read_text(encoding="ascii") + f"# {name}\n", encoding="ascii")
    files += [folder / name for name in broken]
    random.Random(0).shuffle(files)
    write_manifest(folder / "manifest.parquet", files)


def run(name, manifest, out, samples):
    """Remeshes all of the manifest by an executor on all cores."""
    from powerrtf.dataset import RayExecutor, remesh_dataset
    cores = len(os.sched_getaffinity(0))
    if name == "threads":
        remesh_dataset(manifest, out, samples, **LIMITS)
    elif name == "processes":
        from concurrent.futures import ProcessPoolExecutor
        with ProcessPoolExecutor(cores) as pool:
            remesh_dataset(manifest, out, samples, executor=pool, **LIMITS)
    elif name == "dask":
        from distributed import Client, LocalCluster
        with LocalCluster(n_workers=cores, threads_per_worker=1, dashboard_address=None) as cluster, \
                Client(cluster) as client:
            remesh_dataset(manifest, out, samples, executor=client.get_executor(), **LIMITS)
    else:
        import ray
        ray.init(num_cpus=cores, include_dashboard=False)
        remesh_dataset(manifest, out, samples, executor=RayExecutor(), **LIMITS)


def rows_in(out):
    import pyarrow.parquet
    return sum(pyarrow.parquet.ParquetFile(file).metadata.num_rows
               for file in out.glob("parts/*.parquet"))


def run_with_kills(name, options, folder, out):
    """Returns the seconds that it took."""
    command = [sys.executable, __file__, "--run", name, str(folder), str(out),
               "--samples", str(options.samples)]
    paths = filter(None, [str(FAULTS), os.environ.get("PYTHONPATH")])
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    begin = time.monotonic()
    for share in KILLED_AT:
        process = subprocess.Popen(command, env=environment, start_new_session=True)
        while process.poll() is None and rows_in(out) < share * options.meshes:
            time.sleep(0.2)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    subprocess.run(command, env=environment, check=True)
    return time.monotonic() - begin


def outcome(out):
    """The rows of the summary without their seconds, and the meshes by name."""
    import pyarrow.parquet
    table = pyarrow.parquet.ParquetFile(out / "summary.parquet").read()
    return (table.drop_columns(["seconds"]).to_pylist(),
            {file.relative_to(out): file.read_bytes() for file in out.glob("meshes/*/*")})


def measure(options, folder):
    """Rows of the table, what was wrong, and how many meshes have which status."""
    import pyarrow.parquet
    manifest = pyarrow.parquet.ParquetFile(folder / "manifest.parquet").read()["path"].to_pylist()
    table, wrong, first = [], [], None
    for name in options.executors:
        out = folder / f"out-{name}"
        seconds = run_with_kills(name, options, folder, out)
        rows, files = outcome(out)
        first = first or (rows, files)
        if [row["path"] for row in rows] != manifest:
            wrong.append(f"{name}: the summary has not one row for each mesh")
        wrong += [f"{name}: {other['path']} has another row"
                  for row, other in zip(rows, first[0]) if row != other]
        if files != first[1]:
            wrong.append(f"{name}: meshes differ")
        table.append([name, len(rows), len(files), rows_in(out), f"{seconds:.0f}",
                      f"{len(rows) / seconds:.1f}"])
        shutil.rmtree(out)
    statuses = [row["status"] for row in first[0]]
    return table, wrong, ", ".join(f"{statuses.count(s)} {s}" for s in dict.fromkeys(sorted(statuses)))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--meshes", type=int, default=2000, metavar="N")
    parser.add_argument("--samples", type=int, default=200, metavar="N")
    executors = ["threads", "processes", "dask", "ray"]
    parser.add_argument("--executors", nargs="+", choices=executors, default=executors)
    parser.add_argument("--results", default=str(ROOT / "build/datasets"), metavar="FOLDER")
    parser.add_argument("--run", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run:
        name, folder, out = options.run
        run(name, pathlib.Path(folder) / "manifest.parquet", out, options.samples)
        return 0
    models = pathlib.Path(os.environ.get("POWER_RTF_DATA", str(DATA)))
    if not models.exists():
        print(f"no models in {models}", file=sys.stderr)
        return 77
    with tempfile.TemporaryDirectory() as folder:
        make_meshes(pathlib.Path(folder), options.meshes, [models])
        table, wrong, statuses = measure(options, pathlib.Path(folder))
    results = pathlib.Path(options.results)
    results.mkdir(parents=True, exist_ok=True)
    text = markdown(["executor", "rows", "different meshes", "runs of a mesh", "seconds",
                     "meshes a second"], table)
    shown = ["--meshes", str(options.meshes), "--samples", str(options.samples),
             "--executors", *options.executors]
    (results / "datasets.md").write_text(f"{text}\n{statuses}. {made_by(__file__, shown)}\n",
                                         encoding="utf-8")
    print(text, statuses, *wrong, sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
