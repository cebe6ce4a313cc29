// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/math/scalar.hpp"
#include "diabolo/plan/ranges.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A state of the diabolo that is wanted, and how much each cost of the paper counts (section III-B).
struct Waypoint {
  Vector3<double> position = Vector3<double>::Zero();  ///< [m]
  Vector3<double> velocity = Vector3<double>::Zero();  ///< [m/s]
  double position_weight = 1.0;                        ///< of the Euclidean distance [1/m]
  double velocity_weight = 0.0;   ///< of the difference of the velocities' magnitudes [s/m]
  double direction_weight = 0.0;  ///< of the angle between the velocities [1/rad]
};

/// A wanted number.
struct Target {
  double value;
  double weight = 1.0;
};

/// A place where a throw comes down: on its way down through the height z, [m].
struct Landing {
  Vector3<double> position;
  double weight = 1.0;
};

/// A throw has left the string for certain when it is so far above the tips [m].
inline constexpr double kRelease = 0.05;

/// What a plan shall achieve. Goals that are not given do not count.
struct Goals {
  std::vector<Waypoint> waypoints;      ///< on the way, in this order
  std::optional<Waypoint> final_state;  ///< at the end
  std::optional<Target> spin;           ///< at the end [rad/s]; weight per rad/s
  /// The string pulls at least kLeastPull throughout: the diabolo neither leaves it nor hops; weight of the
  /// share that is missing (root mean square over the time).
  std::optional<double> taut;
  std::optional<Target> apex;      ///< of the flight that the motion ends in, above the resting tips [m]
  std::optional<Landing> landing;  ///< of that flight
  std::optional<double> caught;  ///< the flight ends on the string; weight of the distance by which it misses
  /// Up to which cost, without its weight, a goal counts as reached.
  struct Tolerances {
    double position = 0.02;   ///< [m], also of flights
    double velocity = 0.15;   ///< [m/s]
    double direction = 0.15;  ///< [rad]
    double spin = 2.0;        ///< [rad/s]
    double taut = 0.25;       ///< share
  } tolerances{};

  /// Whether the motion ends in a flight.
  bool throws() const { return apex || landing; }
  /// Whether they are of a flight.
  bool flies() const { return throws() || caught; }

  /// Throws std::invalid_argument where a weight is negative, a number is not finite or beyond what can be,
  /// or goals exclude each other.
  void validate() const {
    const auto weight = [](const std::string& name, double value) {
      if (!(value >= 0.0) || !std::isfinite(value))
        throw std::invalid_argument(name + ": a weight of " + shown(value) +
                                    "; expected a finite one that is not negative");
    };
    const auto check = [&weight](const std::string& name, const Waypoint& w) {
      for (const double value : {w.position_weight, w.velocity_weight, w.direction_weight})
        weight(name, value);
      check_size(name + ", position", w.position.stableNorm(), kFarthest, "m");
      check_size(name + ", velocity", w.velocity.stableNorm(), kFastest, "m/s");
      if (w.position_weight + w.velocity_weight + w.direction_weight == 0.0)
        throw std::invalid_argument(name + ": all of its weights are zero");
      if (w.direction_weight > 0.0 && w.velocity.isZero(0.0))
        throw std::invalid_argument(name + ": a direction counts, but its velocity is zero");
    };
    for (std::size_t i = 0; i < waypoints.size(); ++i) check("waypoint " + std::to_string(i), waypoints[i]);
    if (final_state) check("final state", *final_state);
    if (spin) check_size("spin goal", spin->value, kMostSpin, "rad/s");
    if (apex && !(apex->value > kRelease && apex->value <= kFarthest))
      throw std::invalid_argument("apex goal: " + shown(apex->value) + " m above the tips; must be above " +
                                  shown(kRelease) + " and at most " + shown(kFarthest) + " m");
    if (landing) check_size("landing goal", landing->position.stableNorm(), kFarthest, "m");
    if (spin) weight("spin goal", spin->weight);
    if (apex) weight("apex goal", apex->weight);
    if (landing) weight("landing goal", landing->weight);
    if (taut) weight("taut goal", *taut);
    if (caught) weight("catch goal", *caught);
    if (throws() && taut) throw std::invalid_argument("goals: a throw cannot keep the string taut");
    if (waypoints.empty() && !final_state && !spin && !taut && !throws() && !caught)
      throw std::invalid_argument("goals: none; at least one expected");
  }
};

/// Least acceleration of the diabolo by a string that counts as taut [m/s^2].
inline constexpr double kLeastPull = 1.5;

/// How far a play is off one goal. The cost is the weight times the norm of the parts; the parts are smooth,
/// so that a solver can follow their derivatives, and their norm is the paper's cost.
template <class Scalar>
struct GoalError {
  std::string name;
  double weight;
  double tolerance;  ///< of the norm
  const char* unit;  ///< of the norm; empty for a share
  std::vector<Scalar> parts;
  bool held = true;  ///< whether what must hold besides does, such as that the diabolo was caught

  double size() const {
    double sum = 0.0;
    for (const Scalar& part : parts) {
      const double value = static_cast<double>(value_of(part));
      sum += value * value;
    }
    return std::sqrt(sum);
  }

  /// The same as a share of its tolerance; infinite where the goal does not hold.
  double share() const {
    const double off = size();
    return !held ? INFINITY : off == 0.0 ? 0.0 : off / tolerance;
  }
};

}  // namespace diabolo
