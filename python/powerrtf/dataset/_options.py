# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of :func:`powerrtf.remesh` as arguments of the program."""

from .._core import InvalidInputError
from .._options import DEFAULTS, Options


def _plain(value):
    if isinstance(value, float) and value.is_integer():  # as pandas has whole numbers where some are missing
        return int(value)
    return value


def _text(value):
    return {False: "no", True: "yes"}[value] if isinstance(value, bool) else str(value)


def arguments(options):
    """The program's arguments, in one order; what runs the algorithm is the CPU unless ``traits`` says
    otherwise, since it must not depend on the machine.

    :raises InvalidInputError: an option has a value that is not allowed

    >>> arguments({"seed": 3, "n": 200.0, "repair": False})
    ('--samples', '200', '--repair', 'no', '--seed', '3', '--traits', 'cpu')
    """
    options = Options(**{name: _plain(value) for name, value in {"traits": "cpu", **options}.items()})
    if options.size_factor:
        raise InvalidInputError("size_factor needs a sizing field, but a dataset has none")
    result = []
    for name, value in sorted(options.to_dict().items()):
        flag = "--samples" if name == "n" else "--" + name.replace("_", "-")
        if DEFAULTS[name] is not False:
            result += [flag, _text(value)]
        elif value:  # a switch
            result.append(flag)
    return tuple(result)
