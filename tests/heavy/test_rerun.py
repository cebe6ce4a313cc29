# SPDX-License-Identifier: MIT
"""Recordings of rerun: what is in them, read again by rerun itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from diabolo import Model, Recording, RecordingError, load_recording, save_recording
from diabolo.cli import main
from diabolo.view import PREDICTED_ANEW, predict_anew

pytest.importorskip("rerun", reason="rerun is not installed: pip install '.[rerun]'")
from rerun.chunk import RrdReader

pytestmark = pytest.mark.rerun

SWING = Path(__file__).parents[2] / "data" / "recordings" / "swing.csv"


def columns(path: Path) -> dict[str, dict[str, list]]:
    """What a file holds over time, by entity and component."""
    found: dict[str, dict[str, list]] = {}
    for chunk in RrdReader(path).stream().collect().stream():
        if chunk.is_static:
            continue
        batch = chunk.to_record_batch()
        for name, column in zip(batch.schema.names, batch.columns, strict=True):
            values = column.cast("int64") if name == "time" else column
            found.setdefault(chunk.entity_path, {})[name] = values.to_pylist()
    return found


def test_a_take_is_there_row_by_row(tmp_path: Path) -> None:
    take, path = load_recording(SWING), tmp_path / "swing.rrd"
    assert main(["convert", str(SWING), str(path)]) == 0
    assert [one.application_id for one in RrdReader(path).recordings()] == ["diabolo"]
    assert RrdReader(path).blueprints()  # the layout
    found = columns(path)
    assert found.keys() == {
        *("/world/sticks", "/world/string", "/world/diabolo/axle", "/world/diabolo/cups"),
        *("/height", "/spin"),
    }
    seen = np.isfinite(take.diabolo[:, 0])
    assert not seen.all()
    strings = found["/world/string"]["LineStrips3D:strips"]
    whole = seen & np.isfinite(take.left[:, 0] + take.right[:, 0])
    assert [len(row) for row in strings] == whole.tolist()
    for row in np.flatnonzero(whole):
        [(left, middle, right)] = strings[row]
        np.testing.assert_allclose(
            [left, middle, right], [take.left[row], take.diabolo[row], take.right[row]], atol=1e-6
        )
    cups = found["/world/diabolo/cups"]["Ellipsoids3D:centers"]
    assert [len(row) for row in cups] == [2 * one for one in seen]  # nothing in a dropout
    for name, values in (("/height", take.diabolo[:, 2]), ("/spin", take.spin())):
        told = [row[0] if row else np.nan for row in found[name]["Scalars:scalars"]]
        np.testing.assert_array_equal(told, values)
    seconds = 1e-9 * np.array(found["/height"]["time"])
    np.testing.assert_allclose(seconds, take.time - take.time[0], rtol=0.0, atol=2e-9)


def test_what_cannot_be_written_is_told_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"nowhere/a\.rrd: cannot be written \(.*No such file"):
        save_recording(load_recording(SWING), tmp_path / "nowhere" / "a.rrd")


def test_points_alone_and_a_diabolo_that_is_never_seen_are_written(tmp_path: Path) -> None:
    take, path = load_recording(SWING), tmp_path / "bare.rrd"
    for diabolo, count in ((take.diabolo, 1), (np.full_like(take.diabolo, np.nan), 0)):
        save_recording(Recording(take.time, take.left, take.right, diabolo, take.rate), path)
        found = columns(path)
        assert len(found["/world/string"]["LineStrips3D:strips"][0]) == count
        assert found["/world/sticks"]["LineStrips3D:strips"][0] == []


def test_a_diagnosed_take_has_its_predictions_and_their_errors(tmp_path: Path) -> None:
    out, given = tmp_path / "out", [str(SWING.with_name("hop.csv")), "--holdout", f"{SWING}:0-239"]
    assert main(["diagnose", *given, "--out", str(out), "--rerun"]) == 0
    takes = [load_recording(SWING.with_name("hop.csv")), load_recording(SWING).cut(0, 239)]
    models = {"base": Model.named("consistent"), "corrected": Model.load(out / "model.json")}
    means = {}
    for i, take in enumerate(takes):
        path = out / f"replay-{i + 1}.rrd"
        assert len(RrdReader(path).blueprints()) == 1
        found = columns(path)
        for name, model in models.items():
            positions = predict_anew(take, model, PREDICTED_ANEW)[:, :3]
            seen = np.isfinite(positions[:, 0])
            rows = found[f"/world/predicted/{name}"]["Points3D:positions"]
            assert [len(row) for row in rows] == seen.astype(int).tolist()
            assert 0.8 * len(take) < seen.sum() < len(take)
            np.testing.assert_allclose([row[0] for row in rows if row], positions[seen], atol=1e-6)
            errors = np.linalg.norm(positions - take.diabolo, axis=1)
            told = [row[0] if row else np.nan for row in found[f"/error/{name}"]["Scalars:scalars"]]
            np.testing.assert_allclose(told, errors, rtol=1e-12)
            means[i, name] = np.nanmean(errors)
    for i in range(len(takes)):  # it was diagnosed
        assert means[i, "corrected"] < 0.5 * means[i, "base"]
    assert main(["diagnose", *given, "--out", str(out)]) == 2  # the replays would stay
