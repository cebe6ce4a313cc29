// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>

namespace plant {
namespace {

/// Fixed-point text without zeros at its end, the same on every platform.
std::string text_of(double value, int decimals) {
  std::array<char, 64> buffer;
  char* const end = buffer.data() + buffer.size();
  const auto result = std::to_chars(buffer.data(), end, value, std::chars_format::fixed, decimals);
  std::string text(buffer.data(), result.ptr);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

constexpr int kTimeDecimals = 6;
constexpr int kPositionDecimals = 5;     // no camera sees 0.01 mm
constexpr int kOrientationDecimals = 4;  // no camera sees 2e-4 rad
constexpr int kTruthDecimals = 9;

void write_position(std::ostream& out, const std::optional<Pose>& pose) {
  for (int i = 0; i < 3; ++i) out << ',' << (pose ? text_of(pose->position(i), kPositionDecimals) : "");
}

void write_orientation(std::ostream& out, const std::optional<Pose>& pose) {
  for (int i = 0; i < 4; ++i)
    out << ',' << (pose ? text_of(pose->orientation.coeffs()(i), kOrientationDecimals) : "");
}

void write_vector(std::ostream& out, const Vec3& vector) {
  for (int i = 0; i < 3; ++i) out << ',' << text_of(vector(i), kTruthDecimals);
}

}  // namespace

void write_frames(std::ostream& out, const std::vector<Frame>& frames, bool stick_orientation) {
  out << "time,left_x,left_y,left_z,right_x,right_y,right_z,diabolo_x,diabolo_y,diabolo_z,"
         "diabolo_qx,diabolo_qy,diabolo_qz,diabolo_qw";
  if (stick_orientation) out << ",left_qx,left_qy,left_qz,left_qw,right_qx,right_qy,right_qz,right_qw";
  out << '\n';
  for (const Frame& frame : frames) {
    out << text_of(frame.time, kTimeDecimals);
    write_position(out, frame.sticks[0]);
    write_position(out, frame.sticks[1]);
    write_position(out, frame.diabolo);
    write_orientation(out, frame.diabolo);
    if (stick_orientation) {
      write_orientation(out, frame.sticks[0]);
      write_orientation(out, frame.sticks[1]);
    }
    out << '\n';
  }
}

void write_description(std::ostream& out, const Scenario& scenario) {
  const DiaboloParameters& diabolo = scenario.plant.diabolo;
  const nlohmann::ordered_json description = {
      {"schema", "diabolo.recording/1"},
      {"diabolo",
       {{"mass", diabolo.mass},
        {"diameter", diabolo.diameter},
        {"length", diabolo.length},
        {"axle_radius", diabolo.groove.radius + scenario.axle_radius_error}}},
      {"string_length", scenario.plant.string.length + scenario.string_length_error},
      {"rate", scenario.camera.rate},
      {"units", "SI"},
      {"frame", "x forward, y left, z up"},
  };
  out << description.dump(2) << '\n';
}

void write_truth(std::ostream& out, const Plant& plant, const std::vector<Moment>& moments) {
  out << "time,mode,x,y,z,vx,vy,vz,qx,qy,qz,qw,spin,left_tip_x,left_tip_y,left_tip_z,right_tip_x,right_tip_y,"
         "right_tip_z,stretch,wrap,slip,tension_left,tension_right,energy,left_force_x,left_force_y,left_"
         "force_z,"
         "right_force_x,right_force_y,right_force_z\n";
  for (const Moment& moment : moments) {
    const Reading reading = plant.read(moment);
    out << text_of(moment.time, kTruthDecimals) << ',' << mode_name(moment.mode);
    write_vector(out, moment.state.col(kPosition));
    write_vector(out, moment.state.col(kVelocity));
    const Eigen::Quaterniond rotation(orientation(moment.state));
    for (int i = 0; i < 4; ++i) out << ',' << text_of(rotation.coeffs()(i), kTruthDecimals);
    out << ',' << text_of(play_spin(plant.parameters().diabolo, moment.state), kTruthDecimals);
    write_vector(out, reading.tips[0]);
    write_vector(out, reading.tips[1]);
    out << ',' << (std::isfinite(reading.stretch) ? text_of(reading.stretch, kTruthDecimals) : "");
    for (const double value :
         {reading.wrap, reading.slip, reading.tensions.left, reading.tensions.right, reading.energy}) {
      out << ',' << text_of(value, kTruthDecimals);
    }
    write_vector(out, reading.on_tips[0]);
    write_vector(out, reading.on_tips[1]);
    out << '\n';
  }
}

void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  std::ofstream out(temporary, std::ios::binary);
  if (out) write(out);
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(temporary, file, error);
  if (!out || error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(file.string() + ": cannot be written");
  }
}

}  // namespace plant
