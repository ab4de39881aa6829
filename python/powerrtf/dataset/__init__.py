# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Many meshes: on one machine, on a cluster of Dask or Ray, or as an array of Slurm's jobs.

Needs pyarrow: pip install 'powerrtf[dataset]'. As a program: python -m powerrtf.dataset --help
"""

from ._executors import RayExecutor
from ._manifest import write_manifest
from ._plots import plot_summary
from ._run import remesh_dataset

__all__ = ["RayExecutor", "plot_summary", "remesh_dataset", "write_manifest"]
