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

# A bump on one side
awk 'NR > 2 && NF == 3 && $1 > 3.9 { $1 = $1 + 1 } { print }' torus.off >bump.off
run 1 'not symmetric about the plane x = ' 'mirror image of its point' 'half the spacing' -- \
  bump.off out.off -n 501 --symmetry x
run 0 -- bump.off out.off -n 501 --symmetry auto --report r.json
expect 'there are two other planes' grep -q '"axis": "[yz]",' r.json

run 2 "one of none|auto|x|y|z" -- torus.off out.off --symmetry q

finish
