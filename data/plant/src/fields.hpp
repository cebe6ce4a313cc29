// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry.hpp"

namespace plant {

/// A scenario that cannot be run; the message names the field, what was found and what was expected.
struct ScenarioError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Smallest and largest value that a field may have.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Reads one JSON object field by field, with defaults, and refuses what it does not know.
class Fields {
 public:
  using Json = nlohmann::json;

  /// `path` names the object in messages, as in "camera".
  Fields(const Json& object, std::string path);

  bool has(const std::string& key) const { return object_->contains(key); }
  /// A field's value as it is written; the field must be there.
  std::string text(const std::string& key) const { return object_->at(key).dump(); }

  /// Overwrites `value` when the field is there.
  void read(const std::string& key, double& value, Range range = {});
  void read(const std::string& key, int& value, Range range);
  void read(const std::string& key, std::uint64_t& value);
  void read(const std::string& key, bool& value);
  void read(const std::string& key, Vec3& value);
  void read(const std::string& key, std::string& value);
  /// null takes the value away.
  void read(const std::string& key, std::optional<double>& value, Range range);
  void read_degrees(const std::string& key, double& radians, Range range_deg);

  /// The same, for fields that must be there.
  double number(const std::string& key, Range range);
  Vec3 vector(const std::string& key);
  std::vector<double> numbers(const std::string& key);
  std::vector<Vec3> vectors(const std::string& key);

  /// A nested object; empty when the field is not there.
  Fields object(const std::string& key);
  /// A list of objects that must be there.
  std::vector<Fields> objects(const std::string& key);

  /// Throws when the object has a field that nobody read.
  void finish() const;

  /// Throws for field `key`.
  [[noreturn]] void fail(const std::string& key, const std::string& found, const std::string& expected) const;

 private:
  const Json* find(const std::string& key);
  const Json& require(const std::string& key, const std::string& expected);
  std::string name(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  double checked(const std::string& key, const Json& value, Range range) const;
  Vec3 checked_vector(const std::string& key, const Json& value) const;

  const Json* object_;
  std::string path_;
  std::set<std::string> known_;
};

}  // namespace plant
