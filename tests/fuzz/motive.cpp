// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/tidy.hpp"
#include "diabolo/recording/spin.hpp"

/// A Motive export is refused with a sentence, or becomes a recording that keeps its promises and can be
/// written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const diabolo::TrackedTake take =
        diabolo::read_motive(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.csv");
    diabolo::Calibration calibration = diabolo::published_calibration();
    if (take.bodies.empty()) return 0;
    if (take.bodies.front().name.empty()) std::abort();
    calibration.left.bodies = {take.bodies.front().name};
    const diabolo::Recording recording = diabolo::apply(calibration, take);
    diabolo::signed_spin(recording);
  } catch (const diabolo::RecordingError&) {
  }
  return 0;
}
