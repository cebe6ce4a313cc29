// SPDX-License-Identifier: MIT
#include <cstdio>
#include <stdexcept>

#include <diabolo/diagnose/answer.hpp>

/// Asks the compiled diagnosis about nothing, which it refuses.
int main() {
  try {
    diabolo::diagnose({});
  } catch (const std::invalid_argument& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
  return 1;
}
