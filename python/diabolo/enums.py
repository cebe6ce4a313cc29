# SPDX-License-Identifier: MIT
"""The choices that parameters and functions offer; each member is its name, so that a plain str does too."""

from enum import Enum, IntEnum


class _Choice(str, Enum):
    """A str with a fixed set of values."""

    __str__ = str.__str__


class StringLaw(_Choice):
    """How the string acts on the diabolo."""

    PULL_VELOCITY = "pull_velocity"
    """The paper's: put back on the spheroid, a capped part of the correction becomes velocity."""
    INEXTENSIBLE = "inextensible"
    """A massless string that does not stretch: velocity consistent with the constraint."""


class Projection(_Choice):
    """Where a diabolo outside the spheroid is put back."""

    RADIAL = "radial"
    CLOSEST_POINT = "closest_point"


class NormalRule(_Choice):
    """Which direction counts as the spheroid's normal."""

    PUBLISHED = "published"
    TRUE = "true"


class FlightRule(_Choice):
    """When the diabolo leaves the string and comes back to it."""

    PUBLISHED = "published"
    """The authors' program: above the plane of the tips and between them."""
    PAPER = "paper"
    """The paper's c_L and c_F on the signed distance."""
    SLACK = "slack"
    """Ours: as the paper, on the slack of the string, and caught inside the spheroid only."""


class ThinRule(_Choice):
    """What happens to the pull when the spheroid is thin."""

    PUBLISHED = "published"
    """It loses its component along (left - right) x z and keeps its magnitude."""
    PAPER = "paper"
    """It acts along x cross (left - right) only."""


class SpinRule(_Choice):
    """How passing string drives the spin."""

    SLIP = "slip"
    """In proportion to the slip between string and axle."""
    LENGTH_CHANGE = "length_change"
    """The paper's mu times the change of the distance to the right tip."""


class Integrator(_Choice):
    """How the free motion is stepped."""

    EULER = "euler"
    PARABOLIC = "parabolic"


class Interpolation(_Choice):
    """How tips are read between the given instants."""

    HELD = "held"
    """Each pose is held until the next one (the published program)."""
    LINEAR = "linear"
    """Straight lines."""
    SPLINE = "spline"
    """Natural cubic spline: continuous velocity and acceleration."""


class StringState(IntEnum):
    """Where the string is; arrays hold the numbers."""

    ON_STRING = 0
    """The string is taut around the axle."""
    LOOSE = 1
    """Between the cups, too loose to act."""
    FLYING = 2
    """The diabolo has left the string."""
