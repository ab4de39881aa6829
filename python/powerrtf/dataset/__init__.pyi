# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
from collections.abc import Callable, Iterable
from concurrent.futures import Executor, Future
from os import PathLike
from typing import Any

from .. import Options

class RayExecutor(Executor):
    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]: ...

def plot_summary(table: Any, file: str | PathLike[str]) -> None: ...
def remesh_dataset(
    manifest: str | PathLike[str],
    out: str | PathLike[str],
    n: int | None = None,
    *,
    executor: Any = None,
    rank: int = 0,
    world: int = 1,
    format: str = "ply",
    time_limit: float = 600.0,
    memory_limit: float = 4.0,
    progress: bool = False,
    options: Options | None = None,
    **single: Any,
) -> Any: ...
def write_manifest(
    manifest: str | PathLike[str],
    meshes: str | PathLike[str] | Iterable[str | PathLike[str]],
    **options: list[Any],
) -> None: ...
