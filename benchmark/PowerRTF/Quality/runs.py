# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of remeshers: carried out once, measured, judged and kept, so that a driver can go on."""

import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import digest, notice  # noqa: E402


class Failed(Exception):
    """A run that gave no mesh, with the reason."""


def measured(command, limit):
    """Runs a command with at most `limit` seconds of CPU time: (exit code, standard output,
    standard error, CPU seconds, peak memory in MiB). CPU time and memory are those of the whole
    process, by the operating system."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as error:
        process = subprocess.Popen([str(part) for part in command], stdout=out, stderr=error,
                                   stdin=subprocess.DEVNULL)
        if hasattr(resource, "prlimit"):  # a second more: to be killed, not asked
            resource.prlimit(process.pid, resource.RLIMIT_CPU, (limit, limit + 1))
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for stream in (out, error):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace").strip())
    if -process.returncode in (signal.SIGXCPU, signal.SIGKILL):
        raise Failed(f"stopped after {limit} s of CPU time")
    return (process.returncode, *texts, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


def store(path, data):
    """At once or not at all."""
    temporary = path.with_suffix(".tmp")
    temporary.write_text(json.dumps(data, indent=1), encoding="utf-8")
    temporary.rename(path)


class Runner:
    """`folder`: of the runs that are kept; `judge`, `program`: the built programs; `jobs` runs at a
    time, of `limit` seconds at most. All methods may be called from several threads."""

    def __init__(self, folder, program, judge, traits, jobs, limit):
        self.folder = pathlib.Path(folder)
        self.program, self.judge, self.limit = pathlib.Path(program), pathlib.Path(judge), limit
        self.traits = traits
        self.program_id, self.judge_id = digest(self.program), digest(self.judge)
        self.pool = ThreadPoolExecutor(jobs)
        self.locks, self.lock = {}, threading.Lock()
        self.done = self.kept = 0

    def later(self, function, *arguments):
        """Calls the function in a thread of its own as soon as there is one."""
        return self.pool.submit(function, *arguments)

    def keep(self, what, key, model, mesh, make):
        """What `make(folder)` says of its run, a dictionary, and what the judge says of the file
        `mesh` that it leaves in the folder, from earlier if both are there. What fails is not
        kept. Returns the dictionary and the folder."""
        folder = self.folder / digest(key)
        with self.lock:
            lock = self.locks.setdefault(folder.name, threading.Lock())
        with lock:
            made = folder / "run.json"
            if made.exists():
                self.kept += 1
            else:
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir(parents=True)
                notice(f"  {what}")
                self.done += 1
                store(made, make(folder))
            judged = folder / f"judged-{self.judge_id}.json"
            if not judged.exists():
                store(judged, self.judgment(model, folder / mesh))
            return {**load(made), **load(judged)}, folder

    def judgment(self, model, mesh):
        result = subprocess.run([self.judge, model, mesh], capture_output=True, text=True,
                                check=False)
        if result.returncode != 0:
            raise Failed(f"the result cannot be judged: {result.stderr.strip()}")
        return json.loads(result.stdout)

    def power_rtf(self, name, model, samples, *options):
        """A run of the program, by one thread."""

        def make(folder):
            command = [self.program, model, folder / "mesh.off", "--samples", str(samples),
                       *options, "--report", folder / "report.json", "--cells",
                       folder / "cells.vtp", "--threads", "1", "--traits", self.traits,
                       "--quiet"]
            code, _, error, cpu, memory = measured(command, self.limit)
            if code not in (0, 3):
                raise Failed(error or f"exit code {code}")
            report = load(folder / "report.json")
            return {"cpu": cpu, "memory": memory,
                    "inside": report["inside_capacity_interval"],
                    "constructions": report["constructions"],
                    "iterations": report["outer_iterations"],
                    "missed": report["missed_guarantees"]}

        return self.keep(f"power_rtf_remesh {name} n = {samples} {' '.join(options)}",
                         f"{self.program_id} {digest(pathlib.Path(model))} {samples} {options} "
                         f"{self.traits}", model, "mesh.off", make)
