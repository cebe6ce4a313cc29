// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/text/utf8.hpp"

namespace diabolo {

/// Text for a message: in quotes, some 40 bytes of it at most; bytes that are no UTF-8, and characters that
/// control a terminal, as \xNN.
inline std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  std::size_t at = 0;
  while (at < std::min(text.size(), kLongest)) {
    const std::size_t length = utf8_length(text.substr(at));
    const unsigned byte = static_cast<unsigned char>(text[at]);
    const bool controls =
        length == 1 ? byte < 0x20 || byte == 0x7f
                    : length == 2 && byte == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0;
    if (length == 0 || controls) {
      char escaped[5];
      std::snprintf(escaped, sizeof escaped, "\\x%02x", byte);
      result += escaped;
    } else {
      result += text.substr(at, length);
    }
    at += controls ? 1 : std::max<std::size_t>(1, length);
  }
  return result + (at < text.size() ? "...\"" : "\"");
}

/// A number for a message or a file: the shortest text that reads back as the same double.
inline std::string shown(double value) {
  char buffer[32];
  const std::to_chars_result result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

/// The same to three digits after the point, such as millimetres of metres: for people.
inline std::string shown_rounded(double value) { return shown(std::round(value * 1e3) / 1e3); }

/// "a, b and c".
inline std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace diabolo
