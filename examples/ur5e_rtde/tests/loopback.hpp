// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <string>

/// A loopback address of this process alone, as the ports are always the same: others may test beside it.
inline std::string loopback_address(int number) {
  const int id = static_cast<int>(getpid());
  return "127." + std::to_string(1 + id % 200) + "." + std::to_string(id / 200 % 250) + "." +
         std::to_string(10 + number);
}
