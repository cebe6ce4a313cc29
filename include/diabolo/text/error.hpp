// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace diabolo {

/// What is wrong with a recording, a calibration or one of their files: one sentence that names the file, the
/// line or the field, what was found and what was expected.
struct RecordingError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace diabolo
