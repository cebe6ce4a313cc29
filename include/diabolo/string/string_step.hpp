// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string/string_path.hpp"

namespace diabolo {

/// Projection of vectors onto a plane through the origin, or onto nothing.
template <class Scalar>
struct PlaneProjector {
  bool active = false;
  Vector3<Scalar> normal = Vector3<Scalar>::Constant(Scalar(0));
  [[gnu::always_inline]] inline Vector3<Scalar> operator()(const Vector3<Scalar>& v) const {
    return active ? Vector3<Scalar>(v - normal * dot<Scalar>(v, normal)) : v;
  }
  /// The point moved into the plane through `origin`.
  [[gnu::always_inline]] inline Vector3<Scalar> on(const Vector3<Scalar>& origin,
                                                   const Vector3<Scalar>& point) const {
    return active ? Vector3<Scalar>(origin + (*this)(point - origin)) : point;
  }
};

/// What one step of a diabolo on a massless string is made of. Refers to its vectors, which must outlive it.
template <class Scalar>
struct StringStep {
  const Vector3<Scalar>&position, &velocity;  ///< of the diabolo at the beginning [m], [m/s]
  const Vector3<Scalar>& acceleration;        ///< of everything but the string: gravity and effects [m/s^2]
  const Tips<Scalar>&begin, &end;             ///< tips at the beginning and at the end
  Scalar dt;                                  ///< [s]
  Scalar string_length;                       ///< [m]
  /// A guess of the string's mean acceleration over the step, such as that of the last step [m/s^2].
  const Vector3<Scalar>& string_acceleration;
  Scalar compliance;    ///< of the string times the diabolo's mass: extension per tension/mass [s^2]
  Scalar damping_time;  ///< string damping over its stiffness [s]
  const PlaneProjector<Scalar>& plane;
  Scalar restitution{0};  ///< of a catch: share of the path's rate that is given back
  Scalar inertia{0};      ///< of what moves with the string; see StringNow [s^4]
  Scalar resting{0};      ///< that of what is at rest until the string comes taut

  /// Position of the free motion after the time `t` [s].
  [[gnu::always_inline]] inline Vector3<Scalar> free_position(const Scalar& t) const {
    return position + acceleration * Scalar(Scalar(0.5) * t * t) + velocity * t;
  }
  /// Velocity of the free motion after the time `t` [s].
  [[gnu::always_inline]] inline Vector3<Scalar> free_velocity(const Scalar& t) const {
    return velocity + acceleration * t;
  }

  /// What is left of the step from another state and tips on, `left` [s] before its end. Refers to them too.
  [[gnu::always_inline]] inline StringStep rest(const Vector3<Scalar>& position_there,
                                                const Vector3<Scalar>& velocity_there,
                                                const Tips<Scalar>& tips_there, const Scalar& left) const {
    return {
        position_there,      velocity_there, acceleration, tips_there, end,         left,    string_length,
        string_acceleration, compliance,     damping_time, plane,      restitution, inertia, resting};
  }

  /// Whether the string is straight from tip to tip at the end, or shorter than their distance.
  [[gnu::always_inline]] inline Mask<Scalar> overstretched() const {
    const Scalar length = constant(string_length);
    return squared_norm<Scalar>(constant(end.left) - constant(end.right)) >= length * length;
  }

  /// How far the path length may be from the string's [m].
  /// (Nothing but a bound: it has no derivatives.)
  Scalar tolerance() const { return Scalar(constraint_tolerance<Scalar>()) * constant(string_length); }

  /// Tips at a fraction of the step, on the straight line.
  Tips<Scalar> tips_at(const Scalar& fraction) const {
    return {begin.left + (end.left - begin.left) * fraction,
            begin.right + (end.right - begin.right) * fraction,
            begin.left_velocity + (end.left_velocity - begin.left_velocity) * fraction,
            begin.right_velocity + (end.right_velocity - begin.right_velocity) * fraction};
  }

  /// How well the step resolves the string's spring: 0 for a rigid string, 1 where its oscillation is
  /// resolved. It turns the spring's law from its value at the end of the step (stable for any stiffness)
  /// into its mean over the step (second order, keeps the energy), and the inelastic catch of the rigid
  /// string into none.
  Scalar resolution(const Scalar& gradient_squared) const {
    return minimum(Scalar(1), Scalar(Scalar(4) * compliance / (dt * dt * gradient_squared + tiny<Scalar>())));
  }
  /// The mass beside the diabolo's [1] that an inertia is to a change of the path length, where the spring is
  /// resolved; else less, to nothing of a rigid string's.
  Scalar beside(const Scalar& of, const Scalar& gradient_squared) const {
    const Scalar stiffness = Scalar(4) / maximum(Scalar(Scalar(4) * compliance),
                                                 Scalar(dt * dt * gradient_squared + tiny<Scalar>()));
    return of * stiffness * stiffness;
  }
};

/// The outcome of a step.
template <class Scalar>
struct StringStepResult {
  Vector3<Scalar> position, velocity;
  Vector3<Scalar> string_acceleration;  ///< mean of the string's part over the step [m/s^2]; 0 when slack
  Scalar slack{0};                      ///< string length minus path length [m], near the end of the step
  Scalar gradient_squared{0};           ///< |gradient of the path length|^2 there
  Scalar tension{0};  ///< of both strands over mass, mean over the step, without friction [m/s^2]
  Scalar passed{0};   ///< string that has passed the axle from the left strand to the right one [m]
  Mask<Scalar> taut{false}, snapped_taut{false};
};

/// The string that has passed the axle, to the last bit of the position; the search for the string's pull
/// says it as of its last iterate but one.
template <class Scalar>
void measure_passing(const StringStep<Scalar>& step, StringStepResult<Scalar>& result) {
  result.passed = Scalar(0.5) * (StringPath<Scalar>(result.position, step.end).imbalance() -
                                 StringPath<Scalar>(step.position, step.begin).imbalance());
}

/// Energy per mass that a step may be wrong by [J/kg].
template <class Scalar>
Scalar energy_tolerance() {
  return Scalar(30 * constraint_tolerance<Scalar>());
}

/// Velocity without the given rate of the path length [m/s]: the impulse of an inelastic string.
template <class Scalar>
Vector3<Scalar> without_path_rate(const Vector3<Scalar>& velocity, const Vector3<Scalar>& gradient,
                                  const Scalar& rate) {
  return velocity - gradient * Scalar(rate / (squared_norm(gradient) + Scalar(1e-12)));
}

}  // namespace diabolo
