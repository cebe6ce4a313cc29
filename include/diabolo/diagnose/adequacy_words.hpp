// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

#include "diabolo/diagnose/adequacy.hpp"
#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/residual_and_noise.hpp"
#include "diabolo/diagnose/significance.hpp"
#include "diabolo/math/fields.hpp"
#include "diabolo/parameters.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A size with its unit, in two digits.
inline std::string size_in_words(double value, const std::string& unit) {
  const bool small = unit == "m" || (unit == "s" && value < 0.1);
  const double shown_value = small ? 1e3 * value : value;
  const double step = std::pow(10.0, std::floor(std::log10(std::max(shown_value, 1e-3))) - 1.0);
  return shown(std::round(std::round(shown_value / step) * step * 1e6) / 1e6) +
         unit_behind(small ? "m" + unit : unit);
}

/// Where most is left over, after a comma.
inline std::string place_in_words(const ResidualAndNoise& left) {
  std::string text;
  if (left.mode == "ON_STRING") text += ", mostly on the string";
  if (left.mode == "LOOSE") text += ", mostly on the slack string";
  if (left.mode == "FLYING") text += ", mostly in flight";
  if (left.quantity == "spin") text += ", in the spin";
  if (left.direction == "forward") text += ", forward or back";
  if (left.direction == "left") text += ", sideways";
  if (left.direction == "up") text += ", up or down";
  if (!left.recording.empty())
    text += ", most from " + shown(std::round(10.0 * left.begin_s) / 10.0) + " to " +
            shown(std::round(10.0 * left.end_s) / 10.0) + " s of " + left.recording;
  return text;
}

/// What is left beyond noise: size and place.
inline std::string left_in_words(const Adequacy& adequacy) {
  const ResidualAndNoise& worst = adequacy.places.front();
  const std::string when = worst.ahead_s ? shown(*worst.ahead_s) + " s ahead, where the start's noise makes "
                                         : "within half a second, where noise leaves ";
  return size_in_words(worst.left, worst.unit) + " " + when + size_in_words(worst.noise, worst.unit) +
         place_in_words(worst);
}

/// What changes, in plain words: how much of what, and how.
inline std::string change_in_words(const ChangeInTime& change) {
  const std::string& name = change.quantity;
  const std::string what = name == "acceleration_forward" ? "an acceleration forward or back"
                           : name == "acceleration_left"  ? "an acceleration sideways"
                           : name == "acceleration_up"    ? "an acceleration up or down"
                           : name == "string_length"      ? "the string's length"
                           : name == "string_friction"    ? "the string's friction"
                           : name == "time_offset"        ? "a delay between diabolo and sticks"
                           : name.starts_with("spin")     ? "a torque on the spin"
                           : name.starts_with("flight")   ? "a force in flight"
                                                          : "a force on the string";
  if (change.trend_per_s)
    return what + " that changes steadily, by " + size_in_words(std::abs(*change.trend_per_s), change.unit) +
           " each second";
  return what + " that comes and goes, " + size_in_words(change.size, change.unit) +
         (change.frequency_hz ? " at " + shown(std::round(100.0 * *change.frequency_hz) / 100.0) + " Hz"
                              : "");
}

inline std::string three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// A dependence is shown that strengths exchanged among the windows gain as much as so rarely.
inline constexpr double kShownDependence = 0.05;

/// Takes off a law's words where its first number holds, " (at 1 m)", and says it behind that number.
inline std::string place_taken_off(std::string& words) {
  const std::size_t begin = words.rfind(" (at ");
  if (begin == std::string::npos || !words.ends_with(')')) return {};
  const std::string place = words.substr(begin + 2, words.size() - begin - 3);
  words.erase(begin);
  return " " + place;
}

/// A learnt law with its size and its interval: "against the velocity, of constant size: 0.41 [0.38, 0.44]
/// m/s^2".
inline std::string learnt_plainly(const Learnt& learnt) {
  std::string text = learnt.law.plain;
  const std::string place = place_taken_off(text);
  for (std::size_t i = 0; i < learnt.value.size(); ++i) {
    const LawNumber& number = learnt.law.numbers[i];
    if (number.name == "phase") continue;
    const double value = learnt.value[i], reach = kNormal95 * learnt.deviation[i];
    text += (i == 0 ? ": " : ", " + number.name + " ") + three_digits(value) + " [" +
            three_digits(value - reach) + ", " + three_digits(value + reach) + "]" +
            unit_behind(number.unit) + (i == 0 ? place : "");
  }
  const bool sure = !learnt.dependence || learnt.dependence->p_value <= kShownDependence;
  return text + (sure ? "" : " (that it depends on this is not shown)");
}

/// "93 % of the gap": of windows of half a second where these show one, else of the farthest prediction of
/// position that does, else of the spin, in windows, then ahead.
inline std::string share_of_gap(const Adequacy& adequacy) {
  std::optional<double> share = adequacy.explained;
  std::string of;
  const auto ask_ahead = [&](const std::string& quantity, const std::string& where) {
    for (auto left = adequacy.overall.rbegin(); !share && left != adequacy.overall.rend(); ++left) {
      if (left->quantity != quantity || !left->ahead_s) continue;
      share = diagnose_detail::explained_of(*left);
      of = where + " after " + shown(*left->ahead_s) + " s";
    }
  };
  ask_ahead("position", "");
  if (!share) share = adequacy.spin_explained, of = " in the spin";
  ask_ahead("spin", " in the spin");
  if (!share) return {};
  return std::to_string(std::lround(100.0 * std::max(0.0, *share))) + " % of the gap" + of;
}

/// How much of the gap what was found explains, and what it leaves: sentences after the answer's.
inline std::string explained_in_words(const Adequacy& adequacy, bool named) {
  std::string text = share_of_gap(adequacy);
  if (!text.empty())
    text = (named ? " This explains " : " What is fitted along, and not claimed, explains ") + text + ".";
  if (!adequacy.places.empty()) text += " No explanation has been found of " + left_in_words(adequacy) + ".";
  if (!adequacy.changes.empty())
    text += " Something changes in time: " + change_in_words(adequacy.changes.front()) + ".";
  return text;
}

}  // namespace diabolo
