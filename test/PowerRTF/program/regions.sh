#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# --region: some faces are remeshed, the others are in the output as they were.
. "$(dirname "${BASH_SOURCE[0]}")/check.bash"

torus >torus.off

# field NAME: the value of the first such field of r.json
field() { sed -n "s/^ *\"$1\": \(.*[^,{[]\),\{0,1\}$/\1/p" r.json | head -n 1; }
has() { expect "the report's $1 is '$(field "$1")' instead of '$2'" [ "$(field "$1")" = "$2" ]; }

# parted: torus.off as PLY whose faces have the property part, 5 where y < 0 and 6 elsewhere, and whose
# vertices have the property heat
parted() {
  awk 'BEGIN { printf "ply\nformat ascii 1.0\nelement vertex 800\nproperty double x\nproperty double y\n" \
         "property double z\nproperty double heat\nelement face 1600\n" \
         "property list uchar int vertex_indices\nproperty int part\nend_header\n" }
       NR > 2 && NF == 3 { y[n++] = $2; print $0, $1 / 3 }
       NR > 2 && NF == 4 { print $0, (y[$2] + y[$3] + y[$4] > 0) + 5 }' torus.off
}
parted >parted.ply

# kept FILE.ply: the corners of its faces of part 5, with all digits and their heat
kept() {
  awk 'BEGIN { n = 0 } NF == 4 { for (k = 1; k <= 4; ++k) v[n] = v[n] sprintf("%.17g ", $k); ++n }
       NF == 5 && $1 == 3 && $5 == 5 { print v[$2], v[$3], v[$4] }' "$1" | LC_ALL=C sort
}
# shape FILE.ply: vertices, faces, edges of one face, of more than two
shape() {
  awk 'NF == 4 { ++v }
       NF == 5 && $1 == 3 { ++f
         for (k = 2; k <= 4; ++k) {
           a = $k; b = k < 4 ? $(k + 1) : $2
           ++edge[a < b ? a " " b : b " " a]
         } }
       END { for (e in edge) { one += edge[e] == 1; more += edge[e] > 2 }
             print v - f / 2, one + 0, more + 0 }' "$1"
}

run 0 -- parted.ply out.ply -n 300 --region part=6 --ascii --report r.json
expect 'the other part stays, bit for bit' cmp <(kept parted.ply) <(kept out.ply)
expect 'a closed torus comes out' [ "$(shape out.ply)" = '0 0 0' ]
has vertices 300
has kept_faces 800
has kept_vertices 420
has border_loops 2
has region '"part=6"'
expect 'there are as many vertices in all' [ "$(grep -c '^element vertex 680$' out.ply)" = 1 ]
cp out.ply one.ply
run 0 -- parted.ply out.ply -n 300 --region part=6 --ascii --threads 1
expect 'on one thread, too' cmp out.ply one.ply

run 0 -- parted.ply out.ply -n 300 --region part=6 --ascii --provenance from.ply
expect 'a vertex that stays comes from itself' \
  [ "$(awk '/end_header/ { on = 1; next } on && NF == 10 { if ($8 == 1 || $9 == 1 || $10 == 1) ++own }
       END { print (own >= 420) }' from.ply)" = 1 ]

run 0 -- parted.ply out.ply --edge-length 0.2 --region part=6 --ascii --report r.json
expect 'the other part stays, whatever the spacing' cmp <(kept parted.ply) <(kept out.ply)
run 0 -- parted.ply out.ply --max-distance 1% --region part=6 --ascii --report r.json
expect 'a distance may be asked for' cmp <(kept parted.ply) <(kept out.ply)
expect 'and is kept' [ "$(field absolute_distance_bound)" ]

# --- the border remeshed, too
# inner.txt: those of the kept faces that have no corner on the old border, where y = 0
kept parted.ply | awk '($2 ^ 2 > 1e-20) && ($6 ^ 2 > 1e-20) && ($10 ^ 2 > 1e-20)' >inner.txt
for length in 0.1 0.9; do # the input's are about 0.4
  run 0 -- parted.ply out.ply --edge-length $length --region part=6 --region-border remesh --ascii --report r.json
  expect 'a closed torus comes out' [ "$(shape out.ply)" = '0 0 0' ]
  expect 'the report tells of changed faces' [ "$(field changed_faces)" -gt 20 ]
  expect 'kept and changed faces are the other part' \
    [ "$(kept out.ply | wc -l)" = $(($(field kept_faces) + $(field changed_faces))) ]
  expect 'kept faces are as they were' \
    [ "$(kept parted.ply | LC_ALL=C comm -12 - <(kept out.ply) | wc -l)" = "$(field kept_faces)" ]
  expect 'among them all that are off the border' \
    [ "$(LC_ALL=C comm -12 inner.txt <(kept out.ply) | wc -l)" = "$(wc -l <inner.txt)" ]
  cp out.ply one.ply
  run 0 -- parted.ply out.ply --edge-length $length --region part=6 --region-border remesh --ascii --threads 1
  expect 'on one thread, too' cmp out.ply one.ply
done
run 0 -- parted.ply out.stl --edge-length 0.1 --region part=6 --region-border remesh --ascii
run 1 'largest distance' 'parted.ply' -- parted.ply out.off --max-distance 1% --region part=6 --region-border remesh
run 2 '--region-border' -- parted.ply out.off -n 300 --region-border remesh
run 2 'keep|remesh' -- parted.ply out.off -n 300 --region part=6 --region-border move

# --- names of an OBJ file
awk 'NF == 4 { print "v", $1, $2, $3 }
     NF == 5 && $1 == 3 { print "usemtl m" $5; print "f", $2 + 1, $3 + 1, $4 + 1 }' parted.ply >parted.obj
run 0 -- parted.obj out.obj -n 300 --region material=m6 --report r.json
has kept_faces 800
expect 'materials come out' [ "$(grep usemtl out.obj | sort -u | paste -sd ' ')" = 'usemtl m5 usemtl m6' ]

# --- what cannot be
run 1 'no property third' 'they have part' -- parted.ply out.off -n 300 --region third=6
run 1 'part is at no facet 7' -- parted.ply out.off -n 300 --region part=7
run 1 'part is at no facet x' -- parted.ply out.off -n 300 --region part=x
run 1 'material is at no facet m7' -- parted.obj out.off -n 300 --region material=m7
run 1 'too few' 'need 40' -- parted.ply out.off -n 30 --region part=6
run 2 "'part' is not NAME=VALUE" -- parted.ply out.off -n 300 --region part
run 2 "'=6' is not NAME=VALUE" -- parted.ply out.off -n 300 --region =6
run 2 '--patches' -- parted.ply out.ply -n 300 --region part=6 --patches
run 5 'out.stl' 'as it is' '--ascii' -- parted.ply out.stl -n 300 --region part=6
run 0 -- parted.ply out.stl -n 300 --region part=6 --ascii
awk 'NF == 5 && $1 == 3 { $5 = 6 } 1' parted.ply >all.ply
run 0 -- all.ply whole.ply -n 300 --ascii
run 0 -- all.ply out.ply -n 300 --region part=6 --ascii
expect 'all faces: a whole mesh' cmp out.ply whole.ply

finish
