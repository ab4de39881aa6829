#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# cuda/run_gpu_checks.sh [--programs FOLDER] [--models FOLDER] [--quick] [--large] [--sanitizer]
#
# On a machine with an NVIDIA GPU: builds what is missing, runs all device tests and the benchmarks
# of the CUDA engine, and prints a short table.
#   --programs   where the built programs are (default: build/gpu/bin, built first)
#   --models     where armadillo.off and others are (default: those that ./run_tests has fetched)
#   --quick      only up to 30 000 samples
#   --large      also 30 million samples
#   --sanitizer  short runs under compute-sanitizer, too (memcheck, racecheck, initcheck)
set -uo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
programs= models=$root/build/data/meshes quick= large= sanitizer=
while [ $# -gt 0 ]; do
  case $1 in
  --programs) programs=$(readlink -f "$2"); shift ;;
  --models) models=$(readlink -f "$2"); shift ;;
  --quick) quick=yes ;;
  --large) large=yes ;;
  --sanitizer) sanitizer=yes ;;
  *) sed -n '5,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
  esac
  shift
done

if [ -z "$programs" ]; then
  cmake -S "$root" -B "$root/build/gpu" -DPOWER_RTF_WITH_CUDA=ON -DCMAKE_CUDA_ARCHITECTURES=native \
    -DPOWER_RTF_BUILD_BENCHMARKS=ON || exit 1
  cmake --build "$root/build/gpu" || exit 1
  programs=$root/build/gpu/bin
fi

table=() failures=0
note() { table+=("$(printf '%-44s %s' "$1" "$2")"); }

# check NAME COMMAND...: the test passes, or says that it is skipped
check() {
  local name=$1 status
  shift
  "$@"
  status=$?
  case $status in
  0) note "$name" passed ;;
  77) note "$name" skipped ;;
  *) note "$name" "FAILED ($status)"; failures=$((failures + 1)) ;;
  esac
}

for test in "$programs"/test_cuda_*; do
  [ -x "$test" ] && check "$(basename "$test")" "$test"
done
if [ -n "$sanitizer" ]; then
  for tool in memcheck racecheck initcheck; do
    for arguments in '--samples 1000 --iterations 6' \
      '--samples 1000 --preset paper --iterations 3' \
      '--samples 9000 --density curvature --iterations 2' '--samples 150000 --iterations 1' \
      '--samples 9000 --iterations 1 --check'; do
      check "$tool $arguments" compute-sanitizer --tool $tool --error-exitcode 1 \
        "$programs/cuda_remeshing" "$models/fertility.off" $arguments --runs 0
    done
  done
fi

# bench NAME ARGUMENTS...: the program's lines, and those with times into the table
bench() {
  local name=$1 line
  shift
  [ -x "$programs/$name" ] || return
  while IFS= read -r line; do
    echo "$line"
    case $line in *' ms '* | *' | '* | *check:* | *mesh:* | *' total '*) table+=("  $line") ;; esac
  done < <("$programs/$name" "$@" 2>&1)
}

for benchmark in "$programs"/cuda_*; do # the single kernels
  case $benchmark in */cuda_remeshing | *.*) ;; *) bench "$(basename "$benchmark")" ;; esac
done
for model in kitten elk armadillo fertility; do
  [ -r "$models/$model.off" ] || continue
  table+=("$model")
  for density in uniform curvature; do
    bench cuda_remeshing "$models/$model.off" --samples 3000 --density $density --check --cpu \
      --meshes 3
    bench cuda_remeshing "$models/$model.off" --samples 30000 --density $density --check --cpu
  done
  for traits in cuda cpu; do # from mesh to mesh, milliseconds
    bench whole_runs "$models/$model.off" --samples 3000,30000 --traits $traits
  done
  case $model in kitten | fertility) # on the others the paper's weights converge with no traits
    bench cuda_remeshing "$models/$model.off" --samples 3000 --preset paper --check --cpu
    for seed in 1 2 3 4; do
      bench cuda_remeshing "$models/$model.off" --samples 3000 --preset paper --seed $seed
    done ;;
  esac
done
refined=$models/armadillo.off
if [ -z "$quick" ] && [ -r "$refined" ]; then
  table+=("armadillo, refined")
  bench cuda_remeshing "$refined" --refine 2 --samples 3000,30000,1000000
  bench cuda_remeshing "$refined" --refine 3 --samples 10000000 --runs 1
  bench whole_runs "$refined" --refine 2 --samples 1000000 --traits cuda
  [ -n "$large" ] && bench cuda_remeshing "$refined" --refine 3 --samples 30000000 --runs 0
fi

echo
printf '%s\n' "${table[@]}"
exit $((failures > 0))
