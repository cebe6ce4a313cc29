// SPDX-License-Identifier: MIT
#include "diabolo/learn/planned_starts.hpp"

#include <algorithm>
#include <numbers>

#include "catch.hpp"
#include "diabolo/batch/kernels.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/learn/arena.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

constexpr double kPlanPeriod = 0.02;  // [s]

const std::vector<EpisodeStart>& starts() {
  static const std::vector<EpisodeStart> planned = planned_starts(
      "ThrowAndCatch", std::vector{FullPredictor<double>(Parameters<double>())}, {.plays = 3}, kPlanPeriod);
  return planned;
}

Arena arena_of(const ArenaOptions& given) {
  ArenaOptions options = given;
  options.period = kPlanPeriod;
  options.steps = 20;
  options.start_share = 1.0;
  return {options, {consistent_model()}, best_batch_kernel()};
}

ArenaOptions throwing() {
  return {.tasks = {"ThrowAndCatch"}, .autoreset = Autoreset::kDisabled, .starts = starts()};
}

constexpr auto kUsual = static_cast<std::ptrdiff_t>(kObservationSize);

}  // namespace

TEST_CASE("a correction of zero plays exactly the plan, which throws") {
  REQUIRE(starts().size() >= 2);
  for (const EpisodeStart& start : starts()) {
    ArenaOptions options = throwing();
    options.starts = {start};
    Arena one = arena_of(options);
    one.reset(0);
    const Episode& episode = one.episode(0);
    const std::vector<float> none(6, 0.0F);
    double highest = 0.0;
    for (std::size_t period = 0; !episode.over; ++period) {
      const HandPlan::Moment& plan = start.plan->at(period);
      REQUIRE(episode.hands.position == plan.hands.position);
      REQUIRE(episode.hands.velocity == plan.hands.velocity);
      // Of the tips there is nothing off the plan, then.
      const auto off = one.observations.begin() + kUsual;
      REQUIRE(std::all_of(off + 6, off + 18, [](float x) { return x == 0.0F; }));
      if (period <
          20) {  // the throw is not yet over: small steps and large ones differ by centimetres at most
        CHECK((episode.state.position - plan.position).norm() < 0.02);
        CHECK(std::abs(off[0]) + std::abs(off[1]) + std::abs(off[2]) < 0.05);
      }
      one.step(none.data());
      highest = std::max(highest, episode.state.position.z());
    }
    CHECK(highest > one.limits().centre.z() + 0.1);
  }
}

TEST_CASE("a plan's hands are on its path to a millimetre or two, with its velocities") {
  const HandLimits limits;
  const TipColumn<double> home = home_pose("throw", 1.45);
  const PlannedPlay planned = plan_action({.action = std::string(kThrowAndCatch),
                                           .height = 0.6,
                                           .sideways = 0.0,
                                           .limits = tip_limits(limits, home)},
                                          std::vector{FullPredictor<double>(Parameters<double>())});
  const Vector3<double> shift = shift_to(limits.centre, planned);
  HandLimits roomy;  // so that none of them is in the way
  roomy.speed = 5.0;
  roomy.acceleration = 200.0;
  roomy.half = {1.0, 2.0, 1.0};
  const HandPlan plan = planned_hands(planned, shift, roomy, 1.6, kPlanPeriod);
  CHECK(farthest_off(plan, planned, shift) < 2e-3);
  CHECK(farthest_off(planned_hands(planned, shift, roomy, 1.6, 0.5 * kPlanPeriod), planned, shift) < 5e-4);
  for (std::size_t i = 0; i < plan.moments.size(); ++i) {
    const Hands wanted = moment_at(planned, kPlanPeriod * static_cast<double>(i), shift).hands;
    for (std::size_t side = 0; side < 2; ++side)
      CHECK((plan.moments[i].hands.velocity[side] - wanted.velocity[side]).norm() < 1e-9);
  }
  CHECK(plan.time_left(0) == Approx(planned.path.end()).margin(kPlanPeriod));
  CHECK(plan.time_left(1000) == 0.0);
  CHECK(plan.at(1000).hands.velocity[0].norm() < 1e-9);
  HandLimits slow;
  slow.speed = 0.3;
  CHECK(farthest_off(planned_hands(planned, shift, slow, 1.45, kPlanPeriod), planned, shift) > 0.05);
}

TEST_CASE("a correction adds half of what the tips may accelerate, is seen, and wears off") {
  ArenaOptions options = throwing();
  options.starts.resize(1);
  Arena one = arena_of(options);
  one.reset(0);
  const std::vector<float> up{0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F};
  one.step(up.data());
  const double faster = HandPlan::kCorrection * one.limits().acceleration * kPlanPeriod;
  const auto off = one.observations.begin() + kUsual;
  CHECK(off[8] == Approx(0.5 * faster * kPlanPeriod));  // left tip, z
  CHECK(off[14] == Approx(faster));                     // its velocity
  CHECK(off[11] == 0.0F);                               // right tip, z
  const HandPlan::Moment& plan = starts().front().plan->at(1);
  for (std::size_t k = 0; k < 6; ++k)
    CHECK(off[18 + static_cast<std::ptrdiff_t>(k)] == Approx(plan.shares[k]));
  CHECK(off[24] == Approx(starts().front().plan->time_left(1)));
  const std::vector<float> none(6, 0.0F);
  double farthest = 0.0;
  for (int k = 0; k < 80; ++k) one.step(none.data()), farthest = std::max(farthest, std::abs(double{off[8]}));
  // A spring with critical damping: v t exp(-t / T) is the most at t = T.
  CHECK(farthest == Approx(faster * HandPlan::kReturn / std::numbers::e).epsilon(0.1));
  CHECK(std::abs(off[8]) < 0.02 * farthest);
}

TEST_CASE("corrected plans play the same bits with any number of threads, within the limits") {
  ArenaOptions options = throwing();
  options.autoreset = Autoreset::kSameStep;
  options.count = 7;
  Arena one = arena_of(options);
  options.threads = 3;
  Arena many = arena_of(options);
  for (std::size_t i = 0; i < one.count(); ++i) one.reset(i), many.reset(i);
  Draw draw(2421, 0);
  std::vector<float> actions(6 * one.count());
  for (int k = 0; k < 400; ++k) {
    for (float& share : actions) share = static_cast<float>(draw.uniform(-3.0, 3.0));
    one.step(actions.data());
    many.step(actions.data());
    REQUIRE(one.observations == many.observations);
    for (std::size_t i = 0; i < one.count(); ++i) REQUIRE(one.limits().allow(one.episode(i).hands));
  }
}

TEST_CASE("plans that cannot be played are refused") {
  ArenaOptions options = throwing();
  options.starts.front().plan.reset();
  options.start_share = 1.0;
  options.period = kPlanPeriod;
  const auto made = [&] { Arena(options, {consistent_model()}, best_batch_kernel()); };
  CHECK_THROWS_WITH(made(), Contains("starts, 1: expected a plan in all starts, or in none"));
  options.starts = starts();
  options.start_share = 0.5;
  CHECK_THROWS_WITH(made(), "start_share: 0.5; expected 1, as starts have plans");
  options.start_share = 1.0;
  options.period = 0.01;
  CHECK_THROWS_WITH(made(), "starts, 0: a plan for a period of 0.02 s; expected 0.01 s");
  options.period = kPlanPeriod;
  options.tasks = {"Hop"};
  CHECK_THROWS_WITH(made(), "starts, 0: of the task ThrowAndCatch; expected one that is played");
  options.tasks = {"Hop", "ThrowAndCatch"};
  CHECK_THROWS_WITH(made(), "starts: none of Hop; expected plans for each task");
}
