// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "diabolo/diagnose/adequacy.hpp"
#include "diabolo/math/bootstrap.hpp"

namespace diabolo {

/// More is left than noise leaves where noise alone would do so with no greater chance.
inline constexpr double kNoiseMayDoIt = 0.01;

/// Windows in a stretch of time: some four seconds.
inline constexpr std::size_t kStretch = 8;

namespace diagnose_detail {

/// The chance that at least `heads` of `throws` fair coins show heads.
inline double chance_of(std::size_t heads, std::size_t throws) {
  double sum = 0.0;
  for (std::size_t k = heads; k <= throws; ++k) {
    const double n = static_cast<double>(throws), m = static_cast<double>(k);
    sum +=
        std::exp(std::lgamma(n + 1.0) - std::lgamma(m + 1.0) - std::lgamma(n - m + 1.0) - n * std::log(2.0));
  }
  return std::min(1.0, sum);
}

/// What the base, what was found and noise alone leave, each in the same windows or predictions.
struct Compared {
  std::vector<double> base, left, noise;

  void add(double of_base, double of_answer, double of_noise) {
    base.push_back(of_base);
    left.push_back(of_answer);
    noise.push_back(of_noise);
  }
};

/// The middle ones; nothing where fewer than kStretch say anything. What is smaller than `immaterial` counts
/// as that; so many neighbours as `overlap` are one to the test.
inline std::optional<ResidualAndNoise> residual_and_noise_of(const Compared& compared, double immaterial,
                                                             std::size_t overlap) {
  const std::size_t count = compared.left.size();
  if (count / overlap < kStretch) return std::nullopt;
  std::vector<double> times;
  std::size_t above = 0;
  for (std::size_t i = 0; i < count; ++i) {
    times.push_back(compared.left[i] / std::max(compared.noise[i], immaterial));
    above += compared.left[i] > compared.noise[i];
  }
  ResidualAndNoise result;
  result.mode = "ANY";
  result.windows = count;
  result.base = median_of(compared.base);
  result.left = median_of(compared.left);
  result.noise = median_of(compared.noise);
  result.times_noise = median_of(times);
  result.p_value = chance_of(above / overlap, count / overlap);
  return result;
}

/// The share of the gap beyond noise that was closed; nothing where there is none.
inline std::optional<double> explained_of(const ResidualAndNoise& left) {
  if (!(left.base > kTimesNoise * left.noise)) return std::nullopt;
  return std::min(1.0, (left.base - left.left) / (left.base - left.noise));
}

inline bool is_beyond_noise(const ResidualAndNoise& left) {
  return left.times_noise > kTimesNoise && left.p_value < kNoiseMayDoIt;
}

}  // namespace diagnose_detail

}  // namespace diabolo
