// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry.hpp"

namespace plant {

/// One segment of the chain at the middle of a step: a spring with a damper that can only pull.
struct Spring {
  Pair<Vec3> pulls{};       ///< unit vectors: how its length grows with its left and its right node
  Pair<Vec3> yields{};      ///< accelerations of those nodes against the pulls, per tension [1/kg]
  double axle_yield = 0.0;  ///< the same of the axle, along all that it does to the length [1/kg]
  double excess = 0.0;      ///< length beyond the unstretched one [m]
  double stiffness = 0.0;   ///< [N/m]
  double damping = 0.0;     ///< [N s/m]
  double rate = 0.0;        ///< of the length, before the step [m/s]
  double free_rate = 0.0;   ///< after the step, if no spring pulled in it [m/s]
};

/// The tensions of all springs over one step, implicit along the springs: the spring at the mean of its
/// lengths (implicit midpoint, which keeps the energy), the damper at the rate after the step. Neighbours
/// share a node, so that the system is tridiagonal and one sweep each way solves it however stiff the springs
/// are.
class TensionSystem {
 public:
  TensionSystem(const std::vector<Spring>& springs, double step);

  /// Tensions [N]; negative where a spring would have to push.
  std::vector<double> tensions() const;

  /// Change of the tensions where the free rates change by so much, segment by segment [N].
  std::vector<double> response(std::vector<double> rate_changes) const;

 private:
  void solve(std::vector<double>& values) const;

  const std::vector<Spring>& springs_;
  double step_;
  std::vector<double> gains_;   // tension per rate after the step [N s/m]
  std::vector<double> lower_;   // below the diagonal
  std::vector<double> upper_;   // above it, after elimination
  std::vector<double> pivots_;  // inverse
};

}  // namespace plant
