# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The function remesh_dataset()."""

from .._options import given_options
from ._executors import for_each, or_threads
from ._manifest import read_manifest
from ._mesh import key_of, remesh_one
from ._results import Results

_LAST_LIMITS = 4  # times those of the first pass


def remesh_dataset(manifest, out, n=None, *, executor=None, rank=0, world=1, format="ply", time_limit=600.0,
                   memory_limit=4.0, progress=False, options=None, **single):
    """Remeshes many files, each in a process of its own, with one thread: what crashes, hangs or eats
    memory costs one mesh. What former calls have finished is not done again, however they ended.
    Failures are tried once more at the end, with four times the limits.

    Meshes are written to ``out/meshes``, by the hash of all that they depend on: the input's bytes, the
    options, the format and the version. They are the same, bit by bit, for any executor. Their rows are
    in ``out/parts``, and at the end, in the order of the manifest, in ``out/summary.parquet``: ``path``,
    ``status`` ("met", "missed guarantees", "refused", "crashed", "timed out" or "out of memory"),
    ``message``, ``output``, ``key``, ``options``, ``version``, ``seed``, ``vertices``, ``faces``,
    ``q_min``, ``q_avg``, ``theta_min`` in degrees, ``distance_mean``, ``distance_rms`` and
    ``distance_max`` in % of the input's diagonal, ``seconds``, the limits and ``missed_guarantees``.

    :param manifest: see :func:`write_manifest`
    :param out: a folder, which all workers see
    :param n: the number of vertices; or an option as ``edge_length``, as in :func:`powerrtf.remesh`
    :param executor: what has ``submit()`` as ``concurrent.futures``: Dask's ``client.get_executor()``, a
        :class:`RayExecutor`, a pool; None: a thread for each core, which waits for the meshes' processes
    :param rank: does every `world`-th mesh, beginning with this one, and writes no summary
    :param format: "off", "obj", "ply", "stl", "vtp", "vtu" or "msh"
    :param time_limit: seconds for a mesh
    :param memory_limit: GiB of address space for a mesh
    :param progress: whether to show a bar (with tqdm)
    :param options: a :class:`powerrtf.Options`, or these options as arguments; ``traits`` is "cpu"
    :returns: the summary, or this rank's rows of it, a ``pyarrow.Table``
    :raises ValueError: the manifest cannot be used
    :raises TypeError: there is no such option
    :raises OutputError: a mesh cannot be written, say since the disk is full
    """
    if not 0 <= rank < world:
        raise ValueError(f"rank is {rank}, but must be from 0 to {world - 1}")
    entries = read_manifest(manifest, given_options(options, n, single))[rank::world]
    results = Results(out, format)
    with or_threads(executor) as workers:
        keys = _keys(workers, entries, format)
        results.read([key for key, _ in keys])
        for factor, what in ((1, "meshes"), (_LAST_LIMITS, "failures")):
            limits = {"time_limit": factor * time_limit, "memory_limit": factor * memory_limit}
            todo = {key: entry for entry, (key, _) in zip(entries, keys)
                    if key and not results.is_done(key, limits)}
            _remesh(workers, todo, results, limits, _bar(len(todo), what) if progress else None)
    table = results.table(entries, keys)
    if world == 1:
        results.write_summary(table)
    return table


def _keys(workers, entries, format):
    """What key_of() says of each entry."""
    keys = {}
    calls = {entry[1:]: (*entry[1:], format) for entry in entries}
    for_each(workers, key_of, calls, keys.__setitem__)
    return [keys[entry[1:]] for entry in entries]


def _remesh(workers, todo, results, limits, bar):
    """Remeshes the entries of `todo`, by key."""
    def take(key, found):
        results.add(key, todo[key], limits, found)
        if bar is not None:
            bar.update()
    for_each(workers, remesh_one, {key: (entry.file, results.output(key), entry.arguments, *limits.values())
                                   for key, entry in todo.items()}, take)
    if bar is not None:
        bar.close()


def _bar(total, what):
    from tqdm.auto import tqdm
    return tqdm(total=total, desc=what, unit="mesh", disable=None)
