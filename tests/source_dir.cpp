// SPDX-License-Identifier: MIT
#include "source_dir.hpp"

std::filesystem::path source_dir() { return DIABOLO_SOURCE_DIR; }
