// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/guess_shapes.hpp"
#include "diabolo/diagnose/open_law.hpp"
#include "diabolo/effects/law.hpp"

namespace diabolo::diagnose_detail {

/// What moves by less says nothing of a law in place [m].
inline constexpr double kStays = 0.01;

/// Usual sizes of a motion, to one digit: a law's amplitude is what it is there.
struct UsualSizes {
  double speed = 1.0, spin = 100.0, tips = 1.0;
  double apart = 1.0;              ///< of the tips, to a centimetre
  bool hands_come_and_go = false;  ///< whether that changes
};

inline UsualSizes usual_sizes(const Fit& fit) {
  std::vector<double> speeds, spins, tips, apart;
  for (const FitTake& fit_take : fit.fit_takes)
    for (const FitWindow& window : fit_take.windows) {
      speeds.push_back(mean_speed(fit_take, window));
      spins.push_back(std::abs(window.start.spin));
      const Tips<double> now = fit_take.take->motion->at(fit_take.take->times[window.first]);
      tips.push_back(now.left_velocity.norm() + now.right_velocity.norm());
      apart.push_back((now.right - now.left).norm());
    }
  std::ranges::sort(apart);
  const bool change = !apart.empty() && quantile(apart, 0.9) - quantile(apart, 0.1) > kStays;
  return {one_digit(median_of(speeds)), one_digit(median_of(spins)), one_digit(median_of(tips)),
          std::round(100.0 * median_of(apart, 1.0)) / 100.0, change};
}

/// What may depend on where the diabolo is heading: a push of the air that turns with it, drag on the way up
/// or down alone, a spin that is lost on the way up; and on the string that passes: a spin that it feeds, a
/// push along it.
inline void guess_by_heading(Guesses& guesses, const UsualSizes& usual, const std::string& slows) {
  using enum Acts;
  const std::string per = " / " + shown(usual.speed), at = " (at " + shown(usual.speed) + " m/s)",
                    up = "(1 + tanh(vz / 0.2)) / 2", down = "(1 - tanh(vz / 0.2)) / 2";
  constexpr std::array<std::pair<const char*, const char*>, 3> kVelocities{
      {{"vx", "forwards"}, {"vy", "to the left"}, {"vz", "upwards"}}};
  for (const Acts acts : {kForward, kLeft, kUp})
    for (const auto& [velocity, words] : kVelocities)
      guesses.fixed(acts, velocity + per, std::string(", growing with the velocity ") + words + at);
  for (const auto& [factor, words] : {std::pair(up, " on the way up"), std::pair(down, " on the way down")}) {
    guesses.fixed(kAgainst, factor, std::string(words) + ", of constant size");
    guesses.growing(kAgainst, factor, "speed" + per, 1.0,
                    std::string(words) + ", growing with the speed" + at);
  }
  guesses.fixed(kSpin, slows + " * vz" + per, ", slowing it, growing with the velocity upwards" + at);
  guesses.fixed(kSpin, slows + " * abs(vz)" + per, ", slowing it, growing with the speed up or down" + at);
  guesses.fixed(kSpin, "taut * passing" + per, ", growing with the string that passes" + at);
  guesses.fixed(kAlong, "taut * passing" + per, ", growing with the string that passes" + at);
}

/// What may depend on how the tips stand to each other and to the diabolo.
inline void guess_by_hands(Guesses& guesses, const UsualSizes& usual, const std::string& slows) {
  using enum Acts;
  const std::string off = ", growing with the difference of the distances to the tips (at 1 m)";
  guesses.fixed(kAlong, "taut * (left - right)", off);
  guesses.fixed(kAlong, "taut * left", ", growing with the distance to the left tip (at 1 m)");
  guesses.fixed(kAlong, "taut * right", ", growing with the distance to the right tip (at 1 m)");
  guesses.fixed(kString, "(left - right)", off);
  if (!usual.hands_come_and_go) return;
  const std::string wider = "(apart - " + shown(usual.apart) + ")",
                    words = ", growing with the distance between the tips (at 1 m more)";
  for (const Acts acts : {kForward, kLeft, kUp, kString}) guesses.fixed(acts, wider, words);
  guesses.fixed(kSpin, slows + " * " + wider, ", slowing it" + words);
}

/// Whether the axle's surface turns towards the right tip (1), against the string, or away from it (-1).
inline constexpr const char* kSenseOfSlip = "tanh(slip / 0.05)";

/// What the coefficient of the string's friction may depend on: the slip, with which it grows or falls
/// (Stribeck's curve), the string's pull (Howell, "The general case of friction of a string round a
/// cylinder", 1953), and the slip's sense. (A power of its own nobody tells from the coefficient itself.)
inline void guess_rubbing(Guesses& guesses, const Fit& fit, const UsualSizes& usual) {
  const double speed = one_digit(usual.spin * fit.at[index_of(Unknown::kAxleRadius)]);
  const std::string slip = shown(speed);
  guesses.fixed(Acts::kFriction, "abs(slip) / " + slip, ", growing with the slip (at " + slip + " m/s)");
  for (const double part : {1.0, 0.2})
    guesses.decaying(Acts::kFriction, "abs(slip)", part * speed, "m/s",
                     ", more where the string slips slowly");
  guesses.fixed(Acts::kFriction, "log(max(pull, 1) / 10)",
                ", growing with the logarithm of the string's pull");
  guesses.fixed(Acts::kFriction, kSenseOfSlip, ", more where the axle turns towards the right tip");
}

}  // namespace diabolo::diagnose_detail
