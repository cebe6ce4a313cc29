// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/fit_take.hpp"
#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/effects/formula_laws.hpp"
#include "diabolo/model.hpp"

namespace diabolo {

/// Laws with what a fit adds to their numbers, within their ranges, and without those that do nothing.
inline FormulaLaws<double> fitted_laws(const FormulaLaws<double>& laws, const UnknownVector& at) {
  std::vector<Law> kept;
  std::vector<double> values;
  laws.each([&](const Law& law, std::size_t first) {
    const auto value = [&](std::size_t i) {
      const LawNumber& number = law.numbers[i];
      return number.within(laws.numbers[first + i] + number.usual * at[index_of(own_number(first + i))]);
    };
    if (value(0) == 0.0) return;
    kept.push_back(law);
    for (std::size_t i = 0; i < law.numbers.size(); ++i) values.push_back(value(i));
  });
  FormulaLaws<double> result(std::move(kept));
  std::ranges::copy(values, result.numbers.begin());
  return result;
}

/// Whether an unknown counts only beside others, which are zero.
inline bool counts_for_nothing(Unknown u, const UnknownVector& at) {
  return std::ranges::any_of(candidates(), [&](const Candidate& candidate) {
    return std::ranges::count(candidate.companions, u) > 0 &&
           !(at[index_of(candidate.unknowns.front())] > 0.0);
  });
}

/// The base with the physics of a fit.
inline Model augmented_model(const Model& base, const UnknownVector& at, const std::string& name) {
  const auto x = [&](Unknown u) { return at[index_of(u)]; };
  Model model = base;
  model.name = name;
  model.parameters.gravity += x(Unknown::kGravity);
  if (model.own_string_length) model.parameters.string_length += x(Unknown::kStringLength);
  model.parameters.spin_coupling = std::max(0.0, model.parameters.spin_coupling + x(Unknown::kSpinCoupling));
  model.parameters.wraps += x(Unknown::kWraps);
  auto& tilt = model.effects.get<GravityTilt>();
  tilt.x += x(Unknown::kTiltX);
  tilt.y += x(Unknown::kTiltY);
  for_each_unknown(model.effects, [&](Unknown u, double& field) {
    if (!counts_for_nothing(u, at)) field += std::clamp(x(u), info_of(u).minimum, info_of(u).maximum);
  });
  model.effects.get<FormulaLaws>() = fitted_laws(model.effects.get<FormulaLaws>(), at);
  if (x(Unknown::kAxleRadius) > 0.0) {
    model.parameters.axle_radius = x(Unknown::kAxleRadius);
    model.effects.get<FiniteAxle>().radius = is_thin(at) ? 0.0 : x(Unknown::kAxleRadius);
    model.own_axle_radius = true;
  }
  return model;
}

/// The same where the frames' rate may be wrong, which stands for gravity: that is as it was.
inline Model augmented_model(const Model& base, const UnknownVector& at, const std::string& name,
                             const Bank& bank) {
  Model model = augmented_model(base, at, name);
  if (std::ranges::find(bank, &candidate_of("frame_rate")) != bank.end())
    model.parameters.gravity = base.parameters.gravity;
  return model;
}

/// The recording as a camera without the faults of a fit would have made it: tips at the diabolo's time and
/// where they are, the diabolo's centre, lengths and the string's length true. Orientations stay. A lag is
/// undone as the delay that it is at first order.
inline Recording corrected(const Recording& given, const UnknownVector& at) {
  const double scale = 1.0 + at[index_of(Unknown::kLengthScale)],
               offset = at[index_of(Unknown::kTimeOffset)] - at[index_of(Unknown::kLag)];
  const Vector3<double> marker = at.segment<3>(index_of(Unknown::kMarkerX));
  Recording result = given;
  const Eigen::VectorXd times = row_times(given);
  const RecordedTips recorded(given, Interpolation::kSpline);
  const auto motion = recorded.motion(0, given.size() - 1);
  const auto place = [&](Track& tip, const OrientationTrack& orientation, Unknown first, bool left) {
    const std::vector<Eigen::Matrix3d> frames = stick_frames(orientation, given.size());
    std::size_t hint = 0;
    for (Eigen::Index i = 0; i < given.size(); ++i) {
      if (!tip.valid[i]) continue;
      const Tips<double> tips = motion->at(times[i] + offset, hint);
      tip.position.col(i) = ((left ? tips.left : tips.right) -
                             frames[static_cast<std::size_t>(i)] * at.segment<3>(index_of(first))) /
                            scale;
    }
  };
  place(result.left, given.left_orientation, Unknown::kLeftX, true);
  place(result.right, given.right_orientation, Unknown::kRightX, false);
  const OrientationTrack& body = given.diabolo_orientation;
  for (Eigen::Index i = 0; i < given.size(); ++i) {
    if (!given.diabolo.valid[i]) continue;
    Vector3<double> centre = given.diabolo.position.col(i);
    if (!body.empty() && body.valid[i])
      centre -= Eigen::Quaterniond(Eigen::Vector4d(body.quaternion.col(i))) * marker;
    result.diabolo.position.col(i) = centre / scale;
  }
  result.string_length += at[index_of(Unknown::kStringLength)];
  return result;
}

}  // namespace diabolo
