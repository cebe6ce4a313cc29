// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "diabolo/recording/formats/tidy.hpp"
#include "diabolo/recording/plausibility/marker_jumps.hpp"
#include "diabolo/recording/plausibility/regular_times.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"

/// A tidy CSV is refused with a sentence, or read into a recording that is written and read again alike, also
/// once its times are regular and its jumps are masked.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const diabolo::TidyMetadata metadata{diabolo::kRedDiabolo, 1.46, 100.0};
  diabolo::Recording recording;
  try {
    recording =
        diabolo::read_tidy(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.csv", metadata);
  } catch (const diabolo::RecordingError&) {
    return 0;
  }
  const std::string text = diabolo::write_tidy(recording);
  if (diabolo::write_tidy(diabolo::read_tidy(text, "fuzz.csv", metadata)) != text) std::abort();
  diabolo::regularise_times(recording);
  diabolo::mask_jumps(recording);
  for (const std::string& sentence : diabolo::warnings(recording))
    if (sentence.empty() || sentence.find("nan") != sentence.npos) std::abort();
  diabolo::check_recording(recording);
  return 0;
}
