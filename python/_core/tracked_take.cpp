// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/tracked_take.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "diabolo/json/recording_file.hpp"
#include "diabolo/recording/check.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/up_axis.hpp"
#include "diabolo/recording/plausibility/regular_times.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/file.hpp"
#include "diabolo/text/shown.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "tracks.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

/// A rigid body's name, positions (N, 3) and, unless it is a point, orientations (N, 4).
using GivenBody = std::tuple<std::string, Array, std::optional<Array>>;

/// The take that somebody else's reader found in a file.
TrackedTake take_of(const std::string& file, const Array& time, const std::vector<GivenBody>& bodies) {
  expect_shape(time, "time", {kAny});
  const py::ssize_t size = time.shape(0);
  TrackedTake take;
  take.file_name = file;
  take.time = Eigen::Map<const Eigen::VectorXd>(time.data(), size);
  for (py::ssize_t i = 0; i < size; ++i)
    if (!(std::abs(take.time[i]) <= kLargestTime) || (i > 0 && !(take.time[i] > take.time[i - 1])))
      throw RecordingError(file + ", sample " + std::to_string(i) + ": time " + shown(take.time[i]) +
                           " s; expected finite times that increase");
  if (size < 2) throw RecordingError(file + ": " + std::to_string(size) + " samples; expected two at least");
  take.rate = rate_of(take.time);
  check_rate(take.rate, take.time, file);
  for (const double t : take.time) take.frame.push_back(std::lround(t * take.rate));
  for (const auto& [name, position, quaternion] : bodies) {
    const std::string where = file + ", " + name;
    const Track track = to_track(position, where + ", position", size);
    const OrientationTrack turned = to_orientation(quaternion, where + ", orientation", size);
    take.bodies.push_back({name, turned.quaternion, track.position, track.valid});
  }
  return take;
}

Recording read_bodies(const std::string& file, const Array& time, const std::vector<GivenBody>& bodies,
                      const std::vector<std::string>& notes, const Calibration& calibration,
                      const std::optional<std::string>& up) {
  TrackedTake take = take_of(file, time, bodies);
  take.notes = notes;
  ReadOptions options;
  if (up) options.up = up_axis_of(*up);
  Recording recording = recording_of(std::move(take), calibration, options);
  check_recording(recording);
  return recording;
}

}  // namespace

void bind_tracked_take(py::module_& module) {
  py::class_<TrackedBody>(module, "TrackedBody", "A rigid body, in the frame of the motion capture.")
      .def_readonly("name", &TrackedBody::name)
      .def_property_readonly(
          "quaternion",
          [](const py::object& self) { return rows_of(self.cast<const TrackedBody&>().quaternion, self); },
          "Body to capture frame, x, y, z, w, shape (N, 4); NaN in a dropout.")
      .def_property_readonly(
          "position",
          [](const py::object& self) { return rows_of(self.cast<const TrackedBody&>().position, self); },
          "Of the body's origin [m], shape (N, 3); NaN in a dropout.");
  py::class_<TrackedTake>(module, "TrackedTake",
                          "A take of motion capture as its file has it, with nothing interpreted.")
      .def_static(
          "load",
          [](const std::filesystem::path& path) { return read_motive(read_file(path), path.string()); },
          "path"_a, Unlocked(), "Reads a Motive export (CSV).")
      .def_readonly("rate", &TrackedTake::rate, "[Hz]")
      .def_property_readonly(
          "time", [](const TrackedTake& take) { return Array(take.time.size(), take.time.data()); },
          "[s], shape (N,).")
      .def_readonly("bodies", &TrackedTake::bodies, "List of TrackedBody.");
  module.def(
      "recording_of_bodies", &read_bodies, "file"_a, "time"_a, "bodies"_a, "notes"_a, "calibration"_a, "up"_a,
      "The recording of rigid bodies: times [s], shape (N,), and of each body its name, positions [m], "
      "shape "
      "(N, 3), and orientations x, y, z, w, shape (N, 4), or None where it is a point; a row with NaN is "
      "a dropout. `file` is what messages name, `notes` what its reader changed.");
}

}  // namespace diabolo::python
