// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "chain.hpp"
#include "ideal.hpp"
#include "key.hpp"
#include "strands.hpp"
#include "support.hpp"
#include "take.hpp"
#include "techniques.hpp"

using namespace plant;

namespace {

Motion swinging_hands(bool mirrored) {
  const double side = mirrored ? -1.0 : 1.0;
  MotionBuilder motion(SticksPose{});
  const Vec3 sway(0.0, side * 0.1, 0.0);
  motion.oscillate({sway, sway}, 0.75, 2.0);
  return motion.finish({}, 0);
}

/// Largest distance between the plays of two plants [m]; the second one's is seen in a mirror where asked
/// for.
double distance(const Plant& one, const Plant& other, const Start& start, const Start& other_start,
                double duration, double side = 1.0) {
  const std::vector<double> times = times_until(duration, 50);
  const std::vector<Moment> moments = simulate(one, start, times);
  const std::vector<Moment> others = simulate(other, other_start, times);
  REQUIRE(moments.size() == others.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Vec3 place = Vec3(1.0, side, 1.0).cwiseProduct(Vec3(others[i].state.col(kPosition)));
    largest = std::max(largest, (place - moments[i].state.col(kPosition)).norm());
  }
  return largest;
}

Fields::Json technique(const std::string& name, const std::string& base, double tip_distance) {
  Fields::Json json = {{"schema", "diabolo.scenario/1"}, {"structure", "chain"}, {"base", base}};
  json["start"]["spin"] = 200;
  json["motion"]["left"] = {0.0, 0.5 * tip_distance, 1.25};
  json["motion"]["right"] = {0.0, -0.5 * tip_distance, 1.25};
  json["motion"]["elements"] = Fields::Json::array(
      {{{"type", "hold"}, {"duration", 0.3}}, {{"type", name}}, {{"type", "hold"}, {"duration", 0.5}}});
  return json;
}

std::string message_of(const Fields::Json& json) {
  try {
    scenario_from_json(json);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("without friction a chain swings as the strands do, the nearer the lighter it is") {
  const Motion hands = swinging_hands(false);
  Start start;
  start.spin = 0.0;
  PlantParameters parameters = ideal_plant(Structure::kChain);
  const StrandsPlant strands(ideal_plant(Structure::kStrands), hands);
  const auto apart = [&](double linear_density) {
    parameters.string.linear_density = linear_density;
    return distance(ChainPlant(parameters, hands), strands, start, start, 1.0);
  };
  const double nominal = apart(0.0022);
  const double light = apart(0.0004);
  INFO("at 2.2 and 0.4 g/m: " << nominal << " and " << light << " m");
  CHECK(nominal < 3e-3);
  CHECK(light < 0.5 * nominal);
}

TEST_CASE("a mirrored world with opposite spin plays mirrored on a chain") {
  const PlantParameters parameters = nominal_plant(Structure::kChain);
  Start start;
  start.spin = 150.0;
  Start mirrored = start;
  mirrored.spin = -150.0;
  const double apart = distance(ChainPlant(parameters, swinging_hands(false)),
                                ChainPlant(parameters, swinging_hands(true)), start, mirrored, 2.0, -1.0);
  INFO("distance " << apart);
  CHECK(apart < 1e-6);
}

TEST_CASE("looking more often does not change what is seen of a chain") {
  const ChainPlant plant(nominal_plant(Structure::kChain), swinging_hands(false));
  const Moment once = simulate(plant, Start{}, {1.0}).front();
  const Moment often = simulate(plant, Start{}, times_until(1.0, 777)).back();
  CHECK(once.state == often.state);
}

TEST_CASE("a slack chain sags as a catenary and stays there") {
  const ChainPlant plant(chain(airless()), still_hands({0.0, 0.4, 1.25}, {0.0, -0.4, 1.25}));
  Start start;
  start.flying = true;
  start.position = Vec3(0.0, 0.0, 5.0);
  // sinh(q) / q = length / span gives the catenary's scale a = span / 2 q and its sag a (cosh(q) - 1).
  const double length = plant.parameters().string.length;
  double q = 1.0;
  for (int i = 0; i < 100; ++i) q = std::asinh(q * length / 0.8);
  const double sag = 0.4 / q * (std::cosh(q) - 1.0);
  for (const Moment& moment : simulate(plant, start, {0.0, 0.5})) {
    double lowest = 1.25;
    for (const Vec3& place : moment.chain.places) lowest = std::min(lowest, place.z());
    CHECK(1.25 - lowest == Approx(sag).margin(0.01));
  }
}

TEST_CASE("hop and throw are survived on the ideal and on the nominal chain") {
  const std::string base = GENERATE("ideal", "nominal");
  for (const auto& [name, tip_distance] : {std::pair{"hop", 0.62}, std::pair{"throw", 0.51}}) {
    CAPTURE(base, name);
    const Take play = take(scenario_from_json(technique(name, base, tip_distance)), false);
    CHECK_FALSE(play.missed);
    std::set<Mode> modes;
    for (const Moment& moment : play.filmed) modes.insert(moment.mode);
    CHECK(modes.count(Mode::kLoose) == 1);
    CHECK(modes.count(Mode::kFlying) == (std::string(name) == "throw" ? 1 : 0));
    CHECK(play.filmed.back().mode == Mode::kOnString);
  }
}

TEST_CASE("catches bounce: a chain's mass gives much of the speed back, the more the slower it is") {
  const Motion hands = still_hands({0.0, 0.4, 1.25}, {0.0, -0.4, 1.25});
  const auto given_back = [&](const Plant& plant, double fall) {
    Start start;
    start.position = {0.0, 0.0, 0.65 + fall};
    double down = 0.0, up = 0.0;
    for (const Moment& moment : simulate(plant, start, times_until(0.4, 400))) {
      const double speed = moment.state(2, kVelocity);
      if (-speed > down) down = -speed, up = 0.0;
      up = std::max(up, speed);
    }
    return up / down;
  };
  const ChainPlant heavy(ideal_plant(Structure::kChain), hands);
  PlantParameters parameters = ideal_plant(Structure::kChain);
  parameters.string.linear_density = 2e-4;
  CHECK(given_back(heavy, 0.1) > 0.6);
  CHECK(given_back(heavy, 0.1) > given_back(heavy, 0.3) + 0.1);
  CHECK(given_back(ChainPlant(parameters, hands), 0.1) < 0.35);
  CHECK(given_back(StrandsPlant(ideal_plant(Structure::kStrands), hands), 0.1) < 0.3);
}

TEST_CASE("a diabolo that falls beside a chain is missed") {
  const ChainPlant plant(chain(airless()), still_hands({0.0, 0.4, 1.25}, {0.0, -0.4, 1.25}));
  const auto frames = [&](const Vec3& position) {
    Start start;
    start.flying = true;
    start.position = position;
    return simulate(plant, start, times_until(0.8, 80)).size();
  };
  CHECK(frames({0.0, -0.02, 1.5}) == 81);
  CHECK(frames({0.1, 0.0, 1.5}) < 81);
  CHECK(frames({0.0, 0.6, 1.5}) < 81);
}

TEST_CASE("sticks bend under a chain by its pull") {
  PlantParameters parameters = chain(airless());
  parameters.string.friction = 0.0;
  parameters.sticks.bending_stiffness = 250.0;
  parameters.sticks.damping_ratio = 0.5;
  const Motion hands = still_hands({0.0, 0.35, 1.25}, {0.0, -0.35, 1.25});
  const ChainPlant plant(parameters, hands);
  const Moment moment = simulate(plant, Start{}, {0.5}).front();
  const Pair<Vec3> tips = plant.read(moment).tips;
  const double string_weight = 0.0022 * 1.45 * (1.0 - 1.0 / 41.0);
  const double expected = 0.5 * 9.80665 * (parameters.diabolo.mass + string_weight + 0.02) / 250.0;
  CHECK(1.25 - tips[0].z() == Approx(expected).epsilon(1e-3));
  CHECK(1.25 - tips[1].z() == Approx(expected).epsilon(1e-3));
  CHECK(tips[0].y() < 0.35 - 1e-3);
}

TEST_CASE("a scenario chooses the structure, and a chain refuses what it has no law for") {
  Fields::Json json = technique("hop", "nominal", 0.62);
  CHECK(scenario_from_json(json).plant.string.linear_density == 0.0022);
  json["string"]["wraps"] = 1;
  CHECK(message_of(json) == "string.wraps: found 1, expected no such field for a chain");
  json["string"] = {{"segments", 60}};
  CHECK(scenario_from_json(json).plant.string.segments == 60);
  json["structure"] = "strands";
  CHECK(message_of(json) == "string.segments: unknown field");
  json["structure"] = "spring";
  CHECK(message_of(json) == "structure: found \"spring\", expected \"strands\" or \"chain\"");
}

TEST_CASE("the key of a chain tells its friction as a capstan coefficient") {
  Fields::Json json = technique("hop", "nominal", 0.62);
  json["string"]["friction"] = 0.2;
  std::ostringstream out;
  write_key(out, scenario_from_json(json));
  const Fields::Json friction = Fields::Json::parse(out.str())["effects"]["string_friction"];
  CHECK(friction["coefficient"].get<double>() == Approx(0.150117).epsilon(1e-4));
  CHECK(friction["rise"].is_null());
}
