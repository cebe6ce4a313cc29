// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "diabolo/recording/plausibility/swapped_bodies.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

// Bodies that do not fit each other. A taut string has one length: of the paths from tip to tip over the
// diabolo, the share within 20 mm of each other is largest where all three are as they were.
namespace diabolo {

/// How much oftener the string must have one length where the bodies are matched otherwise, and how often.
inline constexpr double kClearlyOftener = 1.5, kLeastTaut = 0.4;

/// Share of the rows in which the string has its most frequent length, where the diabolo is that of the row
/// so many later, and each body's coordinates are made others by a matrix of its own; 0 where too few tell.
/// At most 2000 rows are looked at.
inline double share_of_one_length(const Recording& r, Eigen::Index later,
                                  const std::array<Eigen::Matrix3d, 3>& left_right_diabolo) {
  constexpr Eigen::Index kMostRows = 2000;
  const auto& [left, right, diabolo] = left_right_diabolo;
  const Eigen::Index every = std::max<Eigen::Index>(1, r.size() / kMostRows);
  std::vector<double> lengths;
  for (Eigen::Index i = std::max<Eigen::Index>(0, -later); i < std::min(r.size(), r.size() - later);
       i += every) {
    if (!r.left.valid[i] || !r.right.valid[i] || !r.diabolo.valid[i + later]) continue;
    const Eigen::Vector3d at = diabolo * r.diabolo.position.col(i + later);
    lengths.push_back((left * r.left.position.col(i) - at).norm() +
                      (right * r.right.position.col(i) - at).norm());
  }
  if (static_cast<double>(lengths.size() * static_cast<std::size_t>(every)) < kFewestSeconds * r.rate)
    return 0.0;
  std::ranges::sort(lengths);
  return static_cast<double>(densest_lengths(lengths).second) / static_cast<double>(lengths.size());
}

/// All bodies as they were recorded.
inline std::array<Eigen::Matrix3d, 3> as_recorded() {
  return {Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
}

/// Longest shift that is looked for [s], and the least that is told.
inline constexpr double kLongestShift = 1.0, kLeastShift = 0.05;

/// A clause about tips that fit the diabolo at another time; else empty.
inline std::string odd_shift(const Recording& r) {
  if (static_cast<double>(r.size()) < kFewestSeconds * r.rate) return {};
  const double now = share_of_one_length(r, 0, as_recorded());
  const Eigen::Index longest = std::lround(kLongestShift * r.rate),
                     step = std::max<Eigen::Index>(1, std::lround(0.02 * r.rate));
  Eigen::Index best = 0;
  double most = now;
  for (Eigen::Index shift = -longest; shift <= longest; shift += step)
    if (const double share = share_of_one_length(r, shift, as_recorded()); share > most)
      most = share, best = shift;
  if (most < kLeastTaut || most < kClearlyOftener * now ||
      static_cast<double>(std::abs(best)) < kLeastShift * r.rate)
    return {};
  return "the string has its length where the diabolo is taken " +
         shown_rounded(static_cast<double>(std::abs(best)) / r.rate) + " s " +
         (best > 0 ? "later" : "earlier") + " than the tips: they are shifted against each other";
}

/// A clause about one body whose axes are others than those of the other two; else empty.
inline std::string odd_axes(const Recording& r) {
  using recording_plausibility_detail::kBodies;
  constexpr std::array kAxes{"x", "y", "z"};
  const double now = share_of_one_length(r, 0, as_recorded());
  double most = std::max(kLeastTaut, kClearlyOftener * now);
  std::string clause;
  const auto ask = [&](std::size_t body, const Eigen::Matrix3d& made, const std::string& what) {
    std::array<Eigen::Matrix3d, 3> bodies = as_recorded();
    bodies[body] = made;
    const double share = share_of_one_length(r, 0, bodies);
    if (share <= most) return;
    most = share;
    clause = "the string has one length in " + std::to_string(std::lround(100.0 * now)) +
             " % of the rows, and in " + std::to_string(std::lround(100.0 * share)) + " % where the " +
             kBodies[body] + "'s " + what + ": check its columns";
  };
  for (std::size_t body = 0; body < kBodies.size(); ++body)
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3;
      const std::string name = kAxes[static_cast<std::size_t>(axis)];
      Eigen::Matrix3d mirrored = Eigen::Matrix3d::Identity(), exchanged = mirrored;
      mirrored(axis, axis) = -1.0;
      exchanged.col(axis).swap(exchanged.col(next));
      ask(body, mirrored, name + " is taken the other way round");
      ask(body, exchanged, name + " and " + kAxes[static_cast<std::size_t>(next)] + " are exchanged");
    }
  return clause;
}

}  // namespace diabolo
