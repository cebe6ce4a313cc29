// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "diabolo/effects/all.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/math/shortest_turn.hpp"
#include "diabolo/recording/recording.hpp"

/// Recordings of play that the full model predicts, as a camera sees them.
namespace diabolo {

inline constexpr double kRate = 120.0, kNoise = 4e-4, kAttitudeNoise = 2e-3;

/// A player who swings, beats and moves fore and aft, one after the other, each for a while.
inline Tips<double> hands(double t) {
  const double swing = 0.09 * std::sin(4.5 * t), beat = 0.05 * (1.0 - std::cos(8.0 * t)),
               fore = 0.06 * std::sin(3.1 * t);
  const double a = 0.5 - 0.5 * std::cos(0.9 * t);
  Tips<double> tips;
  tips.left = Vector3<double>(fore, 0.28 + swing * a, 1.25 + beat * (1.0 - a));
  tips.right = Vector3<double>(-fore, -0.28 + swing * a, 1.25 - beat * (1.0 - a));
  return tips;
}

/// The same with hops: the string goes slack and catches the diabolo again.
inline Tips<double> hopping_hands(double t) {
  Tips<double> tips = hands(t);
  for (Vector3<double>* tip : {&tips.left, &tips.right}) tip->z() += 0.075 * (1.0 - std::cos(9.5 * t));
  return tips;
}

/// What a camera sees of play that the full model with these effects predicts; not on the diagnosis' grid.
inline Recording played(const AllEffects<double>& effects, double seconds, std::uint64_t seed,
                        double wraps = 0.0, Tips<double> (*moved)(double) = &hands) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise(0.0, kNoise);
  const Eigen::Index rows = static_cast<Eigen::Index>(seconds * kRate);
  Recording r;
  r.name = "played";
  r.rate = kRate;
  r.string_length = 1.45;
  r.time.resize(rows);
  r.left = r.right = r.diabolo = Track::missing(rows);
  r.diabolo_orientation = OrientationTrack::missing(rows);
  for (Track* track : {&r.left, &r.right, &r.diabolo}) track->valid.setConstant(true);
  r.diabolo_orientation.valid.setConstant(true);
  AllEffects<double> all = effects;
  Parameters<double> parameters;
  parameters.mass = r.properties.mass;
  parameters.wraps = wraps;
  parameters.axle_radius = all.get<FiniteAxle>().radius = r.properties.axle_radius + 7e-4;
  const FullPredictor<double> predictor(parameters, all);
  State<double> state;
  state.position = Vector3<double>(0.0, 0.0, 0.58);
  state.spin = 180.0;
  constexpr int kSteps = 10;  // per row
  const double dt = 1.0 / kRate / kSteps;
  const auto tips_at = [moved](double t) {
    Tips<double> tips = moved(t);
    const double h = 1e-5;
    tips.time = t;
    tips.left_velocity = (moved(t + h).left - moved(t - h).left) / (2.0 * h);
    tips.right_velocity = (moved(t + h).right - moved(t - h).right) / (2.0 * h);
    return tips;
  };
  std::mt19937_64 attitude(seed + 1000);
  std::normal_distribution<double> normal;
  const auto seen_axle = [&] {
    return Vector3<double>(normal(attitude), normal(attitude), normal(attitude));
  };
  double turned = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    r.frame.push_back(i);
    r.time[i] = static_cast<double>(i) / kRate;
    const Tips<double> tips = tips_at(r.time[i]);
    const auto seen = [&](Vector3<double> v) {
      for (double& x : v) x += noise(generator);
      return v;
    };
    r.left.position.col(i) = seen(tips.left);
    r.right.position.col(i) = seen(tips.right);
    r.diabolo.position.col(i) = seen(state.position);
    const Vector3<double> axle = (state.axis + kAttitudeNoise * seen_axle()).normalized();
    r.diabolo_orientation.quaternion.col(i) =
        (shortest_turn(Vector3<double>::UnitX(), axle) * Eigen::AngleAxisd(-turned, Vector3<double>::UnitX()))
            .coeffs();
    for (int s = 0; s < kSteps; ++s) {
      const double t = r.time[i] + s * dt;
      turned += state.spin * dt;
      predictor.step(state, tips_at(t), tips_at(t + dt), dt);
    }
  }
  return r;
}

}  // namespace diabolo
