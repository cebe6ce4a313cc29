// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/alternatives.hpp"
#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/experiments.hpp"
#include "diabolo/diagnose/refine.hpp"

namespace diabolo {

/// Odds beyond which nobody asks further.
inline constexpr double kLongOdds = 1e6;

namespace diagnose_detail {

/// Whether it lies a string's length below the lower tip, or nowhere.
inline bool is_dropped(const Recording& r) {
  const auto lower = r.left.position.row(2).cwiseMin(r.right.position.row(2)).array() - r.string_length;
  return !(r.diabolo.position.row(2).array() > lower).all();
}

/// What is left of a motion that a perfect camera sees where `truth` holds, once an explanation is fitted to
/// it alone, in units of twice the logarithm of odds; NaN where the diabolo is dropped. The noise is that of
/// the camera which saw the tie.
template <class D>
double left_of(const Experiment& experiment, const Model& truth, const Alternative& explanation,
               const Fit& seen, const Model& physics, int threads, const FitWatch& watch) {
  Fit fit;
  Recording like = seen.fit_takes.front().take->recording;
  like.string_length += seen.at[index_of(Unknown::kStringLength)];
  for (const MotionPart& part : experiment.parts) {
    const Recording recording = imagined(part, truth, like);
    if (is_dropped(recording)) return kNaN;
    fit.fit_takes.push_back(make_fit_take(recording));
    fit.noise.push_back(seen.noise.front());
  }
  fit.centre = fit.at = seen.centre;
  for (int u = 0; u < kUnknowns; ++u) {
    const bool of_measurement = u >= index_of(Unknown::kLengthScale) && u < index_of(Unknown::kStringLength);
    if (explanation.set[u] && !of_measurement) fit.at[u] = explanation.at[u];
  }
  fit.at[index_of(Unknown::kStringLength)] -= seen.at[index_of(Unknown::kStringLength)];
  for (const Unknown tried : kTriedUnknowns)
    fit.centre[index_of(tried)] = fit.at[index_of(tried)] = explanation.at[index_of(tried)];
  fit.noise_is_known = true;
  constexpr int kIterations = 4;
  approach<D>(fit, physics, explanation.set, kIterations, threads, watch);
  return fit.cost / std::max(seen.dispersion, fit.dispersion);
}

/// What is tied with a claim, as something to fit; nothing where that cannot be told.
inline std::optional<Alternative> alternative_of(std::string_view claim, std::string_view other,
                                                 const Fit& fit, const ActiveSet& set) {
  const std::vector<Alternative> known = alternatives_to(claim, fit, set);
  const auto own = std::ranges::find(known, other, &Alternative::name);
  if (own != known.end()) return *own;
  const auto known_by_name = [](std::string_view name) {
    return std::ranges::find(candidates(), name, &Candidate::name) != candidates().end();
  };
  if (other == "string_wrap" || !known_by_name(claim) || !known_by_name(other)) return std::nullopt;
  Alternative result{other, fit.delay, in_place_of(candidate_of(claim), candidate_of(other), set), {}};
  result.at = within_bounds(Evidence(fit).solve(result.set), fit);
  return result;
}

/// Delays, scales and rates are of the measurement, which a perfect camera does not have.
inline std::string_view motion_for_measurement(std::string_view name) {
  if (name == "length_scale" || name == "frame_rate") return "high_throws";
  return name == "time_offset" || name == "filter_lag" || name == "robot_servo_lag" ? "fast_beats" : "";
}

}  // namespace diagnose_detail

/// For each tie the motion that parts it best, and the odds against the wrong explanation that it would give
/// by itself: the motion is simulated with the claim and fitted with what is tied with it; of a fault, which
/// a perfect camera does not have, with the first physics that is tied with it, and fitted without. Of
/// delays, scales and rates without odds.
template <class D = diagnose_detail::FitDual>
std::vector<Proposal> next_experiments(const Diagnosis& d, const Fit& fit, const Model& physics,
                                       const ActiveSet& set, int threads, const FitWatch& watch = {}) {
  std::vector<Proposal> result;
  for (const Finding& f : d.findings) {
    if (!f.claimed || f.tied_with.empty()) continue;
    Proposal best{nullptr, f.tied_with, std::nullopt};
    best.parts.insert(best.parts.begin(), std::string(f.candidate->name));
    const std::string_view fixed = diagnose_detail::motion_for_measurement(f.candidate->name);
    if (!fixed.empty()) {
      best.experiment = &*std::ranges::find(experiments(), fixed, &Experiment::motion);
    } else {
      Alternative claim{f.candidate->name, fit.delay, set, fit.at};
      std::vector<Alternative> others;
      for (const std::string& name : f.tied_with)
        if (const auto other = diagnose_detail::alternative_of(f.candidate->name, name, fit, set))
          others.push_back(*other);
      if (others.empty()) continue;
      if (f.candidate->kind == CandidateKind::kMeasurement) {
        others.resize(1, claim);
        std::swap(claim, others.front());
      }
      const Model truth = augmented_model(physics, claim.at, "truth");
      for (const Experiment& experiment : experiments()) {
        const double own =
            diagnose_detail::left_of<D>(experiment, truth, claim, fit, physics, threads, watch);
        double odds = kLongOdds;
        for (const Alternative& other : others) {
          const double more =
              diagnose_detail::left_of<D>(experiment, truth, other, fit, physics, threads, watch) - own;
          odds = std::min(odds, std::isfinite(more) ? std::exp(std::max(0.5 * more, 0.0)) : 1.0);
        }
        if (!best.odds || odds > *best.odds) best.experiment = &experiment, best.odds = odds;
        if (*best.odds == kLongOdds) break;
      }
    }
    if (watch.is_enough()) return result;
    result.push_back(std::move(best));
  }
  return result;
}

}  // namespace diabolo
