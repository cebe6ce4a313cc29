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
from xml.sax.saxutils import quoteattr

from .. import get_include
from .._core import Model

SOURCE = Path(__file__).with_name("string_plugin.cpp")
SENSED = ("left_tension_N", "right_tension_N", "slip_mps", "spin_radps", "string_state")
"""What a sensor of the plugin says; the state is 0 on the string, 1 loose, 2 in flight."""
INERTIA = (5.6e-4, 6.6e-4, 6.6e-4)
"""Of the paper's red diabolo, about and across the axle [kg m^2]."""


@functools.cache
def load_plugin() -> Path:
    """Makes MuJoCo know diabolo.string; the library's path. The first call on a machine compiles it for the
    installed MuJoCo, which takes half a minute, and keeps it in the user's cache.

    Raises:
        RuntimeError: MuJoCo or a C++ compiler is not installed, or the compilation failed.
    """
    library = build_plugin()
    import mujoco

    mujoco.mj_loadPluginLibrary(str(library))
    return library


def build_plugin() -> Path:
    """Compiles the plugin, unless it has been; see `load_plugin`."""
    spec = importlib.util.find_spec("mujoco")
    if spec is None or spec.origin is None:
        raise RuntimeError("MuJoCo is not installed; expected it from: pip install 'diabolo[mujoco]'")
    command = _command(Path(spec.origin).parent)
    kept = _cache() / f"libdiabolo_string-{_digest(command)}.so"
    if kept.exists():
        return kept
    kept.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=kept.parent) as folder:
        made = Path(folder) / kept.name
        done = subprocess.run([*command, "-o", str(made)], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{SOURCE.name} does not compile: {shlex.join(command)}\n{done.stderr}")
        made.replace(kept)
    return kept


def _command(mujoco: Path) -> list[str]:
    compiler = shlex.split(os.environ.get("CXX", "c++"))
    if not compiler or shutil.which(compiler[0]) is None:
        raise RuntimeError(
            f"no C++ compiler {' '.join(compiler)!r}; expected one, as CXX names it (Debian: g++)"
        )
    libraries = sorted(mujoco.glob("libmujoco.*"))
    if not libraries:
        raise RuntimeError(f"{mujoco}: no library of MuJoCo; expected libmujoco.so or .dylib")
    ours = Path(get_include())
    others = (ours / "directories.txt").read_text().split(";")
    found = [option for each in [*others, str(mujoco / "include")] for option in ("-idirafter", each.strip())]
    flags = ["-std=c++20", "-O2", "-fPIC", "-shared", "-fvisibility=hidden"]
    return [*compiler, *flags, f"-I{ours}", *found, str(SOURCE), str(libraries[0])]


def _cache() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "diabolo"


def _digest(command: list[str]) -> str:
    """Of all that decides what the compiler makes."""
    parts = [*command, importlib.metadata.version("mujoco")]
    digest = hashlib.sha256("\0".join(parts).encode())
    for file in [SOURCE, *sorted(Path(get_include()).rglob("*.hpp"))]:
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def scene(model: Model | None = None, timestep: float = 1e-3) -> str:
    """MJCF of a diabolo on a string between two mocap sticks, `left` and `right`, above a floor.

    Before each step put `data.mocap_pos` where the tips are to be after it [m]. The diabolo is the free body
    `diabolo`, its axle along x; the sensor `string` says SENSED. `model` is as diagnosed or written by you,
    with its own string's length and axle; its gravity is the scene's.

    Raises:
        ValueError: the time step [s] is not above zero.
    """
    if not timestep > 0.0:
        raise ValueError(f"timestep: {timestep}; expected more than 0 s")
    model = Model() if model is None else model
    sticks = "".join(
        f'<body name="{name}" mocap="true"><site name="{name}" size="0.01" zaxis="1 0 0"/>'
        f'<geom type="capsule" fromto="0 0 0 -0.3 {side} 0.05" size="0.008" contype="0" conaffinity="0"'
        ' rgba="0.75 0.6 0.4 1"/></body>'
        for name, side in (("left", 0.1), ("right", -0.1))
    )
    cups = "".join(
        f'<geom type="ellipsoid" size="0.03 0.06 0.06" pos="{x} 0 0" condim="1" rgba="0.8 0.15 0.1 1"/>'
        for x in (-0.035, 0.035)
    )
    parameters = model.parameters
    inertia = " ".join(map(str, INERTIA))
    return f"""<mujoco model="diabolo">
  <option timestep="{timestep}" integrator="implicitfast" gravity="0 0 {-parameters.gravity}"/>
  <extension><plugin plugin="diabolo.string"><instance name="string">
    <config key="left" value="left"/><config key="right" value="right"/>
    <config key="model" value={quoteattr(model.to_json())}/>
  </instance></plugin></extension>
  <visual><global offwidth="960" offheight="720"/></visual>
  <asset><texture name="sky" type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0.8 0.85 0.9" width="64"
    height="64"/></asset>
  <worldbody>
    <light pos="1 0 3" dir="-0.3 0 -1"/>
    <geom type="plane" size="2 2 0.1" condim="1" rgba="0.85 0.85 0.8 1"/>
    {sticks}
    <body name="diabolo"><freejoint/>{cups}<plugin instance="string"/>
      <inertial pos="0 0 0" mass="{parameters.mass}" diaginertia="{inertia}"/>
    </body>
  </worldbody>
  <sensor><plugin name="string" plugin="diabolo.string" instance="string"/></sensor>
</mujoco>"""


if __name__ == "__main__":
    try:
        print(build_plugin())
    except RuntimeError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
