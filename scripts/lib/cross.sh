# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# What builds for other systems than this one; to be sourced after common.sh.

TOOLS=$ROOT/build/package/tools
# The Python that blender.org's Blender 4.2 to 5.0 have.
WINDOWS_PYTHON=3.11

# alone COMMAND...: not while another script does what is run so; they share folders of build/package.
alone() {
  mkdir -p "$ROOT/build/package"
  (flock 8; "$@") 8>"$ROOT/build/package/lock"
}

make_package_tools() {
  say "Tools for wheels in build/package/tools"
  rm -rf "$TOOLS"
  "$PYTHON" -m venv "$TOOLS"
  "$TOOLS/bin/pip" install -q --disable-pip-version-check -r scripts/lib/requirements-package.txt
}

get_package_tools() {
  [ -x "$TOOLS/bin/python" ] || rm -f build/stamps/package-tools
  once package-tools "$(fingerprint scripts/lib/requirements-package.txt) $ROOT" make_package_tools
}

# Makes the tools that wheels are built with ready, and sets ZIG.
package_tools() {
  alone get_package_tools
  ZIG=$("$TOOLS/bin/python" -c 'import pathlib, ziglang; print(pathlib.Path(ziglang.__file__).with_name("zig"))')
}

# build_cross_tests PLATFORM: the library's tests, in the folder of the platform's wheels, so that the library is compiled once. scripts/package
# was there before.
build_cross_tests() {
  local folder=$ROOT/build/package/$1/build log=$ROOT/build/configure-$1.log
  PATH=$TOOLS/bin:$PATH cmake -S . -B "$folder" -DSEAMWIRE_TESTS=ON -DSEAMWIRE_GOOGLETEST_SOURCES=/usr/src/googletest/googletest >"$log" ||
    { cat "$log"; return 1; }
  PATH=$TOOLS/bin:$PATH cmake --build "$folder" --target seamwire_tests --parallel "$(nproc)"
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
