// SPDX-License-Identifier: MIT
#include "diabolo/json/recording_file.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "bindings.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

using namespace py::literals;

using GivenColumns = std::variant<std::monostate, std::string, std::map<std::string, std::string>>;

/// Throws RecordingError with the file that they are to be used for.
ReadOptions read_options(const std::filesystem::path& path, const std::optional<std::string>& up,
                         const GivenColumns& columns) try {
  ReadOptions options;
  if (up) options.up = up_axis_of(*up);
  if (const auto* text = std::get_if<std::string>(&columns)) options.columns = columns_of(*text);
  if (const auto* map = std::get_if<std::map<std::string, std::string>>(&columns))
    for (const auto& [tidy, given] : *map) options.columns.push_back(column_of(tidy, given));
  return options;
} catch (const RecordingError& error) {
  throw RecordingError(path.string() + ": " + error.what());
}

Recording load(const std::filesystem::path& path, const std::optional<Calibration>& calibration,
               const std::optional<std::string>& up, const GivenColumns& columns) {
  return load_recording(path, calibration, read_options(path, up, columns));
}

Recording read(const std::string& text, const std::filesystem::path& path,
               const std::optional<Calibration>& calibration, const std::optional<std::string>& up,
               const GivenColumns& columns) {
  return read_recording(text, path, calibration, read_options(path, up, columns));
}

constexpr const char* kLoadDoc =
    R"(Reads a Motive export (CSV), to which the calibration is applied (default: the published one), or a tidy
recording.

up: which axis of the file points up, "y" for Motive's default, "-z", or "y-mirrored" where left and right are
exchanged, too. Without it that is z, and a file whose motion clearly says otherwise is refused.

columns: maps a CSV of your own, {"time": "t[ms]", "left_x": "lx[mm]", ...} or "time=t[ms],left_x=lx[mm],...".
Units are s, ms, us, ns; m, cm, mm, in, ft. Columns with tidy names need no mention. Without a JSON file beside
it, string and diabolo are the calibration's, or assumed.)";

}  // namespace

void bind_recording_file(py::module_& module) {
  auto cls = py::reinterpret_borrow<py::class_<Recording>>(module.attr("Recording"));
  cls.def_static("load", &load, "path"_a, "calibration"_a = py::none(), py::kw_only(), "up"_a = py::none(),
                 "columns"_a = py::none(), Unlocked(), kLoadDoc);
  cls.def("save", &save_tidy, "path"_a, Unlocked(),
          "Writes a tidy recording, NAME.csv and NAME.json beside it, whole or not at all.");
  module.def("load_recording", &load, "path"_a, "calibration"_a = py::none(), py::kw_only(),
             "up"_a = py::none(), "columns"_a = py::none(), Unlocked(), "The same as Recording.load.");
  module.def("read_recording", &read, "text"_a, "path"_a, "calibration"_a, "up"_a, "columns"_a, Unlocked(),
             "The same of a text, as if it stood in a file.");
  module.def(
      "read_text",
      [](const std::filesystem::path& path) {
        const std::string text = read_file(path);
        return std::string(utf8_text(text, path.string()));
      },
      "path"_a, "A text file in UTF-8, without its byte order mark. Raises RecordingError.");
}

}  // namespace diabolo::python
