#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Usage: BUILD=build fuzz.sh SECONDS JOBS
# Runs every fuzz target from the seeds in tests/fuzz/corpus/NAME, where there are any; the first fault fails it.
set -euo pipefail
seconds=$1
jobs=$2

fuzz_one() {
  local program=$1 name corpus
  name=$(basename "$program")
  name=${name#fuzz_}
  corpus=$BUILD/fuzz/corpus/$name
  mkdir -p "$corpus"
  local folders=("$corpus")
  [ ! -d "tests/fuzz/corpus/$name" ] || folders+=("tests/fuzz/corpus/$name")
  if ! "$program" -max_total_time="$seconds" -timeout=10 -artifact_prefix="$BUILD/fuzz/$name-" "${folders[@]}" \
    >"$BUILD/fuzz/$name.log" 2>&1; then
    tail -n 60 "$BUILD/fuzz/$name.log"
    return 1
  fi
  echo "$name: $(tail -n 1 "$BUILD/fuzz/$name.log")"
}
export -f fuzz_one
export BUILD seconds

mapfile -t programs < <(find "$BUILD/fuzz/tests" -maxdepth 1 -name 'fuzz_*' -type f -perm -u+x | sort)
if [ "${#programs[@]}" -eq 0 ]; then
  echo "fuzz.sh: no fuzz target was built; expected one for each tests/fuzz/*.cpp" >&2
  exit 1
fi
printf '%s\0' "${programs[@]}" | xargs -0 -n 1 -P "$jobs" bash -c 'set -euo pipefail; fuzz_one "$1"' --
