// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/law_guesses.hpp"
#include "diabolo/math/solve_symmetric.hpp"

// A window of half a second has a start of its own and takes the mean of what it sees for constant, so
// windows follow no oscillation above 0.9 Hz. A carrier is asked about instead: how much of its sine and of
// its cosine each window wants. An oscillation beside the carrier turns that slowly from window to window.
namespace diabolo {

namespace diagnose_detail {

/// What a window says of a carrier's sine and cosine, its start fitted.
struct Demodulated {
  double time;  ///< of its middle [s]
  Eigen::Matrix2d information;
  Eigen::Vector2d score;
};

/// Carriers, and how far beside them oscillations are looked for [Hz].
inline constexpr std::array<double, 2> kCarriers{1.5, 2.5};
inline constexpr double kBeside = 0.6;

/// What an oscillation of this frequency would take off chi^2.
inline double gain_at(double frequency, double carrier, const std::vector<Demodulated>& windows) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(2, 2);
  Eigen::MatrixXd score = Eigen::MatrixXd::Zero(2, 1);
  for (const Demodulated& window : windows) {
    const double phase = 2.0 * std::numbers::pi * (frequency - carrier) * window.time;
    const Eigen::Matrix2d turn{{std::cos(phase), -std::sin(phase)}, {std::sin(phase), std::cos(phase)}};
    information += turn.transpose() * window.information * turn;
    score += turn.transpose() * window.score;
  }
  information.diagonal().array() += 1e-9;
  return score.col(0).dot(solve_symmetric(information, score).col(0));
}

/// The frequency that takes most off chi^2, and what it does.
inline std::pair<double, double> best_beside(double carrier, const std::vector<Demodulated>& windows,
                                             double span) {
  std::pair<double, double> best{carrier, 0.0};
  const double step = 0.25 / span;
  for (int i = 0; i * step < 2.0 * kBeside; ++i) {
    const double frequency = carrier - kBeside + i * step;
    if (const double gain = gain_at(frequency, carrier, windows); gain > best.second)
      best = {frequency, gain};
  }
  return best;
}

/// What the windows of a fit that was looked at with a carrier say of it, by its first own number.
inline std::vector<Demodulated> demodulated(const Fit& looked, std::size_t first) {
  const std::array<int, 2> own{index_of(own_number(first)), index_of(own_number(first + 1))};
  const FitTake& fit_take = looked.fit_takes.front();
  std::vector<Demodulated> windows;
  for (std::size_t w = 0; w < fit_take.windows.size(); ++w) {
    const WindowScore& score = looked.scores[w];
    const Eigen::VectorXd& times = fit_take.take->times;
    windows.push_back({0.5 * (times[fit_take.windows[w].first] + times[fit_take.windows[w].last]),
                       score.weight * score.information(own, own), score.weight * score.score(own)});
  }
  return windows;
}

}  // namespace diagnose_detail

/// Oscillations too fast for windows to follow, along each axis of the world, as guesses of a single take.
/// `look(laws)` is the fit, looked at with these laws, whose own numbers begin at `used`; at most `room` of
/// them.
template <class Look>
std::vector<LawGuess> fast_swings(const Fit& fit, std::size_t used, std::size_t room, const Look& look) {
  namespace in = diagnose_detail;
  in::Guesses guesses;
  const FitTake& fit_take = fit.fit_takes.front();
  const double span = fit_take.take->times[fit_take.windows.back().last] -
                      fit_take.take->times[fit_take.windows.front().first];
  const std::array<Acts, 3> directions{Acts::kForward, Acts::kLeft, Acts::kUp};
  for (const double carrier : in::kCarriers)
    for (std::size_t begin = 0; begin < directions.size() && room >= 2;) {
      const std::size_t count = std::min(room / 2, directions.size() - begin);
      std::vector<Law> probes;
      for (std::size_t i = 0; i < count; ++i)
        std::ranges::copy(in::Guesses::quadratures(directions[begin + i], "", carrier, ""),
                          std::back_inserter(probes));
      const Fit looked = look(probes);
      for (std::size_t i = 0; i < count; ++i) {
        const auto [frequency, gain] = in::best_beside(carrier, in::demodulated(looked, used + 2 * i), span);
        if (gain > 0.0)
          guesses.swinging(directions[begin + i], "", std::round(1e4 * frequency) / 1e4, span,
                           ", to and fro");
      }
      begin += count;
    }
  return std::move(guesses.list);
}

}  // namespace diabolo
