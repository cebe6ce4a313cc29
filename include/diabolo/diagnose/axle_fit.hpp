// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "diabolo/diagnose/axle_stretches.hpp"
#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/with_axle.hpp"
#include "diabolo/math/solve_symmetric.hpp"

namespace diabolo {

inline bool every_stretch(std::size_t) { return true; }

/// Laws of the axle as they fit best, and what each stretch says around that: numbers in usual sizes.
struct AxleFit {
  std::vector<int> free;                         ///< unknowns
  UnknownVector at = UnknownVector::Zero();      ///< SI units, the others zero
  UnknownVector around = UnknownVector::Zero();  ///< where the stretches were asked
  std::vector<Eigen::MatrixXd> information;
  std::vector<Eigen::VectorXd> slope;

  /// What those stretches say for which `counts` is true, of `asked` alone; the others are nothing. Not
  /// bounded.
  template <class Counts>
  UnknownVector estimate(const std::vector<int>& asked, const Counts& counts) const {
    std::vector<int> places;
    places.reserve(asked.size());
    for (const int u : asked) places.push_back(static_cast<int>(std::ranges::find(free, u) - free.begin()));
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(std::ssize(asked), std::ssize(asked));
    Eigen::VectorXd product = Eigen::VectorXd::Zero(std::ssize(asked));
    Eigen::VectorXd given(std::ssize(free));  // where the stretches were asked
    for (Eigen::Index k = 0; k < given.size(); ++k) {
      const int u = free[static_cast<std::size_t>(k)];
      given[k] = around[u] / kUnknownInfos[static_cast<std::size_t>(u)].scale;
    }
    for (std::size_t i = 0; i < information.size(); ++i) {
      if (!counts(i)) continue;
      sum += information[i](places, places);
      product += (slope[i] + information[i] * given)(places);
    }
    const Eigen::VectorXd solution = solve_symmetric(sum, product);
    UnknownVector result = UnknownVector::Zero();
    for (std::size_t k = 0; k < asked.size(); ++k)
      result[asked[k]] =
          kUnknownInfos[static_cast<std::size_t>(asked[k])].scale * solution[static_cast<Eigen::Index>(k)];
    return result;
  }

  /// The free ones as far as they may be added to a model.
  UnknownVector in_bounds(UnknownVector x, const Model& model) const {
    for (const int u : free) {
      const Interval bounds = addition_to_axle(model, u);
      x[u] = std::clamp(x[u], bounds.low, bounds.high);
    }
    return x;
  }

  /// Standard deviations by the jackknife over the stretches.
  UnknownVector deviation() const {
    UnknownVector square = UnknownVector::Zero();
    const UnknownVector whole = estimate(free, every_stretch);
    for (std::size_t left_out = 0; left_out < information.size(); ++left_out)
      square += (estimate(free, [&](std::size_t i) { return i != left_out; }) - whole).cwiseAbs2();
    return square.cwiseSqrt();
  }
};

namespace diagnose_detail {

/// Less the mean of its columns: where the axle was in the first row is not known either.
inline Eigen::Matrix3Xd about_mean(const Eigen::Matrix3Xd& axle) {
  return axle.colwise() - axle.rowwise().mean();
}

/// What a stretch leaves counts in proportion and no longer as its square, from about a camera's noise on
/// [rad]: where the axle tumbles, little is to be learnt.
inline constexpr double kAxleNoise = 0.2 * kDegree;

/// What stretches leave between what was seen and what is predicted [rad].
class AxleResiduals {
 public:
  AxleResiduals(const std::vector<Eigen::Matrix3Xd>& seen, const std::vector<Eigen::Matrix3Xd>& predicted) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double rows = static_cast<double>(seen[i].cols());
      residuals_.push_back(about_mean(seen[i] - predicted[i]));
      const bool predicts = residuals_.back().allFinite();
      if (!predicts) residuals_.back().setZero();
      const double square = residuals_.back().squaredNorm() / rows + kAxleNoise * kAxleNoise;
      sizes_.push_back(predicts ? std::sqrt(square) : std::numbers::pi);
      weights_.push_back(predicts ? kAxleNoise / (rows * sizes_.back()) : 0.0);
    }
  }
  const Eigen::Matrix3Xd& of(std::size_t i) const { return residuals_[i]; }
  /// Of its squares, by which the cost is linear in the residual; zero where there was no prediction.
  double weight(std::size_t i) const { return weights_[i]; }
  double cost() const { return std::accumulate(sizes_.begin(), sizes_.end(), 0.0); }

 private:
  std::vector<Eigen::Matrix3Xd> residuals_;
  std::vector<double> sizes_, weights_;  ///< root mean squares
};

/// Asks the stretches around `fit.at`. Derivatives are differences over a thousandth of what is usual.
inline void linearize_axle(AxleFit& fit, const AxleStretches& stretches, const Model& model,
                           const std::vector<Eigen::Matrix3Xd>& here, const AxleResiduals& residuals,
                           int threads, const Watch& watch) {
  constexpr double kShare = 1e-3;
  std::vector<std::vector<Eigen::Matrix3Xd>> beside;
  for (const int u : fit.free) {
    UnknownVector shifted = fit.at;
    shifted[u] += kShare * kUnknownInfos[static_cast<std::size_t>(u)].scale;
    beside.push_back(stretches.predicted(with_axle(model, shifted), threads, watch));
  }
  fit.around = fit.at;
  fit.information.clear();
  fit.slope.clear();
  for (std::size_t i = 0; i < here.size(); ++i) {
    Eigen::MatrixXd columns(here[i].size(), std::ssize(fit.free));
    for (std::size_t k = 0; k < beside.size(); ++k) {
      const Eigen::Matrix3Xd change = about_mean(beside[k][i] - here[i]) / kShare;
      columns.col(static_cast<Eigen::Index>(k)) = change.reshaped();
    }
    if (!columns.allFinite()) columns.setZero();
    fit.information.emplace_back(residuals.weight(i) * columns.transpose() * columns);
    fit.slope.emplace_back(residuals.weight(i) * columns.transpose() * residuals.of(i).reshaped());
  }
}

}  // namespace diagnose_detail

/// Fits such unknowns of the axle to its recorded direction, from `at` on, by Gauss and Newton with halved
/// steps; a stretch counts by the root of what it leaves.
inline AxleFit fit_axle(const AxleStretches& stretches, const Model& model, std::vector<int> free,
                        const UnknownVector& at, int threads, const Watch& watch) {
  constexpr int kMost = 12, kMostHalves = 4;
  constexpr double kSettled = 1e-3;  // of the cost
  const std::vector<Eigen::Matrix3Xd> seen = stretches.seen();
  const auto predicted = [&](const UnknownVector& x) {
    return stretches.predicted(with_axle(model, x), threads, watch);
  };
  AxleFit fit{std::move(free), at, at, {}, {}};
  std::vector<Eigen::Matrix3Xd> here = predicted(at);
  for (int iteration = 0; iteration < kMost; ++iteration) {
    const diagnose_detail::AxleResiduals residuals(seen, here);
    diagnose_detail::linearize_axle(fit, stretches, model, here, residuals, threads, watch);
    const UnknownVector step = fit.in_bounds(fit.estimate(fit.free, every_stretch), model) - fit.at;
    double gained = -1.0;
    for (int halves = 0; halves <= kMostHalves && !(gained > 0.0); ++halves) {
      const UnknownVector there = fit.at + std::ldexp(1.0, -halves) * step;
      std::vector<Eigen::Matrix3Xd> trial = predicted(there);
      gained = residuals.cost() - diagnose_detail::AxleResiduals(seen, trial).cost();
      if (gained > 0.0) {
        fit.at = there;
        here = std::move(trial);
      }
    }
    if (!(gained > kSettled * residuals.cost())) break;
  }
  return fit;
}

}  // namespace diabolo
