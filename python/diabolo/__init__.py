# SPDX-License-Identifier: MIT
"""Simulation, planning and diagnosis of diabolo play."""

from ._core import (
    Model,
    ParameterInfo,
    Parameters,
    Predictor,
    Spheroid,
    State,
    StepStatus,
    StringElasticity,
    TipMotion,
    __version__,
)
from .enums import (
    FlightRule,
    Integrator,
    Interpolation,
    NormalRule,
    Projection,
    SpinRule,
    StringLaw,
    StringState,
    ThinRule,
)
from .rollout import Rollout, RolloutGradient, rollout, rollout_gradient

__all__ = [
    "FlightRule",
    "Integrator",
    "Interpolation",
    "Model",
    "NormalRule",
    "ParameterInfo",
    "Parameters",
    "Predictor",
    "Projection",
    "Rollout",
    "RolloutGradient",
    "SpinRule",
    "Spheroid",
    "State",
    "StepStatus",
    "StringElasticity",
    "StringLaw",
    "StringState",
    "ThinRule",
    "TipMotion",
    "__version__",
    "rollout",
    "rollout_gradient",
]
