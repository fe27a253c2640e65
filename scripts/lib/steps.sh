# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Numbered steps with the time they take, and the percentage of what takes longer; to be sourced after common.sh.

STEP=0
# How many steps there are in all: the script that begins with the first step says so.
STEPS=${STEPS:-3}

# step WHAT TIME: the headline of the next step, with how long it takes on two cores where nothing is installed or built yet.
step() {
  STEP=$((STEP + 1))
  STEP_STARTED=$SECONDS
  say "$STEP/$STEPS $1 (about $2)"
}

# step_done [WHAT]: how long the step took.
step_done() { printf '   %s %d s\n' "${1:-done in}" $((SECONDS - STEP_STARTED)); }

# percent_of LINE: sets PERCENT and DOING where the line tells how far a command has come: apt's status lines, Ninja's [3/17], and ours,
# "progress 40 unwrapping".
percent_of() {
  case $1 in
    dlstatus:*:*:*) PERCENT=${1#dlstatus:*:} DOING=downloading ;;
    pmstatus:*:*:*) PERCENT=${1#pmstatus:*:} DOING=installing ;;
    '['[0-9]*/[0-9]*']'*)
      PERCENT=${1#'['} PERCENT=${PERCENT%%']'*}
      PERCENT=$((100 * ${PERCENT%/*} / ${PERCENT#*/})) DOING=compiling
      ;;
    'progress '[0-9]*) PERCENT=${1#progress } DOING=${PERCENT#* } ;;
    *) return 1 ;;
  esac
  PERCENT=${PERCENT%%[!0-9]*}
}

# show_progress LOG: reads what a command prints into LOG and shows the newest percentage: in place on a terminal, a line every five
# seconds elsewhere, and nothing within the first five seconds. Lines that begin with three spaces are for the reader and are shown as
# they come.
show_progress() {
  local line shown=$SECONDS PERCENT DOING is_open=
  while IFS= read -r line; do
    printf '%s\n' "$line" >&3
    if [[ $line == '   '* ]]; then
      [ -z "$is_open" ] || printf '\r\033[K'
      is_open=
      printf '%s\n' "$line"
    elif percent_of "$line" && [ $((SECONDS - shown)) -ge 5 ]; then
      if [ -t 1 ]; then
        printf '\r\033[K   %s: %d %%' "$DOING" "$PERCENT"
        is_open=yes
      else
        printf '   %s: %d %%\n' "$DOING" "$PERCENT"
        shown=$SECONDS
      fi
    fi
  done 3>"$1"
  [ -z "$is_open" ] || printf '\r\033[K'
}

# watched LOG COMMAND...: runs the command and shows its progress. If the command fails, shows the last lines of its output.
watched() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  # Under pipefail the command's exit code is the pipe's.
  "$@" 2>&1 </dev/null | show_progress "$log" || { tail -n 30 "$log" >&2; return 1; }
}
