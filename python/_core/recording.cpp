// SPDX-License-Identifier: MIT
#include "diabolo/recording/recording.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/json/recording_file.hpp"
#include "diabolo/recording/check.hpp"
#include "diabolo/recording/plausibility/overlaps.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"
#include "diabolo/recording/resample.hpp"
#include "diabolo/recording/spin.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "tracks.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

Recording make_recording(const Array& time, const Array& left, const Array& right, const Array& diabolo,
                         double rate, const std::optional<Array>& diabolo_orientation,
                         const std::optional<Array>& left_orientation,
                         const std::optional<Array>& right_orientation, const std::string& name,
                         const std::optional<DiaboloProperties>& properties,
                         std::optional<double> string_length) {
  expect_shape(time, "time", {kAny});
  const py::ssize_t size = time.shape(0);
  Recording recording;
  recording.name = name;
  recording.rate = rate;
  recording.time = Eigen::Map<const Eigen::VectorXd>(time.data(), size);
  recording.left = to_track(left, "left", size);
  recording.right = to_track(right, "right", size);
  recording.diabolo = to_track(diabolo, "diabolo", size);
  recording.diabolo_orientation = to_orientation(diabolo_orientation, "diabolo_orientation", size);
  recording.left_orientation = to_orientation(left_orientation, "left_orientation", size);
  recording.right_orientation = to_orientation(right_orientation, "right_orientation", size);
  recording.properties = properties.value_or(kRedDiabolo);
  recording.string_length = string_length.value_or(kPublishedStringLength);
  if (!string_length) recording.assumed.push_back("string_length");
  if (!properties) recording.assumed.push_back("diabolo");
  // Of times and rates that check_recording() would refuse, lround() may not be asked.
  for (const double t : recording.time)
    recording.frame.push_back(std::abs(t * rate) < 1e15 ? std::lround(t * rate) : 0);
  check_recording(recording);
  return recording;
}

/// What from_tuple() makes the recording of again.
py::tuple to_tuple(const Recording& r) {
  const auto numbers = [](const auto& matrix) {
    return py::array_t<double>({matrix.cols(), matrix.rows()}, matrix.data());
  };
  const auto known = [&](const OrientationTrack& track) -> py::object {
    return track.empty() ? py::object(py::none()) : py::object(numbers(track.quaternion));
  };
  return py::make_tuple(numbers(r.time), numbers(r.left.position), numbers(r.right.position),
                        numbers(r.diabolo.position), r.rate, known(r.diabolo_orientation),
                        known(r.left_orientation), known(r.right_orientation), r.name, r.properties.mass,
                        r.properties.diameter, r.properties.length, r.properties.axle_radius, r.string_length,
                        r.frame, r.notes, r.clock, r.assumed, r.file, r.has_own_rows);
}

Recording from_tuple(const py::tuple& t) {
  if (t.size() != 20)
    throw RecordingError("recording: a state of " + std::to_string(t.size()) + " items; expected 20");
  const auto orientation = [&](std::size_t i) { return t[i].cast<std::optional<Array>>(); };
  const Array time = t[0].cast<Array>().attr("ravel")().cast<Array>();
  Recording recording =
      make_recording(time, t[1].cast<Array>(), t[2].cast<Array>(), t[3].cast<Array>(), t[4].cast<double>(),
                     orientation(5), orientation(6), orientation(7), t[8].cast<std::string>(),
                     DiaboloProperties{t[9].cast<double>(), t[10].cast<double>(), t[11].cast<double>(),
                                       t[12].cast<double>()},
                     t[13].cast<double>());
  recording.frame = t[14].cast<std::vector<long>>();
  recording.notes = t[15].cast<std::vector<std::string>>();
  recording.clock = t[16].cast<double>();
  recording.assumed = t[17].cast<std::vector<std::string>>();
  recording.file = t[18].cast<std::string>();
  recording.has_own_rows = t[19].cast<bool>();
  check_recording(recording);
  return recording;
}

/// Properties `NAME` and `NAME_valid` of a track of positions.
void bind_track(py::class_<Recording>& cls, const char* name, Track Recording::*track, const char* doc) {
  cls.def_property_readonly(
      name,
      [track](const py::object& self) {
        return rows_of((self.cast<const Recording&>().*track).position, self);
      },
      doc);
  cls.def_property_readonly((std::string(name) + "_valid").c_str(),
                            [track](const py::object& self) {
                              const Track& t = self.cast<const Recording&>().*track;
                              return view(t.valid.data(), {t.valid.size()}, self);
                            },
                            "False marks a dropout, shape (N,).");
}

/// A property that is None where no orientations were recorded.
void bind_orientation(py::class_<Recording>& cls, const char* name, OrientationTrack Recording::*track,
                      const char* doc) {
  cls.def_property_readonly(
      name,
      [track](const py::object& self) -> std::optional<py::array_t<double>> {
        const OrientationTrack& t = self.cast<const Recording&>().*track;
        if (t.empty()) return std::nullopt;
        return rows_of(t.quaternion, self);
      },
      doc);
}

std::pair<std::vector<Recording>, std::vector<std::string>> trimmed(std::vector<Recording> recordings) {
  std::vector<std::string> notes = trim_overlaps(recordings);
  return {std::move(recordings), std::move(notes)};
}

Recording named_cut(const Recording& recording, Eigen::Index first, Eigen::Index last,
                    const std::optional<std::string>& name) {
  Recording part = cut(recording, first, last);
  if (name) part.name = *name;
  return part;
}

Recording read_again(Recording recording, const std::optional<std::string>& up) {
  const std::string title = recording.title();
  ReadOptions options;
  if (up) options.up = up_axis_of(*up);
  return put_right(std::move(recording), options, title);
}

Array spin(const Recording& recording, bool with_sign) {
  const Spin spin = with_sign ? signed_spin(recording) : unsigned_spin(recording);
  return Array(spin.value.size(), spin.value.data());
}

}  // namespace

void bind_recording(py::module_& module) {
  py::register_exception<RecordingError>(module, "RecordingError", PyExc_ValueError).attr("__doc__") =
      "What is wrong with a recording, a calibration or one of their files.";

  py::class_<Recording> cls(module, "Recording", R"(A recorded play: stick tips and diabolo over N samples.

World frame: x forward (away from the player), y left, z up. Arrays are read-only views; a dropout is NaN. To
make one from arrays, hand over `time` [s] of the shape (N,), positions [m] of the shape (N, 3) and, if known,
orientations (x, y, z, w) of the shape (N, 4), body x being the spin axis or along the stick outwards. Without
`properties` they are those of the paper's red diabolo, without `string_length` it is 1.46 m, as in the paper:
assumed, which is warned of.)");
  cls.def(py::init(&make_recording), "time"_a, "left"_a, "right"_a, "diabolo"_a, "rate"_a, py::kw_only(),
          "diabolo_orientation"_a = py::none(), "left_orientation"_a = py::none(),
          "right_orientation"_a = py::none(), "name"_a = "recording", "properties"_a = py::none(),
          "string_length"_a = py::none());
  cls.def("cut", &named_cut, "first"_a, "last"_a, py::kw_only(), "name"_a = py::none(),
          "Rows first to last, both included; `name` is what the part is called, by default as the whole.");
  cls.def("resample", py::overload_cast<const Recording&, double>(&resample), "rate"_a,
          "The recording at another rate [Hz]; dropouts are not bridged.");
  cls.def("put_right", &read_again, py::kw_only(), "up"_a = py::none(), Unlocked(),
          "What a file of it would be read as, `up` being as of `load`: stamps that jitter are moved to "
          "even times, and a rate that they contradict gives way to theirs; markers that jump or freeze are "
          "masked; a frame that is turned by a quarter is turned back. `notes` tell. Raises RecordingError "
          "where the motion says that another axis points up, a coordinate was not recorded, or rows come "
          "too close together.");
  cls.def("warnings", &warnings, Unlocked(),
          "What its reader changed, and what is odd about it although it is well formed, such as other "
          "units, tips "
          "that are long unseen or rows that are missing; a sentence each.");
  cls.def_readonly("notes", &Recording::notes, "What its reader changed or took for granted, a clause each.");
  cls.def("spin", &spin, "signed"_a = true,
          "Spin between each sample and the next [rad/s], shape (N,), NaN where it is unknown. Unsigned: the "
          "published rule, which counts turning of the axle too.");
  cls.def_readonly("name", &Recording::name);
  cls.def_property_readonly(
      "title", &Recording::title,
      "What messages call it: the file that it was read from, or its name; of a part or one "
      "that is resampled, both.");
  cls.def_readonly("rate", &Recording::rate, "Nominal sampling rate [Hz].");
  cls.def_readonly("string_length", &Recording::string_length, "[m]");
  cls.def_readonly("assumed", &Recording::assumed,
                   "Those of \"string_length\" and \"diabolo\" (its mass and sizes) that nobody told.");
  cls.def_property_readonly("properties", [](const Recording& r) { return r.properties; });
  cls.def_property_readonly(
      "frame",
      [](const py::object& self) {
        const Recording& r = self.cast<const Recording&>();
        return view(r.frame.data(), {static_cast<py::ssize_t>(r.frame.size())}, self);
      },
      "Number of each sample in its take, shape (N,).");
  cls.def_property_readonly(
      "time",
      [](const py::object& self) {
        const Recording& r = self.cast<const Recording&>();
        return view(r.time.data(), {r.time.size()}, self);
      },
      "[s], shape (N,).");
  cls.def_readonly("clock", &Recording::clock,
                   "What laws in time go by, at the first sample [s]: a part keeps that of the whole.");
  bind_track(cls, "left", &Recording::left, "Left stick tip [m], shape (N, 3).");
  bind_track(cls, "right", &Recording::right, "Right stick tip [m], shape (N, 3).");
  bind_track(cls, "diabolo", &Recording::diabolo, "Centre of the axle [m], shape (N, 3).");
  bind_orientation(cls, "diabolo_orientation", &Recording::diabolo_orientation,
                   "Unit quaternions x, y, z, w, shape (N, 4), or None; body x is the spin axis.");
  bind_orientation(
      cls, "left_orientation", &Recording::left_orientation,
      "Unit quaternions x, y, z, w, shape (N, 4), or None; body x runs along the stick, outwards.");
  bind_orientation(
      cls, "right_orientation", &Recording::right_orientation,
      "Unit quaternions x, y, z, w, shape (N, 4), or None; body x runs along the stick, outwards.");
  cls.def("__len__", &Recording::size);
  cls.def(py::pickle(&to_tuple, &from_tuple));
  cls.def("__repr__", [](const Recording& r) {
    return py::str("<Recording '{}': {} samples at {:g} Hz>").format(r.name, r.size(), r.rate);
  });
  module.def("largest_spin", &largest_spin, "rate"_a,
             "Largest spin that a sampling rate [Hz] tells apart [rad/s].");
  module.def("trim_overlaps", &trimmed, "recordings"_a,
             "Recordings without the samples that they share with ones before, and what was trimmed.");
}

}  // namespace diabolo::python
