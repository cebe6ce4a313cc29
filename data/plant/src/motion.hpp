// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reach.hpp"
#include "spline.hpp"
#include "state.hpp"

namespace plant {

/// Tips and directions of both sticks at one moment.
struct SticksPose {
  Pair<Vec3> tips{Vec3(0.0, 0.3, 1.25), Vec3(0.0, -0.3, 1.25)};  ///< [m]
  Pair<double> yaws{0.0, 0.0};                                   ///< to the left of forward [rad]
  Pair<double> pitches{0.0, 0.0};                                ///< above the horizontal [rad]
};

/// Hands that somebody else moves for a while, with constant accelerations; the sticks keep their directions.
struct Push {
  double begin = 0.0, end = 0.0;  ///< [s]
  Pair<Vec3> tips;                ///< at its begin [m]
  Pair<Vec3> velocities;          ///< at its begin [m/s]
  Pair<Vec3> accelerations;       ///< [m/s^2]
};

/// Unsteadiness of the hands: slow random wandering, which fades in and out within a second.
struct Wander {
  double tips = 0.0;        ///< of each coordinate of a tip (standard deviation) [m]
  double directions = 0.0;  ///< of each angle of a stick (standard deviation) [rad]
  double slowest = 0.2;     ///< lowest frequency [Hz]
  double fastest = 2.0;     ///< highest frequency [Hz]
};

/// The hands' motion: one C2 spline through the poses of a sequence of elements.
class Motion {
 public:
  /// Both sticks at `time` [s]; at rest before the start and after the end.
  Pair<Stick> at(double time) const;

  double duration() const { return spline_.end(); }

  /// The same with a reach of both hands on top.
  Motion reaching(const Reach& reach) const;

  /// The same, but for what is pushed: the tips from its begin on, and after its end too.
  Motion pushed(const Push& push) const;

 private:
  friend class MotionBuilder;
  explicit Motion(CubicSpline<10> spline) : spline_(std::move(spline)) {}

  CubicSpline<10> spline_;
  std::vector<Reach> reaches_;
  std::optional<Push> push_;
};

/// Puts a motion together from elements, each of which starts where the one before it ended. Vectors are
/// offsets from there, world frame [m]; times in s. Oscillations are eased in and out.
class MotionBuilder {
 public:
  explicit MotionBuilder(const SticksPose& start);

  /// Tips where the last element left them.
  Pair<Vec3> home() const;

  /// Keeps still.
  void hold(double duration);
  /// Moves both tips by an offset, from rest to rest (least jerk).
  void move(double duration, const Pair<Vec3>& offsets);
  /// Shakes the tips to and fro along `amplitudes`.
  void oscillate(const Pair<Vec3>& amplitudes, double frequency, double cycles);
  /// Swings the sticks about their tips by `yaws` and `pitches` [rad].
  void turn(const Pair<double>& yaws, const Pair<double>& pitches, double frequency, double cycles);
  /// Through given offsets at given times after the element's start.
  void path(const std::vector<double>& times, const Pair<std::vector<Vec3>>& offsets);

  /// The whole motion, with a player's unsteadiness on top.
  Motion finish(const Wander& wander, std::uint64_t seed) const;

 private:
  using Knot = CubicSpline<10>::Values;

  void add(double time, const Knot& knot);
  template <typename Wave>
  void repeat(double frequency, double cycles, const Wave& wave);

  std::vector<double> times_;
  std::vector<Knot> knots_;
};

}  // namespace plant
