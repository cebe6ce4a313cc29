// SPDX-License-Identifier: MIT
// Hands that are moved from outside.
#include "live.hpp"

#include <sstream>
#include <string>
#include <vector>

#include "support.hpp"

using namespace plant;

namespace {

constexpr double kEnd = 0.6;  // [s]

Scenario scenario(Structure structure) {
  return {.plant = structure == Structure::kChain ? chain(PlantParameters{}) : PlantParameters{},
          .motion = still_hands({0.0, 0.3, 1.25}, {0.0, -0.3, 1.25}),
          .start = Start(),
          .camera = {}};
}

std::vector<std::string> played(const Scenario& scenario, const std::string& periods) {
  std::istringstream in(periods);
  std::ostringstream out;
  play_live(scenario, in, out);
  std::istringstream lines(out.str());
  std::vector<std::string> told;
  for (std::string line; std::getline(lines, line);) told.push_back(line);
  return told;
}

struct Told {
  double time = 0.0;
  std::string mode;
  Vec3 position, velocity;
  double spin = 0.0;
  Pair<Vec3> hands;
  Vec3 axis;
};

Told read(const std::string& line) {
  std::istringstream words(line);
  Told told;
  words >> told.time >> told.mode;
  for (Vec3* vector : {&told.position, &told.velocity})
    for (int i = 0; i < 3; ++i) words >> (*vector)(i);
  words >> told.spin;
  for (Vec3& hand : told.hands)
    for (int i = 0; i < 3; ++i) words >> hand(i);
  for (int i = 0; i < 3; ++i) words >> told.axis(i);
  REQUIRE(words);
  return told;
}

std::string repeated(const std::string& line, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line + "\n";
  return text;
}

}  // namespace

TEST_CASE("hands that are not moved play what still hands play") {
  for (const Structure structure : {Structure::kStrands, Structure::kChain}) {
    const Scenario still = scenario(structure);
    const Told live = read(played(still, repeated("0.02 0 0 0 0 0 0", 30)).back());
    const Moment moment = simulate(*make_plant(still.plant, still.motion), still.start, {kEnd}).front();
    CHECK(live.time == Approx(kEnd));
    CHECK((live.position - Vec3(moment.state.col(kPosition))).norm() < 1e-9);
    CHECK((live.velocity - Vec3(moment.state.col(kVelocity))).norm() < 1e-7);
    CHECK(live.spin == Approx(play_spin(still.plant.diabolo, moment.state)));
    CHECK((live.axis - Vec3(moment.state.col(kAxis))).norm() < 1e-9);
  }
}

TEST_CASE("hands follow their accelerations, however they are cut into periods") {
  const Scenario still = scenario(Structure::kStrands);
  const std::string there = "0 1 3 0 -2 3", back = "0 -1 -3 0 2 -3";
  const auto played_in = [&](double period, int count) {
    std::ostringstream first, second;
    first << period << ' ' << there;
    second << period << ' ' << back;
    return read(played(still, repeated(first.str(), count) + repeated(second.str(), count)).back());
  };
  const Told fine = played_in(0.01, 20), coarse = played_in(0.02, 10);
  const double way = 0.2 * 0.2;  // of an acceleration of 1 m/s^2 for 0.2 s, and as long against it
  CHECK((fine.hands[0] - Vec3(0.0, 0.3 + way, 1.25 + 3.0 * way)).norm() < 1e-9);
  CHECK((fine.hands[1] - Vec3(0.0, -0.3 - 2.0 * way, 1.25 + 3.0 * way)).norm() < 1e-9);
  CHECK((fine.position - coarse.position).norm() < 1e-7);
}

TEST_CASE("play ends where the diabolo misses the string, and says so") {
  Scenario far = scenario(Structure::kStrands);
  far.start.position = Vec3(0.0, 1.0, 2.0);
  far.start.flying = true;
  const std::vector<std::string> told = played(far, repeated("0.02 0 0 0 0 0 0", 500));
  CHECK(told.size() < 200);
  CHECK(read(told.back()).mode == "MISSED");
}

TEST_CASE("a line that is no period is refused") {
  const Scenario still = scenario(Structure::kStrands);
  for (const char* line : {"", "0.02 0 0 0 0 0", "0.02 0 0 0 0 0 0 0", "0 0 0 0 0 0 0", "2 0 0 0 0 0 0",
                           "0.02 0 0 nan 0 0 0", "0.02 0 0 1e9 0 0 0", "0.02 a 0 0 0 0 0"}) {
    INFO(line);
    CHECK_THROWS_WITH(played(still, std::string(line) + "\n"), Catch::Matchers::Contains("period: found"));
  }
}
