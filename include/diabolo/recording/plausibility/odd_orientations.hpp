// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "diabolo/recording/plausibility/odd_axle.hpp"
#include "diabolo/recording/plausibility/odd_spin.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// A clause about the diabolo's orientations where they show no spin, or a wrong one; else empty.
inline std::string odd_orientations(const Recording& r) {
  const std::string axle = odd_axle(r);
  return axle.empty() ? odd_spin(r) : axle;
}

/// Makes dropouts of the diabolo's orientations where they are odd, as if none were recorded. Returns whether
/// they were; a note tells why.
inline bool mask_odd_orientations(Recording& r) {
  const std::string odd = odd_orientations(r);
  if (odd.empty()) return false;
  r.diabolo_orientation = OrientationTrack::missing(r.size());
  r.notes.push_back(odd + "; its orientations are not used, and the spin is unknown");
  return true;
}

}  // namespace diabolo
