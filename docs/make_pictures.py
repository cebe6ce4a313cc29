# SPDX-License-Identifier: MIT
"""Draws the pictures of the README into docs/images.

    python docs/make_pictures.py --recordings FOLDER     # all; FOLDER holds the authors' recordings
    python docs/make_pictures.py                         # those that need none

Needs the package with its `plot` extra, and Pillow, which matplotlib brings. The page to play with is drawn
where `make page` has made it and chromium is installed.
"""

from __future__ import annotations

import argparse
import io
import shutil
import subprocess
import tempfile
import warnings
from pathlib import Path
from typing import Any

import diabolo
import matplotlib
import numpy as np
from diabolo.cli.demo import concealed_in, packaged_recordings
from diabolo.view import predict_anew
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

IMAGES = Path(__file__).with_name("images")
PAGE = Path(__file__).parents[1] / "build" / "page" / "diabolo.html"
SHOWN = "2020-07-11_basic_physics/right_hand_extend_1.csv"  # in the moving picture; no fit sees it
BEGIN, SECONDS, BETWEEN_FRAMES = 1.0, 3.0, 0.12  # real time: GIF counts in hundredths of a second
ANEW = 1.0  # between the starts of its predictions [s]
TRAIL = 0.6  # [s]
INK, SOFT, LEFT, RIGHT = "#111827", "#9ca3af", "#c2410c", "#1d4ed8"
BEFORE, AFTER = "#e11d48", "#059669"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--recordings", type=Path, help="folder of the authors' recordings")
    folder = parser.parse_args().recordings
    matplotlib.rcParams.update(
        {"font.size": 11, "axes.spines.top": False, "axes.spines.right": False, "savefig.facecolor": "white"}
    )
    IMAGES.mkdir(exist_ok=True)
    draw_prediction(IMAGES / "predict.png")
    draw_diagnosis(IMAGES / "diagnose.png")
    draw_plan(IMAGES / "play.png")
    if PAGE.is_file() and shutil.which("chromium"):
        draw_page(IMAGES / "page.png")
    if folder is not None:
        draw_take(IMAGES / "take.gif", folder)


# ---- the moving picture: a real take, two simulators ----


def draw_take(path: Path, folder: Path) -> None:
    """The published simulator and the diagnosed one beside a recording that neither was fitted to."""
    shown = folder / SHOWN
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", diabolo.RecordingWarning)
        take = diabolo.load_recording(shown)
        others = [
            diabolo.load_recording(file) for file in sorted(shown.parent.glob("*.csv")) if file != shown
        ]
        diagnosed = diabolo.diagnose(others).model
        models = {"published simulator": diabolo.Model.named("published"), "diagnosed simulator": diagnosed}
        positions = {name: predict_anew(take, model, ANEW)[:, :3] for name, model in models.items()}
    frames = [
        image_of(take_figure(take, positions, BEGIN + frame * BETWEEN_FRAMES))
        for frame in range(round(SECONDS / BETWEEN_FRAMES))
    ]
    palette = palette_of(frames[len(frames) // 2])
    first, *rest = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    first.save(
        path,
        save_all=True,
        append_images=rest,
        duration=round(1000 * BETWEEN_FRAMES),
        loop=0,
        optimize=True,
    )
    if shutil.which("gifsicle"):  # the same frames in a fifth less
        subprocess.run(["gifsicle", "-O3", "--batch", str(path)], check=True)


def palette_of(frame: Image.Image) -> Image.Image:
    """Colours of a frame, small spots of our own among them."""
    sample = frame.copy()
    for place, color in enumerate(("white", INK, LEFT, RIGHT, BEFORE, AFTER)):
        sample.paste(color, (60 * place, 0, 60 * place + 60, 60))
    return sample.quantize(16, dither=Image.Dither.NONE)


def take_figure(take: diabolo.Recording, positions: dict[str, NDArray[np.float64]], now: float) -> Figure:
    """Two scenes, seen from behind the player, over the errors so far."""
    figure = Figure(figsize=(7.2, 4.2))
    grid = figure.add_gridspec(
        2, 2, height_ratios=[3.2, 1], left=0.095, right=0.985, top=0.92, bottom=0.12, hspace=0.12
    )
    time = take.time - take.time[0]
    for column, (name, color) in enumerate(zip(positions, (BEFORE, AFTER), strict=True)):
        scene = figure.add_subplot(grid[0, column])
        draw_scene(scene, take, positions[name], round(now * take.rate), color)
        scene.set_title(name, color=color, fontsize=12, fontweight="bold")
    panel = figure.add_subplot(grid[1, :])
    for name, color in zip(positions, (BEFORE, AFTER), strict=True):
        error = 1e3 * np.linalg.norm(positions[name] - take.diabolo, axis=1)
        seen = (time >= BEGIN) & (time <= now)
        panel.plot(time[seen], error[seen], color=color, lw=1.8)
    panel.set(
        xlim=(BEGIN, BEGIN + SECONDS),
        ylim=(0, 200),
        yticks=[0, 100, 200],
        xlabel="time [s]",
        ylabel="off [mm]",
    )
    panel.grid(alpha=0.25)
    return figure


def draw_scene(
    axes: Axes, take: diabolo.Recording, predicted: NDArray[np.float64], row: int, color: str
) -> None:
    tail = slice(max(0, row - round(TRAIL * take.rate)), row + 1)
    left, right, recorded = take.left[row], take.right[row], take.diabolo[row]
    for end, shade in ((recorded, INK), (predicted[row], color)):
        axes.plot([left[1], end[1], right[1]], [left[2], end[2], right[2]], color=shade, lw=1.2, alpha=0.7)
    trail = predicted[tail].copy()
    trail[1:][np.linalg.norm(np.diff(trail, axis=0), axis=1) > 0.06] = np.nan  # where it begins anew
    axes.plot(take.diabolo[tail, 1], take.diabolo[tail, 2], color=INK, lw=1.5, alpha=0.6)
    axes.plot(trail[:, 1], trail[:, 2], color=color, lw=1.5)
    radius = 0.5 * take.properties.diameter
    for center, shade, fill in ((recorded, INK, "#11182755"), (predicted[row], color, color + "66")):
        axes.add_patch(matplotlib.patches.Circle((center[1], center[2]), radius, ec=shade, fc=fill, lw=2.0))
    for tip, shade in ((left, LEFT), (right, RIGHT)):
        axes.plot(tip[1], tip[2], "o", color=shade, ms=6)
    axes.set(xlim=(0.62, -0.78), ylim=(0.45, 1.42), aspect="equal", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    off = 1e3 * np.linalg.norm(predicted[row] - recorded)
    axes.text(0.3, 0.47, f"{off:.0f} mm off", color=color, fontsize=13)
    axes.text(-0.28, 0.47, "black: recorded", color=INK, fontsize=9)


def image_of(figure: Figure, dpi: int = 80) -> Image.Image:
    with io.BytesIO() as data:
        figure.savefig(data, format="png", dpi=dpi)
        data.seek(0)
        return Image.open(data).convert("RGB")


# ---- the cards ----


def draw_prediction(path: Path) -> None:
    """A drop onto the string and what follows, by the base model."""
    seconds = 3.0
    tips = diabolo.TipMotion([0.0, seconds], [[0, 0.3, 1.0]] * 2, [[0, -0.3, 1.0]] * 2)
    result = diabolo.rollout(diabolo.Parameters(), [0, 0.1, 0.7, 0, 0, 0, 100], tips, dt=1e-3, record_every=5)
    figure, (side, height) = panels()
    states, time = result.states, 5e-3 * np.arange(1, len(result.states) + 1)
    side.plot([0.3, states[-1, 1], -0.3], [1.0, states[-1, 2], 1.0], color=SOFT, lw=1.2)
    side.plot(states[:, 1], states[:, 2], color=INK, lw=1.6)
    for y, color in ((0.3, LEFT), (-0.3, RIGHT)):
        side.plot(y, 1.0, "o", color=color, ms=7)
    side.set(title="from behind the player", xlabel="y [m]", ylabel="z [m]", aspect="equal")
    side.invert_xaxis()
    for state, color, label in (
        (diabolo.StringState.ON_STRING, "#3b6ea5", "on the string"),
        (diabolo.StringState.LOOSE, "#d9a441", "string slack"),
        (diabolo.StringState.FLYING, "#8e6bb0", "flying"),
    ):
        shown = np.where(result.string_states == state, states[:, 2], np.nan)
        if not np.isnan(shown).all():
            height.plot(time, shown, color=color, lw=2.2, label=label)
    height.set(title="height", xlabel="time [s]", ylabel="z [m]")
    height.legend(frameon=False)
    image_of(figure, 110).quantize(64, dither=Image.Dither.NONE).save(path, optimize=True)


def draw_diagnosis(path: Path) -> None:
    """The answer of `diabolo demo` beside the truth, and the errors before and after."""
    paths = packaged_recordings()
    answer = diabolo.diagnose([diabolo.load_recording(file) for file in paths]).to_dict()
    truths = concealed_in(paths[0])
    figure, (found, errors) = panels()
    labels = {
        "string_friction": "friction",
        "air_drag_quadratic": "air drag",
        "gravity_tilt": "frame's tilt",
        "azimuth_deg": "tilt's azimuth",
    }
    rows = [
        (
            effect["name"] if index == 0 else parameter["name"],
            parameter,
            truths[effect["name"]][parameter["name"]],
        )
        for effect in answer["effects"]
        if effect["name"] in truths
        for index, parameter in enumerate(effect["parameters"])
    ]
    for row, (_, parameter, truth) in enumerate(rows):
        low, high = (end / truth for end in parameter["ci90"])
        color = AFTER if low <= 1.0 <= high else BEFORE
        found.plot([low, high], [row, row], color=color, lw=5, solid_capstyle="butt", alpha=0.5)
        found.plot(parameter["value"] / truth, row, "o", color=color, ms=7)
    found.axvline(1.0, color=INK, lw=1.2, ls="--")
    found.text(1.0, -0.75, " concealed value", color=INK, fontsize=9)
    found.set(
        title="found, with 90 % interval",
        xlabel="found / concealed",
        xlim=(0.7, 1.3),
        ylim=(len(rows) - 0.5, -1),
    )
    found.set_yticks(range(len(rows)), [labels.get(name, name) for name, _, _ in rows])
    fit = answer["fit"]
    for key, color, label in (
        ("base_error_m", BEFORE, "as given"),
        ("augmented_error_m", AFTER, "with what was found"),
    ):
        errors.plot(
            fit["horizons_s"], [1e3 * error for error in fit[key]], "o-", color=color, lw=2, label=label
        )
    errors.set(title="mean held-out error", xlabel="predicted ahead [s]", ylabel="[mm]", ylim=(0, 200))
    errors.legend(frameon=False)
    image_of(figure, 110).quantize(64, dither=Image.Dither.NONE).save(path, optimize=True)


def draw_plan(path: Path) -> None:
    """A planned throw and catch."""
    played = diabolo.plan_action("throw_and_catch", height=0.6)
    figure, (side, height) = panels()
    states, time = played.states, played.time
    for name, tip, color in (("left tip", played.left, LEFT), ("right tip", played.right, RIGHT)):
        side.plot(tip[:, 1], tip[:, 2], color=color, lw=1.4, label=name)
        height.plot(time, tip[:, 2], color=color, lw=1.2)
    for axes, across in ((side, states[:, 1]), (height, time)):
        axes.plot(across, states[:, 2], color=INK, lw=1.8)
    flies = np.where(played.string_states == diabolo.StringState.FLYING, states[:, 2], np.nan)
    height.plot(time, flies, color="#d97706", lw=3.5, label="flying")
    side.set(title="from behind the player", xlabel="y [m]", ylabel="z [m]")
    side.set_aspect("equal", adjustable="datalim")
    side.invert_xaxis()
    side.legend(frameon=False)
    height.set(title="height", xlabel="time [s]", ylabel="z [m]")
    height.legend(frameon=False)
    image_of(figure, 110).quantize(64, dither=Image.Dither.NONE).save(path, optimize=True)


def draw_page(path: Path) -> None:
    """The page to play with, while both tips are shaken."""
    shake = """<script>
    requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 16);
    setInterval(() => {
      const up = 0.15 * Math.sin(performance.now() / 160);
      [wanted.left, wanted.right] = [[0.4, 1.25 + up], [-0.4, 1.25 - up]];
    }, 16);</script></body>"""
    with tempfile.TemporaryDirectory() as folder:
        page, shot = Path(folder) / "page.html", Path(folder) / "page.png"
        page.write_text(PAGE.read_text(encoding="utf-8").replace("</body>", shake), encoding="utf-8")
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]
        options += ["--window-size=900,640", "--virtual-time-budget=9000"]
        options += [f"--user-data-dir={folder}/profile", f"--screenshot={shot}"]
        subprocess.run(["chromium", *options, page.as_uri()], check=True, capture_output=True, timeout=120)
        image = Image.open(shot).convert("RGB")
    image.quantize(64, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(path, optimize=True)


def panels() -> tuple[Figure, Any]:
    figure = Figure(figsize=(7.2, 2.9), layout="constrained")
    axes = figure.subplots(1, 2)
    for panel in axes:
        panel.grid(alpha=0.25)
    return figure, axes


if __name__ == "__main__":
    main()
