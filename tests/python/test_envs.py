# SPDX-License-Identifier: MIT
"""Environments: what Gymnasium expects of them, laws of episodes, and bad input."""

import pickle
import subprocess
import sys
from typing import Any

import diabolo
import numpy as np
import pytest
from diabolo import Model, Parameters, State, StringFriction

gymnasium = pytest.importorskip("gymnasium")
from diabolo.envs import (  # noqa: E402
    TASKS,
    Agent,
    Camera,
    DiaboloEnv,
    DiaboloVectorEnv,
    EpisodeStart,
    HandLimits,
    LiveAgent,
    observation_infos,
    play,
    shipped_agent,
    task_infos,
    taught_starts,
    ur5e_limits,
)
from gymnasium.utils.env_checker import check_env  # noqa: E402
from gymnasium.vector import AutoresetMode  # noqa: E402

STILL = np.zeros(6, np.float32)


def actions(count: int, steps: int, seed: int = 2410) -> Any:
    return np.random.default_rng(seed).uniform(-1.0, 1.0, (steps, count, 6)).astype(np.float32)


@pytest.mark.parametrize("task", TASKS)
def test_gymnasium_finds_nothing_wrong(task: str) -> None:
    env = gymnasium.make(f"Diabolo/{task}-v0")
    check_env(env.unwrapped, skip_render_check=True)
    seconds = next(info["seconds"] for info in task_infos() if info["name"] == task)
    env.reset(seed=1)
    for _ in range(round(seconds / 0.01)):
        *_, terminated, truncated, _ = env.step(STILL)
        if terminated:
            break
    assert terminated or truncated


@pytest.mark.parametrize("task", TASKS)
def test_an_environment_plays_the_same_alone_and_among_others(task: str) -> None:
    models = [Model(Parameters(), string_friction=StringFriction(coefficient=mu)) for mu in (0.1, 0.3)]
    many = DiaboloVectorEnv(5, task, models, threads=2, autoreset_mode=AutoresetMode.SAME_STEP)
    one = DiaboloEnv(task, models)
    first, _ = many.reset(seed=30)
    alone, _ = one.reset(seed=33)
    np.testing.assert_array_equal(first[3], alone)
    for given in actions(5, 900):
        observations, rewards, terminated, truncated, infos = many.step(given)
        seen, reward, over, cut, _ = one.step(given[3])
        assert (reward, over, cut) == (rewards[3], terminated[3], truncated[3])
        if over or cut:
            np.testing.assert_array_equal(infos["final_obs"][3], seen)
            seen, _ = one.reset()
        np.testing.assert_array_equal(observations[3], seen)


def test_the_next_step_resets_and_counts_for_nothing() -> None:
    env = DiaboloVectorEnv(2, "Hold", autoreset_mode="NextStep")
    first, _ = env.reset(seed=4)
    for _ in range(500):
        observations, _, terminated, truncated, infos = env.step(np.zeros((2, 6)))
    assert truncated.all() and not terminated.any() and infos == {}
    last = observations
    observations, rewards, terminated, truncated, _ = env.step(np.ones((2, 6)))
    assert not truncated.any() and not rewards.any()
    assert not np.array_equal(observations, last)
    np.testing.assert_array_equal(observations[:, 16:22], 0.0)  # tips at rest: the action was not played
    assert not np.array_equal(observations, first)  # a fresh episode, not the first again


def test_without_autoreset_only_those_of_a_mask_begin_anew() -> None:
    env = DiaboloVectorEnv(3, "Hold", autoreset_mode=AutoresetMode.DISABLED)
    env.reset(seed=5)
    for given in actions(3, 20):
        before, *_ = env.step(given)
    after, _ = env.reset(options={"reset_mask": np.array([False, True, False])})
    np.testing.assert_array_equal(after[[0, 2]], before[[0, 2]])
    assert not np.array_equal(after[1], before[1])


def test_the_same_seed_is_the_same_episode() -> None:
    env = DiaboloEnv("ThrowAndCatch")
    first, second, again = env.reset(seed=7)[0], env.reset()[0], env.reset(seed=7)[0]
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, second)
    assert not np.array_equal(DiaboloEnv("Hold").reset()[0], DiaboloEnv("Hold").reset()[0])


def test_observations_are_what_their_table_says() -> None:
    env = DiaboloEnv("ThrowAndCatch")
    place = State([0.1, 0.2, 2.0], [0.3, 0.4, 0.5], 90.0, "flying")
    seen, _ = env.reset(seed=1, options={"state": place, "goal": [0.6, -0.1]})
    parts, begin = {}, 0
    for info in observation_infos():
        parts[info["name"]] = seen[begin : begin + info["size"]]
        begin += info["size"]
    assert begin == env.observation_space.shape[0]
    centre = HandLimits().centre
    middle = centre + 0.5 * (parts["left"] + parts["right"])
    np.testing.assert_allclose(parts["diabolo"] + middle, [0.1, 0.2, 2.0], atol=1e-6)
    np.testing.assert_allclose(parts["velocity"], [0.3, 0.4, 0.5], atol=1e-6)
    assert parts["spin"] == pytest.approx([0.9])
    np.testing.assert_array_equal(parts["string"], [0, 0, 1])
    np.testing.assert_allclose(parts["goal"], [0.6, -0.1], atol=1e-6)


def test_only_level_sees_the_axle() -> None:
    usual = sum(info["size"] for info in observation_infos())
    for task in TASKS:
        own = [info["name"] for info in observation_infos(task)]
        env = DiaboloEnv(task, free_axis=True)
        assert env.observation_space.shape == (usual + (6 if task == "Level" else 0),)
        assert ("axle" in own) == (task == "Level")
        assert env.observation_space.contains(env.reset(seed=1)[0])
    many = DiaboloVectorEnv(3, "Level")
    seen, _ = many.reset(seed=1, options={"state": State([0.0, 0.0, 0.6], axis=[0.6, 0.0, 0.8])})
    np.testing.assert_allclose(seen[:, usual : usual + 3], [[0.6, 0.0, 0.8]] * 3, atol=1e-6)
    agent = Agent("Level", 0.01, 10, [(np.zeros((6, usual + 6)), np.zeros(6))])
    assert not agent.act(seen).any()
    with pytest.raises(ValueError, match=f"expected {usual + 6} inputs"):
        Agent("Level", 0.01, 10, [(np.zeros((6, usual)), np.zeros(6))])
    with pytest.raises(ValueError, match="observations"):
        shipped_agent("SpinUp").act(seen)


def test_a_level_axle_is_told_by_the_outcome() -> None:
    env = DiaboloEnv("Level")
    level = State(env.reset(seed=2) and env.pose()[0].position, spin=90.0, string_state="on_string")
    env.reset(seed=2, options={"state": level})
    for _ in range(30):
        env.step(STILL)
    assert env.outcome()["level"] == pytest.approx(0.3)


def test_a_free_axis_leaves_the_usual_tasks_as_they_begin() -> None:
    fixed, free = DiaboloEnv("Swing"), DiaboloEnv("Swing", free_axis=True)
    np.testing.assert_array_equal(fixed.reset(seed=3)[0], free.reset(seed=3)[0])
    for env in (fixed, free):
        for _ in range(50):
            env.step([0.3, 0.0, 0.0, -0.3, 0.0, 0.0])
    turned = [np.abs(np.array(env.pose()[0].axis) - [1.0, 0.0, 0.0]).max() for env in (fixed, free)]
    assert turned[0] == 0.0 and turned[1] > 1e-3


def test_a_camera_sees_late_with_noise_and_not_in_every_frame() -> None:
    eyes = Camera(noise=2e-3, dropouts=0.1, least_delay=2, most_delay=2)
    seeing, exact = (DiaboloVectorEnv(64, "Hold", difficulty=one) for one in (eyes, "easy"))
    for env in (seeing, exact):
        env.reset(seed=6)
    places = []
    for given in actions(64, 120):
        places.append(
            [env.step(0.1 * given)[0][:, :3] + _middle(env._observations) for env in (seeing, exact)]
        )
    seen, true = (np.array([one[k] for one in places], float) for k in (0, 1))
    late = [np.sqrt(np.mean((seen[10:] - np.roll(true, k, axis=0)[10:]) ** 2)) for k in range(6)]
    assert np.argmin(late) == 2
    assert 2e-3 < late[2] < 4e-3  # the noise, and what moved while nothing was seen
    stale = np.all(np.abs(np.diff(seen, axis=0)) < 1e-6, axis=2).mean()
    assert stale == pytest.approx(0.1, abs=0.02)


def _middle(observations: Any) -> Any:
    return 0.5 * (observations[:, 10:13] + observations[:, 13:16])


def test_episodes_begin_where_they_are_told_to() -> None:
    centre = HandLimits().centre
    left, right = centre + np.array([0.0, 0.3, 0.1]), centre + np.array([0.0, -0.3, 0.1])
    start = EpisodeStart(
        State([0.0, 0.1, 1.9], [0.0, 0.0, -1.0], 80.0, "flying"), left, right, goal=[0.5, 0.1]
    )
    env = DiaboloVectorEnv(400, "ThrowAndCatch", starts=[start], start_share=0.25)
    observations, _ = env.reset(seed=3)
    told = observations[:, 9] == 1.0  # flying
    assert told.mean() == pytest.approx(0.25, abs=0.08)
    np.testing.assert_allclose(observations[told][:, 22:24], [[0.5, 0.1]] * told.sum(), atol=1e-6)
    np.testing.assert_allclose(observations[told][:, 10:13], [left - centre] * told.sum(), atol=1e-6)


def test_an_agent_plays_the_same_in_python_and_in_the_core() -> None:
    random = np.random.default_rng(8)
    size = DiaboloEnv().observation_space.shape[0]
    layers = [(random.normal(size=(16, size)) / 6.0, np.zeros(16)), (random.normal(size=(6, 16)), np.ones(6))]
    agent = Agent("Hold", 0.02, 20, layers)
    weights = [(np.float32(w), np.float32(b)) for w, b in layers]

    def by_hand(seen: Any) -> Any:
        hidden = np.tanh(seen @ weights[0][0].T + weights[0][1])
        return np.clip(hidden @ weights[1][0].T + weights[1][1], -1.0, 1.0)

    seen = random.normal(size=(5, size)).astype(np.float32)
    np.testing.assert_allclose(agent.act(seen), by_hand(seen), atol=1e-5)
    one, other = play(agent, 20, seed=4), play(by_hand, 20, task="Hold", seed=4, period=0.02, steps=20)
    assert one.keys() == other.keys()
    assert one["over"].all() and (one["seconds"] <= 5.0 + 1e-9).all()
    # The last digit of an action may decide whether a wild play ends in a drop.
    assert np.mean(np.abs(one["worth"] - other["worth"]) < 0.01) >= 0.8


def test_the_agent_of_the_package_spins_the_diabolo_up_and_keeps_it() -> None:
    outcomes = play(shipped_agent("SpinUp"), 200, seed=100)
    gained = outcomes["spin"] - outcomes["first_spin"]
    assert np.median(gained) >= 90.0
    assert outcomes["dropped"].mean() <= 0.01


def test_the_agent_of_the_package_levels_the_axle_and_keeps_it_so() -> None:
    outcomes = play(shipped_agent("Level"), 200, seed=100)
    assert np.mean(outcomes["level"] >= 1.0) >= 0.85
    assert np.mean(outcomes["level"] >= 5.0 - 1e-9) >= 0.5  # from the third second on
    assert outcomes["dropped"].mean() <= 0.01
    still = play(lambda seen: np.zeros((len(seen), 6)), 200, task="Level", seed=100)
    assert np.median(outcomes["worth"]) >= 5.0 * np.median(still["worth"])


def test_an_episode_is_what_a_rollout_of_the_same_tips_gives() -> None:
    model = Model(Parameters(), string_friction=StringFriction(coefficient=0.3))
    env = DiaboloEnv("SpinUp", model)
    env.reset(seed=3)
    state, left, right = env._arena.pose(0)
    # A push of the right tip upwards: its height is 0.5 a t^2, on a grid of a millisecond.
    time = np.arange(201) / 1000.0
    lift = 0.5 * 0.2 * HandLimits().acceleration * time**2
    rights = right + lift[:, None] * [0.0, 0.0, 1.0]
    tips = diabolo.TipMotion(time, np.tile(left, (201, 1)), rights, interpolation="spline")
    start = [*state.position, *state.velocity, state.spin]
    expected = diabolo.rollout(model, start, tips, steps=200, string_state=state.string_state).states[-1]
    for _ in range(20):
        env.step([0.0, 0.0, 0.0, 0.0, 0.0, 0.2])
    end = env._arena.pose(0)[0]
    np.testing.assert_allclose(end.position, expected[:3], atol=2e-4)
    assert end.spin == pytest.approx(expected[6], abs=0.05)


def test_a_picture_shows_where_the_diabolo_is() -> None:
    pytest.importorskip("matplotlib")
    env = gymnasium.make("Diabolo/ThrowAndCatch-v0", render_mode="rgb_array")
    env.reset(seed=1)
    hanging = env.render()
    assert hanging.shape == (480, 480, 3) and hanging.dtype == np.uint8
    env.reset(seed=1, options={"state": State([0.0, 0.3, 1.8], spin=90.0, string_state="flying")})
    flying = env.render()
    orange = [np.argwhere((one == [0xC7, 0x6F, 0x00]).all(axis=2)).mean(axis=0) for one in (hanging, flying)]
    assert orange[1][0] < orange[0][0] - 100  # higher
    assert orange[1][1] < orange[0][1] - 20  # to the left
    assert DiaboloEnv().render() is None


def test_memory_is_handed_out_or_copied_as_asked() -> None:
    shared, copied = (DiaboloVectorEnv(2, "Hold", copy=copy) for copy in (False, True))
    kept = [env.reset(seed=1)[0] for env in (shared, copied)]
    before = [one.copy() for one in kept]
    for env in (shared, copied):
        env.step(np.ones((2, 6)))
    assert not np.array_equal(kept[0], before[0])
    np.testing.assert_array_equal(kept[1], before[1])
    del shared
    assert np.isfinite(kept[0]).all()  # an array keeps what it looks into


def test_wild_actions_stay_finite_and_within_limits() -> None:
    env = DiaboloVectorEnv(64, "ThrowAndCatch", threads=1)
    env.reset(seed=11)
    random = np.random.default_rng(2411)
    limits = HandLimits()
    held = np.zeros((64, 6), np.float32)
    for _ in range(2000):
        again = random.random(64) < 0.1
        held[again] = random.choice([-1e30, -1.0, 0.0, 1.0, 1e30], (again.sum(), 6))
        observations, rewards, *_ = env.step(held)
        assert env.observation_space.contains(observations)
        assert np.isfinite(observations).all() and np.isfinite(rewards).all()
        tips = observations[:, 10:16].reshape(-1, 2, 3)
        assert (np.abs(tips) <= limits.half + 1e-6).all()
        assert (np.linalg.norm(tips[:, 0] - tips[:, 1], axis=1) < Parameters().string_length).all()


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: DiaboloEnv("Fly"), 'task: found "Fly"; expected one of Hold, Swing'),
        (lambda: DiaboloEnv(model=3), "model: "),
        (lambda: DiaboloEnv(model=[]), "model: "),
        (lambda: DiaboloEnv(period=1.0), "period: 1 s; expected 0.001 to 0.1 s"),
        (lambda: DiaboloEnv(steps=0), "steps: 0; expected 1 to 1000"),
        (lambda: DiaboloEnv(render_mode="human"), "render_mode: 'human'; expected 'rgb_array' or None"),
        (lambda: DiaboloVectorEnv(2, render_mode="rgb_array"), "render_mode: 'rgb_array'; expected None"),
        (
            lambda: DiaboloEnv(difficulty="hard"),
            "difficulty: 'hard'; expected 'easy', 'real', 'sealed' or a Camera",
        ),
        (
            lambda: DiaboloEnv(model=Parameters(), difficulty="sealed"),
            "model: given, beside the difficulty 'sealed', which has its own; expected None",
        ),
        (lambda: Camera(noise=-1.0), "camera, noise: -1; expected 0 to 0.1"),
        (lambda: Camera(axle_noise=2.0), "camera, axle_noise: 2; expected 0 to 1"),
        (
            lambda: Camera(least_delay=3, most_delay=2),
            "camera, delay: 3 to 2 frames; expected a range within 0",
        ),
        (lambda: DiaboloEnv(start_share=0.5), "start_share: 0.5; expected 0 to 0, since there are no starts"),
        (
            lambda: EpisodeStart(State([0, 0, 1]), [0, 1, 2], [0, 0, 0], goal=[1, 2, 3]),
            "goal: 3 numbers; expected at most 2",
        ),
        (
            lambda: EpisodeStart(State([0, 0, 1]), [0, 1, 2], [0, 0, 0], stage=-1),
            "stage: -1; expected 0 to 1000",
        ),
        (
            lambda: DiaboloEnv(starts=[EpisodeStart(State([0, 0, 1]), [0, 9, 1], [0, -0.3, 1])]),
            "starts, 0: a tip at 9 m with 0 m/s along axis 1; expected it within the limits, with room",
        ),
        (lambda: DiaboloEnv(starts=3), "starts: 3; expected"),
        (lambda: DiaboloEnv(starts=["here"]), "starts"),
        (
            lambda: DiaboloEnv(
                starts=[EpisodeStart(State([0, 0, 1]), [0, 0.3, 1], [0, -0.3, 1], goal=[np.nan])]
            ),
            "starts, 0: goal: not finite; expected numbers",
        ),
        (lambda: play(shipped_agent("SpinUp"), 2, autoreset_mode="Disabled"), "autoreset_mode: given"),
        (lambda: shipped_agent("Fly"), "task: 'Fly' has no agent in the package; expected "),
        (lambda: play(lambda seen: seen), "expected an Agent, or a function together with a task"),
        (lambda: play(shipped_agent("SpinUp"), 0), "num_envs: 0; expected a whole number from 1"),
        (lambda: HandLimits(speed=-1.0), "limits, speed: -1; expected a positive number up to 1000"),
        (lambda: DiaboloVectorEnv(0), "num_envs: 0; expected a whole number from 1"),
        (
            lambda: DiaboloVectorEnv(2, autoreset_mode="soon"),
            "autoreset_mode: 'soon'; expected one of 'NextStep'",
        ),
        (lambda: DiaboloVectorEnv(2, threads=-1), "threads: -1"),
        (lambda: DiaboloVectorEnv(2).reset(seed=[1]), "seed: 1 seeds; expected 2"),
        (lambda: DiaboloVectorEnv(2).reset(seed=-1), "seed: -1"),
        (lambda: DiaboloVectorEnv(2).reset(options={"reset_mask": [1, 0]}), "options, reset_mask: "),
        (
            lambda: DiaboloEnv().reset(options={"speed": 1}),
            "options: found 'speed'; expected state, goal, model",
        ),
        (lambda: DiaboloEnv().reset(options={"model": 1}), "options, model: 1"),
        (lambda: DiaboloEnv().reset(options={"goal": [1.0]}), "goal: 1 numbers; expected 2"),
        (lambda: DiaboloEnv("SpinUp").reset(options={"goal": [1.0]}), "goal: 1 numbers; expected 0"),
        (lambda: DiaboloEnv().reset(options={"goal": [np.nan, 0.0]}), "goal: [nan, 0.0]; expected finite"),
        (lambda: DiaboloEnv().reset(options={"goal": [[1], [2, 3]]}), "options, goal: "),
        (lambda: DiaboloEnv().reset(options="abc"), "options: 'abc'; expected a dict"),
        (lambda: DiaboloVectorEnv(2).reset(options=5), "options: 5; expected a dict"),
        (lambda: DiaboloEnv().reset(seed=-1), "seed: -1; expected a whole number from 0"),
        (
            lambda: shipped_agent("SpinUp").act(np.full(32, np.nan)),
            "observations: not finite; expected numbers",
        ),
        (
            lambda: DiaboloEnv(model=Parameters(string_length=0.5), limits=HandLimits(gap=0.7)),
            "limits, gap: 0.7 m; expected less than 0.498 m, as for the string",
        ),
    ],
)
def test_bad_input_is_told_in_one_sentence(call: Any, complaint: str) -> None:
    with pytest.raises(ValueError) as caught:
        call()
    assert complaint in str(caught.value) and "\n" not in str(caught.value)


def test_nothing_is_played_before_its_reset_and_what_is_far_off_stays_within_bounds() -> None:
    many = DiaboloVectorEnv(3, "Hold")
    many.reset(seed=1, options={"reset_mask": np.array([True, False, True])})
    for ask in (lambda: many.step(np.zeros((3, 6))), many.outcomes, lambda: many.pose(0), DiaboloEnv().pose):
        with pytest.raises(gymnasium.error.ResetNeeded):
            ask()
    one = DiaboloEnv("Hold")
    for options in ({"goal": [1e39, 0.0]}, {"state": State([1e39, 0.0, 1.0])}):
        seen, _ = one.reset(seed=1, options=options)
        assert one.observation_space.contains(seen)


def test_what_an_environment_is_made_of_can_be_copied() -> None:
    start = EpisodeStart(State([0, 0, 0.6]), [0, 0.3, 1.25], [0, -0.3, 1.25], goal=[0.1, 0.2], stage=2)
    for one in (Camera(noise=2e-3, axle_noise=3e-3), HandLimits(speed=1.0), start):
        copied = pickle.loads(pickle.dumps(one))
        assert pickle.dumps(copied) == pickle.dumps(one)
    assert gymnasium.make("Diabolo/Hold-v0", difficulty=Camera(), starts=[start]).spec is not None


def test_sealed_episodes_are_of_models_that_a_diagnosis_leaves_open() -> None:
    env = DiaboloVectorEnv(64, "ThrowAndCatch", difficulty="sealed", threads=1)
    seen, _ = env.reset(seed=3)
    assert len(np.unique(env.outcomes()["model"])) > 8
    plain, _ = DiaboloVectorEnv(64, "ThrowAndCatch", difficulty="real").reset(seed=3)
    assert np.abs(seen - plain).max() > 1e-3


def test_hands_of_two_arms_are_slower_than_a_players() -> None:
    arms = ur5e_limits()
    assert 0.3 < arms.speed < 0.6 and 0.8 < arms.acceleration < 3.0
    env = DiaboloVectorEnv(32, "SpinUp", limits=arms)
    env.reset(seed=5)
    random, forth = np.random.default_rng(24), np.ones((32, 6), np.float32)
    for _ in range(500):
        forth[random.random(32) < 0.05] *= -1.0
        before = np.array([env.pose(i)[1:] for i in range(32)])
        env.step(forth)
        moved = np.array([env.pose(i)[1:] for i in range(32)]) - before
        assert np.abs(moved).max() <= arms.speed * 0.01 + 1e-9


def test_a_start_may_lie_in_a_later_stage() -> None:
    start = taught_starts("Routine", plays=1)[0]
    env = DiaboloEnv("Routine", starts=[start], start_share=1.0)
    seen, _ = env.reset(seed=1)
    assert seen[-1] == 1.0


def test_bad_actions_are_refused_before_anything_moves() -> None:
    env = DiaboloVectorEnv(2, "Hold")
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(np.zeros((2, 6)))
    before, _ = env.reset(seed=1)
    bad = np.zeros((2, 6), np.float32)
    bad[1, 2] = np.nan
    with pytest.raises(ValueError, match="actions, environment 1, number 2: not finite; expected -1 to 1"):
        env.step(bad)
    with pytest.raises(ValueError, match=r"actions: .*\(2, 6\)"):
        env.step(np.zeros((3, 6)))
    after, *_ = env.step(np.zeros((2, 6)))
    np.testing.assert_allclose(
        after[:, :25], before[:, :25], atol=0.05
    )  # but for forces, which friction parts
    one = DiaboloEnv()
    one.reset(seed=1)
    with pytest.raises(ValueError, match=r"action: .*; expected six numbers from -1 to 1"):
        one.step([0.0, 0.0])


def test_the_package_needs_no_gymnasium() -> None:
    script = "import sys; sys.modules['gymnasium'] = None; import diabolo; print(diabolo.__version__)"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, check=True).stdout


def test_the_player_teaches_what_a_reward_alone_does_not_lead_to() -> None:
    starts = taught_starts("ThrowAndCatch", plays=2, seed=3)
    assert len(starts) > 20
    many = DiaboloVectorEnv(64, "ThrowAndCatch", starts=starts, start_share=1.0)
    observations, _ = many.reset(seed=1)
    assert len(np.unique(observations[:, 8:10])) > 1  # some are loose or fly, some are not
    with pytest.raises(ValueError, match=r"task: 'Hold'; expected one of Hop, Throw"):
        taught_starts("Hold")
    with pytest.raises(ValueError, match="plays: 0"):
        taught_starts("Throw", plays=0)
    with pytest.raises(ValueError, match="limits: 3"):
        taught_starts("Throw", limits=3)  # type: ignore[arg-type]


def test_an_agent_outside_of_an_environment_does_what_it_does_inside() -> None:
    agent = shipped_agent("ThrowAndCatch")
    env = DiaboloEnv("ThrowAndCatch", period=agent.period, steps=agent.steps)
    seen, _ = env.reset(seed=4, options={"goal": (0.5, 0.1)})
    state, left, right = env.pose()
    live = LiveAgent(agent, left, right, (0.5, 0.1))
    for _ in range(40):
        left, right, left_velocity, _ = live.act(state)
        seen, _, over, _, _ = env.step(agent.act(seen))
        state, *places = env.pose()
        np.testing.assert_allclose(places, [left, right], atol=1e-6)
        assert np.abs(left_velocity).max() <= HandLimits().speed + 1e-9
        assert not over


def test_a_live_agent_refuses_what_it_cannot_play_with() -> None:
    agent = shipped_agent("ThrowAndCatch")
    left, right = (0.0, 0.3, 1.25), (0.0, -0.3, 1.25)
    with pytest.raises(ValueError, match="goal: 1 numbers; expected 2"):
        LiveAgent(agent, left, right, (0.5,))
    with pytest.raises(ValueError, match="hands: a tip at 3 m"):
        LiveAgent(agent, (0.0, 3.0, 1.25), right, (0.5, 0.1))
    with pytest.raises(TypeError, match="state"):
        LiveAgent(agent, left, right, (0.5, 0.1)).act((0.0, 0.0, 0.6))  # type: ignore[arg-type]
