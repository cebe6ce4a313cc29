// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "diabolo/interop/json/fields.hpp"
#include "diabolo/recording/file.hpp"
#include "diabolo/recording/model.hpp"

namespace diabolo {

/// Reads the text of a model file, schema diabolo.model/1. Throws RecordingError with file and field.
Model read_model(std::string_view text, const std::string& file_name);
Model load_model(const std::filesystem::path& path);
std::string write_model(const Model& model);
void save_model(const Model& model, const std::filesystem::path& path);

}  // namespace diabolo
