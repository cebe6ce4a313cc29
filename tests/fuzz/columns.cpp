// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "diabolo/recording/tidy.hpp"

/// A first line of columns and a CSV below it are refused with a sentence, or read into what can be written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = text.find('\n');
  if (end == text.npos) return 0;
  try {
    const diabolo::Recording recording =
        diabolo::read_tidy(text.substr(end + 1), "fuzz.csv", {diabolo::kRedDiabolo, 1.46, 0.0},
                           diabolo::columns_of(text.substr(0, end)));
    diabolo::write_tidy(recording);
  } catch (const diabolo::RecordingError&) {
  }
  return 0;
}
