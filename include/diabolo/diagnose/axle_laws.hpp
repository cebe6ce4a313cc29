// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "diabolo/diagnose/axle_left_out.hpp"
#include "diabolo/diagnose/axle_selection.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/time_budget.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What the axle's recorded direction says of the laws that turn it.
struct AxleAnswer {
  std::vector<Finding> findings;
  UnknownVector at = UnknownVector::Zero(), deviation = at;  ///< of the laws that are sure and help
  bool helps = false;                                        ///< all of it, so that it belongs in the model
  std::optional<AxleAhead> ahead;                            ///< nothing where the axle was not seen
};

namespace diagnose_detail {

/// Asks for the laws of the axle, keeps those that are sure, and judges them on stretches that were left out.
class AxleInquiry {
 public:
  /// `stretches` are fitted, and judged unless `heldout` are; both have to outlive it. `radius_share` is how
  /// well the axle's radius is known, a standard deviation over its size: what lies along the axle is seen as
  /// a share of it.
  AxleInquiry(const AxleStretches& stretches, const AxleStretches& heldout, const Model& model,
              const Bank& laws, double radius_share, int threads, const FitWatch& watch)
      : stretches_(&stretches),
        left_out_(stretches, heldout),
        model_(model),
        laws_(laws),
        radius_share_(radius_share),
        threads_(threads),
        watch_(watch) {}

  /// Nothing where time is up.
  AxleAnswer answer(std::uint64_t seed) {
    AxleAnswer result;
    if (stretches_->all().empty() || laws_.empty()) return result;
    const AxleFit everything = fit_all_axle_laws(*stretches_, model_, laws_, threads_, watch_);
    kept_ = keep_sure_axle_laws(everything, *stretches_, model_, laws_, threads_, watch_);
    if (watch_.is_enough()) return {};
    std::mt19937_64 generator(seed);
    const std::vector<double> found = errors_with(kept_.free);
    for (const Candidate* law : laws_) {
      if (watch_.is_enough()) return {};
      result.findings.push_back(finding_of(*law, everything, found, generator));
    }
    keep_what_helps(result.findings);
    result.ahead = compared(generator);
    result.helps = result.ahead && helps(result.ahead->improvement_ci95);
    for (Finding& f : result.findings) f.claimed = f.claimed && result.helps && is_free(kept_, *f.candidate);
    if (!result.helps) return result;
    result.at = kept_.at;
    result.ahead->lets_strands_follow =
        !needs_gain(model_) && strands_follow_axle(with_axle(model_, kept_.at)) > strands_follow_axle(model_);
    for (const Finding& f : result.findings)
      if (is_free(kept_, *f.candidate))
        result.deviation[number_of(*f.candidate)] = f.deviation[number_of(*f.candidate)];
    return result;
  }

 private:
  static bool helps(const std::optional<Interval>& gain) { return gain && gain->low > 0.0; }

  /// Errors of stretches that were left out, by such laws as the others say they are.
  std::vector<double> errors_with(const std::vector<int>& free) const {
    const auto model_of = [&](const AxlePart& part) {
      if (free.empty()) return with_axle(model_, UnknownVector::Zero());
      const bool all = free == kept_.free && std::ranges::count(part.others, false) == 0;
      const UnknownVector at =
          all ? kept_.at : kept_.estimate(free, [&](std::size_t i) { return part.others[i]; });
      return with_axle(model_, kept_.in_bounds(at, model_));
    };
    return left_out_.errors(model_of, threads_, watch_);
  }

  /// The unknowns that are free without a law.
  std::vector<int> free_without(const Candidate& law) const {
    if (is_gain(law) && needs_gain(model_)) return {};
    std::vector<int> others = kept_.free;
    std::erase(others, number_of(law));
    return others;
  }

  Finding finding_of(const Candidate& law, const AxleFit& everything, const std::vector<double>& found,
                     std::mt19937_64& generator) const {
    const AxleFit& fit = is_free(kept_, law) ? kept_ : everything;
    Finding f;
    f.candidate = &law;
    f.estimate = fit.at;
    f.deviation = fit.deviation();
    f.z = z_of(law, f.estimate, f.deviation);
    if (!is_gain(law))
      f.deviation = (f.deviation.cwiseAbs2() + (radius_share_ * f.estimate).cwiseAbs2()).cwiseSqrt();
    f.p_value = family_wise(f.z);
    f.sure = is_free(kept_, law);
    if (!f.sure) {
      f.reason = kNotSignificant;
      return f;
    }
    measure(f);
    const std::vector<double> without = errors_with(free_without(law));
    f.axle_worsening_ci95 = interval_of(without, found, generator);
    f.claimed = f.material && helps(f.axle_worsening_ci95);
    f.confidence = f.claimed ? confidence_of(std::abs(f.z)) : 0.0;
    f.reason = !f.axle_worsening_ci95          ? "the axle was seen for too short a time to judge"
               : !helps(f.axle_worsening_ci95) ? predicts_no_better(without, found)
               : !f.material                   ? kImmaterial
                                               : kMaterial;
    return f;
  }

  /// Of a law that fits, and does not help: the mean held-out errors without it and with it.
  static std::string predicts_no_better(const std::vector<double>& without, const std::vector<double>& with) {
    return "significant, but the axle's held-out direction is predicted no better: " +
           shown_rounded(mean_of(without) / kDegree) + " -> " + shown_rounded(mean_of(with) / kDegree) +
           " deg";
  }

  /// How far a law turns the axle, and where that matters.
  void measure(Finding& f) const {
    UnknownVector without = UnknownVector::Zero();
    for (const int u : free_without(*f.candidate)) without[u] = kept_.at[u];
    const std::vector<Eigen::Matrix3Xd> with = stretches_->predicted(with_axle(model_, kept_.at), threads_,
                                                                     watch_),
                                        rest = stretches_->predicted(with_axle(model_, without), threads_,
                                                                     watch_);
    std::vector<double> turns;
    for (std::size_t i = 0; i < with.size(); ++i) {
      const AxleStretch& stretch = stretches_->all()[i];
      const double turn =
          angle_between(with[i].rightCols<1>(), rest[i].rightCols<1>()) / std::max(stretch.seconds, 0.1);
      if (stretches_->is_far_enough(i)) turns.push_back(turn);
      if (turn > kSmallestTurn)
        for (std::size_t w = stretch.first; w <= stretch.last; ++w) f.windows.push_back(stretch.windows + w);
    }
    std::ranges::sort(turns);
    f.size = turns.empty() ? 0.0 : quantile(turns, 0.9);
    f.material = f.size > kSmallestTurn;
  }

  /// Fits again without the laws that left-out stretches deny.
  void keep_what_helps(const std::vector<Finding>& findings) {
    for (const Finding& f : findings)
      if (is_free(kept_, *f.candidate) && !helps(f.axle_worsening_ci95))
        kept_ = without_law(kept_, *f.candidate, *stretches_, model_, threads_, watch_);
  }

  /// Of the mean difference. Stretches share no data; how long they depend on each other is asked as far as
  /// enough blocks are left.
  static std::optional<Interval> interval_of(const std::vector<double>& more, const std::vector<double>& less,
                                             std::mt19937_64& generator) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < more.size(); ++i) differences.push_back(more[i] - less[i]);
    const std::size_t most = std::max<std::size_t>(1, differences.size() / kFewestBlocks);
    return mean_interval(differences, std::min(most, dependence_length(differences)), generator);
  }

  /// Nothing where there is nothing to compare.
  std::optional<AxleAhead> compared(std::mt19937_64& generator) const {
    const auto base_of = [&](const AxlePart&) { return model_; };
    const std::vector<double> base = left_out_.errors(base_of, threads_, watch_),
                              found = errors_with(kept_.free);
    if (base.empty()) return std::nullopt;
    return AxleAhead{left_out_.whole_recordings(),
                     mean_of(left_out_.seconds()),
                     mean_of(left_out_.errors_of_constant()),
                     mean_of(base),
                     mean_of(found),
                     interval_of(base, found, generator)};
  }

  const AxleStretches* stretches_;
  AxleLeftOut left_out_;
  Model model_;
  Bank laws_;
  double radius_share_;
  int threads_;
  FitWatch watch_;
  AxleFit kept_;
};

}  // namespace diagnose_detail

}  // namespace diabolo
