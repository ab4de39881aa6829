# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the meshes: small files while they come, and one table at the end."""

import glob
import os
import uuid

from .._core import __version__
from ._mesh import FAILURES, REFUSED, WRITTEN
from ._tables import arrow, read_tables, write_table

_ROWS_PER_PART = 100


def _schema():
    types = {"string": ("path", "status", "message", "output", "key", "options", "version"),
             "int64": ("seed", "vertices", "faces"),
             "float64": ("q_min", "q_avg", "theta_min", "distance_mean", "distance_rms", "distance_max",
                         "seconds", "time_limit", "memory_limit")}
    fields = [(name, getattr(arrow(), kind)()) for kind, names in types.items() for name in names]
    return arrow().schema([*fields, ("missed_guarantees", arrow().list_(arrow().string()))])


def _to_table(rows):
    """What a row lacks is null."""
    schema = _schema()
    return arrow().table({name: [row.get(name) for row in rows] for name in schema.names}, schema=schema)


def _given(entry):
    return {"path": entry.path, "options": " ".join(entry.arguments), "version": __version__}


def _worth(row):
    """Of several rows of a mesh, the last without a failure counts, or the last with the largest limits."""
    return row["status"] not in FAILURES, row["time_limit"], row["memory_limit"]


class Results:
    """What is in a folder of results.

    Rows are in the files of its folder ``parts``. The last file is replaced with each row, so that a kill
    costs none; when it has many, another one begins.
    """

    def __init__(self, folder, ending):
        self._folder = os.path.abspath(folder)
        self._ending = ending
        self._rows = {}  # by key
        self._part, self._part_rows = None, []
        os.makedirs(os.path.join(self._folder, "parts"), exist_ok=True)

    def read(self, keys):
        """Reads the rows of these keys, whatever process has written them."""
        parts = glob.glob(os.path.join(glob.escape(self._folder), "parts", "*.parquet"))
        table = read_tables(sorted(parts, key=os.path.getmtime), _schema())
        own = arrow().compute.is_in(table["key"], arrow().array(keys, arrow().string()))
        self._rows = {row["key"]: row for row in sorted(table.filter(own).to_pylist(), key=_worth)}

    def _output(self, key):
        return os.path.join("meshes", key[:2], f"{key}.{self._ending}")

    def output(self, key):
        """The file of the mesh."""
        return os.path.join(self._folder, self._output(key))

    def is_done(self, key, limits):
        """Whether there is a result, or a failure under limits that were not smaller."""
        row = self._rows.get(key)
        if row is None:
            return False
        if row["status"] in FAILURES:
            return all(row[name] >= limit for name, limit in limits.items())
        return row["status"] not in WRITTEN or os.path.exists(self.output(key))

    def add(self, key, entry, limits, found):
        """Keeps what remesh_one() has found."""
        output = self._output(key) if found["status"] in WRITTEN else None
        self._rows[key] = {**_given(entry), "key": key, "output": output, **limits, **found}
        if not self._part_rows:
            self._part = os.path.join(self._folder, "parts", f"{uuid.uuid4().hex}.parquet")
        self._part_rows.append(self._rows[key])
        write_table(_to_table(self._part_rows), self._part)
        if len(self._part_rows) == _ROWS_PER_PART:
            self._part_rows = []

    def table(self, entries, keys):
        """A row for each entry; `keys` has what key_of() says of them."""
        return _to_table([{**(self._rows[key] if key else {"status": REFUSED, "message": reason}),
                           **_given(entry)} for entry, (key, reason) in zip(entries, keys)])

    def write_summary(self, table):
        write_table(table, os.path.join(self._folder, "summary.parquet"))
