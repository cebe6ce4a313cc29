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
    beyond[axis] = std::max(0.0, median_of(values));
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
    if (!std::isfinite(w->*channel.base + w->*channel.left + w->*channel.noise)) continue;
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

inline const char* mode_of(const WindowFinding& w) { return w.eventful ? "EVENT" : text_of(w.mode); }

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

/// Fewest windows that leave more than noise one after the other, where others do not, to be told; with no
/// more time between them [s].
inline constexpr std::size_t kShortest = 3;
inline constexpr double kTogether = 1.0;

/// A moment that leaves no more than so many times the noise needs to last until chance puts it together so
/// rarely: a string with a mass of its own leaves such in a swing or two.
inline constexpr double kFarMoment = 6.0, kRarely = 1e-5;

/// What happened in a moment, which the middle window of a stretch does not see: windows without events, one
/// after the other, all of which leave more than kTimesNoise times what noise leaves, more than chance would
/// put together.
inline std::vector<ResidualAndNoise> moments_beyond(Windows windows, const Channel& channel,
                                                    const std::vector<std::string>& names) {
  std::erase_if(windows, [&](const WindowFinding* w) {
    return !std::isfinite(w->*channel.base + w->*channel.left + w->*channel.noise);
  });
  const auto noise_of = [&](const WindowFinding& w) {
    return std::max(w.*channel.noise, channel.immaterial);
  };
  const auto is_far = [&](const WindowFinding& w) { return w.*channel.left > kTimesNoise * noise_of(w); };
  const auto far = static_cast<std::size_t>(
      std::ranges::count_if(windows, [&](const WindowFinding* w) { return is_far(*w); }));
  std::vector<ResidualAndNoise> result;
  for (std::size_t first = 0, end = 0; first < windows.size(); first = std::max(end, first + 1)) {
    for (end = first; end < windows.size() && is_far(*windows[end]); ++end)
      if (end > first && (windows[end]->recording != windows[first]->recording ||
                          windows[end]->begin > windows[end - 1]->end + kTogether))
        break;
    if (end < first + kShortest) continue;
    const std::size_t length = end - first, others = windows.size() - length;
    const double share = static_cast<double>(far - length + 1) / static_cast<double>(others + 1),
                 chance = static_cast<double>(others + 1) * std::pow(share, static_cast<double>(length));
    if (!(chance < kNoiseMayDoIt)) continue;
    const Windows moment(windows.begin() + static_cast<std::ptrdiff_t>(first),
                         windows.begin() + static_cast<std::ptrdiff_t>(end));
    const auto middle = [&](const auto& number) {
      std::vector<double> values;
      for (const WindowFinding* w : moment) values.push_back(number(*w));
      return median_of(std::move(values));
    };
    ResidualAndNoise left;
    left.quantity = channel.quantity;
    left.unit = channel.unit;
    left.mode = "ANY";
    if (channel.quantity == kPositionChannel.quantity) left.direction = leading_direction(moment);
    left.recording = names[windows[first]->recording];
    left.begin_s = windows[first]->begin;
    left.end_s = windows[end - 1]->end;
    left.windows = length;
    left.base = middle([&](const WindowFinding& w) { return w.*channel.base; });
    left.left = middle([&](const WindowFinding& w) { return w.*channel.left; });
    left.noise = middle([&](const WindowFinding& w) { return w.*channel.noise; });
    left.times_noise = middle([&](const WindowFinding& w) { return w.*channel.left / noise_of(w); });
    left.p_value = chance;
    if (left.times_noise > kFarMoment || chance < kRarely) result.push_back(left);
  }
  return result;
}

/// Whether a moment is part of one of some stretches.
inline bool is_within(const ResidualAndNoise& moment, const std::vector<ResidualAndNoise>& stretches) {
  return std::ranges::any_of(stretches, [&](const ResidualAndNoise& stretch) {
    return stretch.recording == moment.recording && stretch.begin_s < moment.end_s &&
           moment.begin_s < stretch.end_s;
  });
}

}  // namespace diagnose_detail

/// What windows leave against what noise alone leaves: over all, in each state of the string, and in each
/// stretch of time; and `ahead`, the same of predictions of data that were left out, which see a slight force
/// or torque that a window with a start of its own does not. `names` are the recordings'.
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
    const std::vector<ResidualAndNoise> stretches = in::stretches_beyond(calm, channel, names);
    std::ranges::copy(stretches, std::back_inserter(result.places));
    std::ranges::copy_if(in::moments_beyond(calm, channel, names), std::back_inserter(result.places),
                         [&](const ResidualAndNoise& moment) { return !in::is_within(moment, stretches); });
  }
  std::ranges::stable_sort(result.places, std::greater(), &ResidualAndNoise::times_noise);
  const auto of_windows = static_cast<std::ptrdiff_t>(result.places.size());
  result.changes = changes_in_time(windows);
  for (const ResidualAndNoise& left : ahead) {
    if (!result.adequate) break;
    result.overall.push_back(left);
    if (in::is_beyond_noise(left)) result.places.push_back(left);
  }
  std::ranges::stable_sort(result.places.begin() + of_windows, result.places.end(), std::greater(),
                           &ResidualAndNoise::times_noise);
  if (!result.places.empty() || !result.changes.empty()) result.adequate = false;
  return result;
}

}  // namespace diabolo
