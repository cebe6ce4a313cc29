# SPDX-License-Identifier: MIT
"""Our string inside MuJoCo: its engine plugin diabolo.string (docs/hosts.md).

    import mujoco
    from diabolo.hosts import mujoco as host

    host.load_plugin()
    model = mujoco.MjModel.from_xml_string(host.scene())

`python -m diabolo.hosts.mujoco` prints where the plugin's library is: copy it into the folder `mujoco_plugin`
beside MuJoCo's own program `simulate`, which then loads models that use it.
"""

from __future__ import annotations

import functools
import hashlib
import importlib.metadata
import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .. import get_include
from ..checks import file_name
from .mjcf import INERTIA, SENSED, cell, scene

SOURCE = Path(__file__).with_name("string_plugin.cpp")
__all__ = ["INERTIA", "SENSED", "build_plugin", "cell", "load_plugin", "scene"]


@functools.cache
def load_plugin() -> Path:
    """Makes MuJoCo know diabolo.string; the library's path. The first call on a machine compiles it for the
    installed MuJoCo, which takes half a minute, and keeps it in the user's cache.

    Raises:
        RuntimeError: MuJoCo or a C++ compiler is not installed, or the compilation failed.
    """
    library = build_plugin()
    import mujoco

    try:
        mujoco.mj_loadPluginLibrary(str(library))
    except mujoco.FatalError as error:
        raise RuntimeError(
            f"{library} does not load: {error}; remove it, and it is compiled again"
        ) from error
    return library


def build_plugin(source: str | os.PathLike[str] = SOURCE) -> Path:
    """Compiles the plugin, or another of `source`, unless it has been; see `load_plugin`."""
    source = file_name("source", source)
    if not source.is_file():
        raise RuntimeError(f"{source}: there is no such file; expected the source of a plugin")
    spec = importlib.util.find_spec("mujoco")
    if spec is None or spec.origin is None:
        raise RuntimeError("MuJoCo is not installed; expected it from: pip install 'diabolo[mujoco]'")
    command = _command(Path(spec.origin).parent, source)
    kept = _cache() / f"libdiabolo_{source.stem}-{_digest(command, source)}.so"
    if kept.exists():
        return kept
    try:
        kept.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=kept.parent) as folder:
            made = Path(folder) / kept.name
            done = subprocess.run([*command, "-o", str(made)], capture_output=True, text=True)
            if done.returncode != 0 or not made.exists():
                said = done.stderr.strip() or f"exit status {done.returncode}, and no library"
                raise RuntimeError(f"{command[0]} does not compile {source.name}: {said}")
            made.replace(kept)
    except OSError as error:
        raise RuntimeError(
            f"the plugin cannot be compiled into {kept.parent}: {error}; expected a folder to write into, "
            f"as XDG_CACHE_HOME names it, and a compiler, as CXX does"
        ) from error
    return kept


def _command(mujoco: Path, source: Path) -> list[str]:
    named = os.environ.get("CXX") or "c++"
    try:
        compiler = shlex.split(named)
    except ValueError as error:
        raise RuntimeError(f"CXX {named!r}: {error}; expected a compiler and its options") from error
    if not compiler or shutil.which(compiler[0]) is None:
        raise RuntimeError(f"no C++ compiler {named!r}; expected one, as CXX has it (Debian: g++)")
    libraries = sorted(mujoco.glob("libmujoco.*"))
    if not libraries:
        raise RuntimeError(f"{mujoco}: no library of MuJoCo; expected libmujoco.so or .dylib")
    ours = Path(get_include())
    others = (ours / "directories.txt").read_text().split(";")
    found = [option for each in [*others, str(mujoco / "include")] for option in ("-idirafter", each.strip())]
    flags = ["-std=c++20", "-O3", "-DNDEBUG", "-fPIC", "-shared", "-fvisibility=hidden"]
    return [*compiler, *flags, f"-I{ours}", *found, str(source), str(libraries[0])]


def _cache() -> Path:
    named = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (named if named.is_absolute() else Path.home() / ".cache") / "diabolo"


def _digest(command: list[str], source: Path) -> str:
    """Of all that decides what the compiler makes."""
    parts = [*command, importlib.metadata.version("mujoco")]
    digest = hashlib.sha256("\0".join(parts).encode())
    for file in [source, *sorted(Path(get_include()).rglob("*.hpp"))]:
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


if __name__ == "__main__":
    try:
        print(build_plugin())
    except RuntimeError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
