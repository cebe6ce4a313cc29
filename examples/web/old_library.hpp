// SPDX-License-Identifier: MIT
#pragma once

// What the headers use of C++20 and the C++ library of Debian's emscripten (libc++ 14) has not got yet. The
// page alone is compiled with it (-include).
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <ranges>
#include <string>
#include <system_error>

namespace std {  // NOLINT(cert-dcl58-cpp): as the standard has it

inline from_chars_result from_chars(const char* begin, const char* end, double& value) {
  const string text(begin, end);
  char* stop = nullptr;
  const double read = strtod(text.c_str(), &stop);
  if (stop == text.c_str()) return {begin, errc::invalid_argument};
  value = read;
  return {begin + (stop - text.c_str()), errc{}};
}

inline to_chars_result to_chars(char* begin, char* end, double value) {
  for (int digits = 1;; ++digits) {  // the fewest that read back as the same
    char text[64];
    const int size = snprintf(text, sizeof(text), "%.*g", digits, value);
    if (digits < 17 && strtod(text, nullptr) != value) continue;
    if (end - begin < size) return {end, errc::value_too_large};
    memcpy(begin, text, static_cast<size_t>(size));
    return {begin + size, errc{}};
  }
}

namespace ranges {

template <class Range, class Value, class Projection = identity>
auto find(Range&& range, const Value& value, Projection projection = {}) {
  return std::find_if(begin(range), end(range),
                      [&](const auto& one) { return invoke(projection, one) == value; });
}
template <class Range, class Predicate>
bool all_of(Range&& range, Predicate predicate) {
  return std::all_of(begin(range), end(range), predicate);
}
template <class Range, class Predicate>
bool any_of(Range&& range, Predicate predicate) {
  return std::any_of(begin(range), end(range), predicate);
}
template <class Range, class Value>
auto upper_bound(Range&& range, const Value& value) {
  return std::upper_bound(begin(range), end(range), value);
}

}  // namespace ranges
}  // namespace std
