# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of :func:`powerrtf.remesh` as arguments of the program."""

import inspect

from .._page import RESOLUTIONS
from .._remesh import remesh

_OF_ARRAYS = {"vertices", "faces", "sizing", "refine", "constrained_edges", "labels", "region", "patches",
              "threads", "progress"}
_RESOLUTIONS = {"n", *RESOLUTIONS}
DEFAULTS = {name: parameter.default for name, parameter in inspect.signature(remesh).parameters.items()
            if name not in _OF_ARRAYS}


def merged(common, own):
    """`common` options with those of one mesh, whose resolution, if it has one, replaces the other."""
    if _RESOLUTIONS & own.keys():
        common = {name: value for name, value in common.items() if name not in _RESOLUTIONS}
    return {**common, **own}


def _text(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and value.is_integer():  # as pandas has whole numbers where some are missing
        value = int(value)
    return str(value)


def arguments(options):
    """The program's arguments, in one order; what runs the algorithm is the CPU unless ``traits`` says
    otherwise, since it must not depend on the machine.

    >>> arguments({"seed": 3, "n": 200.0, "repair": False})
    ('--samples', '200', '--repair', 'no', '--seed', '3', '--traits', 'cpu')
    """
    result = []
    for name, value in sorted({"traits": "cpu", **options}.items()):
        flag = "--samples" if name == "n" else "--" + name.replace("_", "-")
        if DEFAULTS[name] is not False:
            result += [flag, _text(value)]
        elif _text(value) == "yes":  # a switch
            result.append(flag)
    return tuple(result)
