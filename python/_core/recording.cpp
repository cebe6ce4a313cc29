// SPDX-License-Identifier: MIT
#include "diabolo/recording/recording.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "diabolo/json/calibration_file.hpp"
#include "diabolo/json/recording_file.hpp"
#include "diabolo/recording/plausibility/overlaps.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"
#include "diabolo/recording/played_recording.hpp"
#include "diabolo/recording/resample.hpp"
#include "diabolo/recording/spin.hpp"

#include "arrays.hpp"
#include "bindings.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

/// A read-only view of numbers that `owner` keeps.
template <class T>
py::array_t<T> view(const T* data, const std::vector<py::ssize_t>& shape, const py::object& owner) {
  py::array_t<T> array(shape, data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// Columns of an Eigen matrix are the rows of the array.
template <class Matrix>
py::array_t<double> rows_of(const Matrix& matrix, const py::object& owner) {
  return view(matrix.data(), {matrix.cols(), matrix.rows()}, owner);
}

/// The columns that the rows of `array`, of the shape (size, extent), are; a row with a NaN is a dropout.
template <class AnyTrack, class Matrix>
AnyTrack to_track(const Array& array, const std::string& name, py::ssize_t size, Matrix AnyTrack::*numbers) {
  AnyTrack track = AnyTrack::missing(size);
  const py::ssize_t extent = (track.*numbers).rows();
  expect_shape(array, name, {size, extent});
  for (py::ssize_t i = 0; i < size; ++i) {
    const Eigen::Map<const Eigen::VectorXd> row(array.data(i, 0), extent);
    track.valid[i] = !row.array().isNaN().any();
    if (track.valid[i]) (track.*numbers).col(i) = row;
  }
  return track;
}

OrientationTrack to_orientation(const std::optional<Array>& array, const std::string& name,
                                py::ssize_t size) {
  if (!array) return {};
  OrientationTrack track = to_track(*array, name, size, &OrientationTrack::quaternion);
  for (py::ssize_t i = 0; i < size; ++i)
    if (track.valid[i] && !normalize_quaternion(track.quaternion.col(i)))
      throw RecordingError(name + ", row " + std::to_string(i) + ": quaternion of norm " +
                           shown(track.quaternion.col(i).norm()) + "; expected 1");
  return track;
}

Recording make_recording(const Array& time, const Array& left, const Array& right, const Array& diabolo,
                         double rate, const std::optional<Array>& diabolo_orientation,
                         const std::optional<Array>& left_orientation,
                         const std::optional<Array>& right_orientation, const std::string& name,
                         const DiaboloProperties& properties, double string_length) {
  expect_shape(time, "time", {kAny});
  const py::ssize_t size = time.shape(0);
  Recording recording;
  recording.name = name;
  recording.rate = rate;
  recording.time = Eigen::Map<const Eigen::VectorXd>(time.data(), size);
  recording.left = to_track(left, "left", size, &Track::position);
  recording.right = to_track(right, "right", size, &Track::position);
  recording.diabolo = to_track(diabolo, "diabolo", size, &Track::position);
  recording.diabolo_orientation = to_orientation(diabolo_orientation, "diabolo_orientation", size);
  recording.left_orientation = to_orientation(left_orientation, "left_orientation", size);
  recording.right_orientation = to_orientation(right_orientation, "right_orientation", size);
  recording.properties = properties;
  recording.string_length = string_length;
  // Of times and rates that check_recording() would refuse, lround() may not be asked.
  for (const double t : recording.time)
    recording.frame.push_back(std::abs(t * rate) < 1e15 ? std::lround(t * rate) : 0);
  check_recording(recording);
  return recording;
}

Eigen::Matrix3Xd to_columns(const Array& rows, const std::string& name) {
  expect_shape(rows, name, {kAny, 3});
  return Eigen::Map<const Eigen::Matrix3Xd>(rows.data(), 3, rows.shape(0));
}

/// `states`, shape (N, 7): position [m], velocity [m/s] and spin [rad/s]; `axis`, of the axle, shape (N, 3).
Recording make_played(const std::string& name, const Array& time, const Array& left, const Array& right,
                      const Array& states, double rate, const DiaboloProperties& properties,
                      double string_length, const std::optional<Array>& axis) {
  expect_shape(time, "time", {kAny});
  expect_shape(states, "states", {time.shape(0), 7});
  if (axis) expect_shape(*axis, "axis", {time.shape(0), 3});
  std::vector<State<double>> played(static_cast<std::size_t>(states.shape(0)));
  for (py::ssize_t i = 0; i < states.shape(0); ++i) {
    const double* numbers = states.data(i, 0);
    State<double>& state = played[static_cast<std::size_t>(i)];
    state.position = {numbers[0], numbers[1], numbers[2]};
    state.velocity = {numbers[3], numbers[4], numbers[5]};
    state.spin = numbers[6];
    if (!axis) continue;
    state.axis = {axis->at(i, 0), axis->at(i, 1), axis->at(i, 2)};
    if (!(std::abs(state.axis.norm() - 1.0) < 1e-6))
      throw std::invalid_argument("axis: norm " + shown(state.axis.norm()) + " in row " + std::to_string(i) +
                                  "; expected unit vectors");
  }
  return played_recording(name, Eigen::Map<const Eigen::VectorXd>(time.data(), time.shape(0)),
                          to_columns(left, "left"), to_columns(right, "right"), played, rate, properties,
                          string_length);
}

/// x, y, z, w.
Array lies(const Array& axis, double turned) {
  Array quaternion(4);
  std::copy_n(played_orientation(to_vector3(axis, "axis"), turned).coeffs().data(), 4,
              quaternion.mutable_data());
  return quaternion;
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
                        r.frame, r.notes, r.clock, r.assumed);
}

Recording from_tuple(const py::tuple& t) {
  if (t.size() != 18)
    throw RecordingError("recording: a state of " + std::to_string(t.size()) + " items; expected 18");
  const auto orientation = [&](std::size_t i) { return t[i].cast<std::optional<Array>>(); };
  const Array time = t[0].cast<Array>().attr("ravel")().cast<Array>();
  Recording recording =
      make_recording(time, t[1].cast<Array>(), t[2].cast<Array>(), t[3].cast<Array>(), t[4].cast<double>(),
                     orientation(5), orientation(6), orientation(7), t[8].cast<std::string>(),
                     {t[9].cast<double>(), t[10].cast<double>(), t[11].cast<double>(), t[12].cast<double>()},
                     t[13].cast<double>());
  recording.frame = t[14].cast<std::vector<long>>();
  recording.notes = t[15].cast<std::vector<std::string>>();
  recording.clock = t[16].cast<double>();
  recording.assumed = t[17].cast<std::vector<std::string>>();
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

using GivenColumns = std::variant<std::monostate, std::string, std::map<std::string, std::string>>;

ReadOptions read_options(const std::optional<std::string>& up, const GivenColumns& columns) {
  ReadOptions options;
  if (up) options.up = up_axis_of(*up);
  if (const auto* text = std::get_if<std::string>(&columns)) options.columns = columns_of(*text);
  if (const auto* map = std::get_if<std::map<std::string, std::string>>(&columns))
    for (const auto& [tidy, given] : *map) options.columns.push_back(column_of(tidy, given));
  return options;
}

Recording load(const std::filesystem::path& path, const std::optional<Calibration>& calibration,
               const std::optional<std::string>& up, const GivenColumns& columns) {
  return load_recording(path, calibration, read_options(up, columns));
}

Recording read(const std::string& text, const std::filesystem::path& path,
               const std::optional<Calibration>& calibration, const std::optional<std::string>& up,
               const GivenColumns& columns) {
  return read_recording(text, path, calibration, read_options(up, columns));
}

/// A rigid body's name, positions (N, 3) and, unless it is a point, orientations (N, 4).
using GivenBody = std::tuple<std::string, Array, std::optional<Array>>;

/// The take that somebody else's reader found in a file.
MotiveTake take_of(const std::string& file, const Array& time, const std::vector<GivenBody>& bodies) {
  expect_shape(time, "time", {kAny});
  const py::ssize_t size = time.shape(0);
  MotiveTake take;
  take.file_name = file;
  take.time = Eigen::Map<const Eigen::VectorXd>(time.data(), size);
  for (py::ssize_t i = 0; i < size; ++i)
    if (!(std::abs(take.time[i]) <= kLargestTime) || (i > 0 && !(take.time[i] > take.time[i - 1])))
      throw RecordingError(file + ", sample " + std::to_string(i) + ": time " + shown(take.time[i]) +
                           " s; expected finite times that increase");
  if (size < 2) throw RecordingError(file + ": " + std::to_string(size) + " samples; expected two at least");
  take.rate = rate_of(take.time);
  for (const double t : take.time) take.frame.push_back(std::lround(t * take.rate));
  for (const auto& [name, position, quaternion] : bodies) {
    const std::string where = file + ", " + name;
    const Track track = to_track(position, where + ", position", size, &Track::position);
    const OrientationTrack turned = to_orientation(quaternion, where + ", orientation", size);
    take.bodies.push_back({name, turned.quaternion, track.position, track.valid});
  }
  return take;
}

Recording read_bodies(const std::string& file, const Array& time, const std::vector<GivenBody>& bodies,
                      const std::vector<std::string>& notes, const Calibration& calibration,
                      const std::optional<std::string>& up) {
  MotiveTake take = take_of(file, time, bodies);
  take.notes = notes;
  Recording recording = recording_of(std::move(take), calibration, read_options(up, {}));
  check_recording(recording);
  return recording;
}

Calibration of_setup(Calibration calibration, const DiaboloProperties& properties, double string_length,
                     const std::vector<std::string>& assumed) {
  calibration.properties = properties;
  calibration.string_length = string_length;
  calibration.assumed = assumed;
  check_calibration(calibration, "setup");
  return calibration;
}

/// A calibration for bodies of these names; empty ones stay as they are.
Calibration renamed(Calibration calibration, const std::string& left, const std::string& right,
                    const std::string& diabolo) {
  if (!left.empty()) calibration.left.bodies = {left};
  if (!right.empty()) calibration.right.bodies = {right};
  if (!diabolo.empty()) calibration.diabolo.bodies = {diabolo};
  check_calibration(calibration, "topics");
  return calibration;
}

std::pair<std::vector<Recording>, std::vector<std::string>> trimmed(std::vector<Recording> recordings) {
  std::vector<std::string> notes = trim_overlaps(recordings);
  return {std::move(recordings), std::move(notes)};
}

constexpr const char* kLoadDoc =
    R"(Reads a Motive export (CSV), to which the calibration is applied (default: the published one), or a tidy
recording.

up: which axis of the file points up, "y" for Motive's default, "-z", or "y-mirrored" where left and right are
exchanged, too. Without it that is z, and a file whose motion clearly says otherwise is refused.

columns: maps a CSV of your own, {"time": "t[ms]", "left_x": "lx[mm]", ...} or "time=t[ms],left_x=lx[mm],...".
Units are s, ms, us, ns; m, cm, mm, in, ft. Columns with tidy names need no mention. Without a JSON file beside
it, string and diabolo are the calibration's, or assumed.)";

Array spin(const Recording& recording, bool with_sign) {
  const Spin spin = with_sign ? signed_spin(recording) : unsigned_spin(recording);
  return Array(spin.value.size(), spin.value.data());
}

void bind_motive(py::module_& module) {
  py::class_<MotiveBody>(module, "MotiveBody",
                         "A rigid body of a Motive take, in the frame of the motion capture.")
      .def_readonly("name", &MotiveBody::name)
      .def_property_readonly(
          "quaternion",
          [](const py::object& self) { return rows_of(self.cast<const MotiveBody&>().quaternion, self); },
          "Body to capture frame, x, y, z, w, shape (N, 4); NaN in a dropout.")
      .def_property_readonly(
          "position",
          [](const py::object& self) { return rows_of(self.cast<const MotiveBody&>().position, self); },
          "Of the body's origin [m], shape (N, 3); NaN in a dropout.");
  py::class_<MotiveTake>(module, "MotiveTake",
                         "A take as OptiTrack Motive exports it, with nothing interpreted.")
      .def_static(
          "load",
          [](const std::filesystem::path& path) { return read_motive(read_file(path), path.string()); },
          "path"_a, Unlocked(), "Reads a Motive export (CSV).")
      .def_readonly("rate", &MotiveTake::rate, "[Hz]")
      .def_property_readonly(
          "time", [](const MotiveTake& take) { return Array(take.time.size(), take.time.data()); },
          "[s], shape (N,).")
      .def_readonly("bodies", &MotiveTake::bodies, "List of MotiveBody.");
}

void bind_text(py::module_& module) {
  module.def(
      "read_text",
      [](const std::filesystem::path& path) {
        const std::string text = read_file(path);
        return std::string(utf8_text(text, path.string()));
      },
      "path"_a, "A text file in UTF-8, without its byte order mark. Raises RecordingError.");
}

void bind_properties(py::module_& module) {
  using Properties = DiaboloProperties;
  const auto make_properties = [](double mass, double diameter, double length, double axle_radius) {
    const Properties properties{mass, diameter, length, axle_radius};
    check_properties(properties, kPublishedStringLength, "DiaboloProperties");
    return properties;
  };
  py::class_<Properties>(module, "DiaboloProperties", "What a diabolo is like.")
      .def(py::init(make_properties), "mass"_a, "diameter"_a, "length"_a, "axle_radius"_a = 0.0065)
      .def_static(
          "red", [] { return kRedDiabolo; }, "The paper's red diabolo, without markers.")
      .def_static(
          "blue", [] { return kBlueDiabolo; }, "The blue one, which runs on a bearing.")
      .def_static("patterned", [] { return kPatternedDiabolo; })
      .def_static("green", [] { return kGreenDiabolo; })
      .def_readonly("mass", &Properties::mass, "[kg]")
      .def_readonly("diameter", &Properties::diameter, "Of the cups [m].")
      .def_readonly("length", &Properties::length, "Along the axle [m].")
      .def_readonly("axle_radius", &Properties::axle_radius, "Where the string runs [m].")
      .def("__repr__", [](const Properties& p) {
        return py::str("DiaboloProperties(mass={!r}, diameter={!r}, length={!r}, axle_radius={!r})")
            .format(p.mass, p.diameter, p.length, p.axle_radius);
      });
}

void bind_calibration(py::module_& module) {
  py::class_<Calibration>(
      module, "Calibration",
      "How the rigid bodies of a Motive take become the tips and the diabolo of a recording.")
      .def_static("published", &published_calibration,
                  "Of the red diabolo with the sticks of July 2020; the default.")
      .def_static("plain", &plain_calibration,
                  "Of bodies that are the tips and the diabolo themselves, in the world frame.")
      .def("renamed", &renamed, "left"_a = "", "right"_a = "", "diabolo"_a = "",
           "The same for bodies of these names, where one is given.")
      .def("of", &of_setup, "properties"_a, "string_length"_a, "assumed"_a = std::vector<std::string>{},
           "The same for a diabolo and a string [m]; assumed: as that of a Recording.")
      .def("completed_by", &completed, "setup"_a,
           "The same with string and diabolo of another where it only assumes them.")
      .def_static("blue", &blue_calibration, "Of the blue diabolo; its tips are only estimates.")
      .def_static("load", &load_calibration, "path"_a, Unlocked(),
                  "Reads a file of the schema diabolo.calibration/1.")
      .def("save", &save_calibration, "path"_a, Unlocked(), "Writes it, whole or not at all.")
      .def("to_json", &write_calibration, "The text of its file.");
}

}  // namespace

void bind_recording(py::module_& module) {
  py::register_exception<RecordingError>(module, "RecordingError", PyExc_ValueError).attr("__doc__") =
      "What is wrong with a recording, a calibration or one of their files.";
  bind_text(module);
  bind_properties(module);
  bind_calibration(module);
  bind_motive(module);

  py::class_<Recording> cls(module, "Recording", R"(A recorded play: stick tips and diabolo over N samples.

World frame: x forward (away from the player), y left, z up. Arrays are read-only views; a dropout is NaN. To
make one from arrays, hand over `time` [s] of the shape (N,), positions [m] of the shape (N, 3) and, if known,
orientations (x, y, z, w) of the shape (N, 4), body x being the spin axis or along the stick outwards.)");
  cls.def(py::init(&make_recording), "time"_a, "left"_a, "right"_a, "diabolo"_a, "rate"_a, py::kw_only(),
          "diabolo_orientation"_a = py::none(), "left_orientation"_a = py::none(),
          "right_orientation"_a = py::none(), "name"_a = "recording", "properties"_a = kRedDiabolo,
          "string_length"_a = kPublishedStringLength);
  cls.def_static("load", &load, "path"_a, "calibration"_a = py::none(), py::kw_only(), "up"_a = py::none(),
                 "columns"_a = py::none(), Unlocked(), kLoadDoc);
  cls.def("save", &save_tidy, "path"_a, Unlocked(),
          "Writes a tidy recording, NAME.csv and NAME.json beside it, whole or not at all.");
  cls.def("cut", &cut, "first"_a, "last"_a, "Rows first to last, both included.");
  cls.def("resample", py::overload_cast<const Recording&, double>(&resample), "rate"_a,
          "The recording at another rate [Hz]; dropouts are not bridged.");
  cls.def("warnings", &warnings, Unlocked(),
          "What its reader changed, and what is odd about it although it is well formed, such as other "
          "units, tips "
          "that are long unseen or rows that are missing; a sentence each.");
  cls.def_readonly("notes", &Recording::notes, "What its reader changed or took for granted, a clause each.");
  cls.def("spin", &spin, "signed"_a = true,
          "Spin between each sample and the next [rad/s], shape (N,), NaN where it is unknown. Unsigned: the "
          "published rule, which counts turning of the axle too.");
  cls.def_readonly("name", &Recording::name);
  cls.def_readonly("rate", &Recording::rate, "Nominal sampling rate [Hz].");
  cls.def_readonly("string_length", &Recording::string_length, "[m]");
  cls.def_readonly("assumed", &Recording::assumed,
                   "Those of \"string_length\" and \"diabolo\" (its mass and sizes) that no file told.");
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
  module.def("played_properties", &played_properties, "parameters"_a,
             "The diabolo of a model: cups of the paper's red one, the model's mass and axle.");
  module.def(
      "played_orientation", &lies, "axis"_a, "turned"_a,
      "How a diabolo lies that has spun by `turned` [rad]: a quaternion x, y, z, w, body to world, body x "
      "along `axis`, a unit vector.");
  module.def(
      "played_recording", &make_played, "name"_a, "time"_a, "left"_a, "right"_a, "states"_a, "rate"_a,
      "properties"_a, "string_length"_a, "axis"_a = py::none(),
      "A predicted play as a recording: time [s], shape (N,), tips [m], shape (N, 3), and states, position "
      "[m], velocity [m/s] and spin [rad/s], shape (N, 7); its orientations turn by the spin about the "
      "axle's "
      "`axis`, unit vectors, shape (N, 3), by default world x.");
  module.def("load_recording", &load, "path"_a, "calibration"_a = py::none(), py::kw_only(),
             "up"_a = py::none(), "columns"_a = py::none(), Unlocked(), "The same as Recording.load.");
  module.def("read_recording", &read, "text"_a, "path"_a, "calibration"_a, "up"_a, "columns"_a, Unlocked(),
             "The same of a text, as if it stood in a file.");
  module.def(
      "recording_of_bodies", &read_bodies, "file"_a, "time"_a, "bodies"_a, "notes"_a, "calibration"_a, "up"_a,
      "The recording of rigid bodies: times [s], shape (N,), and of each body its name, positions [m], "
      "shape "
      "(N, 3), and orientations x, y, z, w, shape (N, 4), or None where it is a point; a row with NaN is "
      "a dropout. `file` is what messages name, `notes` what its reader changed.");
  module.def("largest_spin", &largest_spin, "rate"_a,
             "Largest spin that a sampling rate [Hz] tells apart [rad/s].");
  module.def("trim_overlaps", &trimmed, "recordings"_a,
             "Recordings without the samples that they share with ones before, and what was trimmed.");
}

}  // namespace diabolo::python
