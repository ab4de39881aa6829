#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an installed Python package is, as JSON.

python_package.py PACKAGE [--names]

version: of the package; with --names, names: of what it holds, none if it cannot be imported.
"""

import importlib
import importlib.metadata
import json
import sys


def main():
    package, *options = sys.argv[1:]
    found = {"version": importlib.metadata.version(package)}
    if options == ["--names"]:
        try:
            found["names"] = dir(importlib.import_module(package))
        except ImportError:
            found["names"] = []
    print(json.dumps(found))


if __name__ == "__main__":
    main()
