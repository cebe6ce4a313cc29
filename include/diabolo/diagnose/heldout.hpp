// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/evidence.hpp"
#include "diabolo/diagnose/fitted_spring.hpp"
#include "diabolo/diagnose/folds.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/diagnose/residual_and_noise.hpp"
#include "diabolo/evaluate/horizon_score.hpp"

namespace diabolo {

/// A recording and the unknowns that others say it has, and that they would say without this or that claim.
struct HeldOutRecording {
  Recording recording;
  UnknownVector at;
  std::vector<UnknownVector> without;
  double unseen_spin = 0.0;  ///< of its starts, if it does not show any [rad/s]
};

/// The spin of a play in which nobody saw it [rad/s]: of the middle window that was fitted of such takes, or
/// of all where all show it.
inline double unseen_spin(const Fit& fit) {
  std::vector<double> unseen, all;
  for (const FitTake& fit_take : fit.fit_takes)
    for (const FitWindow& window : fit_take.windows) {
      all.push_back(window.start.spin);
      if (!has_spin(fit_take)) unseen.push_back(window.start.spin);
    }
  const std::vector<double>& spins = unseen.empty() ? all : unseen;
  return median_of(spins, 0.0);
}

/// Scaled unknowns in SI units, within their bounds, with those that are tried and never free.
inline UnknownVector within_bounds(const UnknownVector& scaled, const Fit& fit) {
  UnknownVector at = scaled.cwiseProduct(scales());
  for (const Unknown tried : kTriedUnknowns) at[index_of(tried)] = fit.at[index_of(tried)];
  for (int u = 0; u < kUnknowns; ++u) {
    const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(u)];
    at[u] = std::clamp(at[u], info.minimum, info.maximum);
  }
  return at.cwiseMax(diagnose_detail::least_values(at, fit.centre));
}

/// What is predicted without having been fitted: `holdout`, by all evidence; or, where that is empty, each
/// fold by the other folds' evidence. No window that touches a fold takes part; one without any is not asked.
/// Free are `free` and, for each claim in turn, a set of `without`.
inline std::vector<HeldOutRecording> leave_out(const Fit& fit, const Evidence& evidence,
                                               const ActiveSet& free, const std::vector<ActiveSet>& without,
                                               const std::vector<Recording>& holdout) {
  std::vector<HeldOutRecording> result;
  const auto add = [&](Recording recording, const std::vector<bool>& left_out) {
    result.push_back({std::move(recording),
                      within_bounds(evidence.solve_without(free, left_out), fit),
                      {},
                      unseen_spin(fit)});
    for (const ActiveSet& set : without)
      result.back().without.push_back(within_bounds(evidence.solve_without(set, left_out), fit));
  };
  std::vector<bool> nothing;
  for (const FitTake& fit_take : fit.fit_takes) nothing.resize(nothing.size() + fit_take.windows.size());
  for (const Recording& recording : holdout) {
    add(make_fit_take(recording).take->recording, nothing);
    result.back().at = fit.at;
  }
  if (!holdout.empty()) return result;
  for (const Fold& fold : folds_of(fit.fit_takes)) {
    const std::vector<bool> left_out = windows_in(fold, fit.fit_takes);
    if (std::ranges::count(left_out, false) < 4 || std::ranges::count(left_out, true) == 0) continue;
    add(cut(fit.fit_takes[fold.fit_take].take->recording, fold.first, fold.last), left_out);
  }
  return result;
}

/// Starts on what was held out for each window that may be fitted, and least time between them [s].
inline constexpr double kStartsPerWindow = 2.5, kStartsEvery = 0.2;

/// Time between the starts [s] on recordings that were held out: there are not more than belong to so many
/// windows.
inline double starts_every(const std::vector<HeldOutRecording>& recordings, std::size_t most_windows) {
  double seconds = 0.0;
  for (const HeldOutRecording& held : recordings)
    seconds += held.recording.time[held.recording.size() - 1] - held.recording.time[0];
  return std::max(kStartsEvery, seconds / (kStartsPerWindow * static_cast<double>(most_windows)));
}

/// Predictions over less than so long say little of a slight force or torque [s].
inline constexpr double kAhead = 0.5;

/// So many neighbouring starts count as one where noise alone is asked about: it is that of the start, which
/// is made from a tenth of a second, and of the tips, which neighbours share.
inline constexpr std::size_t kStartsAlike = 2;

/// Without a claim or with it, by the base or with what was found, an error counts no more than so many times
/// that of the middle start, of the two whichever is larger: a missed catch says nothing of the forces.
inline constexpr double kFarAhead = 3.0;

namespace diagnose_detail {

/// What predictions from the same starts are wrong by without something, and with it; infinite where one
/// diverged.
struct WithoutAndWith {
  std::vector<double> without, with;

  void add(double of_without, double of_with) {
    without.push_back(of_without);
    with.push_back(of_with);
  }
  /// Those of which neither diverged.
  WithoutAndWith predicted() const {
    WithoutAndWith result;
    for (std::size_t i = 0; i < with.size(); ++i)
      if (std::isfinite(without[i] + with[i])) result.add(without[i], with[i]);
    return result;
  }
  /// More without it, see kFarAhead.
  std::vector<double> losses() const {
    if (with.empty()) return {};
    const double most = kFarAhead * std::max(median_of(without, 0.0), median_of(with, 0.0));
    std::vector<double> result;
    for (std::size_t i = 0; i < with.size(); ++i)
      result.push_back(std::min(without[i], most) - std::min(with[i], most));
    return result;
  }
};

/// What predictions are wrong by at one horizon, a number for each start.
struct Errors {
  WithoutAndWith found;                ///< by the base, and with what was found
  std::vector<double> start;           ///< what the start's noise alone makes
  std::vector<WithoutAndWith> claims;  ///< each in its turn
  Compared compared;                   ///< with the noise of the start, where it is known
};

struct ErrorsAhead {
  Errors position, spin;
};

inline bool both_comparable(const WindowError& a, const WindowError& b) {
  return a.comparable && b.comparable;
}

inline bool both_predicted(const WindowError& a, const WindowError& b) {
  return both_comparable(a, b) && !a.failed && !b.failed;
}

/// Distance of a prediction from a recording whose lengths are so many times too long [m].
inline double distance_of(const WindowError& error, double scale = 1.0) {
  return error.failed ? std::numeric_limits<double>::infinity() : scale * error.model;
}

/// For each start of a task, its errors at all horizons.
inline std::vector<std::vector<WindowError>> errors_of(const HorizonTask& task, int threads,
                                                       const Watch& watch) {
  std::vector<std::vector<WindowError>> errors(task.size());
  for_each_index(task.size(), threads, watch, [&](std::size_t i) { errors[i] = task.errors(i); });
  return errors;
}

/// Adds what one recording's predictions are wrong by to each horizon's errors.
inline void add_errors(const HeldOutRecording& held, const Model& base, const Model& physics,
                       HorizonOptions options, std::uint64_t seed, const Watch& watch,
                       std::vector<ErrorsAhead>& ahead) {
  options.unseen_spin = held.unseen_spin;
  const auto task_at = [&](const UnknownVector& at) {
    return HorizonTask(corrected(held.recording, at), augmented_model(physics, at, "augmented"), options);
  };
  const Recording seen = corrected(held.recording, held.at);
  const HorizonTask better(seen, augmented_model(physics, held.at, "augmented"), options);
  const std::vector<std::vector<WindowError>> with = errors_of(better, options.threads, watch),
                                              without = errors_of(HorizonTask(held.recording, base, options),
                                                                  options.threads, watch);
  assert(with.size() == without.size());  // windows depend on times and dropouts, which corrected() leaves
  const auto scale_of = [](const UnknownVector& at) { return 1.0 + at[index_of(Unknown::kLengthScale)]; };
  const double scale = scale_of(held.at);
  const StartNoise noise = start_noise(seen);
  std::vector<std::vector<StartScatter>> scatter(with.size());
  for_each_index(with.size(), options.threads, watch,
                 [&](std::size_t i) { scatter[i] = better.scatter(i, noise, seed); });
  for (std::size_t i = 0; i < with.size(); ++i)
    for (std::size_t h = 0; h < ahead.size(); ++h) {
      const WindowError &a = without[i][h], &b = with[i][h];
      if (!both_comparable(a, b)) continue;
      ahead[h].position.found.add(distance_of(a), distance_of(b, scale));
      if (a.failed || b.failed) continue;
      if (std::isfinite(a.spin) && std::isfinite(b.spin)) ahead[h].spin.found.add(a.spin, b.spin);
      if (const double noise_of_spin = std::hypot(better.spin_noise(i), scatter[i][h].spin);
          std::isfinite(b.spin) && std::isfinite(noise_of_spin)) {
        ahead[h].spin.start.push_back(noise_of_spin);
        if (std::isfinite(a.spin)) ahead[h].spin.compared.add(a.spin, b.spin, noise_of_spin);
      }
      const double noise_of_position = scale * scatter[i][h].position;
      if (!std::isfinite(noise_of_position)) continue;
      ahead[h].position.start.push_back(noise_of_position);
      ahead[h].position.compared.add(distance_of(a), distance_of(b, scale), noise_of_position);
    }
  for (std::size_t c = 0; c < held.without.size(); ++c) {
    const std::vector<std::vector<WindowError>> poorer =
        errors_of(task_at(held.without[c]), options.threads, watch);
    for (std::size_t i = 0; i < with.size(); ++i)
      for (std::size_t h = 0; h < ahead.size(); ++h) {
        const WindowError &a = poorer[i][h], &b = with[i][h];
        if (!both_comparable(a, b)) continue;
        ahead[h].position.claims[c].add(distance_of(a, scale_of(held.without[c])), distance_of(b, scale));
        if (a.failed || b.failed) continue;
        if (std::isfinite(a.spin) && std::isfinite(b.spin)) ahead[h].spin.claims[c].add(a.spin, b.spin);
      }
  }
}

inline std::optional<double> mean_if_any(const std::vector<double>& errors) {
  return errors.empty() ? std::nullopt : std::optional(mean_of(errors));
}

/// Takes down one horizon's errors; `interval_of` is that of a mean.
template <class IntervalOf>
void add_horizon(const Errors& errors, ErrorsByHorizon& result, const IntervalOf& interval_of) {
  const WithoutAndWith found = errors.found.predicted();
  result.base_error.push_back(mean_if_any(found.without));
  result.augmented_error.push_back(mean_if_any(found.with));
  result.start_error.push_back(mean_if_any(errors.start));
  result.improvement_ci95.push_back(interval_of(errors.found.losses()));
  result.worsening_ci95.resize(errors.claims.size());
  for (std::size_t c = 0; c < errors.claims.size(); ++c)
    result.worsening_ci95[c].push_back(interval_of(errors.claims[c].losses()));
}

}  // namespace diagnose_detail

/// Predicts each recording from fair starts, by the base and by `physics` with its unknowns.
inline HeldOut compare_held_out(const std::vector<HeldOutRecording>& recordings, const Model& base,
                                const Model& physics, std::uint64_t seed, std::size_t most_windows,
                                int threads, const Watch& watch = {}) {
  HeldOut result;
  HorizonOptions options;
  options.starts_every = starts_every(recordings, most_windows);
  options.horizons = result.horizons;
  options.threads = threads;
  const std::size_t claims = recordings.empty() ? 0 : recordings.front().without.size();
  std::vector<diagnose_detail::ErrorsAhead> ahead(options.horizons.size());
  for (diagnose_detail::ErrorsAhead& errors : ahead) {
    errors.position.claims.resize(claims);
    errors.spin.claims.resize(claims);
  }
  for (const HeldOutRecording& held : recordings)
    diagnose_detail::add_errors(held, base, physics, options, seed, watch, ahead);

  std::mt19937_64 generator(seed);
  for (std::size_t h = 0; h < ahead.size(); ++h) {
    const double horizon = options.horizons[h];
    const auto interval_of = [&](const std::vector<double>& differences) {
      const std::size_t overlap = 1 + static_cast<std::size_t>(std::ceil(horizon / options.starts_every));
      const std::optional<ErrorSummary> summary = summarize(differences, overlap, generator);
      return summary ? std::optional(summary->mean_ci95) : std::nullopt;
    };
    diagnose_detail::ErrorsAhead& errors = ahead[h];
    result.windows = std::max(result.windows, errors.position.found.with.size());
    diagnose_detail::add_horizon(errors.position, result.position, interval_of);
    diagnose_detail::add_horizon(errors.spin, result.spin, interval_of);
    const std::vector<double> distances = errors.position.found.predicted().with;
    result.augmented_median.push_back(distances.empty() ? std::nullopt : std::optional(median_of(distances)));
    if (horizon < kAhead) continue;
    const auto tell = [&](const diagnose_detail::Errors& of, const char* quantity, const char* unit,
                          double immaterial) {
      auto left = diagnose_detail::residual_and_noise_of(of.compared, immaterial, kStartsAlike);
      if (!left) return;
      left->quantity = quantity;
      left->unit = unit;
      left->ahead_s = horizon;
      result.ahead.push_back(*left);
    };
    tell(errors.position, "position", "m", kImmaterialAhead);
    tell(errors.spin, "spin", "rad/s", kImmaterialSpinAhead);
  }
  return result;
}

}  // namespace diabolo
