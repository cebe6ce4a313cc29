// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "diabolo/diagnose/fit.hpp"
#include "diabolo/math/solve_symmetric.hpp"

namespace diabolo {

/// What all windows say of the unknowns, as a quadratic in them about a fit: chi^2 of window w at the scaled
/// unknowns x is a constant - 2 slope_w x + x information_w x. Which explanation is best, how sure it is and
/// what it would predict where it was not fitted are then algebra, without another simulation.
class Evidence {
 public:
  explicit Evidence(const Fit& fit)
      : prior_(prior_precision()), centre_(fit.centre.cwiseQuotient(scales())), dispersion_(fit.dispersion) {
    const UnknownVector at = fit.at.cwiseQuotient(scales());
    for (const WindowScore& score : fit.scores) {
      Part part;
      part.information = score.weight * score.information;
      part.slope = part.information * at + score.weight * score.score;
      information_ += part.information;
      slope_ += part.slope;
      parts_.push_back(std::move(part));
    }
  }

  /// How much wider the residuals are than the noise says.
  double dispersion() const { return dispersion_; }

  /// The same, were what an unknown does in each window so many times as large.
  Evidence rescaled(Unknown unknown, const std::vector<double>& factors) const {
    const int u = index_of(unknown);
    Evidence result = *this;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = result.parts_[i];
      part.information.row(u) *= factors[i];
      part.information.col(u) *= factors[i];
      part.slope[u] *= factors[i];
      result.information_.row(u) += part.information.row(u) - parts_[i].information.row(u);
      result.slope_[u] += part.slope[u] - parts_[i].slope[u];
    }
    result.information_.col(u) = result.information_.row(u).transpose();
    return result;
  }

  /// The same, were 1 / prior variance of the scaled unknowns another.
  Evidence with_priors(const UnknownVector& precision) const {
    Evidence result = *this;
    result.prior_ = precision;
    return result;
  }

  /// Best scaled unknowns where all but `free` are as expected.
  UnknownVector solve(const ActiveSet& free) const { return solve(free, information_, slope_); }

  /// chi^2 of all windows there and what the priors cost, less a constant. What is not free has no prior.
  double cost(const ActiveSet& free) const {
    const UnknownVector x = solve(free);
    return x.dot(information_ * x) - 2.0 * slope_.dot(x) +
           dispersion_ * prior_.dot((x - centre_).cwiseAbs2());  // what is not free is as expected
  }

  /// Two covariances of the scaled free unknowns: what the noise makes of them, and what the windows' own
  /// disagreement does (the jackknife that leaves out one window at a time), which also knows of correlated
  /// noise and of what no unknown explains. (White's sandwich comes out too narrow where unknowns are not
  /// far fewer than windows.) Both hold what the priors leave open: the windows agree on a prior's mean,
  /// wherever the truth is.
  struct Covariances {
    UnknownMatrix noise, spread;
  };
  Covariances covariances(const ActiveSet& free) const {
    const std::vector<int> f = indices(free);
    const Eigen::Index n = static_cast<Eigen::Index>(f.size());
    const Eigen::MatrixXd inverse =
        solve_symmetric(precision(f, information_), Eigen::MatrixXd::Identity(n, n));
    Covariances result{UnknownMatrix::Zero(kUnknowns, kUnknowns), UnknownMatrix::Zero(kUnknowns, kUnknowns)};
    result.noise(f, f) = dispersion_ * inverse;
    // x moves by A^-1 (dispersion P) dc with the prior's mean c, whose covariance is P^-1.
    const Eigen::VectorXd prior = prior_(f);
    result.spread(f, f) =
        jackknife(f, solve(free)) + dispersion_ * dispersion_ * (inverse * prior.asDiagonal() * inverse);
    return result;
  }

  /// chi^2 of the windows that are marked, less a constant, where the unknowns are as the others say.
  double cost_left_out(const ActiveSet& free, const std::vector<bool>& left_out) const {
    const UnknownVector x = solve_without(free, left_out);
    double sum = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (left_out[i]) sum += x.dot(parts_[i].information * x) - 2.0 * parts_[i].slope.dot(x);
    return sum;
  }

  /// Best scaled unknowns as the windows see them that are not marked `left_out`.
  UnknownVector solve_without(const ActiveSet& free, const std::vector<bool>& left_out) const {
    UnknownMatrix information = information_;
    UnknownVector slope = slope_;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!left_out[i]) continue;
      information -= parts_[i].information;
      slope -= parts_[i].slope;
    }
    return solve(free, information, slope);
  }

 private:
  struct Part {
    UnknownMatrix information;
    UnknownVector slope;
  };

  static std::vector<int> indices(const ActiveSet& free) {
    std::vector<int> result;
    for (int u = 0; u < kUnknowns; ++u)
      if (free[u]) result.push_back(u);
    return result;
  }

  Eigen::MatrixXd precision(const std::vector<int>& f, const UnknownMatrix& information) const {
    Eigen::MatrixXd result = information(f, f);
    for (std::size_t i = 0; i < f.size(); ++i) {
      const Eigen::Index k = static_cast<Eigen::Index>(i);
      result(k, k) += dispersion_ * prior_[f[i]] + 1e-9 * (1.0 + result(k, k));
    }
    return result;
  }

  UnknownVector solve(const ActiveSet& free, const UnknownMatrix& information,
                      const UnknownVector& slope) const {
    const std::vector<int> f = indices(free);
    const UnknownVector expected = dispersion_ * prior_.cwiseProduct(centre_);
    UnknownVector result = centre_;
    result(f).setZero();
    const Eigen::VectorXd sums = (slope + expected - information * result)(f);
    result(f) = solve_symmetric(precision(f, information), sums).col(0);
    return result;
  }

  /// Sum of the outer products of what the estimate x moves by without each window.
  Eigen::MatrixXd jackknife(const std::vector<int>& f, const UnknownVector& x) const {
    const Eigen::Index n = static_cast<Eigen::Index>(f.size());
    const Eigen::MatrixXd all = precision(f, information_);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
    for (const Part& part : parts_) {
      // (A - A_w) dx = -(b_w - A_w x) from A x = b.
      const Eigen::VectorXd rest = (part.information * x - part.slope)(f),
                            move = solve_symmetric(all - part.information(f, f), rest);
      sum += move * move.transpose();
    }
    const double count = static_cast<double>(parts_.size());
    return sum * ((count - 1.0) / std::max(count, 1.0));
  }

  UnknownVector prior_, centre_;  ///< scaled
  double dispersion_;
  UnknownMatrix information_ = UnknownMatrix::Zero(kUnknowns, kUnknowns);
  UnknownVector slope_ = UnknownVector::Zero();
  std::vector<Part> parts_;
};

}  // namespace diabolo
