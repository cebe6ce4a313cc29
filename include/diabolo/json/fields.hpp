// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/text/csv.hpp"
#include "diabolo/text/error.hpp"

namespace diabolo {

/// Parses JSON text that may not repeat a field nor nest deeper than 8. Throws RecordingError with file, line
/// and column.
inline nlohmann::json parse_json(std::string_view text, const std::string& file) {
  constexpr int kDeepest = 8;
  text = utf8_text(text, file);
  std::vector<std::set<std::string>> fields;
  const auto check = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    using Event = nlohmann::json::parse_event_t;
    if (depth > kDeepest)
      throw RecordingError(file + ": JSON nested deeper than " + std::to_string(kDeepest));
    if (event == Event::object_start) fields.emplace_back();
    if (event == Event::object_end) fields.pop_back();
    if (event == Event::key && !fields.back().insert(value.get<std::string>()).second)
      throw RecordingError(file + ": field " + shown(value.get<std::string>()) + " is there twice");
    return true;
  };
  try {
    return nlohmann::json::parse(text, check);
  } catch (const nlohmann::json::parse_error& error) {
    const std::string_view before =
        text.substr(0, std::min(text.size(), std::max<std::size_t>(error.byte, 1) - 1));
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    throw RecordingError(
        file + ", line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ", column " +
        std::to_string(before.size() - line_start + 1) + ": this is not JSON (or the file is cut off)");
  } catch (const nlohmann::json::out_of_range&) {
    throw RecordingError(file + ": a number is too large");
  }
}

/// A JSON object read field by field; every complaint names file and field.
class JsonFields {
 public:
  /// `path` is the object's own name with a trailing dot, or nothing for the whole file. Throws
  /// RecordingError where `json` is no object. Both `json` and `file` must outlive this.
  JsonFields(const nlohmann::json& json, const std::string& file, std::string path = "")
      : json_(json), file_(file), path_(std::move(path)) {
    if (!json_.is_object()) {
      const std::string name = path_.empty() ? "the file" : shown(path_.substr(0, path_.size() - 1));
      throw RecordingError(file_ + ": " + name + " is " + found(json_) + "; expected an object");
    }
  }

  bool has(const std::string& field) const { return json_.contains(field); }

  /// Throws RecordingError where there is a field besides these.
  void expect_only(std::initializer_list<std::string_view> fields) const {
    for (const auto& item : json_.items())
      if (std::ranges::find(fields, item.key()) == fields.end())
        throw RecordingError(file_ + ": unknown field " + shown(path_ + item.key()));
  }

  JsonFields object(const std::string& field) const { return {at(field), file_, path_ + field + "."}; }

  double number(const std::string& field) const {
    if (!at(field).is_number()) fail(field, "a number");
    return at(field).get<double>();
  }

  double positive(const std::string& field) const {
    if (!(number(field) > 0.0)) fail(field, "a number > 0");
    return number(field);
  }

  Eigen::Vector3d vector3(const std::string& field) const {
    const nlohmann::json& value = at(field);
    Eigen::Vector3d result;
    if (!value.is_array() || value.size() != 3) fail(field, "[x, y, z]");
    for (std::size_t k = 0; k < 3; ++k) {
      if (!value[k].is_number()) fail(field, "[x, y, z]");
      result[static_cast<Eigen::Index>(k)] = value[k].get<double>();
    }
    return result;
  }

  std::string text(const std::string& field) const {
    if (!at(field).is_string()) fail(field, "a text");
    return at(field).get<std::string>();
  }

  const nlohmann::json& list(const std::string& field) const {
    if (!at(field).is_array()) fail(field, "a list");
    return at(field);
  }

  /// A text, or a list of texts; none of them empty, one at least.
  std::vector<std::string> names(const std::string& field) const {
    const nlohmann::json& value = at(field);
    const auto is_name = [](const nlohmann::json& name) { return name.is_string() && name != ""; };
    if (is_name(value)) return {value.get<std::string>()};
    if (!value.is_array() || value.empty() || !std::ranges::all_of(value, is_name))
      fail(field, "a name, or a list of names");
    return value.get<std::vector<std::string>>();
  }

  /// A list of texts, possibly empty.
  std::vector<std::string> texts(const std::string& field) const {
    const nlohmann::json& value = at(field);
    const auto is_text = [](const nlohmann::json& one) { return one.is_string(); };
    if (!value.is_array() || !std::ranges::all_of(value, is_text)) fail(field, "a list of texts");
    return value.get<std::vector<std::string>>();
  }

  void expect_text(const std::string& field, std::string_view expected) const {
    if (at(field) != expected) fail(field, shown(expected));
  }

  [[noreturn]] void fail(const std::string& field, const std::string& expected) const {
    throw RecordingError(file_ + ": field " + shown(path_ + field) + " is " + found(at(field)) +
                         "; expected " + expected);
  }

 private:
  const nlohmann::json& at(const std::string& field) const {
    const auto value = json_.find(field);
    if (value == json_.end()) throw RecordingError(file_ + ": field " + shown(path_ + field) + " is missing");
    return *value;
  }

  static std::string found(const nlohmann::json& value) {
    if (value.is_string()) return shown(value.get<std::string>());
    if (value.is_number()) return value.dump();
    return std::string("of type ") + value.type_name();
  }

  const nlohmann::json& json_;
  const std::string& file_;
  std::string path_;
};

/// The object as the tools write it. Throws RecordingError where a text in it is not UTF-8.
inline std::string json_text(const nlohmann::ordered_json& json, const std::string& what) {
  try {
    return json.dump(2) + "\n";
  } catch (const nlohmann::json::type_error&) {
    throw RecordingError(what + ": a text is not UTF-8");
  }
}

}  // namespace diabolo
