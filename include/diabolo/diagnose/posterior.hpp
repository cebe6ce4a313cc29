// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/next_experiment.hpp"
#include "diabolo/diagnose/select.hpp"

namespace diabolo {

/// Models that a diagnosis' recordings do not tell from the best one: numbers drawn together, by a normal
/// distribution with the covariance of the fit; what is tied, one or the other; and, in `unclaimed` of them,
/// one effect beside it that was not claimed, as large as is not excluded.
class Posterior {
 public:
  explicit Posterior(const Diagnosis& diagnosis, double unclaimed = 0.5)
      : best_(diagnosis.model), unclaimed_(unclaimed) {
    if (!diagnosis.final_fit) return;
    const auto& [physics, fit, free] = *diagnosis.final_fit;
    physics_ = physics;
    const Evidence evidence(fit);
    claimed_.push_back(explanation(evidence, free, fit.at));
    for (const Finding& f : diagnosis.findings) {
      for (const std::string& other : f.tied_with)
        if (const auto tied = diagnose_detail::alternative_of(f.candidate->name, other, fit, free))
          claimed_.push_back(explanation(evidence, tied->set, tied->at));
      if (f.candidate->kind != CandidateKind::kPhysics || f.candidate->unknowns.empty() ||
          is_in(free, *f.candidate))
        continue;
      const ActiveSet more = with(free, *f.candidate);
      others_.push_back(explanation(evidence, more, within_bounds(evidence.solve(more), fit)));
    }
  }

  /// So many models; the same seed gives the same ones. Without a fit, the diagnosis' model each time.
  std::vector<Model> draw(std::size_t count, std::uint64_t seed) const {
    std::vector<Model> models;
    std::mt19937_64 generator(seed);
    for (std::size_t i = 0; i < count; ++i) {
      models.push_back(claimed_.empty() ? best_ : augmented_model(physics_, unknowns(generator), best_.name));
      models.back().name.append(" ").append(std::to_string(i + 1));
    }
    return models;
  }

 private:
  /// Where the unknowns are, in SI units, and a square root of the covariance of those that are free.
  struct Explanation {
    UnknownVector at;
    std::vector<int> free;
    Eigen::MatrixXd root;
  };

  static Explanation explanation(const Evidence& evidence, const ActiveSet& set, const UnknownVector& at) {
    const Estimates standing = estimates_of(evidence, set);
    Explanation result{at, {}, {}};
    for (int u = 0; u < kUnknowns; ++u)
      if (set[u] && standing.noise(u, u) > 0.0) result.free.push_back(u);
    const Eigen::MatrixXd noise = standing.noise(result.free, result.free);
    const Eigen::VectorXd own = noise.diagonal().cwiseSqrt();
    Eigen::MatrixXd correlation = own.cwiseInverse().asDiagonal() * noise * own.cwiseInverse().asDiagonal();
    correlation.diagonal().array() += 1e-9;
    Eigen::VectorXd deviation(own.size());
    for (Eigen::Index i = 0; i < own.size(); ++i)
      deviation[i] = standing.deviation(result.free[static_cast<std::size_t>(i)]);
    result.root = deviation.asDiagonal() * correlation.llt().matrixL().toDenseMatrix();
    return result;
  }

  UnknownVector unknowns(std::mt19937_64& generator) const {
    const bool beside = !others_.empty() && std::bernoulli_distribution(unclaimed_)(generator);
    const std::vector<Explanation>& list = beside ? others_ : claimed_;
    const Explanation& drawn =
        list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(generator)];
    std::normal_distribution<double> normal;
    Eigen::VectorXd z(drawn.root.cols());
    for (double& number : z) number = normal(generator);
    UnknownVector at = drawn.at;
    at(drawn.free) += drawn.root * z;
    for (int u = 0; u < kUnknowns; ++u) {
      const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(u)];
      at[u] = std::clamp(at[u], info.minimum, info.maximum);
    }
    for (const Candidate& candidate : candidates())
      if (candidate.positive) {
        double& size = at[index_of(candidate.unknowns.front())];
        size = std::max(0.0, size);
      }
    return at;
  }

  Model best_, physics_;
  double unclaimed_;
  std::vector<Explanation> claimed_, others_;  ///< what may be; the same with an effect that was not claimed
};

}  // namespace diabolo
