# SPDX-License-Identifier: MIT
from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import diabolo
import numpy as np
import pytest
from conftest import make_recording
from diabolo import Excerpt, Model, Parameters, Recording, evaluate, position_errors, predict


def test_a_model_predicts_what_it_made_itself(played: Recording) -> None:
    predicted = predict(played)
    errors = position_errors(played, predicted)
    assert predicted.states.shape == (481, 7) and errors.shape == (481,)
    # Its start is the published one, whose velocity looks half a frame ahead; the step is another too.
    assert np.nanmean(errors) < 5e-3
    other = position_errors(
        played, predict(played, Model(Parameters(string_length=1.35), own_string_length=True))
    )
    assert np.nanmean(other) > 0.04


def test_predictions_start_where_they_are_told(played: Recording) -> None:
    predicted = predict(played, "consistent", row=100, start="fair")
    assert np.isnan(predicted.states[:100]).all() and np.isfinite(predicted.states[100:]).all()
    np.testing.assert_array_equal(predicted.states[100, :3], played.diabolo[100])
    np.testing.assert_array_equal(predicted.time, played.time)
    with pytest.raises(ValueError, match="row 3 cannot be a start"):
        predict(played, row=3, start="fair")


def test_the_table_has_a_row_for_each_model_and_excerpt(played: Recording) -> None:
    result = evaluate([played, Excerpt(played, 100, 300)])
    assert [(row.frames, row.model) for row in result.rows] == [
        (frames, model) for frames in ((0, 480), (100, 300)) for model in ("published", "paper", "consistent")
    ]
    assert not result.horizons
    row = result.rows[2]
    errors = position_errors(played, predict(played))
    assert row.error == pytest.approx(float(errors[1:-1].mean()), rel=1e-12)
    lowest = np.linalg.norm(diabolo.baseline(played) - played.diabolo, axis=1)
    assert row.baseline_error == pytest.approx(float(lowest[1:-1].mean()), rel=1e-12)
    assert row.paper_error is None and row.program_error is None
    assert (row.score.scored, row.score.skipped, row.score.start_row) == (479, 0, 0)


def test_only_the_excerpts_of_the_paper_carry_its_figures() -> None:
    take = make_recording("hold", seconds=3.0, name="z_hop_1")
    rows = evaluate([take, Excerpt(take, 0, 180), Excerpt(take, 20, 200)], "paper").rows
    assert [(row.frames, row.paper_error) for row in rows] == [
        ((0, 180), 0.07),
        ((0, 360), None),
        ((0, 180), 0.07),
        ((20, 200), None),
    ]


def test_many_starts_give_errors_that_grow(played: Recording) -> None:
    result = evaluate(played, ["consistent", "published"], starts_every=0.1)
    own = [row.score for row in result.horizons if row.model == "consistent"]
    assert [score.horizon for score in own] == [0.1, 0.25, 0.5, 1.0, 2.0]
    assert not result.rows
    for score in own:
        assert score.model is not None and score.baseline is not None
        assert score.model.mean < 0.1 * score.baseline.mean
        assert score.model.median <= score.model.percentile_90
    assert own[0].windows > own[-1].windows > 15


def test_several_recordings_are_put_together(played: Recording) -> None:
    beaten = make_recording("beat", name="beaten")
    rows = evaluate([played, Excerpt(beaten, 0, 300)], "paper", starts_every=0.2, horizons=[0.5]).horizons
    assert [row.recording for row in rows] == ["played", "beaten:0-300", "all recordings"]
    assert rows[2].score.windows == rows[0].score.windows + rows[1].score.windows


def test_recordings_of_the_same_name_are_told_apart(played: Recording) -> None:
    same = [played.cut(row, 480) for row in range(3)]
    rows = evaluate(same, "paper", starts_every=1.0, horizons=[0.5]).horizons
    assert [row.recording for row in rows] == ["played", "played (2)", "played (3)", "all recordings"]
    together = make_recording(seconds=2.0, name="all recordings")
    rows = evaluate([played, together], "paper", starts_every=1.0, horizons=[0.5]).horizons
    assert [row.recording for row in rows] == ["played", "all recordings (2)", "all recordings"]
    numbered = make_recording(seconds=2.0, name="played (2)")
    rows = evaluate([numbered, *same[:2]], "paper", starts_every=1.0, horizons=[0.5]).horizons
    assert [row.recording for row in rows] == ["played (2)", "played", "played (3)", "all recordings"]


def test_seed_and_threads(played: Recording) -> None:
    def intervals(**options: int) -> list[object]:
        rows = evaluate(played, "published", starts_every=0.05, **options).to_dict()["horizons"]
        return [row["ci95_m"] for row in rows]

    assert intervals(threads=1) == intervals(threads=3) == intervals(threads=0)
    assert intervals(seed=1) == intervals(seed=1)
    assert intervals(seed=1) != intervals(seed=2)


def test_progress_comes_to_its_end(played: Recording) -> None:
    for starts_every in (None, 0.5):
        fractions: list[float] = []
        evaluate([played, played.cut(0, 300)], "paper", starts_every=starts_every, progress=fractions.append)
        assert fractions == sorted(fractions) and fractions[-1] == 1.0


def test_a_failing_progress_function_ends_the_work(played: Recording) -> None:
    def fail(fraction: float) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        evaluate(played, "paper", starts_every=0.1, progress=fail)


def test_the_same_recording_does_not_count_twice(played: Recording) -> None:
    with pytest.raises(
        ValueError, match=r'"played" and recording "played" hold the same 481 samples, from 0 to 4 s; '
    ):
        evaluate([played, played.cut(0, 480)], "paper")
    assert len(evaluate([played, played.cut(0, 300)], "paper").rows) == 2  # as in the paper's table


def test_bad_input_is_named(played: Recording) -> None:
    with pytest.raises(ValueError, match="recordings: none"):
        evaluate([])
    for start in ("x", np.zeros(3)):
        with pytest.raises(ValueError, match=r"^start: .*; expected one of fair, published$"):
            evaluate(played, start=start)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="expected published, paper or consistent"):
        evaluate(played, "ours")
    with pytest.raises(ValueError, match="models: two are named 'paper'"):
        evaluate(played, ["paper", Model.paper()])
    with pytest.raises(ValueError, match="starts_every: 0 s"):
        evaluate(played, starts_every=0.0)
    with pytest.raises(ValueError, match="horizons: 0\\.5; expected times"):
        evaluate(played, starts_every=0.1, horizons=0.5)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="horizon: -1 s"):
        evaluate(played, starts_every=0.1, horizons=[-1.0])
    for change, text in (
        ({"threads": -1}, "threads: -1"),
        ({"threads": 1.5}, "threads: 1.5; expected a whole number"),
        ({"threads": 10**30}, "threads: 10"),
        ({"seed": -1}, "seed: -1"),
        ({"seed": 2**70}, "seed: 11805"),
        ({"progress": 3}, "progress: 3; expected a function"),
        ({"recordings": 3}, "recordings: 3; expected Recording or Excerpt"),
        ({"recordings": [None]}, r"recordings\[0\]: None; expected Recording or Excerpt"),
        ({"models": []}, "models: none; at least one expected"),
        ({"models": [None]}, "models: None; expected a Model"),
        ({"models": Model(name="baseline")}, "models: one is named 'baseline'"),
    ):
        with pytest.raises(ValueError, match=text):
            evaluate(**{"recordings": played, **change})
    for row in (-1, 10**30, 0.5):
        with pytest.raises(ValueError, match=f"row: .*; expected a whole number from 0 to {len(played) - 1}"):
            predict(played, row=row)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="predicted: 101 rows; expected 481"):
        position_errors(played, predict(played.cut(0, 100)))
    unseen = Recording(
        played.time,
        played.left,
        played.right,
        played.diabolo * np.nan,
        120.0,
        name="unseen",
        properties=played.properties,
        string_length=played.string_length,
    )
    with (
        pytest.warns(diabolo.RecordingWarning, match="the diabolo is never seen"),
        pytest.raises(ValueError, match='"unseen": no two successive rows with the diabolo'),
    ):
        evaluate(unseen)


@pytest.mark.filterwarnings("ignore::diabolo.RecordingWarning")
def test_the_published_program_is_repeated(real_recordings: Path) -> None:
    """Its figures are those of the authors' program, run on the same rows (2 %: when it changes tips)."""
    physics, extraction = "2020-07-11_basic_physics", "2020-09-14_motion_extraction"
    paths = [f"{physics}/{name}.csv" for name in ("throw_1", "y_swing_2", "z_hop_1", "acceleration_1")]
    takes = [diabolo.load_recording(real_recordings / path) for path in paths]
    takes.append(diabolo.load_recording(real_recordings / f"{extraction}/circular_accel_stick_motion.csv"))
    rows = [row for row in evaluate(takes, "published").rows if row.program_error is not None]
    assert len(rows) == 5
    for row in rows:
        assert row.error is not None
        assert row.error == pytest.approx(row.program_error, rel=0.02)


@pytest.mark.filterwarnings("ignore::diabolo.RecordingWarning")
@pytest.mark.parametrize("work", [evaluate, predict])
def test_ctrl_c_ends_one_long_prediction(played: Recording, work: Callable[[Recording, str], object]) -> None:
    stretch = 20_000.0
    long = Recording(
        played.time * stretch, played.left, played.right, played.diabolo, played.rate / stretch, name="long"
    )
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))  # needs the interpreter's lock
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work(long, "consistent")
    assert time.monotonic() - begin < 5.0
    timer.join()
