// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/diagnose/findings.hpp"

namespace diabolo {

/// A motion to record next, and what it would tell.
struct Experiment {
  std::string_view motion, plain;
  double seconds;
  std::vector<std::string> parts;  ///< names that it tells apart, or tells at all
};

namespace detail {

/// A motion of the menu and the names that it makes visible.
struct MenuEntry {
  std::string_view motion, plain;
  double seconds;
  std::vector<std::string_view> shows;
};

inline const std::vector<MenuEntry>& experiment_menu() {
  static const std::vector<MenuEntry> menu{
      {"high_throws",
       "four throws or more, at two heights, the highest as high as can be caught",
       20.0,
       {"air_drag_linear", "air_drag_quadratic", "wind", "length_scale", "gravity_tilt", "frame_rate"}},
      {"two_spin_directions",
       "the same throws with the spin forwards and backwards",
       30.0,
       {"magnus_lift", "spin_drag", "axle_drag", "body_swap"}},
      {"stick_sweep",
       "hold the diabolo and turn the sticks by 40 degrees each way, beat in each position",
       20.0,
       {"stick_flex", "string_elasticity", "stick_tip_offset", "string_length"}},
      {"wide_hold",
       "hold it still with the hands wide apart, spinning, then let it spin the other way",
       20.0,
       {"string_friction", "gravity_tilt", "spin_coupling", "axle_drag"}},
      {"fast_beats",
       "short quick beats of both hands, changing direction",
       10.0,
       {"time_offset", "filter_lag", "robot_servo_lag", "string_elasticity", "marker_offset"}},
      {"loose_string", "small hops with a long loose string", 15.0, {"string_mass"}}};
  return menu;
}

}  // namespace detail

/// What to record for each tie: the motions of the menu that show what is tied, most of it first. Which
/// motion shows what is by the laws: drag by its growth with speed, lift by its change of sign with the spin,
/// bending by the angle of stick and string, friction by its lean on a wide string, delays by fast changes.
inline std::vector<Experiment> next_experiments(const Diagnosis& d) {
  std::vector<Experiment> result;
  for (const Finding& f : d.findings) {
    if (!f.claimed || f.tied_with.empty()) continue;
    std::vector<std::string> tied = f.tied_with;
    tied.insert(tied.begin(), std::string(f.candidate->name));
    const detail::MenuEntry* best = nullptr;
    std::ptrdiff_t most = 0;
    for (const detail::MenuEntry& entry : detail::experiment_menu()) {
      const std::ptrdiff_t shown = std::ranges::count_if(
          tied, [&](const std::string& name) { return std::ranges::count(entry.shows, name) > 0; });
      if (shown > most) most = shown, best = &entry;
    }
    if (best == nullptr) continue;
    const auto same = std::ranges::find(result, best->motion, &Experiment::motion);
    if (same == result.end())
      result.push_back({best->motion, best->plain, best->seconds, tied});
    else
      for (const std::string& name : tied)
        if (std::ranges::count(same->parts, name) == 0) same->parts.push_back(name);
  }
  return result;
}

}  // namespace diabolo
