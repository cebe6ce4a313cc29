// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "diabolo.hpp"
#include "motion.hpp"
#include "stick.hpp"

namespace plant {

/// Everything that makes up the plant but the hands' motion.
struct PlantParameters {
  DiaboloParameters diabolo;
  StringParameters string;
  StickParameters sticks;
  AirParameters air;
  Vec3 gravity{0.0, 0.0, -9.80665};  ///< [m/s^2]
  int steps_per_second = 48000;      ///< of the Runge-Kutta integrator
};

/// How play begins.
struct Start {
  double spin = 100.0;  ///< play's sign: positive drives the axle's underside towards the right tip [rad/s]
  double yaw = 0.0;     ///< of the axis, to the left of forward [rad]
  double pitch = 0.0;   ///< of the axis, above the horizontal [rad]
  bool flying = false;  ///< off the string
  std::optional<Vec3> position;  ///< centre of mass, sticks unbent [m]; none: hanging at rest on bent sticks
  Vec3 velocity = Vec3::Zero();  ///< [m/s]; only with a position
};

/// All that changes with time.
struct Moment {
  double time = 0.0;  ///< [s]
  State state = State::Zero();
  Mode mode = Mode::kOnString;
  double chirality = -1.0;      ///< sense of the string around the axis (see StringEnds)
  double wrap_reference = 0.0;  ///< wrap angle of the last step [rad]
  bool missed = false;          ///< fell past the string: play is over
};

/// Quantities that follow from a moment.
struct Reading {
  Pair<Vec3> tips{};     ///< bent tips [m]
  double stretch = 0.0;  ///< string beyond its length [m]; negative when slack, not a number when flying
  double wrap = 0.0;     ///< contact angle [rad]; 0 when flying
  double slip = 0.0;     ///< string over axle [m/s]; 0 unless taut
  Tensions tensions;     ///< [N]; 0 unless taut
  double energy = 0.0;   ///< kinetic, potential, elastic and of the sticks' bends [J]
};

/// A diabolo on a string between two driven sticks. The string is two explicit springs around a finite axle;
/// the integrator is Runge-Kutta of order four with a fixed step, cut where the string tautens, slackens or
/// parts.
class Plant {
 public:
  Plant(PlantParameters parameters, Motion motion)
      : parameters_(std::move(parameters)), motion_(std::move(motion)) {}

  const PlantParameters& parameters() const { return parameters_; }
  const Motion& motion() const { return motion_; }

  /// First moment of play. Throws std::invalid_argument when no hanging position is found.
  Moment begin(const Start& start) const;

  /// The moment `step` later [s], at most one integrator step; stops early when the diabolo misses the
  /// string. Throws std::domain_error when a tip has come within the axle.
  Moment advanced(Moment moment, double step) const;

  Reading read(const Moment& moment) const;

 private:
  Pair<Vec3> tips(const State& state, const Pair<Stick>& sticks) const;
  StringShape shape(const Moment& moment, const State& state, const Pair<Stick>& sticks) const;
  State rate(const Moment& moment, const State& state, const Pair<Stick>& sticks) const;
  State runge_kutta(const Moment& moment, double step) const;
  Moment stepped(const Moment& moment, double step) const;
  bool is_taut(const StringShape& shape) const;
  double height_above_chord(const Moment& moment) const;
  bool stays(const Moment& moment) const;
  void switch_mode(Moment& moment) const;
  void land(Moment& moment) const;
  Vec3 up() const;
  void hang(Moment& moment) const;
  double energy(const State& state) const;

  PlantParameters parameters_;
  Motion motion_;
};

/// Moments of play at the given rising times [s], fewer when the diabolo misses the string before the last of
/// them.
std::vector<Moment> simulate(const Plant& plant, const Start& start, const std::vector<double>& times);

}  // namespace plant
