// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "scenario.hpp"

namespace plant {

/// What is true of a scenario's recording, in the names and units of the project's diagnosis: the answers
/// that a proof on concealed recordings keeps sealed.
void write_key(std::ostream& out, const Scenario& scenario);

}  // namespace plant
