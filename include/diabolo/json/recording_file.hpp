// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/json/fields.hpp"
#include "diabolo/json/properties.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/columns.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/tidy.hpp"
#include "diabolo/recording/formats/up_axis.hpp"
#include "diabolo/recording/plausibility/fall.hpp"
#include "diabolo/recording/plausibility/frozen_tracks.hpp"
#include "diabolo/recording/plausibility/marker_jumps.hpp"
#include "diabolo/recording/plausibility/odd_orientations.hpp"
#include "diabolo/recording/plausibility/regular_times.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

inline constexpr const char* kRecordingSchema = "diabolo.recording/1";
inline constexpr const char* kRecordingFrame = "x forward, y left, z up";

/// Reads the text of the JSON file beside a tidy CSV, schema diabolo.recording/1:
///   {"schema": "diabolo.recording/1",
///    "diabolo": {"mass": kg, "diameter": m, "length": m, "axle_radius": m},
///    "string_length": m, "rate": Hz, "units": "SI", "frame": "x forward, y left, z up"}
/// Every field is required. There may be "assumed", a list, possibly empty, of those of kAssumable that
/// nobody told, and "clock", the time of laws at the first row [s]: a part of a recording keeps that of the
/// whole. Further fields are left alone. Throws RecordingError with file and field.
inline TidyMetadata read_metadata(std::string_view text, const std::string& file_name) {
  const nlohmann::json json = parse_json(text, file_name);
  const JsonFields fields(json, file_name);
  fields.expect_text("schema", kRecordingSchema);
  fields.expect_text("units", "SI");
  fields.expect_text("frame", kRecordingFrame);
  TidyMetadata metadata{properties_from_json(fields.object("diabolo")), fields.positive("string_length"),
                        fields.positive("rate"),
                        fields.has("assumed") ? fields.texts("assumed") : std::vector<std::string>{},
                        fields.has("clock") ? fields.number("clock") : 0.0};
  if (!(std::abs(metadata.clock) <= kLargestTime))
    throw RecordingError(file_name + ": field \"clock\" is " + shown(metadata.clock) +
                         "; expected seconds within 1e9");
  check_assumed(metadata.assumed, file_name);
  check_properties(metadata.properties, metadata.string_length, file_name);
  return metadata;
}

/// The text of the JSON file beside a tidy CSV; see read_metadata().
inline std::string write_metadata(const TidyMetadata& metadata) {
  check_properties(metadata.properties, metadata.string_length, "recording");
  check_rate(metadata.rate, {}, "recording");
  check_assumed(metadata.assumed, "recording");
  nlohmann::ordered_json json{{"schema", kRecordingSchema},
                              {"diabolo", to_json(metadata.properties)},
                              {"string_length", metadata.string_length},
                              {"rate", metadata.rate},
                              {"units", "SI"},
                              {"frame", kRecordingFrame}};
  if (!metadata.assumed.empty()) json["assumed"] = metadata.assumed;
  if (metadata.clock != 0.0) json["clock"] = metadata.clock;
  return json_text(json, "recording");
}

/// What a file does not say of itself.
struct ReadOptions {
  std::optional<UpAxis> up;  ///< which axis points up; nothing: z, and a motion that contradicts is refused
  std::vector<MappedColumn> columns;  ///< maps a CSV of somebody's own
};

/// Reads a CSV in the world frame. One whose columns are mapped needs no JSON file beside it: the string's
/// length and the diabolo are then the calibration's, or assumed without one, and the rate is that of the
/// times.
inline Recording load_tidy(const std::filesystem::path& path, std::string_view text,
                           const std::optional<Calibration>& calibration,
                           const std::vector<MappedColumn>& columns) {
  const std::string file_name = path.string();
  const std::filesystem::path metadata = std::filesystem::path(path).replace_extension(".json");
  if (std::filesystem::exists(metadata))
    return read_tidy(text, file_name, read_metadata(read_file(metadata), metadata.string()), columns);
  if (columns.empty())
    throw RecordingError(file_name + ": expected " + metadata.string() +
                         " beside it, which says the string's length, the rate and what the diabolo is like");
  const Calibration used = calibration.value_or(plain_calibration());
  return read_tidy(text, file_name, {used.properties, used.string_length, 0.0, used.assumed}, columns);
}

/// Throws RecordingError where the motion says clearly that another axis of the file than z points up; the
/// file's frame is turned by `yaw` [rad] about z in the recording.
inline void check_up(const Recording& recording, double yaw, const std::string& file_name) {
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const std::optional<int> axis = other_axis_up(recording, falls(recording), axes);
  if (!axis) return;
  // Beyond: is the left tip on the left once it is turned, as it is of one who looks along x?
  UpAxis up{*axis, false};
  const Eigen::Matrix3d turn = axes * turn_to_z_up(up) * axes.transpose();
  Eigen::Vector3d to_left = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < recording.size(); ++i)
    if (recording.left.valid[i] && recording.right.valid[i])
      to_left += turn * (recording.left.position.col(i) - recording.right.position.col(i));
  // (It is not where the frame is mirrored, the sticks are exchanged, or the player faces the other way; the
  // sticks' directions tell the last.)
  up.mirrored =
      to_left.y() < -0.5 * to_left.norm() && sticks_are_exchanged(turned(recording, turn)).value_or(true);
  const std::string plain = text_of({up.axis, false});
  throw RecordingError(
      file_name + ": the motion says that " + plain +
      " points up, not z (gravity in flight and on the string)" +
      (up.mirrored ? ", and left and right change sides; read it with --up=" + plain +
                         " where the player is turned or the sticks are exchanged, with --up=" + text_of(up) +
                         " where the frame is mirrored"
                   : "; read it with --up=" + plain) +
      ", or with --up=z as it stands");
}

/// What every recording goes through once it is read: stamps that jitter, and a frame that is turned by a
/// quarter about the vertical, are put right; samples that jump or freeze, and orientations that show no
/// spin, become dropouts; notes tell. Throws RecordingError where a coordinate was not recorded, or another
/// axis than z points up.
inline Recording put_right(Recording recording, double yaw, const ReadOptions& options,
                           const std::string& file_name) {
  if (const std::string odd = constant_coordinate(recording); !odd.empty())
    throw RecordingError(file_name + ": " + odd);
  check_rows_apart(recording.time, file_name);
  regularise_times(recording);
  put_rate_right(recording);
  mask_jumps(recording);
  mask_frozen(recording);
  if (!options.up) check_up(recording, yaw, file_name);
  recording = turned_to_face_forward(std::move(recording));
  mask_odd_orientations(recording);
  return recording;
}

/// The same of a recording in the frame of its file, which is turned first where the options say what is up.
inline Recording put_right(Recording recording, const ReadOptions& options, const std::string& file_name) {
  const UpAxis up = options.up.value_or(UpAxis{});
  if (up.axis != 3 || up.mirrored) recording = turned_to_z_up(std::move(recording), up);
  return put_right(std::move(recording), 0.0, options, file_name);
}

/// The recording of rigid bodies, to which `calibration` is applied. Throws RecordingError.
inline Recording recording_of(TrackedTake take, const Calibration& calibration, const ReadOptions& options) {
  const UpAxis up = options.up.value_or(UpAxis{});
  const std::string file_name = take.file_name;
  if (up.axis != 3 || up.mirrored) take = turned_to_z_up(std::move(take), up);
  return put_right(apply(calibration, take), calibration.world_yaw, options, file_name);
}

/// Reads the text of a recording of either kind, told apart by content: a Motive export, to which
/// `calibration` (the published one by default) is applied, or a tidy CSV with its JSON file beside `path`,
/// which is in the world frame already. Throws RecordingError.
inline Recording read_recording(const std::string& text, const std::filesystem::path& path,
                                const std::optional<Calibration>& calibration = {},
                                const ReadOptions& options = {}) {
  const std::string file_name = path.string();
  const std::string_view content = utf8_text(text, file_name);
  const std::string_view first_line = content.substr(0, content.find_first_of("\r\n"));
  const bool is_motive =
      first_line.starts_with(kMotiveMark) || first_line.starts_with('"' + std::string(kMotiveMark));
  if (is_motive) {
    if (!options.columns.empty())
      throw RecordingError(file_name +
                           ": columns are mapped, but it is a Motive export; expected another CSV");
    return recording_of(read_motive(text, file_name), calibration.value_or(published_calibration()), options);
  }
  for (const auto& [other, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}})
    if (first_line.find(',') == std::string_view::npos && first_line.find(other) != std::string_view::npos)
      throw RecordingError(file_name + ", line 1: " + name +
                           " separate the columns; expected commas, and decimal points");
  std::string names(first_line);
  std::erase(names, '"');
  if (options.columns.empty() && (',' + names + ',').find(",time,") == std::string::npos)
    throw RecordingError(file_name + ", line 1: starts with " + shown(first_line) +
                         "; expected a Motive export (\"Format Version,...\") or a tidy recording "
                         "(\"time,...\"); --columns maps other names");
  return put_right(load_tidy(path, text, calibration, options.columns), options, file_name);
}

/// The same of a file.
inline Recording load_recording(const std::filesystem::path& path,
                                const std::optional<Calibration>& calibration = {},
                                const ReadOptions& options = {}) {
  return read_recording(read_file(path), path, calibration, options);
}

/// Writes NAME.csv (tidy) and NAME.json, neither ever half-written. Throws RecordingError where `path` does
/// not end in .csv, the recording is not what its type promises, or a file cannot be written.
inline void save_tidy(const Recording& recording, const std::filesystem::path& path) {
  if (path.extension() != ".csv") throw RecordingError(path.string() + ": expected a name that ends in .csv");
  FilesToWrite files;
  files.add(std::filesystem::path(path).replace_extension(".json"),
            write_metadata({recording.properties, recording.string_length, recording.rate, recording.assumed,
                            recording.clock}));
  files.add(path, write_tidy(recording));
  files.commit();
}

}  // namespace diabolo
