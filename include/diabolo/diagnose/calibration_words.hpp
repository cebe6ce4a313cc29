// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diabolo/diagnose/adequacy_words.hpp"
#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/axle_words.hpp"
#include "diabolo/diagnose/findings.hpp"

namespace diabolo {

/// The string's drive of the spin by the base's own rule, where it is surely another: a part of a sentence.
inline std::string spin_drive_in_words(const Diagnosis& d) {
  constexpr double kNone = 0.02;  // of the base's is as good as none
  const int u = index_of(Unknown::kSpinCoupling);
  const double change = d.at[u], before = d.base_spin_coupling, after = std::max(0.0, before + change);
  if (!(std::abs(change) > kSignificanceOfFault * d.deviation[u]) ||
      !(std::abs(change) * kSpinTime > kSmallestSpinShare))
    return {};
  const std::string given = size_in_words(before, "1/s");
  return after < kNone * before
             ? "the string does not drive the spin, as the simulator's does by " + given
             : "the string drives the spin by " + size_in_words(after, "1/s") + ", not by " + given;
}

/// Of a simulator that is off where nothing is claimed: which setting of it, or which calibration that was
/// fitted along, makes the difference. A sentence.
inline std::string calibration_in_words(const Diagnosis& d) {
  if (d.adequacy.base_adequate.value_or(true)) return {};
  std::vector<const Finding*> faults;
  for (const Finding& f : d.findings)
    if (f.candidate->kind == CandidateKind::kMeasurement && f.sure && f.possible && f.size > kSmallestReach)
      faults.push_back(&f);
  const std::string drive = spin_drive_in_words(d);
  if (drive.empty() && faults.empty()) return {};
  return (faults.empty() ? " A setting of the simulator" : " Calibration") +
         std::string(" makes the difference: ") + drive + (drive.empty() || faults.empty() ? "" : "; ") +
         (faults.empty() ? "" : "fitted along: " + plainly(faults)) + ".";
}

}  // namespace diabolo
