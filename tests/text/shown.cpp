// SPDX-License-Identifier: MIT
#include "diabolo/text/shown.hpp"

#include "catch.hpp"

using namespace diabolo;

TEST_CASE("text is shown as it is, but for bytes that are none and for what a terminal obeys") {
  CHECK(shown("H\xc3\xb6he_\xc2\xb5") == "\"H\xc3\xb6he_\xc2\xb5\"");
  CHECK(shown("a\tb\x1b[0m\x7f") == "\"a\\x09b\\x1b[0m\\x7f\"");
  CHECK(shown("\xe9 \xc3") == "\"\\xe9 \\xc3\"");
  CHECK(shown("\xc2\x9b") == "\"\\xc2\\x9b\"");
}

TEST_CASE("a long text is cut between characters") {
  const std::string long_text(39, 'a');
  CHECK(shown(long_text + "b") == "\"" + long_text + "b\"");
  CHECK(shown(long_text + "\xc3\xb6") == "\"" + long_text + "\xc3\xb6\"");
  CHECK(shown(long_text + "\xc3\xb6" + "c") == "\"" + long_text + "\xc3\xb6...\"");
}
