// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "diabolo/json/calibration_file.hpp"

/// A calibration file is refused with a sentence, or read into what can be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  diabolo::Calibration calibration;
  try {
    calibration =
        diabolo::read_calibration(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
  } catch (const diabolo::RecordingError&) {
    return 0;
  }
  diabolo::read_calibration(diabolo::write_calibration(calibration), "fuzz.json");
  return 0;
}
