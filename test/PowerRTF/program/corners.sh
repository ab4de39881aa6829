#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# --corners, --points: vertices of the input stay, with the same coordinates.
. "$(dirname "${BASH_SOURCE[0]}")/check.bash"

torus >torus.off
awk 'NR > 2 && NF == 3 { print ++n % 97 ? 0 : n }' torus.off >marks.txt
# stayed FILE.off: how many of the marked vertices are vertices of that file, in all bits
stayed() {
  awk -v CONVFMT=%.17g 'FILENAME == "marks.txt" { is_marked[FNR] = $1; next }
       NF != 3 || $1 == "OFF" { next }
       FILENAME == "torus.off" && FNR > 2 { if (is_marked[++n]) wanted[$1 + 0, $2 + 0, $3 + 0]; next }
       FILENAME != "torus.off" && ($1 + 0, $2 + 0, $3 + 0) in wanted { ++found }
       END { print found + 0 }' marks.txt torus.off "$1"
}
marked=$(grep -cv '^0$' marks.txt)

run 0 -- torus.off out.off -n 500 --corners marks.txt --report r.json
expect 'all of a file stay' [ "$(stayed out.off)" = "$marked" ]
expect 'there are as many as asked for' grep -q '"vertices": 500,' r.json
expect 'the report counts them' grep -q "\"constrained_vertices\": $marked," r.json
expect 'and those that are lost' grep -q '"lost_constrained_vertices": 0,' r.json
expect 'it names the file' grep -q '"corners": "marks.txt"' r.json
expect 'the table tells of them' grep -q "vertices that stay  *$marked of $marked\$" stdout
cp out.off one.off
run 0 -- torus.off out.off -n 500 --corners marks.txt --threads 1
expect 'on one thread, too' cmp out.off one.off
run 0 -- torus.off out.off -n 500
expect 'without it they do not' [ "$(stayed out.off)" = 0 ]
run 0 -- torus.off out.off --max-distance 1% --corners marks.txt
expect 'within a distance, too' [ "$(stayed out.off)" = "$marked" ]
run 0 -- torus.off out.off --edge-length 4% --density uniform --corners marks.txt
expect 'and with another resolution' [ "$(stayed out.off)" = "$marked" ]

# The same as a property, and as an OBJ file's points
awk 'FILENAME == "marks.txt" { mark[FNR] = $1; next }
     FNR == 2 { print "ply\nformat ascii 1.0\nelement vertex " $1 "\nproperty double x\nproperty double y"
       print "property double z\nproperty double mark\nelement face " $2
       print "property list uchar int vertex_indices\nend_header" }
     FNR > 2 && NF == 3 { print $0, mark[++n] }
     FNR > 2 && NF == 4' marks.txt torus.off >torus.ply
run 0 -- torus.ply out.off -n 500 --corners mark
expect 'those of a property stay' cmp out.off one.off
awk 'FILENAME == "marks.txt" { if ($1) points = points " " FNR; next }
     FNR > 2 && NF == 3 { print "v", $0 } FNR > 2 && NF == 4 { print "f", $2 + 1, $3 + 1, $4 + 1 }
     END { print "p" points }' marks.txt torus.off >torus.obj
run 0 -- torus.obj out.off -n 500 --points --report r.json
expect 'those that an OBJ file lists stay' cmp out.off one.off
expect 'the report says that they do' grep -q '"points": true' r.json
run 0 'not carried over to the output: points' -- torus.obj out.off -n 500

sed 's/^p .*/p 900/' torus.obj >wrong.obj
run 1 'wrong.obj' 'its point at vertex 899 (numbered from 0) is no vertex of a facet' -- wrong.obj out.off -n 500 --points
sed '3s/.*/nan/' marks.txt >wrong.txt
run 1 'wrong.txt' -- torus.off out.off -n 500 --corners wrong.txt
run 1 'its vertices have no property none, and there is no such file' -- torus.off out.off -n 500 --corners none
run 1 '7 samples are too few' "vertices that are to stay need $marked" -- torus.off out.off -n 7 --corners marks.txt
run 1 'symmetry and vertices that are to stay exclude' -- \
  torus.off out.off -n 500 --corners marks.txt --symmetry x
run 2 'the name is empty' -- torus.off out.off -n 500 --corners ''

finish
