# SPDX-License-Identifier: MIT
# Every target installs what it needs; a second run finds it there. `make help` lists them.

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

BUILD ?= build
VENV ?= .venv
PYTHON ?= python3
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
FUZZ_SECONDS ?= 60
DIABOLO_WARNINGS_AS_ERRORS ?= OFF# of the Python extension; elsewhere they always are
export PIP_DISABLE_PIP_VERSION_CHECK := 1

packages := PYTHON=$(PYTHON) tools/system_packages.sh
pip := $(VENV)/bin/python -m pip install --quiet --quiet# errors alone: warnings are of pip's own set-up
cmake := cmake -G Ninja
ifneq ($(shell command -v ccache),)
cmake += -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
ccache := --config-settings=cmake.define.CMAKE_CXX_COMPILER_LAUNCHER=ccache
export CCACHE_SLOPPINESS ?= pch_defines,time_macros# else nothing with a precompiled header is found again
export CCACHE_BASEDIR ?= $(CURDIR)# so that a checkout in another folder finds what this one compiled
endif
# Optimised a little, so that tests run fast, and with assertions; other groups of targets in trees of their own.
test_flags := -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DDIABOLO_BUILD_BENCHMARKS=OFF \
  -DDIABOLO_BUILD_PYTHON=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 -DCMAKE_UNITY_BUILD_RELOCATABLE=ON
ctest := ctest --output-on-failure --no-tests=error -j $(JOBS)

package_sources := pyproject.toml CMakeLists.txt LICENSE examples/mujoco/plugin/string_plugin.cpp $(wildcard README.md) \
  $(shell find cmake include batch diagnose python -type f -not -name '*.pyc')
our_sources = git ls-files -co --exclude-standard '*.hpp' '*.cpp'

.PHONY: help demo install test test-core test-cpp test-long test-plant test-python test-all ur-rtde prove prove-player mujoco gazebo hosts ros2 rerun page browser agents \
  sanitize fuzz stress bench build-benchmarks check-benchmarks format check-format lint check-tree check-prose stubs check-stubs clean

help: ## List the targets
	@sed -nE 's/^([a-z-]+):[^#]*## (.*)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 26

# ---- set-up ----

$(VENV)/.created: tools/build-requirements.txt
	@$(packages) build
	@$(PYTHON) -m venv $(VENV)
	@$(pip) -r tools/build-requirements.txt
	@touch $@

# Without build isolation, so that a second build compiles only what changed.
install_package = $(pip) --no-build-isolation --config-settings=build-dir=$(BUILD)/python \
  --config-settings=cmake.define.DIABOLO_WARNINGS_AS_ERRORS=$(DIABOLO_WARNINGS_AS_ERRORS) $(ccache)
compiling := (compiles for some minutes, once; another run takes seconds)

$(VENV)/.package: $(VENV)/.created $(package_sources)
	@echo "Installing the Python package into $(VENV) $(compiling)"
	@$(install_package) '.[plot]'
	@touch $@

# What extras name, beside the package as it is installed: it is not built again.
$(VENV)/.package-with-tests: $(VENV)/.package
	@$(pip) 'diabolo[envs,formats,test]'
	@touch $@

$(VENV)/.tools: $(VENV)/.created tools/tool-requirements.txt
	@$(pip) -r tools/tool-requirements.txt
	@touch $@

# ---- what a person runs ----

demo: $(VENV)/.package ## Diagnose recordings whose physics is concealed: what was found, a report and a replay
	@$(VENV)/bin/python -m diabolo demo --out $(BUILD)/demo

PREFIX ?= /usr/local
install: ## Install the C++ headers under PREFIX, for find_package(diabolo); nothing is compiled
	@$(packages) build
	@$(cmake) -S . -B $(BUILD)/headers -DDIABOLO_BUILD_TESTS=OFF -DDIABOLO_BUILD_BATCH=OFF -DDIABOLO_BUILD_DIAGNOSE=OFF \
	  -DDIABOLO_BUILD_PYTHON=OFF -DDIABOLO_BUILD_BENCHMARKS=OFF -DDIABOLO_BUILD_EXAMPLES=OFF >/dev/null
	@cmake --install $(BUILD)/headers --prefix "$(PREFIX)" --component cpp >/dev/null
	@echo "Installed under $(PREFIX)"

test: test-cpp test-plant test-python ## Run the C++ tests, the plant's and the Python tests

test-cpp:
	@$(packages) build test
	@$(cmake) -S . -B $(BUILD)/test $(test_flags) >/dev/null
	@cmake --build $(BUILD)/test -j $(JOBS) -- -k 0
	@$(ctest) --test-dir $(BUILD)/test -LE long

test-long: # Every header compiles alone, and every law keeps in every Scalar.
	@$(packages) build test lint
	@tools/check_headers.sh $(JOBS)
	@$(cmake) -S . -B $(BUILD)/test $(test_flags) >/dev/null
	@cmake --build $(BUILD)/test -j $(JOBS) --target tests_long -- -k 0
	@$(ctest) --test-dir $(BUILD)/test -L long

test-core: # The predictor alone: the quick part of test-cpp.
	@$(packages) build test
	@$(cmake) -S . -B $(BUILD)/test $(test_flags) >/dev/null
	@cmake --build $(BUILD)/test -j $(JOBS) --target test_core test_laws -- -k 0
	@$(ctest) --test-dir $(BUILD)/test -L 'core|laws'

test-plant: # The simulator behind the demonstration recordings is a CMake project of its own.
	@$(packages) build test plant
	@$(cmake) -S data/plant -B $(BUILD)/plant -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON >/dev/null
	@cmake --build $(BUILD)/plant -j $(JOBS)
	@$(ctest) --test-dir $(BUILD)/plant

# The C++ library of ur_rtde's published source, in a prefix of its own: no Python bindings, no examples.
ur_rtde := $(BUILD)/ur_rtde
$(ur_rtde)/source/.fetched: tools/ur-rtde-requirements.txt $(VENV)/.created
	@rm -rf $(@D)
	@$(VENV)/bin/python -m pip download --quiet --no-deps --no-binary ur_rtde -d $(@D) -r $<
	@tar xzf $(@D)/*.tar.gz -C $(@D) --strip-components=1
	@touch $@

$(ur_rtde)/.installed: $(ur_rtde)/source/.fetched tools/ur_rtde.cmake
	@$(packages) build ur-rtde
	@$(cmake) -S $(<D) -B $(ur_rtde)/build -DCMAKE_BUILD_TYPE=Release -DPYTHON_BINDINGS=OFF -DEXAMPLES=OFF \
	  -DCMAKE_PROJECT_ur_rtde_INCLUDE=$(abspath tools/ur_rtde.cmake) \
	  -DCMAKE_INSTALL_PREFIX=$(abspath $(ur_rtde)/prefix) >/dev/null 2>&1
	@cmake --build $(ur_rtde)/build -j $(JOBS) -- --quiet
	@cmake --install $(ur_rtde)/build >/dev/null
	@touch $@

ur5e = $(cmake) -S examples/ur5e_rtde -B $(BUILD)/ur5e/build -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 \
  -DCMAKE_PREFIX_PATH='$(abspath $(BUILD)/ur5e/prefix);$(abspath $(ur_rtde)/prefix)'
ur-rtde: ## Run the program for two UR5e on stand-in controllers, through ur_rtde's client where that can be fetched.
	@$(packages) build test ur-rtde
	@if $(MAKE) --no-print-directory $(ur_rtde)/source/.fetched; then \
	  $(MAKE) --no-print-directory $(ur_rtde)/.installed; \
	else \
	  echo "ur_rtde could not be fetched: its client is left out, the stand-in controller alone is tested"; \
	fi
	@$(MAKE) --no-print-directory install PREFIX=$(BUILD)/ur5e/prefix
	@# Without ur_rtde first, as one has it who has not built it: what is left builds and passes, and says what is left out.
	@$(ur5e) -DCMAKE_DISABLE_FIND_PACKAGE_ur_rtde=ON | grep "ur_rtde was not found"
	@cmake --build $(BUILD)/ur5e/build -j $(JOBS) -- --quiet
	@ctest --test-dir $(BUILD)/ur5e/build --output-on-failure --no-tests=error
	@$(ur5e) -DCMAKE_DISABLE_FIND_PACKAGE_ur_rtde=OFF >/dev/null
	@cmake --build $(BUILD)/ur5e/build -j $(JOBS) -- -k 0
	@ctest --test-dir $(BUILD)/ur5e/build --output-on-failure --no-tests=error --label-exclude plays
	@# Those that play keep time, which a machine that others share may take from them: each may be tried once more.
	@ctest --test-dir $(BUILD)/ur5e/build --output-on-failure --label-regex plays --repeat until-pass:2

.PHONY: plant
plant: ## Build the independent plant, on which the proofs play
	@$(packages) build test plant
	@$(cmake) -S data/plant -B $(BUILD)/plant -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON >/dev/null
	@cmake --build $(BUILD)/plant -j $(JOBS) --target diabolo-plant

prove: $(VENV)/.package plant ## Put the diagnosis to the proof on a few recordings whose truth it cannot see
	@$(VENV)/bin/python -m benchmarks.proof.diagnosis quick --cases 16 --jobs $(JOBS) --plant $(BUILD)/plant/diabolo-plant
	@$(VENV)/bin/python -m benchmarks.proof.axle --cases 4 --jobs $(JOBS) --plant $(BUILD)/plant/diabolo-plant

prove-player: $(VENV)/.package plant ## Play a few plans on the independent plant, and see that they do what is wanted
	@$(VENV)/bin/python -m benchmarks.proof.player small --plant $(BUILD)/plant/diabolo-plant
	@$(VENV)/bin/python -m benchmarks.proof.player.level back --count 4 --wanted 1 --plant $(BUILD)/plant/diabolo-plant
	@$(VENV)/bin/python -m benchmarks.proof.player.level catch --count 1 --wanted 1 --plant $(BUILD)/plant/diabolo-plant
	@$(VENV)/bin/python -m benchmarks.proof.player.level back --count 2 --by diagnosis --wanted 1 --plant $(BUILD)/plant/diabolo-plant

test-python: $(VENV)/.package-with-tests
	@$(VENV)/bin/python -m pytest -n $(JOBS) --dist worksteal

test-all: test test-long mujoco gazebo hosts ros2 rerun browser agents ur-rtde prove prove-player sanitize fuzz stress ## Run the tests and the heavy groups: other simulators, a browser, the robots, proofs, sanitizers, fuzzing

hosts: $(VENV)/.package-with-tests ## Put the string into DART and Drake
	@$(pip) 'diabolo[dart,drake]'
	@$(VENV)/bin/python -m pytest -m hosts tests/heavy

rerun: $(VENV)/.package-with-tests ## Write files of rerun, and read them again
	@$(pip) 'diabolo[rerun]'
	@$(VENV)/bin/python -m pytest -m rerun tests/heavy

ros2: $(VENV)/.package-with-tests ## Play in ROS 2: two processes over DDS
	@$(pip) -r tools/ros2-requirements.txt
	@$(VENV)/bin/python -m pytest -m ros2 tests/heavy

# Debian's emscripten looks for its parser of scripts where Debian's Node.js does; others need to be told.
page: ## Make one page to play with, without a network: our string and the published rules (build/page)
	@$(packages) build page
	@mkdir -p $(BUILD)/page/include && ln -sfn /usr/include/nlohmann $(BUILD)/page/include/nlohmann
	@NODE_PATH=/usr/share/nodejs em++ -std=c++20 -O2 -DNDEBUG -include examples/web/old_library.hpp -Iinclude \
	  -isystem /usr/include/eigen3 -isystem $(BUILD)/page/include examples/web/page.cpp -sSINGLE_FILE=1 \
	  -sALLOW_MEMORY_GROWTH=1 -sDISABLE_EXCEPTION_CATCHING=0 -o $(BUILD)/page/diabolo.js \
	  $(foreach agent,SpinUp ThrowAndCatch,--embed-file python/diabolo/agents/$(agent).json@$(agent).json)
	@perl -0pe 'BEGIN { ($$pointer, $$s) = map { local $$/; open F, "<", $$_; <F> } splice @ARGV, 0, 2; } \
	  s/\{\{\{ POINTER \}\}\}\n/$$pointer/; s/\{\{\{ SCRIPT \}\}\}/<script>$$s<\/script>/' \
	  python/diabolo/templates/pointer.js $(BUILD)/page/diabolo.js examples/web/page.html > $(BUILD)/page/diabolo.html
	@echo $(BUILD)/page/diabolo.html

browser: $(VENV)/.package-with-tests page ## Look at the report, the view and the page to play with as a person sees them
	@$(packages) browser
	@$(VENV)/bin/python -m pytest -m browser tests/heavy

mujoco: $(VENV)/.package-with-tests ## Put the string into MuJoCo, and compare with its own tendon
	@$(packages) mujoco
	@$(pip) 'diabolo[mujoco]'
	@$(VENV)/bin/python -m pytest -m mujoco tests/heavy

gazebo: $(VENV)/.package-with-tests ## Put the string into Gazebo's engine, and compile its plugin for gz-sim 8
	@$(packages) build plant gazebo
	@$(MAKE) --no-print-directory install PREFIX=$(BUILD)/gazebo/prefix
	@$(cmake) -S examples/gazebo -B $(BUILD)/gazebo -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 \
	  -DCMAKE_PREFIX_PATH='$(abspath $(BUILD)/gazebo/prefix)' -DCMAKE_COMPILE_WARNING_AS_ERROR=ON >/dev/null
	@cmake --build $(BUILD)/gazebo -j $(JOBS) -- --quiet
	@$(VENV)/bin/python -m pytest -m gazebo tests/heavy

agents: $(VENV)/.package-with-tests ## Train a small agent from scratch, and see that it learns
	@$(pip) -r tools/learn-requirements.txt
	@$(VENV)/bin/python -m pytest -m learn tests/heavy

sanitize: # The step, in every Scalar, on random input; fuzz does it for the readers.
	@$(packages) build test lint
	@$(cmake) -S . -B $(BUILD)/sanitize $(test_flags) -DCMAKE_CXX_COMPILER=clang++ -DDIABOLO_TEST_HEAVY=ON \
	  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -gline-tables-only' -DDIABOLO_SANITIZE=address,undefined >/dev/null
	@cmake --build $(BUILD)/sanitize -j $(JOBS) --target tests_stress
	@$(BUILD)/sanitize/tests/stress_random_steps 1000000 1

fuzz: # Each target for FUZZ_SECONDS, as many at once as there are processors.
	@$(packages) build lint
	@$(cmake) -S . -B $(BUILD)/fuzz -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_CXX_COMPILER=clang++ \
	  -DDIABOLO_SANITIZE=address,undefined -DDIABOLO_BUILD_TESTS=OFF -DDIABOLO_BUILD_BENCHMARKS=OFF \
	  -DDIABOLO_BUILD_EXAMPLES=OFF -DDIABOLO_BUILD_PYTHON=OFF -DDIABOLO_BUILD_DIAGNOSE=OFF \
	  -DDIABOLO_BUILD_FUZZERS=ON >/dev/null
	@cmake --build $(BUILD)/fuzz -j $(JOBS)
	@BUILD=$(BUILD) tools/fuzz.sh $(FUZZ_SECONDS) $(JOBS)

stress: # Long random runs: with assertions, but optimised in full.
	@$(packages) build test
	@$(cmake) -S . -B $(BUILD)/heavy $(test_flags) -DCMAKE_CXX_FLAGS_DEBUG=-O2 -DDIABOLO_TEST_HEAVY=ON >/dev/null
	@cmake --build $(BUILD)/heavy -j $(JOBS) --target tests_stress -- -k 0
	@$(ctest) --test-dir $(BUILD)/heavy -L stress

# With MuJoCo where `make mujoco` has installed it, with instruction counts where valgrind is found.
run_benchmarks = $(VENV)/bin/python -m benchmarks.speed.run_all $(BUILD)/bench/benchmarks/speed

bench: build-benchmarks $(VENV)/.package ## Run every benchmark and write docs/benchmarks.md
	@$(packages) mujoco
	@$(pip) 'diabolo[mujoco]'
	@$(run_benchmarks) docs/benchmarks.md --json $(BUILD)/bench/benchmarks.json

check-benchmarks: build-benchmarks $(VENV)/.created # Every benchmark runs; its figures are not looked at.
	@$(run_benchmarks) $(BUILD)/bench/check/benchmarks.md --brief

build-benchmarks:
	@$(packages) build bench
	@$(cmake) -S . -B $(BUILD)/bench -DCMAKE_BUILD_TYPE=Release -DDIABOLO_BUILD_TESTS=OFF \
	  -DDIABOLO_BUILD_EXAMPLES=OFF -DDIABOLO_BUILD_PYTHON=OFF >/dev/null
	@cmake --build $(BUILD)/bench -j $(JOBS) --target benchmarks

# ---- the state of the sources ----

format: $(VENV)/.tools ## Format C++ and Python in place
	@$(our_sources) | xargs -r $(VENV)/bin/clang-format -i
	@$(VENV)/bin/ruff format --quiet
	@$(VENV)/bin/ruff check --quiet --select I --fix

check-format: $(VENV)/.tools
	@$(our_sources) | xargs -r $(VENV)/bin/clang-format --dry-run --Werror
	@$(VENV)/bin/ruff format --check

lint: check-tree $(VENV)/.package-with-tests $(VENV)/.tools ## Check bands and file rules, clang-tidy on every header, ruff and mypy
	@$(packages) build test lint
	@$(VENV)/bin/ruff check
	@$(VENV)/bin/mypy --python-executable $(VENV)/bin/python
	@$(cmake) -S . -B $(BUILD)/lint $(test_flags) -DCMAKE_CXX_COMPILER=clang++ \
	  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
	@clang-tidy --quiet -p $(BUILD)/lint $(BUILD)/lint/tests/headers/all_headers.cpp

check-tree:
	@$(packages) build
	@$(PYTHON) tools/check_tree.py

check-prose: # Sentences of the pages are short.
	@$(packages) build
	@git ls-files -co --exclude-standard '*.md' | grep -vx CHANGELOG.md | xargs $(PYTHON) tools/count_sentences.py

# Less the methods that every object has, what fits on one line on one line, long types by a name, and indented by two.
tidy_stubs = s/^ *def __(copy|deepcopy|getstate|setstate|repr)__\(.*\n.*\n//mg; \
  s/(:\n\s+""")\n\s+([^\n"\\]*)\n\s+"""/$$1$$2"""/g; s/:\n\s+\.\.\.\n/: ...\n/g; \
  s/typing\.SupportsFloat \| typing\.SupportsIndex/_Real/g; s/typing\.SupportsInt \| typing\.SupportsIndex/_Whole/g; \
  s/typing\.Annotated\[numpy\.typing\.ArrayLike, numpy\.float64\]/_Reals/g; \
  s/numpy\.typing\.NDArray\[numpy\.float64\]/_Array/g; \
  s/^( +)/" " x (length($$1) \/ 2)/gme; \
  s/\z/_Real: typing.TypeAlias = typing.SupportsFloat | typing.SupportsIndex\n/; \
  s/\z/_Whole: typing.TypeAlias = typing.SupportsInt | typing.SupportsIndex\n/; \
  s/\z/_Reals: typing.TypeAlias = numpy.typing.ArrayLike\n/; s/\z/_Array: typing.TypeAlias = numpy.typing.NDArray[numpy.float64]\n/
generate_stubs = rm -rf $(BUILD)/stubs; $(VENV)/bin/pybind11-stubgen --exit-code -o $(BUILD)/stubs diabolo._core; \
  find $(BUILD)/stubs -name '*.pyi' -exec perl -0pi -e '$(tidy_stubs)' {} +
stubs: $(VENV)/.package-with-tests $(VENV)/.tools ## Write the type stubs of the compiled module anew
	@$(generate_stubs)
	@rm -rf python/diabolo/_core python/diabolo/_core.pyi
	@cp -r $(BUILD)/stubs/diabolo/_core* python/diabolo/

check-stubs: $(VENV)/.package-with-tests $(VENV)/.tools
	@$(generate_stubs)
	@for stub in $(BUILD)/stubs/diabolo/_core*; do \
	  diff -r -u "python/diabolo/$${stub##*/}" "$$stub" || { echo "Stale stubs: run 'make stubs'."; exit 1; }; \
	done

clean: ## Remove everything that was built, and the virtual environment
	@rm -rf $(BUILD) $(VENV)
