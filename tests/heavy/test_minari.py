# SPDX-License-Identifier: MIT
"""Plays as data sets of Minari."""

from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.learn
minari = pytest.importorskip("minari")
from diabolo import Model  # noqa: E402
from diabolo.cli import main  # noqa: E402
from diabolo.envs import play, shipped_agent  # noqa: E402
from diabolo.envs.minari import record  # noqa: E402

NAME = "diabolo/spin-up-v0"


@pytest.fixture(autouse=True)
def kept_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path / "sets"))


def test_what_was_played_is_read_again() -> None:
    agent = shipped_agent("SpinUp")
    outcomes = record(NAME, agent, 3, seed=7, difficulty="real")
    np.testing.assert_array_equal(outcomes["worth"], play(agent, 3, seed=7, difficulty="real")["worth"])
    dataset = minari.load_dataset(NAME)
    assert dataset.total_episodes == 3
    env = dataset.recover_environment()
    for i, episode in enumerate(dataset.iterate_episodes()):
        seen, _ = env.reset(seed=7 + i)
        np.testing.assert_array_equal(episode.observations[0], seen)
        for step, action in enumerate(episode.actions):
            seen, reward, terminated, truncated, _ = env.step(action)
            np.testing.assert_array_equal(episode.observations[step + 1], seen)
            assert episode.rewards[step] == reward
            assert (episode.terminations[step], episode.truncations[step]) == (terminated, truncated)
        assert terminated or truncated
        assert episode.rewards.sum() == pytest.approx(outcomes["worth"][i])


def test_an_episode_ends_where_it_was_dropped() -> None:
    random = np.random.default_rng(4)
    outcomes = record(NAME, lambda seen: random.uniform(-9, 9, (len(seen), 6)), 20, task="Throw")
    lengths = [len(episode.rewards) for episode in minari.load_dataset(NAME).iterate_episodes()]
    assert len(set(lengths)) > 1
    np.testing.assert_allclose(0.01 * np.array(lengths), outcomes["seconds"])


def test_the_command_records_on_other_models_too() -> None:
    assert main(["play", "SpinUp", "--episodes", "2", "--model", "paper", "--minari", NAME]) == 0
    dataset = minari.load_dataset(NAME)
    assert dataset.total_episodes == 2
    with pytest.raises(ValueError, match="cannot be recovered"):
        dataset.recover_environment()


def test_nothing_is_left_where_writing_fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*arguments: object, **options: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("minari.dataset.minari_storage.MinariStorage.update_metadata", full)
    with pytest.raises(ValueError, match=r"spin-up-v0: cannot be written \(No space left on device\)"):
        record(NAME, shipped_agent("SpinUp"), 1, model=Model.named("paper"))
    assert not (tmp_path / "sets" / NAME).exists()


@pytest.mark.parametrize(
    ("name", "complaint"),
    [
        ("no name", "expected a name such as diabolo/spin-up-v0"),
        ("noversion", "expected a name such as diabolo/spin-up-v0"),
        ("there-v0", "data set there-v0: is there; expected another name or version"),
    ],
)
def test_a_bad_name_is_told_in_one_sentence(
    name: str, complaint: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "sets" / "there-v0").mkdir(parents=True)
    assert main(["play", "SpinUp", "--episodes", "1", "--minari", name]) == 2
    error = capsys.readouterr().err
    assert complaint in error and error.count("\n") == 1
