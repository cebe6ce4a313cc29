// SPDX-License-Identifier: MIT
#include "diabolo/learn/arena.hpp"

#include <numbers>

#include "catch.hpp"
#include "count_allocations.hpp"
#include "diabolo/batch/batch.hpp"
#include "random.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

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
  Model fast = rubbing();
  auto& laws = fast.effects.get<FormulaLaws>();
  laws = FormulaLaws<double>({Law("gust", "", Acts::kForward, "size * sin(9 * t)", {{"size", "m/s^2"}})});
  laws.numbers[0] = 0.3;
  Model slow = fast;
  slow.effects.get<StringFriction>().coefficient = 0.1;
  for (const Task& task : kTasks) {
    const std::string name(task.info->name);
    ArenaOptions options{.tasks = {name}, .count = 7, .autoreset = Autoreset::kSameStep, .threads = 3};
    Arena many = arena(options, {fast, slow});
    options.count = 1;
    options.threads = 1;
    Arena one = arena(options, {fast, slow});
    constexpr std::size_t kWatched =
        5;  // the second of its lanes, which begins at other times than the first
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
      REQUIRE(std::equal(
          one.observations.begin(), one.observations.end(),
          many.observations.begin() + static_cast<std::ptrdiff_t>(one.observations.size() * kWatched)));
    }
  }
}

TEST_CASE("in a mixed arena each task is drawn, is seen, and plays as it does alone") {
  const std::vector<std::string> tasks{"SpinUp", "ThrowAndCatch", "Level"};
  Arena mixed = arena({.tasks = tasks, .count = 600});
  constexpr std::size_t kSeen = kObservationSize + kAxleSize + 3;
  REQUIRE(mixed.observations.size() == 600 * kSeen);
  std::array<int, 3> drawn{};
  Random random(2413);
  for (std::size_t i = 0; i < mixed.count(); ++i) {
    mixed.reset(i);
    const std::size_t task = mixed.episode(i).task;
    ++drawn[task];
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(mixed.observations[kSeen * i + kSeen - 3 + k] == (k == task ? 1.0F : 0.0F));
    CHECK(mixed.task(i).name == tasks[task]);
  }
  // Tasks of 10, 4 and 8 s: each is played for as long.
  for (const auto& [task, seconds] : {std::pair(0, 10.0), {1, 4.0}, {2, 8.0}})
    CHECK(drawn[static_cast<std::size_t>(task)] ==
          Approx(600.0 / seconds / (1.0 / 10.0 + 1.0 / 4.0 + 1.0 / 8.0)).margin(50.0));  // four deviations
}

TEST_CASE("a task of a mixed arena is worth what it is alone") {
  EpisodeStart start;  // a little above where it would hang
  start.state.position = HandLimits{}.centre - Vector3<double>(0.0, 0.0, 0.5);
  start.state.spin = 80.0;
  start.hands.position = {HandLimits{}.centre + Vector3<double>(0.0, 0.3, 0.0),
                          HandLimits{}.centre - Vector3<double>(0.0, 0.3, 0.0)};
  start.goal = Goal{0.5, 0.1};
  const std::vector<std::string> tasks{"SpinUp", "ThrowAndCatch", "Level"};
  Arena mixed = arena({.tasks = tasks, .starts = {start}, .start_share = 1.0});
  for (std::size_t task = 0; task < 2; ++task) {
    Arena alone = arena({.tasks = {tasks[task]}, .starts = {start}, .start_share = 1.0});
    mixed.reset(0, {.task = task});
    alone.reset(0);
    Random random(2415);
    for (int k = 0; k < 60; ++k) {
      const std::vector<float> actions = random_actions(random, 1);
      mixed.step(actions.data());
      alone.step(actions.data());
      REQUIRE(mixed.rewards[0] == alone.rewards[0]);
      REQUIRE(std::equal(alone.observations.begin(), alone.observations.end(), mixed.observations.begin()));
    }
    CHECK(mixed.episode(0).worth != 0.0);
  }
}

TEST_CASE("a mixed arena plays the same bits alone and among others, with any number of threads") {
  ArenaOptions options{
      .tasks = {"Level", "SpinUp", "Pass"}, .count = 9, .autoreset = Autoreset::kSameStep, .threads = 3};
  Arena many = arena(options);
  options.count = options.threads = 1;
  for (std::size_t watched = 0; watched < many.count(); watched += 4) {
    Arena one = arena(options);
    for (std::size_t i = 0; i < many.count(); ++i) many.seed(i, 100 + i), many.reset(i);
    one.seed(0, 100 + watched);
    one.reset(0);
    Random random(2414);
    for (int k = 0; k < 600; ++k) {
      const std::vector<float> actions = random_actions(random, many.count());
      many.step(actions.data());
      one.step(actions.data() + 6 * watched);
      REQUIRE(many.rewards[watched] == one.rewards[0]);
      REQUIRE(std::equal(
          one.observations.begin(), one.observations.end(),
          many.observations.begin() + static_cast<std::ptrdiff_t>(one.observations.size() * watched)));
    }
  }
}

TEST_CASE("starts are for episodes of their task") {
  EpisodeStart start;
  start.state.spin = 5.0;
  start.hands.position = {HandLimits{}.centre + Vector3<double>(0.0, 0.3, 0.0),
                          HandLimits{}.centre - Vector3<double>(0.0, 0.3, 0.0)};
  start.task = "Hop";
  Arena mixed = arena({.tasks = {"Hold", "Hop"}, .count = 50, .starts = {start}, .start_share = 1.0});
  for (std::size_t i = 0; i < mixed.count(); ++i) {
    mixed.reset(i);
    CHECK((mixed.episode(i).state.spin == 5.0) == (mixed.task(i).name == "Hop"));
  }
}

TEST_CASE("a step takes no memory") {
  Arena many = arena({.tasks = {"ThrowAndCatch"}, .count = 5, .autoreset = Autoreset::kSameStep});
  for (std::size_t i = 0; i < many.count(); ++i) many.reset(i);
  Random random(2404);
  const std::vector<float> actions = random_actions(random, many.count());
  many.step(actions.data());
  const long before = allocations;
  for (int k = 0; k < 500; ++k) many.step(actions.data());
  CHECK(allocations == before);
}

TEST_CASE("a diabolo that nobody moves hangs where it was, and is worth the most where it is wanted") {
  Arena one = arena({.tasks = {"Hold"}});
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
  Arena one = arena({.tasks = {"SpinUp"}});
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
    Arena one = arena({.tasks = {"ThrowAndCatch"}});
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
  Arena one = arena({.tasks = {"SpinUp"}});
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
  Arena one = arena({.tasks = {"ThrowAndCatch"}});
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
  Arena one = arena({.tasks = {"Hold"}}, {rubbing(), longer});
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

TEST_CASE("episodes begin with somebody's play where they are told to, as often as they are told to") {
  EpisodeStart start;
  start.state.string_state = StringState::kFlying;
  start.state.position = HandLimits{}.centre + Vector3<double>(0.0, 0.1, 0.3);
  start.hands.position = {HandLimits{}.centre + Vector3<double>(0.0, 0.6, 0.0),
                          HandLimits{}.centre - Vector3<double>(0.0, 0.6, 0.0)};
  start.hands.velocity[0].z() = 0.5;
  start.goal = Goal{0.44, 0.0};
  Arena some = arena({.tasks = {"ThrowAndCatch"}, .count = 1000, .starts = {start}, .start_share = 0.3});
  std::size_t begun = 0;
  for (std::size_t i = 0; i < some.count(); ++i) {
    some.reset(i);
    const Episode& episode = some.episode(i);
    if (episode.goal != *start.goal) continue;
    ++begun;
    CHECK(episode.state.position == start.state.position);
    CHECK(episode.hands.velocity[0] == start.hands.velocity[0]);
  }
  CHECK(std::abs(static_cast<double>(begun) - 300.0) < 4.0 * std::sqrt(1000.0 * 0.3 * 0.7));
  start.hands.velocity[0].z() = 9.0;
  CHECK_THROWS_WITH(
      arena({.starts = {start}, .start_share = 0.5}),
      "starts, 0: a tip at 1.25 m with 9 m/s along axis 2; expected it within the limits, with room to stop");
  start.hands.velocity[0].z() = 0.0;
  start.hands.position[0].y() = HandLimits{}.half.y() - 1e-3;
  start.hands.velocity[0].y() = 1.0;
  CHECK_THROWS(arena({.starts = {start}, .start_share = 0.5}));  // it could not stop
  start.hands.velocity[0].y() = 0.0;
  start.hands.position = {HandLimits{}.centre + Vector3<double>(0.0, 0.7, 0.3),
                          HandLimits{}.centre - Vector3<double>(0.0, 0.7, 0.3)};
  CHECK_THROWS(arena({.starts = {start}, .start_share = 0.5}));  // nor is a string so long
  CHECK_THROWS_WITH(arena({.start_share = 0.5}),
                    "start_share: 0.5; expected 0 to 0, since there are no starts");
}

TEST_CASE("without noise a camera shows the diabolo as late as it says") {
  const Camera late{.noise = 0.0, .spin_noise = 0.0, .dropouts = 0.0, .least_delay = 3, .most_delay = 3};
  Arena seen = arena({.tasks = {"SpinUp"}, .camera = late}), exact = arena({.tasks = {"SpinUp"}});
  seen.reset(0);
  exact.reset(0);
  Random random(2405);
  std::vector<Vector3<double>> positions{exact.episode(0).state.position};
  for (int k = 0; k < 50; ++k) {
    std::vector<float> actions = random_actions(random, 1);
    for (float& share : actions) share *= 0.2F;
    seen.step(actions.data());
    exact.step(actions.data());
    positions.push_back(exact.episode(0).state.position);
    const auto& [left, right] = exact.episode(0).hands.position;
    const std::size_t then = positions.size() < 4 ? 0 : positions.size() - 4;
    const Vector3<double> expected = positions[then] - 0.5 * (left + right);
    for (int axis = 0; axis < 3; ++axis)
      REQUIRE(seen.observations[static_cast<std::size_t>(axis)] == Approx(expected[axis]).margin(1e-6));
    if (then < 1) continue;
    const Vector3<double> velocity = (positions[then] - positions[then - 1]) / 0.01;
    REQUIRE(seen.observations[5] == Approx(velocity.z()).margin(1e-4));
  }
}

TEST_CASE("a camera's noise and dropouts are as large as it says") {
  const Camera camera{.noise = 0.02, .spin_noise = 0.0, .dropouts = 0.25, .least_delay = 0, .most_delay = 0};
  Arena one = arena({.tasks = {"Hold"}, .camera = camera});
  one.reset(0, {.goal = Goal{0.0, 0.0}});
  const std::vector<float> still(6, 0.0F);
  const double height = one.observations[2];
  double square = 0.0, last = NAN;
  int same = 0;
  constexpr int kFrames = 480;
  for (int k = 0; k < kFrames; ++k) {
    one.step(still.data());
    const double z = one.observations[2];
    square += std::pow(z - height, 2) / kFrames;
    same += z == last;
    last = z;
  }
  CHECK(std::sqrt(square) == Approx(0.02).epsilon(0.15));
  CHECK(std::abs(same - 0.25 * kFrames) < 4.0 * std::sqrt(0.25 * 0.75 * kFrames));
}

TEST_CASE("a hanging diabolo weighs on both tips, and friction on the one that it leans to") {
  Model smooth = consistent_model();
  for (const Model& model : {smooth, rubbing()}) {
    const double friction = model.effects.get<StringFriction>().coefficient;
    Arena one = arena({.tasks = {"Hold"}}, {model});
    one.reset(0);
    const Episode& episode = one.episode(0);
    const auto& [left, right] = tip_forces(episode.state, episode.hands, episode.pull);
    CHECK((left + right).z() == Approx(-1.0).epsilon(0.01));
    CHECK((left + right).y() == Approx(0.0).margin(0.01));
    CHECK(left.y() < 0.0);  // to the right
    // Capstan: tensions differ by exp(friction times the angle that the string turns by).
    const double turned = std::numbers::pi - std::acos(left.normalized().dot(right.normalized()));
    const double ratio = std::exp(friction * turned);
    CHECK(std::abs(std::log(left.norm() / right.norm())) == Approx(std::log(ratio)).margin(0.05));
  }
}

TEST_CASE("tasks that are none, unknown, or there twice are refused") {
  CHECK_THROWS_WITH(arena({.tasks = {}}), "task: none; expected at least one");
  CHECK_THROWS_WITH(arena({.tasks = {"Hop", "Hop"}}), "task: Hop twice; expected each once");
  CHECK_THROWS_WITH(arena({.tasks = {"Hop", "Fly"}}), Contains("task: found \"Fly\"; expected one of Hold"));
  Arena one = arena({.tasks = {"Hop"}});
  CHECK_THROWS_WITH(one.reset(0, {.task = 1}), "task: found 1; expected less than 1, the number of tasks");
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
  CHECK_THROWS_WITH(arena({.tasks = {"Fly"}}),
                    "task: found \"Fly\"; expected one of Hold, Swing, SpinUp, SpinUpCircle, Hop, Throw, "
                    "ThrowAndCatch, Pass, Routine, Level");
  CHECK_THROWS_WITH(arena({.count = 0}), "count: 0; expected at least one environment");
  CHECK_THROWS_WITH(arena({.period = 1.0}), "period: 1 s; expected 0.001 to 0.1 s");
  CHECK_THROWS_WITH(arena({.steps = 0}), "steps: 0; expected 1 to 1000");
  CHECK_THROWS_WITH(arena({}, {}), "models: none; expected at least one");
  CHECK_THROWS_WITH(arena({}, {rubbing(), published_model()}),
                    "models: they differ in rules, formulas or residual; expected the same in all");
}
