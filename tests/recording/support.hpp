// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "diabolo/recording/recording.hpp"
#include "diabolo/text/error.hpp"

namespace diabolo::test {

/// What a RecordingError says; other exceptions pass, so that a test fails on them.
template <class Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "(no complaint)";
}

/// The folder of the real recordings, from DIABOLO_RECORDINGS; says so in one sentence where there is none.
inline std::optional<std::filesystem::path> recordings_folder(const std::string& test) {
  if (const char* folder = std::getenv("DIABOLO_RECORDINGS")) return folder;
  std::cout << "Not run, because DIABOLO_RECORDINGS names no folder of recordings: " << test << ".\n";
  return std::nullopt;
}

/// A folder of its own, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "diabolo-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  std::size_t entries() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path_)) ++count;
    return count;
  }

 private:
  std::filesystem::path path_;
};

/// `text` with the first `from` replaced; fails loudly where there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

/// A small Motive export: sticks and diabolo, frames from 40 on at 120 Hz, frame 41 without the diabolo.
inline std::string motive_text() {
  return "Format Version,1.22,Take Name,Two beats,Capture Frame Rate,120.000000,Export Frame Rate,120.000000,"
         "Total Exported Frames,3,Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global\n"
         "\n"
         ",,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid "
         "Body,"
         "Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,"
         "Rigid Body,Rigid Body,Rigid Body,Marker,Marker,Marker\n"
         ",,stick_left,stick_left,stick_left,stick_left,stick_left,stick_left,stick_left,\"diabolo_red\","
         "\"diabolo_red\",\"diabolo_red\",\"diabolo_red\",\"diabolo_red\",\"diabolo_red\",\"diabolo_red\","
         "stick_right,"
         "stick_right,stick_right,stick_right,stick_right,stick_right,stick_right,diabolo_red:Marker1,"
         "diabolo_red:Marker1,diabolo_red:Marker1\n"
         ",,\"A1\",\"A1\",\"A1\",\"A1\",\"A1\",\"A1\",\"A1\",\"B2\",\"B2\",\"B2\",\"B2\",\"B2\",\"B2\","
         "\"B2\",\"C3\","
         "\"C3\",\"C3\",\"C3\",\"C3\",\"C3\",\"C3\",\"D4\",\"D4\",\"D4\"\n"
         ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Rotation,Rotation,Rotation,"
         "Rotation,"
         "Position,Position,Position,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Position,"
         "Position,Position\n"
         "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,X,Y,Z,W,X,Y,Z,X,Y,Z,W,X,Y,Z,X,Y,Z\n"
         "40,0.333333,0,0,0,1,-0.25,0.5,1,1,0,0,0,0.01,0.6,0.5,0,0,1,0,0.25,0.5,1,0.1,0.2,0.3\n"
         "41,0.341667,0,0,0,1,-0.25,0.5,1.01,,,,,,,,0,0,1,0,0.25,0.5,0.99,,,\n"
         "42,0.350000,0,0,0,1,-0.25,0.5,1.02,0.6,0.8,0,0,0.03,0.6,0.5,0,0,1,0,0.25,0.5,0.98,0.1,0.2,0.35\n";
}

/// A tidy CSV without stick orientation, the diabolo missing in its second row.
inline std::string tidy_text() {
  return "time,left_x,left_y,left_z,right_x,right_y,right_z,diabolo_x,diabolo_y,diabolo_z,"
         "diabolo_qx,diabolo_qy,diabolo_qz,diabolo_qw\n"
         "0,0.1,0.3,1,0.1,-0.3,1,0.1,0,0.4,1,0,0,0\n"
         "0.01,0.1,0.3,1.01,0.1,-0.3,0.99,,,,,,,\n"
         "0.02,0.1,0.3,1.02,0.1,-0.3,0.98,0.1,0,0.41,0.6,0.8,0,0\n";
}

/// A recording drawn at random: 1 to 40 samples at 120 Hz with dropouts, any of the orientations absent.
inline Recording random_recording(std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-3.0, 3.0), jitter(-0.0001, 0.0001);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution dropout(0.2), absent(0.3);
  const Eigen::Index size = std::uniform_int_distribution<Eigen::Index>(1, 40)(generator);
  const double start = coordinate(generator) * 100.0;
  Recording recording;
  recording.name = "random";
  recording.rate = 120.0;
  recording.time.resize(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    recording.time[i] = start + static_cast<double>(i) / 120.0 + jitter(generator);
    recording.frame.push_back(std::lround(recording.time[i] * 120.0));
  }
  for (Track* track : {&recording.left, &recording.right, &recording.diabolo}) {
    *track = Track::missing(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      track->valid[i] = !dropout(generator);
      if (track->valid[i])
        track->position.col(i) << coordinate(generator), coordinate(generator), coordinate(generator);
    }
  }
  for (OrientationTrack* track :
       {&recording.diabolo_orientation, &recording.left_orientation, &recording.right_orientation}) {
    if (track != &recording.diabolo_orientation && absent(generator)) continue;
    *track = OrientationTrack::missing(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      track->valid[i] = !dropout(generator);
      if (track->valid[i])
        track->quaternion.col(i) =
            Eigen::Vector4d(normal(generator), normal(generator), normal(generator), normal(generator))
                .normalized();
    }
  }
  return recording;
}

/// Equal bit for bit where valid, and valid alike.
inline bool same(const Track& a, const Track& b) {
  if (a.valid.size() != b.valid.size() || (a.valid != b.valid).any()) return false;
  for (Eigen::Index i = 0; i < a.valid.size(); ++i)
    if (a.valid[i] && a.position.col(i) != b.position.col(i)) return false;
  return true;
}
inline bool same(const OrientationTrack& a, const OrientationTrack& b) {
  if (a.valid.size() != b.valid.size() || (a.valid != b.valid).any()) return false;
  for (Eigen::Index i = 0; i < a.valid.size(); ++i)
    if (a.valid[i] && a.quaternion.col(i) != b.quaternion.col(i)) return false;
  return true;
}
inline bool same(const Recording& a, const Recording& b) {
  return a.rate == b.rate && a.frame == b.frame && a.time == b.time && same(a.left, b.left) &&
         same(a.right, b.right) && same(a.diabolo, b.diabolo) &&
         same(a.diabolo_orientation, b.diabolo_orientation) && same(a.left_orientation, b.left_orientation) &&
         same(a.right_orientation, b.right_orientation) && a.string_length == b.string_length &&
         a.properties.mass == b.properties.mass && a.properties.diameter == b.properties.diameter &&
         a.properties.length == b.properties.length && a.properties.axle_radius == b.properties.axle_radius;
}

/// A new seed for each run, printed so that a failure can be repeated.
inline std::uint32_t fresh_seed() {
  const std::uint32_t seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  return seed;
}

}  // namespace diabolo::test
