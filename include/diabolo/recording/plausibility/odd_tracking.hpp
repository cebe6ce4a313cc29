// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "diabolo/recording/plausibility/swapped_bodies.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A clause about a diabolo within the string's reach that is above the tips for most of the time; else
/// empty.
inline std::string odd_height(const Recording& r) {
  Eigen::Index above = 0, known = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!r.left.valid[i] || !r.right.valid[i] || !r.diabolo.valid[i]) continue;
    if (path_at(r, i).length() > r.string_length + kOddPathLength) continue;  // it flies
    ++known;
    above += height_above_tips<double>(r.diabolo.position.col(i), r.left.position.col(i),
                                       r.right.position.col(i)) > 0.0;
  }
  if (static_cast<double>(known) < kFewestSeconds * r.rate || 2 * above <= known) return {};
  return "the diabolo is above the tips in " + std::to_string(100 * above / known) +
         " % of the rows in which the string reaches it: an axis other than z points up, or bodies are "
         "swapped";
}

/// "2.5 s to 2.75 s and 3 times more": when bodies were under each other's names.
inline std::string times_of(const Swaps& swaps, const Eigen::VectorXd& time) {
  const auto [first, last] = swaps.rows.front();
  const std::size_t more = swaps.rows.size() - 1;
  return shown_rounded(time[first]) + " s to " + shown_rounded(time[last]) + " s" +
         (more > 0 ? " and " + std::to_string(more) + (more > 1 ? " times more" : " time more") : "");
}

/// A clause about bodies that are under each other's names in some rows; else empty.
inline std::string odd_names(const Recording& r) {
  Recording given = r;
  if (const Swaps swaps = unswap(given); swaps.count > 0)
    return "bodies jump to each other's places, from " + times_of(swaps, r.time);
  return {};
}

}  // namespace diabolo
