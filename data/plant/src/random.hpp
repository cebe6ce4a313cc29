// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "geometry.hpp"

namespace plant {

/// Random numbers that are the same on every platform: the standard fixes the engine's bits but leaves its
/// distributions open, so these are our own. Each `stream` of a seed is independent of the others.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : engine_(mixed(mixed(seed) + stream)) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

  /// Uniform among the whole numbers from `low` to `high`, both included.
  int uniform_int(int low, int high) { return low + static_cast<int>(uniform() * (high - low + 1)); }

  /// Standard normal (Box and Muller; the second value of each pair is left unused, which keeps no state).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  Vec3 normal_vector() {
    const double x = normal();
    const double y = normal();
    const double z = normal();
    return {x, y, z};
  }

 private:
  /// The finaliser of SplitMix64: neighbouring numbers become unrelated ones.
  static std::uint64_t mixed(std::uint64_t value) {
    value += 0x9e3779b97f4a7c15u;
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
  }

  std::mt19937_64 engine_;
};

}  // namespace plant
