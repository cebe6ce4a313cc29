# SPDX-License-Identifier: MIT
"""A capstan bench in MuJoCo: two weights on a string over a drum, ours beside MuJoCo's own tendon.

Euler and Eytelwein: while a string slips over a drum, the tensions of its two ends are as exp(c b), c the
coefficient of friction and b the angle that it lies around the drum. Here both weights run on rails in line
with their ends of the string. Over a drum that stands, the right one is so heavy that it falls. Over one that
turns, they are equal, and the right one is lifted. Each end's tension is read from the motion of its weight.
The drum is the axle of a diabolo that is held in its place; MuJoCo's tendon wraps round a cylinder.

    pip install '.[mujoco,plot]'
    python examples/mujoco/capstan.py --picture capstan.png
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from diabolo.checks import check_drawing
from diabolo.cli import Parser
from diabolo.cli.arguments import output_name
from diabolo.files import check_outputs, whole_file
from diabolo.hosts.mujoco import load_plugin

try:
    import mujoco
except ModuleNotFoundError as error:
    print(f"capstan.py: {error}; expected it from: pip install 'diabolo[mujoco]'", file=sys.stderr)
    sys.exit(2)

DT, SETTLES, SEEN = 1e-3, 0.2, 0.1  # step, and what is waited for and looked at [s]
WEIGHT, GRAVITY = 0.2, 9.80665  # of the left one [kg], [m/s^2]
HEAVIER = 1.5  # the right one, over a drum that stands, than one that friction still holds
RADIUS, SPIN = 0.0065, 1000.0  # of the drum [m], of one that turns [rad/s]
STRAND, COMPLIANCE, DAMPING = 2.0, 5e-4, 5.0  # each end [m]; of the string [m/N], [N s/m]
COEFFICIENTS = (0.1, 0.2)
ANGLES = np.radians([30, 60, 90, 120, 150, 390, 420, 450, 480, 510])  # a full turn more from the sixth on


def tendon() -> tuple[str, str, str]:
    """MuJoCo's: over a cylinder on a hinge. It knows no friction, and no whole turns."""
    spring = f'springlength="0 {2.0 * STRAND}" stiffness="{1.0 / COMPLIANCE}" damping="{DAMPING}"'
    path = '<site site="left"/><geom geom="drum" sidesite="top"/><site site="right"/>'
    string = f"<tendon><spatial {spring}>{path}</spatial></tendon>"
    return string, '<joint name="drum" axis="1 0 0"/>', f'<site name="top" pos="0 0 {2.0 * RADIUS}"/>'


def ours(coefficient: float, turns: int) -> tuple[str, str, str]:
    """The plugin's, on a free body that is held where it is and may turn."""
    keys = {
        "left": "left",
        "right": "right",
        "string_length": 2.0 * STRAND,
        "axle_radius": RADIUS,
        "wraps": turns,
        "string_friction.coefficient": coefficient,
        "string_elasticity.compliance": COMPLIANCE,
        "string_elasticity.damping": DAMPING,
    }
    config = "".join(f'<config key="{key}" value="{value}"/>' for key, value in keys.items())
    plugin = f'<plugin plugin="diabolo.string"><instance name="string">{config}</instance></plugin>'
    string = f'<extension>{plugin}</extension><equality><connect body1="drum" anchor="0 0 0"/></equality>'
    return string, '<freejoint name="drum"/><plugin instance="string"/>', ""


def bench(parts: tuple[str, str, str], angle: float, heavier: float) -> mujoco.MjModel:
    """Two weights, of which the right one is so many times as heavy, on rails below a drum."""
    string, drum, beside = parts
    half = 0.5 * (angle % (2.0 * np.pi))
    across, down = np.cos(half), np.sin(half)
    rails = ""
    for name, y, mass in (("left", across, WEIGHT), ("right", -across, WEIGHT * heavier)):
        rails += (
            f'<body name="{name}" pos="0 {y * STRAND} {-down * STRAND}"><site name="{name}"/>'
            f'<joint name="{name}" type="slide" axis="0 {y} {-down}"/>'
            f'<inertial pos="0 0 0" mass="{mass}" diaginertia="1e-3 1e-3 1e-3"/></body>'
        )
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{DT}" gravity="0 0 0"/>{string}<worldbody>{rails}{beside}'
        f'<body name="drum">{drum}<inertial pos="0 0 0" mass="10" diaginertia="1e3 1e3 1e3"/>'
        f'<geom name="drum" type="cylinder" size="{RADIUS} 0.05" zaxis="1 0 0" contype="0" conaffinity="0"/>'
        "</body></worldbody></mujoco>"
    )


def ratio(model: mujoco.MjModel, spin: float) -> float:
    """The right end's tension over the left one's, from how the weights move, each drawn along its rail."""
    data = mujoco.MjData(model)
    drum = model.joint("drum")
    is_free = drum.type[0] == mujoco.mjtJoint.mjJNT_FREE
    data.qvel[drum.dofadr[0] + (3 if is_free else 0)] = spin
    weights = [model.joint(name).dofadr[0] for name in ("left", "right")]
    masses = np.array([model.body(name).mass[0] for name in ("left", "right")])
    data.qfrc_applied[weights] = masses * GRAVITY
    mujoco.mj_step(model, data, round(SETTLES / DT))
    before = data.qvel[weights].copy()
    mujoco.mj_step(model, data, round(SEEN / DT))
    left, right = masses * (GRAVITY - (data.qvel[weights] - before) / SEEN)
    return float(right / left)


def measured() -> list[dict[str, float]]:
    """Of each coefficient and angle exp(c b), and the ratios over both drums, ours and the tendon's."""
    rows = []
    for coefficient in COEFFICIENTS:
        for angle in ANGLES:
            turns, law = int(angle // (2.0 * np.pi)), float(np.exp(coefficient * angle))
            row = {"c": coefficient, "b": float(angle), "law": law}
            strings = {"ours": ours(coefficient, turns)} | ({} if turns else {"tendon": tendon()})
            for name, parts in strings.items():
                row[f"{name}, fixed"] = ratio(bench(parts, angle, HEAVIER * law), 0.0)
                row[f"{name}, turning"] = ratio(bench(parts, angle, 1.0), SPIN)
            rows.append(row)
    return rows


def draw(rows: list[dict[str, float]], picture: Path) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    figure = Figure(figsize=(7.2, 3.8), layout="constrained")
    axes = figure.subplots()
    through = np.linspace(0.0, 520.0, 200)
    for coefficient, colour in zip(COEFFICIENTS, ("tab:blue", "tab:red"), strict=True):
        own = [row for row in rows if row["c"] == coefficient]
        angles = np.degrees([row["b"] for row in own])
        axes.plot(
            through, np.exp(coefficient * np.radians(through)), colour, lw=1, label=f"exp({coefficient} b)"
        )
        for drum, marker in (("fixed", "o"), ("turning", "x")):
            ours_there = [row[f"ours, {drum}"] for row in own]
            axes.plot(angles, ours_there, marker, color=colour, mfc="none", label=f"ours, {drum} drum")
    there = [row for row in own if "tendon, fixed" in row]
    angles, tendons = zip(*((np.degrees(row["b"]), row["tendon, fixed"]) for row in there), strict=True)
    axes.plot(angles, tendons, "s", color="0.5", ms=4, label="MuJoCo's tendon")
    axes.set(xlabel="angle b around the drum [degrees]", ylabel="ratio of the tensions", ylim=(0, None))
    axes.legend(frameon=False, fontsize=8)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    with whole_file(picture) as temporary:
        image.quantize(32, dither=Image.Dither.NONE).save(temporary, "PNG", optimize=True)


def main() -> int:
    parser = Parser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("--picture", type=output_name, help="draw it")
    name = parser.parse_args().picture
    picture = Path(name) if name else None
    try:
        if picture:
            check_drawing(picture, "matplotlib")
            check_outputs([picture], [])
        load_plugin()
        rows = measured()
        if picture:
            draw(rows, picture)
    except (RuntimeError, ValueError) as error:
        print(f"capstan.py: {error}", file=sys.stderr)
        return 2
    names = ["ours, fixed", "ours, turning", "tendon, fixed", "tendon, turning"]
    print("| c | b [degrees] | exp(c b) | " + " | ".join(names) + " |\n|" + "---|" * (3 + len(names)))
    for row in rows:
        ratios = " | ".join(f"{row[name]:.4f}" if name in row else "" for name in ("law", *names))
        print(f"| {row['c']} | {np.degrees(row['b']):.0f} | {ratios} |")
    off = [abs(row[name] / row["law"] - 1.0) for row in rows for name in names[:2]]
    print(f"ours is off exp(c b) by {max(off):.1e} of it at most")
    return 0


if __name__ == "__main__":
    sys.exit(main())
