# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
import dataclasses
import inspect
import os
import pickle
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import powerrtf
from shapes import FACES, POINTS, sphere


def same(a, b):
    return np.array_equal(a.vertices, b.vertices) and np.array_equal(a.faces, b.faces)


@pytest.mark.parametrize("real", [np.float32, np.float64])
@pytest.mark.parametrize("whole", [np.int32, np.int64])
def test_output_has_the_types_of_the_input(real, whole):
    mesh = powerrtf.remesh(POINTS.astype(real), FACES.astype(whole), 100)
    assert mesh.vertices.dtype == real and mesh.faces.dtype == whole
    assert mesh.vertices.shape == (100, 3) and mesh.missed_guarantees == []


@pytest.mark.parametrize("change", [
    np.asfortranarray, lambda a: a[::-1][::-1], lambda a: np.repeat(a, 2, axis=0)[::2],
    lambda a: a.astype(a.dtype.newbyteorder()), lambda a: a.tolist()])
def test_any_layout_gives_the_same(change):
    assert same(powerrtf.remesh(change(POINTS), change(FACES), 100),
                powerrtf.remesh(POINTS, FACES, 100))


def test_read_only_input_is_taken_and_no_input_is_changed():
    points, faces = POINTS.copy(), FACES.copy()
    powerrtf.remesh(points, faces, 100)
    assert np.array_equal(points, POINTS) and np.array_equal(faces, FACES)
    points.flags.writeable = faces.flags.writeable = False
    assert same(powerrtf.remesh(points, faces, 100), powerrtf.remesh(POINTS, FACES, 100))


def test_an_edge_length_or_a_share_of_the_vertices_gives_n():
    mesh = powerrtf.remesh(POINTS, FACES, edge_length=0.2, density="uniform")
    assert abs(mesh.report.edge_length_median / 0.2 - 1) < 0.02
    mesh = powerrtf.remesh(POINTS, FACES, vertex_share=0.5)
    assert len(mesh.vertices) == len(POINTS) // 2
    mesh = powerrtf.remesh(POINTS, FACES, relative_max_distance=0.02)
    assert 0 < mesh.report.distance_bound <= 2 and not mesh.missed_guarantees
    with pytest.raises(powerrtf.InvalidInputError, match="not 2 of them"):
        powerrtf.remesh(POINTS, FACES, 100, edge_length=0.2)


def test_edge_lengths_may_be_wanted_somewhere():
    points, faces = sphere(24)
    even = powerrtf.remesh(points, faces, size_field=np.full(len(points), 0.2))
    assert abs(even.report.edge_length_median / 0.2 - 1) < 0.02
    coarse = powerrtf.remesh(points, faces, size_field=np.full(len(points), 0.2), size_factor=1.5)
    assert len(coarse.vertices) < 0.5 * len(even.vertices)
    refined = powerrtf.remesh(points, faces, edge_length=0.2, refine=["sphere:0,0,1,0.3,0.05"],
                              density="uniform")
    assert refined.report.edge_length_min < 0.05 and not refined.missed_guarantees
    with pytest.raises(ValueError, match="size_field has 3 entries"):
        powerrtf.remesh(points, faces, size_field=[1., 2, 3])
    with pytest.raises(ValueError, match="is neither sphere:x,y,z,r,h nor"):
        powerrtf.remesh(points, faces, 100, refine=["cone:1"])


def test_labels_come_out_with_their_areas():
    points, faces = sphere(24)
    labels = np.where(points[faces].mean(axis=1)[:, 2] > 0, 7, -2)
    mesh = powerrtf.remesh(points, faces, 800, face_labels=labels)

    def area(points, faces):
        a, b, c = np.moveaxis(points[faces], 1, 0)
        return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    for label in (7, -2):
        assert abs(area(mesh.vertices, mesh.faces[mesh.labels == label])
                   / area(points, faces[labels == label]) - 1) < 0.01
    assert mesh.report.crease_edges > 0 and set(mesh.labels) == {7, -2}
    assert powerrtf.remesh(points, faces, 100).labels is None
    with pytest.raises(ValueError, match="face_labels has 2 entries"):
        powerrtf.remesh(points, faces, 100, face_labels=[1, 2])


def test_labels_leave_the_sources_for_a_transfer(monkeypatch):
    labels = (POINTS[FACES].mean(axis=1)[:, 2] > 0).astype(np.int16)
    mesh = powerrtf.remesh(POINTS, FACES, 300, face_labels=labels)
    monkeypatch.delattr(powerrtf._core, "sources")
    assert mesh.labels.dtype == np.int16 and np.array_equal(mesh.transfer(labels, of="faces"), mesh.labels)
    assert np.abs(mesh.transfer(POINTS) - mesh.vertices).max() < 0.05


def test_faces_have_the_value_of_the_largest_share():
    points, faces = sphere(60)
    values = (np.random.default_rng(1).random(len(faces)) < 0.3).astype(np.uint8)
    mesh = powerrtf.remesh(points, faces, 150)
    shared = mesh.transfer(values, of="faces")
    assert shared.dtype == np.uint8 and shared.mean() < 0.15 < values[mesh._sources.of_faces].mean()
    names = np.array(["even", "odd"])[values]
    assert (mesh.transfer(names, of="faces") == np.array(["even", "odd"])[shared]).all()
    objects = mesh.transfer(np.array([None, "odd"], dtype=object)[values], of="faces")
    assert ((objects == "odd") == shared).all()
    rows = np.stack([values, 1 - values], axis=1)
    assert (mesh.transfer(rows, of="faces")[:, 0] == shared).all()


@pytest.mark.parametrize("real", [np.float32, np.float64])
def test_constrained_vertices_stay_bit_for_bit(real):
    points, faces = sphere(16, real)
    wanted = [3, 50, 77]
    mesh = powerrtf.remesh(points, faces, 200, constrained_vertices=wanted)
    assert mesh.missed_guarantees == [] and mesh.report.constrained_vertices == 3
    assert {tuple(p) for p in points[wanted].tolist()} <= {tuple(p) for p in mesh.vertices.tolist()}
    mask = np.isin(np.arange(len(points)), wanted)
    assert (powerrtf.remesh(points, faces, 200, constrained_vertices=mask).vertices == mesh.vertices).all()
    free = powerrtf.remesh(points, faces, 200, constrained_vertices=[])
    assert free.report.constrained_vertices == 0
    assert not {tuple(p) for p in points[wanted].tolist()} & {tuple(p) for p in free.vertices.tolist()}


@pytest.mark.parametrize("vertices, message", [
    ([True, False], "constrained_vertices has the shape"), ([-1], "none of the numbers"),
    ([10**6], "none of the numbers"), ([0.5], "whole numbers")])
def test_constrained_vertices_that_cannot_be_are_refused(vertices, message):
    with pytest.raises(ValueError, match=message):
        powerrtf.remesh(POINTS, FACES, 100, constrained_vertices=vertices)


@pytest.mark.parametrize("real", [np.float32, np.float64])
def test_what_is_no_region_stays_bit_for_bit(real):
    points, faces = sphere(16, real)
    inside = points[faces].mean(axis=1)[:, 2] > 0.2
    mesh = powerrtf.remesh(points, faces, 200, region=inside, face_labels=np.arange(len(faces)) // 50)
    kept = np.count_nonzero(~inside)
    assert mesh.missed_guarantees == [] and mesh.vertices.dtype == real
    assert (mesh.vertices[mesh.faces[:kept]] == points[faces[~inside]]).all()
    assert (mesh.labels[:kept] == np.arange(len(faces))[~inside] // 50).all()
    assert (mesh.transfer(points)[mesh.faces[:kept]] == points[faces[~inside]]).all()
    assert len(mesh.labels) == len(mesh.faces) == kept + mesh.report.faces
    assert (mesh.report.kept_faces, mesh.report.vertices) == (kept, 200)
    edges = np.sort(np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]]))
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    by_number = powerrtf.remesh(points, faces, 200, region=np.flatnonzero(inside),
                                face_labels=np.arange(len(faces)) // 50)
    assert (by_number.vertices == mesh.vertices).all()


@pytest.mark.parametrize("real", [np.float32, np.float64])
@pytest.mark.parametrize("length", [0.05, 0.4])
def test_the_border_of_a_region_may_be_remeshed_with_it(real, length):
    points, faces = sphere(16, real)
    inside = points[faces].mean(axis=1)[:, 2] > 0.2
    mesh = powerrtf.remesh(points, faces, edge_length=length, density="uniform", region=inside,
                           face_labels=inside.astype(int), region_border="remesh")
    report = mesh.report
    assert mesh.missed_guarantees == [] and report.changed_faces > 0
    assert len(mesh.faces) == report.kept_faces + report.changed_faces + report.faces
    assert (mesh.labels == 1).sum() == report.faces
    edges = np.sort(np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]]))
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    before = {tuple(map(tuple, triangle)) for triangle in points[faces[~inside]].tolist()}
    kept = mesh.vertices[mesh.faces[:report.kept_faces]]
    assert {tuple(map(tuple, triangle)) for triangle in kept.tolist()} <= before
    with pytest.raises(ValueError, match="there is none"):
        powerrtf.remesh(points, faces, 300, region_border="remesh")


@pytest.mark.parametrize("real", [np.float32, np.float64])
def test_a_symmetric_result_is_its_own_mirror_image(real):
    points, faces = sphere(16, real)
    mesh = powerrtf.remesh(points, faces, 301, symmetry="z")
    plane = mesh.report.symmetry
    assert mesh.missed_guarantees == [] and len(mesh.vertices) == 301
    assert plane["axis"] == "z" and plane["lone_facets"] == 0
    images = mesh.vertices.astype(np.float64) * [1, 1, -1] + [0, 0, 2 * plane["at"]]
    assert {tuple(p) for p in images} == {tuple(p) for p in mesh.vertices.astype(np.float64)}
    assert (images[:, 2] == mesh.vertices[:, 2]).sum() == plane["vertices"]
    cells = mesh.cells()
    above = [cell[:, 2].mean() > plane["at"] for cell in cells]
    assert len(cells) == 301 - plane["vertices"] and sum(above) == len(cells) // 2
    assert abs(cells.area[above].sum() - cells.area[np.invert(above)].sum()) < 1e-9


def test_what_is_not_symmetric_is_refused():
    points, faces = sphere(16, np.float64)
    points[points[:, 0] > 0.8] *= 2
    with pytest.raises(ValueError, match="not symmetric about the plane x"):
        powerrtf.remesh(points, faces, 301, symmetry="x")


@pytest.mark.parametrize("region, message", [
    ([], "no facet is in the region"), ([True, False], "region has the shape"),
    ([-1], "none of the numbers"), ([10**6], "none of the numbers"), ([0.5], "whole numbers")])
def test_a_region_that_cannot_be_is_refused(region, message):
    with pytest.raises(ValueError, match=message):
        powerrtf.remesh(POINTS, FACES, 100, region=region)


def test_patches_lie_between_creases():
    cube = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    mesh = powerrtf.remesh(cube, quads, 400, patches=True)
    centers = np.asarray(mesh.vertices)[mesh.faces].mean(axis=1)
    for patch in range(6):
        side = centers[mesh.patches == patch]
        assert len(side) > 50 and np.ptp(side, axis=0).min() < 1e-12
    assert powerrtf.remesh(cube, quads, 400).patches is None


def test_polygons_may_have_different_sizes():
    cube = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    mixed = quads[:5] + [[1, 5, 7], [1, 7, 3]]
    assert len(powerrtf.remesh(cube, quads, 200).vertices) == 200
    assert len(powerrtf.remesh(cube, mixed, 200).vertices) == 200


def changed(array, place, value):
    array = array.copy()
    array[place] = value
    return array


@pytest.mark.parametrize("arguments, message", [
    ((changed(POINTS, (7, 1), np.nan), FACES, 100), "vertex 7 .*not a finite"),
    ((changed(POINTS, (7, 1), np.inf), FACES, 100), "vertex 7 .*not a finite"),
    ((POINTS, changed(FACES, (5, 2), 99999), 100), "facet 5 refers to vertex 99999"),
    ((POINTS, changed(FACES, (5, 2), -1), 100), "facet 5 refers to vertex -1"),
    ((POINTS[:, :2], FACES, 100), r"vertices must have the shape \(m, 3\), not"),
    ((POINTS, FACES[:, :2], 100), "faces must have the shape"),
    ((POINTS, FACES.astype(float), 100), "faces must be whole numbers, not of type float64"),
    ((POINTS.astype(complex), FACES, 100), "vertices must be numbers, not of type complex"),
    ((POINTS, FACES[:0], 100), "facet|empty"),
    ((POINTS[:0], FACES, 100), "facet 0 refers to vertex"),
    ((POINTS, FACES, 3), "n is 3, but must be"),
    ((POINTS, FACES, 0), "n is 0, but must be"),
    ((POINTS, FACES, "many"), "n is 'many'"),
    ((POINTS, FACES), "one of n, edge_length, .* must be given, not 0"),
    ((POINTS,), "faces are missing"),
])
def test_wrong_input_is_refused_with_the_entry(arguments, message):
    with pytest.raises(powerrtf.InvalidInputError, match=message) as error:
        powerrtf.remesh(*arguments)
    assert isinstance(error.value, ValueError)


def test_wrong_options_are_refused():
    with pytest.raises(ValueError, match="gradation is -1, but must be a number from 0"):
        powerrtf.remesh(POINTS, FACES, 100, gradation=-1)
    with pytest.raises(ValueError, match="sampling is 'no', but must be one of lattice"):
        powerrtf.remesh(POINTS, FACES, 100, sampling="no")
    with pytest.raises(TypeError, match="unexpected keyword argument 'nonsense'"):
        powerrtf.remesh(POINTS, FACES, 100, nonsense=1)
    with pytest.raises(ValueError, match="density has 3 entries"):
        powerrtf.remesh(POINTS, FACES, 100, density=[1., 2, 3])


@pytest.mark.parametrize("options, message", [
    ({"gradation": -1}, "gradation is -1, but must be a number from 0"),
    ({"seed": "x"}, "seed is 'x', but must be a number from 0"),
    ({"traits": "gpu"}, "traits is 'gpu', but must be one of auto"),
    ({"density": np.ones(3)}, "density is array.*, but must be one of uniform"),
    ({"edge_length": 1, "vertex_share": 1}, "vertex_share, edge_length, .* only one")])
def test_options_are_checked_when_they_are_made(options, message):
    with pytest.raises(powerrtf.InvalidInputError, match=f"^(of )?{message}"):
        powerrtf.Options(**options)
    with pytest.raises(TypeError, match="unexpected keyword argument 'nonsense'"):
        powerrtf.Options(nonsense=1)


@pytest.mark.parametrize("name", [field.name for field in dataclasses.fields(powerrtf.Options)])
def test_messages_name_the_argument(name):
    with pytest.raises(powerrtf.InvalidInputError, match=f"^{name} is <object .*, but must be "):
        powerrtf.Options(**{name: object()})


def test_options_are_values_and_cannot_be_changed():
    coarse = powerrtf.Options(n=100, density="uniform")
    with pytest.raises(dataclasses.FrozenInstanceError):
        coarse.n = 200
    fine = dataclasses.replace(coarse, n=200)
    assert {coarse: 1, fine: 2}[powerrtf.Options(density="uniform", n=100)] == 1
    assert pickle.loads(pickle.dumps(fine)) == fine == powerrtf.Options(**fine.to_dict())
    assert repr(fine) == "Options(n=200, density='uniform')"


def test_options_are_those_of_the_keywords():
    keywords = [name for name, p in inspect.signature(powerrtf.remesh).parameters.items()
                if p.kind == p.KEYWORD_ONLY]
    fields = [field.name for field in dataclasses.fields(powerrtf.Options)]
    assert keywords[keywords.index("options") + 1:] == [name for name in fields if name != "n"]


def test_a_call_takes_options_and_changes_them(tmp_path):
    options = powerrtf.Options(n=100, density="uniform", seed=5)
    assert same(powerrtf.remesh(POINTS, FACES, options=options),
                powerrtf.remesh(POINTS, FACES, 100, density="uniform", seed=5))
    assert same(powerrtf.remesh(POINTS, FACES, 200, seed=None, options=options),
                powerrtf.remesh(POINTS, FACES, 200, density="uniform", seed=5))
    assert powerrtf.remesh(POINTS, FACES, edge_length=0.3, options=options).report.seed == 5
    powerrtf._core.write_mesh(str(tmp_path / "in.off"), POINTS, FACES, False)
    mesh = powerrtf.remesh_file(tmp_path / "in.off", tmp_path / "out.off", options=options)
    assert (mesh.report.vertices, mesh.report.seed) == (100, 5)


def test_report_is_that_of_the_program():
    report = powerrtf.remesh(POINTS, FACES, 100, seed=3, feature_angle=30).report
    assert report.vertices == report["vertices"] == dict(report)["vertices"] == 100
    assert report.seed == 3 and report.parameters.features == 30 and report.to_dict()["samples"] == 100


def test_same_bits_as_the_program(tmp_path):
    mesh = powerrtf.remesh(POINTS, FACES, 300, seed=5)
    text = "".join("%.17g %.17g %.17g\n" % tuple(p) for p in POINTS)
    text += "".join("3 %d %d %d\n" % tuple(f) for f in FACES)
    source = tmp_path / "in.off"
    source.write_text(f"OFF\n{len(POINTS)} {len(FACES)} 0\n{text}")
    files = [tmp_path / f"{name}.off" for name in ("program", "module", "function")]
    arguments = ["--samples", "300", "--seed", "5", "--quiet"]
    program = os.environ.get("POWER_RTF_REMESH")
    if not program:
        pytest.skip("POWER_RTF_REMESH does not name the program")
    subprocess.run([program, source, files[0], *arguments], check=True)
    subprocess.run([sys.executable, "-m", "powerrtf", source, files[1], *arguments], check=True)
    powerrtf.remesh_file(source, files[2], 300, seed=5)
    assert files[0].read_bytes() == files[1].read_bytes() == files[2].read_bytes()
    lines = files[0].read_text().split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith("300 ")) + 1
    rows = [line for line in lines[start:] if line]
    assert np.array_equal(np.array([r.split() for r in rows[:300]], float), mesh.vertices)
    assert np.array_equal(np.array([r.split()[1:4] for r in rows[300:]], int), mesh.faces)


def test_threads_at_once_give_the_same():
    expected = [powerrtf.remesh(POINTS, FACES, 500, seed=s) for s in (0, 1)]
    found = [None, None]

    def run(seed):
        found[seed] = powerrtf.remesh(POINTS, FACES, 500, seed=seed, threads=seed)
    threads = [threading.Thread(target=run, args=(s,)) for s in (0, 1)]
    [t.start() for t in threads]
    [t.join() for t in threads]
    assert all(same(a, b) for a, b in zip(expected, found))


def test_progress_is_told_and_its_exceptions_stop_the_run():
    seen = []
    powerrtf.remesh(POINTS, FACES, 500, progress=lambda share, stage: seen.append((share, stage)))
    assert {"surface", "sampling", "optimization"} <= {stage for _, stage in seen}
    assert all(0 <= share <= 1 for share, _ in seen)

    def stop(share, stage):
        if stage == "optimization":
            raise KeyError("enough")
    with pytest.raises(KeyError, match="enough"):
        powerrtf.remesh(POINTS, FACES, 500, progress=stop)


def test_interrupt_stops_the_run_within_a_fifth_of_a_second():
    signal.signal(signal.SIGINT, signal.default_int_handler)  # shells' background jobs ignore it
    sent = []

    def interrupt():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    timer = threading.Timer(.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        powerrtf.remesh(POINTS, FACES, 300000)
    assert time.monotonic() - sent[0] < .2


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


BATCH = 300


def leaked_bytes():
    """By how much a batch of calls and refused ones lets the memory grow. The allocator may keep
    more for a while after some of the batches; a leak shows in all of them."""
    points, faces = sphere(4)
    sizes = []
    for _ in range(6):
        for _ in range(BATCH):
            powerrtf.remesh(points, faces, 30, max_iterations=1)
            with pytest.raises(ValueError):
                powerrtf.remesh(points, faces + 1000, 30)
        sizes.append(resident())
    return min(after - before for before, after in zip(sizes, sizes[1:]))


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs /proc")
def test_calls_leak_nothing():
    # in a process of its own: what other tests have freed changes the figure
    found = subprocess.run([sys.executable, "-B", __file__], check=True, stdout=subprocess.PIPE)
    assert int(found.stdout) < 1000 * BATCH


if __name__ == "__main__":
    print(leaked_bytes())
