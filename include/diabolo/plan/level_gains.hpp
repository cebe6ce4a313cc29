// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <tuple>

#include "diabolo/plan/axle_response.hpp"
#include "diabolo/text/expect_positive.hpp"

namespace diabolo {

/// What levelling weighs: each quantity by the size at which it costs one.
struct LevelWeights {
  double tilt = 0.05;     ///< [rad]
  double yaw = 0.05;      ///< of the axle against the heading [rad]
  double heading = 1.0;   ///< of the player [rad]
  double lead = 0.3;      ///< [rad]
  double turn = 0.5;      ///< [rad/s]
  double horizon = 20.0;  ///< [s]

  /// Throws std::invalid_argument where one is out of its range.
  void validate() const {
    for (const auto& [name, value, unit] : {std::tuple("tilt", tilt, "rad"),
                                            {"yaw", yaw, "rad"},
                                            {"heading", heading, "rad"},
                                            {"lead", lead, "rad"},
                                            {"turn", turn, "rad/s"},
                                            {"horizon", horizon, "s"}})
      expect_positive(name, value, 1e3, unit);
  }
};

/// Gains K of the linear-quadratic regulator, (lead, turn) = -K (tilt, yaw, heading), which minimises the
/// weighed squares over the horizon: Riccati's recursion backwards. What no hand can move costs and stays,
/// such as the yaw of an axle without a groove.
inline Eigen::Matrix<double, 2, 3> level_gains(const AxleResponse& response,
                                               const LevelWeights& weights = {}) {
  constexpr double kStep = 0.02;  // [s]
  weights.validate();
  const auto one_over_square = [](double size) { return 1.0 / (size * size); };
  const double yaw = one_over_square(weights.yaw);
  Eigen::Matrix3d cost = Eigen::Matrix3d::Zero();
  cost(0, 0) = one_over_square(weights.tilt);
  cost.bottomRightCorner<2, 2>() << yaw, -yaw, -yaw, yaw + one_over_square(weights.heading);
  const Eigen::Matrix2d effort =
      Eigen::Vector2d(one_over_square(weights.lead), one_over_square(weights.turn)).asDiagonal();
  const Eigen::Matrix3d next = Eigen::Matrix3d::Identity() + kStep * response.drift;
  const Eigen::Matrix<double, 3, 2> push = kStep * response.drive;
  Eigen::Matrix3d to_go = cost;
  Eigen::Matrix<double, 2, 3> gains;
  for (int i = 0; i < static_cast<int>(weights.horizon / kStep); ++i) {
    const Eigen::Matrix2d weight = effort + push.transpose() * to_go * push;
    const Eigen::Matrix<double, 2, 3> wanted = push.transpose() * to_go * next;
    const double determinant = weight(0, 0) * weight(1, 1) - weight(0, 1) * weight(1, 0);
    Eigen::Matrix2d inverse;
    inverse << weight(1, 1), -weight(0, 1), -weight(1, 0), weight(0, 0);
    gains = inverse * wanted / determinant;
    to_go = cost + next.transpose() * to_go * (next - push * gains);
  }
  return gains;
}

}  // namespace diabolo
