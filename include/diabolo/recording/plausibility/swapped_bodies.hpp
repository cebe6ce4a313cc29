// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// Rows in which bodies were recorded under each other's names.
struct Swaps {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;  ///< first and last of each stretch
  Eigen::Index count = 0;
};

namespace recording_plausibility_detail {

/// Which recorded body is which: entry b is where body b (left, right, diabolo) was recorded.
using Assignment = std::array<int, 3>;

inline constexpr std::array<Assignment, 6> kAssignments{
    {{0, 1, 2}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}}};

inline std::array<Track*, 3> tracks_of(Recording& r) { return {&r.left, &r.right, &r.diabolo}; }
inline std::array<OrientationTrack*, 3> orientations_of(Recording& r) {
  return {&r.left_orientation, &r.right_orientation, &r.diabolo_orientation};
}
inline constexpr std::array<const char*, 3> kBodies{"left tip", "right tip", "diabolo"};

/// Makes dropouts of a body's marked samples, with its orientation.
inline void make_dropouts(Recording& r, std::size_t body, const Marks& marks) {
  Track& track = *tracks_of(r)[body];
  OrientationTrack& turn = *orientations_of(r)[body];
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!marks[i]) continue;
    track.valid[i] = false;
    track.position.col(i).setConstant(kNaN);
    if (turn.empty()) continue;
    turn.valid[i] = false;
    turn.quaternion.col(i).setConstant(kNaN);
  }
}

}  // namespace recording_plausibility_detail

/// A body moves less than this between rows that are seen one after another [m]: beyond, names were mixed up,
/// where another assignment leaves less than a third of the way.
inline constexpr double kFarthestMove = 0.15;

/// Gives positions and orientations that jump to another body's place back to it. What most rows say is
/// right.
inline Swaps unswap(Recording& r) {
  using recording_plausibility_detail::Assignment;
  const Eigen::Index size = r.size();
  Recording source = r;
  const std::array<Track*, 3> from = recording_plausibility_detail::tracks_of(source);
  std::vector<std::size_t> chosen(static_cast<std::size_t>(size), 0);
  std::array<Eigen::Vector3d, 3> last;
  last.fill(Eigen::Vector3d::Zero());
  std::array<Eigen::Index, 3> seen{-1, -1, -1};
  std::array<std::size_t, 6> votes{};
  std::size_t now = 0;
  const auto recent = [&](int b, Eigen::Index i) {
    const std::size_t k = static_cast<std::size_t>(b);
    return seen[k] >= 0 && static_cast<double>(i - seen[k]) <= 0.05 * r.rate;
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    // The way of all bodies that are seen now and were just before.
    const auto way = [&](const Assignment& a) {
      double sum = 0.0;
      int known = 0;
      for (int b = 0; b < 3; ++b) {
        const Track& track = *from[static_cast<std::size_t>(a[static_cast<std::size_t>(b)])];
        if (!track.valid[i] || !recent(b, i)) continue;
        sum += (track.position.col(i) - last[static_cast<std::size_t>(b)]).norm();
        ++known;
      }
      return std::pair(sum, known);
    };
    const auto [stay, known] = way(recording_plausibility_detail::kAssignments[now]);
    if (known >= 2 && stay > kFarthestMove) {
      std::size_t best = now;
      double least = stay / 3.0;
      for (std::size_t a = 0; a < recording_plausibility_detail::kAssignments.size(); ++a) {
        const auto [sum, others] = way(recording_plausibility_detail::kAssignments[a]);
        if (others >= known && sum < least) least = sum, best = a;
      }
      now = best;
    }
    chosen[static_cast<std::size_t>(i)] = now;
    ++votes[now];
    for (int b = 0; b < 3; ++b) {
      const std::size_t k = static_cast<std::size_t>(b);
      const Track& track =
          *from[static_cast<std::size_t>(recording_plausibility_detail::kAssignments[now][k])];
      if (track.valid[i]) last[k] = track.position.col(i), seen[k] = i;
    }
  }
  const std::size_t usual = static_cast<std::size_t>(std::ranges::max_element(votes) - votes.begin());
  Swaps swaps;
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::size_t own = chosen[static_cast<std::size_t>(i)];
    if (own == usual) continue;
    if (swaps.count > 0 && swaps.rows.back().second == i - 1)
      swaps.rows.back().second = i;
    else
      swaps.rows.emplace_back(i, i);
    ++swaps.count;
    for (std::size_t b = 0; b < 3; ++b) {
      const std::size_t place = static_cast<std::size_t>(recording_plausibility_detail::kAssignments[own][b]),
                        name =
                            static_cast<std::size_t>(recording_plausibility_detail::kAssignments[usual][b]);
      Track& to = *recording_plausibility_detail::tracks_of(r)[name];
      to.valid[i] = from[place]->valid[i];
      to.position.col(i) = from[place]->position.col(i);
      OrientationTrack &turn = *recording_plausibility_detail::orientations_of(r)[name],
                       &turned = *recording_plausibility_detail::orientations_of(source)[place];
      if (turn.empty()) continue;
      turn.valid[i] = !turned.empty() && turned.valid[i];
      if (turn.valid[i])
        turn.quaternion.col(i) = turned.quaternion.col(i);
      else
        turn.quaternion.col(i).setConstant(kNaN);
    }
  }
  return swaps;
}

/// Of two sticks that point the same way, as a player's do, the left one's tip is on the left as seen along
/// them; while the arms cross it is not. What nearly all rows say; nothing where the directions are not
/// recorded, or not alike.
inline std::optional<bool> sticks_are_exchanged(const Recording& r) {
  constexpr double kAlike = 0.5, kNearlyAll = 0.95;
  Eigen::Index known = 0, exchanged = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto seen = [i](const Track& tip, const OrientationTrack& turn) {
      return tip.valid[i] && !turn.empty() && turn.valid[i];
    };
    if (!seen(r.left, r.left_orientation) || !seen(r.right, r.right_orientation)) continue;
    const auto direction = [i](const OrientationTrack& turn) {
      return Eigen::Quaterniond(Eigen::Vector4d(turn.quaternion.col(i))) * Eigen::Vector3d::UnitX();
    };
    const Eigen::Vector3d along = 0.5 * (direction(r.left_orientation) + direction(r.right_orientation)),
                          leftwards(-along.y(), along.x(), 0.0);
    if (leftwards.norm() < kAlike) continue;
    ++known;
    if (leftwards.dot(r.left.position.col(i) - r.right.position.col(i)) < 0.0) ++exchanged;
  }
  if (2 * known < r.size()) return {};
  const double share = static_cast<double>(exchanged) / static_cast<double>(known);
  if (share > kNearlyAll) return true;
  if (share < 1.0 - kNearlyAll) return false;
  return {};
}

/// The recording with the names of the sticks exchanged.
inline Recording with_sticks_exchanged(Recording r) {
  std::swap(r.left, r.right);
  std::swap(r.left_orientation, r.right_orientation);
  return r;
}

}  // namespace diabolo
