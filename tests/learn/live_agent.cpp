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
  return {task, 0.02, 20,
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
    const ArenaOptions options{.task = task,
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
