// SPDX-License-Identifier: MIT
#include "diabolo/learn/arena.hpp"

#include "catch.hpp"
#include "count_allocations.hpp"
#include "diabolo/batch/batch.hpp"
#include "random.hpp"

using namespace diabolo;

namespace {

Model rubbing() {
  Model model = consistent_model();
  model.effects.get<StringFriction>().coefficient = 0.3;
  return model;
}

Arena arena(const ArenaOptions& options, std::vector<Model> models = {rubbing()}) {
  return {options, std::move(models), portable_batch_kernel<2>()};
}

std::vector<float> random_actions(Random& random, std::size_t count) {
  std::vector<float> actions(6 * count);
  for (float& share : actions) share = static_cast<float>(random.uniform(-1.0, 1.0));
  return actions;
}

}  // namespace

TEST_CASE("an environment plays the same bits alone and among others, with any number of threads") {
  Model slow = rubbing();
  slow.effects.get<StringFriction>().coefficient = 0.1;
  for (const Task& task : kTasks) {
    const std::string name(task.info->name);
    ArenaOptions options{.task = name, .count = 7, .autoreset = Autoreset::kSameStep, .threads = 3};
    Arena many = arena(options, {rubbing(), slow});
    options.count = 1;
    options.threads = 1;
    Arena one = arena(options, {rubbing(), slow});
    constexpr std::size_t kWatched = 4;
    for (std::size_t i = 0; i < many.count(); ++i) many.seed(i, 100 + i), many.reset(i);
    one.seed(0, 100 + kWatched);
    one.reset(0);
    Random random(2403);
    for (int k = 0; k < 700; ++k) {
      const std::vector<float> actions = random_actions(random, many.count());
      many.step(actions.data());
      one.step(actions.data() + 6 * kWatched);
      REQUIRE(many.rewards[kWatched] == one.rewards[0]);
      REQUIRE(many.terminated[kWatched] == one.terminated[0]);
      REQUIRE(std::equal(one.observations.begin(), one.observations.end(),
                         many.observations.begin() + kObservationSize * kWatched));
    }
  }
}

TEST_CASE("a step takes no memory") {
  Arena many = arena({.task = "ThrowAndCatch", .count = 5, .autoreset = Autoreset::kSameStep});
  for (std::size_t i = 0; i < many.count(); ++i) many.reset(i);
  Random random(2404);
  const std::vector<float> actions = random_actions(random, many.count());
  many.step(actions.data());
  const long before = allocations;
  for (int k = 0; k < 500; ++k) many.step(actions.data());
  CHECK(allocations == before);
}

TEST_CASE("a diabolo that nobody moves hangs where it was, and is worth the most where it is wanted") {
  Arena one = arena({.task = "Hold"});
  one.reset(0, {.goal = Goal{0.0, 0.0}});
  const std::vector<float> still(6, 0.0F);
  const Vector3<double> begin = one.episode(0).state.position;
  double sum = 0.0;
  for (int k = 0; k < 499; ++k) one.step(still.data()), sum += one.rewards[0];
  CHECK((one.episode(0).state.position - begin).norm() < 2e-3);
  CHECK(sum == Approx(4.99).epsilon(0.01));
  CHECK(!one.truncated[0]);
  one.step(still.data());
  CHECK(one.truncated[0]);
}

TEST_CASE("the next step resets, or the same one, or nobody but the owner") {
  const std::vector<float> still(6, 0.0F);
  const auto play = [&](Arena& one, int periods) {
    for (int k = 0; k < periods; ++k) one.step(still.data());
  };
  Arena next = arena({.autoreset = Autoreset::kNextStep}), same = arena({.autoreset = Autoreset::kSameStep}),
        never = arena({.autoreset = Autoreset::kDisabled});
  for (Arena* one : {&next, &same, &never}) {
    one->reset(0);
    play(*one, 500);
    REQUIRE(one->truncated[0]);
  }
  CHECK(next.episode(0).periods == 500);
  CHECK(same.episode(0).periods == 0);
  CHECK(same.final_observations == next.observations);
  play(next, 1);
  CHECK(next.episode(0).periods == 0);
  CHECK(next.rewards[0] == 0.0);
  CHECK(!next.truncated[0]);
  CHECK(next.observations == same.observations);
  play(never, 3);
  CHECK(never.episode(0).periods == 500);
  never.reset(0);
  CHECK(never.observations == same.observations);
}

TEST_CASE("a diabolo out of anybody's reach ends the episode and costs something") {
  Arena one = arena({.task = "SpinUp"});
  State<double> lost;
  lost.string_state = StringState::kFlying;
  lost.position = one.limits().centre - Vector3<double>(0.0, 0.0, 1.4);
  one.reset(0, {.state = lost});
  const std::vector<float> still(6, 0.0F);
  one.step(still.data());
  CHECK(one.terminated[0]);
  CHECK(one.rewards[0] == -1.0);
}

TEST_CASE("a diabolo thrown to its goal and caught is worth two, and more than one that is not") {
  // It falls from where a throw would have it, onto tips that go apart.
  const auto worth_of = [](double goal) {
    Arena one = arena({.task = "ThrowAndCatch"});
    State<double> thrown;
    thrown.string_state = StringState::kFlying;
    thrown.position = one.limits().centre + Vector3<double>(0.0, 0.0, 0.1);
    thrown.velocity.z() = std::sqrt(2.0 * 9.81 * 0.4);
    one.reset(0, {.state = thrown, .goal = Goal{goal, 0.0}});
    double sum = 0.0;
    const std::vector<float> apart{0.0F, 1.0F, 0.0F, 0.0F, -1.0F, 0.0F};
    for (int k = 0; k < 399 && !one.terminated[0]; ++k) {
      one.step(apart.data());
      sum += one.rewards[0];
    }
    CHECK(one.terminated[0]);
    CHECK(one.episode(0).memory.flights == 1);
    return sum;
  };
  CHECK(worth_of(0.5) == Approx(2.0).epsilon(0.02));
  CHECK(worth_of(0.7) < 1.1);
}

TEST_CASE("rewards of a spin-up sum to what it gained") {
  Arena one = arena({.task = "SpinUp"});
  one.reset(0);
  const double begin = one.episode(0).state.spin;
  double sum = 0.0;
  std::vector<float> actions(6, 0.0F);
  for (int k = 0; k < 600; ++k) {
    // The right tip drives by slow and fast strokes.
    actions[5] = k % 50 < 25 ? 0.15F : -0.15F;
    actions[2] = -actions[5];
    one.step(actions.data());
    REQUIRE(!one.terminated[0]);
    sum += one.rewards[0];
  }
  CHECK(100.0 * sum == Approx(one.episode(0).state.spin - begin));
  CHECK(std::abs(one.episode(0).state.spin - begin) > 0.5);
}

TEST_CASE("seeds decide episodes") {
  Arena one = arena({.task = "ThrowAndCatch"});
  const auto drawn = [&](std::uint64_t seed) {
    one.seed(0, seed);
    one.reset(0);
    const std::vector<float> first = one.observations;
    one.reset(0);
    CHECK(one.observations != first);
    return first;
  };
  CHECK(drawn(1) == drawn(1));
  CHECK(drawn(1) != drawn(2));
}

TEST_CASE("an episode begins with what is given, and draws the rest") {
  Model longer = rubbing();
  longer.parameters.string_length = 1.6;
  Arena one = arena({.task = "Hold"}, {rubbing(), longer});
  const auto begun = [&](std::size_t model) {
    one.seed(0, 5);
    one.reset(0, {.goal = Goal{0.1, 0.2}, .model = model});
    return one.episode(0);
  };
  const Episode first = begun(0), second = begun(1);
  CHECK(first.goal == Goal{0.1, 0.2});
  CHECK(first.state.spin == second.state.spin);
  CHECK(second.state.position.z() < first.state.position.z() - 0.05);  // it hangs from its own string
  CHECK(second.rest == second.state.position);
}

TEST_CASE("what cannot be played is refused before anything moves") {
  Arena one = arena({.count = 2});
  one.reset(0);
  one.reset(1);
  const std::vector<float> before = one.observations;
  std::vector<float> actions(12, 0.5F);
  actions[8] = NAN;
  CHECK_THROWS_WITH(one.step(actions.data()),
                    "actions, environment 1, number 2: not finite; expected -1 to 1");
  CHECK(one.observations == before);
  CHECK(one.episode(0).periods == 0);
  CHECK_THROWS_WITH(one.reset(0, {.goal = Goal{NAN, 0.0}}), "goal: not finite; expected numbers");
  CHECK_THROWS_WITH(one.reset(0, {.model = 1}), "model: found 1; expected less than 1, the number of models");
  CHECK_THROWS_WITH(arena({.task = "Fly"}),
                    "task: found \"Fly\"; expected one of Hold, Swing, SpinUp, Hop, ThrowAndCatch");
  CHECK_THROWS_WITH(arena({.count = 0}), "count: 0; expected at least one environment");
  CHECK_THROWS_WITH(arena({.period = 1.0}), "period: 1 s; expected 0.001 to 0.1 s");
  CHECK_THROWS_WITH(arena({.steps = 0}), "steps: 0; expected 1 to 1000");
  CHECK_THROWS_WITH(arena({}, {}), "models: none; expected at least one");
  CHECK_THROWS_WITH(arena({}, {rubbing(), published_model()}),
                    "models: they differ in rules or formulas; expected the same in all");
}
