// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "diabolo/robot/arm/ik_seed_grid.hpp"
#include "diabolo/robot/arm/inverse.hpp"
#include "diabolo/robot/arm/ur5e.hpp"
#include "random.hpp"

/// Each joint within [-pi, pi].
inline diabolo::Joints<double> random_joints(Random& random) {
  diabolo::Joints<double> q;
  for (int k = 0; k < 6; ++k) q[k] = random.uniform(-M_PI, M_PI);
  return q;
}

/// Largest difference of two joint vectors, whole turns left aside [rad].
inline double turned_apart(const diabolo::Joints<double>& a, const diabolo::Joints<double>& b) {
  double largest = 0;
  for (int k = 0; k < 6; ++k) largest = std::max(largest, std::abs(std::remainder(a[k] - b[k], 2 * M_PI)));
  return largest;
}

/// Largest component that two poses differ in.
inline double apart(const diabolo::Pose<double>& a, const diabolo::Pose<double>& b) {
  return std::max((a.position - b.position).cwiseAbs().maxCoeff(),
                  (a.rotation - b.rotation).cwiseAbs().maxCoeff());
}

/// How far the joints are from each singularity, as InverseSolution measures it; shoulder in [m].
struct Margins {
  double shoulder, wrist, elbow;
  double least() const { return std::min({shoulder, wrist, elbow}); }
};
inline Margins margins(const diabolo::Joints<double>& q) {
  const diabolo::Ur5eLengths l;
  const double along =
      l.a2 * std::cos(q[1]) + l.a3 * std::cos(q[1] + q[2]) + l.d5 * std::sin(q[1] + q[2] + q[3]);
  return {std::abs(along), std::abs(std::sin(q[4])), std::abs(std::sin(q[2]))};
}

/// A calibration as a maker's differs from the data sheet: lengths by a millimetre, angles by a milliradian.
inline diabolo::Ur5eCalibration random_calibration(Random& random) {
  diabolo::Ur5eCalibration calibration = diabolo::nominal_calibration();
  for (diabolo::LinkCalibration& link : calibration) {
    for (double* length : {&link.x, &link.y, &link.z}) *length += random.uniform(-1e-3, 1e-3);
    for (double* angle : {&link.roll, &link.pitch, &link.yaw}) *angle += random.uniform(-1e-3, 1e-3);
  }
  return calibration;
}

inline diabolo::Vector3<double> random_point(Random& random, const diabolo::GridBox& box) {
  return {random.uniform(box.lower.x(), box.upper.x()), random.uniform(box.lower.y(), box.upper.y()),
          random.uniform(box.lower.z(), box.upper.z())};
}

/// What an error of this kind says; other exceptions pass, so that a test fails on them.
template <class Error, class Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}
