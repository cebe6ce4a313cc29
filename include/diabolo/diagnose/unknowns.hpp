// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <tuple>

#include "diabolo/diagnose/sought_fields.hpp"
#include "diabolo/effects/law.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"

namespace diabolo {

namespace diagnose_detail {

/// Numbers that are no field of an effect.
inline constexpr int kOthers = 20;
/// Of a field that is looked for under a name.
constexpr int number_of(std::string_view field) { return kOthers + field_named(field); }

}  // namespace diagnose_detail

/// Everything that a diagnosis may find to differ from the base simulator, one number each. At zero it is as
/// the base says. First comes what every recording has, then what else is no field of an effect, then the
/// fields in the order of their effects; those that some rule speaks of have a name here.
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
  kStringLength,  ///< true less given [m]
  kSpinCoupling,  ///< of the string to the spin, less the base's [1/s]
  kAxleRadius,    ///< of the string's centre line around the axle; slip and path count with it [m]
  kGravity,       ///< magnitude, less the base's [m/s^2]
  kWraps,         ///< of the string around the axle; a whole number, tried and never free
  kThinAxle,      ///< 1: the string lies around no axle, as a simulator's may; tried and never free
  kLag,           ///< time constant of what Delay says [s]; never free with kClock
  kCompliance = diagnose_detail::number_of("compliance"),
  kDamping = diagnose_detail::number_of("damping"),
  kStickCompliance = diagnose_detail::number_of("stick_compliance"),
  kStickDamping = diagnose_detail::number_of("stick_damping"),
  kTipMass = diagnose_detail::number_of("tip_mass"),
  kFriction = diagnose_detail::number_of("friction"),
  kSpinGain = diagnose_detail::number_of("spin_gain"),
  kRestitution = diagnose_detail::number_of("restitution"),
  kLinearDrag = diagnose_detail::number_of("linear_drag"),
  kQuadraticDrag = diagnose_detail::number_of("quadratic_drag"),
  kWindX = diagnose_detail::number_of("wind_x"),
  // Seen in the axle alone, and never free beside the others.
  kGyroscopicGain = diagnose_detail::number_of("gyroscopic_gain"),
  kGrooveProfile = diagnose_detail::number_of("groove_profile"),
  // Latent accelerations: what is left, wherever it comes from [m/s^2], [rad/s^2].
  kStringTangent = diagnose_detail::number_of("string_tangent"),
  kStringBinormal = diagnose_detail::number_of("string_binormal"),
  kFlightAgainst = diagnose_detail::number_of("flight_against_v"),
  kFlightVertical = diagnose_detail::number_of("flight_vertical"),
  kFlightLift = diagnose_detail::number_of("flight_axis_x_v"),
  kSpinString = diagnose_detail::number_of("spin_on_string"),
  kSpinFree = diagnose_detail::number_of("spin_off_string"),
  kPlacebo = diagnose_detail::number_of("placebo"),  ///< of a drag along x alone, as nothing is [1/s]
  /// The first number of FormulaLaws, less the base's, in its usual size; the others follow.
  kOwn = diagnose_detail::kOthers + static_cast<int>(diagnose_detail::kSoughtFields),
  kCount = kOwn + static_cast<int>(Law::kMostNumbers)
};

inline constexpr int kUnknowns = static_cast<int>(Unknown::kCount);
constexpr int index_of(Unknown u) { return static_cast<int>(u); }

/// The latent accelerations, one after the other, those of the place before those of the spin.
inline constexpr int kLatentFirst = index_of(Unknown::kStringTangent),
                     kLatents = index_of(Unknown::kSpinFree) + 1 - kLatentFirst,
                     kLatentForces = index_of(Unknown::kSpinString) - kLatentFirst;
static_assert(kLatents == 7 && kLatentForces == 5);

/// Whether a latent acceleration acts while the diabolo is on the string; else it acts off it.
constexpr bool acts_on_string(Unknown latent) {
  return latent == Unknown::kStringTangent || latent == Unknown::kStringBinormal ||
         latent == Unknown::kSpinString;
}

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

/// Whole numbers, which are tried and never free.
inline constexpr std::array kTriedUnknowns{Unknown::kWraps, Unknown::kThinAxle};

/// Whether the string lies around no axle.
inline bool is_thin(const UnknownVector& at) { return at[index_of(Unknown::kThinAxle)] > 0.0; }

/// Which unknowns are free.
using ActiveSet = Eigen::Array<bool, kUnknowns, 1>;

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline constexpr std::array<UnknownInfo, kUnknowns> kUnknownInfos = [] {
  constexpr std::array<UnknownInfo, diagnose_detail::kOthers> kOthers{{
      {"tilt_x", "rad", 0.01, 1.0 * kDegree, -6.0 * kDegree, 6.0 * kDegree},
      {"tilt_y", "rad", 0.01, 1.0 * kDegree, -6.0 * kDegree, 6.0 * kDegree},
      {"length_scale", "1", 0.01, 0.015, -0.05, 0.05},
      {"time_offset", "s", 0.01, 0.01, -0.06, 0.06},
      {"marker_x", "m", 0.01, 0.01, -0.08, 0.08},
      {"marker_y", "m", 0.001, 0.003, -0.04, 0.04},
      {"marker_z", "m", 0.001, 0.003, -0.04, 0.04},
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
      {"wraps", "1", 1.0, 0.0, 0.0, 5.0},
      {"thin_axle", "1", 1.0, 0.0, 0.0, 1.0},
      {"lag", "s", 0.01, 0.0, 0.0, 0.1},
  }};
  constexpr std::array<std::string_view, Law::kMostNumbers> kOwn{"own_1", "own_2", "own_3",
                                                                 "own_4", "own_5", "own_6"};
  std::array<UnknownInfo, kUnknowns> infos{};
  auto next = std::ranges::copy(kOthers, infos.begin()).out;
  next = std::ranges::copy(diagnose_detail::kSought, next).out;
  for (const std::string_view name : kOwn) *next++ = {name, "1", 1.0, 3.0, -1e3, 1e3};
  return infos;
}();

/// The unknown of a field that is looked for under this name.
constexpr Unknown unknown_named(std::string_view field) {
  return static_cast<Unknown>(diagnose_detail::number_of(field));
}

/// Calls `visit(unknown, field)` for every field of some effects that a diagnosis looks for.
template <class Set, class Visit>
void for_each_unknown(Set& effects, const Visit& visit) {
  const auto visit_effect = [&]<class Effect>(Effect& effect) {
    Effect::for_each(effect, [&](const ParameterInfo& info, auto& field) {
      if (!info.sought.name.empty()) visit(unknown_named(info.sought.name), field);
    });
  };
  std::apply([&](auto&... effect) { (visit_effect(effect), ...); }, effects.members);
}

/// The unknown of number `i` of FormulaLaws.
inline constexpr Unknown own_number(std::size_t i) {
  return static_cast<Unknown>(index_of(Unknown::kOwn) + static_cast<int>(i));
}

inline constexpr const UnknownInfo& info_of(Unknown u) {
  return kUnknownInfos[static_cast<std::size_t>(index_of(u))];
}

}  // namespace diabolo
