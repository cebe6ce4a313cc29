// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/residual_window.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/math/parallel.hpp"

namespace diabolo {

/// A residual that was fitted, and what it does to predictions of what it was not fitted to.
struct ResidualFit {
  Model model;              ///< the base, with the residual where it stands
  bool stands = false;      ///< whether predictions get better by more than kImmaterialAhead, for sure
  double usual = 0.0;       ///< the size that weights were expected to have [m/s^2]
  std::size_t windows = 0;  ///< predictions of kAhead that were compared
  double base_error = 0.0, error = 0.0;  ///< median errors without it and with it [m]
  std::optional<Interval> gain_ci95{};   ///< of the mean by which it takes errors off [m]
};

namespace diagnose_detail {

/// So many neighbouring starts depend on each other: those of two seconds. (Recordings differ in their gains,
/// which is no dependence within them.)
inline constexpr std::size_t kResidualAlike = 10;

/// Sizes of weights that are tried [m/s^2].
inline constexpr std::array<double, 4> kResidualSizes{0.01, 0.03, 0.1, 0.3};

/// Windows and folds of recordings, and what is fitted to them. Folds are fitted with the ranges of all: of
/// those nothing is known but where the diabolo was.
class ResidualProblem {
 public:
  ResidualProblem(const std::vector<Recording>& recordings, Model base, int threads, const Watch& watch)
      : base_(std::move(base)), threads_(threads), watch_(watch) {
    base_.effects.get<ResidualForce>() = {};
    for (const Recording& recording : recordings) fit_takes_.push_back(make_fit_take(recording));
    for (std::size_t s = 0; s < fit_takes_.size(); ++s)
      for (std::size_t w = 0; w < fit_takes_[s].windows.size(); ++w) windows_.emplace_back(s, w);
    find_scenes();
    at_rest_ = linearized(begin_);
    std::vector<double> sizes;
    for (const ResidualWindow& window : at_rest_)
      if (window.numbers > 0) sizes.push_back(window.size());
    scatter_ = std::max(median_of(std::move(sizes), 0.0), kSeenWithin);
  }

  const Model& base() const { return base_; }
  const std::vector<FitTake>& fit_takes() const { return fit_takes_; }

  /// The law that the windows which are not left out ask for, by Gauss's and Newton's method.
  ResidualLaw fit(double usual, const std::vector<bool>& left_out) const {
    ResidualLaw law = step(begin_, at_rest_, usual, left_out);
    law = step(law, linearized(law), usual, left_out);
    hold(law);
    return law;
  }

  Model with(const ResidualLaw& law) const {
    Model model = base_;
    model.effects.get<ResidualForce>() = ResidualForce<double>(law);
    return model;
  }

 private:
  struct Seen {
    ResidualScene<double> scene;
    State<double> state;
    Tips<double> tips;
    Parameters<double> parameters;
  };

  /// Where the diabolo is in all windows; the ranges leave out a hundredth at either end.
  void find_scenes() {
    for (const auto& [s, w] : windows_) {
      const Take& take = *fit_takes_[s].take;
      const FitWindow& window = fit_takes_[s].windows[w];
      const FullPredictor<double> predictor = predictor_for(base_, take.recording);
      State<double> begun = residual_start(take, window);
      play_window(take, window, *take.motion, predictor, begun,
                  [&](Eigen::Index, const State<double>& state, const Tips<double>& tips) {
                    const Parameters<double>& parameters = predictor.parameters();
                    seen_.push_back({residual_scene(state, tips, parameters), state, tips, parameters});
                  });
    }
    for (const bool taut : {true, false}) {
      ResidualPart& part = taut ? begin_.on_string : begin_.off_string;
      for (std::size_t i = 0; i < kResidualInputs; ++i) {
        std::vector<double> inputs;
        for (const Seen& seen : seen_)
          if ((seen.state.string_state == StringState::kOnString) == taut)
            inputs.push_back(seen.scene.inputs[i]);
        std::ranges::sort(inputs);
        if (inputs.empty()) continue;
        part.low[i] = quantile(inputs, 0.01);
        part.high[i] = quantile(inputs, 0.99);
      }
    }
  }

  std::vector<ResidualWindow> linearized(const ResidualLaw& law) const {
    std::vector<ResidualWindow> result(windows_.size());
    for_each_index(windows_.size(), threads_, watch_, [&](std::size_t i) {
      const FitTake& fit_take = fit_takes_[windows_[i].first];
      result[i] = residual_window(*fit_take.take, fit_take.windows[windows_[i].second], base_, law);
    });
    return result;
  }

  /// A step of ridge regression; windows that are far off, such as by a catch, count less.
  ResidualLaw step(ResidualLaw law, const std::vector<ResidualWindow>& systems, double usual,
                   const std::vector<bool>& left_out) const {
    constexpr double kFar = 3.0;
    constexpr int n = ResidualWindow::kWeights;
    Eigen::VectorXd at(n);
    for (int i = 0; i < n; ++i) at[i] = residual_weight(law, i);
    const double ridge = std::pow(scatter_ / usual, 2);
    Eigen::MatrixXd information = ridge * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd score = -ridge * at;
    for (std::size_t i = 0; i < systems.size(); ++i) {
      if (left_out[i]) continue;
      const double weight = std::min(1.0, std::pow(kFar * scatter_ / std::max(systems[i].size(), 1e-9), 4));
      information += weight * systems[i].information;
      score += weight * systems[i].score;
    }
    at += solve_symmetric(information, score).col(0);
    for (int i = 0; i < n; ++i)
      residual_weight(law, i) = std::clamp(at[i], -ResidualLaw::kMost, ResidualLaw::kMost);
    return law;
  }

  /// Bounds its size and its work by the most that it does where it was learnt.
  void hold(ResidualLaw& law) const {
    const ResidualForce<double> force(law);
    double largest = ResidualLaw::kLargest.minimum, power = 0.0;
    for (const Seen& seen : seen_) {
      const Vector3<double> push = force.acceleration(seen.state, seen.tips, 1.0, seen.parameters);
      largest = std::max(largest, norm(push));
      power = std::max(power, push.dot(seen.state.velocity));
    }
    law.largest = std::min(largest, ResidualLaw::kLargest.maximum);
    law.power = std::min(power, ResidualLaw::kPower.maximum);
  }

  Model base_;
  int threads_;
  const Watch& watch_;
  std::vector<FitTake> fit_takes_;
  std::vector<std::pair<std::size_t, std::size_t>> windows_;  ///< take, and number in it
  std::vector<Seen> seen_;
  ResidualLaw begin_;                    ///< no weights
  std::vector<ResidualWindow> at_rest_;  ///< linearised there
  double scatter_ = kSeenWithin;         ///< what the middle window leaves [m]
};

/// Errors on what was held out, start by start [m].
struct ResidualErrors {
  std::vector<double> base, with, gain;
  double least_gain = INFINITY;  ///< smallest of the folds' medians
};

/// Fits without each fold in turn, and predicts it.
inline ResidualErrors errors_held_out(const ResidualProblem& problem, double usual, int threads,
                                      const Watch& watch) {
  HorizonOptions options;
  options.horizons = {kAhead};
  options.starts_every = kStartsEvery;
  ResidualErrors errors;
  for (const Fold& fold : folds_of(problem.fit_takes())) {
    const std::vector<bool> left_out = windows_in(fold, problem.fit_takes());
    if (std::ranges::count(left_out, false) < 4 || std::ranges::count(left_out, true) == 0) continue;
    const Recording held = cut(problem.fit_takes()[fold.fit_take].take->recording, fold.first, fold.last);
    const Model model = problem.with(problem.fit(usual, left_out));
    const auto without = errors_of(HorizonTask(held, problem.base(), options), threads, watch),
               with = errors_of(HorizonTask(held, model, options), threads, watch);
    const std::size_t before = errors.gain.size();
    for (std::size_t i = 0; i < with.size(); ++i) {
      if (!both_predicted(without[i][0], with[i][0])) continue;
      errors.base.push_back(without[i][0].model);
      errors.with.push_back(with[i][0].model);
      errors.gain.push_back(without[i][0].model - with[i][0].model);
    }
    const std::vector<double> own(errors.gain.begin() + static_cast<std::ptrdiff_t>(before),
                                  errors.gain.end());
    if (!own.empty()) errors.least_gain = std::min(errors.least_gain, median_of(own, 0.0));
  }
  return errors;
}

}  // namespace diagnose_detail

/// Learns what a model leaves of recordings of one set-up as an acceleration in the string's frame (see
/// ResidualForce), through predictions of half a second. Recordings, or thirds of a single one, are left out
/// in turn to choose the size that weights may have, and to tell whether it stands: only where the error
/// kAhead later falls by more than kImmaterialAhead, its median and all of a 95 % interval of its mean, and
/// in no fold rises. Else the model is the base. A residual that the base has is left out. Throws
/// RecordingError about recordings, std::invalid_argument about the base, Cancelled.
inline ResidualFit fit_residual(const std::vector<Recording>& recordings, const Model& base, int threads = 0,
                                const Watch& watch = {}) {
  if (recordings.empty()) throw std::invalid_argument("recordings: none; expected at least one");
  check_threads(threads);
  const diagnose_detail::ResidualProblem problem(recordings, base, threads, watch);
  ResidualFit result{.model = problem.base()};
  diagnose_detail::ResidualErrors best;
  for (const double usual : diagnose_detail::kResidualSizes) {
    diagnose_detail::ResidualErrors errors = diagnose_detail::errors_held_out(problem, usual, threads, watch);
    const double error = median_of(errors.with, 0.0);
    if (result.usual > 0.0 && !(error < result.error)) continue;
    result.usual = usual;
    result.error = error;
    best = std::move(errors);
  }
  result.windows = best.gain.size();
  result.base_error = median_of(best.base, 0.0);
  if (best.gain.empty()) return result;
  std::mt19937_64 generator(1);
  result.gain_ci95 = mean_interval(best.gain, diagnose_detail::kResidualAlike, generator);
  result.stands = result.gain_ci95 && result.gain_ci95->low > kImmaterialAhead && best.least_gain > 0.0 &&
                  result.base_error - result.error > kImmaterialAhead;
  if (result.stands) {
    const std::vector<bool> none(window_count(problem.fit_takes()), false);
    result.model = problem.with(problem.fit(result.usual, none));
  }
  return result;
}

}  // namespace diabolo
