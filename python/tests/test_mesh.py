# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What users do with a result, and the kinds of arrays and meshes that they have."""
import pickle

import numpy as np
import pytest

import powerrtf
from shapes import FACES, POINTS, sphere

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
                  [1, 5, 7, 3]])


def test_cells_tile_the_surface():
    mesh = powerrtf.remesh(*sphere(24), 1000, density="uniform")
    cells = mesh.cells()
    assert len(cells) == 1000 and (cells.status == 0).all()
    assert abs(cells.area.sum() / (4 * np.pi) - 1) < .01
    assert np.allclose(cells.mass, cells.area * cells.density)
    assert abs(cells.sides.mean() - 6) < .02
    a, b = cells[7][1:-1] - cells[7][0], cells[7][2:] - cells[7][0]
    assert np.isclose(np.linalg.norm(np.cross(a, b).sum(0)) / 2, cells.area[7])
    assert np.linalg.norm(cells[7].mean(0) - mesh.vertices[7]) < np.sqrt(cells.area[7])
    with pytest.raises(IndexError):
        cells[1000]


def test_samples_on_creases_have_no_cells():
    mesh = powerrtf.remesh(CUBE, QUADS, 600, density="uniform")
    cells = mesh.cells()
    assert len(cells) == 600 - mesh.report.feature_samples
    assert .8 * 6 < cells.area.sum() < 6  # half a row of cells is missing along each edge


@pytest.mark.parametrize("traits", ["cpu", "exact"])
def test_cells_are_those_of_the_report(traits):
    mesh = powerrtf.remesh(CUBE * 1e3 + 5e4, QUADS, 600, traits=traits)
    cells = mesh.cells()
    for status, name in enumerate(("ok", "guarded", "empty", "incomplete")):
        assert (cells.status == status).sum() == mesh.report.cells[name]
    ok = cells.status == 0
    rms = np.sqrt(((cells.mass[ok] / cells.mass[ok].mean() - 1) ** 2).mean())
    assert abs(rms - mesh.report.capacity_rms) < 1e-3


def test_a_result_can_be_pickled():
    mesh = powerrtf.remesh(POINTS, FACES, 100)
    again = pickle.loads(pickle.dumps(mesh))
    assert np.array_equal(again.vertices, mesh.vertices) and again.report == mesh.report
    assert np.array_equal(again.cells().points, mesh.cells().points)


def test_vertices_know_where_they_come_from():
    mesh = powerrtf.remesh(CUBE * 1e3 + 5e4, QUADS, 600)
    corners, weights = mesh.source_vertices, mesh.barycentric
    assert (weights >= 0).all() and np.allclose(weights.sum(1), 1)
    for k in range(3):
        assert (QUADS[mesh.source_face] == corners[:, k, None]).any(1).all()
    places = (weights[..., None] * (CUBE * 1e3 + 5e4)[corners]).sum(1)
    assert np.abs(places - mesh.vertices).max() < 1e-6  # a cube is its own remesh
    again = pickle.loads(pickle.dumps(mesh))
    assert np.array_equal(again.source_face, mesh.source_face)


def test_values_are_transferred():
    mesh = powerrtf.remesh(CUBE, QUADS, 600)
    assert np.abs(mesh.transfer(CUBE) - mesh.vertices).max() < 1e-9
    heights = mesh.transfer(CUBE[:, 2].astype(np.float32))
    assert heights.dtype == np.float32 and heights.shape == (600,)
    corner = mesh.transfer(np.arange(8))  # labels are not mixed
    assert corner.dtype == np.arange(8).dtype and np.abs(CUBE[corner] - mesh.vertices).max() < 1
    face = mesh.transfer(np.arange(6), of="faces")
    centers = mesh.vertices[mesh.faces].mean(1)
    sides = np.einsum("nd,nd->n", centers - .5, CUBE[QUADS].mean(1)[face] - .5)
    assert np.allclose(sides, .25)
    with pytest.raises(powerrtf.InvalidInputError, match="each of the input's 8 vertices"):
        mesh.transfer(np.arange(6))
    with pytest.raises(powerrtf.InvalidInputError, match=r"must be one of vertices\|faces"):
        mesh.transfer(CUBE, of="edges")


def test_sources_of_polygons_of_different_sizes():
    faces = [[0, 1, 3], [0, 3, 2], *QUADS[1:].tolist()]
    mesh = powerrtf.remesh(CUBE, faces, 300)
    assert set(mesh.source_face) <= set(range(7))
    assert all(set(c) <= set(faces[f]) for c, f in zip(mesh.source_vertices, mesh.source_face))


class WithArrayInterface:
    def __init__(self, array):
        self._array = array
        self.__array_interface__ = array.__array_interface__


class WithDLPack:
    def __init__(self, array):
        self._array = array

    def __dlpack__(self, **arguments):
        return self._array.__dlpack__(**arguments)

    def __dlpack_device__(self):
        return self._array.__dlpack_device__()


class OnDevice(WithDLPack):
    """As cupy's."""

    def __dlpack_device__(self):
        return 2, 0

    def get(self):
        return self._array


@pytest.mark.parametrize("kind", [WithArrayInterface, WithDLPack, OnDevice])
def test_arrays_of_other_libraries_are_taken(kind):
    expected = powerrtf.remesh(POINTS, FACES, 100)
    found = powerrtf.remesh(kind(POINTS), kind(FACES), 100)
    assert np.array_equal(found.vertices, expected.vertices)


def test_a_tensor_gives_tensors():
    torch = pytest.importorskip("torch")
    points = torch.tensor(POINTS, dtype=torch.float32, requires_grad=True)
    mesh = powerrtf.remesh(points, torch.tensor(FACES), 100)
    assert isinstance(mesh.vertices, torch.Tensor) and mesh.vertices.dtype == torch.float32
    assert mesh.faces.dtype == torch.int64 and mesh.to_trimesh().is_watertight


def test_a_missed_guarantee_is_a_warning():
    # two spheres through each other: the result's triangles intersect, too
    points = np.vstack([POINTS, POINTS + [.5, 0, 0]])
    faces = np.vstack([FACES, FACES + len(POINTS)])
    with pytest.warns(powerrtf.MissedGuaranteeWarning, match="self-intersecting"):
        mesh = powerrtf.remesh(points, faces, 400)
    assert len(mesh.missed_guarantees) == 1 and len(mesh.vertices) == 400


def test_a_bar_shows_the_progress(capsys):
    pytest.importorskip("tqdm")
    powerrtf.remesh(POINTS, FACES, 500, progress=True)
    shown = capsys.readouterr().err
    assert "optimization" in shown and "100%" in shown


def test_trimesh_in_and_out():
    trimesh = pytest.importorskip("trimesh")
    found = powerrtf.remesh_trimesh(trimesh.Trimesh(POINTS, FACES, process=False), 100)
    assert found.is_watertight and found.volume > 3.9 and len(found.vertices) == 100
    assert np.array_equal(found.vertices, powerrtf.remesh(POINTS, FACES, 100).vertices)


def test_meshio_in_and_out():
    meshio = pytest.importorskip("meshio")
    mixed = meshio.Mesh(CUBE, [("quad", QUADS[:5]), ("triangle", [[1, 5, 7], [1, 7, 3]]),
                               ("line", [[0, 1]])])
    found = powerrtf.remesh(mixed, n=200).to_meshio()
    assert len(found.points) == 200 and found.cells[0].type == "triangle"


def test_pyvista_in_and_out():
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.PolyData.from_regular_faces(CUBE, QUADS)
    result = powerrtf.remesh(mesh, n=200)
    found = result.to_pyvista()
    assert found.n_points == 200 and found.is_all_triangles and found.n_open_edges == 0
    cells = result.cells().to_pyvista()
    assert cells.n_cells == len(result.cells()) and np.isclose(
        cells.compute_cell_sizes()["Area"].sum(), result.cells().area.sum())
    mixed = pyvista.PolyData(CUBE, np.hstack([[4, *q] for q in QUADS[:5]] + [[3, 1, 5, 7],
                                                                            [3, 1, 7, 3]]))
    assert powerrtf.remesh(mixed, n=200).to_pyvista().n_open_edges == 0


def test_pyvista_has_the_accessor():
    pyvista = pytest.importorskip("pyvista")
    if not hasattr(pyvista, "register_dataset_accessor"):
        pytest.skip("this pyvista has no accessors")
    import powerrtf._pyvista  # noqa: F401  (as the entry point does where the package is installed)
    found = pyvista.PolyData.from_regular_faces(POINTS, FACES).powerrtf.remesh(100, seed=2)
    assert found.n_points == 100 and found.user_dict["powerrtf"]["seed"] == 2


def test_open3d_in_and_out():
    class Open3d:  # what is read of open3d's mesh, which is a large package
        vertices, triangles = POINTS, FACES.astype(np.int32)
    assert len(powerrtf.remesh(Open3d(), n=100).vertices) == 100
    open3d = pytest.importorskip("open3d")
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(POINTS),
                                        open3d.utility.Vector3iVector(FACES.astype(np.int32)))
    assert powerrtf.remesh_open3d(mesh, 100).is_watertight()


def _folded_strip(n):
    """A strip of n squares around a cylinder, and the uv of its corners: one chart that is cut where x = 1."""
    angle = np.arange(n) * 2 * np.pi / n
    points = np.concatenate([np.stack([np.cos(angle), np.sin(angle), np.full(n, z)], 1) for z in (0., 1)])
    i, j = np.arange(n), (np.arange(n) + 1) % n
    faces = np.concatenate([np.stack([i, j, j + n], 1), np.stack([i, j + n, i + n], 1)])
    u = np.stack([i, i + 1, i + 1], 1), np.stack([i, i + 1, i], 1)
    v = np.repeat([[0, 0, 1]], n, 0), np.repeat([[0, 1, 1]], n, 0)
    return points, faces, np.stack([np.concatenate(u) / n, np.concatenate(v)], 2)


@pytest.mark.parametrize("real", [np.float32, np.float64])
def test_texture_coordinates_come_over_with_their_seams(real):
    points, faces, uv = _folded_strip(48)
    points, uv = points.astype(real), uv.astype(real)
    mesh = powerrtf.remesh(points, faces, 400, uv=uv, density="uniform")
    assert mesh.missed_guarantees == [] and mesh.uv.shape == (len(mesh.faces), 3, 2) and mesh.uv.dtype == real
    angle = mesh.uv[..., 0] * 2 * np.pi
    places = np.stack([np.cos(angle), np.sin(angle), mesh.uv[..., 1]], 2)
    assert np.abs(places - mesh.vertices[mesh.faces]).max() < .02
    a, b = mesh.uv[:, 1] - mesh.uv[:, 0], mesh.uv[:, 2] - mesh.uv[:, 0]
    areas = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    assert (areas > 0).all() and abs(areas.sum() - 1) < 1e-5
    on_cut = np.abs(mesh.vertices[:, 1]) + (mesh.vertices[:, 0] < 0) < 1e-6
    pairs = {(v, round(float(u), 6)) for v, u in zip(mesh.faces.ravel(), mesh.uv[..., 0].ravel())}
    assert on_cut.sum() > 3 and len(pairs) == len(mesh.vertices) + on_cut.sum()

    rows = powerrtf.remesh(points, faces, 400, uv=uv.reshape(-1, 2), density="uniform")
    assert (rows.uv == mesh.uv).all() and (rows.vertices == mesh.vertices).all()
    assert (pickle.loads(pickle.dumps(mesh)).transfer(uv, of="corners") == mesh.uv).all()
    charts = mesh.transfer(np.repeat(np.arange(len(faces)), 3), of="corners")
    assert charts.shape == mesh.faces.shape


def test_texture_coordinates_of_polygons_and_of_a_region():
    uv = np.array([[[0, 0], [1, 0], [1, 1], [0, 1]]] * 6) + 2. * np.arange(6)[:, None, None]
    whole = powerrtf.remesh(CUBE, QUADS, 300, uv=uv)
    charts = whole.uv[:, :, 0].mean(1) // 2
    assert set(charts) == set(range(6)) and np.ptp(whole.uv - 2 * charts[:, None, None]) <= 1 + 1e-9
    for border in ("keep", "remesh"):
        part = powerrtf.remesh(CUBE, QUADS, 300, uv=uv, region=[0, 2, 4], region_border=border)
        charts = part.uv[:, :, 0].mean(1) // 2
        assert set(charts) == set(range(6)) and np.ptp(part.uv - 2 * charts[:, None, None]) <= 1 + 1e-9


@pytest.mark.parametrize("uv, message", [
    (np.zeros((5, 4, 2)), "the 24 corners of 6 faces"), (np.zeros((24, 3)), "the 24 corners"),
    (np.full((24, 2), np.inf), "not a finite number"), (np.zeros(24), "the 24 corners"),
    ([["a", "b"]] * 24, "uv must be numbers")])
def test_wrong_texture_coordinates_are_refused(uv, message):
    with pytest.raises(powerrtf.InvalidInputError, match=message):
        powerrtf.remesh(CUBE, QUADS, 300, uv=uv)


def test_corners_without_seams_are_refused():
    mesh = powerrtf.remesh(CUBE, QUADS, 300)
    assert mesh.uv is None
    with pytest.raises(powerrtf.InvalidInputError, match="told by uv only"):
        mesh.transfer(np.zeros((24, 2)), of="corners")
    with pytest.raises(powerrtf.InvalidInputError, match="exclude each other"):
        powerrtf.remesh(CUBE, QUADS, 300, uv=np.zeros((24, 2)), symmetry="x")
