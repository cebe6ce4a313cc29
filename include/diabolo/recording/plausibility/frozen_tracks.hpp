// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/plausibility/odd_stretches.hpp"
#include "diabolo/recording/plausibility/swapped_bodies.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/track_noise.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Longest time [s] for which a body may seem to rest to the last digit.
inline constexpr double kLongestRest = 0.1;

/// Noise [m] from which on a track cannot rest to the last digit.
inline constexpr double kNoisyTrack = 1e-5;

/// Rows of a track that repeat the one before for longer than kLongestRest.
inline Marks repeated_rows(const Recording& r, const Track& track, Stretches& found) {
  Marks marks = Marks::Constant(r.size(), false);
  for_each_rest(track, [&](Eigen::Index first, Eigen::Index last) {
    if (r.time[last] - r.time[first] <= kLongestRest) return;
    found.add(r.time[first], r.time[last]);
    marks.segment(first + 1, last - first).setConstant(true);
  });
  return marks;
}

/// Makes dropouts of rows in which a track repeats itself for longer than kLongestRest although its noise
/// moves it elsewhere: what tracked it held the last pose. Returns how many; a note tells of each body's
/// longest.
inline Eigen::Index mask_frozen(Recording& r) {
  const std::array<Track*, 3> tracks = recording_plausibility_detail::tracks_of(r);
  Eigen::Index total = 0;
  std::string told;
  for (std::size_t b = 0; b < 3; ++b) {
    Stretches found;
    const Marks frozen = repeated_rows(r, *tracks[b], found);
    if (found.count == 0) continue;
    Track moving = *tracks[b];
    moving.valid = moving.valid && !frozen;
    if (!(track_noise(moving).deviation.maxCoeff() > kNoisyTrack)) continue;
    total += frozen.count();
    told += (told.empty() ? "the " : ", the ") + std::string(recording_plausibility_detail::kBodies[b]) +
            " for " + found.text();
    recording_plausibility_detail::make_dropouts(r, b, frozen);
  }
  if (total > 0) r.notes.push_back("frozen tracking, read as dropouts: " + told);
  return total;
}

/// A clause about a coordinate that is the same in all rows although noise moves the others of its body, and
/// the same one of another body; else empty. A simulation may stay in a plane.
inline std::string constant_coordinate(const Recording& r) {
  Recording given = r;
  const std::array<Track*, 3> tracks = recording_plausibility_detail::tracks_of(given);
  std::array<Eigen::Array3d, 3> noise;
  for (std::size_t b = 0; b < 3; ++b) noise[b] = track_noise(*tracks[b]).deviation;
  const auto is_noisy = [](double deviation) { return deviation > kNoisyTrack; };
  for (std::size_t b = 0; b < 3; ++b)
    for (int axis = 0; axis < 3; ++axis) {
      const auto moves_along = [&](const Eigen::Array3d& body) { return is_noisy(body[axis]); };
      if (!is_noisy(noise[b].maxCoeff()) || std::ranges::none_of(noise, moves_along)) continue;
      double least = kLargestCoordinate, most = -kLargestCoordinate;
      for (Eigen::Index i = 0; i < r.size(); ++i) {
        if (!tracks[b]->valid[i]) continue;
        least = std::min(least, tracks[b]->position(axis, i));
        most = std::max(most, tracks[b]->position(axis, i));
      }
      if (least == most)
        return "the " + std::string(recording_plausibility_detail::kBodies[b]) + "'s " + "xyz"[axis] +
               " is " + shown(least) +
               " m in all rows, while noise moves its other coordinates: it was not recorded";
    }
  return {};
}

}  // namespace diabolo
