// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "diabolo/json/recording_file.hpp"

/// The JSON beside a tidy CSV is refused with a sentence, or read into what can be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  diabolo::TidyMetadata metadata;
  try {
    metadata =
        diabolo::read_metadata(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
  } catch (const diabolo::RecordingError&) {
    return 0;
  }
  if (metadata.rate <= 1e6) diabolo::read_metadata(diabolo::write_metadata(metadata), "fuzz.json");
  return 0;
}
