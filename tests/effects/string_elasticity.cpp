// SPDX-License-Identifier: MIT
#include "diabolo/effects/string_elasticity.hpp"

#include "catch.hpp"
#include "diabolo/predictor.hpp"
#include "diabolo/string/hanging.hpp"
#include "random.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;
using Elastic = Predictor<double, StringElasticity>;
using Numbers = Parameters<double>;

namespace {

constexpr double kMass = 0.2845;

Elastic elastic(double stiffness, double damping = 0.0, Numbers parameters = Numbers::consistent()) {
  parameters.mass = kMass;
  EffectSet<double, StringElasticity> effects;
  effects.get<StringElasticity>() = StringElasticity<double>::of_stiffness(stiffness, damping);
  return Elastic(parameters, effects);
}

double path_length(const Vector& p, const Tips<double>& tips) {
  return (p - tips.left).norm() + (p - tips.right).norm();
}

/// The lowest point of the taut, not yet stretched string.
State<double> hanging_at(const Tips<double>& tips, double length) {
  return hanging_state(tips.left, tips.right, length);
}

/// Kinetic, potential and elastic energy [J].
double energy(const State<double>& state, const Tips<double>& tips, double stiffness, double length) {
  const double extension = std::max(0.0, path_length(state.position, tips) - length);
  return kMass * (0.5 * state.velocity.squaredNorm() + kStandardGravity * state.position.z()) +
         0.5 * stiffness * extension * extension;
}

}  // namespace

TEST_CASE("stiffness is stated, compliance is kept") {
  const StringElasticity<double> e = StringElasticity<double>::of_stiffness(400.0, 2.0);
  CHECK(e.spring().compliance == 1.0 / 400.0);
  CHECK(e.spring().damping_time == 2.0 / 400.0);
  CHECK(StringElasticity<double>().spring().compliance == 0.0);
  CHECK(StringElasticity<double>().spring().damping_time == 0.0);
}

TEST_CASE("numbers out of their range are refused by effect and field") {
  using Catch::Matchers::Contains;
  using Catch::Matchers::StartsWith;
  EffectSet<double, StringElasticity> effects;
  const auto refused = [&](double compliance, double damping) {
    effects.get<StringElasticity>().compliance_per_newton = compliance;
    effects.get<StringElasticity>().damping = damping;
    return [&] { Elastic(Numbers(), effects); };
  };
  CHECK_NOTHROW(refused(0.0, 0.0)());
  CHECK_NOTHROW(refused(1.0, 1e4)());
  CHECK_THROWS_WITH(refused(-1e-9, 0.0)(),
                    StartsWith("string_elasticity compliance: ") && Contains("[0, 1] m/N"));
  CHECK_THROWS_WITH(refused(1.001, 0.0)(), StartsWith("string_elasticity compliance: "));
  CHECK_THROWS_WITH(refused(0.1, -1.0)(), StartsWith("string_elasticity damping: "));
  CHECK_THROWS_WITH(refused(std::nan(""), 0.0)(), StartsWith("string_elasticity compliance: nan"));
}

TEST_CASE("a diabolo at rest stretches the string by compliance times tension") {
  for (const double stiffness : {20.0, 60.0, 400.0, 4000.0, 1e6})
    for (const double distance : {0.0, 0.2, 1.0}) {
      const Tips<double> tips = level(distance);
      const Elastic predictor = elastic(stiffness, 0.3 * std::sqrt(stiffness));
      State<double> state = hanging_at(tips, 1.45);
      for (int i = 0; i < 20000; ++i) predictor.step(state, tips, tips, 1e-3);
      CAPTURE(stiffness, distance);
      REQUIRE(state.velocity.norm() < 1e-8);
      // T = m g / (2 cos of half the angle between the strands), at the stretched place itself.
      const double drop = 1.0 - state.position.z(), strand = std::hypot(0.5 * distance, drop);
      const double tension = kMass * kStandardGravity * strand / (2.0 * drop);
      CHECK(path_length(state.position, tips) - 1.45 ==
            Approx(tension / stiffness).epsilon(1e-6).margin(2e-10));
      CHECK(state.string_acceleration.z() == Approx(kStandardGravity).epsilon(1e-6));
    }
}

TEST_CASE("a stretched string rings at the frequency of its spring") {
  // Tips in one place: both strands stretch at once, m z'' = -4 k z.
  for (const double stiffness : {60.0, 300.0, 1000.0}) {
    const Tips<double> tips = level(0.0);
    const double rate = std::sqrt(4.0 * stiffness / kMass), period = 2.0 * M_PI / rate, dt = period / 400.0;
    const double rest = 1.0 - 0.5 * (1.45 + 0.5 * kMass * kStandardGravity / stiffness);
    State<double> state;
    const double swing = 0.5 * (1.0 - 0.725 - rest);  // half of what would let the string go slack
    state.position = Vector(0.0, 0.0, rest - swing);
    const Elastic predictor = elastic(stiffness);
    // Upward zero crossings over ten periods.
    int crossings = 0;
    double first = 0.0, last = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const double before = state.position.z() - rest;
      predictor.step(state, tips, tips, dt);
      const double now = state.position.z() - rest;
      if (before < 0.0 && now >= 0.0) {
        last = (i + before / (before - now)) * dt;
        if (crossings++ == 0) first = last;
      }
    }
    REQUIRE(crossings == 10);
    // The trapezoidal rule lengthens the period by (rate dt)^2 / 12 = 2e-5.
    CHECK((last - first) / 9.0 == Approx(period).epsilon(5e-5));
  }
}

TEST_CASE("an undamped resolved spring keeps the energy, a damped one loses it, none gains") {
  Random random(700);
  double kept_worst = 0.0, gain = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double stiffness = random.log_uniform(30.0, 1000.0);
    const Tips<double> tips = level(random.uniform(0.0, 0.8));
    State<double> state = hanging_at(tips, 1.45);
    state.position += random.vector(0.02) - Vector(0.0, 0.0, 0.03);
    state.velocity = random.vector(0.3);
    for (const double damping : {0.0, 1.0}) {
      const Elastic predictor = elastic(stiffness, damping);
      State<double> now = state;
      const double start = energy(now, tips, stiffness, 1.45);
      double before = start;
      bool taut = true;
      for (int k = 0; k < 1000; ++k) {
        predictor.step(now, tips, tips, 1e-3);
        if (now.string_state == StringState::kFlying) break;  // the string is no longer around the axle
        const double after = energy(now, tips, stiffness, 1.45);
        gain = std::max(gain, after - before);
        before = after;
        taut = taut && path_length(now.position, tips) > 1.45;
      }
      if (damping > 0.0) CHECK(before < start - 1e-6);
      if (damping == 0.0 && taut) kept_worst = std::max(kept_worst, std::abs(before - start));
    }
  }
  CHECK(kept_worst < 1e-8);
  CHECK(gain < 1e-9);
}

TEST_CASE("bouncing on an elastic string gives no energy") {
  Random random(701);
  double gain = 0.0;
  int slack = 0;
  for (int i = 0; i < 60; ++i) {
    const double stiffness = random.log_uniform(30.0, 1e5);  // resolved and not
    const Tips<double> tips = level(random.uniform(0.0, 1.2));
    State<double> state = hanging_at(tips, 1.45);
    state.position.z() += 0.2;
    state.velocity = random.vector(2.0);
    const Elastic predictor = elastic(stiffness);
    for (int k = 0; k < 1000; ++k) {
      const double before = energy(state, tips, stiffness, 1.45);
      predictor.step(state, tips, tips, 1e-3);
      gain = std::max(gain, energy(state, tips, stiffness, 1.45) - before);
      slack += path_length(state.position, tips) < 1.45;
    }
  }
  CHECK(slack > 1000);
  CHECK(gain < 1e-9);
}

TEST_CASE("elastic motion converges to its equation with the second order of the step") {
  // m a = m g - (k e + c de/dt) grad S, by the classical Runge-Kutta method with small steps.
  Random random(702);
  for (int episode = 0; episode < 4; ++episode) {
    const double stiffness = random.log_uniform(60.0, 400.0), damping = episode % 2 == 0 ? 0.0 : 3.0;
    const SmoothTips player = SmoothTips::random(random, 0.3, 0.05, 6.0);
    const auto acceleration = [&](const Vector& p, const Vector& v, double t) {
      const Tips<double> tips = player.at(t);
      const Vector l = (p - tips.left).normalized(), r = (p - tips.right).normalized();
      const double rate = l.dot(v - tips.left_velocity) + r.dot(v - tips.right_velocity);
      const double tension = stiffness * (path_length(p, tips) - 1.45) + damping * rate;
      return Vector(Vector(0.0, 0.0, -kStandardGravity) - (l + r) * (std::max(0.0, tension) / kMass));
    };
    State<double> start = hanging_at(player.at(0.0), 1.45 + 0.5 * kMass * kStandardGravity / stiffness);
    constexpr double kDuration = 0.5;
    Vector p = start.position, v = start.velocity;
    double least = 1.0;
    const int fine_steps = 10000;
    const double h = kDuration / fine_steps;
    for (int i = 0; i < fine_steps; ++i) {
      const double t = i * h;
      const Vector a1 = acceleration(p, v, t), v2 = v + a1 * (0.5 * h),
                   a2 = acceleration(p + v * (0.5 * h), v2, t + 0.5 * h);
      const Vector v3 = v + a2 * (0.5 * h), a3 = acceleration(p + v2 * (0.5 * h), v3, t + 0.5 * h);
      const Vector v4 = v + a3 * h, a4 = acceleration(p + v3 * h, v4, t + h);
      p += (v + 2.0 * v2 + 2.0 * v3 + v4) * (h / 6.0);
      v += (a1 + 2.0 * a2 + 2.0 * a3 + a4) * (h / 6.0);
      least = std::min(least, path_length(p, player.at(t + h)) - 1.45);
    }
    if (least < 1e-3) continue;
    const auto error = [&](int steps) {
      const Elastic predictor = elastic(stiffness, damping);
      State<double> state = start;
      for (int i = 0; i < steps; ++i)
        predictor.step(state, player.at(i * kDuration / steps), player.at((i + 1) * kDuration / steps),
                       kDuration / steps);
      return (state.position - p).norm();
    };
    const double coarse = error(500), fine = error(1000);
    CAPTURE(episode, stiffness, damping, coarse, fine);
    CHECK(fine < 1e-4);
    CHECK(coarse / fine == Approx(4.0).epsilon(0.15));
  }
}

TEST_CASE("ever stiffer strings give the rigid string's motion") {
  Random random(703);
  for (int episode = 0; episode < 5; ++episode) {
    const SmoothTips player = SmoothTips::random(random, 0.4, 0.1, 6.0);
    State<double> start = hanging_at(player.at(0.0), 1.44);
    Numbers parameters = Numbers::consistent();
    parameters.mass = kMass;
    const auto final = [&](const auto& predictor) {
      State<double> state = start;
      for (int i = 0; i < 500; ++i)
        predictor.step(state, player.at(i * 1e-3), player.at((i + 1) * 1e-3), 1e-3);
      return state.position;
    };
    const Vector rigid = final(Predictor<double>(parameters));
    const double soft = (final(elastic(1e5)) - rigid).norm(), stiff = (final(elastic(1e7)) - rigid).norm(),
                 stiffest = (final(elastic(1e9)) - rigid).norm();
    CAPTURE(episode, soft, stiff, stiffest);
    CHECK(soft < 5e-3);
    CHECK(stiff < 0.02 * soft + 1e-7);
    CHECK(stiffest < 0.02 * stiff + 1e-7);
  }
}

TEST_CASE("at amplitude zero every preset gives the plain predictor's bits") {
  Random random(704);
  for (const auto preset : {&Numbers::consistent, &Numbers::paper, &Numbers::published})
    for (int episode = 0; episode < 40; ++episode) {
      const Numbers parameters = preset();
      const Predictor<double> plain(parameters);
      EffectSet<double, StringElasticity> effects;
      effects.get<StringElasticity>().damping = 3.0;  // of no spring: nothing
      const Elastic neutral(parameters, effects);
      const SmoothTips player = SmoothTips::random(random, random.uniform(0.1, 1.44), 0.2, 12.0);
      const Tips<double> begin = player.at(0.0);
      State<double> a;
      a.position = random.reachable({begin.left, begin.right, parameters.string_length});
      a.velocity = random.vector(3.0);
      a.spin = random.uniform(-100.0, 100.0);
      a.string_state = static_cast<StringState>(random.index(3));
      State<double> b = a;
      bool same = true;
      for (int k = 0; k < 300; ++k) {
        const Tips<double> now = player.at(k * 1e-3), next = player.at((k + 1) * 1e-3);
        const StepStatus<double> one = plain.step(a, now, next, 1e-3), two = neutral.step(b, now, next, 1e-3);
        same = same && a.position == b.position && a.velocity == b.velocity && a.spin == b.spin &&
               a.string_state == b.string_state && a.string_acceleration == b.string_acceleration &&
               one.caught == two.caught && one.snapped_taut == two.snapped_taut &&
               one.overstretched == two.overstretched;
      }
      CHECK(same);
    }
}

TEST_CASE("under the published rules a compliant string hangs as far down as its law says") {
  for (const double stiffness : {200.0, 4000.0}) {
    const Tips<double> tips = level(0.2);
    const Numbers parameters = Numbers::published();
    const Elastic predictor = elastic(stiffness, 0.0, parameters);
    State<double> state = hanging_at(tips, parameters.string_length);
    for (int i = 0; i < 5000; ++i) predictor.step(state, tips, tips, 1e-3);
    const double drop = 1.0 - state.position.z(), strand = std::hypot(0.1, drop);
    const double tension = kMass * parameters.gravity * strand / (2.0 * drop);
    CAPTURE(stiffness);
    // Its projection is radial and its step explicit: a few percent.
    CHECK(path_length(state.position, tips) - parameters.string_length ==
          Approx(tension / stiffness).epsilon(0.05));
  }
}

TEST_CASE(
    "under the paper's and the published rules compliance keeps every motion finite and near the string") {
  Random random(705);
  for (const auto preset : {&Numbers::paper, &Numbers::published})
    for (int episode = 0; episode < 20; ++episode) {
      const Elastic predictor = elastic(random.log_uniform(60.0, 1e4), 0.0, preset());
      const SmoothTips player = SmoothTips::random(random, random.uniform(0.1, 1.2), 0.1, 8.0);
      State<double> state = hanging_at(player.at(0.0), predictor.parameters().string_length);
      for (int k = 0; k < 1000; ++k) {
        predictor.step(state, player.at(k * 1e-3), player.at((k + 1) * 1e-3), 1e-3);
        REQUIRE(state.position.allFinite());
        REQUIRE(state.velocity.allFinite());
        if (state.string_state != StringState::kFlying)
          CHECK(path_length(state.position, player.at((k + 1) * 1e-3)) < 2.0);
      }
    }
}

TEST_CASE("a slack string does not pull, whatever its damper") {
  const Tips<double> tips = level(0.4);
  for (const double damping : {0.1, 1.0, 10.0, 1000.0})
    for (const double stiffness : {30.0, 100.0, 1000.0}) {
      const Elastic predictor = elastic(stiffness, damping);
      State<double> state = hanging_at(tips, 1.45);
      state.position.z() += 0.03;
      state.velocity = Vector(0.5, 0.2, -2.0);  // lengthening by almost 4 m/s
      predictor.step(state, tips, tips, 1e-3);
      CAPTURE(damping, stiffness);
      REQUIRE(path_length(state.position, tips) < 1.45);
      CHECK(state.string_acceleration.isZero(0.0));
      CHECK(state.velocity.z() == Approx(-2.0 - kStandardGravity * 1e-3));
    }
}

TEST_CASE("an elastic string holds a diabolo between tips that are farther apart than it") {
  const Tips<double> tips = level(1.5);
  const Elastic predictor = elastic(300.0, 50.0);
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.99);
  for (int i = 0; i < 20000; ++i) REQUIRE(predictor.step(state, tips, tips, 1e-3).overstretched);
  CHECK(state.position.allFinite());
  CHECK(state.position.z() < 1.0);  // it sags under its weight
  const double drop = 1.0 - state.position.z(), strand = std::hypot(0.75, drop);
  const double tension = 300.0 * (2.0 * strand - 1.45);
  CHECK(2.0 * tension * drop / strand == Approx(kMass * kStandardGravity).epsilon(0.01));
}
