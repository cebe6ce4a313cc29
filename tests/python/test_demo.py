# SPDX-License-Identifier: MIT
from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import diabolo
import pytest
from conftest import Command
from diabolo.cli import demo

DATA = Path(__file__).parents[2] / "data" / "recordings"
CONCEALED = {"string_friction", "air_drag_quadratic", "gravity_tilt"}


@pytest.fixture(scope="module")
def shown(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """What the demo prints to a terminal that is none, and its folder."""
    pytest.importorskip("plotly")
    folder = tmp_path_factory.mktemp("demo")
    command = [
        sys.executable,
        "-W",
        "error",
        "-m",
        "diabolo",
        "demo",
        "--out",
        "shown",
        "--json",
        "demo.json",
    ]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout, folder


def test_the_package_brings_recordings_of_the_project_and_their_keys() -> None:
    paths = demo.packaged_recordings()
    assert [path.stem for path in paths] == ["puzzle_1", "puzzle_2"]
    for path in paths:
        assert path.read_bytes() == (DATA / path.name).read_bytes()
        assert set(demo.concealed_in(path)) == CONCEALED
        assert diabolo.load_recording(path).diabolo_valid.mean() > 0.9


def test_the_demo_finds_what_is_concealed_and_nothing_else(shown: tuple[str, Path]) -> None:
    found = json.loads((shown[1] / "demo.json").read_text())
    assert found["headline"] == "NAMED"
    assert set(found["found"]) == set(found["concealed"]) == CONCEALED
    for name, parameters in found["found"].items():
        leading = parameters[0]
        truth = found["concealed"][name][leading["name"]]
        low, high = leading["ci90"]
        assert low <= truth <= high and high - low < 0.2 * truth


def test_the_fit_improves_on_data_left_out(shown: tuple[str, Path]) -> None:
    found = json.loads((shown[1] / "demo.json").read_text())
    assert found["heldout"] == "recordings"
    errors = zip(found["horizons_s"], found["base_error_m"], found["augmented_error_m"], strict=True)
    for horizon, before, after in errors:
        assert after < 0.3 * before
        assert horizon < 0.5 or after < 0.1 * before


def test_the_demo_says_what_was_found_beside_what_was_concealed(shown: tuple[str, Path]) -> None:
    text, folder = shown
    assert "\033" not in text, "colours are for terminals"
    friction = next(line for line in text.splitlines() if "Friction between string and axle" in line)
    assert "0.17 " in friction and "along the string" in friction
    assert "not found" not in text and "nothing" not in text
    for name in ("report.html", "replay.html"):
        assert f"shown/{name}" in text
    names = sorted(path.name for path in (folder / "shown").iterdir())
    assert names == ["diagnosis.json", "model.json", "replay.html", "report.html"]
    replay = (folder / "shown" / "replay.html").read_text()
    assert '{"name":"base"' in replay and '{"name":"corrected"' in replay


class AskedError(Exception):
    """Raised in place of a diagnosis."""


def test_no_key_is_read_before_the_answer(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pytest.importorskip("plotly")
    read: list[str] = []
    plain, opened = Path.read_text, Path.open

    def diagnose(takes: list[diabolo.Recording], base: str, **_: Any) -> None:
        assert [take.name for take in takes] == ["puzzle_1", "puzzle_2"]
        raise AskedError

    def read_text(self: Path, *arguments: Any, **options: Any) -> str:
        read.append(self.name)
        return plain(self, *arguments, **options)

    def open_(self: Path, *arguments: Any, **options: Any) -> Any:
        read.append(self.name)
        return opened(self, *arguments, **options)

    monkeypatch.setattr(demo, "diagnose", diagnose)
    monkeypatch.setattr(Path, "read_text", read_text)
    monkeypatch.setattr(Path, "open", open_)
    monkeypatch.chdir(tmp_path)
    parser = demo.argparse.ArgumentParser()
    demo.add_parser(parser.add_subparsers())
    with pytest.raises(AskedError):
        demo.run(parser.parse_args(["demo"]))
    assert not [name for name in read if name.endswith(".key.json")]
    demo.concealed_in(demo.packaged_recordings()[0])
    assert "puzzle_1.key.json" in read, "this test would not notice"


def effect(name: str, value: float, interval: list[float]) -> dict[str, Any]:
    return {
        "name": name,
        "kind": "physics",
        "parameters": [{"name": "coefficient", "value": value, "unit": "1", "ci90": interval}],
        "where": {
            "modes": ["ON_STRING"],
            "direction": "string_tangent",
            "intervals": [[0.0, 2.0], [3.0, 4.0]],
        },
    }


def test_what_is_missed_invented_or_outside_its_interval_is_shown_as_that() -> None:
    found = [effect("string_friction", 0.2, [0.19, 0.21]), effect("magnus_lift", 1e-3, [0.5e-3, 1.5e-3])]
    truth = {"string_friction": {"coefficient": 0.3}, "axle_drag": {"rate": 2.0}}
    rows = demo.found_rows({"effects": found}, truth, 5.0)
    assert [color for _, color in rows] == [demo.YELLOW, demo.RED, demo.RED]
    assert [cells[2] for cells, _ in rows] == ["0.3", "nothing", "2"]
    assert rows[0][0][3] == "along the string, in 3 of 5 s"
    assert rows[2][0][1] == "not found"
    assert demo.color_of([0.25, 0.35], 0.3) == demo.GREEN


def test_colours_are_for_terminals_that_want_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert demo.Painter.of_terminal()("words", demo.RED) == "\033[31mwords\033[0m"
    monkeypatch.setenv("NO_COLOR", "1")
    assert demo.Painter.of_terminal()("words", demo.RED) == "words"
    monkeypatch.delenv("NO_COLOR")
    monkeypatch.setattr(sys.stdout, "isatty", lambda: False, raising=False)
    assert demo.Painter.of_terminal()("words", demo.RED) == "words"


def test_a_view_shows_predictions_that_begin_again(command: Command, tmp_path: Path) -> None:
    take = DATA / "puzzle_1.csv"
    shown = command("view", f"{take}:0-359", "--model", "consistent", "--model", "published", "--every", "1",
                    "--out", "v.html")  # fmt: skip
    assert (shown.returncode, shown.stderr) == (0, "")
    text = (tmp_path / "v.html").read_text().split("const data = ")[1].split(";\n")[0]
    data = json.loads(text)
    assert [prediction["name"] for prediction in data["predictions"]] == ["consistent", "published"]
    recorded, predicted = data["diabolo"], data["predictions"][0]["positions"]
    errors = [
        sum((a - b) ** 2 for a, b in zip(p, q, strict=True)) ** 0.5
        for p, q in zip(recorded, predicted, strict=True)
        if p[0] is not None and q[0] is not None
    ]
    assert max(errors) > 0.08, "a second ahead the base is off"
    begun = [i for i in range(1, len(errors)) if errors[i] < 0.01 < 0.05 < errors[i - 1]]
    assert len(begun) == 2, "three predictions of a second each"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--every", "1"), "--every: there is no prediction to begin again"),
        (("--every", "0", "--model", "paper"), "--every: 0.0 s; expected more than 0"),
        (("--model", "paper", "--model", "paper"), "another model is named 'paper' too"),
    ],
)
def test_a_view_refuses_what_it_cannot_show(command: Command, arguments: tuple[str, ...], said: str) -> None:
    done = command("view", DATA / "puzzle_1.csv", *arguments, "--out", "v.html")
    assert done.returncode == 2 and said in done.stderr


def test_a_view_refuses_predictions_of_other_rows() -> None:
    take = diabolo.load_recording(DATA / "puzzle_1.csv")
    with pytest.raises(ValueError, match=r"prediction 'mine': shape \(3, 3\); expected \(1264, 3\), or \(12"):
        diabolo.view_html(take, predictions={"mine": take.diabolo[:3]})
