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
#include "diabolo/math/bootstrap.hpp"

namespace diabolo {

/// A law of the axle is claimed only where it turns it by so much in a second, in the most affected tenth of
/// the stretches [rad].
inline constexpr double kSmallestTurn = 3.0 * kDegree;

/// What the axle's recorded direction says of the laws that turn it.
struct AxleAnswer {
  std::vector<Finding> findings;
  UnknownVector at = UnknownVector::Zero();  ///< of the laws that are sure, if they help on left-out data
  std::optional<AxleAhead> ahead;            ///< nothing where the axle was not seen for long enough
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
              const Watch& watch)
      : fit_(&fit),
        stretches_(fit),
        model_(model),
        laws_(laws),
        radius_share_(radius_share),
        threads_(threads),
        watch_(watch) {}

  AxleAnswer answer(std::uint64_t seed) {
    AxleAnswer result;
    if (stretches_.all().empty() || laws_.empty()) return result;
    const AxleFit everything = fit_all_axle_laws(stretches_, model_, laws_, threads_, watch_);
    kept_ = keep_sure_axle_laws(everything, stretches_, model_, laws_, threads_, watch_);
    const std::vector<double> base = errors(UnknownVector::Zero()), found = errors_left_out(kept_.free);
    std::mt19937_64 generator(seed);
    for (const Candidate* law : laws_)
      result.findings.push_back(finding_of(*law, everything, found, generator));
    result.ahead = compared(base, found, generator);
    if (result.ahead && result.ahead->improvement_ci95 && result.ahead->improvement_ci95->low > 0.0)
      result.at = kept_.at;
    return result;
  }

 private:
  bool far_enough(std::size_t i) const { return stretches_.all()[i].seconds >= kFarEnoughAhead; }

  /// Angles at the stretches' ends between what such unknowns predict and what was seen, of those that are
  /// far enough [rad].
  std::vector<double> errors(const UnknownVector& at) const {
    return errors(at, [](std::size_t) { return true; });
  }
  template <class Counts>
  std::vector<double> errors(const UnknownVector& at, const Counts& counts) const {
    const std::vector<Eigen::Matrix3Xd> seen = stretches_.seen(),
                                        here = stretches_.predicted(with_axle(model_, at), threads_, watch_);
    std::vector<double> result;
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (far_enough(i) && counts(i))
        result.push_back(angle_between(here[i].rightCols<1>(), seen[i].rightCols<1>()));
    return result;
  }

  /// The same for each part of the stretches by unknowns that the others say.
  std::vector<double> errors_left_out(const std::vector<int>& free) const {
    if (free.empty()) return errors(UnknownVector::Zero());
    std::vector<double> result;
    const std::size_t parts = std::max<std::size_t>(kParts, fit_->fit_takes.size());
    for (std::size_t part = 0; part < parts; ++part) {
      const auto left_out = [&](std::size_t i) { return part_of(i) == part; };
      const std::vector<double> own =
          errors(kept_.estimate(free, [&](std::size_t i) { return !left_out(i); }), left_out);
      result.insert(result.end(), own.begin(), own.end());
    }
    return result;
  }

  /// Whole recordings where there are several; else thirds of the only one.
  std::size_t part_of(std::size_t i) const {
    if (fit_->fit_takes.size() > 1) return stretches_.all()[i].fit_take;
    return i * kParts / stretches_.all().size();
  }

  Finding finding_of(const Candidate& law, const AxleFit& everything, const std::vector<double>& found,
                     std::mt19937_64& generator) const {
    const AxleFit& fit = is_free(kept_, law) ? kept_ : everything;
    Finding f;
    f.candidate = &law;
    f.estimate = fit.at;
    f.deviation = fit.deviation();
    f.z = z_of(law, f.estimate, f.deviation);
    if (number_of(law) != index_of(Unknown::kGyroscopicGain))
      f.deviation = (f.deviation.cwiseAbs2() + (radius_share_ * f.estimate).cwiseAbs2()).cwiseSqrt();
    f.p_value = family_wise(f.z);
    f.sure = is_free(kept_, law);
    if (!f.sure) {
      f.reason = "too small to be told from nothing";
      return f;
    }
    measure(f);
    std::vector<int> others = kept_.free;
    std::erase(others, number_of(law));
    if (number_of(law) == index_of(Unknown::kGyroscopicGain)) others.clear();
    f.axle_worsening_ci95 = interval_of(errors_left_out(others), found, generator);
    const bool helps = f.axle_worsening_ci95 && f.axle_worsening_ci95->low > 0.0;
    f.claimed = f.material && helps;
    f.confidence = f.claimed ? confidence_of(std::abs(f.z)) : 0.0;
    f.reason = !f.material ? "there, but too small to matter"
               : !helps    ? "does not help on data that were left out"
                           : "sure, and large enough to matter";
    return f;
  }

  /// How far a law turns the axle, and where that matters.
  void measure(Finding& f) const {
    UnknownVector without = kept_.at;
    without[number_of(*f.candidate)] = 0.0;
    if (number_of(*f.candidate) == index_of(Unknown::kGyroscopicGain)) without.setZero();
    const std::vector<Eigen::Matrix3Xd> with = stretches_.predicted(with_axle(model_, kept_.at), threads_,
                                                                    watch_),
                                        rest = stretches_.predicted(with_axle(model_, without), threads_,
                                                                    watch_);
    std::vector<double> turns;
    for (std::size_t i = 0; i < with.size(); ++i) {
      const AxleStretch& stretch = stretches_.all()[i];
      const double turn =
          angle_between(with[i].rightCols<1>(), rest[i].rightCols<1>()) / std::max(stretch.seconds, 0.1);
      if (far_enough(i)) turns.push_back(turn);
      if (turn > kSmallestTurn)
        for (std::size_t w = stretch.first; w <= stretch.last; ++w) f.windows.push_back(stretch.windows + w);
    }
    std::ranges::sort(turns);
    f.size = turns.empty() ? 0.0 : quantile(turns, 0.9);
    f.material = f.size > kSmallestTurn;
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

  std::optional<AxleAhead> compared(const std::vector<double>& base, const std::vector<double>& found,
                                    std::mt19937_64& generator) const {
    if (base.empty()) return {};
    std::vector<double> seconds;
    for (const AxleStretch& stretch : stretches_.all())
      if (stretch.seconds >= kFarEnoughAhead) seconds.push_back(stretch.seconds);
    return AxleAhead{mean_of(seconds), mean_of(base), mean_of(found), interval_of(base, found, generator),
                     base.size()};
  }

  static constexpr std::size_t kParts = 3;
  const Fit* fit_;
  AxleStretches stretches_;
  Model model_;
  Bank laws_;
  double radius_share_;
  int threads_;
  Watch watch_;
  AxleFit kept_;
};

}  // namespace diagnose_detail

}  // namespace diabolo
