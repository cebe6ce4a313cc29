# SPDX-License-Identifier: MIT
"""Checks rules that no compiler knows: floors, licence lines, lengths of headers, words that stay out.

Prints one line for each fault, as FILE:LINE: what was found, and what was expected; exits with 1 when there
is one.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LONGEST_HEADER = 300  # lines

# What lives on each floor, from the lowest: files, or folders with a closing slash (see CONTRIBUTING.md).
# A file named on its own stands there and not with its folder.
FLOORS: list[list[str]] = [
    ["types.hpp", "version.hpp", "scalar.hpp", "dual.hpp", "pack.hpp", "parallel.hpp"],
    ["spheroid.hpp", "sticks.hpp", "state.hpp", "parameters.hpp"],
    [
        "string_path.hpp",
        "string_step.hpp",
        "keep_energy.hpp",
        "put_back.hpp",
        "snap_taut.hpp",
        "taut_string.hpp",
        "state_machine.hpp",
        "factors.hpp",
        "rotation.hpp",
        "pull_velocity.hpp",
        "hold_between_tips.hpp",
        "settle_on_string.hpp",
        "slide_along_string.hpp",
        "advance_by_pull.hpp",
        "advance_in_flight.hpp",
    ],
    ["effects/"],
    [
        "predictor.hpp",
        "predictor_in.hpp",
        "effects/all.hpp",
        "rollout.hpp",
        "lanes.hpp",
        "batch_kernels.hpp",
        "batch.hpp",
    ],
    ["recording/", "player/", "diagnose/"],
    ["robot/"],
]
UMBRELLA = "diabolo.hpp"
UMBRELLA_FLOOR = 5  # the highest that it includes

# The foreign headers that each folder of interop/ may include; every other folder has Eigen alone.
INTEROP: dict[str, str] = {
    "json": r"nlohmann/",
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
STANDARD = re.compile(r"^[a-z_0-9]+(\.h)?$")
SPDX = "// SPDX-License-Identifier: MIT"

# Spelt in pieces, so that this file does not find itself.
FORBIDDEN: dict[str, str] = {
    r"(?<![\w.])/(" + "work|root|tm" + r"p)/": "a path of one machine",
    r"\b(" + "TO" + "DO|FIX" + r"ME)\b": "a note left behind: open an issue instead",
}


def floor_of(header: str) -> int | None:
    """Floor of a header, given relative to include/diabolo; None when the table does not know it."""
    folder = header.split("/")[0] + "/"
    for place in (header, folder):
        for floor, members in enumerate(FLOORS):
            if place in members:
                return floor
    return None


def includes_of(path: Path) -> list[tuple[int, str, str]]:
    """Line number, kind of bracket and name of each include."""
    found = (
        (number, INCLUDE.match(line)) for number, line in enumerate(path.read_text().splitlines(), start=1)
    )
    return [(number, match[1], match[2]) for number, match in found if match]


def resolve(header: str, name: str, known: set[str]) -> str | None:
    """The project's own header that an include names, relative to include/diabolo; None for a foreign one."""
    for candidate in (name.removeprefix("diabolo/"), str(Path(header).parent / name)):
        if candidate in known:
            return candidate
    return None


def check_include(header: str, included: str) -> str | None:
    """What is wrong with one of our headers including another of ours; None when all is well."""
    if header.startswith("interop/"):
        return None
    if included == UMBRELLA or included.startswith("interop/"):
        return f"includes {included}; expected a header of a floor"
    above = floor_of(included)
    if above is None:
        return None  # reported where that header is itself looked at
    if header == UMBRELLA:
        return f"includes {included} of floor {above}; expected at most 5" if above > UMBRELLA_FLOOR else None
    own = floor_of(header)
    if own is not None and above > own:
        return f"on floor {own} includes {included} of floor {above}; expected its own floor or a lower one"
    return None


def check_foreign(header: str, name: str) -> str | None:
    """What is wrong with one of our headers including a foreign one; None when all is well."""
    if name.startswith("unsupported/"):
        return f"includes {name}; expected none of Eigen's unsupported modules"
    if STANDARD.match(name) or name.startswith("Eigen/"):
        return None
    allowed = INTEROP.get(header.split("/")[1], "") if header.startswith("interop/") else ""
    if allowed and re.match(allowed, name):
        return None
    return f"includes {name}; expected the standard library, Eigen{' or ' + allowed if allowed else ''}"


def find_cycles(graph: dict[str, list[str]]) -> list[list[str]]:
    """Loops of includes; without one, a floor has an order in which each header sees earlier ones only."""
    cycles: list[list[str]] = []
    done: set[str] = set()

    def visit(header: str, path: list[str]) -> None:
        if header in path:
            cycles.append([*path[path.index(header) :], header])
        elif header not in done:
            for included in graph[header]:
                visit(included, [*path, header])
            done.add(header)

    for header in graph:
        visit(header, [])
    return cycles


def check_floors(include_dir: Path) -> list[str]:
    headers = sorted(str(path.relative_to(include_dir)) for path in include_dir.rglob("*.hpp"))
    known = set(headers)
    graph: dict[str, list[str]] = {header: [] for header in headers}
    faults: list[str] = []
    for header in headers:
        where = f"include/diabolo/{header}"
        if header != UMBRELLA and not header.startswith("interop/") and floor_of(header) is None:
            faults.append(f"{where}:1: stands on no floor; expected a place in FLOORS of .ci/check_tree.py")
        for number, _, name in includes_of(include_dir / header):
            included = resolve(header, name, known)
            if included is None:
                fault = check_foreign(header, name)
            else:
                graph[header].append(included)
                fault = check_include(header, included)
            if fault:
                faults.append(f"{where}:{number}: {fault}")
    for cycle in find_cycles(graph):
        faults.append(f"include/diabolo/{cycle[0]}:1: includes itself: {' > '.join(cycle)}")
    return faults


def check_cpp_file(name: str, lines: list[str]) -> list[str]:
    faults = []
    if not lines or lines[0] != SPDX:
        faults.append(f"{name}:1: expected the first line '{SPDX}'")
    if name.endswith(".hpp"):
        if "#pragma once" not in lines[:3]:
            faults.append(f"{name}:2: expected '#pragma once' after the licence line")
        if len(lines) > LONGEST_HEADER:
            faults.append(
                f"{name}:1: {len(lines)} lines; expected at most {LONGEST_HEADER}, one idea to a header"
            )
    return faults


def check_words(name: str, lines: list[str]) -> list[str]:
    return [
        f"{name}:{number}: '{match[0]}' is {why}"
        for number, line in enumerate(lines, start=1)
        for pattern, why in FORBIDDEN.items()
        if (match := re.search(pattern, line))
    ]


def project_files() -> list[str]:
    """Tracked files, and new ones that git does not ignore."""
    command = ["git", "ls-files", "-co", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
    return sorted(name for name in listed if (ROOT / name).is_file())


def main() -> int:
    faults = check_floors(ROOT / "include" / "diabolo")
    names = project_files()
    for name in names:
        try:
            lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            continue  # a picture or another binary file
        if name.endswith((".hpp", ".cpp")):
            faults += check_cpp_file(name, lines)
        faults += check_words(name, lines)
    summary = f"{len(names)} files: floors, licence lines, lengths and words are in order"
    print("\n".join(faults) or summary)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
