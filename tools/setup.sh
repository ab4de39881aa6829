# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What ./remesh and ./run_tests share: install what is missing, configure, build, fetch models.
# Sourced by bash with `root` set to the repository. Everything is said on stderr.

build=$root/build/release
program=$build/bin/power_rtf_remesh
# CGAL's own models, as Debian and Ubuntu ship them: $models/meshes/elk.off, ...
models=$root/build/data

say() { printf '%s\n' "$*" >&2; }
fail() { say "$(basename "$0"): $*"; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }

# as_root COMMAND...: run it as root; fails where that cannot be.
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif ! have sudo; then
    return 1
  elif [ -t 0 ]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

apt_get() { as_root env DEBIAN_FRONTEND=noninteractive apt-get -q "$@"; }

# install_missing PACKAGE...: installs those that dpkg does not have, and a compiler, CMake and
# Ninja where there are none.
install_missing() {
  local present missing=() package
  have dpkg-query || { say "No dpkg here: taking for granted that these are installed: $*"; return; }
  { [ -n "${CXX:-}" ] || have g++ || have clang++; } || missing+=(g++)
  have cmake || missing+=(cmake)
  have ninja || have make || missing+=(ninja-build)
  present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  for package; do
    [[ $'\n'$present$'\n' == *$'\n'"installed $package"$'\n'* ]] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0

  say "Installing by apt: ${missing[*]}"
  mkdir -p "$build"
  if ! logged "$build/install.log" 'Installed' \
       apt_get install -y --no-install-recommends "${missing[@]}" 2>/dev/null; then
    # A fresh machine has no list of packages yet, an old one a list that is out of date.
    logged "$build/install.log" 'Read the list of packages' apt_get update || true
    logged "$build/install.log" 'Installed' \
      apt_get install -y --no-install-recommends "${missing[@]}" || {
        tail -n 15 "$build/install.log" >&2
        fail "cannot install packages. As root, run this and try again:
    apt-get update && apt-get install ${missing[*]}"
      }
  fi
}

# logged LOG FINISHED COMMAND...: runs the command with its output in LOG and its progress ("[3/40]...",
# "[ 12%]...") on one line of the terminal, or every half minute elsewhere.
logged() {
  local log=$1 finished=$2 line text start=$SECONDS last=$SECONDS status
  shift 2
  "$@" 2>&1 | while IFS= read -r line; do
    printf '%s\n' "$line"
    [[ $line == \[* ]] || continue
    text=${line#*]}
    line="${line%%]*}] ${text##*/}"
    if [ -t 2 ]; then
      printf '\r\033[K  %.76s' "$line" >&2
    elif ((SECONDS - last >= 30)); then
      last=$SECONDS
      printf '  %.76s\n' "$line" >&2
    fi
  done >"$log"
  status=${PIPESTATUS[0]}
  if [ -t 2 ]; then printf '\r\033[K' >&2; fi
  if [ "$status" = 0 ]; then say "$finished ($((SECONDS - start)) s)"; fi
  return "$status"
}

# or_show LOG WHAT: after a failure, the log's end.
or_show() {
  tail -n 60 "$1" >&2
  fail "$2 failed; its whole output is in $1"
}

# CGAL's headers take 1 to 2 GB for each compiler at work.
build_jobs() {
  local cores memory
  cores=$(nproc 2>/dev/null || echo 1)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null || true)
  if [ -n "$memory" ] && [ "$memory" -lt "$cores" ]; then cores=$memory; fi
  [ "$cores" -ge 1 ] || cores=1
  echo "${CMAKE_BUILD_PARALLEL_LEVEL:-$cores}"
}

# configure OPTION...: cmake with these options, in the build folder of the preset "release".
configure() {
  mkdir -p "$build"
  if have ninja && [ ! -e "$build/CMakeCache.txt" ]; then set -- -G Ninja "$@"; fi
  logged "$build/configure.log" 'Configured' \
    cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release "$@" ||
    or_show "$build/configure.log" 'the configuration'
}

# build_targets [--target TARGET]
build_targets() {
  local jobs first=
  jobs=$(build_jobs)
  [ -e "$build/build.log" ] || first='; the first time takes minutes'
  say "Building, $jobs file(s) at a time$first"
  logged "$build/build.log" 'Built' cmake --build "$build" -j "$jobs" "$@" ||
    or_show "$build/build.log" 'the build'
}

# fetch_models [MEMBER]: unpacks CGAL's models (or one of them, data/meshes/...) to $models.
# Neither installs the package nor trusts that an installed one has its data: images for containers
# leave out /usr/share/doc.
fetch_models() {
  local archive=/usr/share/doc/libcgal-dev/data.tar.gz scratch status=0
  [ ! -e "$models/complete" ] || return 0
  if [ $# -gt 0 ] && [ -s "$root/build/$1" ]; then return 0; fi
  mkdir -p "$root/build"
  if [ -e "$archive" ]; then
    tar -xzf "$archive" -C "$root/build" "${1:-data}" || return 1
  elif have apt-get; then
    say 'Fetching the package libcgal-demo for its models'
    scratch=$(mktemp -d)
    (cd "$scratch" && { apt-get -qq download libcgal-demo ||
                        { apt_get update && apt-get -qq download libcgal-demo; }; } &&
     dpkg-deb --fsys-tarfile libcgal-demo_*.deb | tar -xO "./${archive#/}" |
       tar -xz -C "$root/build" "${1:-data}") >"$root/build/models.log" 2>&1 || status=1
    rm -rf "$scratch"
    [ $status = 0 ] || return 1
  else
    return 1
  fi
  if [ $# = 0 ]; then touch "$models/complete"; fi
}

# make_python_environment FOLDER: a virtual environment with what the Python module and its tests need,
# and the packages that some tests use, which are skipped without them.
make_python_environment() {
  local log=$root/build/python.log
  local packages=('nanobind>=2.4,<4' 'numpy>=1.23,<3' 'pytest>=7,<10' 'pyarrow>=15')
  local more=('trimesh>=4,<6' 'meshio>=5,<6' 'pyvista>=0.44,<1' 'tqdm>=4,<5' 'matplotlib>=3,<4'
              'sphinx>=7,<10' 'myst-parser>=3,<6' 'furo')
  [ "$(cat "$1/complete" 2>/dev/null)" != "${packages[*]} ${more[*]}" ] || return 0
  mkdir -p "$root/build"
  python3 -m venv "$1" >"$log" 2>&1 && "$1/bin/pip" install "${packages[@]}" >>"$log" 2>&1 || return 1
  if "$1/bin/pip" install "${more[@]}" >>"$log" 2>&1; then
    echo "${packages[*]} ${more[*]}" >"$1/complete"
  else
    say "not to be had here (see build/python.log), so tests will skip: ${more[*]}"
  fi
}
