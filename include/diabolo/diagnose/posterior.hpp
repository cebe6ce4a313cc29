// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/with_axle.hpp"

namespace diabolo {

/// Models that a diagnosis' recordings cannot distinguish from the best one: numbers drawn together, by a
/// normal distribution with the covariance of the fit; of laws that are tied one or the other, to the fit's
/// first order; and, with the chance `unclaimed`, one law beside it that was not claimed, as large as is not
/// excluded. Where what was found is withdrawn, there is the base alone.
class Posterior {
 public:
  explicit Posterior(const Diagnosis& diagnosis, double unclaimed = 0.5)
      : best_(diagnosis.model), unclaimed_(unclaimed), own_(diagnosis.own) {
    if (!diagnosis.final_fit || !diagnosis.final_fit->stands) return;
    const FinalFit& final = *diagnosis.final_fit;
    physics_ = final.physics;
    axle_ = final.axle;
    axle_deviation_ = final.axle_deviation;
    bank_ = final.bank;
    const Evidence evidence(final.fit);
    claimed_.push_back(explanation(evidence, final.free, final.fit.at));
    const auto also = [&](std::vector<Explanation>& list, const ActiveSet& set) {
      list.push_back(explanation(evidence, set, within_bounds(evidence.solve(set), final.fit)));
    };
    for (const Finding& f : diagnosis.findings)
      for (const std::string& other : f.tied_with)
        if (const Candidate* const tied = law_named(other);
            f.claimed && tied != nullptr && is_in(final.free, *f.candidate))
          also(claimed_, in_place_of(*f.candidate, *tied, final.free));
    for (const Candidate* candidate : bank_)
      if (is_drawn(*candidate) && !is_in(final.free, *candidate)) also(others_, with(final.free, *candidate));
  }

  /// So many models; the same seed gives the same ones. Without a fit, the diagnosis' model each time.
  std::vector<Model> draw(std::size_t count, std::uint64_t seed) const {
    std::vector<Model> models;
    std::mt19937_64 generator(seed);
    for (std::size_t i = 0; i < count; ++i) {
      if (claimed_.empty()) {
        models.push_back(best_);
      } else {
        models.push_back(augmented_model(physics_, unknowns(generator), best_.name, bank_));
        models.back() = with_axle(models.back(), axle_numbers(generator));
        models.back().effects.get<FiniteAxle>().follows_axis = best_.effects.get<FiniteAxle>().follows_axis;
      }
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

  /// Laws by somebody's formulas stay as they are: models that are played together have the same.
  static bool is_drawn(const Candidate& candidate) {
    return is_law(candidate) && !candidate.unknowns.empty() &&
           index_of(candidate.unknowns.front()) < index_of(own_number(0));
  }

  const Candidate* law_named(std::string_view name) const {
    const auto found = std::ranges::find(bank_, name, &Candidate::name);
    return found != bank_.end() && is_drawn(**found) ? *found : nullptr;
  }

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

  /// Of what turns the axle, each by itself.
  UnknownVector axle_numbers(std::mt19937_64& generator) const {
    UnknownVector at = axle_;
    std::normal_distribution<double> normal;
    for (int u = 0; u < kUnknowns; ++u) {
      if (axle_[u] == 0.0) continue;
      const Interval bounds = addition_to_axle(physics_, u);
      at[u] = std::clamp(axle_[u] + axle_deviation_[u] * normal(generator), bounds.low, bounds.high);
    }
    return at;
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
    for (const Candidate* candidate : bank_)
      if (candidate->positive && is_drawn(*candidate)) {
        double& size = at[index_of(candidate->unknowns.front())];
        size = std::max(0.0, size);
      }
    return at;
  }

  Model best_, physics_;
  UnknownVector axle_ = UnknownVector::Zero(), axle_deviation_ = axle_;
  double unclaimed_;
  std::shared_ptr<const OwnCandidates> own_;  ///< to which the bank may point
  Bank bank_;
  std::vector<Explanation> claimed_, others_;  ///< what may be; the same with an effect that was not claimed
};

}  // namespace diabolo
