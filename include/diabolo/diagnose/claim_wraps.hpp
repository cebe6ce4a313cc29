// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "diabolo/diagnose/alternatives.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/significance.hpp"

namespace diabolo {

/// Claims that the string is wrapped around the axle, which took friction's place: at work wherever that is.
inline void claim_wraps(Diagnosis& d, const Fit& fit, const Replacement& wrap) {
  const auto friction = std::ranges::find_if(
      d.findings, [](const Finding& f) { return f.candidate->name == "string_friction"; });
  if (friction == d.findings.end() || !friction->claimed) return;
  Finding f = *friction;
  f.candidate = &candidate_of("string_wrap");
  f.estimate = fit.at;
  f.deviation.setZero();
  f.z = wrap.z;
  f.p_value = family_wise(f.z);
  f.claimed = f.material = true;
  f.confidence = wrap.tied_with.empty() ? friction->confidence : 0.5;
  f.tied_with = wrap.tied_with;
  f.reason = "the string is as much shorter, and rubs as much more, as its turns around the axle make it";
  d.findings.insert(d.findings.begin(), f);
}

}  // namespace diabolo
