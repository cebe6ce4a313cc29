// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace diabolo {

/// The one version string of the library, its Python package and its result files.
inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace diabolo
