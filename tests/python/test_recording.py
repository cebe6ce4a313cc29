# SPDX-License-Identifier: MIT
from __future__ import annotations

import json
import pickle
import re
from pathlib import Path

import diabolo
import numpy as np
import pytest
from conftest import motive_text
from diabolo import (
    Calibration,
    DiaboloProperties,
    Model,
    Recording,
    RecordingError,
    StickFlex,
    TipMotion,
    load_recording,
    rollout,
)
from diabolo.cli import main


def with_dropouts(played: Recording) -> Recording:
    """A dropout of the diabolo in rows 10 to 12, of the left tip in row 20."""
    left, diabolo_track = played.left.copy(), played.diabolo.copy()
    diabolo_track[10:13] = np.nan
    left[20, 1] = np.nan
    return Recording(
        played.time,
        left,
        played.right,
        diabolo_track,
        played.rate,
        diabolo_orientation=played.diabolo_orientation,
        name="holes",
        properties=DiaboloProperties(0.2, 0.1, 0.12, 0.007),
        string_length=1.3,
    )


def test_arrays_become_a_recording_with_dropouts(played: Recording) -> None:
    recording = with_dropouts(played)
    assert len(recording) == len(played) == recording.time.shape[0]
    assert np.flatnonzero(~recording.diabolo_valid).tolist() == [10, 11, 12]
    assert np.flatnonzero(~recording.left_valid).tolist() == [20]
    assert np.isnan(recording.left[20]).all() and np.isnan(recording.diabolo[10:13]).all()
    assert recording.left_orientation is None and recording.diabolo_orientation is not None
    assert (recording.name, recording.rate, recording.string_length) == ("holes", 120.0, 1.3)
    assert recording.properties.mass == 0.2
    assert repr(recording) == "<Recording 'holes': 481 samples at 120 Hz>"


def test_arrays_are_read_only_views(played: Recording) -> None:
    track = played.cut(0, 99).diabolo  # outlives its recording
    assert track.shape == (100, 3) and track.flags.c_contiguous and not track.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        track[0, 0] = 1.0
    np.testing.assert_array_equal(track, played.diabolo[:100])


def test_recordings_can_be_pickled(played: Recording, tmp_path: Path) -> None:
    other = pickle.loads(pickle.dumps(played))
    part = played.cut(12, 30)
    assert part.clock == pytest.approx(played.time[12] - played.time[0])
    assert pickle.loads(pickle.dumps(part)).clock == part.clock
    part.save(tmp_path / "part.csv")
    assert Recording.load(tmp_path / "part.csv").clock == part.clock > 0.0
    assert (other.name, other.rate, other.string_length) == (played.name, played.rate, played.string_length)
    assert other.properties.mass == played.properties.mass
    for name in ("frame", "time", "left", "right", "diabolo", "diabolo_valid"):
        np.testing.assert_array_equal(getattr(other, name), getattr(played, name))
    np.testing.assert_allclose(other.diabolo_orientation, played.diabolo_orientation, rtol=0, atol=1e-15)


def test_cuts_include_both_rows(played: Recording) -> None:
    part = played.cut(5, 9)
    assert part.frame.tolist() == [5, 6, 7, 8, 9]
    np.testing.assert_array_equal(part.diabolo, played.diabolo[5:10])
    with pytest.raises(RecordingError, match="rows 0 to 481; expected 0 <= first <= last < 481"):
        played.cut(0, 481)


def test_tidy_files_hold_everything(played: Recording, tmp_path: Path) -> None:
    recording = with_dropouts(played)
    recording.save(tmp_path / "holes.csv")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["holes.csv", "holes.json"]
    again = Recording.load(tmp_path / "holes.csv")
    for name in ("time", "left", "right", "diabolo", "diabolo_orientation", "left_valid", "diabolo_valid"):
        np.testing.assert_array_equal(getattr(again, name), getattr(recording, name))
    assert (again.name, again.string_length) == ("holes", 1.3)
    assert repr(again.properties) == repr(recording.properties)


def test_motive_files_are_calibrated(played: Recording, motive_file: Path) -> None:
    take = diabolo.load_recording(motive_file)
    for name in ("left", "right", "diabolo"):
        np.testing.assert_allclose(getattr(take, name), getattr(played, name), atol=1e-7)
    np.testing.assert_allclose(take.spin()[:-1], played.spin()[:-1], atol=1e-3)
    assert take.string_length == 1.46 and take.name == "take"


def test_another_calibration_moves_the_tips(played: Recording, motive_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "calibration.json"
    Calibration.published().save(path)
    numbers = json.loads(path.read_text())
    x, y, z = numbers["left"]["point"]
    numbers["left"]["point"] = [x + 0.01, y, z]
    path.write_text(json.dumps(numbers))
    moved = Recording.load(motive_file, Calibration.load(path))
    shift = np.linalg.norm(moved.left - played.left, axis=1)
    np.testing.assert_allclose(shift, 0.01, atol=1e-6)
    np.testing.assert_allclose(moved.right, played.right, atol=1e-7)


def test_spin_has_a_sign_unless_it_is_not_asked_for(played: Recording) -> None:
    orientation = played.diabolo_orientation
    assert orientation is not None
    mirrored = Recording(
        played.time,
        played.left,
        played.right,
        played.diabolo,
        120.0,
        diabolo_orientation=orientation * [-1, 1, 1, 1],
    )
    assert played.spin()[0] == pytest.approx(100.0, abs=1e-6)
    np.testing.assert_allclose(mirrored.spin()[:-1], -played.spin()[:-1], atol=1e-6)
    np.testing.assert_allclose(mirrored.spin(signed=False)[:-1], np.abs(played.spin()[:-1]), atol=1e-6)
    assert np.isnan(played.spin()[-1])


def test_resampling_keeps_the_motion(played: Recording) -> None:
    half = played.resample(60.0)
    assert half.rate == 60.0 and len(half) == 241
    np.testing.assert_allclose(half.diabolo, played.diabolo[::2], atol=1e-12)


def test_the_tips_of_a_recording_are_a_motion(played: Recording) -> None:
    motion = TipMotion.of_recording(played)
    left, right, _, _ = motion.at(played.time)
    np.testing.assert_allclose(left, played.left, atol=1e-12)
    np.testing.assert_allclose(right, played.right, atol=1e-12)
    filled = TipMotion.of_recording(with_dropouts(played), "linear")
    expected = 0.5 * (played.left[19] + played.left[21])
    np.testing.assert_allclose(filled.at(played.time[20])[0], expected, atol=1e-12)


def test_a_prediction_is_a_rollout_of_the_recorded_tips_and_sticks(played: Recording) -> None:
    half = 0.3 * np.sin(3.0 * played.time)
    zero = np.zeros_like(half)
    turn = np.stack([zero, zero, np.sin(half), np.cos(half)], axis=1)
    recording = Recording(
        played.time,
        played.left,
        played.right,
        played.diabolo,
        played.rate,
        diabolo_orientation=played.diabolo_orientation,
        left_orientation=turn,
        right_orientation=turn,
        properties=played.properties,
        string_length=1.46,
    )
    tips = TipMotion.of_recording(recording)
    np.testing.assert_allclose(
        tips.left_directions[:, :2].T, [np.cos(2 * half), np.sin(2 * half)], atol=1e-12
    )
    flex = StickFlex(compliance=5e-3, damping=2.0)
    model = Model(own_string_length=True, own_mass=True, stick_flex=flex)
    predicted = diabolo.predict(recording, model, row=60, start="fair")
    start = diabolo.start_state(recording, 60)
    result = rollout(
        model, start.to_array(), tips, begin=60 / 120.0, string_state=start.string_state, steps=3500
    )
    steps = np.ceil((np.arange(61, 481) - 60) / 120.0 * 1e3 - 1e-3).astype(int)  # the first at or after a row
    np.testing.assert_array_equal(predicted.states[61:], result.states[steps - 1])


def test_start_states_are_those_of_the_motion(played: Recording) -> None:
    state = diabolo.start_state(played, 60)
    speed = 60.0 * (played.diabolo[61] - played.diabolo[59])
    np.testing.assert_array_equal(state.position, played.diabolo[60])
    np.testing.assert_allclose(state.velocity, speed, atol=0.02)
    assert state.string_state == diabolo.StringState.ON_STRING
    with pytest.raises(ValueError, match="row 0 cannot be a start"):
        diabolo.start_state(played, 0)
    assert diabolo.start_state(played, 0, "published").string_state == diabolo.StringState.LOOSE
    with pytest.raises(ValueError, match="row 481; expected 0 to 480"):
        diabolo.start_state(played, 481)
    with pytest.raises(ValueError, match="'first'; expected 'fair' or 'published'"):
        diabolo.start_state(played, 60, "first")


def test_bad_arrays_are_refused(played: Recording) -> None:
    good = (played.time, played.left, played.right, played.diabolo)
    with pytest.raises(ValueError, match=r"left: shape \(3, 3\); expected \(481, 3\)"):
        Recording(played.time, played.left[:3], played.right, played.diabolo, 120.0)
    with pytest.raises(ValueError, match="rate 100 Hz, but the times step by"):
        Recording(*good, 100.0)
    with pytest.raises(ValueError, match="expected increasing times"):
        Recording(played.time[::-1], *good[1:], 120.0)
    with pytest.raises(ValueError, match="diabolo_orientation, row 0: quaternion of norm 2"):
        Recording(*good, 120.0, diabolo_orientation=np.full((481, 4), 1.0))
    with pytest.raises(ValueError, match="mass"):
        DiaboloProperties(-1.0, 0.1, 0.1)


def test_what_nobody_gives_of_the_set_up_is_assumed(played: Recording) -> None:
    arrays = (played.time, played.left, played.right, played.diabolo, 120.0)
    red = DiaboloProperties.red()
    assert Recording(*arrays).assumed == ["string_length", "diabolo"]
    assert Recording(*arrays, string_length=1.46).assumed == ["diabolo"]
    assert Recording(*arrays, properties=red).assumed == ["string_length"]
    assert Recording(*arrays, string_length=1.46, properties=red).assumed == []
    bare = Recording(*arrays)
    assert (bare.string_length, bare.properties.mass) == (1.46, 0.2845)
    assert any("kg) are assumed: no file, calibration or argument tells" in one for one in bare.warnings())
    assert pickle.loads(pickle.dumps(bare)).assumed == bare.assumed


def test_sentences_name_the_file_of_a_recording(played: Recording, tmp_path: Path) -> None:
    path = tmp_path / "take.csv"
    played.save(path)
    read = load_recording(path)
    assert (read.title, played.title) == (str(path), 'recording "played"')
    assert pickle.loads(pickle.dumps(read)).title == read.cut(0, len(read) - 1).title == str(path)
    for own in (read.cut(12, 99), read.resample(100.0), pickle.loads(pickle.dumps(read.cut(12, 99)))):
        assert own.title == f'recording "{read.name}" (from {path})'  # whose rows are others than the file's
    with pytest.raises(RecordingError, match=rf"cut of {re.escape(str(path))}: rows 0 to 999; expected"):
        read.cut(0, 999)
    with pytest.raises(ValueError, match=rf"recordings: {re.escape(str(path))} and .* hold the same 481"):
        diabolo.evaluate([read, path])


@pytest.mark.parametrize("given", [5, ["time=t"], {"time": 5}, {5: "t"}])
def test_columns_that_are_no_names_are_refused(given: object, played: Recording, tmp_path: Path) -> None:
    played.save(tmp_path / "take.csv")
    with pytest.raises(ValueError, match=r"^columns: .*; expected time=NAME\[UNIT\],... or a dict of such"):
        load_recording(tmp_path / "take.csv", columns=given)  # type: ignore[arg-type]


def test_sentences_about_columns_name_the_file(played: Recording, tmp_path: Path) -> None:
    path = tmp_path / "own.csv"
    played.save(path)
    for columns, text in (
        ("left_w=a", 'columns: "left_w"; expected time, left_x, diabolo_qw and the like'),
        ({"time": "t[mm]"}, 'columns: time=t[mm]: unit "mm"; expected s, ms, us or ns'),
        ("left_x=left_x,left_x=left_y", 'line 1: columns: left_x is mapped to "left_x" and to "left_y"'),
        (
            {"left_x": "left_y", "left_y": "left_y"},
            'line 1: columns: "left_y" is mapped to left_x and to left_y',
        ),
    ):
        with pytest.raises(RecordingError, match=rf"^{re.escape(str(path))}[:,] {re.escape(text)}"):
            load_recording(path, columns=columns)
        with pytest.raises(RecordingError, match=re.escape(text)):
            Recording.load(path, columns=columns)
    with pytest.raises(TypeError, match=r"^Recording\.load: columns: 5; expected None or a str or a dict"):
        Recording.load(path, columns=5)  # type: ignore[arg-type]


@pytest.mark.parametrize("rate", [120.0, None])
def test_two_rows_an_instant_are_refused(rate: float | None, played: Recording, tmp_path: Path) -> None:
    path = tmp_path / "pairs.csv"
    played.save(path)
    head, *rows = path.read_text().splitlines()
    twice = [f"{float(row.split(',')[0]) + 1e-6!r},{row.split(',', 1)[1]}" for row in rows]
    path.write_text(
        "\n".join([head, *(row for pair in zip(rows, twice, strict=True) for row in pair)]) + "\n"
    )
    if rate is None:
        path.with_suffix(".json").unlink()
    with pytest.raises(
        RecordingError, match=r"pairs\.csv: 481 of 962 rows come within 0\.08\d ms of the row"
    ):
        load_recording(path, columns=None if rate else {"time": "time"})


def test_a_diabolo_that_is_never_seen_is_told(played: Recording) -> None:
    unseen = np.full_like(played.diabolo, np.nan)
    none = Recording(played.time, played.left, played.right, unseen, played.rate)
    assert "the diabolo is never seen; nothing can be compared" in none.warnings()


def test_bad_files_are_named(played: Recording, tmp_path: Path) -> None:
    path = tmp_path / "bad.csv"
    with pytest.raises(RecordingError, match=r"bad\.csv: there is no such file"):
        Recording.load(path)
    path.write_text(motive_text(played).replace("0.300000,", "0.3x,", 1))
    with pytest.raises(RecordingError, match=r"bad\.csv, line "):
        Recording.load(path)
    path.write_text("a,b\n1,2\n")
    with pytest.raises(RecordingError, match=r"expected a Motive export .* or a tidy recording"):
        Recording.load(path)
    with pytest.raises(RecordingError, match=r"ends in \.csv"):
        played.save(tmp_path / "tidy.txt")
    with pytest.raises(RecordingError, match="cannot be written"):
        played.save(tmp_path / "no" / "tidy.csv")
    assert [file.name for file in tmp_path.iterdir()] == ["bad.csv"]


def test_the_real_recordings_are_read(real_recordings: Path) -> None:
    takes = sorted((real_recordings / "2020-07-11_basic_physics").glob("*.csv"))
    assert takes
    for path in takes:
        recording = Recording.load(path)
        assert recording.rate == 120.0 and recording.diabolo_valid.mean() > 0.9
        assert np.nanmax(recording.spin()) > 50.0


def shipped(name: str) -> Path:
    return Path(__file__).parents[2] / "data" / "recordings" / f"{name}.csv"


def test_another_axis_up_is_refused_and_turned_on_demand(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    take = load_recording(shipped("hop"))
    path = tmp_path / "hop.csv"
    y_up = [track[:, [0, 2, 1]] * [1, 1, -1] for track in (take.left, take.right, take.diabolo)]
    Recording(take.time, *y_up, take.rate, properties=take.properties, string_length=1.45).save(path)
    with pytest.raises(
        RecordingError, match=r"hop\.csv: the motion says that y points up, not z .* --up=y, "
    ):
        load_recording(path)
    turned = load_recording(path, up="y")
    np.testing.assert_allclose(turned.diabolo, take.diabolo, atol=1e-15)
    assert turned.warnings() == []
    assert any("y points up" in sentence for sentence in load_recording(path, up="z").warnings())
    with pytest.raises(ValueError, match='up: "up"; expected x, y, z'):
        load_recording(path, up="up")
    assert main(["evaluate", str(path)]) == 2
    assert main(["info", str(path)]) == 0
    out = capsys.readouterr().out
    assert out.count("points up") == 1 and "odd: the motion says that y points up" in out and "--up=y" in out
    assert main(["info", str(path), "--up=y"]) == 0
    assert "nothing odd" in capsys.readouterr().out


def test_clocks_jitter_jumps_and_a_cut_line_are_put_right_and_told(tmp_path: Path) -> None:
    names, *rows = shipped("swing").read_text().splitlines()
    random = np.random.default_rng(2)
    cells = [row.split(",") for row in rows]
    for row in cells:
        row[0] = f"{1.7e9 + float(row[0]) + random.normal(0.0, 0.4e-3):.6f}"
    cells[500][9] = f"{float(cells[500][9]) + 0.5:.6f}"  # of the diabolo, up
    text = "\n".join([names, *(",".join(row) for row in cells)])
    (tmp_path / "swing.csv").write_text(text[:-3])
    (tmp_path / "swing.json").write_text(shipped("swing").with_suffix(".json").read_text())
    take, whole = load_recording(tmp_path / "swing.csv"), load_recording(shipped("swing"))
    assert len(take) == len(whole) - 1
    np.testing.assert_allclose(np.diff(take.time), 1.0 / 120.0, atol=1e-6)
    assert not take.diabolo_valid[500] and whole.diabolo_valid[500]
    told = ("stamps of a clock", "last line", "jitter by 0.", "(diabolo 1)")
    assert len(take.notes) == len(told) and take.warnings() == take.notes
    assert all(words in sentence for words, sentence in zip(told, take.notes, strict=True))
    assert pickle.loads(pickle.dumps(take)).notes == take.notes


def test_a_recording_of_arrays_is_put_right_as_a_file_is() -> None:
    swing = load_recording(shipped("swing"))
    jitter = np.random.default_rng(3).normal(0.0, 0.4e-3, len(swing))
    jumping = swing.diabolo.copy()
    jumping[500, 2] += 0.5
    given = Recording(swing.time + jitter, swing.left, swing.right, jumping, swing.rate)
    jitters = "the times jitter about a steady 120 Hz in "
    assert any(jitters in odd and "put_right() moves each row" in odd for odd in given.warnings())
    right = given.put_right()
    np.testing.assert_allclose(np.diff(right.time), 1.0 / 120.0, atol=1e-6)
    assert not right.diabolo_valid[500] and np.array_equal(given.time, swing.time + jitter)
    told = zip(("jitter by 0.", "(diabolo 1)"), right.notes, strict=True)
    assert all(words in note for words, note in told)
    tracks = (track[:, [0, 2, 1]] for track in (swing.left, swing.right, swing.diabolo))
    turned = Recording(swing.time, *tracks, swing.rate)
    with pytest.raises(RecordingError, match="y points up, not z"):
        turned.put_right()
    mirrored = turned.put_right(up="y-mirrored")
    np.testing.assert_array_equal(mirrored.diabolo, swing.diabolo)


def test_columns_of_ones_own_are_mapped(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    take = load_recording(shipped("swing"))
    path = tmp_path / "own.csv"
    tracks = {"L": take.left, "R": take.right, "D": take.diabolo}
    lines = ["label,ms," + ",".join(f"{body}{axis}" for body in tracks for axis in "xyz")]
    for index, time in enumerate(take.time):
        numbers = (1e3 * track[index, axis] for track in tracks.values() for axis in range(3))
        lines.append(
            f"row {index},{1e3 * time!r}," + ",".join("" if np.isnan(n) else f"{n!r}" for n in numbers)
        )
    path.write_text("\n".join(lines).replace("np.float64(", "").replace(")", "") + "\n")
    columns = {"time": "ms[ms]"} | {
        f"{name}_{axis}": f"{name[0].upper()}{axis}[mm]"
        for name in ("left", "right", "diabolo")
        for axis in "xyz"
    }
    own = load_recording(path, columns=columns)
    np.testing.assert_allclose(own.left, take.left, atol=1e-12)
    np.testing.assert_allclose(own.time, take.time, atol=1e-9)
    assert own.rate == 120.0 and own.string_length == 1.46 and own.assumed == ["string_length", "diabolo"]
    text = ",".join(f"{tidy}={name}" for tidy, name in columns.items())
    np.testing.assert_array_equal(load_recording(path, columns=text).diabolo, own.diabolo)
    assert main(["convert", str(path), str(tmp_path / "tidy.csv"), "--columns", text]) == 0
    np.testing.assert_array_equal(load_recording(tmp_path / "tidy.csv").diabolo, own.diabolo)
    capsys.readouterr()
    assert main(["info", str(path), "--columns", text.replace("Lx", "lx")]) == 2
    assert 'no column "lx" for left_x; the file has "label", "ms", "Lx"' in capsys.readouterr().err


def test_recordings_that_overlap_by_a_few_samples_are_trimmed() -> None:
    take = load_recording(shipped("swing"))
    given = [take.cut(0, 400), take.cut(391, 800)]
    (first, second), told = diabolo.trim_overlaps(given)
    assert (len(first), len(second)) == (401, 400)
    assert told == ["'swing' overlaps 'swing' by 10 samples, which are left out of it"]
    whole, told = diabolo.trim_overlaps([take, take])
    assert [len(recording) for recording in whole] == [len(take), len(take)] and told == []


def test_an_inconsistent_state_is_refused(played: Recording) -> None:
    rebuild, arguments, state = played.__reduce_ex__(2)[:3]
    for broken, text in (
        (state[:-1], "a state of 19 items; expected 20"),
        ((*state[:-6], [0, 1], [], 0.0, [], "", False), "2 frame numbers and 481 times"),
        ((state[0].ravel()[:-1], *state[1:]), r"left: shape \(481, 3\); expected \(480, 3\)"),
    ):
        with pytest.raises(ValueError, match=text):
            rebuild(*arguments).__setstate__(broken)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("string_length", 1e300),
        ("string_length", 0.01),
        ("mass", 1e3),
        ("axle_radius", 1.0),
        ("diameter", 1e300),
        ("length", 1e-3),
    ],
)
def test_sizes_out_of_range_name_file_and_field(
    played: Recording, motive_file: Path, tmp_path: Path, field: str, value: float
) -> None:
    played.save(tmp_path / "played.csv")
    calibration = json.loads(Calibration.published().to_json())
    for path, content in (
        (tmp_path / "played.json", json.loads((tmp_path / "played.json").read_text())),
        (tmp_path / "calibration.json", calibration),
    ):
        sizes = content["diabolo"].get("properties", content["diabolo"])
        (content if field == "string_length" else sizes)[field] = value
        path.write_text(json.dumps(content))
    with pytest.raises(RecordingError, match=rf"played\.json: (diabolo\.)?{field} \[k?[gm]\] .*; expected "):
        load_recording(tmp_path / "played.csv")
    with pytest.raises(RecordingError, match=rf"calibration\.json: (diabolo\.)?{field} \[k?[gm]\]"):
        Calibration.load(tmp_path / "calibration.json")


def test_a_body_cannot_be_two(tmp_path: Path) -> None:
    calibration = json.loads(Calibration.published().to_json())
    calibration["right"]["body"] = ["other", calibration["left"]["body"]]
    (tmp_path / "calibration.json").write_text(json.dumps(calibration))
    with pytest.raises(RecordingError, match=r'left\.body and right\.body are both "stick_left"'):
        Calibration.load(tmp_path / "calibration.json")


def test_a_recording_lasts_a_day_at_most(played: Recording, tmp_path: Path) -> None:
    def stretched(factor: float) -> Recording:
        return Recording(
            played.time * factor, played.left, played.right, played.diabolo, played.rate / factor
        )

    stretched(20_000.0).save(tmp_path / "long.csv")
    with pytest.raises(RecordingError, match="from the first sample to the last; expected a day at most"):
        stretched(30_000.0)
    lines = (tmp_path / "long.csv").read_text().splitlines()
    last = lines[-1].split(",", 1)
    for hours in range(1, 4):
        lines.append(f"{float(last[0]) + 3000.0 * hours},{last[1]}")
    (tmp_path / "long.csv").write_text("\n".join(lines) + "\n")
    with pytest.raises(RecordingError, match=r"long\.csv, line 485: time .* more than a day after the first"):
        load_recording(tmp_path / "long.csv")


def test_a_name_that_cannot_be_is_not_called_missing(played: Recording, tmp_path: Path) -> None:
    path = tmp_path / ("r" * 300 + ".csv")
    with pytest.raises(RecordingError, match="the file cannot be reached: File name too long"):
        load_recording(path)
    with pytest.raises(RecordingError, match="the file cannot be written there: File name too long"):
        played.save(path)


def test_the_page_shows_files_that_are_read(played: Recording, tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "recordings.md").read_text(encoding="utf-8")
    metadata, calibration = re.findall(r"```json\n(.*?)```", page, re.DOTALL)
    played.save(tmp_path / "take.csv")
    (tmp_path / "take.json").write_text(metadata)
    assert load_recording(tmp_path / "take.csv").string_length == 1.46
    (tmp_path / "calibration.json").write_text(calibration)
    assert "stick_left" in Calibration.load(tmp_path / "calibration.json").to_json()
