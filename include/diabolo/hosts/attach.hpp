// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "diabolo/full_predictor.hpp"
#include "diabolo/strand_tensions.hpp"
#include "diabolo/string/tip_geometry.hpp"
#include "diabolo/string/winding.hpp"
#include "diabolo/text/shown.hpp"

// Our string on a body of somebody else's simulator. The host integrates, and knows contacts, joints and all
// else; in each step we say which force and torque make its body move as the predictor does, see
// docs/hosts.md.
namespace diabolo {

/// How a host moves a body in a step of dt under a constant force, with a = force / mass + gravity.
enum class HostMotion {
  kNewVelocity,   ///< v' = v + a dt, x' = x + v' dt: semi-implicit Euler
  kConstantForce  ///< v' = v + a dt, x' = x + v dt + a dt^2 / 2: RK4 and better
};

/// The free rigid body that plays the diabolo; SI units, world frame.
struct HostBody {
  Vector3<double> position = Vector3<double>::Zero(), velocity = Vector3<double>::Zero();  ///< of its centre
  Vector3<double> axle = Vector3<double>::UnitX();  ///< forward, a unit vector
  double axle_rate = 0.0;                           ///< angular velocity about it; the spin is -axle_rate
};

/// What a host has to apply over the next step, gravity apart; and what the string does in it.
struct StringWrench {
  Vector3<double> force = Vector3<double>::Zero(),
                  torque = Vector3<double>::Zero();  ///< on the body's centre
  /// On the tips [N]: together the opposite of what the string adds to the body in this step of the host.
  Vector3<double> on_left = Vector3<double>::Zero(), on_right = Vector3<double>::Zero();
  double left_tension = 0.0, right_tension = 0.0;  ///< of the strands, as predicted [N]
  double slip = 0.0;           ///< of the string over the axle, towards the right tip [m/s]
  bool overstretched = false;  ///< the tips are farther apart than the string is long
};

/// What is kept from step to step, beside what the host keeps. To save, copy or reset a simulation, save,
/// copy or reset this: `StringMemory{}` is a beginning.
struct StringMemory {
  using Numbers = std::array<double, 8>;
  Vector3<double> owed = Vector3<double>::Zero();  ///< velocity that the host has not got yet [m/s]
  Vector3<double> string_acceleration = Vector3<double>::Zero();  ///< see State
  StringState string_state = StringState::kLoose;
  double turns = 0.0;  ///< see State

  /// For a host that keeps numbers alone, in this order.
  Numbers numbers() const {
    const Vector3<double>&o = owed, &a = string_acceleration;
    return {o.x(), o.y(), o.z(), a.x(), a.y(), a.z(), static_cast<double>(string_state), turns};
  }
  /// Throws std::invalid_argument where the string's state is none.
  static StringMemory of(const Numbers& n) {
    if (n[6] != 0.0 && n[6] != 1.0 && n[6] != 2.0)
      throw std::invalid_argument("memory[6]: a string state of " + shown(n[6]) + "; expected 0, 1 or 2");
    return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, static_cast<StringState>(static_cast<int>(n[6])), n[7]};
  }
};

/// The string between two tips that a host moves, on a body that it integrates. Holds constants alone: one
/// may serve any number of bodies and threads.
class AttachedString {
 public:
  /// Mass [kg] and inertia about the axle [kg m^2] of the host's body, and the host's gravity [m/s^2]. What
  /// the predictor's own gravity says more or less is part of the force. Throws std::invalid_argument where
  /// mass or inertia is not positive.
  AttachedString(FullPredictor<double> predictor, double mass, double axial_inertia,
                 const Vector3<double>& gravity, HostMotion motion = HostMotion::kNewVelocity)
      : predictor_(std::move(predictor)),
        string_(predictor_.effects().string(predictor_.parameters())),
        mass_(mass),
        inertia_(axial_inertia),
        gravity_(gravity),
        motion_(motion) {
    if (!(mass > 0.0) || !(axial_inertia > 0.0) || !std::isfinite(mass + axial_inertia))
      throw std::invalid_argument("attached string: mass " + std::to_string(mass) + " kg, axial inertia " +
                                  std::to_string(axial_inertia) + " kg m^2; both must be positive");
  }

  const FullPredictor<double>& predictor() const { return predictor_; }

  /// What a simulation begins with where nobody says how: a diabolo above the tips and off the string flies;
  /// of any other the step finds out whether the string is taut.
  StringMemory begin(const Vector3<double>& position, const Tips<double>& tips) const {
    const bool slack = (position - tips.left).norm() + (position - tips.right).norm() <
                       0.99 * predictor_.parameters().string_length;
    StringMemory memory;
    if (slack && height_above_tips(position, tips.left, tips.right) > 0.0)
      memory.string_state = StringState::kFlying;
    return memory;
  }

  /// The wrench for the step of `dt` [s] that begins now, while the tips move from `begin` to `end`. Changes
  /// `memory` to what is to be given for the step after it; a host that asks twice about the same step gives
  /// the same memory twice.
  StringWrench step(const HostBody& body, const Tips<double>& begin, const Tips<double>& end, double dt,
                    StringMemory& memory) const {
    State<double> state;
    state.position = body.position;
    state.velocity = body.velocity + memory.owed;
    state.spin = -body.axle_rate;
    state.axis = body.axle;
    state.string_state = memory.string_state;
    state.string_acceleration = memory.string_acceleration;
    state.turns = memory.turns;
    settle(state, begin);
    const State<double> before = state;
    StringWrench wrench;
    wrench.overstretched = predictor_.step(state, begin, end, dt).overstretched;
    const Vector3<double> reached = motion_ == HostMotion::kNewVelocity
                                        ? Vector3<double>((state.position - body.position) / dt)
                                        : state.velocity;
    wrench.force = mass_ * ((reached - body.velocity) / dt - gravity_);
    wrench.torque = body.axle * (-inertia_ * (state.spin - before.spin) / dt);
    if (state.string_state == StringState::kOnString)
      pull_strands(body, before, state, begin, end, dt, reached, wrench);
    memory = {state.velocity - reached, state.string_acceleration, state.string_state, state.turns};
    return wrench;
  }

 private:
  /// Where a host goes by a constant force is off a rigid string by the third order of the step.
  void settle(State<double>& state, const Tips<double>& begin) const {
    if (state.string_state == StringState::kOnString && string_.compliance == 0.0)
      settle_on_string(state, begin, string_.length, PlaneProjector<double>());
  }

  /// Splits what the string gives the diabolo among its two strands, and gives it back to the tips.
  void pull_strands(const HostBody& body, const State<double>& before, const State<double>& after,
                    const Tips<double>& begin, const Tips<double>& end, double dt,
                    const Vector3<double>& reached, StringWrench& wrench) const {
    const Strands<double> strands = pulling_strands(predictor_, before, after, begin, end);
    const Vector3<double> pull = string_pull(predictor_, before, after, begin, dt);
    std::tie(wrench.left_tension, wrench.right_tension) = strands.tensions(mass_ * pull);
    const Vector3<double> given =
        mass_ * (pull + (reached - body.velocity - after.velocity + before.velocity) / dt);
    const auto [left, right] = strands.tensions(given);
    // What lies outside the strands' plane, or would push a tip, goes to both alike.
    const Vector3<double> rest = 0.5 * (given - left * strands.left - right * strands.right);
    wrench.on_left = -left * strands.left - rest;
    wrench.on_right = -right * strands.right - rest;
    const double passed = (end.right - after.position).norm() - (begin.right - before.position).norm();
    const Parameters<double>& parameters = predictor_.parameters();
    wrench.slip = passed / dt - side_of_axle(after, parameters) * parameters.axle_radius * after.spin;
  }

  FullPredictor<double> predictor_;
  StringNow<double> string_;  ///< the predictor's, which never changes
  double mass_, inertia_;
  Vector3<double> gravity_;
  HostMotion motion_;
};

}  // namespace diabolo
