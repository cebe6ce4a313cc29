// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>

#include "catch.hpp"
#include "diabolo/batch/batch.hpp"
#include "diabolo/batch/kernels.hpp"

using namespace diabolo;
using V = Vector3<double>;

namespace {

TipMotion<double> beat(double amplitude, double frequency) {
  std::vector<double> times;
  std::vector<V> left, right, left_sticks, right_sticks;
  for (int i = 0; i <= 60; ++i) {
    const double t = i / 60.0, z = amplitude * std::sin(2.0 * M_PI * frequency * t);
    times.push_back(t);
    left.emplace_back(0.0, 0.3, 1.0 + z);
    right.emplace_back(0.0, -0.3, 1.0 - z);
    left_sticks.push_back(V(1.0, 0.5, z).normalized());
    right_sticks.push_back(V(1.0, -0.2, -3.0 * z).normalized());
  }
  TipMotion<double> motion(times, left, right, Interpolation::kSpline);
  motion.point_along(left_sticks, right_sticks);
  return motion;
}

/// Every field at a small share of its largest value.
AllEffects<double> every_effect() {
  AllEffects<double> effects;
  const auto turn_on = []<class Effect>(Effect& effect) {
    Effect::for_each(effect, [](const ParameterInfo& info, double& field) { field = 0.005 * info.maximum; });
  };
  std::apply([&](auto&... effect) { (turn_on(effect), ...); }, effects.members);
  return effects;
}

/// Diabolos that hang on strings of their own lengths under one preset, without effects: what a kernel does
/// in the fewest instructions.
Batch hanging(const TipMotion<double>& motion, std::size_t n) {
  Batch batch;
  batch.motions = {&motion};
  for (std::size_t i = 0; i < n; ++i) {
    Parameters<double> p = Parameters<double>::consistent();
    p.string_length = 1.3 + 0.02 * static_cast<double>(i);
    batch.parameters.push_back(p);
    State<double> s;
    s.position = V(0.0, 0.0, 1.0 - std::sqrt(0.25 * p.string_length * p.string_length - 0.09));
    s.velocity = V(0.1 * static_cast<double>(i % 3), 0.0, 0.0);
    s.spin = 10.0 * static_cast<double>(i);
    s.string_state = StringState::kOnString;
    batch.initial.push_back(s);
  }
  batch.steps = {0.0, 1e-3, 700};
  return batch;
}

/// Rollouts of all presets, on the string, slack and flying, without effects, with elasticity and with every
/// effect.
struct Case {
  std::vector<TipMotion<double>> motions;
  Batch batch;

  explicit Case(std::size_t n, bool own_motions) {
    std::mt19937_64 generator(n);
    const auto uniform = [&](double a, double b) {
      return std::uniform_real_distribution<double>(a, b)(generator);
    };
    for (std::size_t i = 0; i < (own_motions ? n : 1); ++i)
      motions.push_back(beat(uniform(0.0, 0.2), uniform(0.5, 3.0)));
    for (const TipMotion<double>& m : motions) batch.motions.push_back(&m);
    batch.parameters.clear();
    batch.effects.clear();
    for (std::size_t i = 0; i < n; ++i) {
      Parameters<double> p = i % 5 == 3   ? Parameters<double>::published()
                             : i % 5 == 4 ? Parameters<double>::paper()
                                          : Parameters<double>::consistent();
      p.string_length = uniform(1.3, 1.6);
      p.dissipation_rate = uniform(0.0, 0.2);
      batch.parameters.push_back(p);
      AllEffects<double> effects;
      if (i % 3 == 0)
        effects.get<StringElasticity>() = StringElasticity<double>::of_stiffness(uniform(60.0, 5000.0), 1.0);
      if (i % 3 == 1) effects = every_effect();
      batch.effects.push_back(effects);
      State<double> s;
      s.position = V(uniform(-0.1, 0.1), uniform(-0.1, 0.1), uniform(0.3, 1.6));
      s.velocity = V(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-2.0, 2.0));
      s.spin = uniform(-200.0, 200.0);
      s.axis = V(1.0, uniform(-0.2, 0.2), uniform(-0.2, 0.2)).normalized();
      s.string_state = i % 7 == 0 ? StringState::kFlying : StringState::kLoose;
      batch.initial.push_back(s);
    }
    batch.steps = {0.0, 1e-3, 700};
    batch.record_every = 7;
  }
};

void require_same(const State<double>& a, const State<double>& b) {
  REQUIRE(a.position == b.position);
  REQUIRE(a.velocity == b.velocity);
  REQUIRE(a.spin == b.spin);
  REQUIRE(a.string_state == b.string_state);
}

/// How far a batch may be from a single rollout: not at all, but where friction asks for tanh and atan2,
/// which in lanes differ from the C library's in the last places. The worst is seen to be between 1e-13 and
/// 1e-12.
double allowed(const AllEffects<double>& effects) {
  return effects.get<StringFriction>().neutral() ? 0.0 : 1e-11;
}

bool close(const V& a, const V& b, double share) { return (a - b).norm() <= share * (1.0 + b.norm()); }
bool close(double a, double b, double share) { return std::abs(a - b) <= share * (1.0 + std::abs(b)); }

}  // namespace

TEST_CASE("every kernel gives the same bits, whatever the neighbours and threads") {
  const std::atomic<bool> cancel = false;
  for (const bool own_motions : {false, true}) {
    Case test(19, own_motions);
    test.batch.forces = test.batch.axles = true;
    const BatchResult expected = rollout_batch(test.batch, portable_batch_kernel(), 1, cancel);
    for (const BatchKernel& kernel : batch_kernels())
      for (const int threads : {0, 1, 3}) {
        INFO("kernel " << kernel.instruction_set << ", threads " << threads << ", own motions "
                       << own_motions);
        const BatchResult result = rollout_batch(test.batch, kernel, threads, cancel);
        for (std::size_t i = 0; i < test.batch.initial.size(); ++i) {
          INFO("rollout " << i);
          require_same(result.final_states[i], expected.final_states[i]);
        }
        REQUIRE(result.records == expected.records);
        REQUIRE(result.record_states == expected.record_states);
        REQUIRE(result.forces == expected.forces);
        REQUIRE(result.axles == expected.axles);
      }
  }
}

TEST_CASE("the kernel for a few predictions is no wider than they need") {
  const std::vector<BatchKernel> kernels = batch_kernels();
  CHECK(batch_kernel_for(1).lanes == kernels.front().lanes);
  CHECK(batch_kernel_for(1000).lanes == kernels.back().lanes);
}

TEST_CASE("every kernel gives the bits of a single rollout, but for friction") {
  const std::atomic<bool> cancel = false;
  std::vector<BatchKernel> kernels = batch_kernels();
  kernels.push_back(portable_batch_kernel());
  for (const bool own_motions : {false, true}) {
    Case test(19, own_motions);
    test.batch.forces = test.batch.axles = true;
    std::vector<std::vector<State<double>>> expected;
    std::vector<std::vector<TipForces<double>>> pulls;
    for (std::size_t i = 0; i < test.batch.initial.size(); ++i) {
      const FullPredictor<double> predictor(test.batch.parameters[i], test.batch.effects[i]);
      const TipMotion<double>& motion = *test.batch.motions[own_motions ? i : 0];
      const Steps& steps = test.batch.steps;
      std::vector<State<double>> states;
      std::vector<TipForces<double>> forces;
      State<double> before = test.batch.initial[i];
      rollout(predictor, before, motion, steps,
              [&](std::size_t step, double time, const State<double>& s, const auto&) {
                forces.push_back(tip_forces(predictor, before, s, motion.at(steps.time(step - 1)),
                                            motion.at(time), steps.dt));
                states.push_back(s);
                before = s;
              });
      expected.push_back(states);
      pulls.push_back(forces);
    }
    for (const BatchKernel& kernel : kernels)
      for (const int threads : {0, 1, 3}) {
        INFO("kernel " << kernel.instruction_set << ", threads " << threads << ", own motions "
                       << own_motions);
        const BatchResult result = rollout_batch(test.batch, kernel, threads, cancel);
        for (std::size_t i = 0; i < expected.size(); ++i) {
          INFO("rollout " << i);
          const double most = allowed(test.batch.effects[i]);
          for (std::size_t k = 0; k < test.batch.records(); ++k) {
            const State<double>& s = expected[i][7 * (k + 1) - 1];
            const double* record = &result.records[7 * (i * test.batch.records() + k)];
            REQUIRE(close(V(record[0], record[1], record[2]), s.position, most));
            REQUIRE(close(V(record[3], record[4], record[5]), s.velocity, most));
            REQUIRE(close(record[6], s.spin, most));
            REQUIRE(result.record_states[i * test.batch.records() + k] == s.string_state);
            const double* axle = &result.axles[7 * (i * test.batch.records() + k)];
            REQUIRE(close(V(axle[0], axle[1], axle[2]), s.axis, most));
            REQUIRE(close(V(axle[3], axle[4], axle[5]), s.tumble, most));
            REQUIRE(axle[6] == s.turns);
            const TipForces<double>& f = pulls[i][7 * (k + 1) - 1];
            const double* force = &result.forces[6 * (i * test.batch.records() + k)];
            REQUIRE((V(force[0], force[1], force[2]) - f.left).norm() <= 1e-9 * (1.0 + f.left.norm()));
            REQUIRE((V(force[3], force[4], force[5]) - f.right).norm() <= 1e-9 * (1.0 + f.right.norm()));
          }
        }
      }
  }
}

TEST_CASE("lanes that differ and hang on taut strings without effects give the bits of single rollouts") {
  const std::atomic<bool> cancel = false;
  const TipMotion<double> motion = beat(0.05, 1.0);
  Batch batch = hanging(motion, 19);
  std::vector<BatchKernel> kernels = batch_kernels();
  kernels.push_back(portable_batch_kernel());
  for (const BatchKernel& kernel : kernels) {
    INFO("kernel " << kernel.instruction_set);
    const BatchResult result = rollout_batch(batch, kernel, 1, cancel);
    for (std::size_t i = 0; i < batch.initial.size(); ++i) {
      INFO("rollout " << i);
      const Predictor<double> predictor(batch.parameters[i]);
      std::size_t taut = 0;
      const State<double> expected = rollout(predictor, batch.initial[i], motion, batch.steps,
                                             [&](std::size_t, double, const State<double>& s, const auto&) {
                                               taut += s.string_state == StringState::kOnString ? 1 : 0;
                                             });
      require_same(result.final_states[i], expected);
      CHECK(taut == batch.steps.count);
    }
  }
}

TEST_CASE("each lane plays a law of time by its own clock") {
  const std::atomic<bool> cancel = false;
  AllEffects<double> effects;
  auto& laws = effects.get<FormulaLaws>();
  laws = FormulaLaws<double>({Law("gust", "", Acts::kForward, "size * sin(9 * t)", {{"size", "m/s^2"}})});
  laws.numbers[0] = 2.0;
  std::vector<TipMotion<double>> motions(7, beat(0.05, 1.0));
  Batch batch = hanging(motions[0], motions.size());
  batch.motions.clear();
  batch.effects = {effects};
  for (std::size_t i = 0; i < motions.size(); ++i) {
    motions[i].start_clock(0.3 * static_cast<double>(i));
    batch.motions.push_back(&motions[i]);
  }
  const BatchResult result = rollout_batch(batch, portable_batch_kernel(), 1, cancel);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    INFO("rollout " << i);
    const FullPredictor<double> predictor(batch.parameters[i], effects);
    const State<double> expected = rollout(predictor, batch.initial[i], motions[i], batch.steps);
    CHECK((result.final_states[i].position - expected.position).norm() < 1e-11);
    CHECK((expected.position - result.final_states[(i + 1) % motions.size()].position).norm() > 1e-3);
  }
}

TEST_CASE("a batch says what is wrong with it") {
  const std::atomic<bool> cancel = false;
  const auto run = [&](const Batch& batch) {
    return rollout_batch(batch, portable_batch_kernel(), 1, cancel);
  };
  Case test(4, false);
  SECTION("sizes") {
    test.batch.parameters.pop_back();
    REQUIRE_THROWS_WITH(run(test.batch),
                        "batch: 3 parameter sets for 4 initial states; must be 1 or as many");
  }
  SECTION("values") {
    test.batch.parameters[2].string_length = 0.0;
    REQUIRE_THROWS_WITH(run(test.batch), "string_length: 0 m; must be within [0.05, 20] m");
  }
  SECTION("effects") {
    test.batch.effects[3].get<StickFlex>().compliance = -1.0;
    REQUIRE_THROWS_WITH(run(test.batch), "stick_flex compliance: -1 m/N; must be within [0, 1] m/N");
  }
  SECTION("states") {
    const auto component = GENERATE(&State<double>::position, &State<double>::velocity, &State<double>::axis,
                                    &State<double>::string_acceleration);
    (test.batch.initial[1].*component)[2] = std::nan("");
    REQUIRE_THROWS_WITH(run(test.batch), "batch: an initial state is not finite");
  }
  SECTION("motions") {
    test.batch.motions[0] = nullptr;
    REQUIRE_THROWS_WITH(run(test.batch), "batch: a tip motion is a null pointer");
  }
  SECTION("threads") {
    REQUIRE_THROWS_WITH(rollout_batch(test.batch, portable_batch_kernel(), -1, cancel),
                        "threads: -1; must be 0 (one for every processor) or more");
  }
  SECTION("steps") {
    test.batch.steps.dt = 0.0;
    REQUIRE_THROWS_AS(run(test.batch), std::invalid_argument);
  }
}

namespace {

std::atomic<bool> cancelled;
std::atomic<int> calls;
constexpr int kCallsBeforeCancelling = 5;

void count_and_cancel(const LaneBlock& block) {
  if (++calls == kCallsBeforeCancelling) cancelled = true;
  portable_batch_kernel().run(block);
}

}  // namespace

TEST_CASE("a cancelled batch calls no kernel") {
  const Case test(8, false);
  cancelled = true;
  calls = 0;
  const BatchResult result = rollout_batch(test.batch, {2, &count_and_cancel, "counting"}, 2, cancelled);
  REQUIRE(calls == 0);
  for (std::size_t i = 0; i < 8; ++i) require_same(result.final_states[i], test.batch.initial[i]);
}

TEST_CASE("a batch that is cancelled in mid-run ends with the kernel calls that were under way") {
  Case test(8, GENERATE(false, true));
  test.batch.steps.count = 2'000'000'000;
  test.batch.record_every = 0;
  cancelled = false;
  calls = 0;
  const int threads = 3;
  rollout_batch(test.batch, {2, &count_and_cancel, "counting"}, threads, cancelled);
  REQUIRE(calls >= kCallsBeforeCancelling);
  REQUIRE(calls < kCallsBeforeCancelling + threads);
}
