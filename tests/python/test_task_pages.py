# SPDX-License-Identifier: MIT
"""The pages of the tasks are what the code says, and their pictures move."""

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("gymnasium")
pytest.importorskip("matplotlib")
from diabolo.envs import TASKS, task_infos

from docs.make_task_pages import PAGES, page_of
from docs.task_pictures import FRAMES, draw_curve, played, svg_of

ANIMATED = ".//{http://www.w3.org/2000/svg}animate"


@pytest.mark.parametrize("task", task_infos(), ids=TASKS)
def test_a_page_is_what_the_code_says(task: dict[str, Any]) -> None:
    """Else run `python -m docs.make_task_pages`."""
    assert (PAGES / f"{task['name']}.md").read_text(encoding="utf-8") == page_of(task)
    overview = (PAGES.parent / "environments.md").read_text(encoding="utf-8")
    assert f"| [{task['name']}](tasks/{task['name']}.md) | {task['meaning']} |" in overview


@pytest.mark.parametrize("task", TASKS)
def test_a_picture_moves(task: str) -> None:
    for text in ((PAGES / f"{task}.svg").read_text(encoding="utf-8"), svg_of(played(task))):
        animated = ET.fromstring(text).findall(ANIMATED)
        assert len(animated) == 3  # spin, string, diabolo
        for one in animated:
            shapes = one.attrib["values"].split(";")
            assert float(one.attrib["dur"].removesuffix("s")) == pytest.approx(len(shapes) / FRAMES)
            letters = {"".join(filter(str.isalpha, shape)) for shape in shapes}
            assert len(letters) == 1  # else nothing is interpolated
        assert len(set(animated[2].attrib["values"].split(";"))) > 5


def test_a_throw_is_seen_to_fly() -> None:
    play = played("Throw")
    assert play.flies.any() and not play.flies.all()
    assert play.diabolo[:, 1].max() > np.maximum(play.left, play.right)[:, 1].max() + 0.2


def test_a_curve_is_drawn_of_trainings(tmp_path: Path) -> None:
    for seed in range(3):
        folder = tmp_path / str(seed)
        folder.mkdir()
        rows = ["100,1,0,nan,nan", *(f"{100 * k},1,{k},{0.1 * k + seed},5" for k in range(2, 9))]
        (folder / "progress.csv").write_text("\n".join(["steps,seconds,episodes,worth,length", *rows]))
    draw_curve(tmp_path / "curve.png", [tmp_path / str(seed) for seed in range(3)])
    assert (tmp_path / "curve.png").read_bytes().startswith(b"\x89PNG")
