# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls by executors, those of ``concurrent.futures`` or what looks like them."""

import contextlib
import itertools
import os
import queue
from concurrent.futures import Executor, ThreadPoolExecutor

_MAX_WAITING = 10000  # calls that an executor holds at a time


class RayExecutor(Executor):
    """``concurrent.futures``' interface to the cluster that ``ray.init()`` has connected to; each call takes
    a core. Ray has none of its own: its pool is that of ``multiprocessing``, and joblib's interface has no
    futures; but its references turn into futures."""

    def __init__(self):
        import ray
        self._call = ray.remote(lambda function, *args, **kwargs: function(*args, **kwargs))

    def submit(self, function, /, *args, **kwargs):
        return self._call.remote(function, *args, **kwargs).future()


def or_threads(executor):
    """A context with this executor, or with threads, one for each core that this process may use."""
    if executor is not None:
        return contextlib.nullcontext(executor)
    return ThreadPoolExecutor(len(os.sched_getaffinity(0)))


def for_each(executor, function, calls, take):
    """Calls `function` with each of `calls`, tuples of arguments by name. `take` gets the name and the
    result as they come. What either raises cancels the calls that have not begun."""
    calls, running, finished = iter(calls.items()), {}, queue.SimpleQueue()

    def submit_next(count):
        for name, arguments in itertools.islice(calls, count):
            future = executor.submit(function, *arguments)
            running[future] = name
            future.add_done_callback(finished.put)
    try:
        submit_next(_MAX_WAITING)
        while running:
            future = finished.get()
            submit_next(1)
            take(running.pop(future), future.result())
    finally:
        for future in running:
            future.cancel()
