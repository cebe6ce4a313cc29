// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/diagnose/answer.hpp"

namespace diabolo {

/// The claim of that name; null where there is none.
inline const Finding* claimed(const Diagnosis& diagnosis, std::string_view name) {
  for (const Finding& f : diagnosis.findings)
    if (f.claimed && f.candidate->name == name) return &f;
  return nullptr;
}

}  // namespace diabolo
