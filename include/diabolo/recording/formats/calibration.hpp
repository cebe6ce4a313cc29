// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/formats/body_names.hpp"
#include "diabolo/recording/formats/tracked_take.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Where a point of the model sits in a rigid body of the motion capture.
struct BodyPoint {
  std::vector<std::string> bodies;  ///< names of the rigid body, tried in order
  Eigen::Vector3d point;            ///< [m], in the rigid body's frame
  Eigen::Vector3d axis;  ///< in the rigid body's frame, unit: along the stick outwards, or the spin axis
};

/// How the rigid bodies of a take become the tips and the diabolo of a recording.
struct Calibration {
  BodyPoint left, right, diabolo;
  double world_yaw = 0.0;                                  ///< world = Rz(yaw) * capture + offset [rad]
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero();  ///< [m]
  DiaboloProperties properties = kRedDiabolo;
  double string_length = kPublishedStringLength;  ///< [m]
  std::vector<std::string> assumed = {};          ///< those of kAssumable that it does not tell
};

/// The direction in which a stick runs, where nothing else is known: from the body's origin, amid markers
/// that ring the stick, to its tip (in the published takes within 4 degrees of the normal of that ring); the
/// body's x axis where the tip is unknown (zero).
inline Eigen::Vector3d stick_axis_towards(const Eigen::Vector3d& tip) {
  return tip.norm() > 0.01 ? Eigen::Vector3d(tip.normalized()) : Eigen::Vector3d::UnitX();
}

/// The published calibration of the red diabolo with the sticks of July 2020: tips from the calibration takes
/// of 2020-07-16, centre and spin axis from that of 2020-08-20; world x forward, y left, z up. The digits
/// beyond the sixth are those with which the authors' processed files follow from the raw ones (least
/// squares; residual below 1e-11 m).
inline Calibration published_calibration() {
  const Eigen::Vector3d left(0.10089205174912, -0.01213736102157, 0.02777518408579);
  const Eigen::Vector3d right(0.10446327172001, -0.00464715716293, 0.00547257636088);
  return {.left = {{"stick_left"}, left, stick_axis_towards(left)},
          .right = {{"stick_right"}, right, stick_axis_towards(right)},
          .diabolo = {{"diabolo_red"},
                      {-0.06544073053103, -0.00596005925319, -0.01285071372451},
                      Eigen::Vector3d(-0.99973054685435, -0.01458713204346, 0.01805683430335).normalized()},
          .world_yaw = -std::numbers::pi / 2.0,
          .world_offset = {0.1, -0.2, 0.3},
          .properties = kRedDiabolo,
          .string_length = kPublishedStringLength};
}

/// Of bodies that are the tips and the diabolo themselves, in the world frame; their names tell which is
/// which. It does not tell what string and diabolo are like.
inline Calibration plain_calibration() {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero(), x = Eigen::Vector3d::UnitX();
  return {.left = {{"left", "/left_tip"}, none, x},
          .right = {{"right", "/right_tip"}, none, x},
          .diabolo = {{"diabolo", "/diabolo"}, none, x},
          .assumed = {kAssumable.begin(), kAssumable.end()}};
}

/// For the take of 2020-11-12 with the blue diabolo, of which no calibration take exists.
/// Its spin axis and the point nearest to the body's origin on it are what find_spin_line() finds in the take
/// itself (to about 1 mm and 0.1 degrees); where along the axle the centre lies is unknown, zero here. The
/// tip offsets of its sticks are unknown too and zero here, so that "tips" are the rigid bodies' origins,
/// some 0.1 m short of the true tips, and have to be estimated.
inline Calibration blue_calibration() {
  Calibration result = published_calibration();
  result.left = {{"stick_left"}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
  result.right = {{"stick_right_2010_10"}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
  result.diabolo = {{"diabolo_blue_2020_10"},
                    {0.000378, -0.019806, 0.005022},
                    Eigen::Vector3d(0.998871, 0.028677, 0.037861).normalized()};
  result.properties = kBlueDiabolo;
  return result;
}

/// Throws RecordingError unless every part of the calibration is usable; `where` opens the sentence.
inline void check_calibration(const Calibration& calibration, const std::string& where) {
  const auto check = [&where](const char* name, const BodyPoint& part) {
    if (part.bodies.empty() || std::ranges::count(part.bodies, "") > 0)
      throw RecordingError(where + ": " + name + ".body is empty; expected the name of a rigid body");
    if (!(part.point.cwiseAbs().array() <= kLargestCoordinate).all())
      throw RecordingError(where + ": " + name + ".point [m] must be finite and within 100 m");
    if (!(std::abs(part.axis.norm() - 1.0) <= 1e-9))
      throw RecordingError(where + ": " + name + ".axis has norm " + shown(part.axis.norm()) +
                           "; expected 1");
  };
  check("left", calibration.left);
  check("right", calibration.right);
  check("diabolo", calibration.diabolo);
  const auto differ = [&where](const char* name, const BodyPoint& part, const char* other_name,
                               const BodyPoint& other) {
    for (const std::string& body : part.bodies)
      if (std::ranges::count(other.bodies, body) > 0)
        throw RecordingError(where + ": " + name + ".body and " + other_name + ".body are both " +
                             shown(body) + "; expected different rigid bodies");
  };
  differ("left", calibration.left, "right", calibration.right);
  differ("left", calibration.left, "diabolo", calibration.diabolo);
  differ("right", calibration.right, "diabolo", calibration.diabolo);
  if (!std::isfinite(calibration.world_yaw)) throw RecordingError(where + ": the world's yaw must be finite");
  if (!(calibration.world_offset.cwiseAbs().array() <= kLargestCoordinate).all())
    throw RecordingError(where + ": world.offset [m] must be finite and within 100 m");
  check_properties(calibration.properties, calibration.string_length, where);
  check_assumed(calibration.assumed, where);
}

/// The calibration, with string and diabolo of `setup` where it only assumes them.
inline Calibration completed(Calibration calibration, const Calibration& setup) {
  std::erase_if(calibration.assumed, [&](const std::string& name) {
    if (name == "diabolo")
      calibration.properties = setup.properties;
    else
      calibration.string_length = setup.string_length;
    return std::ranges::count(setup.assumed, name) == 0;
  });
  return calibration;
}

/// The smallest rotation that takes x to the direction of `axis`, of any length but zero.
inline Eigen::Quaterniond turn_from_x(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d to = axis.normalized();
  const Eigen::Quaterniond doubled(1.0 + to[0], 0.0, -to[2], to[1]);  // cos and sin of half the angle, scaled
  return doubled.norm() < 1e-9 ? Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0) : doubled.normalized();
}

/// The left stick's, the right stick's and the diabolo's body; see above.
inline std::array<const TrackedBody*, 3> find_bodies(const Calibration& calibration, const TrackedTake& take,
                                                     std::vector<std::string>& notes) {
  return find_bodies({{{calibration.left.bodies, "the left stick", "left"},
                       {calibration.right.bodies, "the right stick", "right"},
                       {calibration.diabolo.bodies, "the diabolo", "diabolo"}}},
                     take, notes);
}

/// The recording that a take shows under a calibration: the bodies' points and axes, in the world frame.
/// It is named after the take's file. Throws RecordingError where a body is missing or the calibration is
/// unusable.
inline Recording apply(const Calibration& calibration, const TrackedTake& take) {
  check_calibration(calibration, "calibration");
  const Eigen::Quaterniond yaw(Eigen::AngleAxisd(calibration.world_yaw, Eigen::Vector3d::UnitZ()));
  const Eigen::Index size = take.time.size();
  const auto transform = [&](const BodyPoint& part, const TrackedBody& body, Track& track,
                             OrientationTrack& orientation) {
    // Any rotation that takes body x to the axis would do; this one turns least.
    const Eigen::Quaterniond to_axis = turn_from_x(part.axis);
    const bool is_point = body.quaternion.cols() == 0, is_origin = part.point.isZero();
    if (is_point && !is_origin)
      throw RecordingError(take.file_name + ": " + shown(body.name) +
                           " has no orientation, but the calibration has a point in it; expected 0, 0, 0");
    track = Track::missing(size);
    if (!is_point) orientation = OrientationTrack::missing(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const bool is_turned = !is_point && body.quaternion.col(i).allFinite();
      if (!body.valid[i] || !(is_turned || is_origin)) continue;
      Eigen::Vector3d place = body.position.col(i);
      if (is_turned) {
        const Eigen::Quaterniond rotation(Eigen::Vector4d(body.quaternion.col(i)));
        place += rotation * part.point;
        orientation.quaternion.col(i) = (yaw * rotation * to_axis).normalized().coeffs();
        orientation.valid[i] = true;
      }
      track.position.col(i) = yaw * place + calibration.world_offset;
      track.valid[i] = true;
    }
  };
  Recording result;
  result.file = take.file_name;
  result.name = std::filesystem::path(take.file_name).stem().string();
  result.rate = take.rate;
  result.frame = take.frame;
  result.time = take.time;
  result.notes = take.notes;
  const std::array<const TrackedBody*, 3> bodies = find_bodies(calibration, take, result.notes);
  transform(calibration.left, *bodies[0], result.left, result.left_orientation);
  transform(calibration.right, *bodies[1], result.right, result.right_orientation);
  transform(calibration.diabolo, *bodies[2], result.diabolo, result.diabolo_orientation);
  result.properties = calibration.properties;
  result.string_length = calibration.string_length;
  result.assumed = calibration.assumed;
  return result;
}

}  // namespace diabolo
