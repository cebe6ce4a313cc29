// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "diabolo/math/bootstrap.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/error.hpp"

// Files of records, structs that list their fields in for_each_field(): written, read, and their JSON schema.
namespace diabolo {

template <class T>
concept Record = requires {
  T::for_each_field([](const char*, auto, const char*) {});
};

/// A number that is not finite is null.
inline nlohmann::ordered_json record_to_json(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json record_to_json(bool value) { return value; }
inline nlohmann::ordered_json record_to_json(std::size_t value) { return value; }
inline nlohmann::ordered_json record_to_json(const std::string& value) { return value; }
inline nlohmann::ordered_json record_to_json(const Interval& value) {
  return {record_to_json(value.low), record_to_json(value.high)};
}
inline nlohmann::ordered_json record_to_json(const std::array<double, 2>& value) {
  return {record_to_json(value[0]), record_to_json(value[1])};
}
template <class T>
nlohmann::ordered_json record_to_json(const std::optional<T>& value);
template <class T>
nlohmann::ordered_json record_to_json(const std::vector<T>& values);
template <Record T>
nlohmann::ordered_json record_to_json(const T& record);

template <class T>
nlohmann::ordered_json record_to_json(const std::optional<T>& value) {
  return value ? record_to_json(*value) : nlohmann::ordered_json(nullptr);
}
template <class T>
nlohmann::ordered_json record_to_json(const std::vector<T>& values) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const T& value : values) json.push_back(record_to_json(value));
  return json;
}
template <Record T>
nlohmann::ordered_json record_to_json(const T& record) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  T::for_each_field(
      [&](const char* name, auto member, const char*) { json[name] = record_to_json(record.*member); });
  return json;
}

namespace json_detail {

[[noreturn]] inline void fail_record(const std::string& where, const nlohmann::json& found,
                                     const std::string& expected) {
  throw RecordingError(where + ": " + found.dump().substr(0, 60) + "; expected " + expected);
}

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};

}  // namespace json_detail

/// Reads what is there; a field that is not there stays as it is. `where` names the place. Throws
/// RecordingError where something is of another type.
template <class T>
void read_record(const nlohmann::json& json, T& value, const std::string& where) {
  if constexpr (json_detail::IsOptional<T>::value) {
    value.reset();
    if (!json.is_null()) read_record(json, value.emplace(), where);
  } else if constexpr (json_detail::IsList<T>::value) {
    if (!json.is_array()) json_detail::fail_record(where, json, "a list");
    value.clear();
    for (std::size_t i = 0; i < json.size(); ++i) {
      typename T::value_type item{};
      read_record(json[i], item, where + "[" + std::to_string(i) + "]");
      value.push_back(std::move(item));
    }
  } else if constexpr (std::same_as<T, double>) {
    if (!json.is_number() && !json.is_null()) json_detail::fail_record(where, json, "a number");
    value = json.is_null() ? kNaN : json.get<double>();
  } else if constexpr (std::same_as<T, bool>) {
    if (!json.is_boolean()) json_detail::fail_record(where, json, "true or false");
    value = json.get<bool>();
  } else if constexpr (std::same_as<T, std::size_t>) {
    if (!json.is_number_unsigned()) json_detail::fail_record(where, json, "a whole number");
    value = json.get<std::size_t>();
  } else if constexpr (std::same_as<T, std::string>) {
    if (!json.is_string()) json_detail::fail_record(where, json, "a text");
    value = json.get<std::string>();
  } else if constexpr (Record<T>) {
    if (!json.is_object()) json_detail::fail_record(where, json, "an object");
    T::for_each_field([&](const char* name, auto member, const char*) {
      if (const auto field = json.find(name); field != json.end())
        read_record(*field, value.*member, where.ends_with(": ") ? where + name : where + ", " + name);
    });
  } else {  // two numbers
    if (!json.is_array() || json.size() != 2) json_detail::fail_record(where, json, "two numbers");
    double low = 0.0, high = 0.0;
    read_record(json[0], low, where);
    read_record(json[1], high, where);
    value = T{low, high};
  }
}

/// The JSON schema of what record_to_json() makes of a T.
template <class T>
nlohmann::ordered_json record_schema() {
  if constexpr (json_detail::IsOptional<T>::value) {
    nlohmann::ordered_json schema = record_schema<typename T::value_type>(), &type = schema["type"];
    if (!type.is_array()) type = {type, "null"};  // a number may be null anyway
    return schema;
  } else if constexpr (json_detail::IsList<T>::value) {
    return {{"type", "array"}, {"items", record_schema<typename T::value_type>()}};
  } else if constexpr (std::same_as<T, double>) {
    return {{"type", {"number", "null"}}};
  } else if constexpr (std::same_as<T, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::same_as<T, std::size_t>) {
    return {{"type", "integer"}, {"minimum", 0}};
  } else if constexpr (std::same_as<T, std::string>) {
    return {{"type", "string"}};
  } else if constexpr (Record<T>) {
    nlohmann::ordered_json properties = nlohmann::ordered_json::object(),
                           names = nlohmann::ordered_json::array();
    T::for_each_field([&]<class Member>(const char* name, Member T::*, const char* doc) {
      properties[name] = record_schema<Member>();
      if (*doc != '\0') properties[name]["description"] = doc;
      names.push_back(name);
    });
    return {{"type", "object"}, {"description", T::kDoc}, {"properties", properties}, {"required", names}};
  } else {
    return {{"type", "array"}, {"items", record_schema<double>()}, {"minItems", 2}, {"maxItems", 2}};
  }
}

}  // namespace diabolo
