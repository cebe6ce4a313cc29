# SPDX-License-Identifier: MIT
"""Checks rules that no compiler knows: bands, licence lines, lengths of headers and of Python's functions,
words that stay out.

Prints one line for each fault, as FILE:LINE: what was found, and what was expected; exits with 1 when there
is one.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LONGEST_HEADER = 300  # lines
LONGEST_FUNCTION = 80  # lines of Python, with its docstring
LARGEST_TREE = 7_920_000  # bytes of all files together

# The bands of include/diabolo, from the lowest. A room is a folder, or some headers of the top level, which
# hold the words that a user types. A header includes lower bands, its own room, or a room beside it that does
# not need its own.
NOUNS = ("parameters", "rules", "state", "sticks", "version")
VERBS = ("predictor", "full_predictor", "rollout", "strand_tensions", "model")
BANDS: tuple[tuple[str, ...], ...] = (
    ("math", "text"),  # ground
    ("nouns",),
    ("string",),  # laws
    ("paper", "effects", "recording", "recording/formats", "recording/plausibility"),
    ("verbs", "batch"),
    ("evaluate",),
    ("diagnose", "plan", "learn", "estimate", "robot/arm", "robot/motion", "robot/control"),  # uses
    ("json", "hosts"),
    ("umbrella",),
)
BAND_OF = {room: band for band, rooms in enumerate(BANDS) for room in rooms}
TOP_ROOMS = dict.fromkeys(NOUNS, "nouns") | dict.fromkeys(VERBS, "verbs") | {"diabolo": "umbrella"}

# The foreign headers that a room may include; every other room has Eigen alone.
FOREIGN: dict[str, str] = {"json": r"nlohmann/"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
STANDARD = re.compile(r"^[a-z_0-9]+(\.h)?$")
SPDX = "// SPDX-License-Identifier: MIT"

# Spelt in pieces, so that this file does not find itself.
FORBIDDEN: dict[str, str] = {
    r"(?<![\w.])/(" + "work|root|tm" + r"p)/": "a path of one machine",
    r"\b(" + "TO" + "DO|FIX" + r"ME)\b": "a note left behind: open an issue instead",
}


def room_of(header: str) -> str | None:
    """Room of a header, given relative to include/diabolo; None when the table does not know it."""
    folder, _, name = header.rpartition("/")
    room = folder or TOP_ROOMS.get(name.removesuffix(".hpp"), "")
    return room if room in BAND_OF else None


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
    own, other = room_of(header), room_of(included)
    if own is None or other is None or BAND_OF[other] <= BAND_OF[own]:
        return None  # an unknown room is reported where that header is itself looked at
    return f"in {own} includes {included} of {other}; expected its own band or a lower one"


def check_foreign(header: str, name: str) -> str | None:
    """What is wrong with one of our headers including a foreign one; None when all is well."""
    if name.startswith("unsupported/"):
        return f"includes {name}; expected none of Eigen's unsupported modules"
    if STANDARD.match(name) or name.startswith("Eigen/"):
        return None
    allowed = FOREIGN.get(room_of(header) or "", "")
    if allowed and re.match(allowed, name):
        return None
    return f"includes {name}; expected the standard library, Eigen{' or ' + allowed if allowed else ''}"


def find_cycles(graph: dict[str, list[str]]) -> list[list[str]]:
    """Loops of includes, among headers or among rooms."""
    cycles: list[list[str]] = []
    done: set[str] = set()

    def visit(node: str, path: list[str]) -> None:
        if node in path:
            cycles.append([*path[path.index(node) :], node])
        elif node not in done:
            for included in graph.get(node, []):
                visit(included, [*path, node])
            done.add(node)

    for node in graph:
        visit(node, [])
    return cycles


def room_graph(graph: dict[str, list[str]]) -> dict[str, list[str]]:
    """Which other rooms each room includes."""
    rooms: dict[str, set[str]] = {}
    for header, included in graph.items():
        own = room_of(header) or header
        rooms.setdefault(own, set()).update({room_of(name) or name for name in included} - {own})
    return {room: sorted(others) for room, others in rooms.items()}


def check_bands(include_dir: Path) -> list[str]:
    headers = sorted(str(path.relative_to(include_dir)) for path in include_dir.rglob("*.hpp"))
    known = set(headers)
    graph: dict[str, list[str]] = {header: [] for header in headers}
    faults: list[str] = []
    for header in headers:
        where = f"include/diabolo/{header}"
        if room_of(header) is None:
            faults.append(f"{where}:1: stands in no band; expected a room of BANDS in tools/check_tree.py")
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
    for cycle in find_cycles(room_graph(graph)):
        faults.append(f"include/diabolo/{cycle[0]}:1: rooms need each other: {' > '.join(cycle)}")
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


def check_python_file(name: str, lines: list[str]) -> list[str]:
    functions = (
        (node.lineno, node.name, (node.end_lineno or node.lineno) - node.lineno + 1)
        for node in ast.walk(ast.parse("\n".join(lines)))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    )
    return [
        f"{name}:{number}: {function} has {length} lines; expected at most {LONGEST_FUNCTION}"
        for number, function, length in functions
        if length > LONGEST_FUNCTION
    ]


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
    faults = check_bands(ROOT / "include" / "diabolo")
    names = project_files()
    for name in names:
        try:
            lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            continue  # a picture or another binary file
        if name.endswith((".hpp", ".cpp")):
            faults += check_cpp_file(name, lines)
        if name.endswith(".py"):
            faults += check_python_file(name, lines)
        faults += check_words(name, lines)
    size = sum((ROOT / name).stat().st_size for name in names)
    if size > LARGEST_TREE:
        faults.append(f"tree:1: {size} bytes; expected at most {LARGEST_TREE}")
    summary = f"{len(names)} files: bands, licence lines, lengths and words are in order"
    print("\n".join(faults) or summary)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
