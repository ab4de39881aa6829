#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The command line: what is understood, what is refused (exit code 2, with a reason), cancellation.
. "$(dirname "${BASH_SOURCE[0]}")/check.bash"

torus >torus.off
fast=(-n 100 --iterations 2 --relaxation-iterations 2 --quiet)

# --- wrong usage
run 2 'INPUT is missing' --
run 2 'OUTPUT is missing' -- torus.off
run 2 'one argument too many' 'third' -- torus.off out.off third
run 2 '--nonsense' -- torus.off out.off --nonsense 3
run 2 '--samp' -- torus.off out.off --samp 100
run 2 '-x' -- torus.off out.off -x
run 2 '--samples' 'missing' -- torus.off out.off --samples
run 2 '--quiet' -- torus.off out.off --quiet=yes
run 2 '--samples' -- torus.off out.off -n 100 -n 200
run 2 'same option' -- torus.off out.off -n 100 --number-of-samples 200
run 2 'exclude each other' -- torus.off out.off -n 100 --edge-length 1
run 2 'exclude each other' -- torus.off out.off --edge-length 1 --vertex-share 1
run 2 "'x'" 'not a number' -- torus.off out.off --edge-length x%
run 2 "'0'" 'above 0' -- torus.off out.off -n 0%
run 1 'torus.off' 'edge_length asks for' -- torus.off out.off --edge-length 1e-9
run 2 'exclude each other' -- torus.off out.off --size-field a --density-field b
run 2 'exclude each other' -- torus.off out.obj -n 100 --texture --symmetry x
run 2 'no --size-field' -- torus.off out.off --size-factor 2
run 2 'name is empty' -- torus.off out.off --size-field ''
for region in '' sphere sphere: sphere:1,2,3,4 sphere:1,2,3,4,5,6 sphere:1,2,3,4,5, sphere:1,2,3,4,x box:1,2,3,4,5 \
  cone:1,2,3,4,5; do
  run 2 "--refine: '$region' is neither sphere" -- torus.off out.off --refine "$region"
done
run 2 '--refine' 'radius not above 0' -- torus.off out.off --refine sphere:1,2,3,0,5
run 2 '--refine' 'not finite' -- torus.off out.off --refine sphere:nan,2,3,1,5
run 2 'nothing to write' -- torus.off --no-mesh
run 2 'same file' -- torus.off out.off --report out.off
run 2 'same file' -- torus.off out.off --report ./a.ply --cells a.ply
run 2 'same file' -- torus.off out.off --fields a.vtp --cells a.vtp
run 2 'empty' -- torus.off out.off --fields ''
for sampling in stratified elimination random; do
  run 2 '--fields' '--sampling lattice' -- torus.off out.off --fields out.off --sampling $sampling
done
run 2 '--fields' '--sampling lattice' -- torus.off out.off --fields a.vtp --preset paper
run 2 'empty' -- torus.off ''

# refuse OPTION VALUE REASON
refuse() { run 2 "--$1: '$2'" "$3" -- torus.off out.off "--$1" "$2"; }
for value in '' abc 12x 1e3 1.5 ' 5' 0x10; do
  refuse samples "$value" 'not a whole number'
  refuse iterations "$value" 'not a whole number'
done
for value in '' abc 0.1x ' 1' nan; do refuse gradation "$value" 'not a number'; done
for value in inf 1e400; do refuse gradation "$value" 'not a number'; done
for name in density preset sampling attributes projection position-method weight-method \
  weight-operator extraction traits; do
  refuse $name nonsense 'not one of'
done

# bounds OPTION LOWEST HIGHEST BELOW ABOVE: the bounds are understood (what is missing is the input,
# exit code 1), the values beyond them are refused with the range
bounds() {
  local range="a number from $2 to $3"
  run 1 missing.off -- missing.off out.off "--$1" "$2"
  run 1 missing.off -- missing.off out.off "--$1" "$3"
  refuse "$1" "$4" "$range"
  refuse "$1" "$5" "$range"
}
bounds seed 0 4294967295 -1 4294967296
refuse size-factor -1 'a number from 0 to 1e+300'
bounds min-edge-length 0 1e+300 -1 1e301
bounds max-edge-length 0 1e+300 -1 1e301
bounds min-angle 0 60 -1 60.1
bounds max-angle 60 180 59.9 181
bounds density-power 0 100 -1e-9 100.001
bounds gradation 0 1000 -1e-300 1001
bounds oversampling 1 32 0.999 32.001
for name in relaxation-iterations iterations max-weight-iterations; do
  bounds $name 0 1000000 -1 1000001
done
for name in normal-neighbors density-neighbors projection-neighbors; do bounds $name 1 32 0 33; done
bounds normal-smoothing 0 100 -1 101
bounds neighbors 1 1000 0 1001
bounds guard-factor 1 1000 0.99 1000.5
bounds lbfgs-memory 1 10 0 11
bounds centroid-density-power 0 100 -1 101
bounds capacity-tolerance 0 1 -0.1 1.5
bounds device 0 2147483647 -1 2147483648
bounds check-every 0 2147483647 -1 2147483648
bounds threads 0 4096 -1 4097
refuse neighbors 99999999999999999999 'to 1000'
refuse seed -99999999999999999999 'from 0'
for name in features normal-angle; do
  run 1 missing.off -- missing.off out.off --$name 1e-300
  run 1 missing.off -- missing.off out.off --$name 180
  for value in 0 -60 180.5; do refuse $name $value 'above 0, at most 180'; done
done
run 1 missing.off -- missing.off out.off --weight-step 1000
for value in 0 -1 1000.1; do refuse weight-step $value 'above 0, at most 1000'; done
for name in features density-power oversampling normal-smoothing normal-angle guard-factor \
  centroid-density-power capacity-tolerance weight-step; do
  for value in nan inf -inf 1e400; do refuse $name $value 'not a number'; done
done
many=(-n $((300 * $(nproc))) --weight-method multiplicative --iterations 1 --max-weight-iterations 1
      --improvement no)
said=$("$program" torus.off cuda.off "${fast[@]}" --traits cuda 2>&1)
case $? in # a program without the engine; a machine without a GPU; a machine with one
2) run 2 cuda 'not built' -- torus.off out.off --traits cuda ;;
1)
  run 1 'GPU' -- torus.off out.off "${fast[@]}" --traits cuda
  run 0 'goes on with the CPU: ' -- torus.off out.off "${many[@]}" --traits auto --report r.json
  expect 'the report says why there is no GPU' grep -q '"gpu_not_used": ".*GPU' r.json
  run 0 -- torus.off out.off "${many[@]}" --traits auto --quiet
  expect 'who wants it quiet hears of no GPU' [ ! -s stderr ]
  mkdir several && cp torus.off several/a.off && cp torus.off several/b.off
  run 0 'goes on with the CPU: ' -- --batch several out "${many[@]}" --traits auto
  expect 'many meshes hear once of the GPU' [ "$(grep -c CPU stderr)" -eq 1 ]
  ;;
*)
  expect "--traits cuda: $said" test -s cuda.off
  run 0 -- torus.off out.off "${many[@]}" --traits auto --report r.json
  expect 'many samples are for the GPU' grep -q '"traits": "cuda"' r.json
  ;;
esac
run 0 -- torus.off out.off -n 100 --iterations 2 --relaxation-iterations 2
expect 'who asks for no GPU hears of none' [ ! -s stderr ]
refuse check-every x 'not a whole number'

# --- understood
run 0 -- --help
for word in --samples --density --density-power --gradation --sampling --oversampling \
  --relaxation-iterations --attributes --normal-neighbors --density-neighbors --normal-smoothing --neighbors \
  --normal-angle --position-method --iterations --lbfgs-memory --projection --projection-neighbors \
  --centroid-density-power --weight-method --capacity-tolerance --max-weight-iterations \
  --weight-step --weight-operator --extraction --preset --traits --seed --threads --report --cells \
  --samples-out --fields --check --check-every --certified-combinatorics --no-mesh --ascii --quiet 'paper: 100' \
  '{above 0, at most 180}' '{from 1 to 32}' '[gamma]' '[Theta]' '[N_m^w]' 'Exit codes'; do
  expect "--help shows $word" grep -qF -- "$word" stdout
done
run 0 -- --version
expect '--version shows a number' grep -qE '^power_rtf_remesh [0-9]+\.[0-9]+' stdout

# accept WANTED ARGUMENTS...: the report says "WANTED"
accept() {
  local wanted=$1
  shift
  run 0 -- torus.off out.off "${fast[@]}" --report r.json "$@"
  expect "'$*' is reported as $wanted" grep -qF -- "$wanted" r.json
}
accept '"seed": 7' --seed 7
accept '"seed": 7' --random-seed 7
accept '"seed": 4294967295' --seed 4294967295
accept '"threads": 1' --threads 1
accept '"threads": 2' --threads=2
accept '"traits": "cpu"' --traits auto
accept '"gpu_not_used": "the C' --traits auto # PU is faster, or UDA traits are not built
accept '"traits": "cpu"' --traits cpu
expect 'who asks for the CPU needs no reason' [ "$(grep -c gpu_not_used r.json)" -eq 0 ]
accept '"traits": "exact"' --traits exact
accept '"certified-combinatorics": true' --certified-combinatorics
accept '"certified-combinatorics": false'
accept '"certified_wrong": 0' --check
accept '"equal_cycles": 100' --check --certified-combinatorics
accept '"after_iterations": 2' --check-every 2
for resolution in '-n 25%' '--vertex-share 0.25'; do
  run 0 -- torus.off out.off $resolution --report r.json
  expect "$resolution gives a quarter of the vertices" grep -q '"samples": 200,' r.json
done
run 0 -- torus.off out.off --edge-length 10% --report r.json
expect '10% of the diagonal is an edge length' grep -q '"relative-edge-length": 0.1' r.json
run 0 -- torus.off out.off --max-distance 1% --report r.json
expect '1% of the diagonal is kept' awk '/"distance_bound"/ { exit !($2 > 0 && $2 <= 1) }' r.json
cube >cube.off
run 3 'largest distance' -- cube.off out.off --max-distance 0.3% --features 180 # cut off
accept '"density": "curvature"'
accept '"density": "uniform"' --density uniform
accept '"density-power": 2.0' --density-power 2
accept '"gradation": 0.0' --gradation 0
accept '"preset": "quality"'
accept '"preset": "fast"' --preset fast
accept '"weight-method": "none"' --preset fast
accept '"preset": "paper"' --preset paper
accept '"normal-angle": 100.0' --preset paper
accept '"normal-angle": 75.0' --preset paper --normal-angle 75
accept '"normal-angle": 75.0' --normal-angle 75 --preset paper
accept '"weight-method": "multiplicative"' --preset paper
accept '"weight-method": "none"' --preset paper --weight-method none
accept '"weight-operator": "floor"' --preset paper --weight-operator floor
accept '"capacity-tolerance": 0.0' --capacity-tolerance 0
accept '"position-method": "lloyd"' --position-method lloyd
accept '"sampling": "random"' --sampling random
accept '"oversampling": 3.5' --oversampling 3.5
accept '"extraction": "cells"'
accept '"extraction": "insertion"' --extraction insertion
accept '"extraction": "insertion"' --preset paper
accept '"lbfgs-memory": 3' --lbfgs-memory 3
accept '"normal-smoothing": 0.0' --preset paper
accept '"normal-smoothing": 1.5' --normal-smoothing 1.5
run 0 -- torus.off out.off -n 400 --iterations 20 --density uniform --report r.json \
  --extraction restricted-delaunay
expect 'restricted Delaunay is reported' grep -q '"extraction": "restricted-delaunay"' r.json
run 0 -- -n100 --iterations=2 -q torus.off out.off
run 0 -- --quiet torus.off --iterations 2 -n 100 -- out.off

# --- Ctrl-C and SIGTERM: exit code 128 + the signal's number, the output untouched
torus 100 >large.off
# ends_by NAME NUMBER: the signal cancels a run
ends_by() {
  local status
  echo untouched >out.off
  "$program" large.off out.off -n 4000 --iterations 1000000 --centroid-tolerance 0 \
    --weight-method none 2>stderr &
  pid=$!
  cancel "$1" "$2" || return
  expect "$1 ends with $status instead of $((128 + $2))" [ $status -eq $((128 + $2)) ]
  expect "$1 is said" grep -q cancelled stderr
  expect "$1 leaves the output" [ "$(cat out.off)" = untouched ]
  expect "$1 leaves no temporary file" [ -z "$(find . -name '.power_rtf_*')" ]
}
ends_by INT 2
ends_by TERM 15

finish
