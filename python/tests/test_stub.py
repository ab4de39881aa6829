# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The stub says what the package has: the same names, parameters and defaults."""
import ast
import inspect
from pathlib import Path

import pytest

import powerrtf

STUB = ast.parse((Path(powerrtf.__file__).parent / "__init__.pyi").read_text())
CLASSES = {n.name: n for n in STUB.body if isinstance(n, ast.ClassDef)}
FUNCTIONS = {n.name: n for n in STUB.body if isinstance(n, ast.FunctionDef)}


def check_signature(stub, function):
    arguments = stub.args.args + stub.args.kwonlyargs
    parameters = [p for p in inspect.signature(function).parameters.values()
                  if p.kind != p.VAR_KEYWORD]
    assert [a.arg for a in arguments] == [p.name for p in parameters]
    defaults = [d for d in stub.args.defaults + stub.args.kw_defaults if d]
    assert [ast.literal_eval(d) for d in defaults] == \
        [p.default for p in parameters if p.default is not p.empty]


def test_stub_has_the_public_names():
    assert sorted([*CLASSES, *FUNCTIONS]) == sorted(powerrtf.__all__)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_stub_has_the_signature_of_the_function(name):
    check_signature(FUNCTIONS[name], getattr(powerrtf, name))


@pytest.mark.parametrize("name", CLASSES)
def test_stub_has_the_methods_of_the_class(name):
    found = getattr(powerrtf, name)
    stubs = {n.name: n for n in CLASSES[name].body if isinstance(n, ast.FunctionDef)}
    own = {m for m in vars(found) if not m.startswith("_") and hasattr(found, m)}
    assert own == {m for m in stubs if not m.startswith("_")}
    for method, stub in stubs.items():
        if not isinstance(getattr(found, method), property):
            check_signature(stub, getattr(found, method))
