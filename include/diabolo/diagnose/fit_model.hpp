// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/fit_take.hpp"
#include "diabolo/diagnose/fitted_spring.hpp"
#include "diabolo/diagnose/latent_force.hpp"
#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/effects/all.hpp"
#include "diabolo/evaluate/start_on_spring.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/model.hpp"

namespace diabolo {

/// Usual sizes of a start's numbers [m], [m/s], [rad/s].
inline constexpr double kStartScales[kStartUnknowns] = {0.01, 0.01, 0.01, 0.1, 0.1, 0.1, 1.0};
/// Standard deviation of a start about its first guess, in its scales; far wider than a camera's.
inline constexpr double kStartPriors[kStartUnknowns] = {5.0, 5.0, 5.0, 50.0, 50.0, 50.0, 300.0};

namespace diagnose_detail {

/// The unknowns as numbers with derivatives: by a window's start first, then by those that are carried, in
/// their order. By the others there are none.
template <class D>
struct DualUnknowns {
  using Slope = typename D::Gradient::Scalar;
  UnknownVector at;          ///< SI units
  std::vector<int> columns;  ///< of the derivatives of a D, in the order of a window's system

  /// Those of `set`; a D must have room for them.
  DualUnknowns(const UnknownVector& values, const ActiveSet& set) : at(values) {
    column_.fill(-1);
    for (int c = 0; c < kStartUnknowns; ++c) columns.push_back(c);
    for (int u = 0; u < kUnknowns; ++u) {
      if (!set[u]) continue;
      column_[static_cast<std::size_t>(u)] = static_cast<int>(columns.size());
      columns.push_back(kStartUnknowns + u);
    }
    assert(columns.size() <= static_cast<std::size_t>(D::Gradient::SizeAtCompileTime));
  }

  D operator()(Unknown u) const {
    D result(at[index_of(u)]);
    set_slope(result, u, 1.0);
    return result;
  }
  /// The derivative of `number` by an unknown.
  void set_slope(D& number, Unknown u, double slope) const {
    const int column = column_[static_cast<std::size_t>(index_of(u))];
    if (column >= 0) number.gradient[column] = static_cast<Slope>(slope * info_of(u).scale);
  }

 private:
  std::array<int, kUnknowns> column_;
};

/// (What turns the axle alone is fitted apart, see AxleInquiry; LatentForce stands in its place.)
template <class D>
using FitPredictor = typename face_detail::PredictorWith<MotionEffects<D, LatentForce>>::Type;

/// The base with everything that may be missing, which carries its derivatives.
template <class D>
struct FitModel {
  Parameters<D> parameters;
  typename FitPredictor<D>::Set effects;
  double give;  ///< of the base and what is added [m/N]; see is_dynamic()
};

template <class D>
FitModel<D> fit_model(const Model& base, const Recording& recording, const DualUnknowns<D>& x) {
  const Parameters<double> given = parameters_for(base, recording);
  Parameters<D> p;
  p.copy_rules(given);
  copy_fields(given, p);
  const D scale = D(1.0) + x(Unknown::kLengthScale);
  p.string_length = (p.string_length + x(Unknown::kStringLength)) * scale;
  p.gravity = (p.gravity + x(Unknown::kGravity)) * scale;
  p.spin_coupling = p.spin_coupling + x(Unknown::kSpinCoupling);
  p.wraps = p.wraps + D(x.at[index_of(Unknown::kWraps)]);
  typename FitPredictor<D>::Set effects;
  copy_effects(base.effects, effects);
  auto& tilt = effects.template get<GravityTilt>();
  tilt.x += x(Unknown::kTiltX);
  tilt.y += x(Unknown::kTiltY);
  const auto elasticity = effects.template get<StringElasticity>();
  const auto flex = effects.template get<StickFlex>();
  for_each_unknown(effects, [&](Unknown u, D& field) {
    field += info_of(u).unit == "m/N" ? x(u) * scale : x(u);  // a stretch, in recorded lengths
  });
  const double give = give_of(base.effects) + added_give(x.at);
  if (!is_dynamic(give)) {  // see string_shift()
    effects.template get<StringElasticity>() = elasticity;
    effects.template get<StickFlex>() = flex;
  }
  p.axle_radius = x(Unknown::kAxleRadius) * scale;
  effects.template get<FiniteAxle>().radius = is_thin(x.at) ? D(0.0) : p.axle_radius;
  auto& own = effects.template get<FormulaLaws>();
  own.each([&](const Law& law, std::size_t first) {
    for (std::size_t i = 0; i < law.numbers.size(); ++i) {
      const LawNumber& number = law.numbers[i];
      D& value = own.numbers[first + i];
      value += x(own_number(first + i)) * D(number.usual);
      if (i > 0) value = minimum(maximum(value, D(number.minimum)), D(number.maximum));
    }
  });
  return {p, effects, give};
}

/// The tips with their derivatives by time offset, lag and tip offsets.
template <class D>
Tips<D> fit_tips(const FitTips& s, const DualUnknowns<D>& x) {
  const auto with = [&x](const Vector3<double>& value, const Vector3<double>& by_time,
                         const Vector3<double>& by_lag, const Eigen::Matrix3d& by_offset, Unknown first) {
    Vector3<D> result;
    for (int k = 0; k < 3; ++k) {
      result[k] = D(value[k]);
      x.set_slope(result[k], Unknown::kTimeOffset, by_time[k]);
      x.set_slope(result[k], Unknown::kLag, by_lag[k]);
      for (int j = 0; j < 3; ++j)
        x.set_slope(result[k], static_cast<Unknown>(index_of(first) + j), -by_offset(k, j));
    }
    return result;
  };
  Tips<D> tips;
  tips.time = D(s.tips.time);
  tips.left = with(s.tips.left, s.tips.left_velocity, s.left_by_lag, s.left_frame, Unknown::kLeftX);
  tips.right = with(s.tips.right, s.tips.right_velocity, s.right_by_lag, s.right_frame, Unknown::kRightX);
  tips.left_direction = s.tips.left_direction.template cast<D>();
  tips.right_direction = s.tips.right_direction.template cast<D>();
  tips.left_velocity = with(s.tips.left_velocity, s.left_acceleration, s.left_velocity_by_lag,
                            s.left_frame_rate, Unknown::kLeftX);
  tips.right_velocity = with(s.tips.right_velocity, s.right_acceleration, s.right_velocity_by_lag,
                             s.right_frame_rate, Unknown::kRightX);
  return tips;
}

/// Tension over mass as if at rest, the mean over a window [m/s^2]. The model's string is as much longer as
/// this stretches it; string_shift() is about what varies.
inline double usual_pull(const Recording& r, const FitWindow& window) {
  double sum = 0.0;
  int rows = 0;
  for (Eigen::Index i = window.first; i <= window.last; ++i) {
    if (!r.left.valid[i] || !r.right.valid[i] || !r.diabolo.valid[i]) continue;
    Tips<double> tips;
    tips.left = r.left.position.col(i);
    tips.right = r.right.position.col(i);
    sum += kStandardGravity /
           std::max(0.2, StringPath<double>(r.diabolo.position.col(i), tips).gradient().norm());
    ++rows;
  }
  return rows > 0 ? sum / rows : 0.0;
}

/// How far a string with a stiff spring leaves the diabolo from where a rigid one of its usual length would.
template <class D>
Vector3<D> string_shift(const State<D>& state, const Tips<D>& tips, const D& stretch_per_acceleration,
                        double usual) {
  const StringPath<D> path(state.position, tips);
  const Vector3<D> gradient = path.gradient();
  const D square = squared_norm(gradient) + D(1e-3);
  const D pull = norm(state.string_acceleration) / sqrt(square) - D(usual);
  return gradient * D(stretch_per_acceleration * pull / square);
}

/// Lets a start bounce as it was seen to, with the pull of a string of that length in place of a `rigid`
/// one's, if what gives in its place is soft. Whether it is.
template <class D>
bool bounce(State<D>& state, const State<D>& seen, Tips<D> tips, const D& rigid,
            const FitPredictor<D>& predictor) {
  const StringNow<D> string = string_from(tips, state, predictor);
  // (Both tips across the strands are twice as soft as one.)
  if (value_of(string.compliance) < 0.5 * kBouncyString * value_of(predictor.parameters().mass)) return false;
  state.position = seen.position;
  state.velocity = seen.velocity;
  const D stretch = StringPath<D>(state.position, tips).length() - string.length;
  state.string_acceleration =
      state.string_acceleration * D(maximum(stretch, D(0.0)) / (string.compliance * maximum(rigid, D(1e-3))));
  return true;
}

template <class D>
State<D> fit_start(const FitWindow& window, const FitPredictor<D>& predictor, const Tips<D>& tips,
                   const Tips<D>& next, const D& dt, bool bounces) {
  State<D> state;
  for (int k = 0; k < 3; ++k) {
    state.position[k] = D(window.start.position[k]);
    state.position[k].gradient[k] = static_cast<typename D::Gradient::Scalar>(kStartScales[k]);
    state.velocity[k] = D(window.start.velocity[k]);
    state.velocity[k].gradient[3 + k] = static_cast<typename D::Gradient::Scalar>(kStartScales[3 + k]);
    state.axis[k] = D(window.start.axis[k]);
  }
  state.spin = D(window.start.spin);
  state.spin.gradient[6] = static_cast<typename D::Gradient::Scalar>(kStartScales[6]);
  state.string_state = window.start.string_state;
  if (state.string_state != StringState::kOnString || !has_room(tips, predictor.parameters().string_length))
    return state;
  const State<D> seen = state;
  place_on_string(state, tips, D(0.0), predictor);
  const std::optional<FitPredictor<D>> rigid = without_springs(predictor);
  if (!rigid) return state;
  // At rest relative to its springs, where it does not bounce on them: longer by what the tension of a rigid
  // string's first step stretches them.
  const D pull = rigid_pull(state, *rigid, tips, next, dt);
  if (!bounces || !bounce(state, seen, tips, pull, predictor)) place_on_string(state, tips, pull, predictor);
  return state;
}

}  // namespace diagnose_detail

}  // namespace diabolo
