// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/evidence.hpp"
#include "diabolo/diagnose/significance.hpp"
#include "diabolo/math/solve_symmetric.hpp"

namespace diabolo {

/// What stands out by so many standard deviations may be there, where it would explain something else.
inline constexpr double kMayBe = 2.0;

/// Estimates and their standing once a set of unknowns is free.
struct Estimates {
  UnknownVector estimate;         ///< SI units
  Eigen::MatrixXd noise, spread;  ///< its covariances; see Evidence::Covariances

  /// The larger of the two standard deviations.
  double deviation(int u) const { return std::sqrt(std::max({0.0, noise(u, u), spread(u, u)})); }
};

inline Estimates estimates_of(const Evidence& evidence, const ActiveSet& free) {
  const UnknownVector scale = scales();
  const Evidence::Covariances scaled = evidence.covariances(free);
  return {evidence.solve(free).cwiseProduct(scale), scale.asDiagonal() * scaled.noise * scale.asDiagonal(),
          scale.asDiagonal() * scaled.spread * scale.asDiagonal()};
}

/// x^T covariance^-1 x of some unknowns as standard deviations of one normal variable: the size that it would
/// need to be as unlikely (Wilson and Hilferty's approximation of chi squared).
inline double normal_equivalent(const Eigen::VectorXd& x, const Eigen::MatrixXd& covariance) {
  if (!(covariance.diagonal().minCoeff() > 0.0)) return 0.0;
  const double square = std::max(0.0, x.dot(solve_symmetric(covariance, x).col(0))),
               k = static_cast<double>(x.size());
  return (std::cbrt(square / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

/// Significance of a candidate in a set that holds it, in standard deviations, by the covariance that makes
/// less of it; signed where it is one number. Of physics that lies out of range only what is in range counts:
/// a wind of 20 m/s in a drag of next to nothing is no wind.
inline double significance(const Candidate& candidate, const Estimates& standing) {
  std::vector<int> own;
  double in_range = 1.0;
  for (const Unknown u : candidate.unknowns) {
    if (!(standing.deviation(index_of(u)) > 0.0)) continue;  // not free
    own.push_back(index_of(u));
    const double largest = std::max(-info_of(u).minimum, info_of(u).maximum);
    const double value = std::abs(standing.estimate[index_of(u)]);
    if (candidate.kind == CandidateKind::kPhysics && value > largest)
      in_range = std::min(in_range, largest / value);
  }
  if (own.empty()) return 0.0;
  const Eigen::VectorXd x = in_range * standing.estimate(own);
  if (own.size() == 1) return x[0] / standing.deviation(own.front());
  return std::max(0.0, std::min(normal_equivalent(x, standing.noise(own, own)),
                                normal_equivalent(x, standing.spread(own, own))));
}

/// By how many standard deviations x lies outside the box of +-half on every side: the nearest point of the
/// box in the covariance's measure, found coordinate by coordinate.
inline double beyond_box(const Eigen::VectorXd& x, const Eigen::MatrixXd& covariance, double half) {
  if (!(covariance.diagonal().minCoeff() > 0.0)) return 0.0;
  constexpr int kMostSweeps = 10000;
  const Eigen::Index n = x.size();
  const Eigen::MatrixXd precision = solve_symmetric(covariance, Eigen::MatrixXd::Identity(n, n));
  Eigen::VectorXd rest = x - x.cwiseMin(half).cwiseMax(-half);  // x less a point of the box
  double moved = 1.0;  // in a sweep, at most [standard deviations given the others]
  for (int sweep = 0; sweep < kMostSweeps && moved > 1e-6; ++sweep) {
    moved = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double before = rest[i], best = before - precision.row(i).dot(rest) / precision(i, i);
      rest[i] = std::clamp(best, x[i] - half, x[i] + half);
      moved = std::max(moved, std::abs(rest[i] - before) * std::sqrt(precision(i, i)));
    }
  }
  return normal_equivalent(rest, covariance);
}

/// A fault matters that lies beyond its floor by so many standard deviations.
inline constexpr double kBeyondFloor = 2.5;

/// Whether a candidate lies beyond its floor: that its unknowns should all be within can be ruled out.
inline bool is_beyond_floor(const Candidate& candidate, const Estimates& standing) {
  std::vector<int> own;
  for (const Unknown u : candidate.unknowns) own.push_back(index_of(u));
  const Eigen::VectorXd x = standing.estimate(own);
  if (own.size() == 1)
    return std::abs(x[0]) - kBeyondFloor * standing.deviation(own.front()) > candidate.floor;
  return std::min(beyond_box(x, standing.noise(own, own), candidate.floor),
                  beyond_box(x, standing.spread(own, own), candidate.floor)) > kBeyondFloor;
}

/// Whether the string may be as long as it was told, one turn of it being on the axle.
inline bool is_as_long_with_a_wrap(const Estimates& standing) {
  const std::vector<int> own{index_of(Unknown::kStringLength), index_of(Unknown::kAxleRadius)};
  const Eigen::Vector2d turn(1.0, 2.0 * std::numbers::pi), at = standing.estimate(own);
  const auto variance = [&](const Eigen::MatrixXd& of) { return turn.dot(of(own, own) * turn); };
  const double deviation = std::sqrt(std::max(variance(standing.noise), variance(standing.spread)));
  return std::abs(turn.dot(at)) - kBeyondFloor * deviation <= candidate_of("string_length").floor;
}

/// A z-score as far as it speaks for a candidate: of one that cannot be negative, with its sign.
inline double in_favour(const Candidate& candidate, double z) { return candidate.positive ? z : std::abs(z); }

/// Whether a standing speaks for a candidate.
inline bool speaks_for(const Candidate& candidate, double z) {
  const double least = candidate.kind == CandidateKind::kMeasurement ? kSignificanceOfFault : kSignificance;
  return in_favour(candidate, z) > least;
}

/// From a set with everything, takes away what is least sure, one by one, until all that is left is sure, or
/// a nuisance.
inline ActiveSet eliminate(const Evidence& evidence, const Bank& bank, ActiveSet set) {
  for (;;) {
    const Estimates now = estimates_of(evidence, set);
    const Candidate* weakest = nullptr;
    double least = 0.0;
    for (const Candidate* candidate : bank) {
      if (is_nuisance(*candidate) || !is_in(set, *candidate)) continue;
      const double z = significance(*candidate, now), sure = in_favour(*candidate, z);
      if (weakest == nullptr || sure < least) weakest = candidate, least = sure;
    }
    if (weakest == nullptr || least > kSignificance) return set;
    set = with(set, *weakest, false);
  }
}

/// The surest of what the set leaves out; null where none is sure.
inline const Candidate* strongest_left_out(const Evidence& evidence, const Bank& bank, const ActiveSet& set) {
  const Candidate* strongest = nullptr;
  double most = kSignificance;
  for (const Candidate* candidate : bank) {
    if (is_in(set, *candidate)) continue;
    const double z = significance(*candidate, estimates_of(evidence, with(set, *candidate)));
    const double sure = in_favour(*candidate, z);
    if (sure > most) strongest = candidate, most = sure;
  }
  return strongest;
}

}  // namespace diabolo
