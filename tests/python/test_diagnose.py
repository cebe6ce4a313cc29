# SPDX-License-Identifier: MIT
from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
import pytest
from conftest import make_recording
from diabolo import (
    Calibration,
    DiaboloProperties,
    Diagnosis,
    DiagnosisResult,
    Model,
    Recording,
    RecordingError,
    RecordingWarning,
    diagnose,
    evaluate,
    load_recording,
)
from diabolo._core import diagnosis_schema
from diabolo.cli import main
from diabolo.report import report_html

RECORDINGS = Path(__file__).parents[2] / "data" / "recordings"


def plant_recordings() -> list[Path]:
    return [RECORDINGS / f"{name}.csv" for name in ("hop", "linear_acceleration", "swing")]


@pytest.fixture(scope="module")
def plant() -> list[Recording]:
    """Recordings of the plant, whose string rubs, stretches and whose sticks bend."""
    return [load_recording(path) for path in plant_recordings()]


@pytest.fixture(scope="module")
def found(plant: list[Recording]) -> Diagnosis:
    return diagnose(plant, draws=60)


def test_models_are_drawn_from_what_the_recordings_leave_open(found: Diagnosis) -> None:
    friction = next(effect for effect in found.effects if effect.name == "string_friction").parameters[0]
    assert friction.ci90 is not None
    values = np.array([model.string_friction.coefficient for model in found.models])
    assert len(set(values)) == 60
    within = (values >= friction.ci90.low) & (values <= friction.ci90.high)
    assert 0.5 < within.mean() <= 1.0
    assert abs(np.median(values) - friction.value) < friction.ci90.high - friction.value
    assert found.models[0].name != found.models[1].name
    drags = {model.air.linear_drag for model in found.models}
    assert len(drags) > 1 and min(drags) == 0.0  # not claimed, and not excluded
    flex = next(effect for effect in found.effects if effect.name in ("stick_flex", "string_elasticity"))
    bend = [model.stick_flex.compliance > 0.0 for model in found.models]
    assert any(bend)
    assert all(bend) != bool(flex.tied_with)


def test_the_friction_of_the_plant_is_named_and_helps(found: Diagnosis) -> None:
    assert found.headline in ("NAMED", "TIE")
    friction = next(effect for effect in found.effects if effect.name == "string_friction")
    assert friction.kind == "physics"
    assert friction.parameters[0].value == pytest.approx(0.3, abs=0.03)
    fit = found.to_dict()["fit"]
    assert fit["heldout"] == "recordings"
    at = fit["horizons_s"].index(0.5)
    assert fit["augmented_error_m"][at] < 0.25 * fit["base_error_m"][at]
    assert fit["improvement_ci95_m"][0][0] > 0.0
    # What is left are the starts: an expectation beside one draw.
    assert fit["start_error_m"][at] == pytest.approx(fit["augmented_error_m"][at], rel=0.15)


def test_the_spin_is_predicted_better_and_the_takes_agree(found: Diagnosis) -> None:
    fit = found.result.fit
    before, after = fit.base_spin_error_radps[-1], fit.augmented_spin_error_radps[-1]
    assert before is not None and after is not None and after < 0.5 * before
    friction = next(effect for effect in found.effects if effect.name == "string_friction")
    gained = [interval for interval in friction.spin_worse_without_ci95_radps if interval is not None]
    assert gained and all(interval.low > 0.0 for interval in gained)
    assert "string_friction" not in [one.name for one in found.result.differing]


def test_the_result_is_of_its_schema(found: Diagnosis) -> None:
    result = found.to_dict()
    assert result["schema"] == "diabolo.diagnosis/1"
    assert json.loads(json.dumps(result, allow_nan=False)) == result
    names = {rung["name"] for rung in result["ladder"]}
    assert {"string_elasticity", "air_drag_quadratic", "gravity_tilt", "marker_offset"} <= names
    directions = len(result["locate"]["directions"])
    assert all(len(window["z"]) == directions for window in result["locate"]["windows"])
    for effect in result["effects"]:
        for parameter in effect["parameters"]:
            assert parameter["ci90"][0] <= parameter["value"] <= parameter["ci90"][1]


def test_the_result_is_an_object_and_a_file(found: Diagnosis, tmp_path: Path) -> None:
    result = found.result
    assert result.headline == found.headline
    assert result.thresholds.physics == 4.0
    assert result.fit.horizons_s == [0.1, 0.25, 0.5, 1.0]
    assert result.effects[0].parameters[0].ci90.low < result.effects[0].parameters[0].value
    assert result.to_dict() == json.loads(result.to_json())
    (tmp_path / "diagnosis.json").write_text(result.completed(seconds=1.5).to_json())
    again = DiagnosisResult.load(tmp_path / "diagnosis.json")
    assert again.seconds == 1.5 and again != result
    assert again.completed() == result
    assert result.sentence in repr(result)
    assert "'unit': '1'" in repr(result.effects[0].parameters[0])
    with pytest.raises(AttributeError):
        result.headline = "NOTHING_MISSING"  # type: ignore[misc]


def test_the_schema_is_the_one_that_is_committed() -> None:
    committed = Path(__file__).resolve().parents[2] / "docs" / "diagnosis.schema.json"
    assert json.loads(committed.read_text()) == json.loads(diagnosis_schema())


def test_the_model_predicts_and_is_a_file(found: Diagnosis, tmp_path: Path) -> None:
    found.model.save(tmp_path / "model.json")
    model = Model.load(tmp_path / "model.json")
    assert model == found.model
    assert model.string_friction.coefficient > 0.1


def test_threads_and_seed_do_not_change_the_answer(plant: list[Recording], found: Diagnosis) -> None:
    alone = diagnose(plant, threads=1)
    assert alone.result == found.result


def test_progress_names_the_steps(played: Recording) -> None:
    steps: list[str] = []
    diagnose(played, progress=lambda step, fraction: steps.append(step))
    assert steps


def test_a_bank_restricts_what_is_claimed(plant: list[Recording]) -> None:
    answer = diagnose(plant, bank=["string_elasticity", "gravity_tilt"])
    assert {effect.name for effect in answer.effects} <= {
        "string_elasticity",
        "stick_flex",
        "gravity_tilt",
    }
    assert {row.name for row in answer.result.ladder} == {"string_elasticity", "gravity_tilt"}
    with pytest.raises(ValueError, match='bank: "string_frictions"; expected of string_elasticity, '):
        diagnose(plant, bank=["string_frictions"])


@pytest.mark.filterwarnings("ignore::diabolo.RecordingWarning")
def test_exchanged_bodies_are_claimed_and_do_no_harm(plant: list[Recording], tmp_path: Path) -> None:
    swing = next(recording for recording in plant if recording.name == "swing")
    swing.save(tmp_path / "swapped.csv")
    lines = (tmp_path / "swapped.csv").read_text().splitlines()
    names = lines[0].split(",")
    left, right = ([names.index(f"{side}_{axis}") for axis in "xyz"] for side in ("left", "right"))
    for row in range(300, 360):
        cells = lines[row].split(",")
        for a, b in zip(left, right, strict=True):
            cells[a], cells[b] = cells[b], cells[a]
        lines[row] = ",".join(cells)
    (tmp_path / "swapped.csv").write_text("\n".join(lines) + "\n")
    answer = diagnose(load_recording(tmp_path / "swapped.csv"))
    claimed = {effect.name: effect for effect in answer.effects}
    assert claimed["body_swap"].kind == "measurement"
    assert claimed["body_swap"].parameters[0].value == pytest.approx(60, abs=3)
    assert "string_friction" in claimed
    assert answer.to_dict()["fit"]["augmented_error_m"][2] < answer.to_dict()["fit"]["base_error_m"][2]


@pytest.mark.filterwarnings("ignore::diabolo.RecordingWarning")
def test_sticks_under_each_others_names_are_claimed(plant: list[Recording], tmp_path: Path) -> None:
    swing = next(recording for recording in plant if recording.name == "swing")
    swing.save(tmp_path / "swing.csv")
    names, rows = (tmp_path / "swing.csv").read_text().split("\n", 1)
    exchanged = names.replace("left", "none").replace("right", "left").replace("none", "right")
    (tmp_path / "swing.csv").write_text(exchanged + "\n" + rows)
    swap, *others = diagnose(load_recording(tmp_path / "swing.csv")).effects
    assert swap.name == "body_swap"
    assert swap.parameters[0].value == len(swing.time)
    assert others == diagnose(swing).effects


def test_too_little_is_an_answer(played: Recording) -> None:
    short = played.cut(0, 60)
    answer = diagnose(short)
    assert answer.headline == "INSUFFICIENT_DATA"
    assert "windows" in answer.sentence
    assert answer.effects == []
    assert answer.model == Model.named("consistent")


def lost_from(recording: Recording, row: int, *tracks: str) -> Recording:
    """The recording with tracks that end at a row."""
    kept = {name: np.array(getattr(recording, name)) for name in ("left", "right", "diabolo")}
    for name in tracks:
        kept[name][row:] = np.nan
    return Recording(
        recording.time,
        *kept.values(),
        recording.rate,
        name="lost",
        properties=recording.properties,
        string_length=1.46,
    )


def test_recordings_of_other_set_ups_are_warned_of(played: Recording) -> None:
    other = Recording(
        played.time + 100.0,
        played.left,
        played.right,
        played.diabolo,
        played.rate,
        name="lighter",
        properties=DiaboloProperties.green(),
        string_length=played.string_length,
    )
    with pytest.warns(
        RecordingWarning, match="'lighter' and 'played' differ in mass .kg., 0.1415 and 0.2845"
    ) as caught:
        diagnose([played, other], bank=["string_friction"])
    assert {one.filename for one in caught} == {__file__}


def test_the_same_samples_do_not_count_twice(played: Recording) -> None:
    copy = Recording(
        played.time,
        played.left,
        played.right,
        played.diabolo,
        played.rate,
        name="copy",
        properties=played.properties,
        string_length=played.string_length,
    )
    for takes, held in (
        ([played, copy], []),
        ([played], [copy]),
        ([played, copy.cut(100, 200)], []),
        ([played.cut(0, 240)], [copy.cut(150, 400)]),
    ):
        with pytest.raises(ValueError, match=r'"played" and recording "copy" hold the same [0-9]+ samples'):
            diagnose(takes, holdout=held)
    assert diagnose([played.cut(0, 40), copy.cut(40, 80)]).headline == "INSUFFICIENT_DATA"
    with pytest.warns(diabolo.RecordingWarning, match="'copy' overlaps 'played' by 11 samples") as caught:
        diagnose([played.cut(0, 40), copy.cut(30, 80)])
    assert {one.filename for one in caught} == {__file__}


def test_a_holdout_that_shows_its_axle_judges_it(plant: list[Recording]) -> None:
    fitted, *holdout = plant
    base = diabolo.model_for("consistent", fitted)
    turning = diabolo.Model(base.parameters, gyroscopic_tilt=diabolo.GyroscopicTilt(gain=40.0))
    for held, heldout in (([], "blocks"), (holdout, "recordings")):
        for model, turns in ((base, False), (turning, True)):
            fit = diagnose(fitted, model, holdout=held, bank=["gyroscopic_tilt"]).result.fit
            assert fit.axle_heldout == heldout
            constant, alone = fit.constant_axle_error_rad, fit.base_axle_error_rad
            assert constant is not None and alone is not None
            assert (alone > 1.1 * constant) == turns
            assert turns or alone == constant


def test_the_strands_of_a_base_stay_as_they_are_without_an_axle(plant: list[Recording]) -> None:
    base = diabolo.model_for("consistent", plant[0])
    turning = diabolo.Model(base.parameters, gyroscopic_tilt=diabolo.GyroscopicTilt(gain=3.0))
    take = plant[0]
    blind = Recording(
        take.time,
        take.left,
        take.right,
        take.diabolo,
        take.rate,
        properties=take.properties,
        string_length=take.string_length,
    )
    found = diagnose(blind, turning, bank=["string_friction"])
    assert found.result.fit.axle_heldout is None
    assert found.model.finite_axle.follows_axis == 0.0


@pytest.mark.filterwarnings("ignore::diabolo.RecordingWarning")
def test_a_holdout_without_windows_is_told(played: Recording) -> None:
    other = make_recording("throw")
    unseen = lost_from(other, 5, "diabolo")
    result = diagnose(played.cut(0, 60), holdout=[other, unseen]).to_dict()
    assert result["fit"]["holdout_unused"] == ["lost"]
    assert "could be compared: lost." in report_html(result)


@pytest.mark.filterwarnings("ignore::diabolo.RecordingWarning")
def test_an_unusable_holdout_is_refused_before_the_fit(played: Recording) -> None:
    def fail(step: str, fraction: float) -> None:
        raise AssertionError(step)

    with pytest.raises(RecordingError, match='"lost"'):
        diagnose(played, holdout=lost_from(make_recording("throw"), 0, "left"), progress=fail)


def test_the_command_holds_out_rows(short: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = short.parent / "other.csv"
    make_recording("throw").save(other)
    assert main(["diagnose", str(short), "--holdout", f"{other}:0-8", f"{other}:10-200"]) == 0
    assert "without a start that could be compared: other" in capsys.readouterr().out
    assert main(["diagnose", str(other), "--holdout", f"{other}:0-80"]) == 2
    assert "(from " in (error := capsys.readouterr().err) and "hold the same 81 samples" in error


def test_bad_input_is_named(played: Recording) -> None:
    with pytest.raises(ValueError, match="recordings: none"):
        diagnose([])
    with pytest.raises(ValueError, match="expected published, paper or consistent"):
        diagnose(played, "ours")
    for change, text in (
        ({"threads": -1}, "threads: -1"),
        ({"threads": 1.5}, "threads: 1.5; expected a whole number"),
        ({"threads": 10**30}, "threads: 10"),
        ({"seed": -1}, "seed: -1; expected a whole number"),
        ({"seed": 2**70}, "seed: 11805"),
        ({"progress": 3}, "progress: 3; expected a function"),
        ({"bank": "string_friction"}, "bank: 'string_friction'; expected a list"),
        ({"base": 3}, "base: 3; expected a Model"),
        ({"recordings": "no.csv"}, "no.csv: there is no such file"),
        ({"recordings": [None]}, r"recordings\[0\]: None; expected Recording"),
        ({"recordings": 3}, "recordings: 3; expected Recording"),
        ({"holdout": "no.csv"}, "no.csv: there is no such file"),
    ):
        with pytest.raises(ValueError, match=text):
            diagnose(**{"recordings": played, **change})
    with pytest.raises(ValueError, match="budget: 0"):
        diagnose(played, budget=0.0)


def test_a_spent_budget_is_told(played: Recording) -> None:
    hurried = diagnose(played, budget=1e-6)
    assert hurried.headline == "INSUFFICIENT_DATA"
    assert "the budget of 1e-06 s is spent" in hurried.sentence
    assert hurried.model == Model.named("consistent")
    assert diagnose(played).to_dict()["not_done"] == []


def test_with_little_time_few_windows_are_fitted() -> None:
    answer = diagnose(make_recording(seconds=20.0), budget=1e-3)
    (left,) = answer.result.not_done
    assert re.fullmatch(r"fitting more than 20 of [0-9]+ windows \(beyond the budget\)", left)
    assert answer.sentence.endswith(f"Not done: {left}.")


def test_rules_that_are_numerical_are_told_from_physics() -> None:
    swing = next(path for path in plant_recordings() if path.stem == "swing")
    take = load_recording(str(swing))
    answer = diagnose(take, "published")
    names = [effect.name for effect in answer.effects]
    assert names[0] == "solver_artefact"  # before any physics
    assert 0.5 < answer.effects[0].parameters[0].value <= 1.0
    assert "string_friction" in names
    assert "solver_artefact" not in [effect.name for effect in diagnose(take).effects]


def test_the_command_writes_report_result_and_model(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    takes = [str(path) for path in plant_recordings() if path.stem in ("swing", "hop")]
    out = tmp_path / "out"
    assert main(["diagnose", *takes, "--out", str(out), "--json", str(tmp_path / "r.json")]) == 0
    text = capsys.readouterr().out
    assert "string_friction" in text
    assert {path.name for path in out.iterdir()} == {"report.html", "diagnosis.json", "model.json"}
    result: dict[str, Any] = json.loads((tmp_path / "r.json").read_text())
    assert result == json.loads((out / "diagnosis.json").read_text())
    assert [entry["file"] for entry in result["inputs"]] == [Path(take).name for take in takes]
    report = (out / "report.html").read_text()
    assert result["sentence"].split(",")[0] in report and "<iframe srcdoc=" in report


def test_a_new_process_predicts_the_same_by_the_written_model(found: Diagnosis, tmp_path: Path) -> None:
    take = next(str(path) for path in plant_recordings() if path.stem == "swing")
    file = tmp_path / "model.json"
    found.model.save(file)
    command = [sys.executable, "-m", "diabolo", "evaluate", take, f"--model={file}", "--starts=every=0.2"]
    process = subprocess.run([*command, "--json=-"], capture_output=True, text=True, check=True)
    here = evaluate(load_recording(take), found.model, starts_every=0.2).to_dict()["horizons"]
    there = json.loads(process.stdout)["horizons"]
    assert [row["mean_m"] for row in there] == [row["mean_m"] for row in here]
    assert here[0]["mean_m"] is not None


@pytest.mark.parametrize(
    ("option", "output"),
    [("--base", "out/model.json"), ("--calibration", "out/diagnosis.json"), ("--base", "base.json")],
)
def test_the_command_overwrites_no_input(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], option: str, output: str
) -> None:
    given = tmp_path / output
    given.parent.mkdir(exist_ok=True)
    kind = Model.named("consistent") if option == "--base" else Calibration.published()
    given.write_text(kind.to_json())
    before = given.read_bytes()
    take = str(plant_recordings()[0])
    out = ["--out", str(given.parent)] if given.parent != tmp_path else ["--json", str(given)]
    assert main(["diagnose", take, option, str(given), *out]) == 2
    assert f"{given}: this file is read; choose" in capsys.readouterr().err
    assert given.read_bytes() == before and list(given.parent.iterdir()) == [given]


@pytest.fixture
def short(tmp_path: Path, played: Recording) -> Path:
    """Too short to decide anything, so diagnosed at once."""
    path = tmp_path / "short.csv"
    played.cut(0, 60).save(path)
    return path


@pytest.mark.parametrize("error", [KeyboardInterrupt(), ValueError("no report")])
def test_an_end_while_writing_leaves_the_older_set(
    short: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    def fail(*_: object) -> str:
        raise error

    out = short.parent / "deep" / "out"
    assert main(["diagnose", str(short), "--out", str(out)]) == 0
    before = {path: path.read_bytes() for path in out.iterdir()}
    monkeypatch.setattr("diabolo.cli.diagnose.report_html", fail)
    assert main(["diagnose", str(short), "--seed", "2", "--out", str(out)]) != 0
    assert {path: path.read_bytes() for path in out.iterdir()} == before
    assert main(["diagnose", str(short), "--out", str(short.parent / "other" / "out")]) != 0
    assert not (short.parent / "other").exists()


@pytest.mark.parametrize(
    ("missing", "told"),
    [
        ("jinja2", "install jinja2 (pip install '.[plot]'"),
        ("plotly", "install plotly (pip install '.[plot]'"),
        ("rerun", "writing replay.rrd: needs rerun (pip install '.[rerun]'"),
    ],
)
def test_a_missing_library_is_told_before_the_work(
    short: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], missing: str, told: str
) -> None:
    monkeypatch.setattr("diabolo.cli.diagnose.run_diagnosis", None)
    monkeypatch.setitem(sys.modules, missing, None)
    assert main(["diagnose", str(short), "--rerun", "--out", str(short.parent / "out")]) == 2
    assert told in capsys.readouterr().err
    assert not (short.parent / "out").exists()


@pytest.mark.parametrize("option", ["--out /proc/diagnosis", "--json /proc/r.json", f"--json {'r' * 300}"])
def test_an_output_that_cannot_be_is_told_before_the_work(
    short: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], option: str
) -> None:
    monkeypatch.setattr("diabolo.cli.diagnose.run_diagnosis", None)
    assert main(["diagnose", str(short), *option.split()]) == 2
    error = capsys.readouterr().err
    assert option.split()[1] in error and error.count("\n") == 1


def test_the_command_writes_models_that_were_drawn(tmp_path: Path) -> None:
    out = tmp_path / "drawn"
    take = str(next(path for path in plant_recordings() if path.stem == "hop"))
    assert main(["diagnose", take, "--out", str(out), "--draws", "2"]) == 0
    names = sorted(path.name for path in out.glob("model*.json"))
    assert names == ["model-1.json", "model-2.json", "model.json"]
    assert Model.load(out / "model-1.json").name == "diagnosed 1"
    assert main(["diagnose", take, "--out", str(out)]) == 2  # the drawn ones would stay


def test_bad_input_makes_no_folder(short: Path) -> None:
    assert main(["diagnose", "nothing.csv", "--out", str(short.parent / "new" / "out")]) == 2
    assert not (short.parent / "new").exists()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["nothing.csv"], "nothing.csv: there is no such file"),
        (["TAKE", "--base", "ours"], "model ours: no such file"),
        (["TAKE", "--seed", "-1"], "--seed: -1"),
        (["TAKE", "--threads", "-1"], "--threads: -1"),
        (["TAKE", "--draws", "-1", "--out", "d"], "--draws: -1"),
        (["TAKE", "--draws", "3"], "--draws 3: expected with --out DIR, and without --simulated"),
        (["TAKE", "--rerun"], "--rerun: expected with --out DIR"),
        (["TAKE", "--budget", "nan"], "--budget: nan s"),
        (["TAKE", "--out", "TAKE"], "a file; expected a folder"),
    ],
)
def test_the_command_complains_in_one_sentence(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    take = str(next(path for path in plant_recordings() if path.stem == "hop"))
    assert main(["diagnose", *[take if word == "TAKE" else word for word in arguments]]) == 2
    error = capsys.readouterr().err
    assert complaint in error
    assert error.count("\n") == 1


@pytest.mark.filterwarnings("ignore::diabolo.RecordingWarning")
def test_friction_is_left_out_of_the_real_recordings(real_recordings: Path) -> None:
    takes = [
        diabolo.load_recording(path)
        for path in sorted((real_recordings / "2020-07-11_basic_physics").glob("*.csv"))
    ]
    answer = diagnose(takes)
    assert answer.headline in ("NAMED", "TIE")
    assert "string_friction" in {effect.name for effect in answer.effects}
    fit = answer.to_dict()["fit"]
    at = fit["horizons_s"].index(0.5)
    assert fit["augmented_error_m"][at] < 0.5 * fit["base_error_m"][at]
