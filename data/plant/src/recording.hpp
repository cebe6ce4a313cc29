// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "camera.hpp"
#include "scenario.hpp"

namespace plant {

/// Tidy recording: one row per frame, empty cells where the cameras lost a body.
void write_frames(std::ostream& out, const std::vector<Frame>& frames, bool stick_orientation);

/// The description that lies beside a tidy recording (schema diabolo.recording/1).
void write_description(std::ostream& out, const Scenario& scenario);

/// True motion, one row per moment.
void write_truth(std::ostream& out, const Plant& plant, const std::vector<Moment>& moments);

/// Writes a whole file or none: under a temporary name first. Throws std::runtime_error naming the file.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace plant
