# SPDX-License-Identifier: MIT
"""Recordings of rerun, to be looked at: the play in three dimensions, height and spin over time, and beside
them what models predict."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import Recording, RecordingError
from ..files import whole_file
from ..rotations import first_axes
from ..view import Replay
from .bodies import Floats

STICK = 0.35
"""How much of a stick is drawn [m]."""
GHOST = 0.03
"""Radius of a prediction [m]."""
TAUT = (-0.02, 0.15)
"""The path over the diabolo may be so much shorter and longer than the string to be drawn over it [m]."""
WOOD, ROPE, CUPS, AXLE = (190, 150, 100), (120, 120, 130), (204, 38, 25, 110), (60, 60, 60)
PREDICTED = {"base": (225, 29, 72), "corrected": (5, 150, 105)}
"""Colours of a replay's predictions, as in the report."""


def save(recording: Recording, path: Path) -> None:
    """Write the entities world/sticks, world/string, world/diabolo, height [m] and spin [rad/s] over the
    timeline `time`, with a layout. What was not seen is not there."""
    save_replay(Replay(recording, {}), path)


def save_replay(replay: Replay, path: Path) -> None:
    """That of its recording, and of each prediction world/predicted/NAME and error/NAME [m]."""
    import rerun as rr

    recording = replay.recording
    stream = rr.RecordingStream("diabolo")
    time = rr.TimeColumn("time", duration=recording.time - recording.time[0])

    def send(entity: str, kind: Any, counts: NDArray[np.int64], **columns: Any) -> None:
        stream.send_columns(entity, [time], kind.columns(**columns).partition(counts))

    def plot(entity: str, values: Floats) -> None:
        seen = np.isfinite(values)
        send(entity, rr.Scalars, np.where(seen, 1, 0), scalars=values[seen])

    with whole_file(path) as temporary, _closed(stream, path):
        stream.save(temporary, default_blueprint=_layout(with_errors=bool(replay.predictions)))
        stream.send_recording_name(recording.name)
        stream.log("world", rr.ViewCoordinates.FLU, static=True)
        for name, (strips, counts), colour, radius in (
            ("sticks", _sticks(recording), WOOD, 0.008),
            ("string", _string(recording), ROPE, 0.002),
            ("diabolo/axle", _axle(recording), AXLE, recording.properties.axle_radius),
        ):
            send(f"world/{name}", rr.LineStrips3D, counts, strips=strips)
            drawn = rr.LineStrips3D.from_fields(colors=[colour], radii=[radius])
            stream.log(f"world/{name}", drawn, static=True)
        centres, turns, counts = _cups(recording)
        columns = {"quaternions": turns} if len(turns) else {}
        send("world/diabolo/cups", rr.Ellipsoids3D, counts, centers=centres, **columns)
        stream.log("world/diabolo/cups", _cup(recording), static=True)
        plot("height", recording.diabolo[:, 2])
        plot("spin", recording.spin())
        for name, places in replay.predictions.items():
            positions = places[:, :3]
            entity, seen, colour = f"world/predicted/{name}", np.isfinite(positions[:, 0]), PREDICTED[name]
            send(entity, rr.Points3D, np.where(seen, 1, 0), positions=positions[seen])
            stream.log(entity, rr.Points3D.from_fields(colors=[colour], radii=[GHOST]), static=True)
            plot(f"error/{name}", replay.errors(name))
            stream.log(f"error/{name}", rr.SeriesLines(colors=[colour], names=[name]), static=True)


@contextmanager
def _closed(stream: Any, path: Path) -> Iterator[None]:
    """Everything is written in the end, and the file is closed; rerun's errors become a sentence."""
    try:
        yield
        stream.flush()
        stream.disconnect()
    except RuntimeError as error:
        why = " ".join(str(error).split())
        raise RecordingError(f"{path}: cannot be written ({why})") from error
    finally:
        with suppress(Exception):
            stream.disconnect()


def _layout(with_errors: bool) -> Any:
    """The play, and beside it height, spin and how far predictions are off."""
    import rerun.blueprint as rrb

    units = {"error": "m"} if with_errors else {}
    units |= {"height": "m", "spin": "rad/s"}
    plots = [
        rrb.TimeSeriesView(
            origin=name, name=f"{name} [{unit}]", plot_legend=rrb.PlotLegend(visible=name == "error")
        )
        for name, unit in units.items()
    ]
    eye = rrb.EyeControls3D(position=[-1.3, -0.9, 1.2], look_target=[0.0, 0.0, 0.9], eye_up=[0.0, 0.0, 1.0])
    play = rrb.Spatial3DView(origin="world", name="play", eye_controls=eye)
    parts = rrb.Horizontal(play, rrb.Vertical(*plots), column_shares=[2, 1])
    return rrb.Blueprint(parts, collapse_panels=True)


def _first_axis(orientation: Floats | None, size: int) -> Floats:
    """Body x in the world, shape (n, 3); NaN where it is not known."""
    return np.full((size, 3), np.nan) if orientation is None else first_axes(orientation)


def _strips(rows: Sequence[Floats]) -> tuple[Floats, NDArray[np.int64]]:
    """Of lines of the shape (n, points, 3) the finite ones row by row, and how many a row has."""
    lines = np.stack(rows, axis=1)
    seen = np.isfinite(lines).all(axis=(2, 3))
    return lines[seen], seen.sum(axis=1)


def _sticks(recording: Recording) -> tuple[Floats, NDArray[np.int64]]:
    """Both sticks, from the tip inwards, where their directions are known."""
    rows = []
    for tip, turns in (
        (recording.left, recording.left_orientation),
        (recording.right, recording.right_orientation),
    ):
        rows.append(np.stack([tip, tip - STICK * _first_axis(turns, len(recording))], axis=1))
    return _strips(rows)


def _string(recording: Recording) -> tuple[Floats, NDArray[np.int64]]:
    """From tip to tip, over the diabolo where that is on it; nothing where it is not seen."""
    left, right, diabolo = recording.left, recording.right, recording.diabolo
    path = np.linalg.norm(diabolo - left, axis=1) + np.linalg.norm(diabolo - right, axis=1)
    over = path - recording.string_length
    on = (over > TAUT[0]) & (over < TAUT[1])
    middle = np.where((on | np.isnan(path))[:, None], diabolo, 0.5 * (left + right))
    return _strips([np.stack([left, middle, right], axis=1)])


def _axle(recording: Recording) -> tuple[Floats, NDArray[np.int64]]:
    half = 0.5 * recording.properties.length * _first_axis(recording.diabolo_orientation, len(recording))
    return _strips([np.stack([recording.diabolo - half, recording.diabolo + half], axis=1)])


def _cups(recording: Recording) -> tuple[Floats, Floats, NDArray[np.int64]]:
    """Centres of both cups and their orientations, row by row; one ball without orientations."""
    if recording.diabolo_orientation is None:
        seen = np.isfinite(recording.diabolo).all(axis=1)
        return recording.diabolo[seen], np.zeros((0, 4)), np.where(seen, 1, 0)
    along = 0.25 * recording.properties.length * _first_axis(recording.diabolo_orientation, len(recording))
    centres = np.stack([recording.diabolo - along, recording.diabolo + along], axis=1)
    seen = np.isfinite(centres).all(axis=(1, 2))
    turns = np.repeat(recording.diabolo_orientation[seen], 2, axis=0)
    return centres[seen].reshape(-1, 3), turns, np.where(seen, 2, 0)


def _cup(recording: Recording) -> Any:
    """Its size and colour: half of the diabolo, or a ball as large as that."""
    import rerun as rr

    radius, long = 0.5 * recording.properties.diameter, 0.25 * recording.properties.length
    along = radius if recording.diabolo_orientation is None else long
    return rr.Ellipsoids3D.from_fields(
        half_sizes=[[along, radius, radius]], colors=[CUPS], fill_mode=rr.components.FillMode.Solid
    )
