// SPDX-License-Identifier: MIT
#include "diabolo/learn/level_task.hpp"

#include <numbers>

#include "catch.hpp"
#include "diabolo/batch/batch.hpp"
#include "diabolo/learn/arena.hpp"
#include "diabolo/plan/level_hands.hpp"

using namespace diabolo;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Arena levelling(double reach = HandLimits{}.half.x(), const std::optional<Camera>& camera = {}) {
  Model model = consistent_model();
  model.effects.get<StringFriction>().coefficient = 0.3;
  ArenaOptions options{.tasks = {"Level"}, .autoreset = Autoreset::kDisabled, .camera = camera};
  options.limits.half.x() = reach;
  return {options, {model}, portable_batch_kernel<2>()};
}

/// Hands that follow LevelHands by their accelerations.
class LevelFollower {
 public:
  explicit LevelFollower(const Arena& arena) : arena_(arena), home_(tips()), hands_(hands()) {}

  std::vector<float> operator()() {
    const Episode& episode = arena_.episode(0);
    const Seen seen = arena_.options().camera ? episode.sight.seen() : seen_exactly(episode.state);
    hands_.see(seen.axis.normalized(), seen.spin, episode.state.string_state);
    hands_.advance(arena_.options().period);
    const Tips<double> wanted = hands_.tips(home_), is = tips();
    std::vector<float> shares;
    for (const auto& [gap, late] : {std::pair<Vector3<double>, Vector3<double>>(
                                        wanted.left - is.left, wanted.left_velocity - is.left_velocity),
                                    {wanted.right - is.right, wanted.right_velocity - is.right_velocity}})
      for (int axis = 0; axis < 3; ++axis)
        shares.push_back(static_cast<float>((kQuick * kQuick * gap[axis] + 2.0 * kQuick * late[axis]) /
                                            arena_.limits().acceleration));
    return shares;
  }

 private:
  static constexpr double kQuick = 20.0;  // [1/s]

  Tips<double> tips() const {
    const Hands& now = arena_.episode(0).hands;
    Tips<double> tips;
    tips.left = now.position[0], tips.right = now.position[1];
    tips.left_velocity = now.velocity[0], tips.right_velocity = now.velocity[1];
    return tips;
  }
  LevelHands hands() const {
    const FullPredictor<double> model(consistent_model().parameters, arena_.effects_of(0));
    const LevelWeights weights{.yaw = 0.1, .heading = 0.2, .turn = 1.0};
    return {model, home_, arena_.episode(0).state.spin, weights, {.quickness = kQuick}};
  }

  const Arena& arena_;
  Tips<double> home_;
  LevelHands hands_;
};

struct Levelled {
  int level = 0, soon = 0, dropped = 0;  ///< of the episodes; `soon` are level from 3 s on
  double worth = 0.0;                    ///< mean
};

constexpr int kEpisodes = 100;

Levelled played(Arena& arena, bool follows) {
  Levelled sum;
  for (int k = 0; k < kEpisodes; ++k) {
    arena.seed(0, 100 + static_cast<std::uint64_t>(k));
    arena.reset(0);
    LevelFollower hands(arena);
    const std::vector<float> still(6, 0.0F);
    while (!arena.episode(0).over) arena.step((follows ? hands() : still).data());
    sum.level += arena.episode(0).memory.level >= 1.0;
    sum.soon += arena.episode(0).memory.level >= 5.0 - 1e-9;
    sum.dropped += arena.episode(0).dropped;
    sum.worth += arena.episode(0).worth / kEpisodes;
  }
  return sum;
}

Worth judged(const AxleAngles& angles, Memory& memory, StringState string = StringState::kOnString) {
  State<double> state;
  state.axis = axle_at(angles);
  state.string_state = string;
  const Vector3<double> zero = Vector3<double>::Zero();
  return LevelTask::judge({state, state, Hands{}, zero, zero, 9.81, 0.01, Goal{}}, memory);
}

}  // namespace

TEST_CASE("hands that hold still lose the axle, and hands by the regulator's gains level it") {
  for (const auto& [reach, camera] :
       {std::pair<double, std::optional<Camera>>(0.1, {}), {0.1, Camera{}}, {0.35, {}}}) {
    Arena one = levelling(reach, camera), other = levelling(reach, camera);
    const Levelled still = played(one, false), following = played(other, true);
    CAPTURE(reach, camera.has_value(), following.level, following.soon, following.worth, still.level,
            still.worth);
    CHECK(still.level == 0);
    CHECK(following.dropped == 0);
    CHECK(following.worth > 3.0 * still.worth);
    // A box as deep as the usual one holds the hands up; one that does not shows that it can be done.
    CHECK(following.level >= (reach > 0.2 ? 80 : 40));
  }
}

TEST_CASE("levelling is worth the most on the string at no tilt and no yaw, and half at five degrees") {
  Memory memory;
  CHECK(judged({0.0, 0.0}, memory).reward == Approx(0.01));
  for (const double sign : {1.0, -1.0}) {
    CHECK(judged({5.0 * sign * kDegree, 0.0}, memory).reward == Approx(0.005));
    CHECK(judged({0.0, 5.0 * sign * kDegree}, memory).reward == Approx(0.005));
  }
  CHECK(judged({0.0, 0.0}, memory, StringState::kFlying).reward == 0.0);
}

TEST_CASE("the time for which an axle is level counts from when it was not, or flew") {
  Memory memory;
  for (int k = 0; k < 10; ++k) judged({4.9 * kDegree, -4.9 * kDegree}, memory);
  CHECK(memory.level == Approx(0.1));
  judged({0.0, 5.1 * kDegree}, memory);
  CHECK(memory.level == 0.0);
  judged({0.0, 0.0}, memory);
  CHECK(memory.level == Approx(0.01));
  judged({0.0, 0.0}, memory, StringState::kFlying);
  CHECK(memory.level == 0.0);
}

TEST_CASE("levelling begins 3 to 20 degrees off in all directions, and shows the axle") {
  Arena one = levelling();
  Vector3<double> low = Vector3<double>::Ones(), high = -low;
  for (int k = 0; k < 300; ++k) {
    one.reset(0);
    const State<double>& state = one.episode(0).state;
    const auto [tilt, yaw] = axle_angles(state.axis);
    const double off = std::hypot(tilt, yaw) / kDegree;
    CHECK((off > 2.99 && off < 20.01));
    CHECK((state.spin >= 60.0 && state.spin < 100.0));
    low = low.cwiseMin(state.axis), high = high.cwiseMax(state.axis);
    REQUIRE(one.observations.size() == kObservationSize + 6);
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK(one.observations[kObservationSize + axis] == Approx(state.axis[static_cast<int>(axis)]));
  }
  for (int axis = 1; axis < 3; ++axis) CHECK((low[axis] < -0.2 && high[axis] > 0.2));
}

TEST_CASE("a camera shows the axle as late as it says, and its rate by differences") {
  const Camera late{
      .noise = 0.0, .spin_noise = 0.0, .axle_noise = 0.0, .dropouts = 0.0, .least_delay = 2, .most_delay = 2};
  Arena one = levelling(0.1, late);
  one.reset(0);
  const std::vector<float> still(6, 0.0F);
  std::vector<Vector3<double>> axes{one.episode(0).state.axis};
  for (std::size_t k = 1; k < 40; ++k) {
    one.step(still.data());
    axes.push_back(one.episode(0).state.axis);
    if (k < 3) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = [&](std::size_t when) { return axes[when][static_cast<int>(axis)]; };
      REQUIRE(one.observations[kObservationSize + axis] == Approx(at(k - 2)).margin(1e-6));
      REQUIRE(one.observations[kObservationSize + 3 + axis] ==
              Approx((at(k - 2) - at(k - 3)) / 0.01).margin(1e-4));
    }
  }
}
