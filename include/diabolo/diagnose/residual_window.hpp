// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "diabolo/diagnose/play_window.hpp"
#include "diabolo/math/solve_symmetric.hpp"
#include "diabolo/model.hpp"

namespace diabolo {

/// What a window says of a residual's weights, on the string and off it, once its start has been fitted.
struct ResidualWindow {
  static constexpr int kStart = 6, kWeights = 2 * static_cast<int>(kResidualTerms);
  Eigen::MatrixXd information =
      Eigen::MatrixXd::Zero(kWeights, kWeights);            ///< half the curvature of `square`
  Eigen::VectorXd score = Eigen::VectorXd::Zero(kWeights);  ///< half its slope, downwards
  double square = 0.0;                                      ///< sum of squared residuals [m^2]
  int numbers = 0;  ///< residuals in it; none where the prediction left the world

  /// Root mean square of a coordinate's residual [m].
  double size() const { return std::sqrt(square / std::max(1, numbers)); }
};

namespace diagnose_detail {

/// Weight number `i` of a law, those on the string first.
inline double& residual_weight(ResidualLaw& law, int i) {
  const auto k = static_cast<std::size_t>(i);
  return k < kResidualTerms ? law.on_string.weights[k] : law.off_string.weights[k - kResidualTerms];
}

/// A window's start with the axle as it was seen.
inline State<double> residual_start(const Take& take, const FitWindow& window) {
  State<double> state = window.start;
  state.axis = take.axis.col(window.first);
  return state;
}

/// Positions at the rows after the first at which the diabolo was seen, one after the other [m]; of the
/// prediction, less those that were recorded.
inline Eigen::VectorXd misses(const Take& take, const FitWindow& window,
                              const FullPredictor<double>& predictor, const State<double>& start) {
  std::vector<double> result;
  State<double> begun = start;
  play_window(take, window, *take.motion, predictor, begun,
              [&](Eigen::Index row, const State<double>& state, const auto&) {
                if (row == window.first || !take.recording.diabolo.valid[row]) return;
                for (int c = 0; c < 3; ++c)
                  result.push_back(state.position[c] - take.recording.diabolo.position(c, row));
              });
  return Eigen::Map<Eigen::VectorXd>(result.data(), static_cast<Eigen::Index>(result.size()));
}

/// How far a start may be off: as of the first guess of a fit, one millimetre being the noise.
inline constexpr double kStartOff[2] = {0.01, 0.3}, kSeenWithin = 1e-3;  ///< [m], [m/s]; [m]

/// Takes the start out of normal equations whose first rows are its own.
inline ResidualWindow without_start(Eigen::MatrixXd normal, const Eigen::VectorXd& slope, double square,
                                    int numbers) {
  constexpr int s = ResidualWindow::kStart, n = ResidualWindow::kWeights;
  for (int i = 0; i < s; ++i) normal(i, i) += std::pow(kSeenWithin / kStartOff[i < 3 ? 0 : 1], 2);
  const Eigen::MatrixXd start = normal.topLeftCorner(s, s), cross = normal.topRightCorner(s, n);
  const Eigen::MatrixXd step = solve_symmetric(start, slope.head(s));
  return {.information = normal.bottomRightCorner(n, n) - cross.transpose() * solve_symmetric(start, cross),
          .score = slope.tail(n) - cross.transpose() * step.col(0),
          .square = std::max(0.0, square - slope.head(s).dot(step.col(0))),
          .numbers = numbers};
}

}  // namespace diagnose_detail

/// Predicts a window under `law` on top of `model`, and once more for every number of its start and every
/// weight, a little changed.
inline ResidualWindow residual_window(const Take& take, const FitWindow& window, Model model,
                                      const ResidualLaw& law) {
  using diagnose_detail::misses, diagnose_detail::residual_start, diagnose_detail::residual_weight,
      diagnose_detail::without_start;
  constexpr double kPlace = 1e-4, kVelocity = 1e-3, kWeight = 1e-3;  // [m], [m/s], [m/s^2]
  const auto predictor = [&](const ResidualLaw& own) {
    model.effects.get<ResidualForce>() = ResidualForce<double>(own);
    return predictor_for(model, take.recording);
  };
  const FullPredictor<double> nominal = predictor(law);
  const State<double> start = residual_start(take, window);
  const Eigen::VectorXd missed = misses(take, window, nominal, start);
  Eigen::MatrixXd slopes(missed.size(), ResidualWindow::kStart + ResidualWindow::kWeights);
  for (int i = 0; i < ResidualWindow::kStart; ++i) {
    State<double> moved = start;
    const double by = i < 3 ? kPlace : kVelocity;
    (i < 3 ? moved.position[i] : moved.velocity[i - 3]) += by;
    slopes.col(i) = (misses(take, window, nominal, moved) - missed) / by;
  }
  for (int i = 0; i < ResidualWindow::kWeights; ++i) {
    ResidualLaw heavier = law;
    residual_weight(heavier, i) += kWeight;
    slopes.col(ResidualWindow::kStart + i) =
        (misses(take, window, predictor(heavier), start) - missed) / kWeight;
  }
  if (!slopes.allFinite() || !missed.allFinite()) return {};
  return without_start(slopes.transpose() * slopes, -slopes.transpose() * missed, missed.squaredNorm(),
                       static_cast<int>(missed.size()));
}

}  // namespace diabolo
