# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
import ast
import inspect
from pathlib import Path

import powerrtf


def test_stub_has_the_signature_of_the_function():
    stub = ast.parse((Path(powerrtf.__file__).parent / "__init__.pyi").read_text())
    function = next(n for n in stub.body if isinstance(n, ast.FunctionDef) and n.name == "remesh")
    arguments = function.args.args + function.args.kwonlyargs
    parameters = inspect.signature(powerrtf.remesh).parameters
    assert [a.arg for a in arguments] == list(parameters)
    defaults = [d for d in function.args.defaults + function.args.kw_defaults]
    assert [ast.literal_eval(d) for d in defaults] == \
        [p.default for p in parameters.values() if p.default is not inspect.Parameter.empty]
