// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diabolo/diagnose/fit_take.hpp"

namespace diabolo {

/// Rows of a recording, such as a model is fitted without.
struct Fold {
  std::size_t fit_take;
  Eigen::Index first, last;  ///< both included
};

/// Whole recordings where there are several; else three blocks of the only one. Each is given by its rows.
inline std::vector<Fold> folds_of(const std::vector<Fold>& recordings) {
  constexpr Eigen::Index kBlocks = 3;
  const Eigen::Index blocks = recordings.size() > 1 ? 1 : kBlocks;
  std::vector<Fold> folds;
  for (const Fold& all : recordings) {
    const Eigen::Index size = all.last - all.first + 1;
    for (Eigen::Index b = 0; b < blocks; ++b)
      folds.push_back({all.fit_take, all.first + size * b / blocks, all.first + size * (b + 1) / blocks - 1});
  }
  return folds;
}

/// The same of all rows.
inline std::vector<Fold> folds_of(const std::vector<FitTake>& fit_takes) {
  std::vector<Fold> recordings;
  for (std::size_t s = 0; s < fit_takes.size(); ++s)
    recordings.push_back({s, 0, fit_takes[s].take->recording.size() - 1});
  return folds_of(recordings);
}

inline bool touch(const Fold& a, const Fold& b) {
  return a.fit_take == b.fit_take && a.first <= b.last && a.last >= b.first;
}

/// Which windows touch a fold.
inline std::vector<bool> windows_in(const Fold& fold, const std::vector<FitTake>& fit_takes) {
  std::vector<bool> result;
  for (std::size_t s = 0; s < fit_takes.size(); ++s)
    for (const FitWindow& window : fit_takes[s].windows)
      result.push_back(touch(fold, {s, window.first, window.last}));
  return result;
}

}  // namespace diabolo
