#!/bin/bash -eu
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Called by OSS-Fuzz, which sets CC, CXX, their flags, LIB_FUZZING_ENGINE and OUT: builds the targets
# and puts them into $OUT, with their corpora and dictionaries.
#
# The programs run where CGAL's dependencies are not installed, so that these are linked statically;
# TBB, which no target needs, is left out. Debian's Boost is made for libstdc++, not for libc++.
export CXXFLAGS="${CXXFLAGS//-stdlib=libc++/}"
libraries=/usr/lib/x86_64-linux-gnu
cmake -S . -B build/oss-fuzz -G Ninja -DCMAKE_BUILD_TYPE=Release -DPOWER_RTF_WITH_CUDA=OFF \
  -DPOWER_RTF_BUILD_FUZZERS=ON -DPOWER_RTF_BUILD_TESTING=OFF -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON \
  -DGMP_LIBRARY_RELEASE=$libraries/libgmp.a -DGMPXX_LIBRARIES=$libraries/libgmpxx.a \
  -DMPFR_LIBRARIES=$libraries/libmpfr.a -DCGAL_Boost_USE_STATIC_LIBS=ON \
  -DCMAKE_EXE_LINKER_FLAGS="-static-libstdc++ -static-libgcc"
cmake --build build/oss-fuzz --target fuzz_targets

folder=test/PowerRTF/fuzz
for corpus in "$folder"/corpus/*; do
  name=$(basename "$corpus")
  cp "build/oss-fuzz/bin/fuzz_$name" "$OUT"
  cp "$folder/dict/fuzz_$name.options" "$OUT"
  (cd "$corpus" && zip -qr "$OUT/fuzz_${name}_seed_corpus.zip" .)
done
cp "$folder"/dict/*.dict "$OUT"
