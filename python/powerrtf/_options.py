# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a run that are plain values, from the library's table."""

import dataclasses

from . import _core

RESOLUTIONS = ("n", "edge_length", "relative_edge_length", "max_distance", "relative_max_distance",
               "vertex_share", "size_factor")
PRESETS = ("quality", "fast", "paper")

# by name: what it means and its value in each preset; the precision is that of the input
ROWS = {name: (f"{meaning}; {allowed}", dict(zip(PRESETS, values)))
        for name, *values, meaning, allowed in _core.options() if name != "coordinates"}
DEFAULTS = {"preset": "quality", "traits": "auto", **{name: row[1]["quality"] for name, row in ROWS.items()}}


def merged(common, own):
    """`common` options, changed by `own`, whose resolution, if it has one, replaces the other."""
    if not own.keys().isdisjoint(RESOLUTIONS):
        common = {name: value for name, value in common.items() if name not in RESOLUTIONS}
    return {**common, **own}


def given_options(options, n, single):
    """The options of a call: those of an :class:`Options`, if there is one, changed by its own."""
    for name in single.keys() - DEFAULTS.keys():
        raise TypeError(f"unexpected keyword argument {name!r}")
    single = {name: value for name, value in {**single, "n": n}.items() if value is not None}
    return single if options is None else merged(options.to_dict(), single)


def check_traits(traits):
    if traits not in _core.traits:
        raise _core.InvalidInputError(f"traits is {traits!r}, but must be one of {'|'.join(_core.traits)}")


_DOC = """Options for any number of runs, ``remesh(..., options=)``: those of :func:`remesh` that are plain
values. They are checked at once and cannot be changed; equal ones have one hash. What is None, as
by default, is not given: the preset says it. Arguments that a call has of its own come first.

:raises InvalidInputError: an option has a value that is not allowed (a :class:`ValueError`)

>>> import dataclasses, powerrtf
>>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
>>> even = powerrtf.Options(n=100, density="uniform")
>>> powerrtf.remesh(square, [[0, 1, 2, 3]], options=even)
Mesh(100 vertices, 166 faces)
>>> dataclasses.replace(even, n=None, edge_length=0.1)
Options(edge_length=0.1, density='uniform')
>>> powerrtf.Options(gradation=-1)
Traceback (most recent call last):
    ...
powerrtf._core.InvalidInputError: gradation is -1, but must be a number from 0 to 1000
"""


class _Methods:
    """Of :class:`Options`."""

    def __post_init__(self):
        given = self.to_dict()
        check_traits(given.pop("traits", "auto"))
        _core.check_options(given)

    def __repr__(self):
        return f"Options({', '.join(f'{name}={value!r}' for name, value in self.to_dict().items())})"

    def to_dict(self):
        """Those that are given."""
        return {name: value for name, value in vars(self).items() if value is not None}


Options = dataclasses.make_dataclass(
    "Options", [(name, object, None) for name in DEFAULTS], bases=(_Methods,), frozen=True, repr=False,
    namespace={"__module__": __name__, "__doc__": _DOC})
