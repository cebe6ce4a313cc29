// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/evidence.hpp"

namespace diabolo {

/// An effect stays in the model above so many standard deviations: with a score of candidates about 1e-3 of
/// recordings without any effect would show one.
inline constexpr double kSignificance = 4.0;

/// Estimates and their standing once a set of unknowns is free.
struct Standing {
  UnknownVector estimate;  ///< SI units
  Eigen::MatrixXd covariance;
};

inline Standing standing(const Evidence& evidence, const ActiveSet& free) {
  const UnknownVector scale = scales();
  Standing result{evidence.solve(free).cwiseProduct(scale), evidence.covariance(free)};
  result.covariance = scale.asDiagonal() * result.covariance * scale.asDiagonal();
  return result;
}

/// Significance of a candidate in a set that holds it, as standard deviations of one normal variable: of one
/// unknown signed, of several the size that a normal variable would need to be as unlikely (Wilson and
/// Hilferty's approximation of chi squared).
inline double significance(const Candidate& candidate, const Standing& standing) {
  const Eigen::Index n = static_cast<Eigen::Index>(candidate.unknowns.size());
  Eigen::VectorXd x(n);
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int u = index_of(candidate.unknowns[static_cast<std::size_t>(i)]);
    x[i] = standing.estimate[u];
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) = standing.covariance(u, index_of(candidate.unknowns[static_cast<std::size_t>(j)]));
  }
  if (!(covariance.diagonal().minCoeff() > 0.0)) return 0.0;
  if (n == 1) return x[0] / std::sqrt(covariance(0, 0));
  const double square = std::max(0.0, x.dot(covariance.ldlt().solve(x))), k = static_cast<double>(n);
  return (std::cbrt(square / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

/// Whether a standing speaks for a candidate.
inline bool speaks_for(const Candidate& candidate, double z) {
  return candidate.positive ? z > kSignificance : std::abs(z) > kSignificance;
}

/// From a set with everything, takes away the physics that is least sure, one by one, until all that is left
/// is sure.
inline ActiveSet eliminate(const Evidence& evidence, ActiveSet set) {
  for (;;) {
    const Standing now = standing(evidence, set);
    const Candidate* weakest = nullptr;
    double least = 0.0;
    for (const Candidate& candidate : candidates()) {
      if (candidate.kind != CandidateKind::kPhysics || !is_in(set, candidate)) continue;
      const double z = significance(candidate, now), sure = candidate.positive ? z : std::abs(z);
      if (weakest == nullptr || sure < least) weakest = &candidate, least = sure;
    }
    if (weakest == nullptr || least > kSignificance) return set;
    set = with(set, *weakest, false);
  }
}

/// The physics that is surest of what the set leaves out; null where none is sure.
inline const Candidate* strongest_left_out(const Evidence& evidence, const ActiveSet& set) {
  const Candidate* strongest = nullptr;
  double most = kSignificance;
  for (const Candidate& candidate : candidates()) {
    if (candidate.kind != CandidateKind::kPhysics || is_in(set, candidate)) continue;
    const double z = significance(candidate, standing(evidence, with(set, candidate)));
    const double sure = candidate.positive ? z : std::abs(z);
    if (sure > most) strongest = &candidate, most = sure;
  }
  return strongest;
}

}  // namespace diabolo
