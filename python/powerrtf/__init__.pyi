# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

class InvalidInputError(ValueError): ...
class OutputError(OSError): ...
class MissedGuaranteeWarning(UserWarning): ...

class Report(Mapping[str, Any]):
    def __getitem__(self, name: str) -> Any: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __getattr__(self, name: str) -> Any: ...
    def to_dict(self) -> dict[str, Any]: ...

class Cells:
    points: NDArray[np.float64]
    first: NDArray[np.int32]
    area: NDArray[np.float64]
    mass: NDArray[np.float64]
    density: NDArray[np.float64]
    weight: NDArray[np.float64]
    status: NDArray[np.int32]
    def __len__(self) -> int: ...
    def __getitem__(self, i: int) -> NDArray[np.float64]: ...
    @property
    def sides(self) -> NDArray[np.int32]: ...
    def to_pyvista(self) -> Any: ...

class Mesh:
    vertices: Any
    faces: Any
    labels: Any
    uv: Any
    patches: NDArray[np.int32] | None
    report: Report
    def __iter__(self) -> Iterator[Any]: ...
    @property
    def missed_guarantees(self) -> list[str]: ...
    def cells(self) -> Cells: ...
    @property
    def source_face(self) -> NDArray[np.int32]: ...
    @property
    def source_vertices(self) -> NDArray[np.int32]: ...
    @property
    def barycentric(self) -> NDArray[np.float64]: ...
    def transfer(self, values: Any, of: str = "vertices") -> Any: ...
    def show(self, height: int = 900) -> Any: ...
    def to_trimesh(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_meshio(self) -> Any: ...
    def to_open3d(self) -> Any: ...

@dataclass(frozen=True)
class Options:
    preset: str | None = None
    traits: str | None = None
    n: int | None = None
    vertex_share: float | None = None
    edge_length: float | None = None
    relative_edge_length: float | None = None
    size_factor: float | None = None
    max_distance: float | None = None
    relative_max_distance: float | None = None
    min_angle: float | None = None
    max_angle: float | None = None
    density: str | None = None
    seed: int | None = None
    feature_angle: float | None = None
    repair: bool | None = None
    merge_distance: float | None = None
    non_manifold: str | None = None
    intersections: str | None = None
    wrap_radius: float | None = None
    symmetry: str | None = None
    region_border: str | None = None
    density_power: float | None = None
    gradation: float | None = None
    density_smoothing: float | None = None
    thin: str | None = None
    min_edge_length: float | None = None
    max_edge_length: float | None = None
    sampling: str | None = None
    oversampling: float | None = None
    relaxation_iterations: int | None = None
    attributes: str | None = None
    normal_neighbors: int | None = None
    density_neighbors: int | None = None
    normal_smoothing: float | None = None
    neighbors: int | None = None
    normal_angle: float | None = None
    guard_factor: float | None = None
    certified_combinatorics: bool | None = None
    position_method: str | None = None
    max_iterations: int | None = None
    centroid_tolerance: float | None = None
    lbfgs_memory: int | None = None
    projection: str | None = None
    projection_neighbors: int | None = None
    centroid_density_power: float | None = None
    weight_method: str | None = None
    capacity_tolerance: float | None = None
    max_weight_iterations: int | None = None
    weight_step: float | None = None
    weight_operator: str | None = None
    weights_end: str | None = None
    extraction: str | None = None
    improvement: bool | None = None
    dislocations: str | None = None
    device: int | None = None
    def to_dict(self) -> dict[str, Any]: ...

def remesh(
    vertices: Any,
    faces: Any = None,
    n: int | None = None,
    *,
    size_field: Any = None,
    refine: Iterable[str] = (),
    constrained_edges: Any = None,
    constrained_vertices: Any = None,
    face_labels: Any = None,
    region: Any = None,
    uv: Any = None,
    patches: bool = False,
    threads: int = 0,
    progress: Callable[[float, str], Any] | bool | None = None,
    options: Options | None = None,
    preset: str = "quality",
    traits: str = "auto",
    vertex_share: float = 0.0,
    edge_length: float = 0.0,
    relative_edge_length: float = 0.0,
    size_factor: float = 0.0,
    max_distance: float = 0.0,
    relative_max_distance: float = 0.0,
    min_angle: float = 0.0,
    max_angle: float = 180.0,
    density: Any = "curvature",
    seed: int = 0,
    feature_angle: float = 40.0,
    repair: bool = True,
    merge_distance: float = 0.0,
    non_manifold: str = "keep",
    intersections: str = "keep",
    wrap_radius: float = 0.0,
    symmetry: str = "none",
    region_border: str = "keep",
    density_power: float = 1.0,
    gradation: float = 0.1,
    density_smoothing: float = 3.0,
    thin: str = "keep",
    min_edge_length: float = 0.0,
    max_edge_length: float = 0.0,
    sampling: str = "lattice",
    oversampling: float = 4.0,
    relaxation_iterations: int = 0,
    attributes: str = "facet",
    normal_neighbors: int = 12,
    density_neighbors: int = 12,
    normal_smoothing: float = 0.7,
    neighbors: int = 32,
    normal_angle: float = 140.0,
    guard_factor: float = 3.0,
    certified_combinatorics: bool = False,
    position_method: str = "lbfgs",
    max_iterations: int = 100,
    centroid_tolerance: float = 0.002,
    lbfgs_memory: int = 5,
    projection: str = "nearest-facet",
    projection_neighbors: int = 16,
    centroid_density_power: float = 2.0,
    weight_method: str = "newton",
    capacity_tolerance: float = 0.04,
    max_weight_iterations: int = 30,
    weight_step: float = 1.0,
    weight_operator: str = "ceiling",
    weights_end: str = "inside",
    extraction: str = "cells",
    improvement: bool = True,
    dislocations: str = "annihilate",
    device: int = 0,
) -> Mesh: ...
def remesh_file(
    input: str | PathLike[str],
    output: str | PathLike[str],
    n: int | None = None,
    *,
    ascii: bool = False,
    refine: Iterable[str] = (),
    threads: int = 0,
    progress: Callable[[float, str], Any] | bool | None = None,
    options: Options | None = None,
    **single: Any,
) -> Mesh: ...
def remesh_trimesh(mesh: Any, n: int | None = None, **options: Any) -> Any: ...
def remesh_open3d(mesh: Any, n: int | None = None, **options: Any) -> Any: ...
def report_html(mesh: Mesh, file: str | PathLike[str]) -> None: ...
