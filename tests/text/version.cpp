// SPDX-License-Identifier: MIT
#include <regex>
#include <string>

#include "catch.hpp"
#include "diabolo/version.hpp"

TEST_CASE("the version is major.minor.patch, as packaging tools expect") {
  CHECK(std::regex_match(std::string(diabolo::kVersion), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+")));
}
