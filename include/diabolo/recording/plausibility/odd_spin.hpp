// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/recording/plausibility/odd_axle.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/spin.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Fastest spin of play that is thought of [rad/s], some 50 turns a second: half as fast again as players
/// are known to reach.
inline constexpr double kFastestSpin = 320.0;

/// What the turns from row to row say about the spin. A whole turn more per row looks the same: orientations
/// tell the spin up to a multiple of twice largest_spin() alone. While it stays within the band of
/// largest_spin() it steps by less than that from one row to the next; where it leaves the band, it
/// comes back on the other side, and steps by more.
class SpinBand {
 public:
  explicit SpinBand(const Recording& r) : band_(largest_spin(r.rate)), least_(kLeastAxleTurn * r.rate) {
    const Spin spin = signed_spin(r);
    std::vector<double> known;
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (spin.valid[i]) known.push_back(spin.value[i]);
    if (known.size() < 20 || static_cast<double>(known.size()) < kFewestSeconds * r.rate) return;
    double before = known[0];
    for (std::size_t i = 1; i + 1 < known.size(); ++i) {  // the middle one of three: no single glitch
      const double low = std::min(known[i - 1], known[i + 1]), high = std::max(known[i - 1], known[i + 1]),
                   now = std::clamp(known[i], low, high);
      leaves_ = leaves_ || std::abs(now - before) > band_;
      before = now;
    }
    std::ranges::sort(known);
    low_ = known[known.size() / 20];
    high_ = known[known.size() - 1 - known.size() / 20];
  }

  /// Whether the spin left the band while it was recorded.
  bool leaves() const { return leaves_; }
  /// Whether a turn more or less per row is as slow as play, where the diabolo turns at all.
  bool is_open() const { return std::max(-low_, high_) > least_ && other() != 0.0; }
  /// Whether it turns one way and then the other, as no diabolo does that is to keep its axle up.
  bool reverses() const { return low_ < -least_ && high_ > least_; }

  /// "100 to 180 rad/s": the middle nine tenths, as they look or by one turn per row beside.
  std::string text(double beside = 0.0) const {
    return shown(0.0 + std::round(low_ + beside)) + " to " + shown(0.0 + std::round(high_ + beside)) +
           " rad/s";
  }
  /// What a turn per row adds to get to the slower of both neighbours; zero where it is too fast for play.
  double other() const {
    const double shift = low_ + high_ > 0.0 ? -2.0 * band_ : 2.0 * band_;
    return std::max(std::abs(low_ + shift), std::abs(high_ + shift)) < kFastestSpin ? shift : 0.0;
  }
  double band() const { return band_; }

 private:
  double band_, least_, low_ = 0.0, high_ = 0.0;
  bool leaves_ = false;
};

/// A clause about a spin that the rate does not show: it left the band, or reverses where another one is as
/// likely; else empty.
inline std::string odd_spin(const Recording& r) {
  const SpinBand spin(r);
  if (spin.leaves())
    return "the diabolo turns by more than half a turn from row to row: at " + shown(r.rate) +
           " Hz a spin beyond " + shown(std::round(spin.band())) + " rad/s looks like a slower one";
  if (spin.is_open() && spin.reverses())
    return "the diabolo's spin seems to reverse, from " + spin.text() + ", and may as well be " +
           spin.text(spin.other()) + ": at " + shown(r.rate) + " Hz a turn more per row looks the same";
  return {};
}

/// A clause about a spin that is taken for the slower one of two that look the same; else empty.
inline std::string open_spin(const Recording& r) {
  const SpinBand spin(r);
  if (!spin.is_open()) return {};
  return "the diabolo's spin is read as " + spin.text() + " and may as well be " + spin.text(spin.other()) +
         ": at " + shown(r.rate) + " Hz a turn more per row looks the same, and " +
         shown(std::ceil(kFastestSpin / largest_spin(1.0))) + " Hz or more show which";
}

}  // namespace diabolo
