# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The stubs say what the package has: the same names, parameters, defaults and fields."""
import ast
import dataclasses
import inspect
from pathlib import Path

import pytest

import powerrtf
import powerrtf.dataset

MODULES = (powerrtf, powerrtf.dataset)


def stubs(module, kind):
    tree = ast.parse(Path(module.__file__).with_suffix(".pyi").read_text())
    return {n.name: n for n in tree.body if isinstance(n, kind)}


def public(kind):
    return [pytest.param(getattr(module, name), stub, id=name)
            for module in MODULES for name, stub in stubs(module, kind).items()]


def check_signature(stub, function):
    arguments = stub.args.posonlyargs + stub.args.args + stub.args.kwonlyargs
    parameters = [p for p in inspect.signature(function).parameters.values()
                  if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
    assert [a.arg for a in arguments] == [p.name for p in parameters]
    defaults = [d for d in stub.args.defaults + stub.args.kw_defaults if d]
    assert [ast.literal_eval(d) for d in defaults] == \
        [p.default for p in parameters if p.default is not p.empty]


@pytest.mark.parametrize("module", MODULES)
def test_stub_has_the_public_names(module):
    assert sorted(stubs(module, (ast.ClassDef, ast.FunctionDef))) == sorted(module.__all__)


@pytest.mark.parametrize("function, stub", public(ast.FunctionDef))
def test_stub_has_the_signature_of_the_function(function, stub):
    check_signature(stub, function)


@pytest.mark.parametrize("found, stub", public(ast.ClassDef))
def test_stub_has_the_methods_of_the_class(found, stub):
    methods = {n.name: n for n in stub.body if isinstance(n, ast.FunctionDef)}
    fields = [f.name for f in dataclasses.fields(found)] if dataclasses.is_dataclass(found) else []
    own = {m for base in found.__mro__ if base.__module__.startswith("powerrtf") for m in vars(base)}
    assert {m for m in own.difference(fields) if not m.startswith("_") and hasattr(found, m)} == \
        {m for m in methods if not m.startswith("_")}
    if fields:
        assert fields == [n.target.id for n in stub.body if isinstance(n, ast.AnnAssign)]
    for name, method in methods.items():
        if not isinstance(getattr(found, name), property):
            check_signature(method, getattr(found, name))
