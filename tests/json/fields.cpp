// SPDX-License-Identifier: MIT
#include "diabolo/json/fields.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

TEST_CASE("Text that is not JSON is located") {
  const auto says = [](std::string_view text) { return complaint([&] { parse_json(text, "f.json"); }); };
  CHECK(says("{}") == "(no complaint)");
  CHECK(says("\xef\xbb\xbf{\"a\": [1, 2.5, null]}\r\n") == "(no complaint)");
  CHECK(says("{\n\"a\": nan}") == "f.json, line 2, column 7: this is not JSON (or the file is cut off)");
  CHECK(says("{\"a\": 1") == "f.json, line 1, column 8: this is not JSON (or the file is cut off)");
  CHECK(says("{} {}") == "f.json, line 1, column 4: this is not JSON (or the file is cut off)");
  CHECK(says("{\"a\": 1e999}") == "f.json: a number is too large");
  CHECK(says("") == "f.json: the file is empty");
  CHECK(says("\xff\xfe{\0}\0") == "f.json: the text is UTF-16; expected UTF-8");
  CHECK(says("{\"a\": \"\xe9\"}") ==
        "f.json, line 1: the byte \"\\xe9\" belongs to another encoding; expected text in UTF-8");
}

TEST_CASE("Repeated fields and bottomless nesting are refused") {
  const auto says = [](std::string_view text) { return complaint([&] { parse_json(text, "f.json"); }); };
  CHECK(says("{\"a\": {\"b\": 1}, \"b\": 2}") == "(no complaint)");
  CHECK(says("{\"a\": {\"b\": 1, \"b\": 2}}") == "f.json: field \"b\" is there twice");
  CHECK(says(std::string(1'000'000, '[')) == "f.json: JSON nested deeper than 8");
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  CHECK(says(objects) == "f.json: JSON nested deeper than 8");
}

TEST_CASE("Fields of the wrong kind are named with their path") {
  const nlohmann::json json =
      parse_json(R"({"n": -1, "t": "text", "v": [1, 2, 3], "w": [1, "x", 3], "o": {"x": true},
                                             "l": ["a", "b"], "e": []})",
                 "f.json");
  const std::string file = "f.json";
  const JsonFields fields(json, file);
  const auto says = [&](const auto& action) { return complaint([&] { action(fields); }); };
  using F = JsonFields;
  CHECK(fields.number("n") == -1.0);
  CHECK(fields.vector3("v") == Eigen::Vector3d(1.0, 2.0, 3.0));
  CHECK(fields.names("t") == std::vector<std::string>{"text"});
  CHECK(fields.names("l") == std::vector<std::string>{"a", "b"});
  CHECK(says([](const F& f) { f.number("t"); }) == "f.json: field \"t\" is \"text\"; expected a number");
  CHECK(says([](const F& f) { f.number("o"); }) ==
        "f.json: field \"o\" is of type object; expected a number");
  CHECK(says([](const F& f) { f.number("x"); }) == "f.json: field \"x\" is missing");
  CHECK(says([](const F& f) { f.positive("n"); }) == "f.json: field \"n\" is -1; expected a number > 0");
  CHECK(says([](const F& f) { f.vector3("w"); }) ==
        "f.json: field \"w\" is of type array; expected [x, y, z]");
  CHECK(says([](const F& f) { f.vector3("e"); }) ==
        "f.json: field \"e\" is of type array; expected [x, y, z]");
  CHECK(says([](const F& f) { f.names("e"); }) ==
        "f.json: field \"e\" is of type array; expected a name, or a list of names");
  CHECK(says([](const F& f) { f.names("n"); }) ==
        "f.json: field \"n\" is -1; expected a name, or a list of names");
  CHECK(says([](const F& f) { f.object("n"); }) == "f.json: \"n\" is -1; expected an object");
  CHECK(says([](const F& f) { f.object("o").number("x"); }) ==
        "f.json: field \"o.x\" is of type boolean; expected a number");
  CHECK(says([](const F& f) { f.object("o").number("y"); }) == "f.json: field \"o.y\" is missing");
  CHECK(says([](const F& f) { f.expect_text("t", "other"); }) ==
        "f.json: field \"t\" is \"text\"; expected \"other\"");
  CHECK(says([](const F& f) { f.object("o").expect_only({"y"}); }) == "f.json: unknown field \"o.x\"");
  const nlohmann::json list = parse_json("[]", file);
  CHECK(complaint([&] { JsonFields(list, file); }) ==
        "f.json: the file is of type array; expected an object");
}
