// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include <Eigen/Geometry>

#include "diabolo/string/spheroid.hpp"

/// Random numbers for tests: the same ones on every machine, unlike those of the standard distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }  ///< within [0, 1)
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, unit()); }
  bool chance(double probability) { return unit() < probability; }
  int index(int count) { return static_cast<int>(unit() * count); }  ///< within 0 .. count - 1

  /// Each component within [-half_width, half_width].
  diabolo::Vector3<double> vector(double half_width) {
    const double x = uniform(-half_width, half_width), y = uniform(-half_width, half_width);
    return {x, y, uniform(-half_width, half_width)};
  }

  /// Evenly distributed on the unit sphere.
  diabolo::Vector3<double> direction() {
    const double z = uniform(-1.0, 1.0), angle = uniform(-M_PI, M_PI), r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  /// In any direction, its length evenly distributed in the logarithm.
  diabolo::Vector3<double> arrow(double shortest, double longest) {
    const double length = log_uniform(shortest, longest);
    return direction() * length;
  }

  /// A rotation about any axis, by any angle.
  Eigen::Matrix3d rotation() {
    const diabolo::Vector3<double> axis = direction();
    return Eigen::AngleAxisd(uniform(-M_PI, M_PI), axis).toRotationMatrix();
  }

  /// A point that the string reaches; on the taut string with the given probability.
  diabolo::Vector3<double> reachable(const diabolo::Spheroid<double>& spheroid, double on_string = 0.5) {
    const diabolo::Vector3<double> axis = spheroid.axis();
    diabolo::Vector3<double> across = axis.cross(direction());
    across.normalize();
    const double angle = uniform(-M_PI, M_PI), share = chance(on_string) ? 1.0 : std::cbrt(unit());
    return spheroid.center() + axis * (share * spheroid.semi_major() * std::sin(angle)) +
           across * (share * spheroid.semi_minor() * std::cos(angle));
  }

 private:
  std::mt19937_64 engine_;
};
