// SPDX-License-Identifier: MIT
#include "diabolo/hosts/string_attributes.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.hpp"

using namespace diabolo;

namespace {

/// The model of some attributes.
Model model_of(const std::map<std::string, std::string>& texts) {
  return model_of_attributes([&](const std::string& key) {
    const auto text = texts.find(key);
    return text == texts.end() ? std::string() : text->second;
  });
}

}  // namespace

TEST_CASE("a model of attributes is a named one, a file's text, and numbers over it") {
  CHECK(model_of({}).name == "consistent");
  CHECK(model_of({{"model", "published"}}).parameters.string_length == 1.46);
  const std::string text = R"( {"schema": "diabolo.model/1", "base": "consistent", "name": "rubs",
    "effects": {"string_friction": {"coefficient": 0.1}, "air": {"linear_drag": 0.05}}})";
  const Model model =
      model_of({{"model", text}, {"string_friction.coefficient", "0.2"}, {"string_length", "1.4"}});
  CHECK(model.name == "rubs");
  CHECK(model.effects.get<StringFriction>().coefficient == 0.2);
  CHECK(model.effects.get<Air>().linear_drag == 0.05);
  CHECK(model.parameters.string_length == 1.4);
  CHECK(model.own_string_length);
  CHECK_FALSE(model.own_axle_radius);
}

TEST_CASE("attributes are all numbers but the host's own") {
  const std::vector<std::string> names = string_attributes();
  for (const char* const known : {"model", "string_length", "wraps", "air.linear_drag"})
    CHECK(std::ranges::count(names, known) == 1);
  CHECK(std::ranges::count(names, "mass") + std::ranges::count(names, "gravity") == 0);
}

TEST_CASE("a wrong attribute or host is refused") {
  for (const char* const wrong : {"long", "1.4m", "nan", "inf"})
    CHECK_THROWS_WITH(model_of({{"string_length", wrong}}),
                      "string_length: \"" + std::string(wrong) + "\"; expected a number");
  CHECK_THROWS_WITH(model_of({{"model", "none.json"}}), "none.json: there is no such file");
  const auto attach = [](const Vector3<double>& gravity) {
    return attach_string(consistent_model(), 0.2, 5e-4, gravity, HostMotion::kNewVelocity);
  };
  CHECK(attach({0.0, 0.0, -3.7}).predictor().parameters().gravity == 3.7);
  CHECK_THROWS_AS(attach({0.0, 0.1, -9.8}), std::invalid_argument);
  CHECK_THROWS_AS(attach({0.0, 0.0, 9.8}), std::invalid_argument);
}
