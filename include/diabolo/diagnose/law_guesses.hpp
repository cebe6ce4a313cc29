// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/change_in_time.hpp"
#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/guess_shapes.hpp"
#include "diabolo/diagnose/guesses_by_motion.hpp"
#include "diabolo/diagnose/open_law.hpp"
#include "diabolo/effects/law.hpp"

namespace diabolo {

namespace diagnose_detail {

static_assert(kMayChange.back().unknown == Unknown::kTimeOffset);
/// What may drive a change in time, as kMayChange has it, and by which factor it acts there; nothing drives a
/// delay.
struct Swinging {
  Acts acts;
  const char* factor;
};
inline constexpr std::array<Swinging, kMayChange.size() - 1> kSwinging{{{Acts::kForward, ""},
                                                                        {Acts::kLeft, ""},
                                                                        {Acts::kUp, ""},
                                                                        {Acts::kAlong, "taut"},
                                                                        {Acts::kAcross, "taut"},
                                                                        {Acts::kAgainst, "(1 - taut)"},
                                                                        {Acts::kUp, "(1 - taut)"},
                                                                        {Acts::kLift, "(1 - taut)"},
                                                                        {Acts::kSpin, "taut"},
                                                                        {Acts::kSpin, "(1 - taut)"},
                                                                        {Acts::kString, ""},
                                                                        {Acts::kFriction, ""}}};

/// Laws in time: a trend, and the oscillation and the onset that windows see best. `clock` is the laws' time
/// at the recording's first row [s].
inline void guess_in_time(Guesses& guesses, const std::vector<WindowFinding>& windows, double clock) {
  const double begun = std::round(100.0 * clock) / 100.0;
  for (std::size_t k = 0; k < kSwinging.size(); ++k) {
    const WindowSeries series = series_of(windows, k);
    if (series.size() < 12) continue;
    const double span = series.time.back() - series.time.front();
    const auto [acts, factor] = kSwinging[k];
    guesses.trending(acts, factor);
    const double frequency = std::round(1e4 * best_frequency(series).first) / 1e4;
    if (frequency > 0.0) guesses.swinging(acts, factor, frequency, span, ", to and fro");
    if (const std::optional<double> onset = best_onset(series))
      guesses.starting(acts, factor, std::round(100.0 * (clock + *onset)) / 100.0,
                       clock + series.time.front(), clock + series.time.back());
    if (acts == Acts::kString || acts == Acts::kFriction)
      guesses.decaying(acts, begun == 0.0 ? "t" : "(t - " + shown(begun) + ")", one_digit(span / 4.0), "s",
                       ", other at the beginning");
  }
}

/// Forces that grow with the way from a place, and forces near or beyond one: at the middle of where the
/// diabolo is, to both sides, and above and below. (Fore and aft it hardly goes, and where it stays in place
/// it says nothing of one.)
inline void guess_in_places(Guesses& guesses, const Fit& fit) {
  constexpr std::array kAxes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    std::vector<double> places;
    for (const FitTake& fit_take : fit.fit_takes)
      for (const FitWindow& window : fit_take.windows)
        places.push_back(window.start.position[static_cast<int>(axis)]);
    std::ranges::sort(places);
    const auto place = [&](double part) { return std::round(100.0 * quantile(places, part)) / 100.0; };
    const double reach = quantile(places, 0.9) - quantile(places, 0.1), width = one_digit(reach / 3.0);
    if (reach < kStays) continue;
    for (const Acts acts : {Acts::kForward, Acts::kLeft, Acts::kUp}) {
      guesses.off_place(acts, kAxes[axis], place(0.5));
      if (axis == 0) continue;
      for (const double part : {0.1, 0.5, 0.9}) guesses.close_to(acts, kAxes[axis], place(part), width);
      for (const double part : {0.25, 0.5, 0.75})
        guesses.beyond_place(acts, kAxes[axis], place(part), 0.3 * width);
    }
  }
}

}  // namespace diagnose_detail

/// What may be left over beside the laws that have a name: dependences on speed, spin, tension, tips, place
/// and, where all windows share a clock, time, in each direction. `windows` hold what they say of the fit.
inline std::vector<LawGuess> law_guesses(const Fit& fit, const std::vector<WindowFinding>& windows) {
  using enum Acts;
  const diagnose_detail::UsualSizes usual = diagnose_detail::usual_sizes(fit);
  const std::string speed = "speed / " + shown(usual.speed), spin = "abs(spin) / " + shown(usual.spin),
                    tips = "(left_speed + right_speed) / " + shown(usual.tips);
  const std::string at_speed = " (at " + shown(usual.speed) + " m/s)",
                    at_spin = " (at " + shown(usual.spin) + " rad/s)",
                    at_tips = " (at " + shown(usual.tips) + " m/s)";
  diagnose_detail::Guesses guesses;
  const auto in_all = [&](Acts acts, const std::string& factor) {
    for (const double power : {1.0, 3.0})
      guesses.growing(acts, factor, speed, power, ", growing with the speed" + at_speed,
                      acts == kAgainst ? std::vector{1.0, 2.0} : std::vector<double>{});
    guesses.growing(acts, factor, spin, 1.0, ", growing with the spin" + at_spin);
    guesses.growing(acts, factor, tips, 1.0, ", growing with the speed of the tips" + at_tips);
  };
  guesses.fixed(kAgainst, "", ", of constant size");
  guesses.fixed(kAgainst, "taut", " while on the string, of constant size");
  guesses.fixed(kAgainst, "(1 - taut)", " while off the string, of constant size");
  guesses.fixed(kAgainst, "pull / 10", ", growing with the string's pull (at 10 m/s^2)");
  in_all(kAgainst, "");
  guesses.growing(kAgainst, speed, spin, 1.0,
                  ", growing with the speed" + at_speed + " and the spin" + at_spin, {0.0});
  for (const Acts acts : {kAlong, kAcross}) {
    guesses.fixed(acts, "taut", ", of constant size");
    guesses.fixed(acts, "taut * pull / 10", ", growing with the string's pull (at 10 m/s^2)");
    guesses.fixed(acts, "taut * " + std::string(diagnose_detail::kSenseOfSlip),
                  ", with the sense of the slip");
    in_all(acts, "taut");
  }
  guesses.fixed(kUp, "(1 - taut)", " while off the string, of constant size");
  guesses.growing(kUp, "(1 - taut)", speed, 1.0, " while off the string, growing with the speed" + at_speed);
  guesses.fixed(kLift, "", ", of constant size");
  in_all(kLift, "");
  for (const Acts acts : {kForward, kLeft, kUp}) {
    guesses.fixed(acts, "taut", " while on the string, of constant size");
    guesses.growing(acts, "", spin, 1.0, ", growing with the spin" + at_spin);
    guesses.growing(acts, "", tips, 1.0, ", growing with the speed of the tips" + at_tips);
  }
  diagnose_detail::guess_in_places(guesses, fit);
  if (fit.at[index_of(Unknown::kFriction)] > 0.0) diagnose_detail::guess_rubbing(guesses, fit, usual);
  const std::string slows = "tanh(-spin)";
  for (const double power : {1.0, 3.0})
    guesses.growing(kSpin, slows, spin, power, ", slowing it, growing with it" + at_spin, {0.0, 2.0});
  guesses.fixed(kSpin, slows + " * taut", ", slowing it while on the string");
  guesses.fixed(kSpin, slows + " * (1 - taut)", ", slowing it while off the string");
  guesses.fixed(kSpin, slows + " * pull / 10", ", slowing it, growing with the string's pull (at 10 m/s^2)");
  guesses.growing(kSpin, slows, speed, 1.0, ", slowing it, growing with the speed" + at_speed);
  guesses.growing(kSpin, slows, tips, 1.0, ", slowing it, growing with the speed of the tips" + at_tips);
  guesses.growing(kString, "", speed, 1.0, ", growing with the speed" + at_speed);
  guesses.growing(kString, "", spin, 1.0, ", growing with the spin" + at_spin);
  guesses.growing(kString, "", tips, 1.0, ", growing with the speed of the tips" + at_tips);
  diagnose_detail::guess_by_heading(guesses, usual, slows);
  diagnose_detail::guess_by_hands(guesses, usual, slows);
  if (fit.fit_takes.size() == 1) {
    diagnose_detail::guess_in_time(guesses, windows, fit.fit_takes.front().take->recording.clock);
    guesses.trending(kAgainst, speed, ", growing with the speed" + at_speed + " and in time");
    guesses.trending(kSpin, slows, ", slowing it, growing in time");
  }
  return std::move(guesses.list);
}

/// Leaves out guesses of which nothing is seen, since no recording of the fit shows the spin.
inline void leave_out_unseen(std::vector<LawGuess>& guesses, const Fit& fit) {
  if (std::ranges::none_of(fit.fit_takes, has_spin))
    std::erase_if(guesses, [](const LawGuess& guess) { return guess.law.by_spin(); });
}

}  // namespace diabolo
