// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace diabolo {

/// Text for a message: in quotes, at most 40 bytes of it, bytes beyond printable ASCII as \xNN.
inline std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, kLongest)) {
    const unsigned byte = static_cast<unsigned char>(c);
    char escaped[5];
    std::snprintf(escaped, sizeof escaped, byte >= 0x20 && byte < 0x7f ? "%c" : "\\x%02x", byte);
    result += escaped;
  }
  return result + (text.size() > kLongest ? "...\"" : "\"");
}

/// A number for a message or a file: the shortest text that reads back as the same double.
inline std::string shown(double value) {
  char buffer[32];
  const std::to_chars_result result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

/// The same to three digits after the point, such as millimetres of metres: for people.
inline std::string shown_rounded(double value) { return shown(std::round(value * 1e3) / 1e3); }

}  // namespace diabolo
