# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""powerrtf.dataset: every mesh has one row and the same bytes, whatever happens and whoever does it."""
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import pytest

from shapes import sphere

pyarrow = pytest.importorskip("pyarrow")
import pyarrow.parquet  # noqa: E402
from powerrtf import Options, OutputError  # noqa: E402
from powerrtf.dataset import RayExecutor, plot_summary, remesh_dataset, write_manifest  # noqa: E402
from powerrtf.dataset._executors import for_each  # noqa: E402

N = 60
FAULTS = Path(__file__).with_name("faults")


def write_ellipsoid(file, height):
    points, faces = sphere(6)
    rows = [f"{x!r} {y!r} {z * height!r}" for x, y, z in points.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in faces.tolist()]
    file.write_text(f"OFF\n{len(points)} {len(faces)} 0\n" + "\n".join(rows) + "\n")


def without_seconds(table):
    return table.drop_columns(["seconds"]).to_pylist()


def contents(out):
    return {file.relative_to(out): file.read_bytes() for file in out.glob("meshes/*/*")}


def parts(out):
    return {file.name: file.read_bytes() for file in out.glob("parts/*.parquet")}


def rows_so_far(out):
    return [row for file in sorted(out.glob("parts/*.parquet"))
            for row in pyarrow.parquet.ParquetFile(file).read().to_pylist()]


@pytest.fixture(scope="module", autouse=True)
def faults():
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(FAULTS), prepend=os.pathsep)
        yield


@pytest.fixture(scope="module")
def manifest(tmp_path_factory):
    folder = tmp_path_factory.mktemp("meshes")
    names = [*(f"{i:02}.off" for i in range(14)), "crash.off", "hog.off"]
    for i, name in enumerate(names):
        write_ellipsoid(folder / name, 1 + i / 10)
    (folder / "broken.off").write_text("OFF\nbroken text\n")
    (folder / "copy.off").write_bytes((folder / "03.off").read_bytes())
    names[7:7] = ["broken.off", "missing.off", "copy.off"]
    write_manifest(folder / "manifest.parquet", [folder / name for name in names])
    return folder / "manifest.parquet"


@pytest.fixture(scope="module")
def whole(manifest, tmp_path_factory):
    out = tmp_path_factory.mktemp("whole")
    return out, remesh_dataset(manifest, out, N, executor=ThreadPoolExecutor(2))


def check_equal(out, table, whole):
    assert without_seconds(table) == without_seconds(whole[1])
    assert contents(out) == contents(whole[0])


def test_each_mesh_has_a_row_that_says_what_became_of_it(manifest, whole):
    out, table = whole
    assert table.equals(pyarrow.parquet.ParquetFile(out / "summary.parquet").read())
    rows = {row["path"]: row for row in table.to_pylist()}
    assert list(rows) == pyarrow.parquet.ParquetFile(manifest).read()["path"].to_pylist()
    assert [(path, row["status"], row["message"]) for path, row in rows.items() if row["message"]] == [
        ("broken.off", "refused", "cannot be read: line 2: 'broken' is not a whole number"),
        ("missing.off", "refused", "cannot be read: No such file or directory"),
        ("crash.off", "crashed", "Segmentation fault"),
        ("hog.off", "out of memory", "16 GiB do not suffice")]
    for row in rows.values():
        if row["status"] == "met":
            assert row["vertices"] == N and row["q_min"] > 0.3 and row["missed_guarantees"] == []
            assert (out / row["output"]).read_bytes().startswith(b"ply")
        else:
            assert row["output"] is None and row["vertices"] is None
    assert rows["copy.off"]["output"] == rows["03.off"]["output"]
    assert len(contents(out)) == 14


def test_one_worker_gives_the_same(manifest, whole, tmp_path):
    with ProcessPoolExecutor(1) as pool:
        table = remesh_dataset(manifest, tmp_path, N, executor=pool)
    check_equal(tmp_path, table, whole)


def test_dask_gives_the_same(manifest, whole, tmp_path):
    distributed = pytest.importorskip("distributed", reason="dask[distributed] is not installed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, \
            distributed.Client(cluster) as client:
        table = remesh_dataset(manifest, tmp_path, N, executor=client.get_executor())
    check_equal(tmp_path, table, whole)


def test_ray_gives_the_same(manifest, whole, tmp_path):
    ray = pytest.importorskip("ray", reason="ray is not installed")
    ray.init(num_cpus=2, include_dashboard=False)
    try:
        table = remesh_dataset(manifest, tmp_path, N, executor=RayExecutor())
    finally:
        ray.shutdown()
    check_equal(tmp_path, table, whole)


def command(manifest, out, *options):
    return [sys.executable, "-m", "powerrtf.dataset", str(manifest), str(out), "-n", str(N), *options]


def test_jobs_that_share_the_meshes_give_the_same(manifest, whole, tmp_path):
    shared = command(manifest, tmp_path, "--world", "2")
    first = subprocess.run([*shared, "--rank", "0"], capture_output=True, text=True, check=True)
    second = subprocess.run(shared, env={**os.environ, "SLURM_ARRAY_TASK_ID": "1"}, check=True,
                            capture_output=True, text=True)
    assert "8 met" in first.stdout and "7 met" in second.stdout
    named = [line for line in (first.stderr + second.stderr).splitlines() if "met" not in line]
    assert "crash.off: crashed: Segmentation fault" in named
    assert not (tmp_path / "summary.parquet").exists()
    before = parts(tmp_path)
    table = remesh_dataset(manifest, tmp_path, N)
    check_equal(tmp_path, table, whole)
    assert parts(tmp_path) == before


def heed_interrupts():
    """A shell's job in the background would ignore them."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def test_what_is_finished_survives_a_kill_and_is_not_done_again(manifest, whole, tmp_path):
    for ending in (signal.SIGKILL, signal.SIGINT, signal.SIGTERM):
        before = len(rows_so_far(tmp_path))
        run = subprocess.Popen(command(manifest, tmp_path, "--workers", "2"), start_new_session=True,
                               preexec_fn=heed_interrupts, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        while len(rows_so_far(tmp_path)) == before:  # far from the end, even of the last run
            assert run.poll() is None
            time.sleep(0.01)
        os.killpg(run.pid, ending)
        assert run.wait() in (-signal.SIGKILL, 130, -signal.SIGTERM)
    done = {row["key"]: row for row in rows_so_far(tmp_path)}
    failures = {row["path"] for row in done.values() if row["status"] not in ("met", "refused")}
    assert failures <= {"crash.off", "hog.off"}
    table = remesh_dataset(manifest, tmp_path, N)
    check_equal(tmp_path, table, whole)
    kept = {row["key"]: row["seconds"] for row in table.to_pylist()}
    assert all(kept[key] == row["seconds"] for key, row in done.items())
    assert len(rows_so_far(tmp_path)) == 17 + 2  # crash and hog twice


def test_a_mesh_that_hangs_costs_its_time_only(manifest, tmp_path):
    folder = manifest.parent
    write_ellipsoid(folder / "hang.off", 7)
    write_manifest(tmp_path / "two.parquet", [folder / "hang.off", folder / "00.off"])
    table = remesh_dataset(tmp_path / "two.parquet", tmp_path, N, time_limit=1)
    assert table["status"].to_pylist() == ["timed out", "met"]
    assert table["message"][0].as_py() == "after 4 s"
    assert 4 <= table["seconds"][0].as_py() < 16  # the limit of a second try, not of a third


@pytest.fixture
def small(tmp_path):
    """A manifest of three meshes with options of their own, of which one runs out of memory."""
    for name, height in (("a.off", 1), ("b.off", 2), ("hog.off", 3)):
        write_ellipsoid(tmp_path / name, height)
    write_manifest(tmp_path / "small.parquet", tmp_path, edge_length=[None, 0.5, None], n=[50.0, None, None])
    return tmp_path / "small.parquet"


def test_only_what_has_changed_is_done_again(small, tmp_path):
    def remesh(**options):
        rows = remesh_dataset(small, tmp_path / "out", N, memory_limit=1, **options).to_pylist()
        seconds.append([row["seconds"] for row in rows])
        return rows
    seconds = []
    a, b, hog = remesh()
    assert a["options"] == "--samples 50 --traits cpu" and a["vertices"] == 50
    assert b["options"] == "--edge-length 0.5 --traits cpu" and b["vertices"] > N
    assert hog["options"] == f"--samples {N} --traits cpu" and hog["memory_limit"] == 4
    (tmp_path / "out" / a["output"]).unlink()
    write_ellipsoid(tmp_path / "b.off", 2.5)
    new_a, new_b, _ = remesh()
    assert new_a["output"] == a["output"] and (tmp_path / "out" / a["output"]).exists()
    assert new_b["output"] != b["output"]
    remesh(time_limit=600.)
    assert remesh(time_limit=700.)[2]["time_limit"] == 2800
    again = [[new != old for new, old in zip(*two)] for two in zip(seconds[1:], seconds)]
    assert again == [[True, True, False], [False, False, False], [False, False, True]]
    assert remesh(options=Options(n=70, seed=1))[0]["seed"] == 1


@pytest.mark.parametrize("columns, message", [
    ({"file": ["a.off"]}, "m.parquet: there is no column 'path'"),
    ({"path": ["a.off", None]}, "m.parquet: row 1 has no path"),
    ({"path": ["a.off"], "edge_lenght": [1]}, "m.parquet: the column 'edge_lenght' is no option"),
    (None, "m.parquet: cannot be read")])
def test_a_wrong_manifest_is_refused_with_its_name(columns, message, tmp_path):
    file = tmp_path / "m.parquet"
    if columns:
        pyarrow.parquet.write_table(pyarrow.table(columns), file)
    else:
        file.write_text("a.off\n")
    with pytest.raises((TypeError, ValueError), match=message):
        remesh_dataset(file, tmp_path, N)


def test_wrong_arguments_are_refused(small, tmp_path):
    with pytest.raises(TypeError, match="unexpected keyword argument 'edge_lenght'"):
        remesh_dataset(small, tmp_path / "out", edge_lenght=1)
    with pytest.raises(ValueError, match="rank is 2, but must be from 0 to 1"):
        remesh_dataset(small, tmp_path / "out", N, rank=2, world=2)
    with pytest.raises(ValueError, match="seed has 1 values, but there are 3 meshes"):
        write_manifest(small, tmp_path, seed=[1])
    (tmp_path / "empty").mkdir()
    with pytest.raises(ValueError, match="empty: there is no mesh"):
        write_manifest(small, tmp_path / "empty")
    with pytest.raises(ValueError, match="^seed is 'x', but must be a number from 0"):
        remesh_dataset(small, tmp_path / "out", N, seed="x")
    with pytest.raises(ValueError, match="^size_factor needs a sizing field"):
        remesh_dataset(small, tmp_path / "out", size_factor=2)
    write_manifest(small, tmp_path, gradation=[None, -1., None])
    with pytest.raises(ValueError, match="row 1: gradation is -1, but must be a number from 0"):
        remesh_dataset(small, tmp_path / "out", N)
    run = subprocess.run(command(small, tmp_path / "out", "--repair", "perhaps"), capture_output=True,
                         text=True)
    assert run.returncode == 2 and "--repair: 'perhaps' is neither yes nor no" in run.stderr


def test_an_output_that_cannot_be_written_ends_the_run(small, tmp_path):
    with pytest.raises(OutputError, match="cannot be written: its name does not end in"):
        remesh_dataset(small, tmp_path / "out", N, format="xyz")
    run = subprocess.run(command(small, tmp_path / "out", "--format", "xyz"), capture_output=True, text=True)
    assert run.returncode == 1 and "cannot be written: its name does not end in" in run.stderr
    assert rows_so_far(tmp_path / "out") == []


def test_an_error_cancels_the_calls_that_have_not_begun():
    begun = []

    def call(i):
        begun.append(i)
        time.sleep(0.01)
        return 1 // (3 - i)
    with ThreadPoolExecutor(1) as pool, pytest.raises(ZeroDivisionError):
        for_each(pool, call, {i: (i,) for i in range(1000)}, lambda name, result: None)
    assert 3 < len(begun) < 500


def test_the_package_does_without_pyarrow_and_says_what_needs_it(small):
    program = "import powerrtf, sys; assert 'pyarrow' not in sys.modules; sys.modules['pyarrow'] = None; " \
              f"import powerrtf.dataset; powerrtf.dataset.remesh_dataset({str(small)!r}, 'out', 50)"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stderr.splitlines()[-1] == \
        "ImportError: powerrtf.dataset needs pyarrow: pip install 'powerrtf[dataset]'"


def test_a_summary_can_be_drawn(whole, tmp_path):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    plot_summary(whole[1], tmp_path / "summary.svg")
    text = (tmp_path / "summary.svg").read_text()
    assert "out of memory" in text and "least quality" in text
