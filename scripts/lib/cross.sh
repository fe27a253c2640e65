# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# What builds for other systems than this one; to be sourced after common.sh.

WORK=$ROOT/build/package
# All checkouts share this folder, and `rm -rf build` leaves it: tools, sources, headers, and what zig has compiled. You can delete it.
KEPT=${XDG_CACHE_HOME:-$HOME/.cache}/seamwire
# Named after the system's release, which decides what Python there is: Python itself may not be installed yet.
# shellcheck disable=SC1091
TOOLS=$KEPT/tools-$({ (. /etc/os-release && echo "${VERSION_ID:-unstable}"); cat scripts/lib/requirements-package.txt; } | sha256sum | cut -c1-12)
# The sources of OpenMesh and Eigen.
SOURCES=$KEPT/sources-$(cat scripts/lib/wheel_sources.py scripts/lib/wheel-sources.txt | sha256sum | cut -c1-12)
export ZIG_GLOBAL_CACHE_DIR=$KEPT/zig
# The Python that blender.org's Blender 4.2 to 5.0 have.
WINDOWS_PYTHON=3.11

# Which Debian, or Ubuntu, has which Python; Debian's unstable has what is newer.
declare -A SUITES=([3.10]=jammy [3.11]=bookworm [3.12]=noble [3.13]=trixie)
UBUNTU=http://archive.ubuntu.com/ubuntu

# suite_of PYTHON
suite_of() { echo "${SUITES[$1]:-sid}"; }

# alone COMMAND...: runs the command while no other script changes $KEPT.
alone() {
  mkdir -p "$KEPT"
  (flock 8; "$@") 8>"$KEPT/lock"
}

get_package_tools() {
  [ ! -f "$TOOLS/complete" ] || return 0
  rm -rf "$TOOLS"
  "$PYTHON" -m venv "$TOOLS" &&
    "$TOOLS/bin/pip" install -q --disable-pip-version-check -r scripts/lib/requirements-package.txt &&
    touch "$TOOLS/complete"
}

# Downloads the sources of OpenMesh and Eigen into $SOURCES.
wheel_sources() { alone "$TOOLS/bin/python" scripts/lib/wheel_sources.py "$SOURCES"; }

# Makes the tools that wheels are built with ready, and sets ZIG.
package_tools() {
  alone get_package_tools
  ZIG=$("$TOOLS/bin/python" -c 'import pathlib, ziglang; print(pathlib.Path(ziglang.__file__).with_name("zig"))')
}

# get_from SUITE KIND COMMAND...: runs apt-get with the lists of that Debian or Ubuntu, without touching this system's apt. KIND: deb, deb-src.
# The command's downloads land in the folder printed. ARCHITECTURE: without it amd64.
get_from() {
  local suite=$1 kind=$2 apt=$WORK/apt/$1 mirror key=/usr/share/keyrings/debian-archive-keyring.gpg
  shift 2
  if [[ $suite =~ ^(jammy|noble)$ ]]; then
    mirror=$UBUNTU
    key=$(get_ubuntu_key) || { echo "$key"; return 1; }
  else
    mirror=$(debian_mirror)
    [ -n "$mirror" ] || { echo "this system's apt knows no Debian mirror"; return 1; }
  fi
  rm -rf "$apt"
  mkdir -p "$apt"/{lists/partial,cache/archives/partial,state,got}
  printf '%s [signed-by=%s] %s %s main\n' "$kind" "$key" "$mirror" "$suite" >"$apt/sources.list"
  : >"$apt/status"
  local options=(-q -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null -o "Dir::State=$apt/state"
    -o "Dir::State::Lists=$apt/lists" -o "Dir::State::status=$apt/status" -o "Dir::Cache=$apt/cache"
    -o "APT::Architecture=${ARCHITECTURE:-amd64}" -o Acquire::Check-Valid-Until=false -o Acquire::Languages=none -o APT::Sandbox::User=)
  apt-get "${options[@]}" update >&2 || { echo "the package lists of $suite cannot be had"; return 1; }
  (cd "$apt/got" && apt-get "${options[@]}" "$@" >&2) || { echo "$suite cannot be asked for ${*: -1} today"; return 1; }
  echo "$apt/got"
}

# Prints the file of the key that Ubuntu's lists are signed with, from Debian's package.
get_ubuntu_key() {
  local key=$KEPT/keys/usr/share/keyrings/ubuntu-archive-keyring.gpg got
  if [ ! -f "$key" ]; then
    got=$(get_from trixie deb download ubuntu-keyring) || { echo "$got"; return 1; }
    dpkg-deb -x "$got"/ubuntu-keyring_*.deb "$KEPT/keys"
  fi
  echo "$key"
}

# The system's libraries that Python and its modules link.
PYTHON_LIBRARIES=(libc6 libgcc-s1 libstdc++6 libbz2-1.0 libcrypt1 libdb5.3 libexpat1 libffi8 liblzma5 libncursesw6 libreadline8
  libsqlite3-0 libssl3 libtinfo6 libuuid1 zlib1g)

# linux_python PYTHON FOLDER [ARCHITECTURE]: that Python in FOLDER/usr/bin, as its Debian or Ubuntu has it; for another ARCHITECTURE than this
# machine's with the libraries it needs.
linux_python() {
  local python=$1 folder=$2 suite got packages=("python$1-minimal" "libpython$1-minimal" "libpython$1-stdlib") package
  [ ! -x "$folder/usr/bin/python$python" ] || return 0
  suite=$(suite_of "$python")
  [ $# -lt 3 ] || packages+=("${PYTHON_LIBRARIES[@]}")
  got=$(ARCHITECTURE=${3:-} get_from "$suite" deb download "${packages[@]}") || { echo "$got"; return 1; }
  rm -rf "$folder"
  for package in "$got"/*.deb; do dpkg-deb -x "$package" "$folder.new"; done
  rm -rf "$WORK/apt/$suite"
  mv "$folder.new" "$folder"
}

# build_cross_tests PLATFORM: the library's tests, in the folder of the platform's wheels, so that the library is compiled once. scripts/package
# was there before.
build_cross_tests() {
  local folder=$WORK/$1/build
  (
    flock 7
    watched "$WORK/$1/configure-tests.log" \
      cmake -S . -B "$folder" -DSEAMWIRE_TESTS=ON -DSEAMWIRE_GOOGLETEST_SOURCES=/usr/src/googletest/googletest &&
      watched "$WORK/$1/compile-tests.log" cmake --build "$folder" --target seamwire_tests --parallel "$(nproc)"
  ) 7>"$WORK/$1/lock"
}

# windows_dll PYTHON FOLDER: a Python's DLLs for Windows in the folder (scripts/lib/windows_python.py), with its import library.
windows_dll() {
  local library=$2/python${1/./}.dll
  "$TOOLS/bin/python" scripts/lib/windows_python.py "$1" "$2" >&2 || { echo "PyPI has no Windows Python $1"; return 1; }
  [ "$library.a" -nt "$2/stamp" ] || "$ZIG" dlltool -m i386:x86-64 -d "${library%.dll}.def" -l "$library.a"
}

# What changes when scripts/lib/make_windows_python would make another one.
windows_python_recipe() {
  (cd "$ROOT/scripts/lib" && fingerprint make_windows_python cross.sh requirements-wine.txt python_launcher.c windows_python.py \
    windows-python.txt)
}
