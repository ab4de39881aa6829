#!/usr/bin/env python3
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual's table of parameters, from what power_rtf_remesh --help says.

parameters.py [--program FILE] [--update PowerRTF.txt]

A block to update lies between the lines
<!-- generated: parameters --> and <!-- end of generated -->.
"""

import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEGIN, END = "<!-- generated: parameters -->", "<!-- end of generated -->"
GREEK = {"rho": "ρ", "gamma": "γ", "Theta": "Θ", "tau": "τ", "alpha": "α", "k_n": "k_n",
         "N_m^w": "N_m^w"}
# of the program's options, those that are no parameters of the method
OTHERS = {"Files", "Comparison with exact arithmetic", "Program"}


def options(text):
    """(group, option, description) for each option of --help; descriptions are unwrapped."""
    group, found = "", []
    for line in text.splitlines():
        heading = re.fullmatch(r"(\S.*):", line)
        option = re.match(r"  (?:-\w \[ )?--([a-z-]+)(?: \])?(?: [A-Z.a-z]+)?  +(\S.*)", line)
        if heading:
            group = heading[1]
        elif option:
            found.append([group, option[1], option[2].strip()])
        elif found and line.startswith("      "):
            found[-1][2] += " " + line.strip()
        else:
            group = "" if line and not line[0].isspace() else group
    return found


def table(text):
    lines = ["| option | symbol | meaning | `quality` | `paper` |", "| --- | --- | --- | --- | --- |"]
    last = ""
    for group, name, description in options(text):
        if group in OTHERS or name == "preset" or not group:
            continue
        if group != last:
            lines.append(f"| **{group}** | | | | |")
            last = group
        default = re.search(r" \(([^()]*?)(?:; paper: ([^()]*))?\)$", description)
        quality = default[1] if default else "off"
        paper = default[2] if default and default[2] else quality
        meaning = description[:default.start()] if default else description
        symbol = re.search(r" \[([^\]]*)\]$", meaning)
        meaning = meaning[:symbol.start()] if symbol else meaning
        meaning = meaning.replace("|", ", ").replace("^", "&#94;").replace("_", "&#95;")
        meaning = re.sub(r"--[a-z]+ [a-z]+", r"`\g<0>`", meaning)
        shown = GREEK.get(symbol[1], symbol[1]) if symbol else ""
        lines.append(f"| `{name}` | {f'`{shown}`' if shown else ''} | {meaning} | {quality} "
                     f"| {paper} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/power_rtf_remesh"))
    parser.add_argument("--update", metavar="FILE", help="replace the table in this file, too")
    arguments = parser.parse_args()
    help_text = subprocess.run([arguments.program, "--help"], capture_output=True, text=True,
                               check=True).stdout
    text = table(help_text)
    print(text, end="")
    if arguments.update:
        path = pathlib.Path(arguments.update)
        content, count = re.subn(re.escape(BEGIN) + r"\n.*?" + re.escape(END),
                                 lambda _: f"{BEGIN}\n{text}{END}",
                                 path.read_text(encoding="utf-8"), flags=re.DOTALL)
        if count != 1:
            sys.exit(f"{path}: {count} blocks instead of 1")
        path.write_text(content, encoding="utf-8")


if __name__ == "__main__":
    main()
