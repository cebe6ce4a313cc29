// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/sticks.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Both tips in one column, left over right.
template <class Scalar>
using TipColumn = Eigen::Matrix<Scalar, 6, 1>;

/// A cubic of both tips over an interval: c[0] + c[1] s + c[2] s^2 + c[3] s^3, s [s] since its begin.
template <class Scalar>
struct TipPiece {
  Scalar begin{0}, duration{0};  ///< [s]
  std::array<TipColumn<Scalar>, 4> c;
  TipColumn<double> sticks = TipColumn<double>::Zero();  ///< their directions, as in Tips

  /// Position [m] and its first three derivatives [m/s, m/s^2, m/s^3] at `s` [s] after the begin.
  std::array<TipColumn<Scalar>, 4> at(const Scalar& s) const {
    return {TipColumn<Scalar>(((c[3] * s + c[2]) * s + c[1]) * s + c[0]),
            TipColumn<Scalar>((c[3] * Scalar(Scalar(3) * s) + c[2] * Scalar(2)) * s + c[1]),
            TipColumn<Scalar>(c[3] * Scalar(Scalar(6) * s) + c[2] * Scalar(2)),
            TipColumn<Scalar>(c[3] * Scalar(6))};
  }
};

/// Planned motion of the stick tips: cubics one after the other. Before the first and after the last one the
/// tips rest. May be followed by rollout() as a TipMotion may; its instants are Scalars too, so that
/// derivatives by them come out. An empty one has no times and no tips: asked for them it throws
/// std::invalid_argument.
template <class Scalar>
class TipPath {
  // An exception to the Scalar contract: no packs, whose lanes may each be in another piece.
  static_assert(ScalarTraits<Scalar>::kLanes == 1, "a path for each lane");

 public:
  static constexpr double kSameTips = 1e-6;  ///< where paths meet [m], [m/s]

  TipPath() = default;
  /// Throws std::invalid_argument where a duration is not positive or a piece does not begin where the one
  /// before it ends, within 1e-9 s.
  explicit TipPath(std::vector<TipPiece<Scalar>> pieces) : pieces_(std::move(pieces)) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const std::string where = "tip path, piece " + std::to_string(i) + ": ";
      if (!(pieces_[i].duration > Scalar(0)) || !is_finite(pieces_[i].duration))
        throw std::invalid_argument(where + "its duration must be positive and finite");
      if (i > 0 && !(absolute<Scalar>(pieces_[i].begin - end_of(i - 1)) < Scalar(1e-9)))
        throw std::invalid_argument(where + "must begin where the one before it ends");
    }
  }

  const std::vector<TipPiece<Scalar>>& pieces() const { return pieces_; }
  bool empty() const { return pieces_.empty(); }
  Scalar begin() const { return check(), pieces_.front().begin; }     ///< [s]
  Scalar end() const { return check(), end_of(pieces_.size() - 1); }  ///< [s]

  /// Position [m] and its first three derivatives, at a time [s] within the path or at its ends.
  std::array<TipColumn<Scalar>, 4> derivatives_at(double time) const {
    std::size_t hint = 0;
    const TipPiece<Scalar>& piece = piece_at(Scalar(time), hint);
    const Scalar s = Scalar(time) - piece.begin;
    return piece.at(minimum(maximum(s, Scalar(0)), piece.duration));
  }

  /// Tips at a time [s]. `hint` speeds up sequential reading: pass the same variable again.
  Tips<Scalar> at(const Scalar& time, std::size_t& hint) const {
    const TipPiece<Scalar>& piece = piece_at(time, hint);
    const Scalar s = time - piece.begin;
    const bool before = s<Scalar(0), after = s> piece.duration;
    const Scalar u = before ? Scalar(0) : after ? piece.duration : s;
    const TipColumn<Scalar> value = ((piece.c[3] * u + piece.c[2]) * u + piece.c[1]) * u + piece.c[0];
    Tips<Scalar> tips;
    tips.time = time;
    tips.left = value.template head<3>();
    tips.right = value.template tail<3>();
    tips.left_direction = piece.sticks.template head<3>().template cast<Scalar>();
    tips.right_direction = piece.sticks.template tail<3>().template cast<Scalar>();
    if (before || after) return tips;
    const TipColumn<Scalar> rate =
        (piece.c[3] * Scalar(Scalar(3) * u) + piece.c[2] * Scalar(2)) * u + piece.c[1];
    tips.left_velocity = rate.template head<3>();
    tips.right_velocity = rate.template tail<3>();
    return tips;
  }

  Tips<Scalar> at(double time) const {
    std::size_t hint = 0;
    return at(Scalar(time), hint);
  }

  /// Goes on with another path, moved in time to this one's end. Throws std::invalid_argument where they do
  /// not meet: tips and velocities within kSameTips.
  void append(const TipPath& next) {
    if (next.empty()) return;
    if (!empty()) {
      const auto last = pieces_.back().at(pieces_.back().duration),
                 first = next.pieces_.front().at(Scalar(0));
      for (const std::size_t order : {0u, 1u})
        for (int k = 0; k < 6; ++k)
          if (!(absolute<Scalar>(first[order][k] - last[order][k]) <= Scalar(kSameTips)))
            throw std::invalid_argument("tip path: what follows begins elsewhere, or moves otherwise there");
    }
    const TipPath moved = empty() ? next : next.begun_at(end());
    pieces_.insert(pieces_.end(), moved.pieces_.begin(), moved.pieces_.end());
  }

  /// The same motion from another time on [s].
  TipPath begun_at(const Scalar& time) const {
    TipPath result = *this;
    for (TipPiece<Scalar>& piece : result.pieces_) piece.begin += time - begin();
    return result;
  }

  /// The part up to a time [s] within the path; empty at its begin.
  TipPath until(double time) const {
    TipPath result;
    for (TipPiece<Scalar> piece : pieces_) {
      if (piece.begin >= Scalar(time)) break;
      piece.duration = minimum(piece.duration, Scalar(Scalar(time) - piece.begin));
      result.pieces_.push_back(piece);
    }
    return result;
  }

 private:
  Scalar end_of(std::size_t i) const { return pieces_[i].begin + pieces_[i].duration; }

  void check() const {
    if (pieces_.empty()) throw std::invalid_argument("tip path: empty");
  }

  const TipPiece<Scalar>& piece_at(const Scalar& time, std::size_t& hint) const {
    check();
    if (hint >= pieces_.size() || pieces_[hint].begin > time) hint = 0;
    while (hint + 1 < pieces_.size() && pieces_[hint + 1].begin <= time) ++hint;
    return pieces_[hint];
  }

  std::vector<TipPiece<Scalar>> pieces_;
};

/// Of samples [s].
inline constexpr double kShortestInterval = 1e-5;
inline constexpr double kMostSamples = 1e7;

/// Poses of the path every `interval` [s] or less, for whatever reads tips at given instants.
inline TipMotion<double> sampled(const TipPath<double>& path, double interval) {
  if (!(interval >= kShortestInterval && std::isfinite(interval)))
    throw std::invalid_argument("interval: " + shown(interval) + " s; must be finite and at least " +
                                shown(kShortestInterval) + " s");
  const double intervals = std::max(1.0, std::ceil((path.end() - path.begin()) / interval - 1e-9));
  if (intervals > kMostSamples)
    throw std::invalid_argument("interval: " + shown(interval) + " s; would be " + shown(intervals) +
                                " samples, expected " + shown(kMostSamples) + " at most");
  const auto count = static_cast<std::size_t>(intervals);
  std::vector<double> times;
  std::vector<Vector3<double>> left, right, left_stick, right_stick;
  std::size_t hint = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    times.push_back(path.begin() + share * (path.end() - path.begin()));
    const Tips<double> tips = path.at(times.back(), hint);
    left.push_back(tips.left);
    right.push_back(tips.right);
    left_stick.push_back(tips.left_direction);
    right_stick.push_back(tips.right_direction);
  }
  TipMotion<double> motion(times, left, right, Interpolation::kSpline);
  motion.point_along(left_stick, right_stick);
  return motion;
}

}  // namespace diabolo
