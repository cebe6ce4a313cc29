// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/math/cubic_spline.hpp"
#include "diabolo/plan/ranges.hpp"
#include "diabolo/plan/tip_path.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// How the spline of the tips ends.
enum class SplineEnds {
  kClamped,   ///< at rest
  kPeriodic,  ///< in the pose that it began in, with the same velocity and acceleration: a loop
};

/// Motion that a spline goes on from, beside its first point.
template <class Scalar>
struct SplineStart {
  TipColumn<Scalar> velocity = TipColumn<Scalar>::Constant(Scalar(0));      ///< [m/s]
  TipColumn<Scalar> acceleration = TipColumn<Scalar>::Constant(Scalar(0));  ///< [m/s^2]
};

/// How soon the acceleration that a spline goes on from gives way to its own [s].
inline constexpr double kSettling = 0.06;

/// A motion of the stick tips by control points: piecewise cubics with continuous velocity and acceleration,
/// one for each stick and coordinate (paper, section III-B). It starts at rest, or goes on from a given
/// velocity and acceleration (one more point kSettling after the first, or in the middle of a short interval,
/// not a control point, then makes the acceleration right).
template <class Scalar>
struct StickSpline {
  static_assert(ScalarTraits<Scalar>::kLanes == 1, "one motion a lane, see TipPath");
  Scalar begin{0};                        ///< time of the first point [s]
  std::vector<Scalar> durations;          ///< between the points [s]
  std::vector<TipColumn<Scalar>> points;  ///< one more than durations [m]; of a loop, first = last
  SplineEnds ends = SplineEnds::kClamped;
  std::optional<SplineStart<Scalar>> start{};  ///< at rest where it is not given; not for loops
  /// Directions of both sticks throughout, unit vectors, left over right; zero where they are not known.
  TipColumn<double> sticks = TipColumn<double>::Zero();

  Scalar end() const {
    Scalar time = begin;
    for (const Scalar& duration : durations) time += duration;
    return time;
  }

  /// Throws std::invalid_argument where there are not enough points, a number is not finite or beyond what
  /// play comes to (see ranges.hpp), a direction is none, or a loop does not close.
  void validate() const {
    if (points.size() < 2 || durations.size() + 1 != points.size())
      throw std::invalid_argument("stick spline: " + std::to_string(points.size()) + " points and " +
                                  std::to_string(durations.size()) +
                                  " durations; expected at least two points, and a duration less");
    const auto number = [](const Scalar& x) { return static_cast<double>(value_of(x)); };
    const auto check = [&number](const auto& column, const std::string& what, double most, const char* unit) {
      for (int k = 0; k < 6; ++k) check_size("stick spline, " + what, number(column[k]), most, unit);
    };
    check_size("stick spline, begin", number(begin), kLatest, "s");
    for (std::size_t i = 0; i < durations.size(); ++i)
      if (const double s = number(durations[i]); !(s >= kShortestDuration && s <= kLatest))
        throw std::invalid_argument("stick spline, duration " + std::to_string(i) + ": " + shown(s) +
                                    " s; must be within " + shown(kShortestDuration) + " and " +
                                    shown(kLatest) + " s");
    for (std::size_t i = 0; i < points.size(); ++i)
      check(points[i], "point " + std::to_string(i), kFarthest, "m");
    if (start) {
      check(start->velocity, "velocity of its start", kFastest, "m/s");
      check(start->acceleration, "acceleration of its start", kMostAcceleration, "m/s^2");
    }
    if (!is_direction<double>(sticks.head<3>()) || !is_direction<double>(sticks.tail<3>()))
      throw std::invalid_argument("stick spline: a stick's direction is neither a unit vector nor zero");
    if (ends == SplineEnds::kClamped) return;
    if (points.size() < 4) throw std::invalid_argument("stick spline: a loop needs at least four points");
    if (start) throw std::invalid_argument("stick spline: a loop has no start velocity of its own");
    for (int k = 0; k < 6; ++k)
      if (!all(absolute<Scalar>(points.front()[k] - points.back()[k]) <= Scalar(1e-12)))
        throw std::invalid_argument("stick spline: a loop must end in its first point");
  }
};

namespace plan_detail {

/// A tip column, and in the seventh row a spline of numbers that all of them may add a multiple of.
template <class Scalar>
using SplineColumn = Eigen::Matrix<Scalar, 7, 1>;

template <class Scalar>
SplineColumn<Scalar> spline_column(const TipColumn<Scalar>& tips, double seventh) {
  SplineColumn<Scalar> result;
  result << tips, Scalar(seventh);
  return result;
}

}  // namespace plan_detail

/// The path of a spline. Throws std::invalid_argument where the spline is no valid one.
template <class Scalar>
TipPath<Scalar> path_of(const StickSpline<Scalar>& spline) {
  using Column = plan_detail::SplineColumn<Scalar>;
  spline.validate();
  const TipColumn<Scalar> zero = TipColumn<Scalar>::Constant(Scalar(0));
  std::vector<Scalar> h = spline.durations;
  std::vector<Column> y;
  for (const TipColumn<Scalar>& point : spline.points)
    y.push_back(plan_detail::spline_column<Scalar>(point, 0.0));
  const bool loop = spline.ends == SplineEnds::kPeriodic;
  Column first = plan_detail::spline_column<Scalar>(zero, loop ? 1.0 : 0.0), last = first;
  if (spline.start) {
    first.template head<6>() = spline.start->velocity;
    const Scalar settling = minimum(Scalar(h[0] * Scalar(0.5)), Scalar(kSettling)),
                 share_of = settling / h[0];
    h.front() = h.front() - settling;
    h.insert(h.begin(), settling);
    const TipColumn<Scalar> between =
        spline.points[0] + TipColumn<Scalar>(spline.points[1] - spline.points[0]) * share_of;
    y.insert(y.begin() + 1, plan_detail::spline_column<Scalar>(between, 1.0));
  }
  std::vector<Column> m = spline_curvatures(h, y, std::optional(EndSlopes<Column>{first, last}));
  // The seventh spline takes care of one condition: of a loop, the same acceleration at both ends, by their
  // common velocity; of one that goes on, its first acceleration, by the point in between.
  TipColumn<Scalar> share = zero;
  if (loop)
    share = (m.back() - m.front()).template head<6>() * Scalar(Scalar(1) / (m.front()[6] - m.back()[6]));
  if (spline.start)
    share = (spline.start->acceleration - m.front().template head<6>()) * Scalar(Scalar(1) / m.front()[6]);
  const auto whole = [&share](const Column& column) {
    return TipColumn<Scalar>(column.template head<6>() + share * column[6]);
  };
  std::vector<TipPiece<Scalar>> pieces(h.size());
  Scalar time = spline.begin;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const TipColumn<Scalar> a = whole(y[i]), b = whole(y[i + 1]), p = whole(m[i]), q = whole(m[i + 1]);
    const Scalar inverse = Scalar(1) / h[i], sixth = h[i] * Scalar(1.0 / 6.0);
    pieces[i].begin = time;
    pieces[i].duration = h[i];
    pieces[i].sticks = spline.sticks;
    pieces[i].c = {a, TipColumn<Scalar>((b - a) * inverse - (p * Scalar(2) + q) * sixth),
                   TipColumn<Scalar>(p * Scalar(0.5)),
                   TipColumn<Scalar>((q - p) * Scalar(inverse * Scalar(1.0 / 6.0)))};
    time += h[i];
  }
  return TipPath<Scalar>(std::move(pieces));
}

}  // namespace diabolo
