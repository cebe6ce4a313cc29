// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "diabolo/effects/law.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"

namespace diabolo {

/// Everything that a diagnosis may find to differ from the base simulator, one number each. At zero it is as
/// the base says.
enum class Unknown : int {
  kTiltX,  ///< of gravity in the recording's frame [rad]
  kTiltY,
  kLengthScale,  ///< recorded / true length, less 1
  kTimeOffset,   ///< the recorded diabolo is ahead of the sticks [s]
  kMarkerX,      ///< recorded centre less true centre in the diabolo's body, x along the axle [m]
  kMarkerY,
  kMarkerZ,
  kLeftX,  ///< recorded less true left tip, in the stick's frame or, without one, the world's [m]
  kLeftY,
  kLeftZ,
  kRightX,
  kRightY,
  kRightZ,
  kStringLength,     ///< true less given [m]
  kSpinCoupling,     ///< of the string to the spin, less the base's [1/s]
  kAxleRadius,       ///< of the string's centre line around the axle; slip and path count with it [m]
  kGravity,          ///< magnitude, less the base's [m/s^2]
  kCompliance,       ///< of the string [m/N]
  kDamping,          ///< of the string [N s/m]; counts where there is compliance
  kStickCompliance,  ///< of one stick's tip [m/N]
  kStickDamping,     ///< of one stick's tip [N s/m]; counts where there is compliance
  kTipMass,          ///< of one stick's tip [kg]; counts where there is compliance
  kFriction,         ///< capstan coefficient
  kSpinGain,         ///< mass times axle radius over moment of inertia [1/m]; counts where there is friction
  kWraps,            ///< of the string around the axle; a whole number, tried and never free
  kRestitution,      ///< of a catch
  kLinearDrag,       ///< [1/s]
  kQuadraticDrag,    ///< [1/m]
  kWindX,            ///< [m/s]; counts where there is drag
  kWindY,
  kLift,            ///< Magnus [1/rad]
  kStringMass,      ///< per length [kg/m]
  kSpinAir,         ///< [1/rad]
  kSpinAxle,        ///< [rad/s^2]
  kGyroscopicGain,  ///< of the axle's turning [1/m]; seen in the axle alone, and never free
  kLag,             ///< time constant of what Delay says [s]; never free with kClock
  // Latent accelerations: what is left, wherever it comes from [m/s^2], [rad/s^2].
  kStringTangent,
  kStringBinormal,
  kFlightAgainst,
  kFlightVertical,
  kFlightLift,
  kSpinString,
  kSpinFree,
  kPlacebo,  ///< of a drag that acts along the recording's x alone, as nothing does [1/s]
  kOwn,      ///< the first number of FormulaLaws, less the base's, in its usual size; the others follow
  kCount = kOwn + static_cast<int>(Law::kMostNumbers)
};

inline constexpr int kUnknowns = static_cast<int>(Unknown::kCount);
inline constexpr int index_of(Unknown u) { return static_cast<int>(u); }

/// What makes the recorded diabolo late against the sticks, beside the time offset.
enum class Delay {
  kClock,   ///< nothing
  kFilter,  ///< a first-order low pass that the diabolo's track went through
  kServo,   ///< sticks that follow the recorded, commanded ones as through such a filter
};

/// One number for each unknown, in SI units. (Not aligned for SIMD: the buffers that libstdc++'s stable
/// algorithms work in are not, either.)
using UnknownVector = Eigen::Matrix<double, kUnknowns, 1, Eigen::ColMajor | Eigen::DontAlign>;
using UnknownMatrix = Eigen::MatrixXd;  ///< kUnknowns x kUnknowns

/// Which unknowns are free.
using ActiveSet = Eigen::Array<bool, kUnknowns, 1>;

/// What is known of an unknown before a recording is looked at.
struct UnknownInfo {
  std::string_view name, unit;
  double scale;             ///< a usual size: all linear algebra is done in it
  double prior;             ///< standard deviation of what a well made measurement has; 0: not known at all
  double minimum, maximum;  ///< search bounds
};

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline constexpr std::array<UnknownInfo, kUnknowns> kUnknownInfos{{
    {"tilt_x", "rad", 0.01, 1.0 * kDegree, -6.0 * kDegree, 6.0 * kDegree},
    {"tilt_y", "rad", 0.01, 1.0 * kDegree, -6.0 * kDegree, 6.0 * kDegree},
    {"length_scale", "1", 0.01, 0.015, -0.05, 0.05},
    {"time_offset", "s", 0.01, 0.01, -0.06, 0.06},
    {"marker_x", "m", 0.01, 0.01, -0.08, 0.08},
    {"marker_y", "m", 0.001, 0.003, -0.01, 0.01},
    {"marker_z", "m", 0.001, 0.003, -0.01, 0.01},
    {"left_x", "m", 0.01, 0.005, -0.04, 0.04},
    {"left_y", "m", 0.01, 0.005, -0.04, 0.04},
    {"left_z", "m", 0.01, 0.005, -0.04, 0.04},
    {"right_x", "m", 0.01, 0.005, -0.04, 0.04},
    {"right_y", "m", 0.01, 0.005, -0.04, 0.04},
    {"right_z", "m", 0.01, 0.005, -0.04, 0.04},
    {"string_length", "m", 0.01, 0.02, -kOddPathLength, kOddPathLength},
    {"spin_coupling", "1/s", 0.1, 1.0, -1e3, 1e3},
    {"axle_radius", "m", 0.001, 0.0007, 0.001, 0.03},
    {"gravity", "m/s^2", 0.1, 0.0, -10.0, 10.0},
    {"compliance", "m/N", 1e-3, 3e-3, 0.0, 1.0 / 30.0},
    {"damping", "N s/m", 10.0, 10.0, 0.0, 1e3},
    {"stick_compliance", "m/N", 1e-3, 3e-3, 0.0, 1.0 / 30.0},
    {"stick_damping", "N s/m", 1.0, 2.0, 0.0, 1e3},
    {"tip_mass", "kg", 0.01, 0.004, 0.0, 0.1},
    {"friction", "1", 0.1, 0.3, 0.0, 0.6},
    {"spin_gain", "1/m", 1.0, 5.0, 0.0, 100.0},
    {"wraps", "1", 1.0, 0.0, 0.0, 5.0},
    {"restitution", "1", 0.1, 0.2, 0.0, 1.0},
    {"linear_drag", "1/s", 0.1, 0.3, 0.0, 1.0},
    {"quadratic_drag", "1/m", 0.1, 0.15, 0.0, 0.5},
    {"wind_x", "m/s", 1.0, 3.0, -6.0, 6.0},
    {"wind_y", "m/s", 1.0, 3.0, -6.0, 6.0},
    {"lift", "1/rad", 1e-3, 5e-3, -0.02, 0.02},
    {"string_mass", "kg/m", 1e-3, 3e-3, 0.0, 0.1},
    {"spin_air", "1/rad", 1e-3, 5e-3, 0.0, 0.02},
    {"spin_axle", "rad/s^2", 1.0, 20.0, 0.0, 60.0},
    {"gyroscopic_gain", "1/m", 1.0, 0.0, 0.0, 100.0},
    {"lag", "s", 0.01, 0.0, 0.0, 0.1},
    {"string_tangent", "m/s^2", 0.1, 0.0, -100.0, 100.0},
    {"string_binormal", "m/s^2", 0.1, 0.0, -100.0, 100.0},
    {"flight_against_v", "m/s^2", 0.1, 0.0, -100.0, 100.0},
    {"flight_vertical", "m/s^2", 0.1, 0.0, -100.0, 100.0},
    {"flight_axis_x_v", "m/s^2", 0.1, 0.0, -100.0, 100.0},
    {"spin_on_string", "rad/s^2", 1.0, 0.0, -100.0, 100.0},
    {"spin_off_string", "rad/s^2", 1.0, 0.0, -100.0, 100.0},
    {"placebo", "1/s", 0.1, 0.0, -10.0, 10.0},
    {"own_1", "1", 1.0, 3.0, -1e3, 1e3},
    {"own_2", "1", 1.0, 3.0, -1e3, 1e3},
    {"own_3", "1", 1.0, 3.0, -1e3, 1e3},
    {"own_4", "1", 1.0, 3.0, -1e3, 1e3},
    {"own_5", "1", 1.0, 3.0, -1e3, 1e3},
    {"own_6", "1", 1.0, 3.0, -1e3, 1e3},
}};

/// The unknown of number `i` of FormulaLaws.
inline constexpr Unknown own_number(std::size_t i) {
  return static_cast<Unknown>(index_of(Unknown::kOwn) + static_cast<int>(i));
}

inline constexpr const UnknownInfo& info_of(Unknown u) {
  return kUnknownInfos[static_cast<std::size_t>(index_of(u))];
}

}  // namespace diabolo
