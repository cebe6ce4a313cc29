// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/change_in_time.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/diagnose/residual_and_noise.hpp"

namespace diabolo {

/// A name is a wrong one where the gap stays open by more than half, and the middle window still misses by so
/// many times the noise, or by so much after half a second [m].
inline constexpr double kHalfOpen = 0.5, kFarOff = 10.0, kFarOffAnyway = 0.1;

namespace diagnose_detail {

/// A number of a window: left by the base, with what was found, and by noise alone.
struct Channel {
  const char *quantity, *unit;
  double immaterial;
  double WindowFinding::*base;
  double WindowFinding::*left;
  double WindowFinding::*noise;
};

inline constexpr Channel kPositionChannel{"position",
                                          "m",
                                          kImmaterialPosition,
                                          &WindowFinding::residual_before,
                                          &WindowFinding::residual_after,
                                          &WindowFinding::residual_noise};
inline constexpr Channel kSpinChannel{"spin",
                                      "rad/s",
                                      kImmaterialSpin,
                                      &WindowFinding::spin_before,
                                      &WindowFinding::spin_after,
                                      &WindowFinding::spin_noise};

using Windows = std::vector<const WindowFinding*>;

/// The direction in which most of what noise does not explain lies, where one leads.
inline std::string leading_direction(const Windows& windows) {
  std::array<double, 3> beyond{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const WindowFinding* w : windows) values.push_back(w->beyond_noise[axis]);
    beyond[axis] = std::max(0.0, middle_of(values));
  }
  constexpr std::array<const char*, 3> kNames{"forward", "left", "up"};
  const std::size_t most = static_cast<std::size_t>(std::ranges::max_element(beyond) - beyond.begin());
  return beyond[most] > 0.7 * (beyond[0] + beyond[1] + beyond[2]) ? kNames[most] : "";
}

/// What the middle one of some windows leaves; nothing where fewer than kStretch say anything.
inline std::optional<ResidualAndNoise> residual_and_noise_in(const Windows& windows, const Channel& channel) {
  Compared compared;
  Windows seen;
  for (const WindowFinding* w : windows) {
    if (!std::isfinite(w->*channel.left) || !std::isfinite(w->*channel.noise)) continue;
    seen.push_back(w);
    compared.add(w->*channel.base, w->*channel.left, w->*channel.noise);
  }
  std::optional<ResidualAndNoise> result = residual_and_noise_of(compared, channel.immaterial, 1);
  if (!result) return std::nullopt;
  result->quantity = channel.quantity;
  result->unit = channel.unit;
  if (channel.quantity == kPositionChannel.quantity) result->direction = leading_direction(seen);
  return result;
}

/// The share of the gap beyond noise that was closed; nothing where there is none.
inline std::optional<double> explained_of(const ResidualAndNoise& left) {
  if (!(left.base > kTimesNoise * left.noise)) return std::nullopt;
  return std::min(1.0, (left.base - left.left) / (left.base - left.noise));
}

inline const char* mode_of(const WindowFinding& w) {
  if (w.eventful) return "EVENT";
  return w.mode == StringState::kOnString ? "ON_STRING" : w.mode == StringState::kLoose ? "LOOSE" : "FLYING";
}

/// Stretches of time without events in which more is left than noise leaves, joined where they touch.
inline std::vector<ResidualAndNoise> stretches_beyond(const Windows& windows, const Channel& channel,
                                                      const std::vector<std::string>& names) {
  const auto part = [&](std::size_t first, std::size_t end) {
    return Windows(windows.begin() + static_cast<std::ptrdiff_t>(first),
                   windows.begin() + static_cast<std::ptrdiff_t>(end));
  };
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  for (std::size_t first = 0; first + kStretch <= windows.size(); first += kStretch / 2) {
    const std::size_t end = first + kStretch;
    if (windows[first]->recording != windows[end - 1]->recording) continue;
    const std::optional<ResidualAndNoise> left = residual_and_noise_in(part(first, end), channel);
    if (!left || !is_beyond_noise(*left)) continue;
    if (!ranges.empty() && first <= ranges.back().second &&
        windows[ranges.back().first]->recording == windows[first]->recording)
      ranges.back().second = end;
    else
      ranges.emplace_back(first, end);
  }
  std::vector<ResidualAndNoise> result;
  for (const auto& [first, end] : ranges) {
    result.push_back(*residual_and_noise_in(part(first, end), channel));
    result.back().recording = names[windows[first]->recording];
    result.back().begin_s = windows[first]->begin;
    result.back().end_s = windows[end - 1]->end;
  }
  return result;
}

}  // namespace diagnose_detail

/// What windows leave against what noise alone leaves: over all, in each state of the string, and in each
/// stretch of time; and `ahead`, the same of predictions of data that were left out, which see a slight force
/// that a window with a start of its own does not. `names` are the recordings'.
inline Adequacy judge_adequacy(const std::vector<WindowFinding>& windows,
                               const std::vector<std::string>& names,
                               const std::vector<ResidualAndNoise>& ahead = {}) {
  namespace in = diagnose_detail;
  Adequacy result;
  in::Windows all, calm;
  for (const WindowFinding& w : windows) {
    all.push_back(&w);
    if (!w.eventful) calm.push_back(&w);
  }
  for (const in::Channel& channel : {in::kPositionChannel, in::kSpinChannel}) {
    const std::optional<ResidualAndNoise> overall = in::residual_and_noise_in(all, channel);
    if (!overall) continue;
    in::Channel of_base = channel;
    of_base.left = channel.base;
    const std::optional<ResidualAndNoise> before = in::residual_and_noise_in(all, of_base);
    result.adequate = result.adequate.value_or(true);
    result.base_adequate = result.base_adequate.value_or(true) && !(before && in::is_beyond_noise(*before));
    (channel.quantity == in::kPositionChannel.quantity ? result.explained : result.spin_explained) =
        in::explained_of(*overall);
    result.overall.push_back(*overall);
    if (in::is_beyond_noise(*overall)) result.places.push_back(*overall);
    for (const char* mode : {"ON_STRING", "LOOSE", "FLYING"}) {
      in::Windows part;
      for (const WindowFinding* w : all)
        if (std::string(in::mode_of(*w)) == mode) part.push_back(w);
      std::optional<ResidualAndNoise> left = in::residual_and_noise_in(part, channel);
      if (!left || !in::is_beyond_noise(*left)) continue;
      left->mode = mode;
      result.places.push_back(*left);
    }
    std::ranges::move(in::stretches_beyond(calm, channel, names), std::back_inserter(result.places));
  }
  std::ranges::stable_sort(result.places, std::greater(), &ResidualAndNoise::times_noise);
  result.changes = changes_in_time(windows);
  for (const ResidualAndNoise& left : ahead) {
    if (!result.adequate) break;
    result.overall.push_back(left);
    if (in::is_beyond_noise(left)) result.places.push_back(left);
  }
  if (!result.places.empty() || !result.changes.empty()) result.adequate = false;
  return result;
}

}  // namespace diabolo
