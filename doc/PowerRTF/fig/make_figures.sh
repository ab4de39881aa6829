#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# make_figures.sh [PROGRAM [MODELS [FOLDER]]]
# The pictures of the manual and of the pages on Python (camel, page), from the program's own output: cells and mesh of
# some of CGAL's models, the lattice that samples begin as, and the cells of a thin disc with and
# without NVISPC.
# PROGRAM: power_rtf_remesh; MODELS: the folder of CGAL's meshes; FOLDER: for the pictures. The
# defaults are what ./remesh and ./run_tests have made, and this folder.
# PYTHON: an interpreter with PyVista (see render.py). The page needs Chromium, too.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
program=${1:-$root/build/release/bin/power_rtf_remesh}
models=${2:-$root/build/data/meshes}
target=${3:-$here}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

render() { "${PYTHON:-python3}" "$here/render.py" "$@" --edges --height 420 --edge-width 0.8; }

# draw NAME SAMPLES [options of render.py]
draw() {
  local name=$1 samples=$2
  shift 2
  "$program" "$models/$name.off" "$work/$name.off" --samples "$samples" \
    --cells "$work/$name.vtp" --quiet
  render "$work/$name.vtp" "$target/${name}_cells.png" --color-by sides "$@"
  render "$work/$name.off" "$target/${name}_mesh.png" "$@"
}

draw camel 5000 --height 1000 --edge-width 1.2 --azimuth 50 --palette 128
draw elk 6000
draw armadillo 6000 --azimuth 240
draw bunny00 3000
draw fandisk 3000 --azimuth 35 --elevation 30

# The lattice, seen from near.
"$program" "$models/bunny00.off" --no-mesh --samples 3000 --fields "$work/lattice.vtp" --quiet
"${PYTHON:-python3}" "$here/render.py" "$models/bunny00.off" "$target/bunny00_lattice.png" \
  --lattice "$work/lattice.vtp" --color "#faf6ee" --azimuth 20 --elevation 20 --zoom 1.5 \
  --aspect 1.35 --height 600 --palette 256

# The disc of the benchmarks, with the preset of the paper.
"${PYTHON:-python3}" -B "$root/benchmark/PowerRTF/Quality/models.py" "$work"
for angle in 60 180; do
  "$program" "$work/disc.off" --no-mesh --samples 3000 --preset paper --density uniform \
    --normal-angle "$angle" --iterations 20 --cells "$work/disc_$angle.vtp" --quiet
  render "$work/disc_$angle.vtp" "$target/disc_$angle.png" --color-by sides --up z --elevation 40
done

# A region that is refined.
"$program" "$models/fandisk.off" "$work/plain.off" --edge-length 4% --quiet
"$program" "$models/fandisk.off" "$work/refined.off" --edge-length 4% \
  --refine sphere:0.46,0.2,0.2,0.15,0.008 --quiet
for name in plain refined; do
  render "$work/$name.off" "$target/fandisk_$name.png" --azimuth 35 --elevation 30 --palette 128
done

# Edge lengths, distances.
for picture in coarse=5% fine=2.5%; do
  "$program" "$models/bunny00.off" "$work/length.off" --edge-length "${picture#*=}" --density uniform --quiet
  render "$work/length.off" "$target/edge_length_${picture%=*}.png" --palette 128
done
for picture in coarse=1% fine=0.25%; do
  "$program" "$models/bunny00.off" "$work/distance.off" --max-distance "${picture#*=}" --quiet
  render "$work/distance.off" "$target/max_distance_${picture%=*}.png" --palette 128
done

# with_vertex_values NAME FORMULA FILE.off: as PLY, with a property of the vertices by x, y, z
with_vertex_values() {
  awk 'NR == 2 {
      print "ply\nformat ascii 1.0\nelement vertex " $1
      print "property double x\nproperty double y\nproperty double z\nproperty double '"$1"'"
      print "element face " $2 "\nproperty list uchar int vertex_indices\nend_header"
    }
    NR > 2 && NF == 3 { x = $1; y = $2; z = $3; print $0, '"$2"' }
    NR > 2 && NF == 4' "$3"
}

# Edge lengths of the user's own, and values that come over.
with_vertex_values size '0.008 + 0.12 * (x + 0.55) ^ 2' "$models/bunny00.off" >"$work/size.ply"
"$program" "$work/size.ply" "$work/even.off" --edge-length 3% --density uniform --quiet
"$program" "$work/size.ply" "$work/sized.off" --size-field size --quiet
render "$work/even.off" "$target/size_field_before.png" --palette 128
render "$work/sized.off" "$target/size_field_after.png" --palette 128
with_vertex_values wave 'sin(18 * x) * cos(15 * y)' "$models/bunny00.off" >"$work/wave.ply"
"$program" "$work/wave.ply" "$work/carried.vtp" --samples 3000 --quiet
awk '$2 == "vertex" { n = $3 } $2 == "face" { m = $3 }
  on { on <= n ? point[on] = $1 " " $2 " " $3 : face[on - n] = $0; value[on++] = $4 }
  /^end_header/ { on = 1 }
  END {
    printf "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS %d double\n", n
    for (k = 1; k <= n; ++k) print point[k]
    print "POLYGONS", m, 4 * m
    for (k = 1; k <= m; ++k) print face[k]
    print "POINT_DATA", n, "\nSCALARS wave double 1\nLOOKUP_TABLE default"
    for (k = 1; k <= n; ++k) print value[k]
  }' "$work/wave.ply" >"$work/wave.vtk"
render "$work/wave.vtk" "$target/transfer_before.png" --color-by wave --palette 128
render "$work/carried.vtp" "$target/transfer_after.png" --color-by wave --palette 128

# Vertices that stay.
with_vertex_values stay '(NR % 200 == 0)' "$models/bunny00.off" >"$work/stay.ply"
awk 'NF == 4 && $4 == 1 { print "v", $1, $2, $3; ++n } END { print "p", n }' "$work/stay.ply" >"$work/stay.obj"
"$program" "$work/stay.ply" "$work/free.off" --samples 600 --quiet
"$program" "$work/stay.ply" "$work/stay.off" --samples 600 --corners stay --quiet
render "$work/free.off" "$target/corners_before.png" --dots "$work/stay.obj" --palette 128
render "$work/stay.off" "$target/corners_after.png" --dots "$work/stay.obj" --palette 128

# A thin finger on a ball, turned on a lathe.
awk 'BEGIN {
  pi = atan2(0, -1); m = 48; k = 60; n = 0
  for (i = 1; i < k; ++i) { a = pi * i / k; if (a > pi - 0.05) break; z[n] = -cos(a) / 2; r[n++] = sin(a) / 2 }
  for (i = 0; i <= 60; ++i) { z[n] = 0.5 + 0.5 * i / 60; r[n++] = 0.02 }
  for (i = 1; i < 8; ++i) { z[n] = 1 + 0.02 * sin(pi * i / 16); r[n++] = 0.02 * cos(pi * i / 16) }
  print "OFF"; print n * m + 2, 2 * n * m, 0
  for (i = 0; i < n; ++i) for (j = 0; j < m; ++j)
    print r[i] * cos(2 * pi * j / m), r[i] * sin(2 * pi * j / m), z[i]
  print 0, 0, -0.5; print 0, 0, 1.02
  for (j = 0; j < m; ++j) {
    l = (j + 1) % m; print 3, n * m, l, j; print 3, n * m + 1, (n - 1) * m + j, (n - 1) * m + l
    for (i = 0; i + 1 < n; ++i) {
      print 3, i * m + j, i * m + l, (i + 1) * m + l; print 3, i * m + j, (i + 1) * m + l, (i + 1) * m + j
    }
  }
}' >"$work/finger.off"
for what in keep refine; do
  "$program" "$work/finger.off" "$work/thin.off" --samples 700 --density uniform --thin "$what" --quiet
  render "$work/thin.off" "$target/thin_$what.png" --up x --azimuth 20 --elevation 10 --palette 128
done

# Patches between creases.
"$program" "$models/fandisk.off" "$work/patches.vtp" --samples 2000 --patches --quiet
render "$work/patches.vtp" "$target/patches.png" --color-by patch --range -1 13 --azimuth 35 \
  --elevation 30 --palette 128

# A symmetric mesh.
"$program" "$models/head.off" "$work/plain.off" --samples 1500 --quiet
"$program" "$models/head.off" "$work/symmetric.off" --samples 1500 --symmetry auto --quiet
render "$work/plain.off" "$target/symmetry_before.png" --azimuth 270 --elevation 5 --palette 128
render "$work/symmetric.off" "$target/symmetry_after.png" --azimuth 270 --elevation 5 --palette 128

# A region, finer than the rest.
"$program" "$models/bunny00.off" "$work/coarse.off" --samples 2000 --quiet
awk -v ply="$work/region.ply" -v vtk="$work/before.vtk" '
  NR == 2 {
    printf "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\n" \
      "property double z\nelement face %d\nproperty list uchar int vertex_indices\n" \
      "property int part\nend_header\n", $1, $2 >ply
    printf "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS %d double\n", $1 >vtk
    faces = $2
  }
  NR > 2 && NF == 3 { along[n++] = $2 - 0.6 * $1; print >ply; print >vtk }
  NR > 2 && NF == 4 {
    if (!count++) printf "POLYGONS %d %d\n", faces, 4 * faces >vtk
    part[count] = along[$2] + along[$3] + along[$4] > 0.75
    print $0, part[count] >ply; print >vtk
  }
  END {
    printf "CELL_DATA %d\nSCALARS part int 1\nLOOKUP_TABLE default\n", faces >vtk
    for (f = 1; f <= faces; ++f) print part[f] >vtk
  }' "$work/coarse.off"
"$program" "$work/region.ply" "$work/after.vtp" --edge-length 1.2% --region part=1 --quiet
render "$work/before.vtk" "$target/region_before.png" --color-by part --range -2 3 --palette 128
render "$work/after.vtp" "$target/region_after.png" --color-by part --range -2 3 --palette 128
"$program" "$work/region.ply" "$work/border.vtp" --edge-length 1.2% --region part=1 \
  --region-border remesh --quiet
render "$work/border.vtp" "$target/region_border.png" --color-by part --range -2 3 --palette 128

# Bands as labels, of the result only and kept apart.
awk 'NR == 2 {
    print "ply\nformat ascii 1.0\nelement vertex " $1
    print "property double x\nproperty double y\nproperty double z\nelement face " $2
    print "property list uchar int vertex_indices\nproperty int label\nend_header"
  }
  NR > 2 && NF == 3 { height[n++] = $2 + 0.3 * $1; print }
  NR > 2 && NF == 4 { print $0, int(5 * (height[$2] + height[$3] + height[$4]) / 3 + 20) % 4 }' \
  "$models/bunny00.off" >"$work/bands.ply"
"$program" "$work/bands.ply" "$work/carried.vtp" --samples 3000 --quiet
"$program" "$work/bands.ply" "$work/kept.vtp" --samples 3000 --labels label --quiet
for name in carried kept; do
  render "$work/$name.vtp" "$target/labels_$name.png" --color-by label --range -2 3 --palette 128
done

# The page of a run, without a GPU.
(cd "$models" && "$program" bunny00.off "$work/bunny.ply" --samples 3000 --html "$work/page.html" --quiet)
chromium --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
  --user-data-dir="$work/profile" --virtual-time-budget=5000 --window-size=1300,1000 \
  --screenshot="$work/page.png" "file://$work/page.html#cells"
"${PYTHON:-python3}" - "$work/page.png" "$target/page.png" <<'end'
import sys
from PIL import Image
Image.open(sys.argv[1]).convert("RGB").quantize(256, kmeans=1).save(sys.argv[2], optimize=True)
end

# A texture on a knot, a tube whose texture has a seam along it and one across.
awk 'BEGIN {
  pi = atan2(0, -1); n = 160; m = 24
  for (i = 0; i <= n; ++i) for (j = 0; j <= m; ++j) print "vt", 16 * i / n, 2 * j / m
  for (i = 0; i < n; ++i) {
    t = 2 * pi * i / n
    x = sin(t) + 2 * sin(2 * t); y = cos(t) - 2 * cos(2 * t); z = -sin(3 * t)
    tx = cos(t) + 4 * cos(2 * t); ty = -sin(t) + 4 * sin(2 * t); tz = -3 * cos(3 * t)
    l = sqrt(tx * tx + ty * ty + tz * tz); tx /= l; ty /= l; tz /= l # along
    bx = -tz * tx; by = -tz * ty; bz = 1 - tz * tz
    l = sqrt(bx * bx + by * by + bz * bz); bx /= l; by /= l; bz /= l # across
    nx = by * tz - bz * ty; ny = bz * tx - bx * tz; nz = bx * ty - by * tx
    for (j = 0; j < m; ++j) {
      c = 0.55 * cos(2 * pi * j / m); s = 0.55 * sin(2 * pi * j / m)
      print "v", x + c * nx + s * bx, y + c * ny + s * by, z + c * nz + s * bz
    }
  }
  for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
    a = i * m + j + 1; b = i * m + (j + 1) % m + 1; u = i * (m + 1) + j + 1
    c = (i + 1) % n * m + j + 1; d = (i + 1) % n * m + (j + 1) % m + 1; w = u + m + 1
    print "f", a "/" u, b "/" u + 1, d "/" w + 1; print "f", a "/" u, d "/" w + 1, c "/" w
  }
}' >"$work/before.obj"
"$program" "$work/before.obj" "$work/after.obj" --samples 4000 --texture --quiet
for name in before after; do
  render "$work/$name.obj" "$target/texture_$name.png" --texture --up z --elevation 50 --zoom 2 \
    --palette 128
done
