// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/location.hpp"

namespace diabolo {

namespace diagnose_detail {

/// Where base and recording part, window by window.
inline Location located(const Diagnosis& d, const std::vector<Recording>& recordings) {
  Location location;
  for (int k = 0; k < kLatents; ++k) {
    const Unknown latent = static_cast<Unknown>(kLatentFirst + k);
    const UnknownInfo& info = info_of(latent);
    location.directions.push_back(
        {std::string(info.name), acts_on_string(latent) ? "ON_STRING" : "FLYING", std::string(info.unit)});
  }
  for (const WindowFinding& w : d.windows) {
    const auto where_seen = [](double value) {
      return std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    LocatedWindow window{recordings[w.recording].name,
                         w.begin,
                         w.end,
                         text_of(w.mode),
                         w.residual_before,
                         w.residual_after,
                         {},
                         {},
                         where_seen(w.residual_noise),
                         where_seen(w.spin_before),
                         where_seen(w.spin_after),
                         where_seen(w.spin_noise)};
    for (const double z : w.z) window.z.push_back(where_seen(z));
    for (const double z : w.z_after) window.z_after.push_back(where_seen(z));
    location.windows.push_back(std::move(window));
  }
  return location;
}

}  // namespace diagnose_detail
}  // namespace diabolo
