# SPDX-License-Identifier: MIT
"""The pages in a real browser, Debian's chromium: their scripts run, their pictures show."""

from __future__ import annotations

import math
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import diabolo
import matplotlib.colors
import matplotlib.image
import numpy as np
import pytest
from chromium import BROWSER, Page, chromium

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


# ---- a live play ----


@pytest.fixture
def live(tmp_path: Path) -> Iterator[tuple[Page, subprocess.Popen[str]]]:
    command = [
        sys.executable,
        "-m",
        "diabolo",
        "simulate",
        "--live",
        "--seconds",
        "100",
        "--out",
        "played.csv",
    ]
    process = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[1]
        with chromium(tmp_path / "profile") as page:
            page.ask("Page.navigate", url=address)
            page.wait_for("document.documentElement.dataset.frames > 10")
            yield page, process
    finally:
        process.kill()
        process.communicate()


def tip(page: Page, side: str) -> tuple[float, float]:
    """Where it is on the page [CSS pixels]."""
    x, y, _ = page.value(f"project(data.{side}.at(-1)).map(place => place / devicePixelRatio)")
    return x, y


def paused_at(page: Page) -> float:
    """The play's time [s], once two readings agree."""
    until, before, now = time.monotonic() + 20.0, None, page.value("data.time.at(-1)")
    while now != before:
        assert time.monotonic() < until, "the play goes on"
        time.sleep(0.2)
        before, now = now, page.value("data.time.at(-1)")
    return float(now)


def drag(page: Page, seconds: float, across: float, up: float, rate: float) -> None:
    """The left tip in circles that begin where it is, so wide and high [CSS pixels], so many a second."""
    x, y = tip(page, "left")
    page.mouse("mousePressed", x, y)
    begun = time.monotonic()
    while (angle := 2.0 * math.pi * rate * (time.monotonic() - begun)) < 2.0 * math.pi * rate * seconds:
        page.mouse("mouseMoved", x + across * (1.0 - math.cos(angle)), y - up * math.sin(angle))
        time.sleep(0.01)
    page.mouse("mouseReleased", x, y)


# Once a second: the time [s], the frames that came, and those that were painted.
COUNT = """window.counted = [];
window.painted = 0;
(function next(now) {
  ++painted;
  if (counted.length === 0 || now / 1000 - counted.at(-1)[0] >= 1)
    counted.push([now / 1000, Number(document.documentElement.dataset.frames), painted]);
  requestAnimationFrame(next);
})(performance.now())"""


def test_a_live_play_follows_the_mouse_at_fifty_frames_a_second(
    live: tuple[Page, subprocess.Popen[str]], tmp_path: Path
) -> None:
    page, process = live
    page.value(COUNT)
    drag(page, 4.0, 20.0, 70.0, 1.5)
    page.picture(tmp_path / "live.png")
    seconds, frames, painted = np.diff(page.value("counted"), axis=0).T
    print("frames", (frames / seconds).round(1), "1/s, painted", (painted / seconds).round(1), "1/s")
    best = max(np.minimum(frames, painted) / seconds)  # second by second, since other work may slow some
    assert best > 25.0, "50 on a machine with nothing else to do"
    heights = np.array(page.value("[data.left, data.right].map(tips => tips.map(place => place[2]))"))
    assert np.ptp(heights, axis=1).min() > 0.1, "both tips move"
    assert np.corrcoef(heights)[0, 1] < -0.9, "against each other"
    assert len(np.unique(matplotlib.image.imread(tmp_path / "live.png").reshape(-1, 4), axis=0)) > 50

    drag(page, 1.0, 3000.0, 3000.0, 1.0)  # as far as the page goes, and farther
    page.value("document.getElementById('again').click()")
    page.wait_for("Math.abs(data.left.at(-1)[1] - 0.4) < 1e-3 && data.time.at(-1) > 0.2")
    page.value("document.getElementById('both').click()")
    right = tip(page, "right")
    drag(page, 1.0, 30.0, 30.0, 1.0)
    assert math.dist(right, tip(page, "right")) < 3.0, "one tip alone"
    page.value("document.getElementById('play').click()")
    before = paused_at(page)
    page.ask("Input.dispatchKeyEvent", type="keyDown", key="s")
    page.wait_for(f"data.time.at(-1) < {before}")
    begun = paused_at(page)
    time.sleep(0.5)
    assert page.value("data.time.at(-1)") == begun, "a pause is one"
    yaw = page.value("camera.yaw")
    for kind, x in (("mousePressed", 500), ("mouseMoved", 600), ("mouseReleased", 600)):
        page.mouse(kind, x, 300, "right")
    assert page.value("camera.yaw") != yaw
    assert page.console == []

    page.ask("Page.navigate", url="about:blank")
    output, _ = process.communicate(timeout=30)
    assert process.returncode == 0 and output.startswith("the page was closed\nplayed.csv: ")
    assert diabolo.load_recording(tmp_path / "played.csv").rate == pytest.approx(125.0)


def test_a_page_says_so_when_the_program_ends(live: tuple[Page, subprocess.Popen[str]]) -> None:
    page, process = live
    process.send_signal(signal.SIGINT)
    assert page.wait_for("document.getElementById('note').textContent") == "ended by Ctrl-C"
    assert process.wait(timeout=30) == 0
    assert page.console == []
