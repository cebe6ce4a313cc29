// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "diabolo/estimate/chart.hpp"
#include "diabolo/estimate/measurements.hpp"

namespace diabolo {

/// What a reading says of one strand: its tension and, where the pull is sure, its direction.
struct StrandPull {
  /// So many times its noise (of all components together), a pull is none of a string that hangs free.
  static constexpr double kSure = 3.0;

  bool sure = false;
  double tension = 0.0;                         ///< [N]; of noise alone, either sign
  MatrixOf<3> frame = MatrixOf<3>::Identity();  ///< towards the tip, and two directions across
  MatrixOf<3> noise = MatrixOf<3>::Identity();  ///< a factor of the covariance in that frame [N]
  bool directed = false;                        ///< the direction was measured, too

  /// From a force on the tip [N]; `expected` is the strand's unit vector from the diabolo to the tip.
  static StrandPull of_force(const Vector3<double>& on_tip, const MatrixOf<3>& noise,
                             const Vector3<double>& expected) {
    StrandPull pull;
    pull.sure = pull.directed = on_tip.norm() > kSure * noise.norm();
    const Vector3<double> towards = pull.sure ? Vector3<double>(-on_tip.normalized()) : expected;
    pull.frame << towards, StateChart<true>::across(towards);
    pull.tension = -towards.dot(on_tip);
    pull.noise = pull.frame.transpose() * noise;
    return pull;
  }

  static StrandPull of_tension(double tension, double noise) {
    StrandPull pull;
    pull.sure = tension > kSure * noise;
    pull.tension = tension;
    pull.noise(0, 0) = noise;
    return pull;
  }

  /// What it would have been for a strand of the given tension and direction: that tension, and how far its
  /// measured pull would have pointed across what was measured [N].
  ColumnOf<3> expected(double of_tension, const Vector3<double>& direction) const {
    if (!directed) return {of_tension, 0.0, 0.0};
    const ColumnOf<3> along = frame.transpose() * direction * tension;
    return {of_tension, along[1], along[2]};
  }
};

using StrandPulls = std::array<StrandPull, 2>;  ///< left, right

/// Both strands' pulls by a reading.
inline StrandPulls strand_pulls(const PullMeasurement& reading, const Strands<double>& expected) {
  if (const auto* forces = std::get_if<ForceMeasurement>(&reading))
    return {StrandPull::of_force(forces->forces.left, forces->left_noise, expected.left),
            StrandPull::of_force(forces->forces.right, forces->right_noise, expected.right)};
  if (const auto* tensions = std::get_if<TensionMeasurement>(&reading))
    return {StrandPull::of_tension(tensions->left, tensions->noise),
            StrandPull::of_tension(tensions->right, tensions->noise)};
  return {};
}

}  // namespace diabolo
