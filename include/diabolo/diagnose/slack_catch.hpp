// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/catch_rule.hpp"
#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/significance.hpp"
#include "diabolo/diagnose/time_budget.hpp"

namespace diabolo {

namespace diagnose_detail {

/// The recordings of a fit, predicted from many starts by models that differ in their catch alone.
class CatchTrials {
 public:
  CatchTrials(const Fit& fit, const Model& physics, int threads, const FitWatch& watch)
      : model_(augmented_model(physics, fit.at, "")), threads_(threads), watch_(watch) {
    for (const FitTake& fit_take : fit.fit_takes)
      recordings_.push_back({corrected(fit_take.take->recording, fit.at), fit.at, {}, {}});
    options_.unseen_spin = unseen_spin(fit);
    options_.starts_every = starts_every(recordings_, fit.most_windows);
    options_.horizons = {0.25, 0.5, 1.0};
  }

  HorizonTask task(const HeldOutRecording& held, double slack) const {
    Model model = model_;
    model.parameters.catch_slack = slack;
    return {held.recording, model, options_};
  }

  double longest_string() const {
    double length = 0.0;
    for (const HeldOutRecording& held : recordings_)
      length = std::max(length, parameters_for(model_, held.recording).string_length);
    return length;
  }

  /// Each start's errors, recording after recording.
  using Errors = std::vector<std::vector<WindowError>>;
  Errors errors(double slack) const {
    Errors result;
    for (const HeldOutRecording& held : recordings_)
      std::ranges::move(errors_of(task(held, slack), threads_, watch_), std::back_inserter(result));
    return result;
  }

  /// The same by a slack between two others. A start from which these predict alike has the same catches by
  /// every slack between them, and is not asked again.
  Errors errors_between(double slack, const Errors& narrower, const Errors& wider) const {
    const auto alike = [](const WindowError& a, const WindowError& b) {
      return a.model == b.model && a.failed == b.failed;
    };
    Errors result = wider;
    std::size_t before = 0;
    for (const HeldOutRecording& held : recordings_) {
      const HorizonTask starts = task(held, slack);
      std::vector<std::size_t> asked;
      for (std::size_t i = 0; i < starts.size(); ++i)
        if (!std::ranges::equal(narrower[before + i], wider[before + i], alike)) asked.push_back(i);
      for_each_index(asked.size(), threads_, watch_,
                     [&](std::size_t k) { result[before + asked[k]] = starts.errors(asked[k]); });
      before += starts.size();
    }
    return result;
  }

  /// What the noise of each start alone makes at each horizon.
  std::vector<std::vector<StartScatter>> scatter(double slack, std::uint64_t seed) const {
    std::vector<std::vector<StartScatter>> result;
    for (const HeldOutRecording& held : recordings_) {
      const HorizonTask starts = task(held, slack);
      const StartNoise noise = start_noise(held.recording);
      std::vector<std::vector<StartScatter>> some(starts.size());
      for_each_index(some.size(), threads_, watch_,
                     [&](std::size_t i) { some[i] = starts.scatter(i, noise, seed); });
      std::ranges::move(some, std::back_inserter(result));
    }
    return result;
  }

 private:
  Model model_;
  std::vector<HeldOutRecording> recordings_;
  HorizonOptions options_;
  int threads_;
  const FitWatch& watch_;
};

/// The last horizon at which a start was predicted both ways; none where there is none.
inline std::optional<std::size_t> last_horizon(const std::vector<WindowError>& a,
                                               const std::vector<WindowError>& b) {
  for (std::size_t h = a.size(); h-- > 0;)
    if (both_predicted(a[h], b[h])) return h;
  return std::nullopt;
}

/// Mean error of `some` where it can be set beside `others` [m].
inline double mean_beside(const std::vector<std::vector<WindowError>>& some,
                          const std::vector<std::vector<WindowError>>& others) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < some.size(); ++i)
    if (const std::optional<std::size_t> h = last_horizon(some[i], others[i]))
      errors.push_back(some[i][*h].model);
  return errors.empty() ? std::numeric_limits<double>::infinity() : mean_of(errors);
}

}  // namespace diagnose_detail

/// Whether the rule for a catch is too strict: the paper's wants tips nearly a string length apart, where
/// hands that give way catch with a string that hangs slack. No derivative tells, since a missed catch stays
/// missed at any slight change; so a few values are tried, from the string's length, which lets any slack
/// string catch, by halves. A start speaks for or against where errors differ by kStrong times what its noise
/// makes. None where not more starts speak for than against, or time is up; else of the values that predict
/// as well as any, the widest. The errors are of recordings that were fitted, with all that was found until
/// now.
inline std::optional<CatchRule> slack_catch(const Fit& fit, const Model& physics, std::uint64_t seed,
                                            int threads, const FitWatch& watch = {}) {
  namespace detail = diagnose_detail;
  constexpr double kAsWell = 1.01, kNarrowest = 0.02;  // [1], [m]
  const detail::CatchTrials trials(fit, physics, threads, watch);
  const double given = physics.parameters.catch_slack, length = trials.longest_string();
  const auto by_given = trials.errors(given), by_widest = trials.errors(length);
  CatchRule found{length, detail::mean_beside(by_given, by_widest), detail::mean_beside(by_widest, by_given)};
  auto best = by_widest;
  for (double slack = 0.5 * length; slack > std::max(given, kNarrowest) && !watch.is_enough(); slack *= 0.5) {
    auto errors = trials.errors_between(slack, by_given, by_widest);
    const double mean = detail::mean_beside(errors, by_given);
    if (kAsWell * mean >= found.error_after_m) continue;
    found.catch_slack_m = slack;
    found.error_after_m = mean;
    best = std::move(errors);
  }
  if (!(found.error_after_m < found.error_before_m) || watch.is_enough()) return std::nullopt;
  const auto scatter = trials.scatter(found.catch_slack_m, seed);
  for (std::size_t i = 0; i < best.size(); ++i) {
    const std::optional<std::size_t> h = detail::last_horizon(by_given[i], best[i]);
    if (!h) continue;
    const double gain = by_given[i][*h].model - best[i][*h].model, enough = kStrong * scatter[i][*h].position;
    found.starts_for += gain > enough ? 1 : 0;
    found.starts_against += -gain > enough ? 1 : 0;
  }
  return found.starts_for > found.starts_against ? std::optional(found) : std::nullopt;
}

}  // namespace diabolo
