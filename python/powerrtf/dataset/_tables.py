# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parquet files: read and written as a whole."""

import os


def arrow():
    """The module pyarrow, with its compute and parquet."""
    try:
        import pyarrow.compute
        import pyarrow.parquet
    except ImportError as error:
        raise ImportError("powerrtf.dataset needs pyarrow: pip install 'powerrtf[dataset]'") from error
    return pyarrow


def write_table(table, file):
    """Writes a table; a file of that name is replaced by the whole new one, or not at all."""
    temporary = f"{file}.{os.getpid()}.tmp"
    arrow().parquet.write_table(table, temporary)
    os.replace(temporary, file)


def read_tables(files, schema=None):
    """The rows of these files, one after the other.

    :raises ValueError: a file is no Parquet file
    """
    tables = []
    for file in files:
        try:
            tables.append(arrow().parquet.ParquetFile(file).read())
        except arrow().ArrowInvalid as error:
            raise ValueError(f"{file}: cannot be read: {error}") from error
    return arrow().concat_tables(tables or [schema.empty_table()])
