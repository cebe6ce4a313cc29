// SPDX-License-Identifier: MIT
// How fast recordings are read: a Motive CSV of 20 MB with 44 columns of numbers, made in memory, and the
// tidy CSV of the same recording.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/tidy.hpp"
#include "support/job.hpp"

namespace {

constexpr std::size_t kBytes = 20'000'000;
constexpr int kMarkers =
    7;  // with three bodies: 2 + 3 * 7 + 7 * 3 = 44 columns, about as many as Motive's exports have

std::string header(std::size_t frames) {
  std::string types = ",", names = ",", ids = ",", kinds = ",", axes = "Frame,Time (Seconds)";
  const auto add = [&](const std::string& type, const std::string& name, const std::string& kind, char axis) {
    types += "," + type;
    names += "," + name;
    ids += ",\"" + name + "\"";
    kinds += "," + kind;
    axes += std::string(",") + axis;
  };
  for (const std::string name : {"stick_left", "stick_right", "diabolo_red"}) {
    for (const char axis : {'X', 'Y', 'Z', 'W'}) add("Rigid Body", name, "Rotation", axis);
    for (const char axis : {'X', 'Y', 'Z'}) add("Rigid Body", name, "Position", axis);
  }
  for (int m = 1; m <= kMarkers; ++m)
    for (const char axis : {'X', 'Y', 'Z'})
      add("Marker", "stick_left:Marker" + std::to_string(m), "Position", axis);
  return "Format Version,1.22,Export Frame Rate,120.000000,Total Exported Frames," + std::to_string(frames) +
         ",Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global\r\n\r\n" + types + "\r\n" +
         names + "\r\n" + ids + "\r\n" + kinds + "\r\n" + axes + "\r\n";
}

std::string motive_text() {
  std::string rows;
  std::size_t frames = 0;
  for (; rows.size() < kBytes; ++frames) {
    const double time = static_cast<double>(frames) / 120.0;
    const auto put = [&rows](double value) {
      char cell[32];
      rows.append(cell, static_cast<std::size_t>(std::snprintf(cell, sizeof cell, ",%.6f", value)));
    };
    rows += std::to_string(frames);
    put(time);
    for (int body = 0; body < 3; ++body) {
      const double half = 0.5 * (100.0 * time + body);
      for (const double q : {std::sin(half), 0.0, 0.0, std::cos(half)}) put(q);
      for (int k = 0; k < 3; ++k) put(std::sin(time + k));
    }
    for (int k = 0; k < 3 * kMarkers; ++k) put(std::cos(time + k));
    rows += "\r\n";
  }
  return header(frames) + rows;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace diabolo;
  const auto job = [](const std::string& name, auto make) {
    return NamedJob{name, [make] { return std::make_unique<Calls>(1.0, make()); }};
  };
  const auto read = [](const std::string& text) { return read_motive(text, "synthetic.csv"); };
  return run_jobs(
      {job("read_motive_20_MB",
           [=] { return [=, text = motive_text()] { benchmark::DoNotOptimize(read(text)); }; }),
       job("read_motive_20_MB_and_apply_calibration",
           [=] {
             return [=, text = motive_text()] {
               benchmark::DoNotOptimize(apply(published_calibration(), read(text)));
             };
           }),
       job("read_tidy_of_the_same_recording",
           [=] {
             const Recording recording = apply(published_calibration(), read(motive_text()));
             const TidyMetadata known{recording.properties, recording.string_length, recording.rate};
             return [text = write_tidy(recording), known] {
               benchmark::DoNotOptimize(read_tidy(text, "synthetic.csv", known));
             };
           })},
      argc, argv);
}
