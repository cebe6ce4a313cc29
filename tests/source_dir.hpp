// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

/// Where the project lies. source_dir.cpp alone is told, so that all else is found in the compiler's cache by
/// a checkout that lies elsewhere.
std::filesystem::path source_dir();
