// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// An excerpt of the paper's table of position errors.
struct PaperExcerpt {
  std::string_view motion;     ///< as the paper calls it
  std::string_view recording;  ///< name of the take
  Eigen::Index rows;           ///< how many of the take's first rows it is
  double paper_error;          ///< mean position error as printed [m]
  double program_error;        ///< the authors' program, run again on the same rows [m]
};

inline constexpr std::array<PaperExcerpt, 5> kPaperTable{{
    {"throw", "throw_1", 325, 0.21, 0.1980},
    {"swinging", "y_swing_2", 903, 0.08, 0.0811},
    {"hop", "z_hop_1", 181, 0.07, 0.0700},
    {"linear acceleration", "acceleration_1", 181, 0.03, 0.0303},
    {"circular acceleration", "circular_accel_stick_motion", 143, 0.11, 0.1104},
}};

/// The row of the table for a take of this name; null where the paper has none.
inline const PaperExcerpt* paper_excerpt(std::string_view recording) {
  for (const PaperExcerpt& excerpt : kPaperTable)
    if (excerpt.recording == recording) return &excerpt;
  return nullptr;
}

}  // namespace diabolo
