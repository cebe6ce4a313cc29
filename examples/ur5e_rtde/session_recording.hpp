// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "diabolo/json/recording_file.hpp"
#include "diabolo/robot/arm/stick_arm.hpp"

namespace ur5e {

/// What the arms were sent and where they were, tick by tick; written as tidy recordings of the stick tips,
/// in which the diabolo is never seen.
class SessionRecording {
 public:
  explicit SessionRecording(std::size_t most) { ticks_.reserve(most); }

  /// Takes no memory until `most` ticks are full; then it records no more.
  void add(double time, const diabolo::PairJoints& commanded, const diabolo::PairJoints& actual) {
    if (ticks_.size() < ticks_.capacity()) ticks_.push_back({time, commanded, actual});
  }
  std::size_t size() const { return ticks_.size(); }

  /// The tips of one of both.
  diabolo::Recording tips(const diabolo::StickArm& left, const diabolo::StickArm& right,
                          const std::string& name, bool commanded) const {
    const auto size = static_cast<Eigen::Index>(ticks_.size());
    diabolo::Recording recording;
    recording.name = name;
    recording.rate = 1 / diabolo::kTick;
    recording.time.resize(size);
    recording.left = recording.right = recording.diabolo = diabolo::Track::missing(size);
    recording.diabolo_orientation = diabolo::OrientationTrack::missing(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const Tick& tick = ticks_[static_cast<std::size_t>(i)];
      const diabolo::PairJoints& joints = commanded ? tick.commanded : tick.actual;
      recording.time[i] = tick.time - ticks_.front().time;
      recording.frame.push_back(std::lround(recording.time[i] * recording.rate));
      recording.left.position.col(i) = left.tip_at(joints.head<diabolo::kJointCount>());
      recording.right.position.col(i) = right.tip_at(joints.tail<diabolo::kJointCount>());
      recording.left.valid[i] = recording.right.valid[i] = true;
    }
    return recording;
  }

  /// Writes NAME.csv, the actual tips, and NAME_commanded.csv, each with its JSON file, none ever
  /// half-written. Throws diabolo::RecordingError as save_tidy() does.
  void save(const diabolo::StickArm& left, const diabolo::StickArm& right,
            const std::filesystem::path& path) const {
    const std::filesystem::path stem = path.stem(), folder = path.parent_path();
    const std::filesystem::path commanded = folder / (stem.string() + "_commanded.csv");
    diabolo::save_tidy(tips(left, right, stem.string(), false), path);
    diabolo::save_tidy(tips(left, right, commanded.stem().string(), true), commanded);
  }

  // Joints, for whoever looks at how late the arms follow.
  std::vector<diabolo::PairJoints> commanded() const { return all(&Tick::commanded); }
  std::vector<diabolo::PairJoints> actual() const { return all(&Tick::actual); }

 private:
  struct Tick {
    double time;  ///< [s]
    diabolo::PairJoints commanded, actual;
  };
  std::vector<diabolo::PairJoints> all(diabolo::PairJoints Tick::*which) const {
    std::vector<diabolo::PairJoints> joints;
    for (const Tick& tick : ticks_) joints.push_back(tick.*which);
    return joints;
  }

  std::vector<Tick> ticks_;
};

}  // namespace ur5e
