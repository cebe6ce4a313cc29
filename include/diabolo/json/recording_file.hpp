// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "diabolo/json/fields.hpp"
#include "diabolo/json/properties.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/tidy.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

inline constexpr const char* kRecordingSchema = "diabolo.recording/1";
inline constexpr const char* kRecordingFrame = "x forward, y left, z up";

/// Reads the text of the JSON file beside a tidy CSV, schema diabolo.recording/1:
///   {"schema": "diabolo.recording/1",
///    "diabolo": {"mass": kg, "diameter": m, "length": m, "axle_radius": m},
///    "string_length": m, "rate": Hz, "units": "SI", "frame": "x forward, y left, z up"}
/// Every field is required; further ones are left alone. Throws RecordingError with file and field.
inline TidyMetadata read_metadata(std::string_view text, const std::string& file_name) {
  const nlohmann::json json = parse_json(text, file_name);
  const JsonFields fields(json, file_name);
  fields.expect_text("schema", kRecordingSchema);
  fields.expect_text("units", "SI");
  fields.expect_text("frame", kRecordingFrame);
  const TidyMetadata metadata{properties_from_json(fields.object("diabolo")),
                              fields.positive("string_length"), fields.positive("rate")};
  check_properties(metadata.properties, metadata.string_length, file_name);
  return metadata;
}

/// The text of the JSON file beside a tidy CSV; see read_metadata().
inline std::string write_metadata(const TidyMetadata& metadata) {
  check_properties(metadata.properties, metadata.string_length, "recording");
  check_rate(metadata.rate, {}, "recording");
  return json_text({{"schema", kRecordingSchema},
                    {"diabolo", to_json(metadata.properties)},
                    {"string_length", metadata.string_length},
                    {"rate", metadata.rate},
                    {"units", "SI"},
                    {"frame", kRecordingFrame}},
                   "recording");
}

/// Reads a recording of either kind, told apart by content: a Motive export, to which `calibration` is
/// applied, or a tidy CSV with its JSON file beside it, which is in the world frame already. Throws
/// RecordingError.
inline Recording load_recording(const std::filesystem::path& path,
                                const Calibration& calibration = published_calibration()) {
  const std::string text = read_file(path), file_name = path.string();
  const std::string_view content = utf8_text(text, file_name);
  const std::string_view first_line = content.substr(0, content.find_first_of("\r\n"));
  if (first_line.starts_with(kMotiveMark) || first_line.starts_with('"' + std::string(kMotiveMark)))
    return apply(calibration, read_motive(text, file_name));
  if ((',' + std::string(first_line) + ',').find(",time,") == std::string::npos)
    throw RecordingError(
        file_name + ", line 1: starts with " + shown(first_line) +
        "; expected a Motive export (\"Format Version,...\") or a tidy recording (\"time,...\")");
  const std::filesystem::path metadata = std::filesystem::path(path).replace_extension(".json");
  if (!std::filesystem::exists(metadata))
    throw RecordingError(file_name + ": expected " + metadata.string() +
                         " beside it, which says the string's length, the rate and what the diabolo is like");
  return read_tidy(text, file_name, read_metadata(read_file(metadata), metadata.string()));
}

/// Writes NAME.csv (tidy) and NAME.json, neither ever half-written. Throws RecordingError where `path` does
/// not end in .csv, the recording is not what its type promises, or a file cannot be written.
inline void save_tidy(const Recording& recording, const std::filesystem::path& path) {
  if (path.extension() != ".csv") throw RecordingError(path.string() + ": expected a name that ends in .csv");
  FilesToWrite files;
  files.add(std::filesystem::path(path).replace_extension(".json"),
            write_metadata({recording.properties, recording.string_length, recording.rate}));
  files.add(path, write_tidy(recording));
  files.commit();
}

}  // namespace diabolo
