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

/// What minimises the weighed squares over the horizon from the angles x = (tilt, yaw, heading) on.
struct LevelRegulator {
  Eigen::Matrix<double, 2, 3> gains;  ///< (lead, turn) = -gains x
  Eigen::Matrix3d to_go;              ///< what is left then costs x' to_go x, in the weighed squares' seconds
};

/// The linear-quadratic regulator by Riccati's recursion backwards (Anderson and Moore, Optimal Control,
/// 1990, section 2.4). What no hand can move costs and stays, such as the yaw of an axle without a groove.
inline LevelRegulator level_regulator(const AxleResponse& response, const LevelWeights& weights = {}) {
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
  LevelRegulator found{Eigen::Matrix<double, 2, 3>::Zero(), cost};
  Eigen::Matrix3d& to_go = found.to_go;
  for (int i = 0; i < static_cast<int>(weights.horizon / kStep); ++i) {
    const Eigen::Matrix2d weight = effort + push.transpose() * to_go * push;
    const Eigen::Matrix<double, 2, 3> wanted = push.transpose() * to_go * next;
    const double determinant = weight(0, 0) * weight(1, 1) - weight(0, 1) * weight(1, 0);
    Eigen::Matrix2d inverse;
    inverse << weight(1, 1), -weight(0, 1), -weight(1, 0), weight(0, 0);
    found.gains = inverse * wanted / determinant;
    to_go = cost + next.transpose() * to_go * (next - push * found.gains);
  }
  to_go *= kStep;
  return found;
}

/// The regulator for the spin that is seen, learnt anew where that has changed by a tenth: the response goes
/// as one over the spin (gain scheduling).
class RegulatorBySpin {
 public:
  /// Throws as axle_response() does.
  RegulatorBySpin(const FullPredictor<double>& model, const Tips<double>& home, double spin,
                  const LevelWeights& weights)
      : model_(model), home_(home), weights_(weights) {
    learn(spin);
  }

  /// The last one where the diabolo is too slow to steer.
  const LevelRegulator& at(double spin) {
    const bool steers = std::abs(spin) >= kSlowestToSteer;
    if (steers && std::abs(spin - learnt_spin_) > kRelearn * std::abs(learnt_spin_)) learn(spin);
    return regulator_;
  }

  const LevelRegulator& last() const { return regulator_; }

 private:
  static constexpr double kRelearn = 0.1;  // share of the spin

  void learn(double spin) {
    regulator_ = level_regulator(axle_response(model_, home_, spin), weights_);
    learnt_spin_ = spin;
  }

  FullPredictor<double> model_;
  Tips<double> home_;
  LevelWeights weights_;
  LevelRegulator regulator_;
  double learnt_spin_ = 0.0;
};

}  // namespace diabolo
