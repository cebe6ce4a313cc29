#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Usage: check_headers.sh JOBS
# Every header compiles alone, after Eigen/Core, with which nearly all begin: clang reads it as a header that is
# to be precompiled. Those that their own test includes first are left out: a build of the tests without
# CMAKE_UNITY_BUILD shows it. Those of json are left out too where nlohmann_json is not installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

headers() {
  local header own
  while read -r header; do
    own=tests/${header#include/diabolo/}
    own=${own%.hpp}.cpp
    if [ -f "$own" ] && [ "$(grep -m 1 '^#include' "$own")" = "#include \"${header#include/}\"" ]; then
      continue
    fi
    case $header in include/diabolo/json/* | include/diabolo/hosts/string_attributes.hpp) [ -d /usr/include/nlohmann ] || continue ;; esac
    echo "$header"
  done < <(find include/diabolo -name '*.hpp' | sort)
}

compile() {
  clang++ -std=c++20 -Iinclude -isystem "${EIGEN_INCLUDE_DIR:-/usr/include/eigen3}" -Wall -Wextra -Wpedantic -Wshadow \
    -Wconversion -Werror -Wno-pragma-once-outside-header -x c++-header "$@"
}

check_one() {
  local out
  out=$(mktemp -p "$scratch")
  compile -include-pch "$scratch/eigen.pch" "$1" -o "$out"
  rm "$out"
}
export -f compile check_one
export scratch

echo "#include <Eigen/Core>" >"$scratch/eigen.hpp"
compile "$scratch/eigen.hpp" -o "$scratch/eigen.pch"
mapfile -t alone < <(headers)
printf '%s\0' "${alone[@]}" | xargs -0 -n 1 -P "$jobs" bash -c 'set -euo pipefail; check_one "$1"' --
echo "${#alone[@]} headers compile alone"
