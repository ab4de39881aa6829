#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run power_rtf_remesh with too little memory, on a full disk, and kill it: is the output sound?

faults.py                  one of CGAL's models; the program is built when needed
faults.py FILE ...         others
faults.py --kills 100      instead of 500, at random moments of a run
faults.py --samples 30000  instead of 3000

memory   the address space is limited, from too little for the program to start up to enough for it
disk     files are limited in size, from nothing up to the output's: writing fails as on a full disk
kill     SIGKILL comes at a random moment

Each output, a mesh and a report, has to be that of an undisturbed run or the file that was there
before, and no other file may be left. When memory or disk do not suffice the program has to end with
1 or 5 and a message. The table goes to faults.md in the folder --results. The exit code is 1 when a
run was not like that, else 0; 77 when there is no mesh. Needs nothing beside Python and the program.
"""

import argparse
import collections
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import BUILD, DATA, ROOT, build, made_by, markdown  # noqa: E402

BEFORE = "what was there before\n"
OUTPUTS = ["mesh.off", "report.json"]
MEMORY_ERROR, WRITE_ERROR = 1, 5  # exit codes of the program


class Folder:
    """Where one run writes; its outputs are there already."""

    def __init__(self, options, model):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        for name in OUTPUTS:
            (self.path / name).write_text(BEFORE, encoding="ascii")
        self.command = [options.program, str(model.resolve()), OUTPUTS[0], "--report", OUTPUTS[1],
                        "--samples", str(options.samples), "--quiet", "--traits", "cpu"]

    def start(self, **limits):
        """The process, its resources limited, for example `RLIMIT_AS=2**20`."""
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # else it ends the process
            for name, value in {"RLIMIT_CORE": 0, **limits}.items():
                resource.setrlimit(getattr(resource, name), (value, value))

        return subprocess.Popen(self.command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                cwd=self.path, text=True, preexec_fn=limit)

    def outputs(self):
        """Their texts, without what differs from run to run."""
        return [re.sub(r'"seconds".*?\}', "", (self.path / name).read_text(encoding="ascii"),
                       flags=re.DOTALL) for name in OUTPUTS]

    def defect(self, whole):
        """What is wrong with the files, or nothing."""
        left = sorted(set(os.listdir(self.path)) - set(OUTPUTS))
        if left:
            return "left over: " + ", ".join(left)
        return "; ".join(f"{name} is neither whole nor as it was"
                         for name, text, good in zip(OUTPUTS, self.outputs(), whole)
                         if text not in (good, BEFORE))


def limited(options, model, whole, expected, limits):
    """Runs with a limit each, up to the first that suffices. Yields what was wrong, or nothing."""
    for limit in limits:
        run = Folder(options, model)
        process = run.start(**limit)
        _, errors = process.communicate()
        wrong = run.defect(whole)
        if process.returncode == 0:
            yield wrong
            return
        if process.returncode != expected or not errors.strip():
            wrong = f"{limit}: exit code {process.returncode}: {errors.strip()}; {wrong}"
        yield wrong


def killed(options, model, whole, seconds):
    """The same for runs that are killed."""
    chance = random.Random(0)
    for _ in range(options.kills):
        run = Folder(options, model)
        process = run.start()
        time.sleep(chance.uniform(0, 1.02) * seconds)
        process.kill()
        process.communicate()
        yield run.defect(whole)


def growing(first, factor):
    while True:
        yield int(first)
        first *= factor


def measure(options, model):
    """Rows of the table, and what was wrong."""
    run = Folder(options, model)
    begin = time.monotonic()
    run.start().communicate()
    seconds, whole = time.monotonic() - begin, run.outputs()
    size = max((run.path / name).stat().st_size for name in OUTPUTS)
    faults = {"memory": limited(options, model, whole, MEMORY_ERROR,
                                ({"RLIMIT_AS": n} for n in growing(options.least_memory, 1.02))),
              "disk": limited(options, model, whole, WRITE_ERROR,
                              ({"RLIMIT_FSIZE": size * k // 50} for k in range(52))),
              "kill": killed(options, model, whole, seconds)}
    rows, wrong = [], []
    for name, runs in faults.items():
        defects = list(runs)
        rows.append([model.name, name, len(defects), sum(map(bool, defects))])
        wrong += [f"{model.name}, {name}: {d}" for d in defects if d]
    return rows, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="FILE", type=pathlib.Path, default=[
        pathlib.Path(os.environ.get("POWER_RTF_DATA", str(DATA))) / "elephant.off"])
    parser.add_argument("--samples", type=int, default=3000, metavar="N")
    parser.add_argument("--kills", type=int, default=500, metavar="N")
    parser.add_argument("--results", default=str(ROOT / "build/faults"), metavar="FOLDER")
    parser.add_argument("--program", help="power_rtf_remesh; default: built here")
    options = parser.parse_args()
    if not options.program:
        build(["power_rtf_remesh"])
        options.program = BUILD / "bin/power_rtf_remesh"
    options.program = str(pathlib.Path(options.program).resolve())
    if not all(file.exists() for file in options.meshes):
        print("no mesh", *options.meshes, file=sys.stderr)
        return 77
    # the program's own size: below it the system cannot start it
    options.least_memory = least_memory(options.program)
    rows, wrong = [], []
    for model in options.meshes:
        of_model, defects = measure(options, model)
        rows += of_model
        wrong += defects
    text = (f"# Faults\n\n{made_by(__file__, [os.path.basename(a) for a in sys.argv[1:]])}\n\n"
            + markdown(["mesh", "fault", "runs", "unsound"], rows, left=2))
    text += "".join(f"\n- {kind} ({count})" for kind, count in collections.Counter(wrong).items())
    results = pathlib.Path(options.results)
    results.mkdir(parents=True, exist_ok=True)
    (results / "faults.md").write_text(text, encoding="utf-8")
    print(text)
    return 1 if wrong else 0


def least_memory(program):
    """Bytes of address space with which the program can print its help."""
    for size in growing(2**20, 1.05):
        if subprocess.run([program, "--help"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)),
                          check=False).returncode == 0:
            return size
    raise AssertionError


if __name__ == "__main__":
    sys.exit(main())
