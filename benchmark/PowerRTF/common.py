# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmark drivers share: building, the machine's name, Markdown."""

import csv
import datetime
import hashlib
import os
import pathlib
import platform
import re
import subprocess
import sys
import venv

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/release"
DATA = ROOT / "build/data/meshes"


def notice(text):
    print(text, file=sys.stderr, flush=True)


def build(targets):
    """Installs what is missing, builds the targets and fetches CGAL's models."""
    subprocess.run([pathlib.Path(__file__).with_name("build.sh"), *targets], check=True)


def python_environment(folder, packages):
    """An interpreter in `folder` with these packages. Returns it, or None where it cannot be had,
    and the packages that could not be installed."""
    python = folder / "bin/python"
    missing = []
    if not python.exists():
        notice(f"Making the Python environment {folder}")
        try:
            venv.create(folder, with_pip=True)
        except (OSError, subprocess.CalledProcessError) as error:
            notice(f"No Python environment: {error}")
            return None, packages
    for package in packages:
        done = folder / f"installed-{package}"
        if done.exists():
            continue
        result = subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-input",
                                 "--disable-pip-version-check", package],
                                capture_output=True, text=True, check=False)
        if result.returncode == 0:
            done.touch()
        else:
            missing.append(package)
            lines = result.stderr.strip().splitlines()
            notice(f"{package} cannot be installed: {lines[-1] if lines else 'no reason given'}")
    return python, missing


def machine():
    name, cores = platform.processor() or platform.machine(), os.cpu_count()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    name = line.split(":", 1)[1].strip()
                    break
    except OSError:
        pass
    return f"{name}, {cores} cores"


def commit():
    try:
        return "commit " + subprocess.run(
            ["git", "describe", "--always", "--dirty", "--exclude", "*"], cwd=ROOT,
            capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "no commit"


def made_by(script, options, origin=None):
    """The line below each table. `options`: of the command line, without this machine's folders.
    `origin`: program, day and machine of the measurement, if they are not these."""
    path = pathlib.Path(script).resolve().relative_to(ROOT)
    origin = origin or f"{commit()}, {datetime.date.today().isoformat()}, {machine()}"
    return f"Made by `{' '.join([str(path), *options])}`; {origin}."


def digest(*parts):
    """A name for what these strings and files (as `pathlib.Path`) are."""
    result = hashlib.sha256()
    for part in parts:
        data = part.read_bytes() if isinstance(part, pathlib.Path) else str(part).encode()
        result.update(hashlib.sha256(data).digest())
    return result.hexdigest()[:20]


def markdown(columns, rows, left=1):
    """A table; the first `left` columns and the last are aligned to the left."""
    lines = ["| " + " | ".join(columns) + " |",
             "|" + "|".join(" --- " if k < left or k == len(columns) - 1 else " ---: "
                            for k in range(len(columns))) + "|"]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def write_csv(path, columns, rows):
    clean = [re.sub(r"</?(sub|sup)>", "", column) for column in columns]
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([clean, *rows])


def update_block(path, name, text):
    """Replaces what lies between the lines `<!-- generated: name -->` and
    `<!-- end of generated -->` of a file; fails when there is no such block."""
    begin, end = f"<!-- generated: {name} -->", "<!-- end of generated -->"
    content, count = re.subn(re.escape(begin) + r"\n.*?" + re.escape(end),
                             lambda _: f"{begin}\n{text}{end}",
                             pathlib.Path(path).read_text(encoding="utf-8"), flags=re.DOTALL)
    if count != 1:
        sys.exit(f"{path}: {count} blocks {name} instead of 1")
    pathlib.Path(path).write_text(content, encoding="utf-8")
