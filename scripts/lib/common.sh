# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# Shared by the scripts; to be sourced. Sets the working folder to the top of the project.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
ROOT=$PWD

# Debian's own tools, whatever stands before them: the add-on's module must be built for the Python that Blender embeds.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
unset PYTHONPATH PYTHONHOME
# Files may have any letters, and programs speak English, also where no language is set, as in a container.
export LC_ALL=C.UTF-8
PYTHON=/usr/bin/python3
VENV=$ROOT/.venv

# The folders where Blender finds the add-on and keeps its settings in tests and demo; the user's own stay untouched. A test of another
# Blender than the installed one names its own.
export SEAMWIRE_BLENDER_PACKAGES=${SEAMWIRE_BLENDER_PACKAGES:-$ROOT/build/blender-packages}
BLENDER_USER=${SEAMWIRE_BLENDER_USER:-$ROOT/build/blender}
export BLENDER_USER_SCRIPTS=$BLENDER_USER/scripts
export BLENDER_USER_CONFIG=$BLENDER_USER/config
export BLENDER_USER_DATAFILES=$BLENDER_USER/datafiles
export BLENDER_USER_EXTENSIONS=$BLENDER_USER/extensions
ADDON=$BLENDER_USER_SCRIPTS/addons/seamwire
REPORTS=$ROOT/build/reports

say() { printf '\033[1m== %s\033[0m\n' "$*"; }
die() { printf '%s\n' "$*" >&2; exit 1; }
source scripts/lib/steps.sh

# install_debian_packages PACKAGE...: installs the missing ones, as root or with sudo, and shows the progress. apt's own words go to
# build/apt*.log. Fails with a sentence that names the missing packages.
install_debian_packages() {
  local missing=() as_root=() package log
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  printf '   Debian packages: %s\n' "${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "not root, and no sudo: these Debian packages are missing: ${missing[*]}" >&2; return 1; }
    as_root=(sudo)
  fi
  mkdir -p "$ROOT/build"
  log=$ROOT/build/apt-${missing[0]}.log
  # Another script of ours may be installing. Packages need not survive a power failure during the installation.
  local apt_get="apt-get -q -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=600 -o APT::Status-Fd=3 -o Dpkg::Options::=--force-unsafe-io"
  local install="$apt_get install -y --no-install-recommends ${missing[*]}"
  # apt makes its status pipe non-blocking, so packages must not write there: their words go to the log. apt itself waits for nobody who
  # updates the lists, so one script does so at a time.
  flock "$ROOT/build/apt.lock" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    sh -c "exec 3>&1 >'$log' 2>&1; $apt_get update; $install" </dev/null |
    show_progress /dev/null || { tail -n 20 "$log" >&2; echo "not installed: ${missing[*]} ($log)" >&2; return 1; }
}

# configure_preset PRESET [OPTION...]: CMake's first step, with OpenMesh's sources from PyPI: Debian's package brings half a desktop with it.
configure_preset() {
  "$VENV/bin/python" scripts/lib/wheel_sources.py build/sources || return
  cmake --preset "$@" -DSEAMWIRE_OPENMESH_SOURCES="$ROOT/build/sources/openmesh"
}

# A number that changes with the contents of the files and folders named.
fingerprint() {
  find "$@" -type f ! -name '*.pyc' -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum | cut -d' ' -f1
}

# once STAMP FINGERPRINT COMMAND...: runs the command unless it went well before with the same fingerprint.
once() {
  local stamp=$ROOT/build/stamps/$1 print=$2
  shift 2
  if [ "$(cat "$stamp" 2>/dev/null)" = "$print" ]; then return 0; fi
  rm -f "$stamp"
  "$@" || return # also where bash ignores errors, as within a condition
  mkdir -p "$ROOT/build/stamps"
  printf '%s\n' "$print" >"$stamp"
}

# with_window COMMAND...: runs it on a new virtual display, drawn by the processor. The contents of the display can be read from
# $SEAMWIRE_SCREEN, an X window dump that the X server writes to.
with_window() {
  local folder code=0
  folder=$(mktemp -d)
  # Start at a different display number for each process, so that two runs do not choose the same one.
  env -u WAYLAND_DISPLAY LIBGL_ALWAYS_SOFTWARE=1 SEAMWIRE_SCREEN="$folder/Xvfb_screen0" \
    xvfb-run -n "$((100 + BASHPID % 400))" -a -s "-screen 0 ${SEAMWIRE_SCREEN_SIZE:-1280x960}x24 -fbdir $folder" "$@" || code=$?
  rm -rf "$folder"
  return $code
}

# The Debian mirror that this machine's own packages come from.
debian_mirror() {
  local codename
  # shellcheck disable=SC1091
  codename=$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-}")
  # shellcheck disable=SC2016 # apt fills them in
  apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' | awk -v c="$codename" '$1 == c && $2 == "main" {print $3; exit}'
}
