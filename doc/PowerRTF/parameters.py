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
GREEK = "alpha gamma kappa rho tau Delta Theta".split()
FORMULAS = ["rho = kappa^p", "f, f^2, f^3", "Delta s = tau gamma D_i / 4", "rho"]
# of the program's options, those that are no parameters of the method
OTHERS = {"Fields and regions of the input", "Files", "Comparison with exact arithmetic", "Program"}


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


def latex(formula):
    formula = re.sub(rf"\b({'|'.join(GREEK)})\b", r"\\\1", formula)
    return rf"\f${formula}\f$"


def with_formulas(text):
    return re.sub("|".join(rf"\b{re.escape(f)}(?!\w)" for f in FORMULAS),
                  lambda match: latex(match[0]), text)


def taken_from_end(description, brackets):
    """What stands in such brackets at the end, and the description without it."""
    opening, closing = map(re.escape, brackets)
    found = re.search(rf" {opening}([^{opening}{closing}]*){closing}$", description)
    return (found[1], description[:found.start()]) if found else ("", description)


def table(text):
    lines = ["| option | symbol | meaning | allowed | `quality` | `fast` | `paper` |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    last = ""
    for group, name, description in options(text):
        if group in OTHERS or name == "preset" or not group:
            continue
        if group != last:
            lines.append(f"| **{group}** | | | | | | |")
            last = group
        default, meaning = taken_from_end(description, "()")
        symbol, meaning = taken_from_end(meaning, "[]")
        allowed, meaning = taken_from_end(meaning, "{}")
        if not default: # a switch
            allowed, default = "off, on", "off"
        elif not allowed: # "yes|no: what that means"
            allowed, meaning = meaning.split(": ", 1)
            allowed = allowed.replace("|", ", ")
        quality, *others = default.split("; ")
        of = dict(other.split(": ") for other in others)
        lines.append(f"| `{name}` | {latex(symbol) if symbol else ''} | {with_formulas(meaning)} "
                     f"| {allowed} | {quality} | {of.get('fast', quality)} "
                     f"| {of.get('paper', quality)} |")
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
