# SPDX-License-Identifier: MIT
"""The report and the view in a real browser, Debian's chromium: their scripts run, their pictures show."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import diabolo
import matplotlib.colors
import matplotlib.image
import numpy as np
import pytest

BROWSER = shutil.which("chromium")
pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(BROWSER is None, reason="chromium is not installed: apt-get install chromium"),
]

RECORDINGS = Path(__file__).resolve().parents[2] / "data" / "recordings"
# What a script of the page's own can see once it has loaded, written where the DOM's text shows it.
LOOK = """<script>addEventListener("load", () => setTimeout(() => {
  const root = document.documentElement;
  const plots = [...document.querySelectorAll(".plot")];
  const replay = document.querySelector("iframe").contentDocument;
  root.dataset.drawn = plots.filter(plot => plot.querySelector(".main-svg")).length;
  root.dataset.missing = plots.filter(plot => !plot.querySelector(".main-svg")).length;
  root.dataset.overflow = Math.max(0, root.scrollWidth - innerWidth);
  const slider = replay.getElementById("time"), seen = [100, 600, 600].map(place => {
    slider.value = place;
    slider.dispatchEvent(new Event("input"));
    return replay.getElementById("scene").toDataURL();
  });
  root.dataset.moved = Number(seen[0] !== seen[1] && seen[1] === seen[2]);
  replay.getElementById("play").click();
  root.dataset.paused = Number(replay.getElementById("play").textContent === "play");
}, 1500));</script>"""
# Frames come by the clock of the page, which the browser drives, also where a busy machine paints none.
FRAMES = "<script>requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 16);</script>"


def opened(page: Path, width: int, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Opens a page without any network; ends by itself."""
    command = [
        str(BROWSER),
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--hide-scrollbars",
        "--enable-logging=stderr",
        "--host-resolver-rules=MAP * ~NOTFOUND",
        f"--user-data-dir={page.parent / 'profile'}",
        f"--window-size={width},900",
        "--virtual-time-budget=4000",
        *arguments,
        page.as_uri(),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert "CONSOLE" not in done.stderr, done.stderr
    return done


def document(page: Path, width: int) -> str:
    return opened(page, width, "--dump-dom").stdout


def colors(page: Path, width: int) -> int:
    """How many colours a picture of the page has."""
    picture = page.with_suffix(".png")
    opened(page, width, f"--screenshot={picture}")
    pixels = matplotlib.image.imread(picture)[..., :3].reshape(-1, 3)
    return len(np.unique(np.round(pixels, 2), axis=0))


def seen(dom: str, name: str) -> int:
    found = re.search(rf'data-{name}="(\d+)"', dom)
    assert found is not None, dom[:300]
    return int(found[1])


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from diabolo.report import report_html
    from diabolo.view import replay_of

    take = diabolo.load_recording(RECORDINGS / "swing.csv")
    answer = diabolo.diagnose(take)
    replays = [replay_of(take, diabolo.Model.named("consistent"), answer.model)]
    page = tmp_path_factory.mktemp("report") / "report.html"
    html = report_html(answer.to_dict(), replays=replays)
    assert len(html) < 5e6
    page.write_text(html.replace("</body>", LOOK + "</body>"), encoding="utf-8")
    return page


@pytest.mark.parametrize("width", [1280, 500])
def test_a_report_draws_its_figures_fits_the_window_and_replays(report: Path, width: int) -> None:
    dom = document(report, width)
    assert seen(dom, "drawn") >= 2
    assert seen(dom, "missing") == seen(dom, "overflow") == 0
    assert seen(dom, "moved") == 1, "the slider moves the picture"
    assert seen(dom, "paused") == 1
    assert colors(report, width) > 50


def test_a_view_plays_and_draws(tmp_path: Path) -> None:
    page = tmp_path / "view.html"
    html = diabolo.view_html(diabolo.load_recording(RECORDINGS / "throw.csv"))
    assert "<body>" in html
    page.write_text(html.replace("<body>", "<body>" + FRAMES), encoding="utf-8")
    dom = document(page, 1000)
    clock = re.search(r'id="clock">([0-9.]+) of', dom)
    assert clock is not None, dom[-500:]
    assert float(clock[1]) > 0.0, "the play does not run"
    assert colors(page, 1000) > 20


def test_a_replay_shows_each_prediction_in_its_color_beside_the_recording(tmp_path: Path) -> None:
    take = diabolo.load_recording(RECORDINGS / "puzzle_1.csv")
    beside = {
        "above": take.diabolo + np.array([0.0, 0.0, 0.3]),
        "below": take.diabolo - np.array([0.0, 0.0, 0.1]),
    }
    page = tmp_path / "replay.html"
    html = diabolo.view_html(take, predictions=beside)
    page.write_text(html.replace("<body>", "<body>" + FRAMES), encoding="utf-8")
    picture = tmp_path / "replay.png"
    opened(page, 1200, f"--screenshot={picture}")
    pixels = matplotlib.image.imread(picture)[..., :3]
    scenes = pixels[200:600, :600], pixels[200:600, 600:]
    for scene, own, other in ((scenes[0], "#e11d48", "#059669"), (scenes[1], "#059669", "#e11d48")):
        near = [
            (np.abs(scene - matplotlib.colors.to_rgb(color)).max(axis=2) < 0.02).sum()
            for color in (own, other)
        ]
        assert near[0] > 50 and near[1] == 0, near


PAGE = Path(__file__).resolve().parents[2] / "build" / "page" / "diabolo.html"
# Moves the tips up and down against each other, then lets each agent play; by frames, since the page's clock
# runs on while the browser compiles.
PLAY = """<script>
const say = (name, value) => document.documentElement.dataset[name] = Math.round(value);
let highest = 0, flew = false, before = 0;
setInterval(() => {
  if (frames === before) return;
  before = frames;
  if (frames < 125) {
    const up = 0.15 * Math.sin(frames / 10);
    [wanted.left, wanted.right] = [[0.4, 1.25 + up], [-0.4, 1.25 - up]];
  } else if (frames === 125) {
    const box = canvas.getBoundingClientRect();
    say("ratio", 100 * canvas.width / canvas.height * box.height / box.width);
    say("apart", 1000 * Math.hypot(seen[0] - seen[6], seen[1] - seen[7]));
    element("player").value = "0";
    begin();
  } else if (frames === 375) {
    say("spin", seen[3]);
    element("player").value = "1";
    begin();
  } else if (375 < frames && frames < 560) {
    flew = flew || seen[2] === 2;
    highest = Math.max(highest, seen[1]);
    say("flew", flew);
    say("highest", 100 * highest);
    say("caught", flew && seen[2] !== 2);
  }
}, 4);</script></body>"""


@pytest.mark.skipif(not PAGE.is_file(), reason="the page is not made: make page")
def test_the_page_plays_by_pointers_and_by_agents(tmp_path: Path) -> None:
    html = PAGE.read_text(encoding="utf-8")
    assert len(html) < 2e6
    assert "http" not in html.replace("http://www.w3.org", "").split("<script>")[1]  # of the page's own
    page = tmp_path / "diabolo.html"
    page.write_text(html.replace("</body>", FRAMES + PLAY), encoding="utf-8")
    done = opened(page, 1100, "--virtual-time-budget=30000", "--dump-dom").stdout
    assert seen(done, "frames") > 560
    assert seen(done, "ratio") == 100, "circles are round"
    assert seen(done, "apart") > 5, "the published rules go elsewhere"
    assert seen(done, "spin") > 90, "from 60 rad/s"
    assert seen(done, "flew") == seen(done, "caught") == 1
    assert 150 < seen(done, "highest") < 200
    assert colors(page, 1100) > 50
