// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/time_budget.hpp"

namespace diabolo {

/// What a whole diagnosis costs for each window that it fits, in predictions of it with derivatives by all
/// unknowns: what all threads share, and what one does alone. (65 to 80 in all were measured, on shipped
/// recordings and on 20 minutes of play: python -m benchmarks.speed.long_takes.)
inline constexpr double kSharedPerWindow = 90.0, kAlonePerWindow = 10.0;

/// How long such a prediction may ever take [s].
inline constexpr double kLongestPrediction = 0.1;

/// Windows that are fitted however little time there is.
inline constexpr std::size_t kFewestFitted = 20;

/// Share of the time in which windows are chosen.
inline constexpr double kChoosingShare = 0.1;

/// What each window says of the unknowns before anything is fitted: the diagonal of its information.
template <class D = diagnose_detail::FitDual>
std::vector<UnknownVector> window_information(const Fit& fit, const Model& base, int threads,
                                              const Watch& watch = {}) {
  std::vector<UnknownVector> result(window_count(fit.fit_takes), UnknownVector::Zero());
  predict_windows<D>(fit, base, ActiveSet::Constant(true), threads, watch,
                     [&](std::size_t i, std::size_t fit_take, const WindowSystem& system) {
                       if (!system.failed)
                         result[i] = without_start(system, fit.noise[fit_take]).information.diagonal();
                     });
  return result;
}

namespace diagnose_detail {

/// For each unknown what three of four windows that say anything of it stay below. More counts as this: few
/// windows shall not decide alone.
inline UnknownVector usual_information(const std::vector<UnknownVector>& information) {
  constexpr double kLevel = 0.75;
  UnknownVector result = UnknownVector::Zero();
  for (int u = 0; u < kUnknowns; ++u) {
    std::vector<double> sizes;
    for (const UnknownVector& window : information)
      if (window[u] > 0.0 && std::isfinite(window[u])) sizes.push_back(window[u]);
    std::ranges::sort(sizes);
    if (!sizes.empty()) result[u] = quantile(sizes, kLevel);
  }
  return result;
}

}  // namespace diagnose_detail

/// So many windows stay together, one after the other: what comes and goes shows between neighbours.
inline constexpr std::size_t kInARow = 4;

/// Which `most` of the windows decide together, in order, or up to kInARow fewer: of every part of them the
/// neighbours that add most, in logarithms, to what those before say of each unknown. So all takes, times and
/// modes stay, and an unknown that few windows show gets these.
inline std::vector<std::size_t> windows_that_decide(const std::vector<UnknownVector>& information,
                                                    std::size_t most) {
  const std::size_t count = information.size(), row = most < count ? std::min(kInARow, most) : 1,
                    parts = std::min(most, count) / row;
  std::vector<std::size_t> result;
  const UnknownVector usual = diagnose_detail::usual_information(information);
  UnknownVector known = prior_precision().array() + 1.0;
  const auto says = [&](std::size_t first) {
    UnknownVector sum = UnknownVector::Zero();
    for (std::size_t i = first; i < first + row; ++i)
      if (information[i].allFinite()) sum += information[i].cwiseMin(usual).cwiseMax(0.0);
    return sum;
  };
  for (std::size_t part = 0; part < parts; ++part) {
    std::size_t best = part * count / parts;
    double most_gain = -1.0;
    for (std::size_t i = best; i + row <= (part + 1) * count / parts; ++i) {
      const double gain = (says(i).array() / known.array()).log1p().sum();
      if (gain > most_gain) most_gain = gain, best = i;
    }
    known += says(best);
    for (std::size_t i = best; i < best + row; ++i) result.push_back(i);
  }
  return result;
}

/// `most` windows evenly spread over so many.
inline std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < std::min(most, count); ++k)
    result.push_back((2 * k + 1) * count / (2 * std::min(most, count)));
  return result;
}

/// Keeps the windows of these numbers, which count take after take and ascend.
inline void keep_windows(std::vector<FitTake>& fit_takes, const std::vector<std::size_t>& kept) {
  std::size_t first = 0;
  auto next = kept.begin();
  for (FitTake& fit_take : fit_takes) {
    std::vector<FitWindow> windows;
    for (; next != kept.end() && *next < first + fit_take.windows.size(); ++next)
      windows.push_back(fit_take.windows[*next - first]);
    first += fit_take.windows.size();
    fit_take.windows = std::move(windows);
  }
}

/// Time that it takes to predict a window with derivatives by all unknowns [s], measured on a few.
template <class D>
double seconds_per_prediction(const Fit& fit, const Model& base, const TimeBudget& budget, int threads,
                              const Watch& watch) {
  constexpr std::size_t kFew = 12;
  Fit few = fit;
  keep_windows(few.fit_takes, evenly(window_count(fit.fit_takes), kFew));
  const double begin = budget.elapsed();
  window_information<D>(few, base, threads, watch);
  return (budget.elapsed() - begin) / static_cast<double>(window_count(few.fit_takes));
}

/// Thins the windows to kMostWindows, or to as many as there is time for. With time enough for all, and not
/// more of them, all stay.
template <class D = diagnose_detail::FitDual>
void thin(Fit& fit, const Model& base, int threads, TimeBudget& budget, const Watch& watch = {}) {
  const std::size_t count = window_count(fit.fit_takes);
  std::size_t candidates = count;
  const double per_window = kSharedPerWindow + kAlonePerWindow * static_cast<double>(thread_count(threads)),
               longest = per_window * kLongestPrediction * static_cast<double>(kMostWindows);
  if (budget.seconds() < longest && count > kFewestFitted) {
    const double each = seconds_per_prediction<D>(fit, base, budget, threads, watch),
                 left = (budget.seconds() - budget.elapsed()) / std::max(each, 1e-9);
    const auto windows = [&](double wanted, std::size_t least, std::size_t most) {
      return static_cast<std::size_t>(
          std::clamp(wanted, static_cast<double>(least), static_cast<double>(std::max(least, most))));
    };
    fit.most_windows = windows(left / per_window, kFewestFitted, kMostWindows);
    candidates = std::min(count, windows(kChoosingShare * left, fit.most_windows, count));
  }
  if (count <= fit.most_windows) return;
  if (fit.most_windows < kMostWindows)
    budget.leave("fitting more than " + std::to_string(fit.most_windows) + " of " + std::to_string(count) +
                 " windows");
  keep_windows(fit.fit_takes, evenly(count, candidates));
  keep_windows(fit.fit_takes,
               windows_that_decide(window_information<D>(fit, base, threads, watch), fit.most_windows));
}

}  // namespace diabolo
