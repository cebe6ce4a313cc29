// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "chain_state.hpp"
#include "diabolo.hpp"
#include "motion.hpp"
#include "stick.hpp"

namespace plant {

/// What the string is made of.
enum class Structure {
  kStrands,  ///< two massless springs around the axle (`StrandsPlant`)
  kChain,    ///< lumps of mass joined by springs, over which the axle slides (`ChainPlant`)
};

/// Everything that makes up the plant but the hands' motion.
struct PlantParameters {
  Structure structure = Structure::kStrands;
  DiaboloParameters diabolo;
  StringParameters string;
  StickParameters sticks;
  AirParameters air;
  Vec3 gravity{0.0, 0.0, -9.80665};  ///< [m/s^2]
  int steps_per_second = 48000;      ///< of the integrator
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
  ChainState chain;             ///< only where the string is a chain
};

/// Quantities that follow from a moment.
struct Reading {
  Pair<Vec3> tips{};     ///< bent tips [m]
  double stretch = 0.0;  ///< string beyond its length [m]; negative when slack, not a number when flying
  double wrap = 0.0;     ///< contact angle [rad]; 0 when flying
  double slip = 0.0;     ///< string over axle [m/s]; 0 unless taut
  Tensions tensions;     ///< on either side of the axle [N]; 0 unless taut
  Pair<Vec3> on_tips{Vec3::Zero(), Vec3::Zero()};  ///< the string's force on the tips [N]; 0 unless it pulls
  double energy = 0.0;  ///< kinetic, potential, elastic and of the sticks' bends [J]
};

/// A diabolo on a string between two driven sticks: what every structure of the string has in common.
class Plant {
 public:
  Plant(PlantParameters parameters, Motion motion)
      : parameters_(std::move(parameters)), motion_(std::move(motion)) {}
  virtual ~Plant() = default;

  const PlantParameters& parameters() const { return parameters_; }
  const Motion& motion() const { return motion_; }

  /// First moment of play. Throws std::invalid_argument when no hanging position is found.
  virtual Moment begin(const Start& start) const = 0;

  /// The moment `step` later [s], at most one integrator step; stops early when the diabolo misses the
  /// string. Throws std::domain_error when a tip has come within the axle.
  virtual Moment advanced(Moment moment, double step) const = 0;

  virtual Reading read(const Moment& moment) const = 0;

 protected:
  /// Unit vector against gravity, world z where there is none.
  Vec3 up() const;
  /// Height [m] of a place above the line between two ends.
  double height_above(const Pair<Vec3>& ends, const Vec3& place) const;

  PlantParameters parameters_;
  Motion motion_;
};

/// The plant of the structure that the parameters name.
std::unique_ptr<Plant> make_plant(PlantParameters parameters, Motion motion);

/// Moments of play at the given rising times [s], fewer when the diabolo misses the string before the last of
/// them.
std::vector<Moment> simulate(const Plant& plant, const Start& start, const std::vector<double>& times);

}  // namespace plant
