// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

#include "diabolo/full_predictor.hpp"
#include "diabolo/plan/turned.hpp"
#include "diabolo/string/hanging.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Tilt of the axle up and yaw to the left [rad], of a unit vector that points forward.
struct AxleAngles {
  double tilt = 0.0, yaw = 0.0;
};
inline AxleAngles axle_angles(const Vector3<double>& axis) {
  return {std::atan2(axis.z(), std::hypot(axis.x(), axis.y())), std::atan2(axis.y(), axis.x())};
}
inline Vector3<double> axle_at(const AxleAngles& angles) {
  const double level = std::cos(angles.tilt);
  return {level * std::cos(angles.yaw), level * std::sin(angles.yaw), std::sin(angles.tilt)};
}

/// How the axle of a diabolo that hangs between level hands answers them, to first order: d/dt (tilt, yaw,
/// heading) = drift (tilt, yaw, heading) + drive (lead, turn), angles in rad as in Turned, and `turn`
/// the rate of the heading [rad/s]. The axle follows its torque without nutation, so that both
/// matrices go as one over the spin but for the heading's own row.
struct AxleResponse {
  Eigen::Matrix3d drift;
  Eigen::Matrix<double, 3, 2> drive;
};

/// A slower diabolo is not steered: its law fades [rad/s].
inline constexpr double kSlowestToSteer = 2.0 * GyroscopicTilt<double>::kSlowSpin;

namespace level_detail {

/// Throws std::invalid_argument where these are no hands side by side.
inline void check_home(const Tips<double>& home, double string_length) {
  const Eigen::Vector3d apart = home.left - home.right;
  if (!apart.allFinite() || !(home.left.cwiseAbs().maxCoeff() < 1e3))
    throw std::invalid_argument("hands: a place is not finite, or more than 1000 m away");
  if (!(apart.norm() < string_length))
    throw std::invalid_argument("hands: " + shown(apart.norm()) +
                                " m apart; expected less than the string's " + shown(string_length) + " m");
  if (!(apart.y() > 0.5 * apart.norm()))
    throw std::invalid_argument("hands: the left one is " + shown(apart.y()) +
                                " m to the left of the right one; expected them side by side");
}

/// Rate of the axle's angles under a string that carries the resting diabolo.
inline Eigen::Vector2d angle_rates(const AllEffects<double>& effects, const Parameters<double>& parameters,
                                   const AxleAngles& at, double spin, const Tips<double>& tips) {
  constexpr double kStep = 1e-3;
  State<double> state = hanging_state(tips.left, tips.right, parameters.string_length, spin);
  state.axis = axle_at(at);
  StringStepResult<double> result;
  result.position = state.position;
  result.string_acceleration = Vector3<double>(0.0, 0.0, parameters.gravity);
  result.taut = true;
  Tips<double> shifted = tips;
  effects.tip_shift(state, tips, parameters).move(shifted);
  effects.turn_axle(state, shifted, result, 0.0, kStep, parameters);
  const AxleAngles after = axle_angles(state.axis);
  return {(after.tilt - at.tilt) / kStep, (after.yaw - at.yaw) / kStep};
}

}  // namespace level_detail

/// The response of the model's diabolo at that spin [rad/s], between hands at `home`, by central differences.
/// Throws std::invalid_argument where the model does not turn its axle, or the spin is too slow to steer.
inline AxleResponse axle_response(const FullPredictor<double>& model, const Tips<double>& home, double spin) {
  constexpr double kSmall = 1e-4;
  AllEffects<double> effects = model.effects();
  effects.get<GyroscopicTilt>().inertia_ratio = 0.0;
  if (!(effects.get<GyroscopicTilt>().gain > 0.0))
    throw std::invalid_argument("gyroscopic_tilt gain: 0 1/m; levelling needs a model that turns its axle");
  if (!(std::abs(spin) >= kSlowestToSteer) || !std::isfinite(spin))
    throw std::invalid_argument("spin: " + shown(spin) + " rad/s; levelling needs 10 at least");
  level_detail::check_home(home, model.parameters().string_length);
  const Eigen::Vector3d pivot = 0.5 * (home.left + home.right);
  const auto rates = [&](double tilt, double yaw, double heading, double lead) {
    return level_detail::angle_rates(effects, model.parameters(), {tilt, yaw}, spin,
                                     Turned{heading, lead, pivot}(home));
  };
  const auto slope = [&](double tilt, double yaw, double heading, double lead) -> Eigen::Vector2d {
    return (rates(kSmall * tilt, kSmall * yaw, kSmall * heading, kSmall * lead) -
            rates(-kSmall * tilt, -kSmall * yaw, -kSmall * heading, -kSmall * lead)) /
           (2.0 * kSmall);
  };
  AxleResponse response{Eigen::Matrix3d::Zero(), Eigen::Matrix<double, 3, 2>::Zero()};
  response.drift.topRows<2>() << slope(1, 0, 0, 0), slope(0, 1, 0, 0), slope(0, 0, 1, 0);
  response.drive.topLeftCorner<2, 1>() = slope(0, 0, 0, 1);
  response.drive(2, 1) = 1.0;
  return response;
}

}  // namespace diabolo
