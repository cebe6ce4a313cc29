// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// How a parameter is looked for in recordings, where it may be another than a model has.
struct Sought {
  std::string_view name{};              ///< as an unknown; empty: it is not looked for
  double usual = 1.0;                   ///< size: all linear algebra is done in it
  double prior = 0.0;                   ///< standard deviation of what there is in play; 0: nothing is known
  double minimum = 0.0, maximum = 0.0;  ///< search bounds
};

/// Name, unit and range of a numeric parameter.
struct ParameterInfo {
  std::string_view name, unit;
  double minimum, maximum;
  std::string_view meaning;
  Sought sought{};
};

/// A unit behind a number; nothing for the unit "1".
inline std::string unit_behind(std::string_view unit) {
  return unit == "1" ? "" : std::string(" ").append(unit);
}

/// Throws std::invalid_argument naming the first field of `Fields::for_each` that is out of its range, its
/// value and the range.
template <class Scalar, class Fields>
void validate_fields(const Fields& fields, const std::string& prefix = {}) {
  Fields::for_each(fields, [&](const ParameterInfo& info, const Scalar& field) {
    if (all(field >= Scalar(info.minimum)) && all(field <= Scalar(info.maximum))) return;
    std::ostringstream text;
    text << prefix << info.name << ": ";
    if constexpr (std::floating_point<Scalar>) text << field << unit_behind(info.unit) << "; ";
    text << "must be within [" << info.minimum << ", " << info.maximum << "]" << unit_behind(info.unit);
    throw std::invalid_argument(text.str());
  });
}

/// Calls `put(field, value)` for every field of `to` with the value of that field in `from`, a struct of
/// doubles with the same for_each.
template <class From, class To, class Put>
void copy_fields(const From& from, To& to, Put&& put) {
  std::array<double, sizeof(From) / sizeof(double)> values{};  // room for all, whatever their number
  std::size_t next = 0;
  From::for_each(from, [&](const ParameterInfo&, double value) { values[next++] = value; });
  next = 0;
  To::for_each(to, [&](const ParameterInfo&, auto& field) { put(field, values[next++]); });
}

/// The value of every field of `from`, given to another Scalar's.
template <class From, class To>
void copy_fields(const From& from, To& to) {
  copy_fields(from, to,
              [](auto& field, double value) { field = std::remove_reference_t<decltype(field)>(value); });
}

}  // namespace diabolo
