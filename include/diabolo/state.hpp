// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// Where the string is (paper, section III-A and its figure of the states).
enum class StringState : std::uint8_t {
  kOnString = 0,  ///< the string is taut around the axle
  kLoose = 1,     ///< OFF_STRING_LOOSE: between the cups, too loose to act
  kFlying = 2,    ///< the diabolo has left the string
};

/// A string state per lane of a Pack.
template <class Scalar>
struct LaneStringState {
  Scalar code{static_cast<double>(StringState::kLoose)};
  LaneStringState() = default;
  LaneStringState(StringState state) : code(static_cast<double>(state)) {}  // NOLINT: the same in every lane
};

/// StringState, or one per lane.
template <class Scalar>
using StringStateOf =
    std::conditional_t<ScalarTraits<Scalar>::kLanes == 1, StringState, LaneStringState<Scalar>>;

inline bool is(StringState state, StringState wanted) { return state == wanted; }
template <class Scalar>
Mask<Scalar> is(const LaneStringState<Scalar>& state, StringState wanted) {
  return state.code == Scalar(static_cast<double>(wanted));
}

inline void assign_where(bool condition, StringState& state, StringState next) {
  if (condition) state = next;
}
template <class Scalar>
void assign_where(const Mask<Scalar>& condition, LaneStringState<Scalar>& state, StringState next) {
  state.code = select(condition, Scalar(static_cast<double>(next)), state.code);
}

/// State of the diabolo: a point mass that spins, and where GyroscopicTilt has an inertia, a rigid body. (No
/// vector stands before the velocity, so that no compiler stores the last component of one with the first of
/// the next, which slows down reading them.)
template <class Scalar>
struct State {
  Vector3<Scalar> position = Vector3<Scalar>::Constant(Scalar(0));  ///< centre [m], world frame
  StringStateOf<Scalar> string_state{StringState::kLoose};
  Vector3<Scalar> velocity = Vector3<Scalar>::Constant(Scalar(0));  ///< [m/s], world frame
  /// Spin [rad/s]; positive when the axle's surface under the string moves towards the right tip (rotation
  /// about -x).
  Scalar spin{0};
  /// Direction of the axle, forward: a unit vector, world frame. Only effects look at it, and only
  /// GyroscopicTilt turns it. The angular velocity is tumble - spin * axis.
  Vector3<Scalar> axis = Vector3<Scalar>(Scalar(1), Scalar(0), Scalar(0));
  /// Mean acceleration of the diabolo by the string over the last step [m/s^2]; times its mass, the string's
  /// force on it. Part of the state: the next step begins its iteration with it, which changes the result by
  /// no more than the iteration's tolerance, but StickFlex bends the sticks by it. A motion that is continued
  /// without it starts with straight sticks, which for a step puts the tips aside by compliance times
  /// tension.
  Vector3<Scalar> string_acceleration = Vector3<Scalar>::Constant(Scalar(0));
  /// Angular velocity of the axle itself [rad/s], square to it, world frame. Only a GyroscopicTilt with an
  /// inertia looks at it and changes it.
  Vector3<Scalar> tumble = Vector3<Scalar>::Constant(Scalar(0));
  /// Turns of the string around the axle beyond Parameters::wraps, the pass under it counted: some 0.4 under
  /// hands side by side, 1.4 with one turn more, negative where the string runs around the axle the other
  /// way. A start of n means n whole turns and the pass that the strands show. Parameters::follow_turns
  /// alone looks at it and changes it.
  Scalar turns{0};
};

/// Most turns that a string of play has around the axle, either way.
inline constexpr double kMostTurns = 10.0;

/// Whether every number of it is finite.
inline bool is_finite(const State<double>& state) {
  return state.position.allFinite() && state.velocity.allFinite() && state.axis.allFinite() &&
         state.string_acceleration.allFinite() && state.tumble.allFinite() && std::isfinite(state.spin) &&
         std::isfinite(state.turns);
}

/// What happened in one step.
template <class Scalar>
struct StepStatus {
  /// The tips are as far apart as the string is long, or farther, whatever the diabolo does: one on a rigid
  /// string is held between them, unless the parameters release it.
  Mask<Scalar> overstretched{false};
  Mask<Scalar> snapped_taut{false};  ///< an inextensible string came taut within the step
  Mask<Scalar> caught{false};        ///< the string was under a flying diabolo again
  Scalar turned{0};     ///< 1: a turn came onto the axle within the step; -1: one went off; by follow_turns
  Scalar turned_at{0};  ///< when, after the beginning of the step [s]
};

}  // namespace diabolo
