#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Usage: system_packages.sh GROUP...   with groups build, test, plant, ur-rtde, bench, lint, mujoco, gazebo, browser, page
# Looks for what the groups need and installs with apt-get what is missing; asks for nothing when all is there.
set -euo pipefail

readonly WANTED="a C++20 compiler, CMake 3.25, Ninja, Eigen 3.4, nlohmann-json, Python 3.10 with venv and headers; \
for tests Catch2, CLI11, Orocos KDL and Boost (system, thread, program_options), for benchmarks Google Benchmark, for lint and fuzzing clang, clang-tidy and its runtime libraries"
python=${PYTHON:-python3}

has_command() { command -v "$1" >/dev/null 2>&1; }
has_header() {
  printf '#include <%s>\n' "$1" |
    c++ -std=c++20 -E -x c++ -isystem /usr/include/eigen3 -isystem /usr/local/include/eigen3 - >/dev/null 2>&1
}
has_library() { # headers alone may come with another package
  printf 'int main() {}' | c++ -x c++ - -l"$1" -o /dev/null 2>/dev/null
}
has_cmake() {
  local version
  version=$(cmake --version 2>/dev/null | sed -n '1s/.*version //p') && printf '3.25\n%s\n' "$version" | sort -V -C
}
has_python() { "$python" -c 'import ensurepip, venv' 2>/dev/null; }
has_python_headers() {
  "$python" -c 'import pathlib, sysconfig; (pathlib.Path(sysconfig.get_path("include")) / "Python.h").stat()' 2>/dev/null
}
has_fuzzer() {
  printf 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }\n' |
    clang++ -fsanitize=fuzzer,address,undefined -x c++ - -o /dev/null 2>/dev/null
}

# Prints the Debian packages that the named group lacks.
missing_packages() {
  case $1 in
    build)
      has_header concepts || echo g++
      has_cmake || echo cmake
      has_command ninja || echo ninja-build
      has_header Eigen/Core || echo libeigen3-dev
      has_header nlohmann/json.hpp || echo nlohmann-json3-dev
      has_python || echo python3-venv
      has_python_headers || echo python3-dev
      ;;
    test)
      has_header catch2/catch_all.hpp || has_header catch2/catch.hpp || echo catch2
      has_header kdl/chain.hpp || echo liborocos-kdl-dev
      ;;
    plant) has_header CLI/CLI.hpp || echo libcli11-dev ;;
    ur-rtde)
      has_header CLI/CLI.hpp || echo libcli11-dev
      has_library boost_system || echo libboost-system-dev
      has_library boost_program_options || echo libboost-program-options-dev
      has_library boost_thread || echo libboost-thread-dev
      ;;
    bench)
      has_header benchmark/benchmark.h || echo libbenchmark-dev
      has_header kdl/chain.hpp || echo liborocos-kdl-dev
      has_command valgrind || echo valgrind
      ;;
    lint)
      has_command clang-tidy || echo clang-tidy
      has_command clang++ || echo clang
      has_fuzzer || echo libclang-rt-dev
      ;;
    mujoco)
      ldconfig -p | grep 'libEGL\.so\.1' >/dev/null || echo libegl1 libgl1-mesa-dri
      has_command xvfb-run || echo xvfb
      has_command xauth || echo xauth
      ;;
    gazebo)
      [ -e /usr/include/ignition/physics5/ignition/physics/sdf/ConstructWorld.hh ] || echo libignition-physics-sdf-dev
      ldconfig -p | grep 'libignition-physics5-dartsim-plugin\.so\.5' >/dev/null || echo libignition-physics5-dartsim-plugin5
      ;;
    browser) has_command chromium || echo chromium ;;
    page)
      has_command em++ || echo emscripten
      [ -d /usr/share/nodejs/acorn ] || echo node-acorn
      ;;
    *)
      echo "system_packages.sh: unknown group '$1'; expected build, test, plant, ur-rtde, bench, lint, mujoco, gazebo, browser or page" >&2
      exit 2
      ;;
  esac
}
all_missing() { for group in "$@"; do missing_packages "$group"; done | sort -u; }

# Called once before, so that a wrong group ends the script: inside $(...) of a test it would not.
missing=$(all_missing "$@")
if [ -n "$missing" ]; then
  if ! has_command apt-get; then
    echo "Not a Debian or Ubuntu system: please install $WANTED." >&2
    exit 1
  fi
  # Targets that run side by side come here together; apt-get serves one, and the others find its work done.
  exec 9<"${BASH_SOURCE[0]}"
  flock 9
  missing=$(all_missing "$@")
fi
if [ -n "$missing" ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  echo "Installing with apt-get:" $missing
  export DEBIAN_FRONTEND=noninteractive
  "${as_root[@]}" apt-get update -qq 9<&- || echo "apt-get update failed; trying with the package lists at hand" >&2
  # shellcheck disable=SC2086  # a list of words
  "${as_root[@]}" apt-get install -y -qq --no-install-recommends $missing >/dev/null 9<&- ||
    echo "apt-get could not install:" $missing >&2
  missing=$(all_missing "$@")
  if [ -n "$missing" ]; then
    echo "Still missing:" $missing "- the project needs $WANTED." >&2
    exit 1
  fi
fi
"$python" - <<'PY'
import sys
if sys.version_info < (3, 10):
    sys.exit(f"Python {sys.version.split()[0]} was found; diabolo needs 3.10 or newer (set PYTHON=...).")
PY
