#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# build.sh TARGET...   install what the benchmarks need, build these targets and fetch CGAL's models
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
. "$root/tools/setup.sh"

install_missing libcgal-dev libeigen3-dev libtbb-dev libboost-program-options-dev \
  nlohmann-json3-dev libbenchmark-dev python3-venv
if [ -e "$build/CMakeCache.txt" ]; then
  configure -DPOWER_RTF_BUILD_BENCHMARKS=ON # what ./run_tests has switched on stays on
else
  configure -DPOWER_RTF_BUILD_BENCHMARKS=ON -DPOWER_RTF_BUILD_TESTING=OFF
fi
build_targets --target "$@"
fetch_models || say "CGAL's models cannot be had here"
