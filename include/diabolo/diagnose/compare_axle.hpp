// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/with_axle.hpp"

// What turns the axle, in reality and in a simulator: each as its own recorded axle says.
namespace diabolo::diagnose_detail {

/// Whether both tell what turns their axle.
inline bool both_tell_axle(const Diagnosis& real, const Diagnosis& simulated) {
  return real.heldout.axle.has_value() && simulated.heldout.axle.has_value();
}

/// What a diagnosis says of a law of the axle, claimed or not. Where nothing turns the axle none of the
/// others acts, whatever its number: it is as good as zero.
inline Estimates axle_estimate(const Diagnosis& d, const Candidate& law) {
  const int u = index_of(first_of(law));
  Estimates result{UnknownVector::Zero(), Eigen::MatrixXd::Zero(kUnknowns, kUnknowns),
                   Eigen::MatrixXd::Zero(kUnknowns, kUnknowns)};
  const auto f =
      std::ranges::find_if(d.findings, [&](const Finding& one) { return one.candidate->name == law.name; });
  const bool acts = first_of(law) == Unknown::kGyroscopicGain || !needs_gain(d.model);
  if (f == d.findings.end() || !acts) return result;
  result.estimate[u] = f->estimate[u];
  result.noise(u, u) = result.spread(u, u) = f->deviation[u] * f->deviation[u];
  return result;
}

/// Whether the base has a law of the axle: then both have more or less of it.
inline bool base_turns_axle_by(const Candidate& law, const Diagnosis& d) {
  return is_of_axle(law) && own_of_axle(d.final_fit->physics, index_of(first_of(law))) != 0.0;
}

/// How far a difference turns the axle in 1 s [rad], in proportion to what a claim does.
inline double turn_of(const Finding& claim, const Estimates& difference) {
  const int u = index_of(first_of(*claim.candidate));
  return claim.size * std::abs(difference.estimate[u] / claim.estimate[u]);
}

/// That the axle was not compared, where one of the two could tell.
inline std::string axle_not_compared(const Diagnosis& real, const Diagnosis& simulated) {
  if (real.heldout.axle.has_value() == simulated.heldout.axle.has_value()) return "";
  return std::string(" What turns the axle is not compared: it could be told of ") +
         (real.heldout.axle ? "the recordings" : "what was simulated") + " alone.";
}

}  // namespace diabolo::diagnose_detail
