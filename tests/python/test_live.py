# SPDX-License-Identifier: MIT
"""A live play without a browser: its laws, what the server takes and refuses, and how the command ends."""

from __future__ import annotations

import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
import pytest
from conftest import Command
from diabolo.cli.live import play_live
from diabolo.live.broadcast import Broadcast
from diabolo.live.hands import HOME, REACH, Hands, in_plane
from diabolo.live.page import live_html
from diabolo.live.play import DT, RATE, Play
from diabolo.live.server import LONGEST_BODY, MOST_CONNECTIONS, LiveServer
from diabolo.live.wish import Wish, wish_of

CORNERS = [(y, z) for y in REACH[0] for z in REACH[1]]


def model_of(name: str) -> diabolo.Model:
    if name != "with effects":
        return diabolo.Model.named(name)
    effects = {
        "string_friction": diabolo.StringFriction(coefficient=0.2),
        "air": diabolo.Air(linear_drag=0.1),
    }
    return diabolo.Model(diabolo.Parameters(), **effects)


def random_wishes(count: int) -> Iterator[Wish]:
    seed = int.from_bytes(os.urandom(4), "little")
    print("seed", seed)
    random = np.random.default_rng(seed)
    for _ in range(count):
        left, right = zip(random.uniform(*REACH[0], 2), random.uniform(*REACH[1], 2), strict=True)
        yield Wish(left, right)


# ---- the hands ----


def test_hands_come_to_rest_where_the_pointer_is() -> None:
    hands, wanted = Hands(1.45), in_plane(((0.6, 1.5), (-0.2, 1.0)))
    for _ in range(1000):
        hands.follow(wanted, DT)
    np.testing.assert_allclose(hands.position, wanted, atol=1e-6)
    np.testing.assert_allclose(hands.velocity, 0.0, atol=1e-6)


def test_a_leap_of_the_pointer_is_no_throw() -> None:
    """From corner to corner of its reach a tip keeps a person's limits; a taut string drags it, at most."""
    fastest = 0.0
    for begin in CORNERS:
        for end in CORNERS:
            hands = Hands(1.45)
            for wanted in (begin, end):
                for _ in range(600):
                    before = hands.velocity
                    hands.follow(in_plane((wanted, HOME[1])), DT)
                    fastest = max(fastest, float(np.linalg.norm(hands.velocity, axis=1).max()))
                    if np.linalg.norm(hands.position[0] - hands.position[1]) < 1.4:
                        assert np.linalg.norm(hands.velocity - before, axis=1).max() < 60.0 * DT * 1.001
    print("fastest tip", fastest, "m/s")
    assert 3.0 < fastest < 6.0


@pytest.mark.parametrize("length", [0.1, 1.45, 8.0])
def test_hands_never_tear_the_string(length: float) -> None:
    hands = Hands(length)
    for wish in random_wishes(40):
        for _ in range(50):
            hands.follow(in_plane((wish.left, wish.right)), DT)
            assert np.linalg.norm(hands.position[0] - hands.position[1]) <= length


# ---- the play ----


@pytest.mark.parametrize("name", ["consistent", "paper", "published", "with effects"])
def test_a_play_is_what_the_predictor_makes_of_its_tips(name: str) -> None:
    """Stepped alone, along the path of hands that follow the same wishes."""
    model = model_of(name)
    play, predictor, hands = Play(model, 80.0), diabolo.Predictor(model), Hands(1.45)
    hands.string_length = model.parameters.string_length
    left, right = hands.position
    state = diabolo.hang_at_rest(model, left, right, 80.0)
    step = 0
    for wish in (Wish((0.5, 1.4), (-0.3, 1.1)), Wish((0.4, 1.1), (-0.5, 1.4))):
        play.obey(wish)
        for _ in range(25):
            play.advance(1 / 64)  # no whole steps
        while step < play.steps:
            tips, velocities = hands.position, hands.velocity
            hands.follow(in_plane((wish.left, wish.right)), DT)
            moving = [*velocities, *hands.velocity]
            predictor.step(state, *tips, *hands.position, DT, velocities=moving, time=step * DT)
            step += 1
    assert play.stretches == 1 and step > 750
    np.testing.assert_array_equal(play.state.to_array(), state.to_array())


def test_time_is_owed_and_never_lost() -> None:
    play = Play(diabolo.Model.named("consistent"), 80.0)
    for _ in range(1000):
        play.advance(1 / 60)
    assert play.steps + play.owed / DT == pytest.approx(1000 / 60 / DT, abs=1e-6)
    play.obey(Wish(speed=0.0))
    steps = play.steps
    play.advance(1.0)
    assert play.steps == steps


def test_a_play_begins_at_rest_on_a_string_that_gives() -> None:
    play = Play(diabolo.Model(string_elasticity=diabolo.StringElasticity(compliance=2e-3, damping=5.0)), 0.0)
    begin = play.state.position.copy()
    play.advance(0.5)
    assert np.abs(play.state.position - begin).max() < 1e-6


def test_tensions_of_a_string_that_rubs_are_in_the_ratio_of_the_capstan() -> None:
    play = Play(diabolo.Model(string_friction=diabolo.StringFriction(coefficient=0.2)), 80.0)
    play.advance(0.1)
    to_left, to_right = play.hands.position - play.state.position
    cosine = to_left @ to_right / np.linalg.norm(to_left) / np.linalg.norm(to_right)
    left, right = play.tensions
    assert left / right == pytest.approx(np.exp(0.2 * (np.pi - np.arccos(cosine))), rel=0.01)


def test_at_rest_the_strands_carry_the_weight() -> None:
    play = Play(diabolo.Model.named("consistent"), 0.0)
    for _ in range(60):
        play.advance(1 / 60)
    frame = json.loads(play.frame())
    p = play.model.parameters
    steepness = (frame["left"][2] - frame["diabolo"][2]) / (0.5 * p.string_length)
    assert frame["tensions"] == pytest.approx([0.5 * p.mass * p.gravity / steepness] * 2, abs=0.02)
    assert frame["string"] == "on_string"


@pytest.mark.parametrize("length", [0.05, 1.45, 20.0])
def test_what_is_shown_and_recorded_is_finite_whatever_is_wished(length: float) -> None:
    play = Play(diabolo.Model(diabolo.Parameters(string_length=length)), 100.0)
    for wish in random_wishes(60):
        play.obey(wish)
        for _ in range(6):
            play.advance(1 / 60)
            json.loads(play.frame(), parse_constant=lambda constant: pytest.fail(constant))
    taken = play.recording("wild")
    assert taken is not None and np.isfinite(taken[0].diabolo).all()


@pytest.mark.parametrize("speed", [1e3, 1e5, 1e150, 1e308])
def test_what_leaves_the_world_begins_again(speed: float) -> None:
    play = Play(diabolo.Model.named("consistent"), 10.0)
    play.state.string_state = "flying"
    play.state.velocity = np.array([speed, speed, speed])
    for _ in range(60):
        play.advance(1 / 60)
        assert np.abs(json.loads(play.frame())["diabolo"]).max() <= 100.0
    assert play.stretches == 2
    taken = play.recording("away")
    assert taken is not None and np.abs(taken[0].diabolo).max() <= 100.0


def test_what_is_dropped_begins_again() -> None:
    play = Play(diabolo.Model.named("consistent"), 100.0)
    play.state.position = np.array([2.0, 0.0, 1.0])
    play.state.string_state = "flying"
    for _ in range(200):
        play.advance(0.01)
    assert play.stretches == 2
    assert play.state.position[2] > 0.5


def test_the_longest_stretch_is_recorded_and_is_physics() -> None:
    """A rollout along the recorded tips goes where the recorded diabolo goes."""
    model = diabolo.Model.named("consistent")
    play = Play(model, 100.0)
    for seconds, begin in ((0.4, None), (1.5, "again"), (0.2, "spin")):
        play.obey(Wish((0.5, 1.35), (-0.35, 1.15), begin=begin))
        for _ in range(round(seconds * 60)):
            play.advance(1 / 60)
    taken = play.recording("mine")
    assert taken is not None
    take, string_states = taken
    assert len(take) == len(string_states) == pytest.approx(1.5 * RATE, abs=2)
    assert take.name == "mine" and play.stretches == 3
    tips = diabolo.TipMotion.of_recording(take, "spline")
    states = diabolo.rollout(
        model,
        [*take.diabolo[0], 0.0, 0.0, 0.0, 100.0],
        tips,
        dt=DT,
        steps=8 * (len(take) - 1),
        record_every=8,
        string_state="on_string",
    ).states
    assert np.linalg.norm(states[:, :3] - take.diabolo[1:], axis=1).max() < 1e-3


# ---- the server ----


@pytest.fixture
def server() -> Iterator[LiveServer]:
    play = Play(diabolo.Model.named("consistent"), 100.0)
    with LiveServer(0, live_html(play)) as server:
        server.frames.publish(play.frame())
        yield server


def answer(server: LiveServer, method: str, path: str, body: Any = None, **headers: str) -> tuple[int, str]:
    connection = http.client.HTTPConnection("127.0.0.1", server.server_port, timeout=10)
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    connection.request(method, path, body, {"Content-Type": "application/json", **named})
    response = connection.getresponse()
    text = response.read().decode()
    connection.close()
    return response.status, text


def test_a_wish_is_heard(server: LiveServer) -> None:
    for corner in CORNERS:
        body = json.dumps({"left": corner, "right": [0, 1], "speed": 0.5, "begin": "spin"})
        assert answer(server, "POST", "/play", body) == (204, "")
        assert list(server.wishes()) == [Wish(corner, (0.0, 1.0), 0.5, "spin")]
    assert list(server.wishes()) == []


BODIES: list[tuple[Any, str]] = [
    ("", "no JSON"),
    (b"\xff\xfe{}", "no JSON"),
    ("{", "no JSON"),
    ("[" * (LONGEST_BODY // 2), "no JSON"),
    ("[]", "expected an object with left, right"),
    ("null", "expected an object"),
    ('{"lift": 1}', "expected an object with left"),
    ('{"left": 1}', "left: 1; expected two numbers"),
    ('{"left": [1]}', "expected two numbers"),
    ('{"left": "ab"}', "expected two numbers"),
    ('{"left": [0, NaN]}', "left: nan; expected a number from 0.5 to 2.2"),
    ('{"left": [0, Infinity]}', "left: inf"),
    ('{"right": [1e999, 1]}', "right: inf; expected a number from -1.2 to 1.2"),
    ('{"right": [1' + "0" * 300 + ", 1]}", "right: 1000"),
    ('{"right": [true, 1]}', "right: True"),
    ('{"right": ["0", 1]}', "right: '0'"),
    ('{"speed": -1}', "speed: -1; expected a number from 0 to 2"),
    ('{"speed": null}', "speed: None"),
    ('{"begin": "now"}', "begin: 'now'; expected null"),
    ('{"begin": ["again"]}', "begin: ['again']"),
]


@pytest.mark.parametrize(("body", "said"), BODIES)
def test_a_body_that_is_no_wish_is_refused(server: LiveServer, body: Any, said: str) -> None:
    status, text = answer(server, "POST", "/play", body)
    assert status == 400 and said in text and text.count("\n") == 1
    assert list(server.wishes()) == []
    assert answer(server, "POST", "/play", "{}")[0] == 204


def test_bytes_at_random_are_refused_by_a_sentence() -> None:
    seed = int.from_bytes(os.urandom(4), "little")
    print("seed", seed)
    random = np.random.default_rng(seed)
    for _ in range(2000):
        body = bytearray(b'{"left": [0.4, 1.25], "right": [-0.4, 1.25], "speed": 1, "begin": null}')
        for place in random.integers(len(body), size=3):
            body[place] = random.integers(256)
        try:
            wish = wish_of(bytes(body))
        except ValueError as error:
            assert str(error).count("\n") == 0
        else:
            assert np.isfinite([*wish.left, *wish.right, wish.speed]).all()


@pytest.mark.parametrize(
    ("status", "method", "path", "headers"),
    [
        (404, "GET", "/etc/passwd", {}),
        (404, "POST", "/../play", {}),
        (405, "GET", "/play", {}),
        (405, "POST", "/", {}),
        (405, "DELETE", "/", {}),
        (405, "OPTIONS", "/play", {}),
        (421, "GET", "/", {"Host": "example.org"}),
        (421, "POST", "/play", {"Host": "127.0.0.1"}),
        (415, "POST", "/play", {"Content_Type": "text/plain"}),
        (413, "POST", "/play", {"Content_Length": "401"}),
        (413, "POST", "/play", {"Content_Length": "9" * 40}),
        (411, "POST", "/play", {"Content_Length": "-1"}),
        (411, "POST", "/play", {"Content_Length": "many"}),
        (411, "POST", "/play", {"Transfer_Encoding": "chunked"}),
        (431, "GET", "/", {"X": "x" * 70_000}),
        (414, "GET", "/" + "x" * 70_000, {}),
    ],
)
def test_what_is_none_of_its_business_is_refused(
    server: LiveServer, status: int, method: str, path: str, headers: dict[str, str]
) -> None:
    assert answer(server, method, path, **headers)[0] == status
    assert list(server.wishes()) == []
    assert answer(server, "GET", "/")[0] == 200


def eventually_answers(server: LiveServer) -> None:
    until = time.monotonic() + 20
    while True:
        try:
            assert answer(server, "GET", "/")[0] == 200
            return
        except (OSError, http.client.HTTPException):
            assert time.monotonic() < until, "those that have gone still count"
            time.sleep(0.05)


def test_a_browser_leaves_port_80_out() -> None:
    try:
        server = LiveServer(80, "")
    except ValueError as error:
        pytest.skip(str(error))
    with server:
        for host in ("127.0.0.1", "localhost", "localhost:80"):
            assert answer(server, "GET", "/", Host=host)[0] == 200
        assert answer(server, "GET", "/", Host="example.org")[0] == 421


def test_noise_and_too_many_connections_do_not_stop_it(server: LiveServer) -> None:
    noise = [socket.create_connection(("127.0.0.1", server.server_port)) for _ in range(2 * MOST_CONNECTIONS)]
    for connection in noise:
        connection.sendall(b"\x00\xff nonsense\r\n" if connection.fileno() % 2 else b"GET / HT")
    for connection in noise:
        connection.close()
    eventually_answers(server)


def test_what_connects_beyond_the_most_is_turned_away(server: LiveServer) -> None:
    address = ("127.0.0.1", server.server_port)
    silent = [socket.create_connection(address) for _ in range(MOST_CONNECTIONS)]
    with pytest.raises((OSError, http.client.HTTPException)):
        answer(server, "GET", "/")
    for connection in silent:
        connection.close()
    eventually_answers(server)


def test_it_hears_this_machine_only(server: LiveServer) -> None:
    assert server.server_address[0] == "127.0.0.1"
    with pytest.raises(ValueError, match=r"port \d+: Address already in use; expected one that is free"):
        LiveServer(server.server_port, "")


def test_all_who_watch_are_told_and_who_goes_is_missed(server: LiveServer) -> None:
    watching = [http.client.HTTPConnection("127.0.0.1", server.server_port, timeout=10) for _ in range(2)]
    streams = []
    for connection in watching:
        connection.request("GET", "/frames")
        streams.append(connection.getresponse())
    for stream in streams:
        assert stream.readline() == b"retry: 500\n"
        assert stream.readline() == b"\n"
        assert set(json.loads(stream.readline()[6:])) >= {
            "time",
            "left",
            "right",
            "diabolo",
            "spin",
            "tensions",
        }
    assert server.frames.listeners == 2
    streams[1].close()
    watching[1].close()
    until = time.monotonic() + 10
    while server.frames.listeners == 2:
        assert time.monotonic() < until
        server.frames.publish("{}")
        time.sleep(0.02)
    threading.Thread(target=server.frames.end, args=("all is over",)).start()
    assert streams[0].read().endswith(b'event: ended\ndata: "all is over"\n\n')
    watching[0].close()


# ---- the command ----


class Live:
    """`diabolo simulate --live`, and a page that watches it."""

    def __init__(self, folder: Path, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-W", "error", "-m", "diabolo", "simulate", "--live", *arguments],
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert self.process.stdout is not None
        self.said = self.process.stdout.readline()
        self.port = int(self.said.partition("127.0.0.1:")[2].partition("/")[0])
        self.page: http.client.HTTPConnection | None = None

    def watch(self, frames: int) -> list[dict[str, Any]]:
        self.page = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        self.page.request("GET", "/frames")
        self.stream = self.page.getresponse()
        return self.read(frames)

    def read(self, frames: int) -> list[dict[str, Any]]:
        seen: list[dict[str, Any]] = []
        while len(seen) < frames:
            line = self.stream.readline()
            assert line, "the stream has ended"
            if line.startswith(b"data: "):
                seen.append(json.loads(line[6:]))
        return seen

    def close_page(self) -> None:
        assert self.page is not None
        self.stream.close()
        self.page.close()

    def end(self) -> tuple[int, str, str]:
        output, errors = self.process.communicate(timeout=30)
        return self.process.returncode, output, errors


@pytest.fixture
def live(tmp_path: Path) -> Iterator[Any]:
    begun: list[Live] = []

    def begin(*arguments: str) -> Live:
        begun.append(Live(tmp_path, *arguments))
        return begun[-1]

    yield begin
    for one in begun:
        one.process.kill()
        one.process.communicate()
        if one.page is not None:
            one.close_page()


def test_what_was_played_is_a_recording(live: Any, tmp_path: Path, command: Command) -> None:
    play = live("--out", "played.csv", "--json", "summary.json", "--spin", "50")
    frames = play.watch(90)
    assert frames[0]["spin"] == 50.0 and frames[-1]["time"] > frames[0]["time"]
    play.close_page()
    status, output, errors = play.end()
    assert (status, errors) == (0, "")
    assert output.startswith("the page was closed\nplayed.csv: ") and "100 % on string" in output
    assert json.loads((tmp_path / "summary.json").read_text())["schema"] == "diabolo.simulate/1"
    assert "125 Hz" in command("info", "played.csv").stdout
    for reader in (("view", "played.csv", "--out", "v.html"), ("evaluate", "played.csv")):
        assert command(*reader).returncode == 0
    diagnosed = command("diagnose", "played.csv")
    assert diagnosed.returncode == 0, diagnosed.stderr


@pytest.mark.parametrize("watched", [True, False])
def test_ctrl_c_ends_it_in_order(live: Any, tmp_path: Path, watched: bool) -> None:
    play = live("--out", "played.csv")
    if watched:
        play.watch(30)
    play.process.send_signal(signal.SIGINT)
    status, output, errors = play.end()
    assert (status, errors) == (0, "")
    assert output.startswith("ended by Ctrl-C\nplayed.csv: ")
    assert (tmp_path / "played.csv").exists() == watched
    assert ("nothing was played" in output) != watched


def test_who_stops_reading_loses_no_play(live: Any, tmp_path: Path) -> None:
    play = live("--out", "played.csv")
    play.process.stdout.close()
    play.watch(30)
    play.close_page()
    assert play.process.wait(timeout=30) == 0
    assert diabolo.load_recording(tmp_path / "played.csv").rate == pytest.approx(RATE)


def test_a_second_ctrl_c_loses_no_play(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Broadcast, "end", interrupted)
    play = Play(diabolo.Model.named("consistent"), 100.0)
    assert play_live(play, 0, 0.01) == "0.01 s are over"


def test_sigterm_stops_it_and_leaves_nothing(live: Any, tmp_path: Path) -> None:
    play = live("--out", "played.csv")
    play.watch(10)
    play.process.send_signal(signal.SIGTERM)
    assert play.end() == (143, "", "diabolo: terminated\n")
    assert list(tmp_path.iterdir()) == []


def test_a_machine_that_sleeps_does_not_make_it_jump(live: Any) -> None:
    play = live()
    play.watch(10)
    play.process.send_signal(signal.SIGSTOP)
    time.sleep(1.5)
    play.process.send_signal(signal.SIGCONT)
    times = [frame["time"] for frame in play.read(60)]
    print("longest step between frames", max(np.diff(times)), "s")
    assert 0.0 < max(np.diff(times)) < 0.7
    play.process.send_signal(signal.SIGINT)
    assert play.end()[0] == 0


def test_a_page_that_does_not_listen_keeps_nobody(live: Any) -> None:
    play = live()
    deaf = [socket.create_connection(("127.0.0.1", play.port)) for _ in range(5)]
    for one in deaf:
        one.sendall(f"GET /frames HTTP/1.1\r\nHost: localhost:{play.port}\r\n\r\n".encode())
    frames = play.watch(120)
    assert frames[-1]["time"] - frames[0]["time"] > 0.5
    for one in deaf:
        one.close()
    play.close_page()
    assert play.end()[:2] == (0, "the page was closed\n")


def test_it_ends_by_itself(live: Any) -> None:
    play = live("--seconds", "0.5")
    assert play.end() == (0, "0.5 s are over\n", "")


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (("--motion", "hold"), "not allowed with argument"),
        (("out.csv",), "out.csv: expected --out out.csv with --live"),
        (("--duration", "3"), "--duration 3.0: does not belong to --live"),
        (("--up", "y"), "--up y: does not belong to --live"),
        (("--port", "0"), "--port 0: expected 1 to 65535"),
        (("--port", "many"), "invalid int value"),
        (("--seconds", "nan"), "--seconds nan: expected more than 0"),
        (("--seconds", "-1"), "--seconds -1: expected more than 0"),
        (("--spin", "400"), "--spin 400: expected less than 393 rad/s"),
        (("--out", "out.txt"), "out.txt: expected a name that ends in .csv"),
        (("--out", "no/out.csv"), "there is no folder"),
        (("--json", "-"), "--json -: expected a file, and --out FILE.csv"),
        (("--model", "mine"), "model mine: no such file"),
    ],
)
def test_options_that_do_not_fit_are_told(
    command: Command, tmp_path: Path, arguments: tuple[str, ...], text: str
) -> None:
    done = command("simulate", "--live", *arguments)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert text in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("option", [("--port", "9"), ("--seconds", "9"), ("--out", "live.csv")])
def test_options_of_a_live_play_are_its_own(command: Command, option: tuple[str, str]) -> None:
    done = command("simulate", "out.csv", "--motion", "hold", *option)
    assert (done.returncode, done.stdout) == (2, "")
    assert "belongs to --live" in done.stderr


def test_a_port_in_use_is_told(command: Command, server: LiveServer) -> None:
    done = command("simulate", "--live", "--port", str(server.server_port))
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert f"port {server.server_port}: Address already in use; expected one that is free" in done.stderr
