#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# --batch: many files in one run.
. "$(dirname "${BASH_SOURCE[0]}")/check.bash"

mkdir in bad
for k in 1 2 3 4 5; do torus $((20 + 4 * k)) >in/t$k.off; done
off_to_ply <in/t1.off >in/u.PLY
off_to_stl <in/t2.off >in/v.stl
echo 'no mesh' >in/notes.txt
cp in/t1.off bad/a.off
echo nonsense >bad/b.off
printf 'OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n' >bad/c.off
cp in/t2.off bad/d.off
fast=(-n 100 --iterations 5 --traits cpu)

# --- a folder: every mesh in it, each as it would be alone
for threads in 1 2 3; do
  rm -rf out && run 0 -- --batch in out/meshes "${fast[@]}" --threads $threads
  expect "$threads threads: it says how many" grep -q '^7 of 7 meshes in .* a second$' stdout
  expect "$threads threads: a line each" [ "$(wc -l <stdout)" -eq 8 ]
  expect "$threads threads: nothing else is written" [ "$(ls out/meshes | wc -l)" -eq 7 ]
  for f in t1.off t2.off t3.off t4.off t5.off u.PLY v.stl; do
    "$program" in/$f alone_$f "${fast[@]}" --quiet 2>/dev/null
    expect "$threads threads: $f is what it is alone" cmp out/meshes/$f alone_$f
  done
done
run 0 -- --batch in out2 "${fast[@]}" --quiet
expect '--quiet says nothing' [ ! -s stdout -a ! -s stderr ]

# --- a list, another format
printf '%s\n' in/t1.off '' in/t3.off "$PWD/in/u.PLY" >list
printf 'in/t4.off\r\n' >>list
run 0 -- --batch list out3 "${fast[@]}" --format obj
expect 'the outputs are OBJ' [ "$(ls out3 | tr '\n' ' ')" = 't1.obj t3.obj t4.obj u.obj ' ]
expect 'they are meshes' [ "$(grep -c '^v ' out3/t4.obj)" -eq 100 ]

# --- failures, one by one; the others are written
run 1 'bad/b.off' 'bad/c.off' 'facet' -- --batch bad out4 "${fast[@]}" --report r.json
expect 'the others are written' [ "$(ls out4 | tr '\n' ' ')" = 'a.off d.off ' ]
expect 'a line for each failure' [ "$(wc -l <stderr)" -eq 2 ]
expect 'it says how many' grep -q '^2 of 4 meshes in ' stdout
expect 'no temporary files are left' [ -z "$(find . -name '.power_rtf_*')" ]
expect 'the report has a line each' [ "$(wc -l <r.json)" -eq 4 ]
expect 'the lines are objects' [ "$(grep -c '^{.*}$' r.json)" -eq 4 ]
expect 'the report has the inputs' [ "$(grep -o '"input":"bad/[a-d].off"' r.json | sort -u | wc -l)" -eq 4 ]
expect 'the report has the errors' [ "$(grep -c '"error":"bad/[bc].off' r.json)" -eq 2 ]
expect 'the report has the meshes' [ "$(grep -c '"vertices":100[,}]' r.json)" -eq 2 ]
printf '%s\n' in/t1.off missing.off >list
run 1 missing.off 'No such file' -- --batch list out5 "${fast[@]}"
expect 'what is there is remeshed' [ -s out5/t1.off ]
mkdir -p out6/t2.off # in the way
run 5 'out6/t2.off: cannot be written' -- --batch in out6 "${fast[@]}"
expect 'the others are written' [ "$(find out6 -type f | wc -l)" -eq 6 ]
printf '%s\n' in/t1.off in/x.xyz >list
run 5 'x.xyz' 'does not end in' -- --batch list out7 "${fast[@]}"
printf 'OFF\n7 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n' >touch.off
printf '3 %s\n' '0 2 1' '0 1 3' '0 3 2' '1 2 3' '0 4 5' '0 6 4' '0 5 6' '4 6 5' >>touch.off
printf '%s\n' touch.off in/t1.off >list
run 3 'out8/touch.off: a guarantee is missed' -- --batch list out8 -n 100 --non-manifold split

# --- what goes on: outputs that are there, and newer than their inputs, stay
cp -r in again && rm -rf out11
run 0 -- --batch again out11 "${fast[@]}" --report lines.json
expect 'all have a line' [ "$(wc -l <lines.json)" -eq 7 ]
cp -r out11 whole
rm out11/t2.off out11/u.PLY
touch -d '1 hour' again/t4.off # in an hour
for f in t1.off t3.off t5.off v.stl; do echo kept >out11/$f; done
printf '{"input":"cut o' >>lines.json # where it was killed
run 0 -- --batch again out11 "${fast[@]}" --resume --report lines.json
expect 'it says how many' grep -q '^3 of 7 meshes in .* a second; 4 were there$' stdout
for f in t1.off t3.off t5.off v.stl; do
  expect "$f stays" grep -qx kept out11/$f
done
for f in t2.off t4.off u.PLY; do expect "$f is made" cmp out11/$f whole/$f; done
expect 'new lines come after the old ones' [ "$(wc -l <lines.json)" -eq 10 ]
expect 'all of them are whole' [ "$(grep -c '^{.*}$' lines.json)" -eq 10 ]
expect 'they are those of the new meshes' \
  [ "$(tail -3 lines.json | grep -c '"output":"out11/\(t2.off\|t4.off\|u.PLY\)"')" -eq 3 ]
run 0 -- --batch again out11 "${fast[@]}" --report lines.json
expect 'without --resume all are made' cmp out11/t5.off whole/t5.off
expect 'and the report is new' [ "$(wc -l <lines.json)" -eq 7 ]
run 2 '--resume: for --batch' -- in/t1.off out.off --resume

# --- what cannot begin
run 1 'missing: the files' 'No such file' -- --batch missing out9
run 1 'it is empty' -- --batch /dev/null out9
mkdir empty && run 1 'it has no mesh' -- --batch empty out9
run 2 'would both be written to out9/t1.off' -- --batch <(printf '%s\n' in/t1.off ./in/t1.off) out9
run 2 'OUTPUT is missing' -- --batch in
run 2 '--batch writes meshes and a report: not with --cells' -- --batch in out9 --cells c.ply
run 2 '--batch writes meshes and a report: not with --no-mesh' -- --batch in out9 --no-mesh
run 2 '--format' "'xyz' is not one of" -- --batch in out9 --format xyz
run 2 'for --batch' -- in/t1.off out.off --format obj
run 5 'nowhere/r.json' -- --batch in out9 --report nowhere/r.json
echo file >plain && run 5 'plain' 'cannot be made' -- --batch in plain
expect 'nothing is made' [ ! -e out9 ]

# --- Ctrl-C and SIGTERM: no mesh is begun any more, those that are whole stay
torus 60 >large.off
for k in $(seq 40); do mkdir -p many && cp large.off many/$k.off; done
# ends_by NAME NUMBER: the signal cancels a batch
ends_by() {
  local status
  rm -rf out10
  "$program" --batch many out10 -n 2000 --iterations 100000 --centroid-tolerance 0 \
    --weight-method none >/dev/null 2>stderr &
  pid=$!
  cancel "$1" "$2" || return
  expect "$1 ends with $status instead of $((128 + $2))" [ $status -eq $((128 + $2)) ]
  expect "$1: it says how many are written" grep -q 'cancelled; 0 of 40 meshes' stderr
  expect "$1: no temporary files are left" [ -z "$(find . -name '.power_rtf_*')" ]
}
ends_by INT 2
ends_by TERM 15

finish
