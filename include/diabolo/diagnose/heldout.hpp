// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/evidence.hpp"
#include "diabolo/diagnose/left_over.hpp"
#include "diabolo/evaluate/horizon_score.hpp"

namespace diabolo {

/// Rows of a recording that a model is fitted without.
struct Fold {
  std::size_t fit_take;
  Eigen::Index first, last;
};

/// Whole recordings where there are several; else three blocks of the only one.
inline std::vector<Fold> folds_of(const std::vector<FitTake>& fit_takes) {
  constexpr Eigen::Index kBlocks = 3;
  std::vector<Fold> folds;
  for (std::size_t s = 0; s < fit_takes.size(); ++s) {
    const Eigen::Index size = fit_takes[s].take->recording.size(),
                       blocks = fit_takes.size() > 1 ? 1 : kBlocks;
    for (Eigen::Index b = 0; b < blocks; ++b)
      folds.push_back({s, size * b / blocks, size * (b + 1) / blocks - 1});
  }
  return folds;
}

/// A recording and the unknowns that others say it has, and that they would say without this or that claim.
struct HeldOutRecording {
  Recording recording;
  UnknownVector at;
  std::vector<UnknownVector> without;
};

/// Scaled unknowns in SI units, within their bounds, with the wraps that are tried and never free.
inline UnknownVector within_bounds(const UnknownVector& scaled, const Fit& fit) {
  UnknownVector at = scaled.cwiseProduct(scales());
  at[index_of(Unknown::kWraps)] = fit.at[index_of(Unknown::kWraps)];
  for (int u = 0; u < kUnknowns; ++u) {
    const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(u)];
    at[u] = std::clamp(at[u], info.minimum, info.maximum);
  }
  return at;
}

/// What is predicted without having been fitted: `holdout`, by all evidence; or, where that is empty, each
/// fold by the other folds' evidence. No window that touches a fold takes part. Free are `free` and, for each
/// claim in turn, a set of `without`.
inline std::vector<HeldOutRecording> leave_out(const Fit& fit, const Evidence& evidence,
                                               const ActiveSet& free, const std::vector<ActiveSet>& without,
                                               const std::vector<Recording>& holdout) {
  std::vector<HeldOutRecording> result;
  const auto add = [&](Recording recording, const std::vector<bool>& left_out) {
    result.push_back({std::move(recording), within_bounds(evidence.solve_without(free, left_out), fit), {}});
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
    std::vector<bool> left_out;
    for (std::size_t s = 0; s < fit.fit_takes.size(); ++s)
      for (const FitWindow& window : fit.fit_takes[s].windows)
        left_out.push_back(s == fold.fit_take && window.first <= fold.last && window.last >= fold.first);
    if (std::ranges::count(left_out, false) < 4) continue;
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

/// Predictions over less than so long say little of a slight force [s].
inline constexpr double kAhead = 0.5;

/// An error that matters to nobody at any horizon [m].
inline constexpr double kImmaterialAhead = 1e-3;

/// So many neighbouring starts count as one where noise alone is asked about: it is that of the start, which
/// is made from a tenth of a second, and of the tips, which neighbours share.
inline constexpr std::size_t kStartsAlike = 2;

/// Predicts each recording from fair starts, by the base and by `physics` with its unknowns.
inline HeldOut compare_held_out(const std::vector<HeldOutRecording>& recordings, const Model& base,
                                const Model& physics, std::uint64_t seed, std::size_t most_windows,
                                int threads, const Watch& watch = {}) {
  HeldOut result;
  HorizonOptions options;
  options.starts_every = starts_every(recordings, most_windows);
  options.horizons = result.horizons;
  options.threads = threads;
  const std::size_t horizons = options.horizons.size();
  std::vector<std::vector<double>> base_errors(horizons), augmented_errors(horizons), gains(horizons),
      start_errors(horizons);
  std::vector<diagnose_detail::Compared> compared(horizons);
  const std::size_t claims = recordings.empty() ? 0 : recordings.front().without.size();
  std::vector<std::vector<std::vector<double>>> losses(claims, std::vector<std::vector<double>>(horizons));
  for (const HeldOutRecording& held : recordings) {
    const HorizonTask plain(held.recording, base, options);
    const HorizonTask better(corrected(held.recording, held.at),
                             augmented_model(physics, held.at, "augmented"), options);
    const std::size_t count = plain.size();
    assert(better.size() == count);  // windows depend on times and dropouts, which corrected() leaves
    const StartNoise noise = start_noise(held.recording);
    std::vector<std::vector<WindowError>> without(count), with(count);
    std::vector<std::vector<double>> scatter(count);
    for_each_index(count, threads, watch, [&](std::size_t i) {
      without[i] = plain.errors(i);
      with[i] = better.errors(i);
      scatter[i] = better.scatter(i, noise, seed);
    });
    for (std::size_t c = 0; c < claims; ++c) {
      const UnknownVector& at = held.without[c];
      const HorizonTask poorer(corrected(held.recording, at), augmented_model(physics, at, "poorer"),
                               options);
      std::vector<std::vector<WindowError>> errors(count);
      for_each_index(count, threads, watch, [&](std::size_t i) { errors[i] = poorer.errors(i); });
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t h = 0; h < horizons; ++h)
          if (const WindowError& a = errors[i][h], &b = with[i][h];
              a.comparable && b.comparable && !a.failed && !b.failed)
            losses[c][h].push_back(a.model - b.model);
    }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t h = 0; h < horizons; ++h) {
        const WindowError &a = without[i][h], &b = with[i][h];
        if (!a.comparable || !b.comparable || a.failed || b.failed) continue;
        base_errors[h].push_back(a.model);
        augmented_errors[h].push_back(b.model);
        gains[h].push_back(a.model - b.model);
        if (!std::isfinite(scatter[i][h])) continue;
        start_errors[h].push_back(scatter[i][h]);
        compared[h].add(a.model, b.model, scatter[i][h]);
      }
  }
  std::mt19937_64 generator(seed);
  const auto interval_of = [&](const std::vector<double>& differences, std::size_t h) {
    const std::size_t overlap =
        1 + static_cast<std::size_t>(std::ceil(options.horizons[h] / options.starts_every));
    const std::optional<ErrorSummary> summary = summarize(differences, overlap, generator);
    return summary ? std::optional(summary->mean_ci95) : std::nullopt;
  };
  for (std::size_t h = 0; h < horizons; ++h) {
    const bool any = !gains[h].empty();
    result.windows = std::max(result.windows, gains[h].size());
    result.base_error.push_back(any ? std::optional(mean_of(base_errors[h])) : std::nullopt);
    result.augmented_error.push_back(any ? std::optional(mean_of(augmented_errors[h])) : std::nullopt);
    std::ranges::sort(augmented_errors[h]);
    result.augmented_median.push_back(any ? std::optional(quantile(augmented_errors[h], 0.5)) : std::nullopt);
    result.start_error.push_back(start_errors[h].empty() ? std::nullopt
                                                         : std::optional(mean_of(start_errors[h])));
    result.improvement_ci95.push_back(interval_of(gains[h], h));
    if (options.horizons[h] < kAhead) continue;
    std::optional<LeftOver> left = diagnose_detail::left_over_of(compared[h], kImmaterialAhead, kStartsAlike);
    if (!left) continue;
    left->quantity = "position";
    left->unit = "m";
    left->ahead_s = options.horizons[h];
    result.ahead.push_back(*left);
  }
  for (const auto& claim : losses) {
    result.worsening_ci95.emplace_back();
    for (std::size_t h = 0; h < horizons; ++h)
      result.worsening_ci95.back().push_back(interval_of(claim[h], h));
  }
  return result;
}

}  // namespace diabolo
