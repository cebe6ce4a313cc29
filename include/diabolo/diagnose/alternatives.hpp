// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/explanations.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/refine.hpp"

namespace diabolo {

/// Over which a string lies around the axle that has no wraps [rad].
inline constexpr double kUsualContact = 2.6;

/// By how much a wrapped string may differ from its given length [m].
inline constexpr double kWrappedLength = 0.03;

/// Another explanation, which takes the place of the first in a fit of its own.
struct Alternative {
  std::string_view name;
  Delay delay;
  ActiveSet set;
  UnknownVector at;  ///< to begin with
};

/// What took a claim's place, or kept it, and what does as well.
struct Replacement {
  std::string_view name;               ///< of the best
  std::vector<std::string> tied_with;  ///< others that do as well, or would but for a single window
  double z = 0.0;  ///< by how much the claim that it replaced is worse [standard deviations]
};

/// `fit` with one unknown's part taken by another, beside what the other has of its own; the damping is that
/// of what was replaced.
inline Alternative exchanged(const Fit& fit, const ActiveSet& set, std::string_view from, std::string_view to,
                             double share) {
  const Candidate &old = candidate_of(from), &young = candidate_of(to);
  Alternative result{to, fit.delay, with(with(set, old, false), young), fit.at};
  double& taken = result.at[index_of(first_of(young))];
  taken = std::min(info_of(first_of(young)).maximum,
                   (is_in(set, young) ? taken : 0.0) + share * fit.at[index_of(first_of(old))]);
  // Two sticks are two springs in a row with their dashpots.
  if (to == "stick_flex")
    result.at[index_of(Unknown::kStickDamping)] = 2.0 * fit.at[index_of(Unknown::kDamping)];
  if (to == "string_elasticity")
    result.at[index_of(Unknown::kDamping)] = 0.5 * fit.at[index_of(Unknown::kStickDamping)];
  return result;
}

/// Whether wraps of the string are worth a trial, which multiply friction by three to five: it rubs no less
/// than three times what the smoothest string does, on a spin that was seen. (A turn around no axle takes up
/// no length, and cannot be told.)
inline bool may_be_wrapped(const Fit& fit) {
  return !is_thin(fit.at) && fit.at[index_of(Unknown::kWraps)] == 0.0 &&
         std::ranges::all_of(fit.fit_takes, has_spin) && fit.at[index_of(Unknown::kFriction)] > 0.1;
}

/// The string so often around the axle: longer by its circumference for each turn, and rubbing less.
inline Alternative wrapped(std::string_view name, const Fit& fit, const ActiveSet& set, double turns) {
  constexpr double kTurn = 2.0 * std::numbers::pi;  // [rad]
  Alternative result{name, fit.delay, set, fit.at};
  double& now = result.at[index_of(Unknown::kWraps)];
  result.at[index_of(Unknown::kFriction)] *= (kUsualContact + kTurn * now) / (kUsualContact + kTurn * turns);
  result.at[index_of(Unknown::kStringLength)] +=
      kTurn * (turns - now) * fit.at[index_of(Unknown::kAxleRadius)];
  now = turns;
  return result;
}

/// A drag by the square of the speed relative to a wind, in place of a drag and a tilt. To a diabolo that is
/// slower than the wind it is a linear drag of k w and a push of k w^2, as a tilt gives.
inline Alternative drag_in_wind(const Fit& fit, const ActiveSet& set, std::string_view from) {
  Alternative result = from == "air_drag_linear" ? exchanged(fit, set, from, "air_drag_quadratic", 0.0)
                                                 : Alternative{from, fit.delay, set, fit.at};
  result.name = "wind";
  result.set = with(result.set, candidate_of("wind"));
  constexpr int kTilt = index_of(Unknown::kTiltX), kWind = index_of(Unknown::kWindX);
  const Eigen::Vector2d push = kStandardGravity * fit.at.segment<2>(kTilt);
  const double linear = std::max(fit.at[index_of(Unknown::kLinearDrag)], 1e-3);
  double& quadratic = result.at[index_of(Unknown::kQuadraticDrag)];
  const double speed =
      std::clamp(quadratic > 0.0 ? std::sqrt(push.norm() / quadratic) : push.norm() / linear, 0.5, 5.0);
  if (!(quadratic > 0.0)) quadratic = std::min(info_of(Unknown::kQuadraticDrag).maximum, linear / speed);
  result.at.segment<2>(kWind) = push.normalized() * speed;
  result.at.segment<2>(kTilt).setZero();
  return result;
}

/// A wrong rate of the frames in place of a wrong scale: recorded gravity and string stay as long.
inline Alternative rate_for_scale(const Fit& fit, const ActiveSet& set) {
  Alternative result{"frame_rate", fit.delay, set, fit.at};
  result.set[index_of(Unknown::kLengthScale)] = false;
  result.set[index_of(Unknown::kGravity)] = true;
  const double scale = fit.at[index_of(Unknown::kLengthScale)];
  double& length = result.at[index_of(Unknown::kStringLength)];
  length += scale * (fit.fit_takes.front().take->recording.string_length + length);
  result.at[index_of(Unknown::kGravity)] = scale * kStandardGravity;
  return result;
}

/// What else may explain what is claimed under this name. A pure delay, a low pass and a lagging servo differ
/// in the second order of the delay only; a wrong rate of the frames looks like a wrong scale on a string of
/// another length; wind in a drag like a tilt; a string wrapped around the axle like one that is shorter by
/// the axle's circumference and rubs more; the give of string and sticks by the sticks' directions; the laws
/// of drag by the speeds; friction slows the spin as a bearing does.
inline std::vector<Alternative> alternatives_to(std::string_view name, const Fit& fit, const ActiveSet& set) {
  constexpr double kUsualSpeed = 2.0;  // [m/s]
  std::vector<Alternative> others;
  const auto absent = [&](std::string_view other) { return !is_in(set, candidate_of(other)); };
  if (name == "time_offset" && fit.delay == Delay::kClock && fit.at[index_of(Unknown::kTimeOffset)] < 0.0) {
    // Two beginnings: from a lag that is all of the delay the way to one that is a part of it may be barred.
    for (const auto& [lag, delay] :
         {std::pair("filter_lag", Delay::kFilter), {"robot_servo_lag", Delay::kServo}})
      for (const double share : {1.0, 0.5}) {
        others.push_back({lag, delay, with(set, candidate_of(lag)), fit.at});
        others.back().at[index_of(Unknown::kLag)] = -share * fit.at[index_of(Unknown::kTimeOffset)];
        others.back().at[index_of(Unknown::kTimeOffset)] *= 1.0 - share;
      }
  } else if (name == "length_scale" && !set[index_of(Unknown::kGravity)]) {
    others.push_back(rate_for_scale(fit, set));
  } else if (name == "gravity_tilt" && absent("wind") && !absent("air_drag_quadratic")) {
    // (In a drag that is linear it is exactly that tilt: nothing could tell, and a tilt is the likelier one.)
    others.push_back(drag_in_wind(fit, with(set, candidate_of(name), false), "air_drag_quadratic"));
  } else if (name == "wind") {
    others.push_back({"gravity_tilt", fit.delay, with(set, candidate_of(name), false), fit.at});
  } else if (name == "string_friction" && may_be_wrapped(fit)) {
    others.push_back(wrapped("string_wrap", fit, set, 1.0));
  } else if ((name == "axle_drag" || name == "spin_drag") && absent("string_friction")) {
    others.push_back(exchanged(fit, set, name, "string_friction", 0.0));
    others.back().at[index_of(Unknown::kFriction)] = 0.1;
  } else if (name == "string_elasticity") {
    others.push_back(exchanged(fit, set, name, "stick_flex", 0.5));
  } else if (name == "stick_flex") {
    others.push_back(exchanged(fit, set, name, "string_elasticity", 2.0));
  } else if (name == "air_drag_linear") {
    others.push_back(exchanged(fit, set, name, "air_drag_quadratic", 1.0 / kUsualSpeed));
    if (absent("wind")) others.push_back(drag_in_wind(fit, set, name));
  } else if (name == "air_drag_quadratic") {
    others.push_back(exchanged(fit, set, name, "air_drag_linear", kUsualSpeed));
    if (absent("wind")) others.push_back(drag_in_wind(fit, set, name));
  }
  return others;
}

/// The bank in which one explanation has taken another's place. A wrap is no candidate of its own, and a lag
/// comes beside the time offset.
inline Bank exchanged(Bank bank, std::string_view from, std::string_view to) {
  if (alternative_to(to) != from || to == "string_wrap") return bank;
  if (from == "time_offset")
    bank.push_back(&candidate_of(to));
  else
    std::ranges::replace(bank, &candidate_of(from), &candidate_of(to));
  return bank;
}

/// How many explanations a fit is sure of.
inline std::ptrdiff_t explanations_of(const Fit& fit, const ActiveSet& set, const Bank& bank) {
  Diagnosis draft;
  draft.windows.resize(fit.systems.size());
  find(draft, fit, Evidence(fit), bank, set);
  const auto needed = [&](const Finding& f) { return f.sure && is_in(set, *f.candidate); };
  return std::ranges::count_if(draft.findings, needed) + (fit.at[index_of(Unknown::kWraps)] > 0.0 ? 1 : 0);
}

namespace diagnose_detail {

/// Whether the bank holds an alternative, or what it is one to.
inline bool is_known(std::string_view name, const Bank& bank) {
  return std::ranges::any_of(
      bank, [&](const Candidate* c) { return c->name == name || c->name == alternative_to(name); });
}

/// The fit of an alternative, with derivatives by its own unknowns. What it does not have stays at its
/// centre.
template <class D>
Fit refitted(Fit trial, const Alternative& other, const Model& base, int threads, const FitWatch& watch) {
  trial.delay = other.delay;
  trial.at = other.at;
  trial.centre[index_of(Unknown::kWraps)] = other.at[index_of(Unknown::kWraps)];
  for (int u = 0; u < kUnknowns; ++u)
    if (!other.set[u]) trial.at[u] = trial.centre[u];
  approach<D>(trial, base, other.set, kMostIterations, threads, watch);
  return trial;
}

/// Whether a fit is sure of the alternative that it was made for; nothing where it is none.
inline std::optional<bool> is_sure(const Fit& trial, const Alternative& other) {
  // A wrap is there to explain why the string is short: with one, its length must be right.
  if (other.name == "string_wrap" && std::abs(trial.at[index_of(Unknown::kStringLength)]) > kWrappedLength)
    return std::nullopt;
  const Candidate& young = candidate_of(other.name);
  if (!is_in(other.set, young)) return true;
  const Estimates now = estimates_of(Evidence(trial), other.set);
  const double z = significance(young, now);
  if (in_favour(young, z) < kMayBe) return std::nullopt;
  if (other.name != "wind") return speaks_for(young, z);
  const Candidate& drag = candidate_of("air_drag_quadratic");  // it acts in it
  return speaks_for(young, z) && speaks_for(drag, significance(drag, now));
}

}  // namespace diagnose_detail

/// Refits with each alternative to a claim and keeps the best: of those that are sure and explain it as well
/// as any, the one that needs the fewest; then a fault stays what it is, the others being rarer, and physics
/// is what leaves least. One that may be there and does as well is a tie, and so is one that would do as well
/// but for a single window. `draft` holds what is claimed before; `fit`, `bank` and `set` are moved to what
/// is best.
template <class D = diagnose_detail::FitDual>
std::vector<Replacement> exchange_claims(Fit& fit, Bank& bank, ActiveSet& set, const Diagnosis& draft,
                                         const Model& base, int threads, const FitWatch& watch) {
  using diagnose_detail::Explanation;
  std::vector<Replacement> result;
  const bool any = std::ranges::any_of(draft.findings, [&](const Finding& f) {
    return f.claimed && !alternatives_to(f.candidate->name, fit, set).empty();
  });
  fit.noise_is_known = true;  // from here on, so that costs can be compared
  Fit before = fit;
  if (any) {
    descend<D>(fit, base, set, kMostIterations, threads, watch);
    linearize<D>(fit, base, threads, watch);
  }
  for (const Finding& finding : draft.findings) {
    if (!finding.claimed || watch.is_enough()) continue;
    const std::string_view name = finding.candidate->name;
    const std::vector<Alternative> others = alternatives_to(name, fit, set);
    if (others.empty()) continue;
    std::vector<Explanation> options{{name, fit, set, explanations_of(fit, set, bank), true}};
    for (const Alternative& other : others) {
      if (!diagnose_detail::is_known(other.name, bank)) continue;
      Fit trial = diagnose_detail::refitted<D>(before, other, base, threads, watch);
      if (watch.is_enough()) return result;  // it may not have settled
      const std::optional<bool> sure = diagnose_detail::is_sure(trial, other);
      if (!sure) continue;
      linearize<D>(trial, base, threads, watch);
      const std::ptrdiff_t explanations =
          explanations_of(trial, other.set, exchanged(bank, name, other.name));
      diagnose_detail::add(options, {other.name, std::move(trial), other.set, explanations, *sure});
    }
    diagnose_detail::keep_the_good(options, name);
    const Explanation best = diagnose_detail::best_of(options, *finding.candidate);
    Replacement exchange{best.name, {}, std::sqrt(std::max(0.0, fit.cost - best.fit.cost) / fit.dispersion)};
    for (const Explanation& option : options)
      if (option.name != best.name) exchange.tied_with.emplace_back(option.name);
    bank = exchanged(std::move(bank), name, best.name);
    if (best.name != name) before = best.fit;
    fit = best.fit;
    set = best.set;
    result.push_back(std::move(exchange));
  }
  return result;
}

}  // namespace diabolo
