// SPDX-License-Identifier: MIT
#include "fields.hpp"

#include <cmath>
#include <cstdint>
#include <sstream>

namespace plant {
namespace {

std::string describe(Range range) {
  std::ostringstream text;
  text << "a number";
  if (std::isfinite(range.low) && std::isfinite(range.high)) {
    text << " from " << range.low << " to " << range.high;
  } else if (std::isfinite(range.low)) {
    text << " of at least " << range.low;
  }
  return text.str();
}

constexpr Range kComponent{-100.0, 100.0};  // of a vector, in SI units: far beyond play
const nlohmann::json kEmptyObject = nlohmann::json::object();

}  // namespace

Fields::Fields(const Json& object, std::string path) : object_(&object), path_(std::move(path)) {
  if (!object.is_object()) {
    throw ScenarioError((path_.empty() ? "scenario" : path_) + ": found " + object.dump() +
                        ", expected an object");
  }
}

void Fields::fail(const std::string& key, const std::string& found, const std::string& expected) const {
  throw ScenarioError(name(key) + ": found " + found + ", expected " + expected);
}

const Fields::Json* Fields::find(const std::string& key) {
  known_.insert(key);
  const auto field = object_->find(key);
  return field == object_->end() ? nullptr : &*field;
}

const Fields::Json& Fields::require(const std::string& key, const std::string& expected) {
  const Json* field = find(key);
  if (field == nullptr) fail(key, "nothing", expected);
  return *field;
}

double Fields::checked(const std::string& key, const Json& value, Range range) const {
  if (!value.is_number()) fail(key, value.dump(), describe(range));
  const double number = value.get<double>();
  if (!std::isfinite(number) || number < range.low || number > range.high)
    fail(key, value.dump(), describe(range));
  return number;
}

Vec3 Fields::checked_vector(const std::string& key, const Json& value) const {
  if (!value.is_array() || value.size() != 3) fail(key, value.dump(), "three numbers");
  Vec3 vector;
  for (int i = 0; i < 3; ++i) vector(i) = checked(key, value[static_cast<std::size_t>(i)], kComponent);
  return vector;
}

void Fields::read(const std::string& key, double& value, Range range) {
  if (const Json* field = find(key)) value = checked(key, *field, range);
}

void Fields::read(const std::string& key, int& value, Range range) {
  const Json* field = find(key);
  if (field == nullptr) return;
  if (!field->is_number_integer()) fail(key, field->dump(), "a whole number");
  value = static_cast<int>(checked(key, *field, range));
}

void Fields::read(const std::string& key, std::uint64_t& value) {
  const Json* field = find(key);
  if (field == nullptr) return;
  const bool is_whole =
      field->is_number_unsigned() || (field->is_number_integer() && field->get<std::int64_t>() >= 0);
  if (!is_whole) fail(key, field->dump(), "a whole number of at least 0");
  value = field->get<std::uint64_t>();
}

void Fields::read(const std::string& key, bool& value) {
  const Json* field = find(key);
  if (field == nullptr) return;
  if (!field->is_boolean()) fail(key, field->dump(), "true or false");
  value = field->get<bool>();
}

void Fields::read(const std::string& key, Vec3& value) {
  if (const Json* field = find(key)) value = checked_vector(key, *field);
}

void Fields::read(const std::string& key, std::string& value) {
  const Json* field = find(key);
  if (field == nullptr) return;
  if (!field->is_string()) fail(key, field->dump(), "a text");
  value = field->get<std::string>();
}

void Fields::read(const std::string& key, std::optional<double>& value, Range range) {
  const Json* field = find(key);
  if (field == nullptr) return;
  value = field->is_null() ? std::nullopt : std::optional<double>(checked(key, *field, range));
}

void Fields::read_degrees(const std::string& key, double& radians, Range range_deg) {
  if (const Json* field = find(key)) radians = kRadiansPerDegree * checked(key, *field, range_deg);
}

double Fields::number(const std::string& key, Range range) {
  return checked(key, require(key, describe(range)), range);
}

Vec3 Fields::vector(const std::string& key) { return checked_vector(key, require(key, "three numbers")); }

std::vector<double> Fields::numbers(const std::string& key) {
  const Json& field = require(key, "a list of numbers");
  if (!field.is_array()) fail(key, field.dump(), "a list of numbers");
  std::vector<double> values;
  for (const Json& value : field) values.push_back(checked(key, value, {}));
  return values;
}

std::vector<Vec3> Fields::vectors(const std::string& key) {
  const Json& field = require(key, "a list of vectors");
  if (!field.is_array()) fail(key, field.dump(), "a list of vectors");
  std::vector<Vec3> values;
  for (const Json& value : field) values.push_back(checked_vector(key, value));
  return values;
}

Fields Fields::object(const std::string& key) {
  const Json* field = find(key);
  return Fields(field == nullptr ? kEmptyObject : *field, name(key));
}

std::vector<Fields> Fields::objects(const std::string& key) {
  const Json& field = require(key, "a list of objects");
  if (!field.is_array()) fail(key, field.dump(), "a list of objects");
  std::vector<Fields> list;
  for (std::size_t i = 0; i < field.size(); ++i) {
    list.emplace_back(field[i], name(key) + "[" + std::to_string(i) + "]");
  }
  return list;
}

void Fields::finish() const {
  for (const auto& item : object_->items()) {
    if (known_.count(item.key()) == 0) throw ScenarioError(name(item.key()) + ": unknown field");
  }
}

}  // namespace plant
