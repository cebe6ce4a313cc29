// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "diabolo/recording/formats/tracked_take.hpp"
#include "diabolo/recording/plausibility/odd_tips.hpp"
#include "diabolo/recording/plausibility/swapped_bodies.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Which axis of a file points up, and whether its frame is left-handed, as where two columns are exchanged.
struct UpAxis {
  int axis = 3;           ///< 1 to 3 for x to z, negative for the opposite
  bool mirrored = false;  ///< left and right are exchanged, too
};

/// "y", "-y" or "y-mirrored".
inline std::string text_of(const UpAxis& up) {
  return std::string(up.axis < 0 ? "-" : "") + "xyz"[std::abs(up.axis) - 1] +
         (up.mirrored ? "-mirrored" : "");
}

/// Reads such a text. Throws RecordingError about another one.
inline UpAxis up_axis_of(std::string_view text) {
  for (const int axis : {1, 2, 3, -1, -2, -3})
    for (const bool mirrored : {false, true})
      if (text_of({axis, mirrored}) == text) return {axis, mirrored};
  throw RecordingError("up: " + shown(text) +
                       "; expected x, y, z, -x, -y or -z, with -mirrored behind it for a left-handed frame");
}

/// What takes directions of the file to those with z up: a rotation that keeps x where it can, then left and
/// right exchanged where the frame is mirrored.
inline Eigen::Matrix3d turn_to_z_up(const UpAxis& up) {
  const Eigen::Vector3d z = (up.axis > 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(std::abs(up.axis) - 1);
  const Eigen::Vector3d x = std::abs(up.axis) == 1
                                ? Eigen::Vector3d((up.axis > 0 ? -1.0 : 1.0) * Eigen::Vector3d::UnitZ())
                                : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  Eigen::Matrix3d turn;
  turn << x.transpose(), (up.mirrored ? -1.0 : 1.0) * z.cross(x).transpose(), z.transpose();
  return turn;
}

namespace recording_formats_detail {

/// Turns positions, and orientations from body to file; a mirrored body keeps its x and z.
inline void turn_frame(const Eigen::Matrix3d& turn, Eigen::Matrix3Xd& position,
                       Eigen::Matrix4Xd& quaternion) {
  const Eigen::Vector3d kept(1.0, turn.determinant(), 1.0);
  for (Eigen::Index i = 0; i < position.cols(); ++i)
    position.col(i) = Eigen::Vector3d(turn * position.col(i));
  for (Eigen::Index i = 0; i < quaternion.cols(); ++i) {
    if (quaternion.col(i).array().isNaN().any()) continue;
    const Eigen::Quaterniond given(Eigen::Vector4d(quaternion.col(i)));
    quaternion.col(i) =
        Eigen::Quaterniond(turn * given.toRotationMatrix() * kept.asDiagonal()).normalized().coeffs();
  }
}

}  // namespace recording_formats_detail

/// The recording in another frame.
inline Recording turned(Recording r, const Eigen::Matrix3d& turn) {
  recording_formats_detail::turn_frame(turn, r.left.position, r.left_orientation.quaternion);
  recording_formats_detail::turn_frame(turn, r.right.position, r.right_orientation.quaternion);
  recording_formats_detail::turn_frame(turn, r.diabolo.position, r.diabolo_orientation.quaternion);
  return r;
}

/// The recording with z up, of one in which another axis points up.
inline Recording turned_to_z_up(Recording r, const UpAxis& up) {
  return turned(std::move(r), turn_to_z_up(up));
}

/// The recording with y to the player's left, of one whose frame is turned about the vertical by quarters, as
/// the tips show; a note tells. (By a half only where the sticks' directions say the same: exchanged sticks
/// look alike.)
inline Recording turned_to_face_forward(Recording r) {
  const int off = quarters_off(r).value_or(0);
  if (off == 0 || (off == 2 && sticks_are_exchanged(r) != false)) return r;
  const int degrees = -90 * off;
  r.notes.push_back("the left tip does not lie to the left, along y: all is turned by " +
                    std::to_string(degrees) + " degrees about the vertical" +
                    (off != 2 && !sticks_are_exchanged(r)
                         ? ", and the spin's sign is right unless the sticks "
                           "are exchanged"
                         : ""));
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
  return turned(std::move(r), turn.toRotationMatrix());
}

/// The take with z up, of one in which another axis points up; the bodies' own frames stay.
inline TrackedTake turned_to_z_up(TrackedTake take, const UpAxis& up) {
  const Eigen::Matrix3d turn = turn_to_z_up(up);
  Eigen::Matrix4Xd none(4, 0);
  for (TrackedBody& body : take.bodies)
    recording_formats_detail::turn_frame(turn, body.position, body.quaternion);
  for (TrackedMarker& marker : take.markers)
    recording_formats_detail::turn_frame(turn, marker.position, none);
  return take;
}

}  // namespace diabolo
