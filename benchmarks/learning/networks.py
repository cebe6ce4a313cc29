# SPDX-License-Identifier: MIT
"""Networks that predict a diabolo: the paper's, rebuilt from its section IV-B, and a stronger one.

Both see the state (place, velocity, spin) and the tips at a row and at the next one, in a frame that moves
with the middle of the tips at that row, and give the state at the next row. The paper has a minus where it
defines the middle, which we read as a plus. Weights and training data of its network are not public.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

STATE, TIPS = 7, 6
GRAVITY = 9.81


@dataclass(frozen=True)
class Track:
    """Rows at a constant rate: states (n, 7), NaN where unknown, and tips (n, 6), left before right."""

    states: NDArray[np.float64]
    tips: NDArray[np.float64]
    dt: float


def sequences(tracks: Sequence[Track], length: int, stride: int) -> tuple[Tensor, Tensor]:
    """Runs of `length` + 1 rows in which all is known: states (m, length + 1, 7), tips (m, length + 1, 6)."""
    states, tips = [], []
    for track in tracks:
        known = np.isfinite(track.states).all(1) & np.isfinite(track.tips).all(1)
        for i in range(0, len(known) - length, stride):
            if known[i : i + length + 1].all():
                states.append(track.states[i : i + length + 1])
                tips.append(track.tips[i : i + length + 1])
    if not states:
        raise ValueError(f"no {length + 1} rows in a row in which all is known; expected longer takes")
    return torch.tensor(np.array(states)).float(), torch.tensor(np.array(tips)).float()


def inputs(state: Tensor, tips: Tensor, following: Tensor) -> Tensor:
    """What a network sees, (n, 19): all places relative to the middle of the tips at this row."""
    middle = 0.5 * (tips[:, :3] + tips[:, 3:])
    both = middle.repeat(1, 2)
    return torch.cat([state[:, :3] - middle, state[:, 3:], following - both, tips - both], 1)


class Network(nn.Module):
    """Layers of 100 units with ReLU, all but the last; what goes in and comes out is standardised."""

    def __init__(self, layers: int = 3, units: int = 100, outputs: int = STATE) -> None:
        super().__init__()
        sizes = [STATE + 2 * TIPS, *([units] * layers)]
        hidden = [one for a, b in pairwise(sizes) for one in (nn.Linear(a, b), nn.ReLU())]
        self.layers = nn.Sequential(*hidden, nn.Linear(units, outputs))
        for name, size in (("in", STATE + 2 * TIPS), ("out", outputs)):
            self.register_buffer(f"{name}_mean", torch.zeros(size))
            self.register_buffer(f"{name}_scale", torch.ones(size))

    def standardise(self, seen: Tensor, wanted: Tensor) -> None:
        for name, values in (("in", seen), ("out", wanted)):
            getattr(self, f"{name}_mean").copy_(values.mean(0))
            getattr(self, f"{name}_scale").copy_(values.std(0).clamp(min=1e-6))

    def forward(self, seen: Tensor) -> Tensor:
        return self.layers((seen - self.in_mean) / self.in_scale) * self.out_scale + self.out_mean


class PaperNetwork:
    """The paper's recipe: the next state itself, trained row by row; `steps` of Adam in place of EPOCHS."""

    name = "neural net, rebuilt"
    EPOCHS = 200

    def __init__(self, tracks: Sequence[Track], seed: int, steps: int | None = None) -> None:
        torch.manual_seed(seed)
        states, tips = sequences(tracks, 1, 1)
        seen, wanted = inputs(states[:, 0], tips[:, 0], tips[:, 1]), self._relative(states[:, 1], tips[:, 0])
        self.network = Network()
        self.network.standardise(seen, wanted)
        scale = self.network.out_scale

        def loss(batch: Tensor) -> Tensor:
            return (((self.network(seen[batch]) - wanted[batch]) / scale) ** 2).mean()

        _descend(self.network, loss, len(seen), 256, self.EPOCHS, steps)

    @staticmethod
    def _relative(state: Tensor, tips: Tensor) -> Tensor:
        return torch.cat([state[:, :3] - 0.5 * (tips[:, :3] + tips[:, 3:]), state[:, 3:]], 1)

    def step(self, state: Tensor, tips: Tensor, following: Tensor, dt: float) -> Tensor:
        result = self.network(inputs(state, tips, following))
        return torch.cat([result[:, :3] + 0.5 * (tips[:, :3] + tips[:, 3:]), result[:, 3:]], 1)


class StrongNetwork:
    """Increments beside free fall, a loss over unrolled rows, noise on the start, mirrored and turned copies,
    and the mean of several networks."""

    name = "neural net, strong"
    UNROLLED, MEMBERS, TURNS, EPOCHS = 24, 3, 2, 6

    def __init__(self, tracks: Sequence[Track], seed: int, steps: int | None = None) -> None:
        torch.manual_seed(seed)
        dt = tracks[0].dt
        states, tips = self._copies(*sequences(tracks, self.UNROLLED, 3))
        first = inputs(states[:, 0], tips[:, 0], tips[:, 1])
        self.scale = torch.tensor([0.1, 0.1, 0.1, 1.0, 1.0, 1.0, 10.0])
        noise = torch.tensor([1e-3, 1e-3, 1e-3, 0.05, 0.05, 0.05, 1.0])
        self.networks = []
        for _ in range(self.MEMBERS):
            network = Network(2, 128, 4)
            network.standardise(first, self._increments(states, dt))

            def loss(batch: Tensor, network: Network = network) -> Tensor:
                state, total = states[batch, 0] + noise * torch.randn(len(batch), STATE), torch.zeros(())
                for k in range(self.UNROLLED):
                    state = self._advance(network, state, tips[batch, k], tips[batch, k + 1], dt)
                    total = total + nn.functional.smooth_l1_loss(
                        state / self.scale, states[batch, k + 1] / self.scale
                    )
                return total / self.UNROLLED

            _descend(network, loss, len(states), 512, self.EPOCHS, steps)
            self.networks.append(network)

    @staticmethod
    def _increments(states: Tensor, dt: float) -> Tensor:
        change = (states[:, 1] - states[:, 0])[:, 3:].clone()
        change[:, 2] += GRAVITY * dt
        return change

    def _copies(self, states: Tensor, tips: Tensor) -> tuple[Tensor, Tensor]:
        """What is as true seen in a mirror, in which left and right change and the spin its sign, and turned
        about the vertical."""
        mirror = torch.tensor([1.0, -1.0, 1.0])
        swapped = torch.cat([tips[..., 3:] * mirror, tips[..., :3] * mirror], -1)
        flipped = states * torch.cat([mirror, mirror, torch.tensor([-1.0])])
        states, tips = torch.cat([states, flipped]), torch.cat([tips, swapped])
        every = [(states, tips)]
        for _ in range(self.TURNS - 1):
            angle = 2.0 * np.pi * torch.rand(()).item()
            c, s = float(np.cos(angle)), float(np.sin(angle))
            turn = torch.tensor([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
            parts = [states[..., :3] @ turn, states[..., 3:6] @ turn, states[..., 6:]]
            every.append((torch.cat(parts, -1), torch.cat([tips[..., :3] @ turn, tips[..., 3:] @ turn], -1)))
        return torch.cat([one for one, _ in every]), torch.cat([one for _, one in every])

    @staticmethod
    def _advance(network: Network, state: Tensor, tips: Tensor, following: Tensor, dt: float) -> Tensor:
        change = network(inputs(state, tips, following))
        velocity = state[:, 3:6] + change[:, :3] - torch.tensor([0.0, 0.0, GRAVITY * dt])
        place = state[:, :3] + 0.5 * dt * (state[:, 3:6] + velocity)
        return torch.cat([place, velocity, state[:, 6:] + change[:, 3:]], 1)

    def step(self, state: Tensor, tips: Tensor, following: Tensor, dt: float) -> Tensor:
        each = [self._advance(network, state, tips, following, dt) for network in self.networks]
        return torch.stack(each).mean(0)


def _descend(network: Network, loss, count: int, size: int, epochs: int, steps: int | None) -> None:  # type: ignore[no-untyped-def]
    """By Adam, with a rate that falls to nothing."""
    if steps is None:
        steps = epochs * max(1, count // size)
    optimiser = torch.optim.Adam(network.parameters(), lr=1e-3)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, steps)
    for _ in range(steps):
        optimiser.zero_grad()
        value = loss(torch.randint(count, (min(size, count),)))
        value.backward()
        nn.utils.clip_grad_norm_(network.parameters(), 1.0)
        optimiser.step()
        schedule.step()


@torch.no_grad()
def predicted(
    network: PaperNetwork | StrongNetwork, start: NDArray[np.float64], tips: NDArray[np.float64], dt: float
) -> NDArray[np.float64]:
    """Places at each row of `tips` (m, n, 6) from states (m, 7) at the first: (m, n, 3)."""
    state, path = torch.tensor(start).float(), torch.tensor(tips).float()
    places = [state[:, :3]]
    for k in range(path.shape[1] - 1):
        state = network.step(state, path[:, k], path[:, k + 1], dt)
        places.append(state[:, :3])
    return torch.stack(places, 1).double().numpy()
