// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace diabolo {

/// Random numbers of one environment. They depend on its seed, the episode and how many were drawn in it, and
/// on nothing else: so an environment plays the same alone and among a thousand.
class Draw {
 public:
  Draw() = default;
  Draw(std::uint64_t seed, std::uint64_t episode) : key_(mixed(mixed(seed) + episode)) {}

  /// Uniform within [low, high).
  double uniform(double low, double high) { return low + (high - low) * share(); }

  /// Uniform among 0, 1, ..., count - 1.
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(share() * static_cast<double>(count));
  }

  /// Of the standard normal distribution (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - share()));
    return radius * std::cos(2.0 * std::numbers::pi * share());
  }

 private:
  /// Uniform within [0, 1), on a grid of 2^-53.
  double share() { return static_cast<double>(mixed(key_ + ++drawn_) >> 11) * 0x1p-53; }

  /// The output function of SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number
  /// generators").
  static std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  }

  std::uint64_t key_ = 0, drawn_ = 0;
};

}  // namespace diabolo
