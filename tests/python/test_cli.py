# SPDX-License-Identifier: MIT
from __future__ import annotations

import fcntl
import json
import os
import pty
import signal
import struct
import subprocess
import sys
import termios
import time
from pathlib import Path
from typing import Any

import diabolo
import jsonschema
import numpy as np
import pytest
from conftest import Command, make_recording, motive_text
from diabolo import Recording

COMMANDS = ("demo", "evaluate", "simulate", "info", "convert")

NUMBER_OR_NULL = {"type": ["number", "null"], "minimum": 0.0}
EVALUATION_SCHEMA: dict[str, Any] = {
    "type": "object",
    "required": ["schema", "rows", "horizons"],
    "properties": {
        "schema": {"const": "diabolo.evaluation/1"},
        "rows": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["recording", "frames", "model", "mean_error_m", "baseline_m", "paper_m"],
                "properties": {
                    "recording": {"type": "string"},
                    "frames": {
                        "type": "array",
                        "items": {"type": "integer", "minimum": 0},
                        "minItems": 2,
                        "maxItems": 2,
                    },
                    "model": {"type": "string"},
                    "mean_error_m": NUMBER_OR_NULL,
                    "baseline_m": {"type": "number"},
                    "paper_m": NUMBER_OR_NULL,
                },
            },
        },
        "horizons": {
            "type": "array",
            "items": {
                "type": "object",
                "required": [
                    "recording",
                    "model",
                    "horizon_s",
                    "windows",
                    "mean_m",
                    "median_m",
                    "p90_m",
                    "ci95_m",
                ],
                "properties": {
                    "recording": {"type": "string"},
                    "model": {"type": "string"},
                    "horizon_s": {"type": "number", "exclusiveMinimum": 0.0},
                    "windows": {"type": "integer", "minimum": 0},
                    "mean_m": NUMBER_OR_NULL,
                    "median_m": NUMBER_OR_NULL,
                    "p90_m": NUMBER_OR_NULL,
                    "ci95_m": {
                        "type": ["array", "null"],
                        "items": {"type": "number"},
                        "minItems": 2,
                        "maxItems": 2,
                    },
                },
            },
        },
    },
}


@pytest.fixture
def tidy(tmp_path: Path, played: Recording) -> Path:
    path = tmp_path / "played.csv"
    played.save(path)
    return path


def json_of(text: str) -> dict[str, Any]:
    def refuse(constant: str) -> None:
        raise AssertionError(f"{constant} is not JSON")

    value = json.loads(text, parse_constant=refuse)
    assert isinstance(value, dict)
    return value


def names_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


# ---- help and version ----


def test_help_of_each_command_shows_an_example(command: Command) -> None:
    done = command("--help")
    assert done.returncode == 0 and not done.stderr
    for name in COMMANDS:
        assert name in done.stdout
        own = command(name, "--help")
        assert own.returncode == 0
        assert f"example:\n  diabolo {name}" in own.stdout


def test_version_is_the_one_of_the_package(command: Command) -> None:
    assert command("--version").stdout == f"diabolo {diabolo.__version__}\n"


# ---- evaluate ----


def test_evaluate_prints_the_table(command: Command, tidy: Path) -> None:
    done = command("evaluate", tidy, f"{tidy}:100-300", "--json", "out.json")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert lines[0].split() == ["recording", "rows", "published", "paper", "consistent", "baseline"]
    assert [line.split()[:2] for line in lines[2:4]] == [["played", "0-480"], ["played", "100-300"]]
    found = json_of((tidy.parent / "out.json").read_text())
    jsonschema.validate(found, EVALUATION_SCHEMA)
    assert [row["frames"] for row in found["rows"]] == [[0, 480]] * 3 + [[100, 300]] * 3
    printed = [float(cell) for cell in lines[2].split()[2:]]
    expected = [row["mean_error_m"] for row in found["rows"][:3]] + [found["rows"][0]["baseline_m"]]
    np.testing.assert_allclose(printed, expected, atol=5.01e-4)
    assert names_in(tidy.parent) == ["out.json", "played.csv", "played.json"]


def test_evaluate_prints_figures_of_the_paper_where_it_has_them(command: Command, tmp_path: Path) -> None:
    make_recording("hold", seconds=2.0, name="z_hop_1").cut(0, 180).save(tmp_path / "z_hop_1.csv")
    done = command("evaluate", "z_hop_1.csv", "--model", "published")
    lines = done.stdout.splitlines()
    assert lines[0].split() == ["recording", "rows", "published", "baseline", "program", "printed"]
    assert lines[2].split()[-2:] == ["0.070", "0.07"]


def test_evaluate_over_many_starts(command: Command, tidy: Path) -> None:
    options = ("--starts", "every=0.1", "--model", "consistent", "--model", "paper", "--json", "-")
    done = command("evaluate", tidy, *options)
    assert (done.returncode, done.stderr) == (0, "")
    found = json_of(done.stdout)
    jsonschema.validate(found, EVALUATION_SCHEMA)
    assert not found["rows"] and len(found["horizons"]) == 10
    for row in found["horizons"]:
        if row["ci95_m"] is not None:
            assert row["ci95_m"][0] <= row["mean_m"] <= row["ci95_m"][1]
    assert command("evaluate", tidy, *options, "--threads", "1").stdout == done.stdout
    text = command("evaluate", tidy, *options[:-2])
    assert text.stdout.splitlines()[0] == "played"
    assert "95 % interval" in text.stdout and "baseline" in text.stdout


def test_evaluate_takes_model_files_and_calibrations(
    command: Command, motive_file: Path, tmp_path: Path
) -> None:
    diabolo.Model(diabolo.Parameters(string_length=1.30), name="short", own_string_length=True).save(
        tmp_path / "short.json"
    )
    diabolo.Calibration.published().save(tmp_path / "calibration.json")
    done = command(
        "evaluate", motive_file, "--model", "short.json", "--calibration", "calibration.json", "--json", "-"
    )
    (row,) = json_of(done.stdout)["rows"]
    assert row["model"] == "short" and row["mean_error_m"] > 0.05


@pytest.mark.parametrize("starts", ["first", "every=0.2"])
@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_evaluate_draws(command: Command, tidy: Path, starts: str, ending: str) -> None:
    pytest.importorskip("matplotlib")
    plot = tidy.with_name(f"errors.{ending}")
    done = command("evaluate", tidy, f"{tidy}:0-200", "--starts", starts, "--plot", plot)
    assert (done.returncode, done.stderr) == (0, "")
    beginning = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}[ending]
    assert plot.read_bytes().startswith(beginning) and plot.stat().st_size > 5000
    assert names_in(tidy.parent) == sorted([plot.name, "played.csv", "played.json"])


# ---- the other commands ----


def test_convert_then_evaluate_is_the_same(command: Command, motive_file: Path, tmp_path: Path) -> None:
    done = command("convert", motive_file, "tidy.csv", "--json", "-")
    assert done.returncode == 0
    assert json_of(done.stdout)["samples"] == 481
    results = [
        json_of(command("evaluate", path, "--model", "published", "--json", "-").stdout)["rows"][0]
        for path in (motive_file, "tidy.csv")
    ]
    assert results[0]["mean_error_m"] == pytest.approx(results[1]["mean_error_m"], rel=1e-9)
    assert results[0]["recording"] == "take" and results[1]["recording"] == "tidy"


def test_info_tells_what_is_there(command: Command, played: Recording, tmp_path: Path) -> None:
    diabolo_track = played.diabolo.copy()
    diabolo_track[10:13] = np.nan
    diabolo_track[-1] = np.nan
    holes = Recording(
        played.time,
        played.left,
        played.right,
        diabolo_track,
        120.0,
        diabolo_orientation=played.diabolo_orientation,
    )
    (tmp_path / "holes.csv").write_text(motive_text(holes))
    found = json_of(command("info", "holes.csv", "--json").stdout)
    bodies = {body["name"]: body for body in found["bodies"]}
    assert (found["schema"], found["format"], found["samples"]) == ("diabolo.info/1", "motive", 481)
    assert found["duration_s"] == pytest.approx(4.0) and found["rate_hz"] == 120.0
    assert bodies["diabolo_red"]["dropouts"] == 4
    assert bodies["diabolo_red"]["longest_gap_s"] == pytest.approx(3 / 120)
    assert bodies["stick_left"]["dropouts"] == 0
    assert found["spin_rad_s"]["max"] == pytest.approx(100.0, abs=0.01)
    part = json_of(command("info", "holes.csv:5-20", "--json").stdout)
    assert (part["samples"], part["bodies"][0]["samples"]) == (16, 16) and part[
        "duration_s"
    ] == pytest.approx(0.125)
    assert {body["name"]: body["dropouts"] for body in part["bodies"]}["diabolo_red"] == 3
    refused = command("info", "holes.csv:5-481")
    assert refused.returncode == 2 and "rows 5 to 481; expected rows from 0 to 480" in refused.stderr
    text = command("info", "holes.csv")
    assert "Motive export, 481 samples at 120 Hz, 4.00 s" in text.stdout
    assert "diabolo_red" in text.stdout and "spin: " in text.stdout


def test_a_gap_is_as_long_as_the_time_in_which_nothing_was_seen(
    command: Command, played: Recording, tmp_path: Path
) -> None:
    kept = np.r_[0:100, 160 : len(played)]
    diabolo = played.diabolo[kept]
    diabolo[100] = np.nan
    rows = Recording(played.time[kept], played.left[kept], played.right[kept], diabolo, 120.0)
    rows.save(tmp_path / "rows.csv")
    found = json_of(command("info", "rows.csv", "--json").stdout)
    gaps = {body["name"]: body["longest_gap_s"] for body in found["bodies"]}
    assert gaps == pytest.approx({"left": 60 / 120, "right": 60 / 120, "diabolo": 61 / 120})


def test_calibrations_of_the_authors_go_by_name(command: Command, motive_file: Path) -> None:
    published = command("info", motive_file, "--calibration", "published")
    assert published.stdout == command("info", motive_file).stdout
    blue = command("info", motive_file, "--calibration", "blue")
    assert 'the calibration is of "diabolo_blue_2020_10"' in blue.stdout


def test_info_reads_takes_that_the_calibration_does_not_fit(command: Command, motive_file: Path) -> None:
    motive_file.write_text(motive_file.read_text().replace("stick_left", "stick_lost"))
    done = command("info", motive_file)
    assert done.returncode == 0
    assert (
        "stick_lost" in done.stdout and "No tips and no spin: no rigid body for the left stick" in done.stdout
    )
    assert json_of(command("info", motive_file, "--json").stdout)["spin_rad_s"] is None
    assert "nothing odd" not in done.stdout


@pytest.mark.parametrize(
    ("hidden", "sentence"),
    [
        (slice(None), "not seen in 100.0 % of the samples, for up to 4.008 s at a time"),
        (slice(100, 300), "not seen in 41.6 % of the samples, for up to 1.667 s at a time"),
        (slice(None, None, 2), "not seen in 50.1 % of the samples, for up to 0.008 s at a time"),
    ],
)
def test_info_tells_of_a_body_that_is_hardly_seen(
    command: Command, played: Recording, tmp_path: Path, hidden: slice, sentence: str
) -> None:
    track = played.diabolo.copy()
    track[hidden] = np.nan
    Recording(played.time, played.left, played.right, track, played.rate).save(tmp_path / "holes.csv")
    shown = command("info", "holes.csv").stdout
    assert f"odd: diabolo: {sentence}\n" in shown and "nothing odd" not in shown


@pytest.mark.parametrize(
    "line",
    ["evaluate TIDY --plot e.png", "evaluate TIDY --starts every=0.5 --plot e.png", "view TIDY --out v.html"],
)
def test_each_warning_is_printed_once(command: Command, tidy: Path, line: str) -> None:
    pytest.importorskip("matplotlib")
    odd = Recording.load(tidy)
    Recording(
        odd.time, odd.left, odd.right, odd.diabolo, odd.rate, properties=odd.properties, string_length=3.0
    ).save(tidy)
    done = command(*line.replace("TIDY", str(tidy)).split())
    assert done.returncode == 0 and done.stderr.count("diabolo: warning: played: ") == 1


@pytest.mark.parametrize("rows", ["-1-5", "a-b", "3", "3-", "", "0-99999999999"])
def test_rows_that_are_none_are_told(command: Command, tidy: Path, rows: str) -> None:
    done = command("evaluate", f"{tidy}:{rows}")
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        done.stderr == f"diabolo: {tidy}:{rows}: '{rows}'; expected the rows FIRST-LAST, as in {tidy}:0-180\n"
    )


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("arguments", ["--help", "--version", "view --help"])
def test_help_that_cannot_be_printed_is_told(arguments: str, unbuffered: str) -> None:
    done = subprocess.run(
        f"{sys.executable} -m diabolo {arguments} > /dev/full",
        shell=True,
        env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert (done.returncode, done.stderr) == (2, "diabolo: standard output: No space left on device\n")


def test_matplotlib_says_nothing_of_its_own(command: Command, tidy: Path) -> None:
    pytest.importorskip("matplotlib")
    homeless = {"HOME": "/proc/home", "MPLCONFIGDIR": "", "XDG_CONFIG_HOME": "", "XDG_CACHE_HOME": ""}
    done = command("evaluate", tidy, "--plot", "errors.png", env=homeless)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_warning_that_cannot_be_printed_loses_nothing(tidy: Path) -> None:
    played = Recording.load(tidy)
    odd = Recording(played.time, played.left, played.right, played.diabolo, played.rate, string_length=3.0)
    odd.save(tidy.with_name("odd.csv"))
    command = f"{sys.executable} -m diabolo evaluate odd.csv --model paper --json odd.out 2> /dev/full"
    done = subprocess.run(
        command, shell=True, cwd=tidy.parent, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0 and "paper" in done.stdout
    assert json_of(tidy.with_name("odd.out").read_text())["rows"]


@pytest.mark.parametrize("motion", ["hold", "swing", "beat", "throw"])
def test_simulate_writes_a_recording(command: Command, tmp_path: Path, motion: str) -> None:
    done = command("simulate", "out.csv", "--motion", motion, "--duration", "3", "--spin", "80")
    assert (done.returncode, done.stderr) == (0, "")
    played = Recording.load(tmp_path / "out.csv")
    assert len(played) == 361 and played.diabolo_valid.all()
    # The mean between the first two samples, as the string drives the spin by 0.15 1/s.
    assert played.spin()[0] == pytest.approx(80.0 * np.exp(-0.15 / 240.0), abs=1e-3)
    flew = np.any(played.diabolo[:, 2] > 1.0)
    assert flew == (motion == "throw")
    assert names_in(tmp_path) == ["out.csv", "out.json"]


def test_simulate_on_a_recording_gives_its_prediction(command: Command, tidy: Path) -> None:
    done = command("simulate", "out.csv", "--on", f"{tidy}:60-300", "--model", "published", "--json", "-")
    assert json_of(done.stdout)["model"] == "published"
    out, take = Recording.load(tidy.with_name("out.csv")), Recording.load(tidy).cut(60, 300)
    np.testing.assert_array_equal(out.left, take.left)
    np.testing.assert_array_equal(out.diabolo, diabolo.predict(take, "published").states[:, :3])


# ---- everything that goes wrong ----


@pytest.mark.parametrize(
    "arguments",
    [
        ("convert", "feet.csv", "out.csv"),
        ("evaluate", "feet.csv", "--model", "paper"),
        ("evaluate", "feet.csv", "feet.csv:0-479", "--model", "paper"),
        ("evaluate", "feet.csv", "--starts", "every=0.5", "--model", "paper"),
        ("simulate", "out.csv", "--on", "feet.csv"),
        ("view", "feet.csv", "--model", "paper", "--out", "out.html"),
        ("diagnose", "feet.csv"),
        ("plan", "stop", "--recording", "feet.csv"),
    ],
    ids=lambda arguments: " ".join(arguments),
)
def test_a_recording_that_is_odd_is_warned_of(
    command: Command, played: Recording, tmp_path: Path, arguments: tuple[str, ...]
) -> None:
    feet = Recording(
        played.time,
        *(track / 0.3048 for track in (played.left, played.right, played.diabolo)),
        played.rate,
        properties=played.properties,
        string_length=1.46,
    )
    feet.save(tmp_path / "feet.csv")
    done = command(*arguments)
    assert done.returncode == 0
    assert done.stderr.startswith(
        "diabolo: warning: feet: the path from tip to tip over the diabolo is mostly"
    )
    assert done.stderr.endswith("another string, or a diabolo that lies elsewhere\n")
    assert done.stderr.count("\n") == 1
    assert "odd: the path" in command("info", "feet.csv").stdout


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((), "the following arguments are required: COMMAND"),
        (("juggle",), "invalid choice: 'juggle'"),
        (("evaluate",), "the following arguments are required: RECORDING"),
        (
            ("plan", "hop", "--height", "0.6"),
            "diabolo plan: unrecognized arguments: --height 0.6; see diabolo plan",
        ),
        (("info", "played.csv", "more.csv"), "unrecognized arguments: more.csv; see diabolo info --help"),
        (("evaluate", "no.csv"), "no.csv: there is no such file"),
        (("evaluate", "."), ".: a directory; expected a file"),
        (("evaluate", "played.csv:0-481"), "rows 0 to 481; expected 0 <= first <= last < 481"),
        (("evaluate", "played.csv:9-3"), "rows 9 to 3"),
        (("evaluate", "played.csv:0-3", "--starts", "every=0.1"), "played.csv:0-3: no start to predict from"),
        (
            ("evaluate", "played.csv", "--model", "ours"),
            "model ours: no such file; expected published, paper",
        ),
        (("evaluate", "played.csv", "--model", "paper", "--model", "paper"), "models: two are named 'paper'"),
        (("evaluate", "played.csv", "--model", "played.json"), "played.json: "),
        (("evaluate", "played.csv", "--starts", "often"), "--starts often: expected first, or every=SECONDS"),
        (("evaluate", "played.csv", "--starts", "every=0"), "--starts every=0: expected"),
        (("evaluate", "played.csv", "--starts", "every=nan"), "--starts every=nan: expected"),
        (("evaluate", "played.csv", "--starts", "every=1e-9"), "--starts every=1e-9: expected"),
        (("evaluate", "played.csv", "--threads", "-1"), "--threads: -1; expected a whole number from 0"),
        (("evaluate", "played.csv", "--threads", "many"), "invalid int value: 'many'"),
        (("evaluate", "played.csv", "--seed", "-1"), "--seed: -1; expected a whole number from 0"),
        (("evaluate", "played.csv", "--json", "no/out.json"), "no/out.json: there is no folder"),
        (("evaluate", "played.csv", "--json", "."), ".: a directory; expected the name of a file"),
        (("evaluate", "played.csv", "--json", "/dev/null"), "/dev/null: a device or a pipe; expected a file"),
        (("evaluate", "played.csv", "--json", "played.csv"), "played.csv: this file is read; choose"),
        (("evaluate", "played.csv", "--json", "played.json"), "played.json: this file is read; choose"),
        (("evaluate", "played.csv:0-60", "--json", "played.csv:0-60"), "played.csv:0-60: this file is read"),
        (("info", "played.csv", "--json", "played.json"), "played.json: this file is read; choose"),
        (
            ("evaluate", "played.csv", "played.csv"),
            "recordings: played.csv and played.csv hold the same 481 samples",
        ),
        (("evaluate", "nowhere.csv:0-180"), "nowhere.csv: there is no such file"),
        (
            ("evaluate", "played.csv", "--seed", str(10**20)),
            f"--seed: {10**20}; expected a whole number from 0",
        ),
        (("evaluate", "played.csv", "--plot", "out.doc"), "out.doc: expected a name that ends in .png"),
        (
            ("evaluate", "played.csv", "--json", "a.png", "--plot", "a.png"),
            "a.png: another output has this name; choose",
        ),
        (("evaluate", "played.csv", "--calibration", "no.json"), "no.json: there is no such file"),
        (("evaluate", "played.csv:0-1"), "no row to compare"),
        (("info", "no.csv"), "no.csv: No such file or directory"),
        (("info", "played.json"), "played.json, line 1: "),
        (("info", "played.csv", "--calibration", "played.json"), "played.json: "),
        (("convert", "played.csv", "out.txt"), "out.txt: expected a name that ends in .csv"),
        (("convert", "played.csv", "played.csv"), "played.csv: this file is read; choose"),
        (("convert", "played.csv"), "the following arguments are required: OUT"),
        (("convert", "no.csv", "out.csv"), "no.csv: there is no such file"),
        (("convert", "played.csv", "no/out.csv"), "out.csv: there is no folder"),
        (("simulate", "out.csv"), "one of the arguments --on --motion --live is required"),
        (("simulate", "out.csv", "--motion", "fly"), "invalid choice: 'fly'"),
        (("simulate", "out.csv", "--motion", "hold", "--duration", "-1"), "duration: -1.0 s"),
        (("simulate", "out.csv", "--motion", "hold", "--duration", "nan"), "duration: nan s"),
        (
            ("simulate", "out.csv", "--motion", "hold", "--spin", "inf"),
            "--spin inf: expected less than 377 rad/s",
        ),
        (
            ("simulate", "out.csv", "--motion", "hold", "--spin", "-400"),
            "--spin -400: expected less than 377",
        ),
        (("simulate", "-", "--on", "played.csv"), "'-'; expected a name; standard output is for --json only"),
        (("demo", "--out", ""), "''; expected a name"),
        (("convert", "pl\udce9.csv", "out.csv"), "'pl\\udce9.csv': not UTF-8"),
        (
            ("simulate", "out.csv", "--on", "played.csv", "--spin", "1"),
            "--duration and --spin belong to --motion",
        ),
        (("simulate", "played.csv", "--on", "played.csv"), "played.csv: this file is read; choose"),
        (("demo", "--out", "played.csv"), "played.csv: a file; expected a folder"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_a_sentence_says_what_is_wrong(
    command: Command, tidy: Path, arguments: tuple[str, ...], text: str
) -> None:
    before = {path: path.read_bytes() for path in tidy.parent.iterdir()}
    done = command(*arguments)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("diabolo") and done.stderr.count("\n") == 1
    assert text in done.stderr
    assert {path: path.read_bytes() for path in tidy.parent.iterdir()} == before


@pytest.mark.parametrize(
    ("library", "arguments"),
    [("matplotlib", ("evaluate", "played.csv", "--plot", "out.png")), ("plotly", ("demo",))],
)
def test_without_its_library_a_sentence_says_so(
    command: Command, tidy: Path, library: str, arguments: tuple[str, ...]
) -> None:
    (tidy.parent / f"{library}.py").write_text(f"raise ModuleNotFoundError(name='{library}')\n")
    done = command(*arguments, env={"PYTHONPATH": f"{tidy.parent}:{os.environ.get('PYTHONPATH', '')}"})
    assert done.returncode == 2
    assert f"install {library} (pip install '.[plot]' in the project's root)" in done.stderr
    assert not (tidy.parent / "out.png").exists()


def test_importing_the_package_needs_numpy_only() -> None:
    text = (
        "import sys; old = set(sys.modules); import diabolo; "
        "print(sorted({m.partition('.')[0] for m in set(sys.modules) - old} - sys.stdlib_module_names))"
    )
    done = subprocess.run([sys.executable, "-W", "error", "-c", text], capture_output=True, text=True)
    assert done.stdout.strip() in ("['diabolo', 'numpy']", "['diabolo']"), done.stdout + done.stderr


def test_a_full_disk_leaves_nothing_half_written(tidy: Path) -> None:
    limit = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100)); "
    ignore = "import signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
    for arguments in (["evaluate", "played.csv", "--json", "out.json"], ["convert", "played.csv", "out.csv"]):
        text = f"{limit}{ignore}import sys; from diabolo.cli import main; sys.exit(main({arguments}))"
        done = subprocess.run([sys.executable, "-c", text], cwd=tidy.parent, capture_output=True, text=True)
        assert done.returncode == 2 and "cannot be written" in done.stderr
        assert names_in(tidy.parent) == ["played.csv", "played.json"]


def test_a_closed_pipe_is_no_error(tidy: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "diabolo", "evaluate", tidy], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert process.stdout is not None and process.stderr is not None
    process.stdout.close()
    assert process.stderr.read() == b""
    process.stderr.close()
    assert process.wait() == 0


@pytest.mark.parametrize(
    ("redirection", "complaint"),
    [(">&-", "standard output is closed"), ("> /dev/full", "standard output: No space left on device")],
)
def test_output_that_cannot_be_printed_is_told(tidy: Path, redirection: str, complaint: str) -> None:
    done = subprocess.run(
        ["sh", "-c", f'"{sys.executable}" -m diabolo info "{tidy}" {redirection}'],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert complaint in done.stderr and done.stderr.count("\n") == 1


def test_it_works_without_standard_error(tidy: Path) -> None:
    done = subprocess.run(
        ["sh", "-c", f'"{sys.executable}" -m diabolo evaluate "{tidy}" 2>&-'], capture_output=True, text=True
    )
    assert done.returncode == 0 and "consistent" in done.stdout


def let_it_run(process: subprocess.Popen[Any]) -> None:
    """Waits until the command, once loaded, catches SIGTERM, and lets it work for a while."""
    status = Path(f"/proc/{process.pid}/status")
    for _ in range(600):
        caught = next(line for line in status.read_text().splitlines() if line.startswith("SigCgt:"))
        if int(caught.split()[1], 16) >> (signal.SIGTERM - 1) & 1:
            break
        time.sleep(0.1)
    time.sleep(2.0)


def long_evaluation(tidy: Path) -> list[str | Path]:
    """Takes far longer than a test would wait: many excerpts at many starts."""
    options = ["--starts", "every=0.001", "--json", "out.json", "--plot", "out.png"]
    excerpts = [f"{tidy}:0-{480 - i}" for i in range(60)]
    return [sys.executable, "-m", "diabolo", "evaluate", *excerpts, *options]


def test_a_link_that_leads_to_itself_is_told(tmp_path: Path, command: Command) -> None:
    loop = tmp_path / "loop.csv"
    loop.symlink_to(loop)
    done = command("view", str(loop), "--out", str(tmp_path / "v.html"))
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "loop.csv" in done.stderr


def test_outputs_go_where_links_lead(tmp_path: Path, command: Command) -> None:
    (tmp_path / "there").mkdir()
    page, take, loop, nowhere = (
        tmp_path / name for name in ("page.html", "take.csv", "loop.html", "no.html")
    )
    page.symlink_to("there/page.html")  # of which there is none yet
    take.symlink_to("there/take.csv")
    loop.symlink_to(loop)
    nowhere.symlink_to("nowhere/page.html")
    done = command("plan", "hop", "--out", str(take), "--html", str(page))
    assert done.returncode == 0, done.stderr
    assert page.is_symlink() and take.is_symlink()
    assert (tmp_path / "there" / "page.html").read_text().startswith("<!DOCTYPE html>")
    assert (tmp_path / "there" / "take.csv").read_text().startswith("time,")
    assert command("view", str(take), "--out", str(page)).returncode == 0
    for wrong, said in ((loop, "leads to itself"), (nowhere, "there is no folder")):
        done = command("plan", "hop", "--html", str(wrong))
        assert (done.returncode, done.stderr.count("\n")) == (2, 1)
        assert f"{wrong.name}: " in done.stderr and said in done.stderr
    assert sorted(path.name for path in (tmp_path / "there").iterdir()) == ["page.html", "take.csv"]


def test_ctrl_c_stops_it_and_leaves_nothing(tidy: Path) -> None:
    process = subprocess.Popen(
        long_evaluation(tidy), cwd=tidy.parent, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    let_it_run(process)
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=20)
    assert (process.returncode, output, errors) == (130, "", "diabolo: interrupted\n")
    assert names_in(tidy.parent) == ["played.csv", "played.json"]


def test_the_progress_bar_is_for_terminals(tidy: Path) -> None:
    watching, terminal = pty.openpty()
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    process = subprocess.Popen(
        long_evaluation(tidy), cwd=tidy.parent, stdout=subprocess.DEVNULL, stderr=terminal
    )
    let_it_run(process)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=20) == 130
    os.close(terminal)
    shown = os.read(watching, 100_000).decode()
    os.close(watching)
    assert "evaluating" in shown and "%" in shown


@pytest.mark.parametrize(
    "line", ["diagnose TAKE", "evaluate TAKE", "motion TAKE m.csv", "simulate out.csv --on TAKE"]
)
@pytest.mark.parametrize(
    ("body", "shown"), [("left", "left tip"), ("right", "right tip"), ("diabolo", "diabolo")]
)
def test_a_body_that_is_never_seen_is_told_with_the_file(
    command: Command, played: Recording, tmp_path: Path, line: str, body: str, shown: str
) -> None:
    if body == "diabolo" and line.split()[0] in ("motion", "simulate"):
        pytest.skip("the tips are enough")
    tracks = {name: getattr(played, name).copy() for name in ("left", "right", "diabolo")}
    tracks[body][:] = np.nan
    setup = {"properties": played.properties, "string_length": played.string_length}
    Recording(played.time, rate=played.rate, **tracks, **setup).save(tmp_path / "empty.csv")
    done = command(*line.replace("TAKE", "empty.csv").split())
    assert done.returncode == 2
    assert done.stderr == f"diabolo: empty.csv: the {shown} is never seen; expected its positions\n"


# ---- how it ends ----


@pytest.mark.parametrize(
    "arguments",
    [
        ("plan", "hop", "--goal=--"),
        ("plan", "hop", "--spin=--"),
        ("evaluate", "played.csv", "--starts=--"),
        ("simulate", "out.csv", "--motion=--"),
        ("demo", "--out=--"),
        ("info", "played.csv", "--json=--"),
    ],
    ids=" ".join,
)
def test_an_option_without_its_value_is_told(
    command: Command, tidy: Path, arguments: tuple[str, ...]
) -> None:
    done = command(*arguments)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert f"{arguments[-1]}: expected a value" in done.stderr
    assert names_in(tidy.parent) == ["played.csv", "played.json"]


@pytest.mark.parametrize("spin", ["-1e5", "-1E+5", "-.4e6", "-inf"])
def test_a_negative_number_with_an_exponent_is_no_option(command: Command, spin: str) -> None:
    done = command("simulate", "out.csv", "--motion", "hold", "--spin", spin)
    assert done.returncode == 2 and f"--spin {float(spin):g}: expected less than 377" in done.stderr
    done = command("simulate", "out.csv", "--motion", "hold", "--duration", "0.5", "--spin", "-1e2")
    assert done.returncode == 0


@pytest.mark.parametrize(
    ("error", "said"),
    [("MemoryError", "out of memory"), ("RecursionError('deep')", "nested too deeply")],
)
def test_what_the_machine_lacks_is_told_in_a_sentence(tmp_path: Path, error: str, said: str) -> None:
    text = (
        "import sys, diabolo.cli.info as info\n"
        "def run(arguments): raise " + error + "\n"
        "info.run = run\n"
        "from diabolo.cli import main; sys.exit(main(['info', 'take.csv']))"
    )
    done = subprocess.run([sys.executable, "-c", text], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert said in done.stderr


def test_too_little_memory_is_told_in_a_sentence(tidy: Path) -> None:
    limit = (
        "import resource, sys, diabolo.cli\n"
        "used = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()\n"
        "resource.setrlimit(resource.RLIMIT_AS, (used + (20 << 20), resource.RLIM_INFINITY))\n"
        "sys.exit(diabolo.cli.main(['simulate', 'out.csv', '--motion', 'swing', '--duration', '3000']))"
    )
    done = subprocess.run([sys.executable, "-c", limit], cwd=tidy.parent, capture_output=True, text=True)
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith("diabolo: out of memory") and done.stderr.count("\n") == 1
    assert names_in(tidy.parent) == ["played.csv", "played.json"]


def test_sigterm_stops_it_and_leaves_nothing(tidy: Path) -> None:
    process = subprocess.Popen(
        long_evaluation(tidy), cwd=tidy.parent, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    let_it_run(process)
    process.send_signal(signal.SIGTERM)
    output, errors = process.communicate(timeout=20)
    assert (process.returncode, output, errors) == (143, "", "diabolo: terminated\n")
    assert names_in(tidy.parent) == ["played.csv", "played.json"]


def test_sigterm_while_a_file_is_written_leaves_nothing(tidy: Path) -> None:
    text = (
        "import os, signal, sys, diabolo.cli.convert as convert\n"
        "from diabolo import files\nfrom diabolo.cli import main\n"
        "def run(arguments):\n"
        "    with files.whole_file('new/out.csv') as temporary:\n"
        "        temporary.write_text('half')\n"
        "        os.kill(os.getpid(), signal.SIGTERM)\n"
        "        os.kill(os.getpid(), signal.SIGTERM)\n"
        "convert.run = run\n"
        "os.mkdir('new')\n"
        "sys.exit(main(['convert', 'played.csv', 'out.csv']))"
    )
    done = subprocess.run([sys.executable, "-c", text], cwd=tidy.parent, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (143, "diabolo: terminated\n")
    assert names_in(tidy.parent / "new") == []


@pytest.mark.parametrize("start", [("-m", "diabolo"), ("diabolo",)], ids=" ".join)
def test_ctrl_c_while_it_loads_shows_no_traceback(tmp_path: Path, start: tuple[str, ...]) -> None:
    (tmp_path / "numpy.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n")
    (tmp_path / "diabolo").write_text("from diabolo.cli import main\n")
    path = f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}"
    done = subprocess.run(
        [sys.executable, *start],
        cwd=tmp_path.parent if start[0] == "-m" else tmp_path,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_importing_the_package_leaves_ctrl_c_alone() -> None:
    text = "import signal, diabolo; print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)"
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)
    assert done.stdout == "True\n"
