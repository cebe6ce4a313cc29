// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "diabolo/estimate/square_root.hpp"
#include "diabolo/strand_tensions.hpp"
#include "diabolo/text/expect_positive.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// The diabolo as a camera saw it. Noises are standard deviations.
struct CameraMeasurement {
  double time = 0.0;                                   ///< when it was seen, not when that is known [s]
  Vector3<double> position = Vector3<double>::Zero();  ///< [m], world frame
  double noise = 5e-3;                                 ///< of each coordinate [m]
  /// A unit vector, which end of the axle it points to does not count; only estimates with an axle take it.
  std::optional<Vector3<double>> axle = std::nullopt;
  double axle_noise = 0.02;                   ///< [rad]
  std::optional<double> spin = std::nullopt;  ///< [rad/s], where the camera sees marks turn
  double spin_noise = 1.0;                    ///< [rad/s]
};

/// Forces of the string on both tips at the end of a step, world frame, less what sticks and arms weigh.
struct ForceMeasurement {
  TipForces<double> forces;  ///< [N]
  /// Lower factors of the covariances of both readings [N].
  MatrixOf<3> left_noise = 0.1 * MatrixOf<3>::Identity(), right_noise = 0.1 * MatrixOf<3>::Identity();
};

/// Tensions of both strands alone.
struct TensionMeasurement {
  double left = 0.0, right = 0.0;  ///< [N]
  double noise = 0.1;              ///< of each, a standard deviation [N]
};

/// What a step's end has of the strands.
using PullMeasurement = std::variant<std::monostate, ForceMeasurement, TensionMeasurement>;

namespace estimate_detail {

inline void expect_finite(const char* what, bool finite) {
  if (!finite) throw std::invalid_argument(std::string(what) + ": not finite; expected numbers");
}
inline void expect_within(const char* what, const char* field, const Vector3<double>& vector, double most) {
  if (!(vector.norm() <= most))
    throw std::invalid_argument(std::string(what) + ", " + field + ": of size " + shown(vector.norm()) +
                                "; expected at most " + shown(most));
}

}  // namespace estimate_detail

/// Throws std::invalid_argument naming the field, what was found and what was expected.
inline void validate(const CameraMeasurement& measured) {
  estimate_detail::expect_finite("camera, time", std::isfinite(measured.time));
  estimate_detail::expect_within("camera", "position", measured.position, 1e4);
  expect_positive("camera, noise", measured.noise);
  expect_positive("camera, axle_noise", measured.axle_noise);
  expect_positive("camera, spin_noise", measured.spin_noise);
  if (measured.axle && !(std::abs(measured.axle->norm() - 1.0) < 1e-6))
    throw std::invalid_argument("camera, axle: norm " + shown(measured.axle->norm()) +
                                "; expected a unit vector");
  if (measured.spin && !(std::abs(*measured.spin) <= 1e5))
    throw std::invalid_argument("camera, spin: " + shown(*measured.spin) + " rad/s; expected at most 100000");
}
inline void validate(const ForceMeasurement& reading) {
  estimate_detail::expect_within("forces", "left", reading.forces.left, 1e5);
  estimate_detail::expect_within("forces", "right", reading.forces.right, 1e5);
  for (const MatrixOf<3>& noise : {reading.left_noise, reading.right_noise})
    for (int i = 0; i < 3; ++i) {
      expect_positive("forces, noise", noise(i, i));
      estimate_detail::expect_finite("forces, noise", noise.allFinite());
    }
}
inline void validate(const TensionMeasurement& reading) {
  for (const auto& [name, tension] : {std::pair("left", reading.left), {"right", reading.right}})
    if (!(std::abs(tension) <= 1e5))
      throw std::invalid_argument(std::string("tensions, ") + name + ": " + shown(tension) +
                                  " N; expected at most 100000");
  expect_positive("tensions, noise", reading.noise);
}

}  // namespace diabolo
