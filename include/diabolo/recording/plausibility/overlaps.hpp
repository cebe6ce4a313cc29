// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Longest overlap of two recordings that is trimmed [s]: excerpts of one take that were cut generously. A
/// longer one may be the wrong file.
inline constexpr double kLongestOverlap = 0.5;

/// Cuts the samples off a recording that one before it in the list holds, too, where they are its first or
/// its last and make up at most kLongestOverlap. A single one may be the border of two. Samples are the same
/// where time and positions are. Returns what was trimmed, a sentence each.
inline std::vector<std::string> trim_overlaps(std::vector<Recording>& recordings) {
  const auto same = [](const Recording& a, Eigen::Index i, const Recording& b, Eigen::Index j) {
    const auto alike = [i, j](const Track& x, const Track& y) {
      return x.valid[i] == y.valid[j] && (!x.valid[i] || x.position.col(i) == y.position.col(j));
    };
    return a.time[i] == b.time[j] && alike(a.left, b.left) && alike(a.right, b.right) &&
           alike(a.diabolo, b.diabolo);
  };
  std::vector<std::string> notes;
  for (std::size_t k = 1; k < recordings.size(); ++k) {
    for (std::size_t before = 0; before < k; ++before) {
      Recording& later = recordings[k];
      const Recording& given = recordings[before];
      const Eigen::Index rows = given.size(), size = later.size();
      const auto row_at = [&given](double time) {
        const double* const begin = given.time.data();
        return std::lower_bound(begin, begin + given.size(), time) - begin;
      };
      if (rows == 0 || size == 0) continue;
      Eigen::Index first = 0, last = size - 1;
      for (Eigen::Index j = row_at(later.time[0]); j < rows && first < size && same(given, j, later, first);
           ++j)
        ++first;
      for (Eigen::Index j = row_at(later.time[last]);
           j >= 0 && j < rows && last >= first && same(given, j, later, last); --j)
        --last;
      const Eigen::Index shared = first + size - 1 - last;
      if (shared < 2 || first > last || static_cast<double>(shared) > kLongestOverlap * later.rate) continue;
      notes.push_back("'" + later.name + "' overlaps '" + given.name + "' by " + std::to_string(shared) +
                      " samples, which are left out of it");
      later = cut(later, first, last);
    }
  }
  return notes;
}

}  // namespace diabolo
