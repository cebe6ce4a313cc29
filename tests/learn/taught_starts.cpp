// SPDX-License-Identifier: MIT
#include "diabolo/learn/taught_starts.hpp"

#include <algorithm>
#include <string>

#include "catch.hpp"
#include "diabolo/batch/kernels.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/learn/arena.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

std::vector<FullPredictor<double>> models() { return {FullPredictor<double>(Parameters<double>())}; }

std::vector<EpisodeStart> few(std::uint64_t seed = 0) {
  return taught_starts("ThrowAndCatch", models(), {.plays = 3, .seed = seed});
}

}  // namespace

TEST_CASE("starts lie along plays, from the string into the flight, within the limits") {
  const std::vector<EpisodeStart> starts = few();
  REQUIRE(starts.size() > 30);
  const HandLimits limits;
  std::size_t flying = 0;
  for (const EpisodeStart& start : starts) {
    CHECK(limits.allow(start.hands));
    REQUIRE(start.goal);
    CHECK((*start.goal)[0] >= start.state.position.z() - limits.centre.z());
    CHECK(std::abs((*start.goal)[1]) < 0.6);
    if (start.state.string_state == StringState::kFlying) ++flying;
  }
  CHECK(flying > 0);
  CHECK(flying < starts.size());
}

TEST_CASE("starts are those of their seed") {
  const std::vector<EpisodeStart> once = few(), again = few(), others = few(1);
  REQUIRE(once.size() == again.size());
  for (std::size_t i = 0; i < once.size(); ++i) CHECK(once[i].state.position == again[i].state.position);
  CHECK(once.front().goal != others.front().goal);
}

TEST_CASE("whoever begins in flight and keeps the hands where they are sees the apex of the goal") {
  std::vector<EpisodeStart> starts = few();
  std::erase_if(starts, [](const EpisodeStart& start) {
    return start.state.string_state != StringState::kFlying || start.state.velocity.z() < 1.0;
  });
  REQUIRE(!starts.empty());
  for (const EpisodeStart& start : starts) {
    const ArenaOptions options{
        .tasks = {"ThrowAndCatch"}, .autoreset = Autoreset::kDisabled, .starts = {start}, .start_share = 1.0};
    Arena arena(options, {consistent_model()}, best_batch_kernel());
    arena.reset(0);
    const std::vector<float> still(6, 0.0F);
    double apex = -INFINITY;
    for (int period = 0; period < 100 && arena.episode(0).state.string_state == StringState::kFlying;
         ++period) {
      arena.step(still.data());
      apex = std::max(apex, arena.episode(0).state.position.z() - arena.limits().centre.z());
    }
    CHECK(apex == Approx((*start.goal)[0]).margin(0.01));
  }
}

TEST_CASE("starts of strings of several lengths are for all of them") {
  std::vector<Model> lent(2, consistent_model());
  std::vector<FullPredictor<double>> predictors;
  for (const double length : {1.45, 1.3}) {
    Model& model = lent[predictors.size()];
    model.parameters.string_length = length;
    predictors.emplace_back(model.parameters, model.effects);
  }
  const std::vector<EpisodeStart> starts = taught_starts("ThrowAndCatch", predictors, {.plays = 4});
  const ArenaOptions options{.tasks = {"ThrowAndCatch"}, .starts = starts, .start_share = 1.0};
  CHECK_NOTHROW(Arena(options, lent, best_batch_kernel()));
}

TEST_CASE("whoever begins in flight on its way to the right comes down at the goal, and is rewarded") {
  std::vector<EpisodeStart> starts = taught_starts("Pass", models(), {.plays = 12});
  std::erase_if(starts, [](const EpisodeStart& start) {
    return start.state.string_state != StringState::kFlying || start.state.velocity.z() < 1.0;
  });
  REQUIRE(!starts.empty());
  for (const EpisodeStart& start : starts) {
    CHECK((*start.goal)[0] < -0.5);
    const ArenaOptions options{
        .tasks = {"Pass"}, .autoreset = Autoreset::kDisabled, .starts = {start}, .start_share = 1.0};
    Arena arena(options, {consistent_model()}, best_batch_kernel());
    arena.reset(0);
    const std::vector<float> still(6, 0.0F);
    while (!arena.episode(0).over) arena.step(still.data());
    CHECK(arena.episode(0).worth > 1.8);
  }
}

TEST_CASE("a routine's lesson begins with the throw, with the spin of its goal, of which it loses some") {
  const std::vector<EpisodeStart> starts = taught_starts("Routine", models(), {.plays = 3});
  CHECK(starts.front().state.spin == starts.front().goal->front());
  for (const EpisodeStart& start : starts) {
    const ArenaOptions options{.tasks = {"Routine"}, .starts = {start}, .start_share = 1.0};
    Arena arena(options, {consistent_model()}, best_batch_kernel());
    arena.reset(0);
    CHECK(arena.episode(0).memory.stage == 1);
    CHECK(arena.episode(0).state.spin <= arena.episode(0).goal[0]);
    CHECK(arena.episode(0).state.spin > 0.8 * arena.episode(0).goal[0]);
    CHECK(arena.episode(0).goal[1] >= start.state.position.z() - HandLimits().centre.z());
  }
}

TEST_CASE("a play that is not caught, and what nobody teaches, give no starts") {
  CHECK(starts_along(plan_action({.action = "swing"}, models()), kLessons.front(), {}, 0.02, 2.0).empty());
  CHECK_THROWS_WITH(taught_starts("Hold", models(), {}),
                    Contains("task: found \"Hold\"") && Contains("Hop, Throw, ThrowAndCatch"));
  CHECK_THROWS_WITH(taught_starts("Throw", models(), {.plays = 0}), Contains("plays: 0; expected 1"));
  CHECK_THROWS_WITH(taught_starts("Throw", std::vector<FullPredictor<double>>(), {}),
                    Contains("models: none"));
}
