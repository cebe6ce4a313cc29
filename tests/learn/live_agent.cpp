// SPDX-License-Identifier: MIT
#include "diabolo/learn/live_agent.hpp"

#include "catch.hpp"
#include "diabolo/batch/kernels.hpp"
#include "diabolo/learn/arena.hpp"
#include "random.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

Agent agent_of(Random& random, const std::string& task) {
  const auto drawn = [&] { return static_cast<float>(random.uniform(-0.5, 0.5)); };
  const auto inputs = static_cast<Eigen::Index>(kObservationSize);
  return {{task},
          0.02,
          20,
          Policy({{Eigen::MatrixXf::NullaryExpr(6, inputs, drawn), Eigen::VectorXf::NullaryExpr(6, drawn)}})};
}

}  // namespace

TEST_CASE("a live agent does what it does in an arena, by a camera too") {
  Random random(2411);
  const Camera late{.noise = 0.0, .spin_noise = 0.0, .dropouts = 0.0, .least_delay = 2, .most_delay = 2};
  const std::optional<Camera> none;
  for (const auto& [task, camera] : {std::pair<std::string, std::optional<Camera>>("Hop", none),
                                     {"ThrowAndCatch", none},
                                     {"Routine", none},
                                     {"SpinUp", none},
                                     {"ThrowAndCatch", late}}) {
    const Agent agent = agent_of(random, task);
    const ArenaOptions options{.tasks = {task},
                               .period = agent.period,
                               .steps = agent.steps,
                               .autoreset = Autoreset::kDisabled,
                               .camera = camera};
    Arena arena(options, {consistent_model()}, best_batch_kernel());
    arena.seed(0, 7);
    arena.reset(0);
    const Episode& episode = arena.episode(0);
    LiveAgent live(agent, episode.hands, {.goal = episode.goal, .camera = camera});
    int periods = 0;
    for (; periods < 150 && !episode.over; ++periods) {
      const Eigen::Map<const Eigen::VectorXf> seen(arena.observations.data(),
                                                   static_cast<Eigen::Index>(kObservationSize));
      const Eigen::MatrixXf action = agent.policy.act(seen);
      const Hands& next = live.act(episode.state);
      arena.step(action.data());
      INFO(task << ", period " << periods);
      for (std::size_t side = 0; side < 2; ++side) {
        CHECK((next.position[side] - episode.hands.position[side]).norm() < 1e-6);
        CHECK((next.velocity[side] - episode.hands.velocity[side]).norm() < 1e-5);
      }
    }
    CHECK(periods > 10);
  }
}

TEST_CASE("of several tasks a live agent plays the one that it is told") {
  Random random(2416);
  Agent agent = agent_of(random, "Hop");
  agent.tasks = {"Hop", "SpinUp"};
  const auto drawn = [&] { return static_cast<float>(random.uniform(-0.5, 0.5)); };
  const auto inputs = static_cast<Eigen::Index>(kObservationSize + 2);
  agent.policy =
      Policy({{Eigen::MatrixXf::NullaryExpr(6, inputs, drawn), Eigen::VectorXf::NullaryExpr(6, drawn)}},
             kObservationSize + 2);
  Arena arena({.tasks = agent.tasks, .period = 0.02, .steps = 20}, {consistent_model()}, best_batch_kernel());
  arena.reset(0, {.task = 1});
  const Episode& episode = arena.episode(0);
  LiveAgent live(agent, episode.hands, {.task = "SpinUp"});
  for (int period = 0; period < 30; ++period) {
    const Eigen::Map<const Eigen::VectorXf> seen(arena.observations.data(), inputs);
    const Eigen::MatrixXf action = agent.policy.act(seen);
    const Hands& next = live.act(episode.state);
    arena.step(action.data());
    CHECK((next.position[0] - episode.hands.position[0]).norm() < 1e-6);
  }
  CHECK_THROWS_WITH(LiveAgent(agent, episode.hands, {}),
                    "task: found \"\"; expected one that the agent knows, Hop, SpinUp");
}

TEST_CASE("a live agent corrects a plan as it does in an arena") {
  Random random(2417);
  const auto drawn = [&] { return static_cast<float>(random.uniform(-0.5, 0.5)); };
  const auto inputs = static_cast<Eigen::Index>(kObservationSize + kPlanSize);
  const Agent agent{
      {"Throw"},
      0.02,
      20,
      Policy({{Eigen::MatrixXf::NullaryExpr(6, inputs, drawn), Eigen::VectorXf::NullaryExpr(6, drawn)}},
             kObservationSize + kPlanSize),
      true};
  const Arena usual({.tasks = {"Throw"}}, {consistent_model()}, best_batch_kernel());
  EpisodeStart start{.state = usual.episode(0).state, .hands = usual.episode(0).hands};
  start.hands.position = {Vector3<double>(0.0, 0.3, 1.25), Vector3<double>(0.0, -0.3, 1.25)};
  start.state.position = {0.0, 0.0, 0.6};
  HandPlan plan{.period = 0.02, .moments = std::vector<HandPlan::Moment>(40)};
  for (HandPlan::Moment& moment : plan.moments)
    moment = {start.hands, start.state.position, {0.0, 0.0, 0.1}, {}};
  for (std::size_t k = 0; k < 20; ++k) plan.moments[k].shares = {0.0, 0.1, 0.2, 0.0, -0.1, 0.3};
  start.plan = std::make_shared<HandPlan>(plan);
  Arena arena({.tasks = {"Throw"}, .period = 0.02, .steps = 20, .starts = {start}, .start_share = 1.0},
              {consistent_model()}, best_batch_kernel());
  arena.reset(0);
  const Episode& episode = arena.episode(0);
  LiveAgent live(agent, start.hands, {.goal = episode.goal, .plan = start.plan});
  for (int period = 0; period < 50 && !episode.over; ++period) {
    const Eigen::Map<const Eigen::VectorXf> seen(arena.observations.data(), inputs);
    const Eigen::MatrixXf action = agent.policy.act(seen);
    const Hands& next = live.act(episode.state);
    arena.step(action.data());
    CHECK((next.position[0] - episode.hands.position[0]).norm() < 1e-6);
    CHECK((next.velocity[1] - episode.hands.velocity[1]).norm() < 1e-5);
  }
  CHECK_THROWS_WITH(LiveAgent(agent, start.hands, {}),
                    "plan: none, for an agent that corrects one; expected one");
  CHECK_THROWS_WITH(LiveAgent(agent_of(random, "Throw"), start.hands, {.plan = start.plan}),
                    "plan: given, to an agent that corrects none; expected none");
  Hands elsewhere = start.hands;
  elsewhere.position[0].z() += 0.01;
  CHECK_THROWS_WITH(LiveAgent(agent, elsewhere, {.plan = start.plan}),
                    Contains("hands: not where the plan begins"));
}

TEST_CASE("hands outside the limits, and states that are not finite, are refused") {
  Random random(2412);
  const Agent agent = agent_of(random, "Hop");
  CHECK_THROWS_WITH(LiveAgent(agent, {{Vector3<double>(0, 3, 1.25), Vector3<double>(0, -0.3, 1.25)}, {}}, {}),
                    Contains("a tip at 3 m"));
  const Vector3<double> still = Vector3<double>::Zero();
  const Hands hands{{Vector3<double>(0, 0.3, 1.25), Vector3<double>(0, -0.3, 1.25)}, {still, still}};
  LiveAgent live(agent, hands, {});
  State<double> state;
  state.position.x() = NAN;
  CHECK_THROWS_WITH(live.act(state), Contains("state: not finite"));
  CHECK_THROWS_WITH(LiveAgent(agent, hands, {.string_length = 0.5}),
                    Contains("farther apart than the string"));
}
