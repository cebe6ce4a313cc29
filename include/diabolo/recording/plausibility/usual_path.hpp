// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/recording/recording.hpp"
#include "diabolo/string/string_path.hpp"
#include "diabolo/string/tip_geometry.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Farthest that the string's length and the usual path may be apart [m]; beyond, something else is wrong. A
/// diagnosis looks for a string's length within the same bounds.
inline constexpr double kOddPathLength = 0.08;

/// Least time [s] from which something is concluded that play may be like for a moment, as a string is slack,
/// and from which it is where play is never like that.
inline constexpr double kFewestSeconds = 2.0, kFewestSecondsOfNoPlay = 0.2;

/// The string from tip to tip in a row where tips and diabolo are seen.
inline StringPath<double> path_at(const Recording& r, Eigen::Index row) {
  Tips<double> tips;
  tips.left = r.left.position.col(row);
  tips.right = r.right.position.col(row);
  return StringPath<double>(r.diabolo.position.col(row), tips);
}

/// Path lengths from tip to tip over the diabolo [m], sorted, of the rows with the diabolo below the tips.
inline std::vector<double> sorted_path_lengths(const Recording& r) {
  std::vector<double> lengths;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!r.left.valid[i] || !r.right.valid[i] || !r.diabolo.valid[i]) continue;
    if (height_above_tips<double>(r.diabolo.position.col(i), r.left.position.col(i),
                                  r.right.position.col(i)) > 0.0)
      continue;
    lengths.push_back(path_at(r, i).length());
  }
  std::ranges::sort(lengths);
  return lengths;
}

/// The densest 20 mm of sorted path lengths: which one is the first in it, and how many are.
inline std::pair<std::size_t, std::size_t> densest_lengths(const std::vector<double>& lengths) {
  std::size_t best = 0, most = 0;
  for (std::size_t low = 0, high = 0; low < lengths.size(); ++low) {
    while (high < lengths.size() && lengths[high] < lengths[low] + 0.02) ++high;
    if (high - low > most) most = high - low, best = low;
  }
  return {best, most};
}

/// The most frequent of sorted path lengths [m]; none where no length stands out. That is the string's length
/// while it is taut.
inline std::optional<double> usual_path_length(const std::vector<double>& lengths) {
  if (lengths.size() < 20) return std::nullopt;
  const auto [first, count] = densest_lengths(lengths);
  if (count * 4 < lengths.size()) return std::nullopt;
  return lengths[first + count / 2];
}
inline std::optional<double> usual_path_length(const Recording& r) {
  return usual_path_length(sorted_path_lengths(r));
}

/// A clause about a recording whose usual path is not of its string's length; else empty. Where no length
/// stands out, as in units that are much smaller than thought, the median must be within a factor of two. No
/// path is longer than the string; a slack one is shorter, for a while.
inline std::string odd_path_length(const Recording& r) {
  const std::vector<double> lengths = sorted_path_lengths(r);
  const double seconds = static_cast<double>(lengths.size()) / r.rate;
  if (lengths.size() < 20 || seconds < kFewestSecondsOfNoPlay) return {};
  const std::optional<double> usual = usual_path_length(lengths);
  const double path = usual.value_or(lengths[lengths.size() / 2]), given = r.string_length;
  const bool longer = path > (usual ? given + kOddPathLength : 2.0 * given),
             shorter = path < (usual ? given - kOddPathLength : 0.5 * given) && seconds >= kFewestSeconds;
  if (!longer && !shorter) return {};
  return "the path from tip to tip over the diabolo is mostly " + shown_rounded(path) +
         " m where the string is " + shown(given) +
         " m long: wrong units, swapped bodies, another string, or a diabolo that lies elsewhere";
}

}  // namespace diabolo
