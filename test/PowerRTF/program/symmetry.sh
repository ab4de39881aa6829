#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# --symmetry: the output is its own mirror image, and inputs that are not nearly so are refused.
. "$(dirname "${BASH_SOURCE[0]}")/check.bash"

torus >torus.off

# lone FILE.off: how many vertices have no mirror image about x = 0 among the vertices
lone() {
  awk 'NF == 3 && $1 != "OFF" && ++n > 1 { at[$1 + 0, $2, $3]; x[n] = $1; y[n] = $2; z[n] = $3 }
       END { for (k = 2; k <= n; ++k) lone += !((-x[k], y[k], z[k]) in at)
             print lone + 0 }' CONVFMT=%.17g "$1"
}

run 0 -- torus.off out.off -n 501 --symmetry x --report r.json
expect 'every vertex has its image' [ "$(lone out.off)" = 0 ]
expect 'there are as many as asked for' grep -q '"vertices": 501,' r.json
expect 'the report names the axis' grep -q '"axis": "x",' r.json
expect 'it has no facet without an image' grep -q '"lone_facets": 0$' r.json
expect 'the table tells of the plane' grep -q 'plane of symmetry  *x = 0$' stdout
cp out.off one.off
run 0 -- torus.off out.off -n 501 --symmetry x --threads 1
expect 'on one thread, too' cmp out.off one.off

run 0 -- torus.off out.off -n 501 --report r.json
expect 'without it vertices have none' [ "$(lone out.off)" -gt 400 ]
expect 'and the report says nothing of it' [ "$(grep -c lone_facets r.json)" = 0 ]

run 0 -- torus.off out.off --edge-length 3% --symmetry auto
expect 'with another resolution, too' [ "$(lone out.off)" = 0 ]

# column NAME FILE.ply: that property of the faces, or of the vertices of a file without faces
column() { awk -v name="$1" '/^property list/ { next } /^element/ { k = $2 == "face" ? 4 : 0; side = $2 }
  /^property/ { at[side, $3] = ++count[side] } /^end_header/ { on = 1; next }
  on && NF == count["face"] + 1 + $1 && $1 > 2 { print $(1 + $1 + at["face", name]) }' "$2"; }

run 0 -- torus.off out.off -n 501 --symmetry x --cells cells.ply --samples-out samples.ply --ascii --html page.html
awk 'NF == 3 && on { print } /^end_header/ { on = 1 }' cells.ply >corners.txt
awk '{ at[$1 + 0, $2, $3]; x[NR] = $1; y[NR] = $2; z[NR] = $3 }
     END { for (k in x) lone += !((-x[k], y[k], z[k]) in at); exit lone > 0 }' CONVFMT=%.17g corners.txt
expect 'the corners of the cells have their images' [ $? = 0 ]
expect 'there are as many samples as vertices' grep -qx 'element vertex 501' samples.ply
expect 'each cell names a sample of its own' \
  [ "$(column sample cells.ply | sort -n | uniq -d | wc -l)" = 0 ]
awk 'BEGIN { m = n = 0 }
     NR == FNR { if (on) point[n++] = $1 " " $2 " " $3; else on = /^end_header/; next }
     /^end_header/ { body = 1; next }
     body && NF == 3 { x[m] = $1; y[m] = $2; z[m++] = $3 }
     body && NF > 7 { s = $(NF - 4); split(point[s], p, " "); a = b = c = 0
       for (k = 2; k <= $1 + 1; ++k) { a += x[$k] / $1; b += y[$k] / $1; c += z[$k] / $1 }
       if ((a - p[1]) ^ 2 + (b - p[2]) ^ 2 + (c - p[3]) ^ 2 > .01) ++far; ++cells }
     END { exit !(cells > 400 && !far) }' samples.ply cells.ply
expect 'which is in its middle' [ $? = 0 ]

# A bump on one side
awk 'NR > 2 && NF == 3 && $1 > 3.9 { $1 = $1 + 1 } { print }' torus.off >bump.off
run 1 'not symmetric about the plane x = ' 'mirror image of its point' 'half the spacing' -- \
  bump.off out.off -n 501 --symmetry x
run 0 -- bump.off out.off -n 501 --symmetry auto --report r.json
expect 'there are two other planes' grep -q '"axis": "[yz]",' r.json

run 2 "one of none|auto|x|y|z" -- torus.off out.off --symmetry q

finish
