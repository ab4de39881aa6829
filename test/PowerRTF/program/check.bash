# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the scripts that test the program share: a scratch folder, small meshes, counted checks.
# Sourced with the program's path as the script's first argument.
set -uo pipefail
program=$(readlink -f "${1:?the path of power_rtf_remesh}")
scratch=$(mktemp -d)
trap 'chmod -R u+w "$scratch"; rm -rf "$scratch"' EXIT
cd "$scratch"
checks=0 failures=0

# expect NAME COMMAND...: counts a check, that the command succeeds
expect() {
  local name=$1
  shift
  checks=$((checks + 1))
  if ! "$@" >/dev/null 2>&1; then
    failures=$((failures + 1))
    echo "FAILED: $name"
  fi
}

# run EXPECTED_CODE TEXT... -- ARGUMENTS...: the program's exit code is the expected one, stderr
# contains every text, and out.off is untouched unless the code is 0 or 3.
run() {
  local code=$1 texts=() text status said
  shift
  while [ "$1" != -- ]; do
    texts+=("$1")
    shift
  done
  shift
  echo untouched >out.off
  timeout 120 "$program" "$@" >stdout 2>stderr
  status=$?
  said=$(head -c 300 stderr | tr -d '\0')
  expect "'$*' ends with $status instead of $code: $said" [ "$status" -eq "$code" ]
  for text in "${texts[@]}"; do
    expect "'$*' does not say '$text' but '$said'" grep -qiF -- "$text" stderr
  done
  if [ "$code" -ne 0 ] && [ "$code" -ne 3 ]; then
    expect "'$*' has changed its output" [ "$(cat out.off)" = untouched ]
    expect "'$*' leaves a temporary file" [ -z "$(find . -name '.power_rtf_*')" ]
  fi
}

# cube: a cube as OFF, of quadrangles
cube() {
  printf '%s\n' OFF '8 6 0' '0 0 0' '1 0 0' '0 1 0' '1 1 0' '0 0 1' '1 0 1' '0 1 1' '1 1 1' \
    '4 0 2 3 1' '4 4 5 7 6' '4 0 1 5 4' '4 2 6 7 3' '4 0 4 6 2' '4 1 3 7 5'
}

# torus [N]: a torus as OFF, N x N/2 quadrangles cut in two
torus() {
  awk -v n="${1:-40}" 'BEGIN {
    pi = atan2(0, -1); m = n / 2
    print "OFF"; print n * m, 2 * n * m, 0
    for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
      r = 3 + cos(2 * pi * j / m)
      printf "%.17g %.17g %.17g\n", r * cos(2 * pi * i / n), r * sin(2 * pi * i / n), sin(2 * pi * j / m)
    }
    for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
      a = i * m + j; b = i * m + (j + 1) % m; c = (i + 1) % n * m + j; d = (i + 1) % n * m + (j + 1) % m
      print 3, a, c, d; print 3, a, d, b
    }
  }'
}

# off_to_obj, off_to_stl: the OFF triangles of stdin in another format
off_to_obj() {
  awk 'NR == 2 { v = $1 } NR > 2 && NR <= 2 + v { print "v", $0 }
       NR > 2 + v { print "f", $2 + 1, $3 + 1, $4 + 1 }'
}
off_to_stl() {
  awk 'NR == 1 { print "solid s" } NR == 2 { v = $1 } NR > 2 && NR <= 2 + v { p[NR - 3] = $0 }
       NR > 2 + v { print "facet normal 0 0 0\nouter loop\nvertex " p[$2] "\nvertex " p[$3] \
                          "\nvertex " p[$4] "\nendloop\nendfacet" }
       END { print "endsolid s" }'
}
off_to_ply() {
  awk 'NR == 2 { v = $1; print "ply\nformat ascii 1.0\nelement vertex " $1 \
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " $2 \
         "\nproperty list uchar int vertex_indices\nend_header" } NR > 2'
}

# catches NUMBER: the program has a handler for the signal
catches() {
  local mask
  mask=$(awk '/^SigCgt/ { print $2 }' "/proc/$pid/status" 2>/dev/null) &&
    [ $((0x${mask: -8} & 1 << ($1 - 1))) -ne 0 ]
}
# waits 60 s at most for a command to succeed
await() {
  for _ in $(seq 600); do
    "$@" 2>/dev/null && return
    sleep 0.1
  done
  return 1
}
has_ended() { ! kill -0 $pid; }
# cancel NAME NUMBER: sends the signal to the program `pid` once it has a handler and has begun, and
# sets `status`; fails where the system does not tell of handlers
cancel() {
  if [ ! -e "/proc/$pid/status" ]; then
    kill -KILL $pid
    return 1
  fi
  expect "$1 can be caught" await catches "$2"
  sleep 1
  kill -"$1" $pid
  await has_ended || kill -KILL $pid
  wait $pid
  status=$?
}

# finish: the summary; the script's exit status
finish() {
  echo "$checks checks, $failures failures"
  [ "$failures" -eq 0 ] && [ "$checks" -gt 0 ]
}
