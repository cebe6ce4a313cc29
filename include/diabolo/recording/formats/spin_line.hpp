// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <string>

#include "diabolo/math/solve_symmetric.hpp"
#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/formats/tracked_take.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// The line about which a rigid body spins, in the body's frame. Where along it the diabolo's centre lies,
/// spinning cannot tell.
struct SpinLine {
  Eigen::Vector3d axis;   ///< unit, x component >= 0
  Eigen::Vector3d point;  ///< the line's point nearest to the body's origin [m]
  Eigen::Index samples;   ///< how many triples of frames it rests on
};

/// Finds the spin line of a body from a take in which it spins fast: the axis is the principal direction of
/// the turns from frame to frame; the point is the one whose path has the least second difference (least
/// squares), since points off the line circle about it. Frames within two of a dropout are left out. Throws
/// RecordingError where fewer than ten frames remain or the body does not spin.
inline SpinLine find_spin_line(const TrackedTake& take, const TrackedBody& body) {
  const Marks usable = widen_dropouts(body.valid, 2);
  const auto rotation = [&body](Eigen::Index i) {
    return Eigen::Quaterniond(Eigen::Vector4d(body.quaternion.col(i))).toRotationMatrix();
  };
  Eigen::Matrix3d turns = Eigen::Matrix3d::Zero(), normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  SpinLine line{};
  for (Eigen::Index i = 1; i + 1 < usable.size(); ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (!usable[i - 1] || !usable[i] || !usable[i + 1] || take.frame[k + 1] != take.frame[k - 1] + 2)
      continue;
    const Eigen::Matrix3d before = rotation(i - 1), now = rotation(i), after = rotation(i + 1);
    const Eigen::Matrix3d turn = now.transpose() * after;
    const Eigen::Vector3d direction(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0),
                                    turn(1, 0) - turn(0, 1));
    turns += direction * direction.transpose();
    const Eigen::Matrix3d circling = after - 2.0 * now + before;
    normal += circling.transpose() * circling;
    right_side -= circling.transpose() *
                  (body.position.col(i + 1) - 2.0 * body.position.col(i) + body.position.col(i - 1));
    ++line.samples;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(turns);
  if (line.samples < 10 || !(axes.eigenvalues()[2] > 1e-3 * static_cast<double>(line.samples)))
    throw RecordingError(take.file_name + ": " + shown(body.name) + " does not spin enough to show its axis");
  line.axis = axes.eigenvectors().col(2) * (axes.eigenvectors()(0, 2) < 0.0 ? -1.0 : 1.0);
  // Along the axis the data say nothing: only the two directions square to it are solved for.
  Eigen::Matrix<double, 3, 2> square;
  square.col(0) = line.axis.unitOrthogonal();
  square.col(1) = line.axis.cross(square.col(0));
  const Eigen::Matrix2d reduced = square.transpose() * normal * square;
  line.point = square * solve_symmetric(reduced, square.transpose() * right_side).col(0);
  return line;
}

}  // namespace diabolo
