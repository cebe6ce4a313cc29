// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/recording/plausibility/fall.hpp"
#include "diabolo/recording/plausibility/odd_stretches.hpp"
#include "diabolo/recording/plausibility/swapped_bodies.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Largest share of the rows of a still tip in which the diabolo may neither fall freely nor be where the
/// taut string has it [m from the usual path]; catches take some.
inline constexpr double kMostUnexplained = 0.1, kOffUsualPath = 0.03;

/// A clause about a tip that rests to the last digit while the diabolo moves as if it did not; else empty. On
/// a taut string the path over the diabolo has its usual length; off it, or slack, the diabolo falls freely.
inline std::string odd_still_tips(const Recording& r, const std::vector<Fall>& falls) {
  const double usual = usual_path_length(r).value_or(r.string_length);
  const Eigen::Vector3d gravity(0.0, 0.0, -Parameters<double>{}.gravity);
  std::string sides;
  double longest = 0.0;
  for (const auto& [name, tip] : {std::pair{"left", &r.left}, std::pair{"right", &r.right}}) {
    std::pair<Eigen::Index, Eigen::Index> still{0, 0};  // first and last row of the longest rest
    for_each_rest(*tip, [&still](Eigen::Index first, Eigen::Index last) {
      if (last - first > still.second - still.first) still = {first, last};
    });
    if (r.size() == 0 || !(r.time[still.second] - r.time[still.first] > kFewestSeconds)) continue;
    Eigen::Index fitted = 0, unexplained = 0;
    for (const Fall& fall : falls) {
      if (fall.row < still.first || fall.row > still.second) continue;
      ++fitted;
      unexplained += std::abs(path_at(r, fall.row).length() - usual) > kOffUsualPath &&
                     (fall.acceleration - gravity).norm() > 0.5 * gravity.norm();
    }
    if (static_cast<double>(unexplained) <= kMostUnexplained * static_cast<double>(fitted)) continue;
    sides += (sides.empty() ? "" : " and the ") + std::string(name) + " tip";
    longest = std::max(longest, r.time[still.second] - r.time[still.first]);
  }
  if (sides.empty()) return {};
  return "the " + sides + " rest" + (sides.find(" and ") == sides.npos ? "s" : "") +
         " to the last digit for " + shown_rounded(longest) +
         " s while the diabolo moves as no string from there allows: frozen tracking";
}

/// A clause about tips that are farther apart than the string is long in many rows; else empty.
inline std::string odd_distance(const Recording& r) {
  constexpr double kMost = 0.05;  // share of rows
  Eigen::Index known = 0, apart = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!r.left.valid[i] || !r.right.valid[i]) continue;
    ++known;
    apart += (r.left.position.col(i) - r.right.position.col(i)).norm() > r.string_length + kOddPathLength;
  }
  const double share = static_cast<double>(apart) / static_cast<double>(std::max<Eigen::Index>(1, known));
  if (static_cast<double>(known) < kFewestSecondsOfNoPlay * r.rate || known < 20 || share <= kMost) return {};
  return "the tips are farther apart than the string is long, " + shown(r.string_length) + " m, in " +
         std::to_string(std::lround(100.0 * share)) + " % of the rows: wrong units, or another string";
}

/// Which way the left tip lies from the right one, a unit vector along x and y; nothing where it is not
/// clear.
inline std::optional<Eigen::Vector2d> across_tips(const Recording& r) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double length = 0.0;
  Eigen::Index known = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!r.left.valid[i] || !r.right.valid[i]) continue;
    ++known;
    const Eigen::Vector2d across = (r.left.position.col(i) - r.right.position.col(i)).head<2>();
    sum += across;
    length += across.norm();
  }
  if (static_cast<double>(known) < kFewestSeconds * r.rate || known < 20) return {};
  if (!(sum.norm() > 0.5 * length)) return {};
  return sum / sum.norm();
}

/// Quarter turns about the vertical by which the left tip lies off the left of the right one, which is along
/// y: 1 behind it, -1 before it, 2 on its right; nothing where it is not clear.
inline std::optional<int> quarters_off(const Recording& r) {
  constexpr double kLeastAside = 0.4;  // share of what lies between the tips that is along y
  const std::optional<Eigen::Vector2d> across = across_tips(r);
  if (!across) return {};
  if (std::abs(across->y()) <= kLeastAside) return across->x() > 0.0 ? -1 : 1;
  return across->y() < 0.0 ? 2 : 0;
}

/// A clause about a left tip that does not lie on the left, or sticks whose directions say otherwise than
/// their tips; else empty.
inline std::string odd_heading(const Recording& r) {
  constexpr double kFarthestOff = 45.0;  // degrees
  const std::optional<Eigen::Vector2d> across = across_tips(r);
  const int quarters = quarters_off(r).value_or(0);
  const bool exchanged = sticks_are_exchanged(r).value_or(false);
  if (exchanged && across && quarters == 0)
    return "the left tip lies on the left, but not as seen along the sticks: their body x seems to point "
           "inwards, or the sticks are exchanged in a frame that is turned; expected body x outwards";
  if (exchanged && quarters != 1 && quarters != -1)
    return "seen along the sticks, the left one is on the right: they are under each other's names";
  if (!across) return {};
  const double off = std::abs(std::atan2(across->x(), across->y())) * 180.0 / std::numbers::pi;
  if (off <= kFarthestOff) return {};
  const std::string turned =
      "the frame is turned by some " + std::to_string(std::lround(off)) + " degrees about the vertical";
  if (quarters == 2)
    return "the left tip lies to the right of the right one: " + turned +
           ", or the sticks are exchanged; expected y to the left";
  return std::string("the left tip lies ") + (across->x() > 0.0 ? "before" : "behind") +
         " the right one: " + turned + ", and the spin's sign is not sure" +
         (exchanged ? "; seen along the sticks, they are under each other's names" : "") +
         "; expected y to the left";
}

}  // namespace diabolo
