// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <algorithm>
#include <cmath>

namespace plant {
namespace {

/// One body's share of noise and lost frames, drawn from streams of its own.
class BodyNoise {
 public:
  BodyNoise(const CameraParameters& camera, std::uint64_t seed, std::uint64_t body)
      : camera_(camera),
        positions_(seed, 3 * body),
        attitudes_(seed, 3 * body + 1),
        losses_(seed, 3 * body + 2),
        persistence_(std::exp(-1.0 / (camera.rate * camera.drift_time))),
        drift_(camera.drift_noise * positions_.normal_vector()) {}

  /// The next frame of a body whose true pose is given.
  std::optional<Pose> record(Pose pose) {
    pose.position += camera_.white_noise * positions_.normal_vector() + drift_;
    const double innovation = std::sqrt(1.0 - persistence_ * persistence_);
    drift_ = persistence_ * drift_ + innovation * camera_.drift_noise * positions_.normal_vector();
    const Vec3 turn = 0.5 * camera_.attitude_noise * attitudes_.normal_vector();
    pose.orientation =
        (pose.orientation * Eigen::Quaterniond(1.0, turn.x(), turn.y(), turn.z())).normalized();
    if (pose.orientation.w() < 0.0) pose.orientation.coeffs() *= -1.0;
    if (is_lost()) return std::nullopt;
    return pose;
  }

 private:
  bool is_lost() {
    if (lost_frames_ == 0) {
      const double mean = 0.5 * (camera_.shortest_dropout + camera_.longest_dropout);
      const double onset = camera_.dropout_share / (mean * (1.0 - camera_.dropout_share));
      if (losses_.uniform() < onset) {
        lost_frames_ = losses_.uniform_int(camera_.shortest_dropout, camera_.longest_dropout);
      }
    }
    if (lost_frames_ == 0) return false;
    --lost_frames_;
    return true;
  }

  const CameraParameters& camera_;
  RandomStream positions_;
  RandomStream attitudes_;
  RandomStream losses_;
  double persistence_;
  Vec3 drift_;
  int lost_frames_ = 0;
};

/// From the true frame to the recorded one.
Pose in_recorded_frame(const CameraParameters& camera, const Pose& pose) {
  const Eigen::Quaterniond tilt = recorded_rotation(camera);
  return {camera.scale * (tilt * pose.position), tilt * pose.orientation};
}

Pose seen_stick(const Stick& stick, const Vec3& offset, bool turning) {
  const Eigen::Quaterniond orientation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), stick.direction);
  return {stick.tip + (turning ? orientation * offset : offset), orientation};
}

Pose seen_diabolo(const State& state, const Vec3& offset) {
  const Eigen::Matrix3d rotation = orientation(state);
  return {state.col(kPosition) + rotation * offset, Eigen::Quaterniond(rotation)};
}

double frame_time(const CameraParameters& camera, std::size_t frame) {
  return static_cast<double>(frame) / camera.rate;
}

}  // namespace

Eigen::Quaterniond recorded_rotation(const CameraParameters& camera) {
  const Vec3 axis(std::sin(camera.tilt_azimuth), -std::cos(camera.tilt_azimuth), 0.0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(camera.tilt, axis));
}

std::vector<double> diabolo_times(const CameraParameters& camera, double duration) {
  const auto frames = static_cast<std::size_t>(std::floor(duration * camera.rate + 1e-9)) + 1;
  std::vector<double> times(frames);
  for (std::size_t i = 0; i < frames; ++i) times[i] = frame_time(camera, i) - camera.diabolo_delay;
  return times;
}

std::vector<Frame> film(const CameraParameters& camera, const Motion& motion,
                        const std::vector<Moment>& moments, std::uint64_t seed) {
  Pair<BodyNoise> stick_noise{BodyNoise(camera, seed, 0), BodyNoise(camera, seed, 1)};
  BodyNoise diabolo_noise(camera, seed, 2);
  std::vector<Frame> frames(moments.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Frame& frame = frames[i];
    frame.time = frame_time(camera, i);
    for (std::size_t side = 0; side < 2; ++side) {
      const Stick stick = motion.at(frame.time - camera.stick_delays[side])[side];
      const Pose seen = seen_stick(stick, camera.tip_offsets[side], camera.stick_orientation);
      frame.sticks[side] = stick_noise[side].record(in_recorded_frame(camera, seen));
    }
    const Pose seen = seen_diabolo(moments[i].state, camera.centre_offset);
    frame.diabolo = diabolo_noise.record(in_recorded_frame(camera, seen));
  }
  return frames;
}

}  // namespace plant
