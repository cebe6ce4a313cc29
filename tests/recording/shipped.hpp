// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "diabolo/json/recording_file.hpp"

#include "source_dir.hpp"

namespace diabolo::test {

inline constexpr std::array<const char*, 7> kShipped{"circular_acceleration", "drop_and_catch", "hold", "hop",
                                                     "linear_acceleration",   "swing",          "throw"};

/// Where a recording lies that comes with the project, with the noise and the dropouts of a real one.
inline std::filesystem::path shipped_path(const std::string& name) {
  return source_dir() / "data/recordings" / (name + ".csv");
}

inline Recording shipped(const std::string& name) { return load_recording(shipped_path(name)); }

/// Whether one of the sentences holds the words.
inline bool has(const std::vector<std::string>& sentences, const std::string& words) {
  for (const std::string& sentence : sentences)
    if (sentence.find(words) != sentence.npos) return true;
  return false;
}

}  // namespace diabolo::test
