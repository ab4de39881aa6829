#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# make_figures.sh [PROGRAM [MODELS [FOLDER]]]
# The pictures of the README and the manual: cells and mesh of three of CGAL's models, from the
# program's own output. PROGRAM: power_rtf_remesh; MODELS: the folder of CGAL's meshes; FOLDER: for
# the pictures. The defaults are what ./remesh and ./run_tests have made, and this folder.
# PYTHON: an interpreter with PyVista (see render.py).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
program=${1:-$root/build/release/bin/power_rtf_remesh}
models=${2:-$root/build/data/meshes}
target=${3:-$here}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# draw NAME SAMPLES [options of render.py]
draw() {
  local name=$1 samples=$2
  shift 2
  "$program" "$models/$name.off" "$work/$name.off" --samples "$samples" \
    --cells "$work/$name.vtp" --quiet
  "${PYTHON:-python3}" "$here/render.py" "$work/$name.vtp" "$target/${name}_cells.png" \
    --edges --color-by sides --height 420 --edge-width 0.8 "$@"
  "${PYTHON:-python3}" "$here/render.py" "$work/$name.off" "$target/${name}_mesh.png" \
    --edges --height 420 --edge-width 0.8 "$@"
}

draw elk 6000
draw armadillo 6000 --azimuth 240
draw bunny00 3000
