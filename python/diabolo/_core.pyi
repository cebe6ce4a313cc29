"""
Compiled core of diabolo: the header-only C++ library, bound for Python.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import os
import typing
__all__: list[str] = ['AIMS', 'Action', 'Adequacy', 'Agent', 'Air', 'Arena', 'AttachedString', 'Belief', 'Calibration', 'Camera', 'CatchRule', 'ChangeInTime', 'ClaimedEffect', 'ComparedLaw', 'DIAGNOSIS_SCHEMA', 'DiaboloProperties', 'DiagnosisResult', 'DifferingEffect', 'EffectPlace', 'EffectSize', 'EpisodeStart', 'ErrorSummary', 'Estimate', 'Estimator', 'ExcerptScore', 'FiniteAxle', 'FormulaLaws', 'Freedom', 'GoalCost', 'Goals', 'GravityTilt', 'Groove', 'GyroscopicTilt', 'HandLimits', 'HandPlan', 'HeldOutErrors', 'HorizonScore', 'InputFile', 'Interval', 'LadderRow', 'LandingRestitution', 'LearntLawFound', 'LevelHands', 'LevelHorizon', 'LimitUse', 'LiveAgent', 'LocatedDirection', 'LocatedWindow', 'Location', 'MagnusLift', 'Model', 'PLANNED_ACTIONS', 'ParameterInfo', 'Parameters', 'ParametersAlone', 'Plan', 'PlannedPlay', 'Predictor', 'ProposedMotion', 'RecedingHorizon', 'Recording', 'RecordingError', 'RecordingNoise', 'ResidualAndNoise', 'ResidualFit', 'ResidualForce', 'RobotLimits', 'Seam', 'SeedGrid', 'SimulatorComparison', 'Spheroid', 'SpinLoss', 'State', 'StepStatus', 'StickArm', 'StickFlex', 'StickMap', 'StickSpline', 'StringElasticity', 'StringFriction', 'StringMass', 'StringWrench', 'Thresholds', 'TipLimits', 'TipMotion', 'TipPath', 'TrackedBody', 'TrackedTake', 'Unbalance', 'UnnamedForce', 'UnnamedPlace', 'UnnamedStructure', 'UpperLimit', 'Waypoint', 'action', 'aimed_again', 'arm_hand_limits', 'baseline', 'best_guess', 'check_plan', 'compare_simulator', 'diagnose', 'diagnosis_schema', 'fit_residual', 'follow_pointers', 'foresee', 'hand_plan', 'hang_at_rest', 'hanging_state', 'home_pose', 'keep_limits', 'largest_spin', 'lessons', 'limit_uses', 'load_recording', 'load_tip_plan', 'model_for', 'observation_infos', 'plan', 'plan_action', 'plan_cost', 'played_orientation', 'played_properties', 'played_recording', 'predict', 'read_recording', 'read_text', 'recorded_plan', 'recording_of_bodies', 'rollout', 'rollout_gradient', 'score_excerpt', 'score_excerpts', 'score_horizons', 'start_state', 'stretch_starts', 'success_rate', 'task_infos', 'taught_starts', 'trim_overlaps', 'ur5e_inverse']
class ParameterInfo:
  """Name, unit and range of a numeric parameter."""
  @property
  def maximum(self) -> float: ...
  @property
  def meaning(self) -> str: ...
  @property
  def minimum(self) -> float: ...
  @property
  def name(self) -> str: ...
  @property
  def unit(self) -> str: ...
class Parameters:
  """
  Everything that the predictor can be told.
  
    Parameters(string_length=1.4)              # ours: an inextensible string, the default
    Parameters.paper(axle_radius=0.007)        # the rules of the paper's text
    Parameters.published()                     # the authors' program
  
  Keywords set fields; a rule is chosen by a member of its enumeration or by its name. A value out of its range
  is a ValueError that names the field, the value and the range.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def consistent(**kwargs) -> Parameters:
    """Inextensible massless string without friction; results converge as the step goes to zero."""
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every numeric field (ParameterInfo)."""
  @staticmethod
  def paper(**kwargs) -> Parameters:
    """The rules of the paper's text with its errata corrected."""
  @staticmethod
  def published(**kwargs) -> Parameters:
    """The authors' program, rule by rule, with the settings of its evaluation."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def replace(self, **kwargs) -> Parameters:
    """A copy with other values in the given fields."""
  def to_dict(self) -> dict:
    """All fields by name; Parameters(**fields) builds them again."""
  @property
  def axle_radius(self) -> float:
    """radius of the axle [m]; within [0.0001, 0.1]"""
  @axle_radius.setter
  def axle_radius(self, arg1: _Real) -> None: ...
  @property
  def cap_scale(self) -> float:
    """paper: part of the spheroid's motion that caps the pull [1]; within [0.0, 1.0]"""
  @cap_scale.setter
  def cap_scale(self, arg1: _Real) -> None: ...
  @property
  def catch_distance(self) -> float:
    """a catch needs the diabolo this close to the line of the tips [m]; within [0.0, 1.0]"""
  @catch_distance.setter
  def catch_distance(self, arg1: _Real) -> None: ...
  @property
  def catch_slack(self) -> float:
    """a catch needs tips no closer than the string length minus this [m]; within [0.0, 20.0]"""
  @catch_slack.setter
  def catch_slack(self, arg1: _Real) -> None: ...
  @property
  def dissipation_rate(self) -> float:
    """decay of the velocity while on the string [1/s]; within [0.0, 1000.0]"""
  @dissipation_rate.setter
  def dissipation_rate(self, arg1: _Real) -> None: ...
  @property
  def flight_rule(self) -> str:
    """when the diabolo leaves the string and comes back to it, as in diabolo.FlightRule: 'published' 'paper' 'slack'"""
  @flight_rule.setter
  def flight_rule(self, arg1: str) -> None: ...
  @property
  def flying_distance(self) -> float:
    """paper's c_F [m]; within [0.0, 1.0]"""
  @flying_distance.setter
  def flying_distance(self, arg1: _Real) -> None: ...
  @property
  def follow_turns(self) -> bool:
    """let turns of the string around the axle come and go, from `wraps` on"""
  @follow_turns.setter
  def follow_turns(self, arg1: bool) -> None: ...
  @property
  def gravity(self) -> float:
    """acceleration of gravity, downwards [m/s^2]; within [0.0, 100.0]"""
  @gravity.setter
  def gravity(self, arg1: _Real) -> None: ...
  @property
  def integrator(self) -> str:
    """of the free motion, as in diabolo.Integrator: 'euler' 'parabolic'"""
  @integrator.setter
  def integrator(self, arg1: str) -> None: ...
  @property
  def loose_distance(self) -> float:
    """paper's c_L [m]; within [0.0, 1.0]"""
  @loose_distance.setter
  def loose_distance(self, arg1: _Real) -> None: ...
  @property
  def mass(self) -> float:
    """mass of the diabolo [kg]; within [0.001, 10.0]"""
  @mass.setter
  def mass(self, arg1: _Real) -> None: ...
  @property
  def mu_acceleration(self) -> float:
    """paper: spin per growth of the right strand [rad/m]; within [0.0, 10000.0]"""
  @mu_acceleration.setter
  def mu_acceleration(self, arg1: _Real) -> None: ...
  @property
  def mu_deceleration(self) -> float:
    """paper: spin per shrinking of the right strand [rad/m]; within [0.0, 10000.0]"""
  @mu_deceleration.setter
  def mu_deceleration(self, arg1: _Real) -> None: ...
  @property
  def normal_rule(self) -> str:
    """which direction counts as the spheroid's normal, as in diabolo.NormalRule: 'published' 'true'"""
  @normal_rule.setter
  def normal_rule(self, arg1: str) -> None: ...
  @property
  def per_step(self) -> bool:
    """apply the factors as if every step were a reference step, so that the motion depends on the step"""
  @per_step.setter
  def per_step(self, arg1: bool) -> None: ...
  @property
  def planar(self) -> bool:
    """keep the diabolo in the plane through its start square to plane_normal"""
  @planar.setter
  def planar(self, arg1: bool) -> None: ...
  @property
  def plane_normal(self) -> _Array:
    """unit vector, shape (3,)"""
  @plane_normal.setter
  def plane_normal(self, arg1: _Reals) -> None: ...
  @property
  def projection(self) -> str:
    """where a diabolo outside the spheroid is put back, as in diabolo.Projection: 'radial' 'closest_point'"""
  @projection.setter
  def projection(self, arg1: str) -> None: ...
  @property
  def pull_scale(self) -> float:
    """paper: part of the correction that becomes velocity, before the cap [1]; within [0.0, 1.0]"""
  @pull_scale.setter
  def pull_scale(self, arg1: _Real) -> None: ...
  @property
  def pull_scale_after_cap(self) -> float:
    """paper: damping of the pull after the cap, per reference step [1]; within [0.0, 1.0]"""
  @pull_scale_after_cap.setter
  def pull_scale_after_cap(self, arg1: _Real) -> None: ...
  @property
  def reference_step(self) -> float:
    """step that the per-step factors are stated for [s]; within [1e-06, 0.1]"""
  @reference_step.setter
  def reference_step(self, arg1: _Real) -> None: ...
  @property
  def release_when_overstretched(self) -> bool:
    """let go where the tips are farther apart than the string, instead of holding the diabolo"""
  @release_when_overstretched.setter
  def release_when_overstretched(self, arg1: bool) -> None: ...
  @property
  def spin_coupling(self) -> float:
    """rate at which slip on the axle is worn off [1/s]; within [0.0, 1000.0]"""
  @spin_coupling.setter
  def spin_coupling(self, arg1: _Real) -> None: ...
  @property
  def spin_rule(self) -> str:
    """how passing string drives the spin, as in diabolo.SpinRule: 'slip' 'length_change'"""
  @spin_rule.setter
  def spin_rule(self, arg1: str) -> None: ...
  @property
  def string_law(self) -> str:
    """how the string acts on the diabolo, as in diabolo.StringLaw: 'pull_velocity' 'inextensible'"""
  @string_law.setter
  def string_law(self, arg1: str) -> None: ...
  @property
  def string_length(self) -> float:
    """length of the string between the tips [m]; within [0.05, 20.0]"""
  @string_length.setter
  def string_length(self, arg1: _Real) -> None: ...
  @property
  def thin_rule(self) -> str:
    """what happens to the pull when the spheroid is thin, as in diabolo.ThinRule: 'published' 'paper'"""
  @thin_rule.setter
  def thin_rule(self, arg1: str) -> None: ...
  @property
  def thin_slack(self) -> float:
    """the spheroid is thin when the tips are farther apart than L minus this [m]; within [0.0, 20.0]"""
  @thin_slack.setter
  def thin_slack(self, arg1: _Real) -> None: ...
  @property
  def wraps(self) -> float:
    """whole turns of the string around the axle beyond the pass under it [1]; within [0.0, 5.0]"""
  @wraps.setter
  def wraps(self, arg1: _Real) -> None: ...
class StringElasticity:
  """
  A string that stretches.
  
  Its tension is stiffness times extension plus damping times the extension's rate, while positive. The
  amplitude is the compliance, so that zero, the default, is the rigid string.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  @staticmethod
  def of_stiffness(stiffness: _Real, damping: _Real = 0.0) -> StringElasticity:
    """Stiffness [N/m] and damping [N s/m] of the path length."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def compliance(self) -> float:
    """extension of the path length per tension [m/N]; within [0.0, 1.0]"""
  @compliance.setter
  def compliance(self, arg1: _Real) -> None: ...
  @property
  def damping(self) -> float:
    """tension per rate of the path length [N s/m]; within [0.0, 10000.0]"""
  @damping.setter
  def damping(self, arg1: _Real) -> None: ...
class StringFriction:
  """
  A string that rubs on the axle: Euler's and Eytelwein's capstan law.
  
  While it slips towards the right tip, T_right / T_left = exp(coefficient * contact angle). The difference turns
  the axle, too: dw/dt = spin_gain (T_right - T_left) / mass. It adds to Parameters.spin_coupling, which
  stands for the same torque as a rate; set that to zero where friction alone drives the spin.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def coefficient(self) -> float:
    """capstan coefficient of string on axle [1]; within [0.0, 3.0]"""
  @coefficient.setter
  def coefficient(self, arg1: _Real) -> None: ...
  @property
  def spin_gain(self) -> float:
    """mass times axle radius over axial moment of inertia [1/m]; within [0.0, 1000.0]"""
  @spin_gain.setter
  def spin_gain(self, arg1: _Real) -> None: ...
class Air:
  """Air that holds the diabolo back: a = -(linear_drag + quadratic_drag |u|) u, u = v - wind."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def linear_drag(self) -> float:
    """deceleration per speed [1/s]; within [0.0, 10.0]"""
  @linear_drag.setter
  def linear_drag(self, arg1: _Real) -> None: ...
  @property
  def quadratic_drag(self) -> float:
    """deceleration per squared speed [1/m]; within [0.0, 10.0]"""
  @quadratic_drag.setter
  def quadratic_drag(self, arg1: _Real) -> None: ...
  @property
  def wind_x(self) -> float:
    """velocity of the air, forward [m/s]; within [-100.0, 100.0]"""
  @wind_x.setter
  def wind_x(self, arg1: _Real) -> None: ...
  @property
  def wind_y(self) -> float:
    """velocity of the air, to the left [m/s]; within [-100.0, 100.0]"""
  @wind_y.setter
  def wind_y(self, arg1: _Real) -> None: ...
class MagnusLift:
  """Lift of a spinning diabolo: a = coefficient * omega x v, omega = -spin * axis."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def coefficient(self) -> float:
    """acceleration per angular velocity and speed [1/rad]; within [-1.0, 1.0]"""
  @coefficient.setter
  def coefficient(self, arg1: _Real) -> None: ...
class SpinLoss:
  """What slows the spin beside the string: dw/dt = -air w|w| - axle sign(w)."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def air(self) -> float:
    """deceleration per squared spin [1/rad]; within [0.0, 1.0]"""
  @air.setter
  def air(self, arg1: _Real) -> None: ...
  @property
  def axle(self) -> float:
    """constant deceleration [rad/s^2]; within [0.0, 10000.0]"""
  @axle.setter
  def axle(self, arg1: _Real) -> None: ...
class GravityTilt:
  """Gravity along (x, y, -sqrt(1 - x^2 - y^2)) instead of -z: a frame that is not level."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def x(self) -> float:
    """gravity's direction, forward [1]; within [-0.5, 0.5]"""
  @x.setter
  def x(self, arg1: _Real) -> None: ...
  @property
  def y(self) -> float:
    """gravity's direction, to the left [1]; within [-0.5, 0.5]"""
  @y.setter
  def y(self, arg1: _Real) -> None: ...
class FiniteAxle:
  """An axle that is not thin: string lies around it, and the strands leave it along its tangents."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def follows_axis(self) -> float:
    """1: the axle points along the state's axis; 0: square to both strands [1]; within [0.0, 1.0]"""
  @follows_axis.setter
  def follows_axis(self, arg1: _Real) -> None: ...
  @property
  def radius(self) -> float:
    """of the axle, to the string's centre line [m]; within [0.0, 0.1]"""
  @radius.setter
  def radius(self, arg1: _Real) -> None: ...
class Groove:
  """
  A round groove whose flanks the string climbs, towards the tips.
  
  The string then pulls from up to half_width beside the centre and yaws the axle, where a GyroscopicTilt has its gain;
  at the edge it brakes the spin by flank_brake times the force along the axle over the mass.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def flank_brake(self) -> float:
    """friction on the flank times its radius times mass over axial moment of inertia [1/m]; within [0.0, 1000.0]"""
  @flank_brake.setter
  def flank_brake(self, arg1: _Real) -> None: ...
  @property
  def half_width(self) -> float:
    """how far the string may climb from its middle [m]; within [0.0, 0.1]"""
  @half_width.setter
  def half_width(self, arg1: _Real) -> None: ...
  @property
  def profile_radius(self) -> float:
    """of the groove's bottom, in a cut along the axle [m]; within [0.0, 1.0]"""
  @profile_radius.setter
  def profile_radius(self, arg1: _Real) -> None: ...
class StickFlex:
  """Sticks that bend: each tip gives by compliance times the string's pull, square to its stick."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def compliance(self) -> float:
    """of one tip, square to its stick [m/N]; within [0.0, 1.0]"""
  @compliance.setter
  def compliance(self, arg1: _Real) -> None: ...
  @property
  def damping(self) -> float:
    """of one tip [N s/m]; within [0.0, 10000.0]"""
  @damping.setter
  def damping(self, arg1: _Real) -> None: ...
  @property
  def tip_mass(self) -> float:
    """that moves with one tip [kg]; within [0.0, 1.0]"""
  @tip_mass.setter
  def tip_mass(self, arg1: _Real) -> None: ...
class StringMass:
  """A string that weighs something: while it is loose, half of it hangs on the diabolo."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def linear_density(self) -> float:
    """of the string [kg/m]; within [0.0, 0.1]"""
  @linear_density.setter
  def linear_density(self, arg1: _Real) -> None: ...
class LandingRestitution:
  """A catch that bounces: of the rate at which a string that comes taut would stretch, so much is given back."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def coefficient(self) -> float:
    """of the string's rate of stretch that a catch gives back [1]; within [0.0, 1.0]"""
  @coefficient.setter
  def coefficient(self, arg1: _Real) -> None: ...
class UnnamedForce:
  """
  A force without a name, as a diagnosis found it: accelerations times powers of speed and spin.
  
  Each amplitude [m/s^2] is that at 1 m/s and 100 rad/s; on the string along it (towards the right tip) and square to
  its plane, off it against the velocity, up, and along omega x v. It stops growing below 0.05 and above 20 m/s, below
  1 and above 1000 rad/s.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def flight_against(self) -> float:
    """off the string, against the velocity [m/s^2]; within [-100.0, 100.0]"""
  @flight_against.setter
  def flight_against(self, arg1: _Real) -> None: ...
  @property
  def flight_lift(self) -> float:
    """off the string, along omega x v [m/s^2]; within [-100.0, 100.0]"""
  @flight_lift.setter
  def flight_lift(self, arg1: _Real) -> None: ...
  @property
  def flight_vertical(self) -> float:
    """off the string, up [m/s^2]; within [-100.0, 100.0]"""
  @flight_vertical.setter
  def flight_vertical(self, arg1: _Real) -> None: ...
  @property
  def speed_exponent(self) -> float:
    """power of the speed over 1 m/s [1]; within [-4.0, 4.0]"""
  @speed_exponent.setter
  def speed_exponent(self, arg1: _Real) -> None: ...
  @property
  def spin_exponent(self) -> float:
    """power of the spin over 100 rad/s [1]; within [-4.0, 4.0]"""
  @spin_exponent.setter
  def spin_exponent(self, arg1: _Real) -> None: ...
  @property
  def string_binormal(self) -> float:
    """on the string, square to its plane, forwards [m/s^2]; within [-100.0, 100.0]"""
  @string_binormal.setter
  def string_binormal(self, arg1: _Real) -> None: ...
  @property
  def string_tangent(self) -> float:
    """on the string, along it towards the right tip, at 1 m/s and 100 rad/s [m/s^2]; within [-100.0, 100.0]"""
  @string_tangent.setter
  def string_tangent(self, arg1: _Real) -> None: ...
class GyroscopicTilt:
  """
  Strands that leave the axle aside turn it: gain = m r / I, I the axial moment of inertia.
  
  Without an inertia_ratio the axle follows slowly, ds/dt = torque / (I w). With one, the transverse over the axial
  moment of inertia (1 to 1.4), the diabolo is a rigid body that nutes, State.tumble its axle's angular velocity.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def decay(self) -> float:
    """decay of the nutation [1/s]; within [0.0, 1000.0]"""
  @decay.setter
  def decay(self, arg1: _Real) -> None: ...
  @property
  def gain(self) -> float:
    """mass times axle radius over axial moment of inertia [1/m]; within [0.0, 1000.0]"""
  @gain.setter
  def gain(self, arg1: _Real) -> None: ...
  @property
  def inertia_ratio(self) -> float:
    """transverse over axial moment of inertia; zero: no nutation [1]; within [0.0, 100.0]"""
  @inertia_ratio.setter
  def inertia_ratio(self, arg1: _Real) -> None: ...
class Unbalance:
  """
  Cups of unlike weight: the centre of mass lies `offset` beside the groove, along the axle.
  
  It yaws the axle, where a GyroscopicTilt has its gain.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def fields() -> list:
    """Name, unit and range of every field (ParameterInfo)."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> dict:
    """All fields by name."""
  @property
  def offset(self) -> float:
    """of the centre of mass from the groove's middle, along the axle [m]; within [-0.1, 0.1]"""
  @offset.setter
  def offset(self, arg1: _Real) -> None: ...
class FormulaLaws:
  """
  Laws by formulas: somebody's own, or learnt by a diagnosis.
  
    FormulaLaws([{"name": "creep", "plain": "a string that creeps", "acts": "string", "formula": "rate * t",
           "numbers": [{"name": "rate", "unit": "m/s", "usual": 0.001, "value": 0.002}]}])
  
  What a formula gives [m/s^2] acts forward, left, up, against (the velocity), along (the string), across (its plane) or
  lift (along omega x v); or it is the rate of the spin (spin, [rad/s^2]), a length added to the string (string, [m]) or
  to the coefficient of its friction (friction).
  It is made of its numbers, of `variables()`, of pi, + - * / ^ and of abs cos exp log max min sign sin sqrt tanh. The
  first number is the amplitude: where it is zero there is nothing. A diagnosis needs `usual`, the usual size of a
  number, and of the others `expected`, where it begins; `minimum` 0 says that a negative amplitude is against it.
  """
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def load(path: os.PathLike | str | bytes) -> FormulaLaws:
    """Reads a file of the schema diabolo.laws/1."""
  @staticmethod
  def variables() -> dict:
    """Name: (unit, meaning) of all that a formula may ask for."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, laws: typing.Any = []) -> None: ...
  def __len__(self) -> int: ...
  def to_json(self) -> str:
    """The text of their file."""
  def to_list(self) -> typing.Any:
    """The laws as the constructor takes them."""
class ResidualForce:
  """
  A force that was learnt from what named physics leaves.
  
  An acceleration in the string's frame by `fit_residual`: right along the tips, forward and level, up. Each is a sum of
  weights [m/s^2] times what the diabolo does: its velocity, place, spin and slip, the string's pull, and the hands'
  velocity. It fades out where nothing was seen, and neither its size nor its work are larger than there. Without
  arguments there is none.
  """
  __hash__: typing.ClassVar[None] = None
  def __bool__(self) -> bool: ...
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, **kwargs) -> None: ...
  def to_dict(self) -> typing.Any:
    """largest, power, on_string and off_string, as the constructor takes them."""
class Model:
  """
  Everything that decides a prediction.
  
    Model(Parameters(), string_elasticity=StringElasticity.of_stiffness(600.0))
  
  Parameters, and effects beyond the paper by keyword; an effect left out, or None, has the amplitude zero and
  changes nothing. Where a Model is to be simulated, Parameters will do.
  
  The rest matters where a recording is to be predicted: `interpolation` says how its tips are read between the
  samples, as in diabolo.Interpolation; string length, mass and axle radius are the recording's unless the model
  says that its own count.
  """
  __hash__: typing.ClassVar[None] = None
  name: str
  own_axle_radius: bool
  own_mass: bool
  parameters: Parameters
  @staticmethod
  def consistent() -> Model:
    """Ours: an inextensible string of the recording's length, tips on a smooth path."""
  @staticmethod
  def load(path: os.PathLike | str | bytes) -> Model:
    """Reads a model file (JSON) of the schema diabolo.model/1."""
  @staticmethod
  def named(name: str) -> Model:
    """'published', 'paper' or 'consistent'."""
  @staticmethod
  def paper() -> Model:
    """The rules of the paper's text: its own string of 1.45 m, held tips."""
  @staticmethod
  def published() -> Model:
    """The authors' program with the settings of its evaluation: its own string of 1.46 m, held tips."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, parameters: Parameters = ..., *, name: str = 'custom', interpolation: str = 'spline', own_string_length: bool = False, own_mass: bool = False, own_axle_radius: bool = False, **kwargs) -> None: ...
  def save(self, path: os.PathLike | str | bytes) -> None:
    """Writes a model file, whole or not at all."""
  def to_dict(self) -> dict:
    """The keyword arguments that make the model again."""
  def to_json(self) -> str:
    """The text of its file."""
  @property
  def air(self) -> Air: ...
  @air.setter
  def air(self, arg1: typing.Any) -> None: ...
  @property
  def finite_axle(self) -> FiniteAxle: ...
  @finite_axle.setter
  def finite_axle(self, arg1: typing.Any) -> None: ...
  @property
  def formula_laws(self) -> FormulaLaws:
    """Laws by formulas (FormulaLaws): a copy; set them anew to change them."""
  @formula_laws.setter
  def formula_laws(self, arg1: typing.Any) -> None: ...
  @property
  def gravity_tilt(self) -> GravityTilt: ...
  @gravity_tilt.setter
  def gravity_tilt(self, arg1: typing.Any) -> None: ...
  @property
  def groove(self) -> Groove: ...
  @groove.setter
  def groove(self, arg1: typing.Any) -> None: ...
  @property
  def gyroscopic_tilt(self) -> GyroscopicTilt: ...
  @gyroscopic_tilt.setter
  def gyroscopic_tilt(self, arg1: typing.Any) -> None: ...
  @property
  def interpolation(self) -> str:
    """How the tips of a recording are read between its samples, as in diabolo.Interpolation."""
  @interpolation.setter
  def interpolation(self, arg1: str) -> None: ...
  @property
  def landing_restitution(self) -> LandingRestitution: ...
  @landing_restitution.setter
  def landing_restitution(self, arg1: typing.Any) -> None: ...
  @property
  def magnus_lift(self) -> MagnusLift: ...
  @magnus_lift.setter
  def magnus_lift(self, arg1: typing.Any) -> None: ...
  @property
  def own_string_length(self) -> bool:
    """Whether parameters.string_length counts, whatever a recording says."""
  @own_string_length.setter
  def own_string_length(self, arg0: bool) -> None: ...
  @property
  def residual_force(self) -> ResidualForce:
    """What `fit_residual` learnt (ResidualForce), if anything: a copy; set it anew to change it."""
  @residual_force.setter
  def residual_force(self, arg1: typing.Any) -> None: ...
  @property
  def spin_loss(self) -> SpinLoss: ...
  @spin_loss.setter
  def spin_loss(self, arg1: typing.Any) -> None: ...
  @property
  def stick_flex(self) -> StickFlex: ...
  @stick_flex.setter
  def stick_flex(self, arg1: typing.Any) -> None: ...
  @property
  def string_elasticity(self) -> StringElasticity: ...
  @string_elasticity.setter
  def string_elasticity(self, arg1: typing.Any) -> None: ...
  @property
  def string_friction(self) -> StringFriction: ...
  @string_friction.setter
  def string_friction(self, arg1: typing.Any) -> None: ...
  @property
  def string_mass(self) -> StringMass: ...
  @string_mass.setter
  def string_mass(self, arg1: typing.Any) -> None: ...
  @property
  def unbalance(self) -> Unbalance: ...
  @unbalance.setter
  def unbalance(self, arg1: typing.Any) -> None: ...
  @property
  def unnamed_force(self) -> UnnamedForce: ...
  @unnamed_force.setter
  def unnamed_force(self, arg1: typing.Any) -> None: ...
class State:
  """
  State of the diabolo, a point mass that spins.
  
  `position` [m] and `velocity` [m/s] have the shape (3,), world frame: x forward (away from the player), y left,
  z up. `spin` [rad/s] is positive when the axle's surface under the string moves towards the right tip. The
  string is 'on_string', 'loose' or 'flying', as in diabolo.StringState. `axis`, a unit vector of the shape (3,),
  is the axle's direction, which only GyroscopicTilt turns; `tumble` [rad/s], of the shape (3,) and square to it, is
  its angular velocity, which only one with an inertia_ratio has. `turns` are those of the string around the axle
  beyond `Parameters.wraps`, the pass under it counted: about 0.4 under hands side by side, 1.4 with a turn more,
  below zero where the string runs around the axle the other way. A start of n means n whole turns and the pass that
  the strands show. Only `Parameters.follow_turns` looks at it and changes it.
  """
  def __init__(self, position: _Reals, velocity: _Reals = (0.0, 0.0, 0.0), spin: _Real = 0.0, string_state: typing.Any = 'loose', axis: _Reals = (1.0, 0.0, 0.0), tumble: _Reals = (0.0, 0.0, 0.0), turns: _Real = 0.0) -> None: ...
  def to_array(self) -> _Array:
    """Position, velocity and spin, shape (7,)."""
  @property
  def axis(self) -> _Array:
    """Direction of the axle, forward: a unit vector, shape (3,). Takes from tumble what is along it."""
  @axis.setter
  def axis(self, arg1: _Reals) -> None: ...
  @property
  def position(self) -> _Array:
    """Centre [m], shape (3,)."""
  @position.setter
  def position(self, arg1: _Reals) -> None: ...
  @property
  def spin(self) -> float:
    """[rad/s]"""
  @spin.setter
  def spin(self, arg1: _Real) -> None: ...
  @property
  def string_acceleration(self) -> _Array:
    """Mean acceleration by the string over the last step [m/s^2], shape (3,)."""
  @property
  def string_state(self) -> int:
    """A StringState; its number or its name may be assigned."""
  @string_state.setter
  def string_state(self, arg1: typing.Any) -> None: ...
  @property
  def tumble(self) -> _Array:
    """Angular velocity of the axle itself, square to it [rad/s], shape (3,)."""
  @tumble.setter
  def tumble(self, arg1: _Reals) -> None: ...
  @property
  def turns(self) -> float:
    """Of the string around the axle beyond Parameters.wraps, the pass under it counted."""
  @turns.setter
  def turns(self, arg1: _Real) -> None: ...
  @property
  def velocity(self) -> _Array:
    """[m/s], shape (3,)."""
  @velocity.setter
  def velocity(self, arg1: _Reals) -> None: ...
class DiaboloProperties:
  """What a diabolo is like."""
  @staticmethod
  def blue() -> DiaboloProperties:
    """The blue one, which runs on a bearing."""
  @staticmethod
  def green() -> DiaboloProperties: ...
  @staticmethod
  def patterned() -> DiaboloProperties: ...
  @staticmethod
  def red() -> DiaboloProperties:
    """The paper's red diabolo, without markers."""
  def __init__(self, mass: _Real, diameter: _Real, length: _Real, axle_radius: _Real = 0.0065) -> None: ...
  @property
  def axle_radius(self) -> float:
    """Where the string runs [m]."""
  @property
  def diameter(self) -> float:
    """Of the cups [m]."""
  @property
  def length(self) -> float:
    """Along the axle [m]."""
  @property
  def mass(self) -> float:
    """[kg]"""
class Calibration:
  """How the rigid bodies of a Motive take become the tips and the diabolo of a recording."""
  @staticmethod
  def blue() -> Calibration:
    """Of the blue diabolo; its tips are only estimates."""
  @staticmethod
  def load(path: os.PathLike | str | bytes) -> Calibration:
    """Reads a file of the schema diabolo.calibration/1."""
  @staticmethod
  def plain() -> Calibration:
    """Of bodies that are the tips and the diabolo themselves, in the world frame."""
  @staticmethod
  def published() -> Calibration:
    """Of the red diabolo with the sticks of July 2020; the default."""
  def completed_by(self, setup: Calibration) -> Calibration:
    """The same with string and diabolo of another where it only assumes them."""
  def of(self, properties: DiaboloProperties, string_length: _Real, assumed: collections.abc.Sequence[str] = []) -> Calibration:
    """The same for a diabolo and a string [m]; assumed: as that of a Recording."""
  def renamed(self, left: str = '', right: str = '', diabolo: str = '') -> Calibration:
    """The same for bodies of these names, where one is given."""
  def save(self, path: os.PathLike | str | bytes) -> None:
    """Writes it, whole or not at all."""
  def to_json(self) -> str:
    """The text of its file."""
class RecordingError(ValueError):
  """What is wrong with a recording, a calibration or one of their files."""
class Recording:
  """
  A recorded play: stick tips and diabolo over N samples.
  
  World frame: x forward (away from the player), y left, z up. Arrays are read-only views; a dropout is NaN. To
  make one from arrays, hand over `time` [s] of the shape (N,), positions [m] of the shape (N, 3) and, if known,
  orientations (x, y, z, w) of the shape (N, 4), body x being the spin axis or along the stick outwards. Without
  `properties` they are those of the paper's red diabolo, without `string_length` it is 1.46 m, as in the paper:
  assumed, which is warned of.
  """
  @staticmethod
  def load(path: os.PathLike | str | bytes, calibration: Calibration | None = None, *, up: str | None = None, columns: None | str | collections.abc.Mapping[str, str] = None) -> Recording:
    """
    Reads a Motive export (CSV), to which the calibration is applied (default: the published one), or a tidy
    recording.
    
    up: which axis of the file points up, "y" for Motive's default, "-z", or "y-mirrored" where left and right are
    exchanged, too. Without it that is z, and a file whose motion clearly says otherwise is refused.
    
    columns: maps a CSV of your own, {"time": "t[ms]", "left_x": "lx[mm]", ...} or "time=t[ms],left_x=lx[mm],...".
    Units are s, ms, us, ns; m, cm, mm, in, ft. Columns with tidy names need no mention. Without a JSON file beside
    it, string and diabolo are the calibration's, or assumed.
    """
  def __init__(self, time: _Reals, left: _Reals, right: _Reals, diabolo: _Reals, rate: _Real, *, diabolo_orientation: _Reals | None = None, left_orientation: _Reals | None = None, right_orientation: _Reals | None = None, name: str = 'recording', properties: DiaboloProperties | None = None, string_length: _Real | None = None) -> None: ...
  def __len__(self) -> int: ...
  def cut(self, first: _Whole, last: _Whole, *, name: str | None = None) -> Recording:
    """Rows first to last, both included; `name` is what the part is called, by default as the whole."""
  def put_right(self, *, up: str | None = None) -> Recording:
    """What a file of it would be read as, `up` being as of `load`: stamps that jitter are moved to even times, and a rate that they contradict gives way to theirs; markers that jump or freeze are masked; a frame that is turned by a quarter is turned back. `notes` tell. Raises RecordingError where the motion says that another axis points up, a coordinate was not recorded, or rows come too close together."""
  def resample(self, rate: _Real) -> Recording:
    """The recording at another rate [Hz]; dropouts are not bridged."""
  def save(self, path: os.PathLike | str | bytes) -> None:
    """Writes a tidy recording, NAME.csv and NAME.json beside it, whole or not at all."""
  def spin(self, signed: bool = True) -> _Array:
    """Spin between each sample and the next [rad/s], shape (N,), NaN where it is unknown. Unsigned: the published rule, which counts turning of the axle too."""
  def warnings(self) -> list[str]:
    """What its reader changed, and what is odd about it although it is well formed, such as other units, tips that are long unseen or rows that are missing; a sentence each."""
  @property
  def assumed(self) -> list[str]:
    """
    Those of "string_length" and "diabolo" (its mass and sizes) that nobody told.
    """
  @property
  def clock(self) -> float:
    """What laws in time go by, at the first sample [s]: a part keeps that of the whole."""
  @property
  def diabolo(self) -> _Array:
    """Centre of the axle [m], shape (N, 3)."""
  @property
  def diabolo_orientation(self) -> _Array | None:
    """Unit quaternions x, y, z, w, shape (N, 4), or None; body x is the spin axis."""
  @property
  def diabolo_valid(self) -> numpy.typing.NDArray[numpy.bool]:
    """False marks a dropout, shape (N,)."""
  @property
  def frame(self) -> numpy.typing.NDArray[numpy.int64]:
    """Number of each sample in its take, shape (N,)."""
  @property
  def left(self) -> _Array:
    """Left stick tip [m], shape (N, 3)."""
  @property
  def left_orientation(self) -> _Array | None:
    """Unit quaternions x, y, z, w, shape (N, 4), or None; body x runs along the stick, outwards."""
  @property
  def left_valid(self) -> numpy.typing.NDArray[numpy.bool]:
    """False marks a dropout, shape (N,)."""
  @property
  def name(self) -> str: ...
  @property
  def notes(self) -> list[str]:
    """What its reader changed or took for granted, a clause each."""
  @property
  def properties(self) -> DiaboloProperties: ...
  @property
  def rate(self) -> float:
    """Nominal sampling rate [Hz]."""
  @property
  def right(self) -> _Array:
    """Right stick tip [m], shape (N, 3)."""
  @property
  def right_orientation(self) -> _Array | None:
    """Unit quaternions x, y, z, w, shape (N, 4), or None; body x runs along the stick, outwards."""
  @property
  def right_valid(self) -> numpy.typing.NDArray[numpy.bool]:
    """False marks a dropout, shape (N,)."""
  @property
  def string_length(self) -> float:
    """[m]"""
  @property
  def time(self) -> _Array:
    """[s], shape (N,)."""
  @property
  def title(self) -> str:
    """What messages call it: the file that it was read from, or its name; of a part or one that is resampled, both."""
class TrackedBody:
  """A rigid body, in the frame of the motion capture."""
  @property
  def name(self) -> str: ...
  @property
  def position(self) -> _Array:
    """Of the body's origin [m], shape (N, 3); NaN in a dropout."""
  @property
  def quaternion(self) -> _Array:
    """Body to capture frame, x, y, z, w, shape (N, 4); NaN in a dropout."""
class TrackedTake:
  """A take of motion capture as its file has it, with nothing interpreted."""
  @staticmethod
  def load(path: os.PathLike | str | bytes) -> TrackedTake:
    """Reads a Motive export (CSV)."""
  @property
  def bodies(self) -> list[TrackedBody]:
    """List of TrackedBody."""
  @property
  def rate(self) -> float:
    """[Hz]"""
  @property
  def time(self) -> _Array:
    """[s], shape (N,)."""
class Spheroid:
  """
  The points that a diabolo reaches when the string is taut.
  
  The stick tips are its foci, the string's length is its major axis: every point on it has the path length
  |p - left| + |p - right| == string_length. Methods take points of the shape (..., 3) [m] and give arrays of
  the shape (...) or (..., 3); a point with a NaN (a dropout) gives NaN.
  """
  def __init__(self, left: _Reals, right: _Reals, string_length: _Real) -> None:
    """Tips, each of the shape (3,) [m], and string length [m]."""
  def closest_point(self, points: _Reals) -> _Array:
    """The closest points of the surface [m]."""
  def normal(self, points: _Reals) -> _Array:
    """Outward unit normals of the confocal surfaces through the points."""
  def path_gradient(self, points: _Reals) -> _Array:
    """Derivative of the path length with respect to the point."""
  def path_length(self, points: _Reals) -> _Array:
    """|p - left| + |p - right| [m]."""
  def published_normal(self, points: _Reals) -> _Array:
    """The unit vectors that the published program takes for the normals."""
  def radial_point(self, points: _Reals) -> _Array:
    """Where the rays from the centre leave the spheroid [m] (the published program's projection)."""
  def signed_distance(self, points: _Reals) -> _Array:
    """Distance to the surface [m], positive inside (the paper's s)."""
  @property
  def axis(self) -> _Array:
    """Unit vector from the right tip to the left one, shape (3,)."""
  @property
  def center(self) -> _Array:
    """Midpoint of the tips, shape (3,) [m]."""
  @property
  def left(self) -> _Array:
    """Left tip, shape (3,) [m]."""
  @property
  def overstretched(self) -> bool:
    """Whether the tips are farther apart than the string is long."""
  @property
  def right(self) -> _Array:
    """Right tip, shape (3,) [m]."""
  @property
  def semi_major(self) -> float:
    """Half the string's length [m]."""
  @property
  def semi_minor(self) -> float:
    """Radius across the axis [m]."""
  @property
  def string_length(self) -> float:
    """[m]"""
  @property
  def tip_distance(self) -> float:
    """Distance between the tips [m]."""
class TipMotion:
  """
  Motion of the two stick tips, given at increasing instants.
  
  `times` [s] has the shape (M,), `left` and `right` [m] the shape (M, 3), world frame: x forward (away from the
  player), y left, z up. Before the first and after the last instant the tips rest. Between two instants they
  follow `interpolation`, as in diabolo.Interpolation: 'linear', 'spline' or 'held'. `left_directions` and
  `right_directions` are those of the sticks, unit vectors of the shape (M, 3), zero where not known; StickFlex
  alone looks at them.
  """
  @staticmethod
  def of_recording(recording: Recording, interpolation: str = 'spline') -> TipMotion:
    """Motion of a recording's tips and sticks, time zero at its first row; gaps in a tip's track are filled, and rows before both tips are seen, or after, are left out."""
  def __init__(self, times: _Reals, left: _Reals, right: _Reals, interpolation: str = 'linear', left_directions: _Reals | None = None, right_directions: _Reals | None = None) -> None: ...
  def __len__(self) -> int: ...
  def at(self, times: _Reals) -> tuple:
    """Left tips [m], right tips [m], left and right velocities [m/s] at times of any shape (...): four arrays of the shape (..., 3)."""
  def directions_at(self, times: _Reals) -> tuple:
    """Directions of the left and of the right stick at times of any shape (...): two arrays of the shape (..., 3), zero where not known."""
  @property
  def begin(self) -> float:
    """First instant [s]."""
  @property
  def end(self) -> float:
    """Last instant [s]."""
  @property
  def interpolation(self) -> str: ...
  @property
  def left(self) -> _Array:
    """Left tips [m], shape (M, 3)."""
  @property
  def left_directions(self) -> _Array:
    """Of the left stick, shape (M, 3); zero where not known."""
  @property
  def right(self) -> _Array:
    """Right tips [m], shape (M, 3)."""
  @property
  def right_directions(self) -> _Array:
    """Of the right stick, shape (M, 3); zero where not known."""
  @property
  def times(self) -> _Array:
    """Instants [s], shape (M,)."""
class StepStatus:
  """What happened in one step."""
  @property
  def caught(self) -> bool:
    """The string was under a flying diabolo again."""
  @property
  def overstretched(self) -> bool:
    """The tips are as far apart as the string is long, or farther, whatever the diabolo does."""
  @property
  def snapped_taut(self) -> bool:
    """The string came taut within the step."""
  @property
  def tensions(self) -> tuple[float, float]:
    """Mean tensions of the left and the right strand over the step [N], for the mass of the parameters."""
  @property
  def turned(self) -> float:
    """
    1 where a turn of the string came onto the axle within the step, -1 where one went off, else 0;
    by Parameters.follow_turns.
    """
  @property
  def turned_at(self) -> float:
    """When it did, after the beginning of the step [s]."""
class Predictor:
  """
  Predicts the diabolo from the motion of the stick tips.
  
    predictor = Predictor(Parameters())
    predictor = Predictor(Parameters(), string_elasticity=StringElasticity.of_stiffness(600.0))
    predictor.step(state, left0, right0, left1, right1, dt=1e-3)
  
  It holds nothing but checked constants; the state is yours. For many steps, or many states, use rollout().
  """
  @typing.overload
  def __init__(self, parameters: Parameters, **kwargs) -> None: ...
  @typing.overload
  def __init__(self, model: Model, **kwargs) -> None: ...
  def step(self, state: State, left0: _Reals, right0: _Reals, left1: _Reals, right1: _Reals, dt: _Real, velocities: typing.Annotated[collections.abc.Sequence[_Reals], "FixedSize(4)"] | None = None, directions: typing.Annotated[collections.abc.Sequence[_Reals], "FixedSize(4)"] | None = None, time: _Real = 0.0) -> StepStatus:
    """
    Advances `state` in place by `dt` > 0 [s] while the tips move from left0, right0 to left1, right1,
    each of the shape (3,) [m].
    
    `velocities` [m/s] are those of left0, right0, left1, right1; without them the tips go straight at constant
    speed. `directions`, unit vectors, are those of the sticks at the same four instants, zero where not known;
    StickFlex alone looks at them. `time` [s] is that of left0, for FormulaLaws. Raises FloatingPointError, and
    leaves the state as it was, where the result is not finite.
    """
  @property
  def parameters(self) -> Parameters:
    """A copy."""
class StringWrench:
  """What a host applies over a step, and what the string does."""
  @property
  def force(self) -> _Array:
    """On the body's centre, gravity apart [N]."""
  @property
  def left_tension(self) -> float:
    """[N]"""
  @property
  def on_left(self) -> _Array:
    """On the left tip [N]."""
  @property
  def on_right(self) -> _Array:
    """On the right tip [N]."""
  @property
  def overstretched(self) -> bool:
    """Whether the tips are farther apart than the string is long; it holds the diabolo between them."""
  @property
  def right_tension(self) -> float:
    """[N]"""
  @property
  def slip(self) -> float:
    """Of the string over the axle, towards the right tip [m/s]."""
  @property
  def torque(self) -> _Array:
    """On the body [N m]."""
class AttachedString:
  """
  Our string on a body of somebody else's simulator, see docs/hosts.md.
  
  In each step it says which force and torque make a free body move as the predictor does. `mass` [kg] and
  `axial_inertia` [kg m^2] are the body's, `gravity` [m/s^2] the host's. `motion` is how the host moves a body:
  'new_velocity' by x' = x + v' dt, or 'constant_force' by x' = x + v dt + a dt^2 / 2. Raises ValueError.
  """
  def __init__(self, model: Model, mass: _Real, axial_inertia: _Real, gravity: _Reals = ..., motion: str = 'new_velocity') -> None: ...
  def step(self, position: _Reals, velocity: _Reals, axle: _Reals, axle_rate: _Real, left0: _Reals, right0: _Reals, left1: _Reals, right1: _Reals, dt: _Real, velocities: typing.Annotated[collections.abc.Sequence[_Reals], "FixedSize(4)"] | None = None, directions: typing.Annotated[collections.abc.Sequence[_Reals], "FixedSize(4)"] | None = None, time: _Real = 0.0) -> StringWrench:
    """
    The wrench for the step of `dt` [s] that begins now; `memory` moves on to the next one.
    
    The body's centre [m], its velocity [m/s], its axle forward, a unit vector, and its angular velocity about
    that [rad/s] (the spin is -axle_rate). The rest is as for Predictor.step. Raises FloatingPointError, and leaves
    the memory as it was, where the result is not finite.
    """
  @property
  def memory(self) -> typing.Annotated[list[float], "FixedSize(8)"]:
    """
    What is kept from step to step, eight numbers: save and restore it with the host's state. The last two are
    the string's state, 0 on the string, 1 loose (a new one's), 2 in flight, and State.turns.
    """
  @memory.setter
  def memory(self, arg1: _Reals) -> None: ...
class ExcerptScore:
  """Position error of one rollout over a recording, as the paper's table counts it."""
  @property
  def baseline_error(self) -> float:
    """Of the lowest-point baseline [m]."""
  @property
  def diverged(self) -> float | None:
    """When the prediction left the world [s], or None."""
  @property
  def duration(self) -> float:
    """From the start to the last row compared [s]."""
  @property
  def error(self) -> float | None:
    """Mean distance to the recorded diabolo [m]; None where the prediction diverged."""
  @property
  def model(self) -> str:
    """Name."""
  @property
  def motion(self) -> str:
    """As the paper calls it; empty where it has no such excerpt."""
  @property
  def paper_error(self) -> float | None:
    """As the paper prints it [m], or None."""
  @property
  def program_error(self) -> float | None:
    """Of the authors' program, run again [m], or None."""
  @property
  def recording(self) -> str:
    """Name of the take."""
  @property
  def rows(self) -> int:
    """Of the excerpt."""
  @property
  def scored(self) -> int:
    """Rows compared."""
  @property
  def skipped(self) -> int:
    """Rows after the start whose diabolo, or the one before, is missing."""
  @property
  def start_row(self) -> int:
    """0 unless the diabolo or a tip is missing there."""
class Interval:
  """From low to high."""
  @property
  def high(self) -> float: ...
  @property
  def low(self) -> float: ...
class ErrorSummary:
  """What a set of position errors looks like."""
  @property
  def mean(self) -> float:
    """[m]"""
  @property
  def mean_ci95(self) -> Interval | None:
    """Block-bootstrap interval of the mean [m]; None where the errors are too few to tell."""
  @property
  def median(self) -> float:
    """[m]"""
  @property
  def percentile_90(self) -> float:
    """[m]"""
  @property
  def windows(self) -> int:
    """How many errors."""
class HorizonScore:
  """Position errors at one horizon, over all starts."""
  @property
  def advantage(self) -> float | None:
    """How much smaller the model's error is than the baseline's in the same window, mean [m]."""
  @property
  def advantage_ci95(self) -> Interval | None: ...
  @property
  def baseline(self) -> ErrorSummary | None:
    """Of the lowest-point baseline, over all windows."""
  @property
  def failed(self) -> int:
    """Of these: the prediction diverged; not in `model`."""
  @property
  def horizon(self) -> float:
    """After the start [s]."""
  @property
  def missed_catches(self) -> int:
    """Of these: predicted in flight below the tips, so never caught."""
  @property
  def model(self) -> ErrorSummary | None:
    """ErrorSummary, or None where nothing could be compared."""
  @property
  def windows(self) -> int:
    """Starts that could be compared."""
class ResidualAndNoise:
  """What windows of half a second, or predictions of held-out data, leave over, and what noise would."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def ahead_s(self) -> float | None:
    """Of a prediction of held-out data; null for windows that are fitted."""
  @property
  def base(self) -> float:
    """Left by the base in the median window, root mean square; ahead, the median error."""
  @property
  def begin_s(self) -> float:
    """Of the stretch of time."""
  @property
  def direction(self) -> str:
    """forward, left or up where one leads; else empty."""
  @property
  def end_s(self) -> float: ...
  @property
  def left(self) -> float:
    """The same with what was found."""
  @property
  def mode(self) -> str:
    """State of the string; EVENT where it changes, ANY for all."""
  @property
  def noise(self) -> float:
    """The same of noise alone."""
  @property
  def p_value(self) -> float:
    """Chance that noise leaves more than noise in so many windows."""
  @property
  def quantity(self) -> str:
    """position or spin."""
  @property
  def recording(self) -> str:
    """By its name; empty for all."""
  @property
  def times_noise(self) -> float:
    """How many times the noise the middle window leaves."""
  @property
  def unit(self) -> str:
    """m or rad/s."""
  @property
  def windows(self) -> int:
    """How many were looked at, of half a second each; or predictions."""
class ChangeInTime:
  """Something that is not what it was a moment ago, window by window."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def frequency_hz(self) -> float | None:
    """Where an oscillation explains it best."""
  @property
  def quantity(self) -> str:
    """What changes."""
  @property
  def size(self) -> float:
    """Root mean square of what neighbouring windows agree on."""
  @property
  def trend_per_s(self) -> float | None:
    """Where a steady change explains it best."""
  @property
  def unit(self) -> str:
    """Of its size."""
  @property
  def z(self) -> float:
    """Standard deviations by which neighbouring windows agree too well."""
class Adequacy:
  """Whether the answer leaves no more than the camera's noise would."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def adequate(self) -> bool | None:
    """Null where it was not asked."""
  @property
  def base_adequate(self) -> bool | None:
    """The same of the base alone."""
  @property
  def changes(self) -> list[ChangeInTime]:
    """What is left and changes in time, the surest first."""
  @property
  def explained(self) -> float | None:
    """Share of the base's gap of position, beyond noise, that the answer closes; null without a gap."""
  @property
  def overall(self) -> list[ResidualAndNoise]:
    """Over all windows: position and, where it was seen, spin; then predictions."""
  @property
  def places(self) -> list[ResidualAndNoise]:
    """Where more is left than noise leaves: fitted windows, then predictions, each the worst first."""
  @property
  def spin_explained(self) -> float | None:
    """The same of the spin."""
class Estimate:
  """A number that was estimated."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def ci90(self) -> Interval | None:
    """90 % interval."""
  @property
  def name(self) -> str:
    """By its fixed name."""
  @property
  def unit(self) -> str:
    """1 for a plain number."""
  @property
  def value(self) -> float:
    """In its unit."""
class EffectPlace:
  """Where an effect matters."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def direction(self) -> str:
    """In which it acts."""
  @property
  def intervals(self) -> list[Interval]:
    """When it matters [s]."""
  @property
  def modes(self) -> list[str]:
    """States of the string in which it matters."""
class EffectSize:
  """What an effect does to a free diabolo; null where it does not act so."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def acceleration_mps2(self) -> float | None:
    """As a constant one would move it as far."""
  @property
  def axle_1s_rad(self) -> float | None:
    """How far it turns the axle in 1 s."""
  @property
  def position_05s_m(self) -> float | None:
    """How far it moves the diabolo in 0.5 s."""
  @property
  def position_1s_m(self) -> float | None:
    """How far it moves the diabolo in 1 s."""
  @property
  def spin_share_1s(self) -> float | None:
    """Which share of the spin it changes in 1 s."""
class ClaimedEffect:
  """Something that is missing, or was measured wrongly, and is claimed."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def axle_worse_without_ci95_rad(self) -> Interval | None:
    """The same of the axle's direction, some second ahead; null of what does not turn it."""
  @property
  def confidence(self) -> float | None:
    """Chance that the name is right."""
  @property
  def kind(self) -> str:
    """physics, measurement or numerical."""
  @property
  def material(self) -> bool:
    """Whether it is large enough to matter."""
  @property
  def name(self) -> str:
    """Of the candidate."""
  @property
  def p_value(self) -> float | None:
    """Over all candidates."""
  @property
  def parameters(self) -> list[Estimate]:
    """What it comes out as."""
  @property
  def size(self) -> EffectSize:
    """How much it does to a free diabolo."""
  @property
  def spin_worse_without_ci95_radps(self) -> list[Interval | None]:
    """The same of the spin; null where it was not seen."""
  @property
  def tied_with(self) -> list[str]:
    """Candidates that explain as much in its place."""
  @property
  def where(self) -> EffectPlace:
    """Where it matters."""
  @property
  def worse_without_ci95_m(self) -> list[Interval | None]:
    """By how much held-out data is predicted worse without it, 95 % interval of each horizon."""
class UnnamedPlace:
  """Where something without a name acts."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def direction(self) -> str:
    """In which it acts."""
class UnnamedStructure:
  """Something that is there and has no name."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def curve(self) -> list[typing.Annotated[list[float], "FixedSize(2)"]]:
    """Scalar, and the mean around it."""
  @property
  def deviation(self) -> float:
    """Standard deviation of the mean."""
  @property
  def explained(self) -> float:
    """Share of what is left over."""
  @property
  def exponent(self) -> float:
    """Power of the scalar."""
  @property
  def exponent_deviation(self) -> float:
    """Its standard deviation."""
  @property
  def law(self) -> str:
    """In words."""
  @property
  def scalar(self) -> str:
    """Scalar of the motion that it grows with."""
  @property
  def scalar_unit(self) -> str: ...
  @property
  def size_m(self) -> float:
    """How far it moves a free diabolo in 0.5 s."""
  @property
  def unit(self) -> str: ...
  @property
  def value(self) -> float:
    """Mean, in its unit."""
  @property
  def where(self) -> UnnamedPlace:
    """Where it acts."""
  @property
  def z(self) -> float:
    """Standard deviations from zero."""
class LearntLawFound:
  """A law that was learnt from what had no name; it is in the model."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def acts(self) -> str:
    """What the formula is the size of, see FormulaLaws."""
  @property
  def dependence_p_value(self) -> float | None:
    """The chance that exchanged strengths gain as much: small where it depends on what it says."""
  @property
  def formula(self) -> str:
    """Of the numbers and of FormulaLaws.variables()."""
  @property
  def gain(self) -> float:
    """What chi^2 falls by with it, in units of the dispersion."""
  @property
  def gain_by_strength(self) -> float | None:
    """In chi^2, of held-out windows, where it is as strong in each as it is on average there; null where it does not change from window to window, or too fast for them."""
  @property
  def gain_permuted(self) -> float | None:
    """The same once these strengths are exchanged among the windows, the median of many times."""
  @property
  def law(self) -> str:
    """In words."""
  @property
  def name(self) -> str:
    """In the model's file."""
  @property
  def numbers(self) -> list[Estimate]:
    """Of the formula, the size first."""
  @property
  def spin_worse_without_ci95_radps(self) -> list[Interval | None]:
    """The same of the spin; null where it was not seen."""
  @property
  def worse_without_ci95_m(self) -> list[Interval | None]:
    """By how much held-out data is predicted worse without it, 95 % interval of each horizon."""
class ParametersAlone:
  """What something comes out as where one recording is fitted by itself."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def parameters(self) -> list[Estimate]:
    """As of a claimed effect."""
  @property
  def recording(self) -> str:
    """By its name."""
class CatchRule:
  """The simulator catches with a taut string only, and these recordings show catches with a slack one."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def catch_slack_m(self) -> float:
    """How much closer than the string is long the tips may be; it is in the model."""
  @property
  def error_after_m(self) -> float:
    """Mean position error of the same starts by the wider rule."""
  @property
  def error_before_m(self) -> float:
    """Mean position error up to 1 s ahead by the simulator's rule, of recordings that were fitted, with what was found until then."""
  @property
  def starts_against(self) -> int:
    """Starts that are predicted worse by the wider rule, by ten times what their noise makes."""
  @property
  def starts_for(self) -> int:
    """Starts that are predicted better by the wider rule, by ten times what their noise makes."""
class DifferingEffect:
  """Something of which recordings ask for different values."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def kind(self) -> str:
    """physics or measurement."""
  @property
  def name(self) -> str:
    """Of the candidate."""
  @property
  def recordings(self) -> list[ParametersAlone]:
    """Each by itself."""
  @property
  def what(self) -> str:
    """In words."""
  @property
  def z(self) -> float:
    """Standard deviations between the two that differ most."""
class UpperLimit:
  """Physics that is not claimed: how much of it may still be there."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def limit95(self) -> float:
    """It is below this in size, at 95 %."""
  @property
  def name(self) -> str:
    """Of the candidate that is not claimed."""
  @property
  def parameter(self) -> str: ...
  @property
  def unit(self) -> str: ...
class HeldOutErrors:
  """Errors on data that was not fitted, horizon by horizon."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def augmented_axle_error_rad(self) -> float | None:
    """The same with what was found."""
  @property
  def augmented_error_m(self) -> list[float | None]:
    """The same with what was found."""
  @property
  def augmented_spin_error_radps(self) -> list[float | None]:
    """The same with what was found."""
  @property
  def axle_ahead_s(self) -> float | None:
    """How long after the axle was seen its direction is compared, a mean; null where it was not seen."""
  @property
  def axle_heldout(self) -> str | None:
    """recordings, or blocks of one, on which the axle is compared; null where it was not seen."""
  @property
  def axle_improvement_ci95_rad(self) -> Interval | None:
    """95 % interval of base less augmented."""
  @property
  def base_axle_error_rad(self) -> float | None:
    """The same of the base."""
  @property
  def base_error_m(self) -> list[float | None]:
    """Mean position error of the base."""
  @property
  def base_spin_error_radps(self) -> list[float | None]:
    """Mean spin error of the base; null where no spin was seen."""
  @property
  def constant_axle_error_rad(self) -> float | None:
    """Mean angle that an axle which keeps its direction is off then."""
  @property
  def fitted_windows(self) -> int:
    """Windows that were fitted."""
  @property
  def heldout(self) -> str:
    """recordings, or blocks of one."""
  @property
  def holdout_unused(self) -> list[str]:
    """Held-out recordings without a start to compare."""
  @property
  def horizons_s(self) -> list[float]:
    """After the start."""
  @property
  def improvement_ci95_m(self) -> list[Interval | None]:
    """95 % interval of base less augmented, an error counting at most three times the median."""
  @property
  def of_windows(self) -> int:
    """Of so many; the others say least."""
  @property
  def spin_improvement_ci95_radps(self) -> list[Interval | None]:
    """95 % interval of base less augmented."""
  @property
  def start_error_m(self) -> list[float | None]:
    """What the noise of the starts alone makes."""
  @property
  def start_spin_error_radps(self) -> list[float | None]:
    """What the noise of the starts alone makes: of their spin, and of position and velocity through the string."""
  @property
  def windows(self) -> int:
    """Predictions that were compared."""
class ProposedMotion:
  """A motion that would tell ties apart."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def motion(self) -> str:
    """By its name."""
  @property
  def odds(self) -> float | None:
    """Against the wrong one, to 1."""
  @property
  def parts(self) -> list[str]:
    """Candidates that are tied, and that it tells apart."""
  @property
  def seconds(self) -> float:
    """To record."""
  @property
  def what(self) -> str:
    """In words."""
class LadderRow:
  """A candidate, and what speaks for it."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, name: str, estimate: _Real, z: _Real, claimed: bool) -> None: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def claimed(self) -> bool: ...
  @property
  def estimate(self) -> float:
    """Of the parameter."""
  @property
  def kind(self) -> str:
    """physics or measurement."""
  @property
  def name(self) -> str:
    """Of the candidate."""
  @property
  def p_value(self) -> float:
    """Over all candidates."""
  @property
  def parameter(self) -> str:
    """Of several, the one that stands out most."""
  @property
  def reason(self) -> str:
    """Why it is claimed, or not."""
  @property
  def size_m(self) -> float | None:
    """How far it moves a free diabolo in 0.5 s; null where it acts on spin or axle."""
  @property
  def unit(self) -> str: ...
  @property
  def z(self) -> float:
    """Standard deviations from zero."""
class LocatedDirection:
  """A direction in which something may be missing."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def mode(self) -> str:
    """State of the string in which it is looked at."""
  @property
  def name(self) -> str: ...
  @property
  def unit(self) -> str: ...
class LocatedWindow:
  """What is missing in a window of a recording."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def begin_s(self) -> float: ...
  @property
  def end_s(self) -> float: ...
  @property
  def mode(self) -> str:
    """State of the string at its begin."""
  @property
  def recording(self) -> str:
    """By its name."""
  @property
  def residual_after_m(self) -> float:
    """The same with what was found."""
  @property
  def residual_before_m(self) -> float:
    """Root mean square of the base."""
  @property
  def residual_noise_m(self) -> float | None:
    """What noise alone would leave."""
  @property
  def spin_after_rad_s(self) -> float | None:
    """The same with what was found."""
  @property
  def spin_before_rad_s(self) -> float | None:
    """Root mean square of the base's spin."""
  @property
  def spin_noise_rad_s(self) -> float | None:
    """What noise alone would leave."""
  @property
  def z(self) -> list[float | None]:
    """Of what is missing, direction by direction."""
  @property
  def z_after(self) -> list[float | None]:
    """Of what is left with what was found."""
class Location:
  """Where base and recordings part."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def directions(self) -> list[LocatedDirection]: ...
  @property
  def windows(self) -> list[LocatedWindow]: ...
class RecordingNoise:
  """Noise of a recording."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def position_m(self) -> float:
    """Standard deviation."""
  @property
  def recording(self) -> str:
    """By its name."""
  @property
  def spin_rad_s(self) -> float:
    """Standard deviation."""
class Thresholds:
  """What decided the claims, so that nobody has to copy it."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self) -> None: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def measurement(self) -> float:
    """The same of a fault of measurement."""
  @property
  def numerical_share(self) -> float:
    """Share of what is left over, beyond which the base's numerical rules count."""
  @property
  def physics(self) -> float:
    """Standard deviations beyond which physics counts."""
  @property
  def times_noise(self) -> float:
    """What is left may be so many times what noise leaves."""
  @property
  def worthwhile_odds(self) -> float:
    """Below these a proposed motion parts nothing."""
class InputFile:
  """A file that was diagnosed."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def __init__(self, file: str, sha256: str) -> None: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def file(self) -> str:
    """Name without folders."""
  @property
  def sha256(self) -> str: ...
class DiagnosisResult:
  """Everything that a diagnosis says, as its file holds it."""
  __hash__: typing.ClassVar[None] = None
  @staticmethod
  def from_json(text: str) -> DiagnosisResult:
    """Reads the text of such a file; what it lacks is as in an empty result."""
  @staticmethod
  def load(path: os.PathLike | str | bytes) -> DiagnosisResult:
    """Reads such a file."""
  def __eq__(self, other: typing.Any) -> bool: ...
  def completed(self, seconds: _Real | None = None, inputs: collections.abc.Sequence[InputFile] = [], model: str | None = None) -> DiagnosisResult:
    """The same with what only its caller knows; the rest as it is."""
  def to_dict(self) -> dict:
    """The same as its file has it."""
  def to_json(self) -> str:
    """The text of its file, schema diabolo.diagnosis/1."""
  @property
  def adequacy(self) -> Adequacy:
    """Whether it leaves no more than noise would."""
  @property
  def base(self) -> str:
    """Name of the simulator that was asked about."""
  @property
  def catch_rule(self) -> CatchRule | None:
    """That the simulator's catches are too strict; null where nothing says so."""
  @property
  def differing(self) -> list[DifferingEffect]:
    """What recordings ask different values of, the surest first."""
  @property
  def effects(self) -> list[ClaimedEffect]:
    """What is claimed, the surest first."""
  @property
  def fit(self) -> HeldOutErrors:
    """Errors on data that was not fitted."""
  @property
  def headline(self) -> str:
    """The first that holds of INSUFFICIENT_DATA, TIE, NAMED, MEASUREMENT_FAULT, NUMERICAL, UNNAMED_STRUCTURE and NOTHING_MISSING; NAMED of laws of the axle alone just before the last."""
  @property
  def inputs(self) -> list[InputFile]:
    """Files that were diagnosed, where its caller said so."""
  @property
  def ladder(self) -> list[LadderRow]:
    """Every candidate, and why it was claimed or not."""
  @property
  def learnt(self) -> list[LearntLawFound]:
    """Laws that were learnt from it."""
  @property
  def locate(self) -> Location:
    """Where base and recording part, window by window."""
  @property
  def model(self) -> str | None:
    """Name of the model's file; null where none was written."""
  @property
  def next_experiment(self) -> list[ProposedMotion]:
    """Motions that would part ties."""
  @property
  def noise(self) -> list[RecordingNoise]:
    """Of each recording."""
  @property
  def not_done(self) -> list[str]:
    """What budget, base or recordings kept from being asked."""
  @property
  def nuisances(self) -> list[Estimate]:
    """What was measured on the way."""
  @property
  def schema(self) -> str:
    """diabolo.diagnosis/1."""
  @property
  def seconds(self) -> float | None:
    """That it took; null where its caller did not say."""
  @property
  def sentence(self) -> str:
    """The answer in words."""
  @property
  def thresholds(self) -> Thresholds:
    """What decided the claims."""
  @property
  def unnamed(self) -> list[UnnamedStructure]:
    """What is there and has no name."""
  @property
  def upper_limits(self) -> list[UpperLimit]:
    """What may be there unseen."""
  @property
  def version(self) -> str:
    """Of the tool."""
class ComparedLaw:
  """A law in reality and in a simulator."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  @property
  def axle_1s_rad(self) -> float | None:
    """How far the difference turns the axle in 1 s; null where it does not act so."""
  @property
  def difference(self) -> list[Estimate]:
    """Real less simulated: what the simulator has to get."""
  @property
  def kind(self) -> str:
    """physics, measurement or learnt."""
  @property
  def name(self) -> str:
    """Of the candidate, or of a law that was learnt."""
  @property
  def p_value(self) -> float | None:
    """That the two are the same, over all candidates."""
  @property
  def real(self) -> list[Estimate]:
    """What it comes out as in the recordings."""
  @property
  def simulated(self) -> list[Estimate]:
    """What it comes out as in the simulated ones."""
  @property
  def size_m(self) -> float | None:
    """How far the difference moves a free diabolo in 0.5 s; null where it does not act so."""
  @property
  def tied_with(self) -> list[str]:
    """Candidates that explain the recordings as well."""
  @property
  def verdict(self) -> str:
    """agrees, lacks, too_little, too_much or should_not_have, of the simulator; cannot_tell where one of the two shows it and the other is unsure."""
  @property
  def what(self) -> str:
    """In words."""
  @property
  def where(self) -> EffectPlace:
    """Where it matters."""
class SimulatorComparison:
  """What reality has and a simulator has not, law by law."""
  __hash__: typing.ClassVar[None] = None
  def __eq__(self, other: typing.Any) -> bool: ...
  def to_dict(self) -> dict:
    """The same as its file has it."""
  def to_json(self) -> str:
    """The text of its file, schema diabolo.comparison/1."""
  @property
  def fit(self) -> HeldOutErrors:
    """Errors of the simulator on data that was not fitted, alone and with the difference of our two models; without horizons where it was not asked to play from recorded starts."""
  @property
  def laws(self) -> list[ComparedLaw]:
    """What differs, the largest first, and then what agrees."""
  @property
  def real(self) -> DiagnosisResult:
    """Diagnosis of the recordings."""
  @property
  def recording_faults(self) -> list[str]:
    """Faults of the recordings, which no simulator has to have."""
  @property
  def schema(self) -> str:
    """diabolo.comparison/1."""
  @property
  def sentence(self) -> str:
    """The answer in words."""
  @property
  def simulated(self) -> DiagnosisResult:
    """Diagnosis of what was simulated."""
class ResidualFit:
  """A residual that was fitted, and its errors on what it was not fitted to."""
  @property
  def base_error(self) -> float:
    """Median distance without it, half a second later [m]."""
  @property
  def error(self) -> float:
    """The same with it [m]."""
  @property
  def gain_ci95(self) -> typing.Any:
    """95 % interval of the mean by which it takes errors off [m]; None where there are too few."""
  @property
  def model(self) -> Model:
    """The base, with the residual where it stands."""
  @property
  def stands(self) -> bool:
    """Whether predictions get better by more than 1 mm half a second later, for sure."""
  @property
  def usual(self) -> float:
    """The size that weights were expected to have [m/s^2]."""
  @property
  def windows(self) -> int:
    """How many predictions were compared."""
class HandLimits:
  """
  What the tips may do under an agent.
  
  speed [m/s] and acceleration [m/s^2] of either tip along each axis; gap [m]: between the tips along y;
  string_margin [m]: the tips stay closer than the string is long by this; centre and half [m]: of the box, whose
  left half (along y) the left tip keeps to, and the right tip to the other.
  """
  def __init__(self, speed: _Real = 2.3, acceleration: _Real = 34.6, gap: _Real = 0.02, string_margin: _Real = 0.002, centre: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., half: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...) -> None: ...
  @property
  def acceleration(self) -> float: ...
  @property
  def centre(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @property
  def gap(self) -> float: ...
  @property
  def half(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @property
  def speed(self) -> float: ...
  @property
  def string_margin(self) -> float: ...
class Camera:
  """
  How an agent sees the diabolo: with noise, late, and not in every frame. A frame is a period.
  
  noise [m] of each coordinate, spin_noise [rad/s] and axle_noise of each coordinate of the axle's direction, where that
  is seen: standard deviations; dropouts: share of the frames in which
  nothing is seen; least_delay to most_delay [frames]: each episode draws one.
  """
  def __init__(self, noise: _Real = 0.001, spin_noise: _Real = 1.0, dropouts: _Real = 0.02, least_delay: _Whole = 1, most_delay: _Whole = 3, axle_noise: _Real = 0.01) -> None: ...
  @property
  def axle_noise(self) -> float: ...
  @property
  def dropouts(self) -> float: ...
  @property
  def least_delay(self) -> int: ...
  @property
  def most_delay(self) -> int: ...
  @property
  def noise(self) -> float: ...
  @property
  def spin_noise(self) -> float: ...
class HandPlan:
  """A planned play for an agent's hands to play and to correct, a period [s] at a time. left and right [m]: the tips at first."""
  def __len__(self) -> int: ...
  @property
  def left(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @property
  def period(self) -> float: ...
  @property
  def right(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
class EpisodeStart:
  """What an episode may begin with in place of a hanging diabolo, as in the middle of somebody's play: the diabolo's state, the tips' places [m] and velocities [m/s], the goal (None: it is drawn), the stage of a task that has several, and how many flights were caught."""
  def __init__(self, state: State, left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], left_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., right_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., goal: collections.abc.Sequence[_Real] | None = None, stage: _Whole = 0, flights: _Whole = 0, task: str = '', plan: HandPlan | None = None) -> None: ...
class Arena:
  """Environments side by side, in the compiled core: what diabolo.envs is made of. Its arrays are its own memory, which each step overwrites."""
  def __init__(self, task: str | collections.abc.Sequence[str], models: collections.abc.Sequence[Model], count: _Whole = 1, period: _Real = 0.01, steps: _Whole = 10, autoreset: str = 'next_step', threads: _Whole = 1, limits: HandLimits = ..., camera: Camera | None = None, starts: collections.abc.Sequence[EpisodeStart] = [], start_share: _Real = 0.0, free_axis: bool = False) -> None: ...
  def model_of(self, environment: _Whole) -> int:
    """Number of the model that it plays with."""
  def outcome(self, environment: _Whole) -> dict:
    """What its episode has come to: worth (the sum of its rewards), seconds, over, dropped, first_spin and spin [rad/s], flights that ended in a catch, apex [m] of the last, level (how long the axle has been level by now [s], in a task that levels it), goal, model."""
  def pose(self, environment: _Whole) -> tuple:
    """State of the diabolo, left tip and right tip."""
  def reset(self, environment: _Whole, state: State | None = None, goal: collections.abc.Sequence[_Real] | None = None, model: _Whole | None = None, task: _Whole | None = None) -> None:
    """Begins its next episode, with what is given in place of what is drawn."""
  def seed(self, environment: _Whole, seed: _Whole) -> None:
    """Its episodes begin anew with this seed."""
  def step(self, actions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
    """Plays a period. actions: shares of the tips' accelerations, shape (count, 6)."""
  @property
  def count(self) -> int: ...
  @property
  def final_observations(self) -> numpy.ndarray:
    """Of episodes that the same step has reset."""
  @property
  def observations(self) -> numpy.ndarray:
    """float32, shape (count, numbers of an observation)."""
  @property
  def rewards(self) -> numpy.ndarray: ...
  @property
  def terminated(self) -> numpy.ndarray: ...
  @property
  def truncated(self) -> numpy.ndarray: ...
class Agent:
  """
  An agent: a network that sees observations and gives actions, and what it was trained for.
  
  task: its name; period [s] between its actions; steps of the simulation in a period; layers: (weights, bias) of each,
  weights of the shape (outputs, inputs), with tanh between them. Outputs are cut off at -1 and 1. corrects: whether
  they are added to a plan's motion.
  """
  @staticmethod
  def load(path: os.PathLike | str | bytes) -> Agent:
    """Reads a file of the schema diabolo.agent/1."""
  def __init__(self, task: str | collections.abc.Sequence[str], period: _Real, steps: _Whole, layers: collections.abc.Sequence[tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float32, "[m, n]"], typing.Annotated[numpy.typing.ArrayLike, numpy.float32, "[m, 1]"]]], corrects: bool = False) -> None: ...
  def act(self, observations: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> numpy.typing.NDArray[numpy.float32]:
    """Actions, shape (6,) or (n, 6), of observations, shape (k,) or (n, k), of k numbers each."""
  def to_json(self, decimals: _Whole | None = None) -> str:
    """The text of its file; with its numbers rounded to so many decimals (1 to 6) it is a third as large."""
  @property
  def corrects(self) -> bool: ...
  @property
  def layers(self) -> list: ...
  @property
  def period(self) -> float: ...
  @property
  def steps(self) -> int: ...
  @property
  def tasks(self) -> list[str]: ...
class LiveAgent:
  """
  An agent at the sticks of a robot or of somebody else's simulator.
  
  left and right [m]: where the tips are at first, at rest; goal: as many numbers as the task has; string_length [m];
  gravity [m/s^2]; camera: it sees what that makes of the states that it is shown, with noise of this seed; task: one of the
  agent's, where it knows several; plan: that it corrects, which begins with these tips. Raises ValueError where the
  tips are not within the limits.
  """
  def __init__(self, agent: Agent, left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], goal: collections.abc.Sequence[_Real] = [], limits: HandLimits = ..., string_length: _Real = 1.45, gravity: _Real = 9.80665, camera: Camera | None = None, seed: _Whole = 0, task: str = '', plan: HandPlan | None = None) -> None: ...
  def act(self, state: State) -> tuple[typing.Annotated[_Array, "[3, 1]"], typing.Annotated[_Array, "[3, 1]"], typing.Annotated[_Array, "[3, 1]"], typing.Annotated[_Array, "[3, 1]"]]:
    """Shows it the diabolo, once a period: left tip, right tip and their velocities at the period's end. Until then their accelerations are constant."""
  @property
  def agent(self) -> Agent: ...
class Waypoint:
  """A state of the diabolo that is wanted: position [m] and velocity [m/s], and the weights of the paper's costs: distance, difference of speeds, angle."""
  def __init__(self, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., position_weight: _Real = 1.0, velocity_weight: _Real = 0.0, direction_weight: _Real = 0.0) -> None: ...
  @property
  def direction_weight(self) -> float: ...
  @direction_weight.setter
  def direction_weight(self, arg0: _Real) -> None: ...
  @property
  def position(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @position.setter
  def position(self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
  @property
  def position_weight(self) -> float: ...
  @position_weight.setter
  def position_weight(self, arg0: _Real) -> None: ...
  @property
  def velocity(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @velocity.setter
  def velocity(self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
  @property
  def velocity_weight(self) -> float: ...
  @velocity_weight.setter
  def velocity_weight(self, arg0: _Real) -> None: ...
class Goals:
  """
  What a plan shall achieve; what is not given does not count.
  
  waypoints are passed in this order; final_state and spin [rad/s] hold at the end; taut is the weight of slack;
  apex [m], above the tips, and landing [m] are those of the flight that the motion ends in; caught is the weight
  of missing a diabolo that flies.
  """
  def __init__(self, waypoints: collections.abc.Sequence[Waypoint] = [], final_state: Waypoint | None = None, spin: _Real | None = None, spin_weight: _Real = 0.02, taut: _Real | None = None, apex: _Real | None = None, landing: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] | None = None, caught: _Real | None = None) -> None: ...
  @property
  def apex(self) -> float | None: ...
  @property
  def caught(self) -> float | None: ...
  @property
  def final_state(self) -> Waypoint | None: ...
  @property
  def landing(self) -> typing.Annotated[_Array, "[3, 1]"] | None: ...
  @property
  def spin(self) -> float | None: ...
  @property
  def taut(self) -> float | None: ...
  @property
  def waypoints(self) -> list[Waypoint]: ...
class TipPath:
  """Planned motion of the tips: piecewise cubics."""
  def derivatives(self, times: _Reals) -> _Array:
    """Tips, left over right [m], and their velocity, acceleration and jerk at times of the shape (N,): shape (4, N, 6)."""
  def followed_by(self, next: TipPath) -> TipPath:
    """This path and then another one, moved in time to this one's end, where their tips and velocities must meet."""
  def tips(self, interval: _Real = 0.002) -> TipMotion:
    """The same motion in samples [s], for predictions."""
  @property
  def begin(self) -> float:
    """[s]"""
  @property
  def end(self) -> float:
    """[s]"""
class LimitUse:
  """How much of a limit a path uses: value, limit, and the excess, at most zero where it is kept, as a share or in metres."""
  def __init__(self, name: str, value: _Real, limit: _Real, unit: str, time: _Real, excess: _Real) -> None: ...
  @property
  def excess(self) -> float: ...
  @property
  def limit(self) -> float: ...
  @property
  def name(self) -> str: ...
  @property
  def time(self) -> float: ...
  @property
  def unit(self) -> str: ...
  @property
  def value(self) -> float: ...
class TipLimits:
  """
  What the tips may do; every plan keeps it.
  
  speed [m/s], acceleration [m/s^2] and jerk [m/s^3] of either tip; string_margin [m]: the tips stay closer than
  the string is long by this; least_gap [m]: the left tip stays to the left of the right one by this; lowest and
  highest [m]: corners of the workspace; others: called with a TipPath, returns a list of LimitUse, such as a
  robot's.
  """
  def __init__(self, speed: _Real = 4.0, acceleration: _Real = 60.0, jerk: _Real = ..., string_margin: _Real = 0.002, least_gap: _Real = 0.02, lowest: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., highest: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., others: typing.Any = None) -> None: ...
  @property
  def acceleration(self) -> float: ...
  @property
  def highest(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @property
  def jerk(self) -> float: ...
  @property
  def least_gap(self) -> float: ...
  @property
  def lowest(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @property
  def speed(self) -> float: ...
  @property
  def string_margin(self) -> float: ...
class Freedom:
  """What a solver may change of a seed: x too, durations, the last point; up to a reach [m] of each coordinate and a stretch of each duration, as a share."""
  def __init__(self, forward: bool = False, times: bool = True, last_point: bool = True, reach: _Real = 0.4, stretch: _Real = 0.25) -> None: ...
  @property
  def forward(self) -> bool: ...
  @property
  def last_point(self) -> bool: ...
  @property
  def reach(self) -> float: ...
  @property
  def stretch(self) -> float: ...
  @property
  def times(self) -> bool: ...
class StickSpline:
  """
  A motion of the tips by control points: a clamped or periodic cubic spline.
  
  times [s], shape (M,); left and right [m], shape (M, 3); loop: it ends as it begins; start: velocity and
  acceleration of both tips that it goes on from, two arrays of the shape (6,), left over right; sticks: their
  directions, unit vectors, likewise, zero where not known; StickFlex alone looks at them.
  """
  def __init__(self, times: collections.abc.Sequence[_Real], left: _Reals, right: _Reals, loop: bool = False, start: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"], typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"]] | None = None, sticks: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"] = ...) -> None: ...
  def path(self) -> TipPath:
    """The TipPath through the points."""
  @property
  def left(self) -> typing.Annotated[_Array, "[m, n]"]: ...
  @property
  def right(self) -> typing.Annotated[_Array, "[m, n]"]: ...
  @property
  def sticks(self) -> typing.Annotated[_Array, "[6, 1]"]: ...
  @property
  def times(self) -> list[float]: ...
class Action:
  """A figure of play: seed motion, freedom and goals."""
  @property
  def freedom(self) -> Freedom: ...
  @property
  def goals(self) -> Goals: ...
  @property
  def name(self) -> str: ...
  @property
  def seed(self) -> StickSpline: ...
class GoalCost:
  """How far a plan is off one goal."""
  @property
  def error(self) -> float: ...
  @property
  def name(self) -> str: ...
  @property
  def reached(self) -> bool: ...
  @property
  def tolerance(self) -> float: ...
  @property
  def unit(self) -> str:
    """Of error and tolerance; empty for a share."""
  @property
  def weight(self) -> float: ...
class Plan:
  """A motion that was found, and what it leads to. It keeps its limits."""
  @property
  def answer(self) -> str: ...
  @property
  def cost(self) -> float: ...
  @property
  def end(self) -> State:
    """State at the end of the motion."""
  @property
  def evaluations(self) -> int: ...
  @property
  def goals(self) -> list[GoalCost]: ...
  @property
  def limits(self) -> list[LimitUse]: ...
  @property
  def motion(self) -> StickSpline: ...
  @property
  def path(self) -> TipPath: ...
  @property
  def play(self) -> tuple:
    """Times, states (N, 7), string states, left and right tips."""
  @property
  def reached(self) -> bool: ...
class Seam:
  """Where a new piece of motion sets in."""
  def catch(self, home_left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], home_right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], model: Model, others: collections.abc.Sequence[State] = []) -> Action:
    """The action that catches the diabolo, which flies, as it is or as in one of the other states."""
  def joined(self, seed: StickSpline) -> StickSpline:
    """A seed moved there, which goes on from the tips' motion."""
  @property
  def left(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @property
  def right(self) -> typing.Annotated[_Array, "[3, 1]"]: ...
  @property
  def state(self) -> State: ...
  @property
  def time(self) -> float: ...
class RecedingHorizon:
  """
  Motion that is planned piece by piece while it is played.
  
    seam = horizon.seam(now)         # where a plan that is begun now can set in
    piece = ...                      # a plan from seam.state, its seed seam.joined(...)
    horizon.join(seam, piece, now, planning_time)  # False where it comes too late
  """
  def __init__(self, model: Model, left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], state: State, begin: _Real = 0.0, sticks: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"] = ...) -> None: ...
  def join(self, seam: Seam, plan: Plan, now: _Real, planning_time: _Real) -> bool: ...
  def observe(self, time: _Real, state: State) -> None:
    """Takes over an observed state; predictions begin with the latest one."""
  def seam(self, now: _Real) -> Seam: ...
  def seam_at(self, time: _Real) -> Seam: ...
  @property
  def path(self) -> TipPath: ...
class PlannedPlay:
  """A planned motion, and what it leads to by the model that it was planned with."""
  @property
  def action(self) -> str: ...
  @property
  def answer(self) -> str:
    """The same in a sentence: that of the first plan that misses a goal, or why there are no more."""
  @property
  def axis(self) -> typing.Annotated[_Array, "[m, n]"]:
    """Direction of the axle, shape (N, 3)."""
  @property
  def ended(self) -> str:
    """Why there are fewer cycles than were asked for; empty where there are not."""
  @property
  def left(self) -> typing.Annotated[_Array, "[m, n]"]:
    """Left tip [m], shape (N, 3)."""
  @property
  def path(self) -> TipPath:
    """Of the tips."""
  @property
  def planning_time(self) -> float:
    """Of all plans together [s]."""
  @property
  def plans(self) -> list[Plan]:
    """One a cycle; of a throw and catch, two, or one where there is nothing to catch."""
  @property
  def reached(self) -> bool:
    """Whether every goal of every cycle is reached."""
  @property
  def right(self) -> typing.Annotated[_Array, "[m, n]"]:
    """Right tip [m], shape (N, 3)."""
  @property
  def start(self) -> State:
    """State of the diabolo."""
  @property
  def states(self) -> typing.Annotated[_Array, "[m, n]"]:
    """Position [m], velocity [m/s] and spin [rad/s], shape (N, 7)."""
  @property
  def string_states(self) -> typing.Annotated[numpy.typing.NDArray[numpy.uint8], "[m, 1]"]:
    """As in StringState, shape (N,)."""
  @property
  def time(self) -> typing.Annotated[_Array, "[m, 1]"]:
    """[s], shape (N,)."""
  @property
  def wanted(self) -> list[Goals]:
    """The goals of the first cycle."""
class LevelHands:
  """
  Hands that keep the axle of a diabolo level while they play any motion.
  
  They turn the motion towards the axle, and beyond it to tilt it, by the gains of a linear-quadratic regulator on
  the model, learnt anew where the spin has changed by a tenth. The model needs a GyroscopicTilt.
  """
  def __init__(self, model: Model, left: _Reals, right: _Reals, spin: _Real, *, lead: _Real = 0.9, turn: _Real = 1.0, quickness: _Real = 10.0) -> None:
    """
    left, right: the hands of the play at rest [m], shape (3,); spin [rad/s], 10 at least. At most `lead`
    [rad] are they turned beyond their heading, which itself turns with at most `turn` [rad/s]; they follow with the
    rate `quickness` [1/s].
    """
  def advance(self, dt: _Real) -> None:
    """Let the hands follow for `dt` [s]."""
  def see(self, axis: _Reals, spin: _Real, string_state: typing.Any = 'on_string') -> None:
    """
    Take in what is seen: the axle, a unit vector, forward, shape (3,), the spin [rad/s], and where the string is.
    
    From a flight until it is taut around the axle again the hands take no lead.
    """
  def tips(self, left: _Reals, right: _Reals, left_velocity: _Reals = ..., right_velocity: _Reals = ...) -> tuple:
    """
    The motion's tips [m] and their velocities [m/s] as these hands play them now.
    
    Returns left, right, left_velocity, right_velocity, each of the shape (3,).
    """
  @property
  def gains(self) -> _Array:
    """K of (lead, turn) = -K (tilt, yaw, heading), shape (2, 3)."""
  @property
  def heading(self) -> float:
    """Where the player faces, from where the play began to the left [rad]."""
  @property
  def lead(self) -> float:
    """How far the hands are turned to the left beyond the heading [rad]."""
class LevelHorizon:
  """
  Hands that keep the axle level as LevelHands do, by a receding horizon.
  
  Each 0.1 s they plan lead and turn of the next 1.2 s on the model with its free axle, for the motion that they
  play meanwhile: pulls, throws, flights and catches to come count, and the place of the diabolo.
  """
  def __init__(self, model: Model, left: _Reals, right: _Reals, spin: _Real, *, lead: _Real = 0.9, turn: _Real = 1.0, quickness: _Real = 10.0) -> None:
    """
    left, right: the hands of the play at rest [m], shape (3,); spin [rad/s], 10 at least. At most `lead`
    [rad] are they turned beyond their heading, which itself turns with at most `turn` [rad/s]; they follow with the
    rate `quickness` [1/s].
    """
  def advance(self, dt: _Real) -> None:
    """Let the hands follow for `dt` [s]."""
  def see(self, time: _Real, state: State, path: TipPath) -> None:
    """Take in the state that is seen at a time [s], with its axis; path: what the hands are to play, not turned."""
  def tips(self, left: _Reals, right: _Reals, left_velocity: _Reals = ..., right_velocity: _Reals = ...) -> tuple:
    """
    The motion's tips [m] and their velocities [m/s] as these hands play them now.
    
    Returns left, right, left_velocity, right_velocity, each of the shape (3,).
    """
  @property
  def heading(self) -> float:
    """Where the player faces, from where the play began to the left [rad]."""
  @property
  def lead(self) -> float:
    """How far the hands are turned to the left beyond the heading [rad]."""
class StickArm:
  """
  A UR5e where it stands, with the stick in its flange, as in the paper.
  
  `side` is 'left' or 'right'; `height`, `spacing` (between the two bases) and `forward` (x of the bases) are [m],
  world frame. `calibration` has a row of x, y, z [m], roll, pitch, yaw [rad] for each of the six links, shape
  (6, 6), as the ROS driver extracts it; None is the arm of the data sheet. Joints are [rad], base to last wrist.
  """
  def __init__(self, side: str, height: _Real = 0.7, spacing: _Real = 1.1, forward: _Real = 0.0, calibration: typing.Any = None) -> None: ...
  def flange(self, joints: _Reals) -> _Array:
    """Poses of the flange in the controller's base frame, shape (..., 4, 4), of joints (..., 6)."""
  def inverse(self, flange: _Reals, seed: _Reals) -> _Array:
    """Joints, shape (6,), near `seed` that bring the flange to a pose in the controller's base frame, shape (4, 4). Raises ValueError where the arm does not reach it."""
  def jacobian(self, joints: _Reals) -> _Array:
    """Velocity of the tip (rows 0-2, [m/rad]) and rotation of the flange (rows 3-5) over the joints, controller's base frame, shape (..., 6, 6)."""
  def tip_position(self, joints: _Reals) -> _Array:
    """The stick's tip [m, world], shape (..., 3), of joints (..., 6)."""
  @property
  def base(self) -> _Array:
    """Pose of the controller's base frame in the world, shape (4, 4)."""
  @property
  def link_masses(self) -> list[typing.Annotated[list[float], "FixedSize(4)"]]:
    """Of each link its mass [kg] and the centre of that in the link's frame [m], as its maker publishes them."""
  @property
  def links(self) -> list[_Array]:
    """How each of the six links stands against the one before while its joint, about z, is at zero: poses of the shape (4, 4)."""
  @property
  def side(self) -> str: ...
  @property
  def tip(self) -> _Array:
    """The stick's tip in the frame of the flange [m], shape (3,)."""
class SeedGrid:
  """Joint configurations at the key points of a box, and cubic splines between them."""
  @staticmethod
  def build(arm: StickArm, lower: typing.Any = None, upper: typing.Any = None, knots: typing.Annotated[collections.abc.Sequence[_Whole], "FixedSize(3)"] = [6, 7, 7]) -> SeedGrid:
    """For a box from `lower` to `upper` [m, world], each of the shape (3,); default: the paper's. Raises ValueError with the point that the arm does not reach."""
  @staticmethod
  def load(path: os.PathLike | str | bytes) -> SeedGrid:
    """What save() wrote."""
  def save(self, path: os.PathLike | str | bytes) -> None:
    """Write a CSV of x, y, z [m] and q1 to q6 [rad], a line for each key point."""
  def seed(self, points: _Reals) -> _Array:
    """Interpolated joints [rad], shape (..., 6), at points (..., 3); outside, of the nearest point."""
  @property
  def joints(self) -> _Array:
    """Of the key points [rad], shape (x, y, z, 6)."""
  @property
  def knots(self) -> typing.Annotated[list[int], "FixedSize(3)"]:
    """Key points along x, y and z."""
  @property
  def lower(self) -> _Array:
    """[m, world], shape (3,)."""
  @property
  def upper(self) -> _Array:
    """[m, world], shape (3,)."""
class StickMap:
  """The joints of an arm as a function of its stick's tip, without drift."""
  def __init__(self, arm: StickArm, grid: SeedGrid) -> None: ...
  def slopes(self, points: _Reals) -> _Array:
    """How the joints follow the tip [rad/m], shape (..., 6, 3); NaN where solve() has a code."""
  def slowest_tip_speed(self, points: _Reals) -> _Array:
    """The same in the slowest direction: there one joint alone sets the pace."""
  def solve(self, points: _Reals) -> tuple:
    """Joints [rad], shape (..., 6), with the tip at points [m, world], shape (..., 3), and a code for each, shape (...): 0 reached, 1 outside the grid's box, 2 out of reach, 3 outside a joint's range; there the joints are NaN."""
  def tip_speed(self, points: _Reals, direction: _Reals) -> _Array:
    """How fast the tip may go in a direction of any length, shape (3,), before a joint exceeds pi rad/s [m/s], shape (...); NaN where solve() has a code."""
  @property
  def arm(self) -> StickArm: ...
  @property
  def grid(self) -> SeedGrid: ...
class RobotLimits:
  """
  What two arms, each a StickMap, ask of a path: TipLimits(others=RobotLimits(left, right)).
  
  Reach, the joints' speed [rad/s], acceleration [rad/s^2] and jerk [rad/s^3], of which `share` may be used up, and
  what must stay between the arms [m]. Called with a TipPath, it returns a list of LimitUse.
  """
  def __call__(self, path: TipPath) -> list[LimitUse]: ...
  def __init__(self, left: StickMap, right: StickMap, speed: _Real = 2.9845130209103035, acceleration: _Real = 15.0, jerk: _Real = 500.0, least_clearance: _Real = 0.1, share: _Real = 0.97) -> None: ...
class Belief:
  """See diabolo.estimate.Estimate."""
  @property
  def covariance(self) -> _Array: ...
  @property
  def gated(self) -> bool: ...
  @property
  def normalized_innovation_squared(self) -> float: ...
  @property
  def state(self) -> State: ...
  @property
  def string_weights(self) -> typing.Annotated[list[float], "FixedSize(3)"]: ...
  @property
  def time(self) -> float: ...
class Estimator:
  """See diabolo.estimate.Estimator."""
  def __init__(self, model: Model, start: State, left: _Reals, right: _Reals, spread: typing.Annotated[collections.abc.Sequence[_Real], "FixedSize(4)"], noise: typing.Annotated[collections.abc.Sequence[_Real], "FixedSize(7)"], time: _Real, history: _Whole) -> None: ...
  def history(self) -> int: ...
  def now(self) -> Belief: ...
  def past(self, ago: _Whole) -> Belief: ...
  def step(self, left: _Reals, right: _Reals, left_velocity: _Reals, right_velocity: _Reals, dt: _Real) -> None: ...
  def update_by_camera(self, time: _Real, position: _Reals, noise: _Real, axle: _Reals | None, axle_noise: _Real, spin: _Real | None, spin_noise: _Real) -> str: ...
  def update_by_forces(self, left: _Reals, right: _Reals, noise: _Real, time: _Real | None) -> str: ...
  def update_by_tensions(self, left: _Real, right: _Real, noise: _Real, time: _Real | None) -> str: ...
  def update_by_torques(self, arms: typing.Annotated[collections.abc.Sequence[StickArm], "FixedSize(2)"], joints: typing.Annotated[collections.abc.Sequence[_Reals], "FixedSize(2)"], torques: typing.Annotated[collections.abc.Sequence[_Reals], "FixedSize(2)"], noise: _Real, time: _Real | None) -> str: ...
def action(name: str, left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], start: State, string_length: _Real, size: _Real = 1.0, pace: _Real = 1.0, height: _Real = 0.5, sideways: _Real = 0.3, spin_gain: _Real | None = None, sticks: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"] = ...) -> Action:
  """The figure of that name from a pose of the tips and a state of the diabolo."""
def aimed_again(aim: _Reals, wanted: _Reals, came: _Reals) -> tuple[float, float]:
  """See diabolo.aimed_again."""
def arm_hand_limits(left: StickMap, right: StickMap, speed: _Real = 2.9845130209103035, acceleration: _Real = 15.0, room: HandLimits | None = None) -> HandLimits:
  """
  HandLimits of an agent under which no joint of two arms, each a StickMap, exceeds `speed` [rad/s] or
  `acceleration` [rad/s^2], wherever in its part of a box a tip is. The box is that of `room`, HandLimits whose speed and acceleration do not
  count; None is one in front of the paper's arms. Jerk is not limited. Raises ValueError where an arm does not
  reach its part.
  """
def baseline(recording: Recording) -> _Array:
  """The lowest points of the spheroid [m], shape (N, 3): what every model has to beat."""
def best_guess(model: Model, ladder: collections.abc.Sequence[LadderRow]) -> Model:
  """See diabolo.best_guess."""
def check_plan(left: StickMap, right: StickMap, motion: TipMotion, speed: _Real = 2.9845130209103035, acceleration: _Real = 15.0, jerk: _Real = 500.0, least_clearance: _Real = 0.1) -> dict:
  """Whether two arms, each a StickMap, can play a TipMotion from rest to rest, where not and why."""
def compare_simulator(recordings: collections.abc.Sequence[Recording], simulated: collections.abc.Sequence[Recording], simulate: typing.Any, base: Model, holdout: collections.abc.Sequence[Recording], bank: collections.abc.Sequence[str], laws: FormulaLaws, budget: _Real, seed: _Whole, threads: _Whole, progress: typing.Any) -> tuple:
  """See diabolo.compare_simulator."""
def diagnose(recordings: collections.abc.Sequence[Recording], base: Model, holdout: collections.abc.Sequence[Recording], bank: collections.abc.Sequence[str], laws: FormulaLaws, budget: _Real, seed: _Whole, threads: _Whole, progress: typing.Any, draws: _Whole) -> tuple:
  """See diabolo.diagnose."""
def diagnosis_schema() -> str:
  """The JSON schema of a diagnosis' file."""
def fit_residual(recordings: collections.abc.Sequence[Recording], base: Model, threads: _Whole) -> ResidualFit: ...
def follow_pointers(position: _Reals, velocity: _Reals, pointers: _Reals, string_length: _Real, dt: _Real) -> tuple[_Array, _Array]:
  """Where the hands of a live play are after a step of `dt` [s], and how fast: both of the shape (2, 3), left over right [m, m/s], as they go after the pointers, shape (2, 3) [m]."""
def foresee(model: Model, start: State, path: TipPath, dt: _Real = 0.001, flight: _Real = 0.0, down_to: _Real = ...) -> tuple:
  """What a path leads to by a model: times, states (N, 7), string states, left and right tips. A flight at its end is followed for `flight` seconds, or until it falls through the height `down_to`."""
def hand_plan(planned: PlannedPlay, string_length: _Real, limits: HandLimits, period: _Real) -> HandPlan:
  """See diabolo.envs.hand_plan."""
def hang_at_rest(model: Model, left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], spin: _Real = 0.0, sticks: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"] = ...) -> State:
  """See diabolo.hang_at_rest."""
def hanging_state(left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], string_length: _Real, spin: _Real = 0.0) -> State:
  """A diabolo that hangs at rest at the lowest point between the tips."""
def home_pose(name: str, string_length: _Real) -> tuple[typing.Annotated[_Array, "[3, 1]"], typing.Annotated[_Array, "[3, 1]"]]:
  """Where the tips start a figure [m]: left and right."""
def keep_limits(joints: _Reals, speed: _Real = 2.9845130209103035, acceleration: _Real = 15.0, jerk: _Real = 500.0) -> tuple:
  """
  Play a path slowly enough.
  
  `joints` [rad] of both arms, left and then right, 2 ms apart, shape (N, 12). Gives setpoints 2 ms apart of the same
  curve, shape (M, 12), whose speed [rad/s], acceleration [rad/s^2] and jerk [rad/s^3] keep the limits, and the time
  of the path that each belongs to [s], shape (M,). Raises ValueError where no play is slow enough.
  """
def largest_spin(rate: _Real) -> float:
  """Largest spin that a sampling rate [Hz] tells apart [rad/s]."""
def lessons() -> list:
  """Tasks that the player teaches."""
def limit_uses(path: TipPath, limits: TipLimits, string_length: _Real) -> list[LimitUse]:
  """How much a path uses of each limit, from its exact maxima."""
def load_recording(path: os.PathLike | str | bytes, calibration: Calibration | None = None, *, up: str | None = None, columns: None | str | collections.abc.Mapping[str, str] = None) -> Recording:
  """The same as Recording.load."""
def load_tip_plan(path: os.PathLike | str | bytes) -> TipMotion:
  """The TipMotion of a CSV with the columns time, left_x ... right_z [s, m], or a tidy recording's."""
def model_for(model: Model, recording: Recording) -> Model:
  """See diabolo.model_for."""
def observation_infos(task: str | collections.abc.Sequence[str] = [], corrects: bool = False) -> list:
  """What an agent of these tasks sees: name, unit, size and meaning. Last what one that corrects plans does."""
def plan(models: collections.abc.Sequence[Model], starts: collections.abc.Sequence[State], seed: StickSpline, goals: Goals, limits: TipLimits, freedom: Freedom, solver: str, evaluations: _Whole, seconds: _Real, random_seed: _Whole, dt: _Real) -> Plan:
  """See diabolo.plan."""
def plan_action(action: str, models: collections.abc.Sequence[Model], start: State | None, cycles: _Whole, spin: _Real, size: _Real, pace: _Real, height: _Real | None, sideways: _Real | None, spin_gain: _Real | None, limits: TipLimits, solver: str, seconds: _Real, random_seed: _Whole, dt: _Real, sticks: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"]) -> PlannedPlay:
  """See diabolo.plan_action."""
def plan_cost(models: collections.abc.Sequence[Model], start: State, motion: StickSpline, goals: Goals, limits: TipLimits, dt: _Real = 0.004) -> float:
  """The paper's residual of a motion; infinite where it breaks a limit."""
def played_orientation(axis: _Reals, turned: _Real) -> _Array:
  """How a diabolo lies that has spun by `turned` [rad]: a quaternion x, y, z, w, body to world, body x along `axis`, a unit vector."""
def played_properties(parameters: Parameters) -> DiaboloProperties:
  """The diabolo of a model: cups of the paper's red one, the model's mass and axle."""
def played_recording(name: str, time: _Reals, left: _Reals, right: _Reals, states: _Reals, rate: _Real, properties: DiaboloProperties, string_length: _Real, axis: _Reals | None = None, clock: _Real = 0.0) -> Recording:
  """A predicted play as a recording: time [s], shape (N,), tips [m], shape (N, 3), and states, position [m], velocity [m/s] and spin [rad/s], shape (N, 7); its orientations turn by the spin about the axle's `axis`, unit vectors, shape (N, 3), by default world x. `clock` is the time of laws at its begin [s]."""
def predict(recording: Recording, model: Model, row: _Whole | None, start: str) -> tuple:
  """See diabolo.predict."""
def read_recording(text: str, path: os.PathLike | str | bytes, calibration: Calibration | None, up: str | None, columns: None | str | collections.abc.Mapping[str, str]) -> Recording:
  """The same of a text, as if it stood in a file."""
def read_text(path: os.PathLike | str | bytes) -> str:
  """A text file in UTF-8, without its byte order mark. Raises RecordingError."""
def recorded_plan(recording: Recording) -> TipMotion:
  """The TipMotion of a recording whose tips are smoothed: a camera's noise of 0.1 mm asks for more jerk than an arm's limits allow."""
def recording_of_bodies(file: str, time: _Reals, bodies: collections.abc.Sequence[tuple[str, _Reals, _Reals | None]], notes: collections.abc.Sequence[str], calibration: Calibration, up: str | None) -> Recording:
  """The recording of rigid bodies: times [s], shape (N,), and of each body its name, positions [m], shape (N, 3), and orientations x, y, z, w, shape (N, 4), or None where it is a point; a row with NaN is a dropout. `file` is what messages name, `notes` what its reader changed."""
def rollout(models: collections.abc.Sequence[Model], initial: _Reals, string_states: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8], tips: collections.abc.Sequence[TipMotion], begin: _Real, dt: _Real, steps: _Whole, record_every: _Whole, threads: _Whole, forces: bool, axles: bool) -> tuple:
  """See diabolo.rollout, which checks and broadcasts what it hands over."""
def rollout_gradient(model: Model, initial: State, tips: TipMotion, with_respect_to: collections.abc.Sequence[str], begin: _Real, dt: _Real, steps: _Whole, threads: _Whole) -> tuple:
  """See diabolo.rollout_gradient."""
def score_excerpt(recording: Recording, model: Model) -> ExcerptScore:
  """See diabolo.evaluate."""
def score_excerpts(recording: Recording, model: Model) -> list[ExcerptScore]:
  """See diabolo.evaluate."""
def score_horizons(recordings: collections.abc.Sequence[Recording], model: Model, starts_every: _Real, horizons: collections.abc.Sequence[_Real], start: str, seed: _Whole, threads: _Whole, progress: typing.Any) -> list[HorizonScore]:
  """See diabolo.evaluate."""
def start_state(recording: Recording, row: _Whole, start: str = 'fair', signed_spin: bool = True) -> State:
  """State at a row of a recording: 'fair', from the rows up to it, or 'published', by the rules of the authors' program."""
def stretch_starts(recording: Recording) -> list:
  """Rows from which a simulator is asked to play, each with its state, shape (7,)."""
def success_rate(play: PlannedPlay, models: collections.abc.Sequence[Model]) -> float:
  """See diabolo.success_rate."""
def task_infos() -> list:
  """What can be played: name, meaning, reward, seconds, goal and first spin of each."""
def taught_starts(task: str, models: collections.abc.Sequence[Model], plays: _Whole, seed: _Whole, limits: HandLimits, period: _Real | None = None) -> list[EpisodeStart]:
  """See diabolo.envs.taught_starts and diabolo.envs.planned_starts."""
def trim_overlaps(recordings: collections.abc.Sequence[Recording]) -> tuple[list[Recording], list[str]]:
  """Recordings without the samples that they share with ones before, and what was trimmed."""
def ur5e_inverse(flange: _Reals) -> _Array:
  """Every joint vector of the data sheet's UR5e, shape (N, 6) with N up to 8, whose flange has a pose in the controller's base frame, shape (4, 4)."""
AIMS: dict = {'height': ('hop', 'throw', 'side_throw', 'throw_and_catch'), 'sideways': ('swing', 'side_throw', 'throw_and_catch'), 'spin_gain': ('linear_acceleration', 'wind_up', 'one_turn_low', 'circular_acceleration')}
DIAGNOSIS_SCHEMA: str = 'diabolo.diagnosis/1'
PLANNED_ACTIONS: tuple = ('linear_acceleration', 'wind_up', 'one_turn_low', 'circular_acceleration', 'swing', 'hop', 'throw', 'side_throw', 'stop', 'throw_and_catch')
__version__: str = '0.1.0'
_Real: typing.TypeAlias = typing.SupportsFloat | typing.SupportsIndex
_Whole: typing.TypeAlias = typing.SupportsInt | typing.SupportsIndex
_Reals: typing.TypeAlias = numpy.typing.ArrayLike
_Array: typing.TypeAlias = numpy.typing.NDArray[numpy.float64]
