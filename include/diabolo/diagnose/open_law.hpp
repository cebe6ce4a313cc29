// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/fit.hpp"
#include "diabolo/math/bootstrap.hpp"

namespace diabolo {

/// From this deviation on an exponent says nothing.
inline constexpr double kVagueExponent = 1.0;

/// What one window says of an unknown at a fit, all others held.
struct WindowSays {
  double x, value, precision;
};

namespace diagnose_detail {

/// Mean speed of the recorded diabolo in a window [m/s].
inline double mean_speed(const FitTake& fit_take, const FitWindow& window) {
  const Track& track = fit_take.take->recording.diabolo;
  double length = 0.0, seconds = 0.0;
  for (Eigen::Index i = window.first; i < window.last; ++i) {
    if (!track.valid[i] || !track.valid[i + 1]) continue;
    length += (track.position.col(i + 1) - track.position.col(i)).norm();
    seconds += fit_take.take->times[i + 1] - fit_take.take->times[i];
  }
  return seconds > 0.0 ? length / seconds : 0.0;
}

template <class Scalar>
std::vector<WindowSays> windows_say(const Fit& fit, Unknown unknown, Scalar&& scalar) {
  const int u = index_of(unknown);
  std::vector<WindowSays> result;
  std::size_t i = 0;
  for (const FitTake& fit_take : fit.fit_takes)
    for (const FitWindow& window : fit_take.windows) {
      const WindowScore& score = fit.scores[i++];
      const double precision = score.weight * score.information(u, u), x = scalar(fit_take, window);
      if (precision > 1e-6 && x > 1e-3)
        result.push_back({x, score.score[u] / score.information(u, u) * info_of(unknown).scale, precision});
    }
  std::ranges::sort(result, {}, &WindowSays::x);
  return result;
}

}  // namespace diagnose_detail

/// The power of x that explains best what windows, in the order of x, say: least squares for each exponent on
/// a grid; its deviation is where the sum of squares has grown by one window's worth. Where that is far off,
/// the force counts as constant. Fewer than eight windows have no law.
inline PowerLaw power_law(const std::vector<WindowSays>& windows, std::string_view scalar,
                          std::string_view unit) {
  constexpr std::size_t kFewest = 8, kPoints = 6;
  constexpr double kLeast = -2.0, kMost = 4.0, kStep = 0.05;
  PowerLaw law;
  law.scalar = scalar;
  law.unit = unit;
  if (windows.size() < kFewest) return law;
  law.at = windows[windows.size() / 2].x;
  double nothing = 0.0;
  for (const WindowSays& w : windows) nothing += w.precision * w.value * w.value;
  const auto fitted = [&](double exponent) {  // the rest, and the value at law.at
    double cross = 0.0, square = 0.0;
    for (const WindowSays& w : windows) {
      const double power = std::pow(w.x / law.at, exponent);
      cross += w.precision * power * w.value;
      square += w.precision * power * power;
    }
    return std::pair(nothing - cross * cross / square, cross / square);
  };
  double least = fitted(0.0).first;
  for (int k = 0; k * kStep <= kMost - kLeast; ++k)
    if (const double rest = fitted(kLeast + k * kStep).first; rest < least)
      least = rest, law.exponent = kLeast + k * kStep;
  const double one = least / static_cast<double>(windows.size() - 2);
  const auto reach = [&](double step) {
    double p = law.exponent, before = least, now = least;
    while (now < least + one && std::abs(p - law.exponent) < kMost) {
      before = now;
      now = fitted(p += step).first;
    }
    if (now < least + one) return kMost;
    return std::abs(p - step * (now - least - one) / std::max(now - before, 1e-300) - law.exponent);
  };
  law.deviation = 0.5 * (reach(kStep) + reach(-kStep));
  if (law.deviation > kVagueExponent) law.exponent = 0.0;
  const auto [rest, value] = fitted(law.exponent);
  law.value = value;
  law.explained = nothing > 0.0 ? 1.0 - rest / nothing : 0.0;
  for (std::size_t k = 0; k < kPoints; ++k) {
    double x = 0.0, sum = 0.0, precision = 0.0;
    const std::size_t first = windows.size() * k / kPoints, last = windows.size() * (k + 1) / kPoints;
    for (std::size_t i = first; i < last; ++i) {
      x += windows[i].x / static_cast<double>(last - first);
      sum += windows[i].precision * windows[i].value;
      precision += windows[i].precision;
    }
    law.curve.emplace_back(x, sum / precision);
  }
  return law;
}

/// What the windows say, in the order of their speed, or spin.
inline std::vector<WindowSays> windows_by(std::string_view scalar, const Fit& fit, Unknown unknown) {
  const auto of_spin = [](const FitTake&, const FitWindow& window) { return std::abs(window.start.spin); };
  return scalar == "spin" ? diagnose_detail::windows_say(fit, unknown, of_spin)
                          : diagnose_detail::windows_say(fit, unknown, diagnose_detail::mean_speed);
}

/// How the force behind a latent acceleration grows: with the speed or with the spin, whichever explains
/// more.
inline PowerLaw open_law(const Fit& fit, Unknown unknown) {
  PowerLaw speed = power_law(windows_by("speed", fit, unknown), "speed", "m/s"),
           spin = power_law(windows_by("spin", fit, unknown), "spin", "rad/s");
  return spin.explained > speed.explained ? spin : speed;
}

}  // namespace diabolo
