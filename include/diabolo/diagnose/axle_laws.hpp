// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "diabolo/diagnose/axle_selection.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/time_budget.hpp"
#include "diabolo/math/bootstrap.hpp"

namespace diabolo {

/// A law of the axle is claimed only where it turns it by so much in a second, in the most affected tenth of
/// the stretches [rad].
inline constexpr double kSmallestTurn = 3.0 * kDegree;

/// What the axle's recorded direction says of the laws that turn it.
struct AxleAnswer {
  std::vector<Finding> findings;
  UnknownVector at = UnknownVector::Zero(), deviation = at;  ///< of the laws that are sure and help
  std::optional<AxleAhead> ahead;                            ///< nothing where the axle was not seen
};

namespace diagnose_detail {

/// Half a turn where a prediction came to nothing.
inline double angle_between(const Vector3<double>& predicted, const Vector3<double>& seen) {
  const double angle = std::atan2(predicted.cross(seen).norm(), predicted.dot(seen));
  return std::isfinite(angle) ? angle : std::numbers::pi;
}

/// Asks for the laws of the axle, keeps those that are sure, and judges them on stretches that were left out.
class AxleInquiry {
 public:
  /// `radius_share` is how well the axle's radius is known, a standard deviation over its size: what lies
  /// along the axle is seen as a share of it.
  AxleInquiry(const Fit& fit, const Model& model, const Bank& laws, double radius_share, int threads,
              const FitWatch& watch)
      : stretches_(fit),
        model_(model),
        laws_(laws),
        radius_share_(radius_share),
        threads_(threads),
        watch_(watch) {
    double longest = 0.0;
    for (const AxleStretch& stretch : stretches_.all()) longest = std::max(longest, stretch.seconds);
    far_enough_ = kFarEnough * std::min(longest, 1.0);
    std::vector<std::size_t> takes;
    for (const AxleStretch& stretch : stretches_.all()) takes.push_back(stretch.fit_take);
    several_ = !takes.empty() && takes.front() != takes.back();
  }

  /// Nothing where time is up.
  AxleAnswer answer(std::uint64_t seed) {
    AxleAnswer result;
    if (stretches_.all().empty() || laws_.empty()) return result;
    const AxleFit everything = fit_all_axle_laws(stretches_, model_, laws_, threads_, watch_);
    kept_ = keep_sure_axle_laws(everything, stretches_, model_, laws_, threads_, watch_);
    if (watch_.is_enough()) return {};
    std::mt19937_64 generator(seed);
    const std::vector<double> found = errors_left_out(kept_.free);
    for (const Candidate* law : laws_) {
      if (watch_.is_enough()) return {};
      result.findings.push_back(finding_of(*law, everything, found, generator));
    }
    keep_what_helps(result.findings);
    result.ahead = compared(generator);
    const bool better = result.ahead && helps(result.ahead->improvement_ci95);
    for (Finding& f : result.findings) f.claimed = f.claimed && better && is_free(kept_, *f.candidate);
    if (!better) return result;
    result.at = kept_.at;
    for (const Finding& f : result.findings)
      if (is_free(kept_, *f.candidate))
        result.deviation[number_of(*f.candidate)] = f.deviation[number_of(*f.candidate)];
    return result;
  }

 private:
  static bool helps(const std::optional<Interval>& gain) { return gain && gain->low > 0.0; }
  bool is_far_enough(std::size_t i) const { return stretches_.all()[i].seconds >= far_enough_; }

  /// Angles at the ends of stretches that count between what such unknowns predict and what was seen [rad].
  template <class Counts>
  std::vector<double> errors(const UnknownVector& at, const Counts& counts) const {
    const auto asked = [&](std::size_t i) { return is_far_enough(i) && counts(i); };
    const std::vector<Eigen::Matrix3Xd> seen = stretches_.seen(),
                                        here = stretches_.predicted(with_axle(model_, at), threads_, watch_,
                                                                    asked);
    std::vector<double> result;
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (asked(i)) result.push_back(angle_between(here[i].rightCols<1>(), seen[i].rightCols<1>()));
    return result;
  }

  /// Angles for each part of the stretches by unknowns that the others say, in the order of all.
  std::vector<double> errors_left_out(const std::vector<int>& free) const {
    if (free.empty()) return errors(UnknownVector::Zero(), every_stretch);
    std::vector<double> result;
    for (std::size_t part = 0; part <= part_of(stretches_.all().size() - 1); ++part) {
      const auto left_out = [&](std::size_t i) { return part_of(i) == part; };
      const UnknownVector others =
          kept_.in_bounds(kept_.estimate(free, [&](std::size_t i) { return !left_out(i); }));
      const std::vector<double> own = errors(others, left_out);
      result.insert(result.end(), own.begin(), own.end());
    }
    return result;
  }

  /// Whole recordings where several show their axle; else thirds of the stretches.
  std::size_t part_of(std::size_t i) const {
    constexpr std::size_t kParts = 3;
    return several_ ? stretches_.all()[i].fit_take : i * kParts / stretches_.all().size();
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
      f.reason = "too small to be told from nothing";
      return f;
    }
    measure(f);
    f.axle_worsening_ci95 = interval_of(errors_left_out(free_without(law)), found, generator);
    f.claimed = f.material && helps(f.axle_worsening_ci95);
    f.confidence = f.claimed ? confidence_of(std::abs(f.z)) : 0.0;
    f.reason = !f.axle_worsening_ci95          ? "the axle was seen for too short a time to judge"
               : !helps(f.axle_worsening_ci95) ? "does not help on data that were left out"
               : !f.material                   ? "there, but too small to matter"
                                               : "sure, and large enough to matter";
    return f;
  }

  /// How far a law turns the axle, and where that matters.
  void measure(Finding& f) const {
    UnknownVector without = UnknownVector::Zero();
    for (const int u : free_without(*f.candidate)) without[u] = kept_.at[u];
    const std::vector<Eigen::Matrix3Xd> with = stretches_.predicted(with_axle(model_, kept_.at), threads_,
                                                                    watch_),
                                        rest = stretches_.predicted(with_axle(model_, without), threads_,
                                                                    watch_);
    std::vector<double> turns;
    for (std::size_t i = 0; i < with.size(); ++i) {
      const AxleStretch& stretch = stretches_.all()[i];
      const double turn =
          angle_between(with[i].rightCols<1>(), rest[i].rightCols<1>()) / std::max(stretch.seconds, 0.1);
      if (is_far_enough(i)) turns.push_back(turn);
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
        kept_ = without_law(kept_, *f.candidate, stretches_, model_, threads_, watch_);
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

  std::optional<AxleAhead> compared(std::mt19937_64& generator) const {
    const std::vector<double> base = errors(UnknownVector::Zero(), every_stretch),
                              found = errors_left_out(kept_.free);
    std::vector<double> seconds;
    for (std::size_t i = 0; i < stretches_.all().size(); ++i)
      if (is_far_enough(i)) seconds.push_back(stretches_.all()[i].seconds);
    return AxleAhead{mean_of(seconds), mean_of(base), mean_of(found), interval_of(base, found, generator)};
  }

  AxleStretches stretches_;
  Model model_;
  Bank laws_;
  double radius_share_;
  int threads_;
  FitWatch watch_;
  double far_enough_ = 0.0;  ///< [s]
  bool several_ = false;     ///< recordings whose axle was seen
  AxleFit kept_;
};

}  // namespace diagnose_detail

}  // namespace diabolo
