// SPDX-License-Identifier: MIT
#include "diabolo/predictor.hpp"

#include <limits>

#include "catch.hpp"
#include "diabolo/math/pack.hpp"
#include "random.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

constexpr StringState kOn = StringState::kOnString, kLoose = StringState::kLoose,
                      kFlying = StringState::kFlying;
constexpr double kStep = 1e-3;

using Numbers = Parameters<double>;
using Preset = Numbers (*)();
constexpr Preset kPresets[] = {&Numbers::consistent, &Numbers::paper, &Numbers::published};
constexpr Preset kPullPresets[] = {&Numbers::paper, &Numbers::published};

/// Level resting tips at height 1 m, the given distance apart along y.
Tips<double> level(double distance) {
  Tips<double> tips;
  tips.left = Vector(0.0, 0.5 * distance, 1.0);
  tips.right = Vector(0.0, -0.5 * distance, 1.0);
  return tips;
}

Spheroid<double> spheroid_of(const Tips<double>& tips, double length) {
  return {tips.left, tips.right, length};
}

State<double> at_rest(const Vector& position, StringState string_state) {
  State<double> state;
  state.position = position;
  state.string_state = string_state;
  return state;
}

/// The string state after one step on resting tips.
StringState after_step(const Numbers& parameters, State<double> state, const Tips<double>& tips) {
  Predictor<double>(parameters).step(state, tips, tips, kStep);
  return state.string_state;
}

}  // namespace

TEST_CASE("a bad parameter is refused at construction") {
  Numbers parameters;
  parameters.mass = -1.0;
  CHECK_THROWS_AS(Predictor<double>(parameters), std::invalid_argument);
  CHECK(Predictor<double>(Numbers::paper()).parameters().gravity == 9.8);
}

TEST_CASE("every preset: from the string to loose, well inside the spheroid") {
  const Tips<double> tips = level(0.5);
  for (const Preset preset : kPresets) {
    const Numbers parameters = preset();
    const Spheroid<double> s = spheroid_of(tips, parameters.string_length);
    const auto below = [&](double inside) {
      return Vector(s.center() - Vector(0.0, 0.0, s.semi_minor() - inside));
    };
    CHECK(after_step(parameters, at_rest(below(0.011), kOn), tips) == kLoose);
    CHECK(after_step(parameters, at_rest(below(0.3), kOn), tips) == kLoose);
    CHECK(after_step(parameters, at_rest(below(0.011), kLoose), tips) == kLoose);
    // The published program has no c_L: inside is loose.
    if (preset != kPresets[2]) CHECK(after_step(parameters, at_rest(below(0.009), kOn), tips) == kOn);
  }
}

TEST_CASE("every preset: from loose to the string at the surface") {
  const Tips<double> tips = level(0.5);
  for (const Preset preset : kPresets) {
    const Numbers parameters = preset();
    const Spheroid<double> s = spheroid_of(tips, parameters.string_length);
    State<double> state = at_rest(s.center() - Vector(0.0, 0.0, s.semi_minor() - 1e-4), kLoose);
    state.velocity.z() = -1.0;
    CHECK(after_step(parameters, state, tips) == kOn);
    state.velocity.z() = 1.0;
    CHECK(after_step(parameters, state, tips) == kLoose);
  }
}

TEST_CASE("every preset: to flying only above the plane of the tips") {
  const Tips<double> tips = level(1.2);
  for (const Preset preset : kPresets)
    for (const StringState from : {kOn, kLoose}) {
      CHECK(after_step(preset(), at_rest({0.0, 0.1, 1.1}, from), tips) == kFlying);
      CHECK(after_step(preset(), at_rest({0.0, 0.1, 0.9}, from), tips) == kLoose);
    }
}

TEST_CASE("every preset: a flying diabolo passes through the surface") {
  const Tips<double> tips = level(0.5);
  for (const Preset preset : kPresets) {
    const Numbers parameters = preset();
    const Spheroid<double> s = spheroid_of(tips, parameters.string_length);
    for (const double outside : {-0.02, 0.02}) {
      State<double> state = at_rest(s.center() - Vector(0.0, 0.0, s.semi_minor() + outside), kFlying);
      state.velocity = Vector(0.1, 0.0, -1.0);
      const Predictor<double> predictor(parameters);
      for (int i = 0; i < 50; ++i) {
        const double fall = state.velocity.z();
        const StepStatus<double> status = predictor.step(state, tips, tips, kStep);
        CHECK(state.string_state == kFlying);
        CHECK_FALSE(status.caught);
        CHECK(state.velocity.z() == Approx(fall - parameters.gravity * kStep));
      }
    }
  }
}

TEST_CASE("every preset: the taut catch") {
  for (const Preset preset : kPresets) {
    const Numbers parameters = preset();
    const double length = parameters.string_length;
    // Falls onto the string between the tips, with the string open by less than the catch's slack.
    const auto fall = [&](double distance, double y, double from_height, double speed, int steps) {
      const Tips<double> tips = level(distance);
      State<double> state = at_rest({0.0, y, 1.0 + from_height}, kFlying);
      state.velocity.z() = -speed;
      const Predictor<double> predictor(parameters);
      bool caught = false;
      for (int i = 0; i < steps; ++i) caught = predictor.step(state, tips, tips, kStep).caught || caught;
      return std::pair(state.string_state, caught);
    };
    const auto [state, caught] = fall(length - 0.02, 0.1, 0.2, 2.0, 200);
    CHECK(state == kOn);
    CHECK(caught);
    CHECK(fall(length - 0.02, 0.1, 0.2, 2.0, 50).first == kFlying);   // not there yet
    CHECK(fall(length - 0.05, 0.1, 0.2, 2.0, 200).first == kFlying);  // string too loose: falls through
    CHECK(fall(length - 0.02, 0.8, 0.2, 2.0, 200).first == kFlying);  // beside the string
  }
}

TEST_CASE("published: state, then constraint, then spin, in the order of the recipe") {
  Numbers parameters = Numbers::published();
  const Predictor<double> predictor(parameters);
  Random random(500);
  int constrained = 0;
  for (int i = 0; i < 2000; ++i) {
    const SmoothTips player = SmoothTips::random(random, random.uniform(0.1, 1.44), 0.2, 10.0);
    Tips<double> begin = player.at(0.0), end = player.at(kStep);
    State<double> state;
    const Spheroid<double> before(begin.left, begin.right, parameters.string_length);
    const Spheroid<double> after(end.left, end.right, parameters.string_length);
    state.position = random.reachable(before, 0.9);
    state.velocity = random.vector(2.0);
    state.spin = random.uniform(-100.0, 100.0);
    state.string_state = random.chance(0.5) ? kOn : kLoose;
    const State<double> start = state;
    predictor.step(state, begin, end, kStep);

    // 1. The parabola; 3. the state by the position so predicted.
    const double g = 9.8, a = parameters.string_length / 2.0;
    Vector p = start.position + start.velocity * kStep - Vector(0.0, 0.0, 0.5 * g * kStep * kStep);
    Vector v = start.velocity - Vector(0.0, 0.0, g * kStep);
    const StringState expected_state =
        published_string_state<double>(start.string_state, p, after, parameters);
    double spin = start.spin;
    if (expected_state == kOn) {
      ++constrained;
      // 2. and 4.: scaled towards the centre, in the frame of the spheroid.
      const Vector axis = (end.left - end.right).normalized(), center = (end.left + end.right) / 2.0;
      const double half = (end.left - end.right).norm() / 2.0, b = std::sqrt(a * a - half * half);
      const double half_before = (begin.left - begin.right).norm() / 2.0;
      const double b_before = std::sqrt(a * a - half_before * half_before);
      const auto published_normal = [&](const Vector& x) {
        const Vector along = axis * axis.dot(x - center);
        return Vector(((x - center - along) / b + along / a).normalized());
      };
      const double along = axis.dot(p - center), across = (p - center - axis * along).norm();
      const Vector put =
          center + (p - center) / std::sqrt(along * along / (a * a) + across * across / (b * b));
      const Vector n = published_normal(put), n_before = published_normal(p);
      double pull_size = -(put - p).dot(n) / kStep * 0.13;
      Vector pull = pull_size > 0.0 ? Vector(n * -pull_size) : Vector(Vector::Zero());
      const Vector center_shift = center - (begin.left + begin.right) / 2.0;
      double cap = center_shift.dot(n_before) < 0.0 ? center_shift.norm() / kStep : 0.0;
      cap += std::max(0.0, (b_before - b) / kStep);
      if (pull.norm() > 0.13 * cap) pull = n_before * (-0.13 * cap);
      if (2.0 * half >= parameters.string_length - 0.03 && pull.norm() > 0.0) {  // 5.
        const Vector sideways = (end.left - end.right).cross(Vector::UnitZ()).normalized();
        const Vector kept = pull - sideways * sideways.dot(pull);
        pull = kept * (pull.norm() / kept.norm());
      }
      v = v * 0.9999 + pull * 0.07;  // 6.
      v -= n * std::max(0.0, n.dot(v));
      if (start.string_state == kOn) {  // 7.
        const double change = (put - end.right).norm() - (start.position - begin.right).norm();
        spin += (change / kStep - spin * 0.0065) * 0.00015 / 0.0065;
      }
      p = put;
    }
    CAPTURE(i);
    CHECK(state.string_state == expected_state);
    CHECK((state.position - p).norm() < 1e-13);
    CHECK((state.velocity - v).norm() < 1e-9);
    CHECK(state.spin == Approx(spin).epsilon(1e-10).margin(1e-8));
  }
  CHECK(constrained > 300);
}

TEST_CASE("the paper's rules change position and spin on the string only") {
  Numbers parameters = Numbers::paper();
  const Predictor<double> predictor(parameters);
  Random random(501);
  int held = 0;
  for (int i = 0; i < 3000; ++i) {
    const SmoothTips player = SmoothTips::random(random, random.uniform(0.1, 1.44), 0.2, 10.0);
    const Tips<double> begin = player.at(0.0), end = player.at(kStep);
    const Spheroid<double> after(end.left, end.right, parameters.string_length);
    if (after.overstretched()) continue;
    State<double> state;
    state.position = random.reachable({begin.left, begin.right, parameters.string_length}, 0.8);
    state.velocity = random.vector(2.0);
    state.spin = 50.0;
    state.string_state = static_cast<StringState>(random.index(3));
    const State<double> start = state;
    predictor.step(state, begin, end, kStep);
    const Vector euler = start.position + start.velocity * kStep;
    if (state.string_state == kOn && !after.contains(euler)) {
      ++held;
      CHECK((state.position - after.closest_point(euler)).norm() < 1e-15);
    } else {
      CHECK((state.position - euler).norm() < 1e-15);
    }
    const double change = (state.position - end.right).norm() - (start.position - begin.right).norm();
    const bool stays = start.string_state == kOn && state.string_state == kOn;
    CHECK(state.spin == Approx(stays ? 50.0 + 154.0 * change : 50.0));
  }
  CHECK(held > 300);
}

TEST_CASE("the paper's spin knows how much string has passed, and nothing of motion in common") {
  const Numbers parameters = Numbers::paper();
  const Predictor<double> predictor(parameters);
  const auto raised = [](double height) {
    Tips<double> tips = level(0.5);
    tips.left.z() += height;
    tips.right.z() += height;
    return tips;
  };
  const Spheroid<double> s = spheroid_of(raised(0.0), parameters.string_length);
  State<double> lifted = at_rest(s.center() - Vector(0.0, 0.0, s.semi_minor()), kOn);
  for (int k = 0; k < 500; ++k) {
    const auto height = [](int i) { return 0.5 * std::pow(i * kStep, 2); };
    predictor.step(lifted, raised(height(k)), raised(height(k + 1)), kStep);
  }
  CHECK(lifted.position.z() == Approx(s.center().z() - s.semi_minor() + 0.125).margin(1e-9));
  CHECK(std::abs(lifted.spin) < 1e-9);

  const Tips<double> tips = raised(0.0);
  State<double> swinging = at_rest(s.closest_point({0.0, 0.3, 0.0}), kOn);
  const double start = (swinging.position - tips.right).norm();
  double farthest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    predictor.step(swinging, tips, tips, kStep);
    REQUIRE(swinging.string_state == kOn);
    const double change = (swinging.position - tips.right).norm() - start;
    CHECK(swinging.spin == Approx(parameters.pull.mu_acceleration * change).margin(1e-9));
    farthest = std::max(farthest, std::abs(change));
  }
  CHECK(farthest > 0.1);
}

TEST_CASE("tips farther apart than the string: the diabolo is held between them, or let go") {
  for (const Preset preset : kPresets) {
    const Numbers parameters = preset();
    const Predictor<double> predictor(parameters);
    Tips<double> begin = level(parameters.string_length - 0.01), end = level(parameters.string_length + 0.05);
    end.left_velocity = Vector(0.0, 1.0, 0.2);
    end.right_velocity = Vector(0.0, -1.0, 0.2);
    State<double> state = at_rest({0.0, 0.2, 0.95}, kOn);
    const StepStatus<double> status = predictor.step(state, begin, end, kStep);
    CHECK(status.overstretched);
    if (parameters.pull.release_when_overstretched) {
      CHECK(state.velocity.z() == Approx(-parameters.gravity * kStep));
      CHECK(state.string_state == kLoose);
      continue;
    }
    CHECK(std::abs(state.position.z() - 1.0) < 1e-12);
    CHECK(std::abs(state.position.x()) < 1e-12);
    CHECK(std::abs(state.position.y()) < 0.75);
    CHECK(state.velocity.z() == Approx(0.2));
    CHECK(state.string_state == kOn);
    State<double> flying = at_rest({0.0, 0.2, 3.0}, kFlying);
    CHECK(predictor.step(flying, begin, end, kStep).overstretched);
    CHECK_FALSE(predictor.step(flying, end, begin, kStep).overstretched);
    CHECK(flying.string_state == kFlying);
    CHECK(flying.position.z() == Approx(3.0).margin(1e-5));
  }
}

TEST_CASE("an overstretched string lets the diabolo swing on when the tips come back") {
  const Predictor<double> predictor(Numbers::consistent());
  State<double> state = at_rest({0.0, 0.0, 0.5}, kLoose);
  bool was_overstretched = false;
  for (int i = 0; i < 2000; ++i) {
    const auto distance = [](int k) { return 1.3 + 0.3 * std::sin(0.005 * k); };
    was_overstretched =
        predictor.step(state, level(distance(i)), level(distance(i + 1)), kStep).overstretched ||
        was_overstretched;
    REQUIRE(state.position.allFinite());
    const Spheroid<double> s = spheroid_of(level(distance(i + 1)), 1.45);
    if (!s.overstretched() && !(state.string_state == kFlying))
      CHECK(s.path_length(state.position) < 1.45 * (1.0 + 1.1e-10));
  }
  CHECK(was_overstretched);
}

TEST_CASE("the string's acceleration is that over the whole step, also after a catch within it") {
  Random random(78);
  Numbers parameters;
  int caught = 0;
  for (int i = 0; i < 200; ++i) {
    const double speed = random.uniform(0.5, 4.0), fraction = random.uniform(0.05, 0.95);
    const Tips<double> tips = level(parameters.string_length - 0.01);
    State<double> state = at_rest({0.0, 0.0, 1.0 + speed * fraction * kStep}, kFlying);
    state.velocity = Vector(0.0, 0.0, -speed);
    const State<double> before = state;
    const StepStatus<double> status = Predictor<double>(parameters).step(state, tips, tips, kStep);
    if (!status.caught || status.snapped_taut) continue;
    ++caught;
    const Vector free = before.velocity - Vector(0.0, 0.0, parameters.gravity * kStep);
    CHECK((state.velocity - free - state.string_acceleration * kStep).norm() < 1e-9);
  }
  CHECK(caught > 20);
}

TEST_CASE("a planar diabolo on a straight string stays in its plane") {
  Numbers parameters;
  parameters.planar = true;
  Tips<double> tips = level(parameters.string_length + 0.05);
  tips.left.x() = 0.1;
  State<double> state = at_rest({0.02, 0.1, 0.95}, kOn);
  for (int i = 0; i < 5; ++i) {
    const StepStatus<double> status = Predictor<double>(parameters).step(state, tips, tips, kStep);
    CHECK(status.overstretched);
    CHECK(state.position.x() == Approx(0.02).margin(1e-12));
    CHECK(state.velocity.x() == Approx(0.0).margin(1e-12));
    CHECK(state.position.allFinite());
  }
}

TEST_CASE("planar motion stays in its plane") {
  Random random(502);
  for (const Preset preset : kPresets) {
    double off = 0.0, astray = 0.0;
    for (int i = 0; i < 30; ++i) {
      Numbers parameters = preset();
      parameters.planar = true;
      parameters.plane_normal =
          Eigen::AngleAxisd(random.uniform(-0.5, 0.5), Vector::UnitZ()) * Vector::UnitX();
      const Predictor<double> predictor(parameters);
      const SmoothTips player = SmoothTips::random(random, random.uniform(0.1, 1.0), 0.15, 8.0);
      State<double> state;
      const Tips<double> begin = player.at(0.0);
      state.position = random.reachable({begin.left, begin.right, parameters.string_length}, 0.0);
      state.velocity = random.vector(2.0);
      const Vector start = state.position;
      for (int k = 0; k < 300; ++k) {
        predictor.step(state, player.at(k * kStep), player.at((k + 1) * kStep), kStep);
        off = std::max(off, std::abs(parameters.plane_normal.dot(state.position - start)));
        astray = std::max(astray, std::abs(parameters.plane_normal.dot(state.velocity)));
      }
    }
    CHECK(off < 1e-12);
    CHECK(astray < 1e-12);
  }
}

TEST_CASE("planar motion of tips in the plane is the full motion") {
  Random random(503);
  for (int i = 0; i < 10; ++i) {
    SmoothTips player = SmoothTips::random(random, 0.4, 0.15, 8.0);
    for (SmoothTip* tip : {&player.left, &player.right}) tip->amplitude.x() = 0.0;
    Numbers parameters = Numbers::consistent();
    const Predictor<double> full(parameters);
    parameters.planar = true;
    const Predictor<double> planar(parameters);
    State<double> a = at_rest({0.0, 0.1, 0.4}, kLoose), b = a;
    for (int k = 0; k < 500; ++k) {
      full.step(a, player.at(k * kStep), player.at((k + 1) * kStep), kStep);
      planar.step(b, player.at(k * kStep), player.at((k + 1) * kStep), kStep);
    }
    CHECK((a.position - b.position).norm() < 1e-12);
  }
}

TEST_CASE("spin follows the string that passes: its sign and its rate") {
  // A pull of the right hand lengthens the right strand: the axle's surface under the string moves to the
  // right.
  for (const Preset preset : kPresets) {
    Numbers parameters = preset();
    if (preset == kPresets[0]) parameters.spin_coupling = 20.0;
    const Predictor<double> predictor(parameters);
    const double speed = 0.5;
    const auto tips_at = [&](double t) {
      Tips<double> tips = level(0.3);
      tips.left.z() -= speed * t;
      tips.right.z() += speed * t;
      tips.left_velocity.z() = -speed;
      tips.right_velocity.z() = speed;
      return tips;
    };
    const Spheroid<double> s = spheroid_of(tips_at(0.0), parameters.string_length);
    State<double> state = at_rest(s.center() - Vector(0.0, 0.0, s.semi_minor()), kOn);
    for (int k = 0; k < 200; ++k) predictor.step(state, tips_at(k * kStep), tips_at((k + 1) * kStep), kStep);
    CHECK(state.spin > 1e-3);
  }
}

TEST_CASE("the pull damping, the caps and the thin rule act through the step") {
  // Tips that jump up by 2 mm within a step under a diabolo that hangs: the cap is 2 m/s * 0.13, the velocity
  // gained 0.07 of the smaller of pull and cap.
  for (const Preset preset : kPullPresets) {
    Numbers parameters = preset();
    parameters.dissipation_rate = 0.0;
    const Predictor<double> predictor(parameters);
    Tips<double> begin = level(0.3), end = level(0.3);
    end.left.z() += 2e-3;
    end.right.z() += 2e-3;
    const Spheroid<double> s = spheroid_of(begin, parameters.string_length);
    State<double> state = at_rest(s.center() - Vector(0.0, 0.0, s.semi_minor()), kOn);
    predictor.step(state, begin, end, kStep);
    const double pull = std::min(0.13 * 2.0, 0.13 * 2.0 + 0.13 * 0.5 * 9.8 * kStep);
    const double by_gravity = -9.8 * kStep;
    CHECK(state.velocity.z() == Approx(by_gravity + 0.07 * pull).epsilon(1e-3).margin(1e-5));
  }
}

TEST_CASE("lanes go their own ways, with the bits of scalars") {
  using P = Pack<double, 4>;
  for (const Preset preset : kPresets) {
    Random random(504);
    for (int episode = 0; episode < 20; ++episode) {
      Parameters<P> packed;
      packed.copy_rules(preset());
      Numbers scalars[4];
      for (int lane = 0; lane < 4; ++lane) {
        scalars[lane] = preset();
        scalars[lane].string_length *= random.uniform(0.9, 1.1);
        if (lane == 2) scalars[lane].dissipation_rate = 0.0;
      }
      // The same fields in the same order.
      double values[4][32];
      for (int lane = 0; lane < 4; ++lane) {
        int i = 0;
        Numbers::for_each(scalars[lane],
                          [&](const ParameterInfo&, double& field) { values[lane][i++] = field; });
      }
      int i = 0;
      Parameters<P>::for_each(packed, [&](const ParameterInfo&, P& field) {
        for (int lane = 0; lane < 4; ++lane) field.set(lane, values[lane][i]);
        ++i;
      });
      const Predictor<P> together(packed);
      SmoothTips players[4];
      State<double> states[4];
      State<P> state;
      for (int lane = 0; lane < 4; ++lane) {
        players[lane] = SmoothTips::random(random, random.uniform(0.1, 1.3), 0.2, 12.0);
        const Tips<double> begin = players[lane].at(0.0);
        states[lane].position = random.reachable({begin.left, begin.right, scalars[lane].string_length});
        states[lane].velocity = random.vector(3.0);
        states[lane].string_state = static_cast<StringState>(random.index(3));
        for (int k = 0; k < 3; ++k) {
          state.position[k].set(lane, states[lane].position[k]);
          state.velocity[k].set(lane, states[lane].velocity[k]);
        }
        state.string_state.code.set(lane, static_cast<double>(states[lane].string_state));
      }
      const auto gather = [&](double time) {
        Tips<P> tips;
        for (int lane = 0; lane < 4; ++lane) {
          const Tips<double> one = players[lane].at(time);
          for (int k = 0; k < 3; ++k) {
            tips.left[k].set(lane, one.left[k]);
            tips.right[k].set(lane, one.right[k]);
            tips.left_velocity[k].set(lane, one.left_velocity[k]);
            tips.right_velocity[k].set(lane, one.right_velocity[k]);
          }
        }
        return tips;
      };
      bool same = true;
      for (int step = 0; step < 200; ++step) {
        const StepStatus<P> status =
            together.step(state, gather(step * kStep), gather((step + 1) * kStep), P(kStep));
        for (int lane = 0; lane < 4; ++lane) {
          const StepStatus<double> alone = Predictor<double>(scalars[lane])
                                               .step(states[lane], players[lane].at(step * kStep),
                                                     players[lane].at((step + 1) * kStep), kStep);
          for (int k = 0; k < 3; ++k)
            same = same && state.position[k][lane] == states[lane].position[k] &&
                   state.velocity[k][lane] == states[lane].velocity[k] &&
                   state.string_acceleration[k][lane] == states[lane].string_acceleration[k];
          same = same && state.spin[lane] == states[lane].spin &&
                 state.string_state.code[lane] == static_cast<double>(states[lane].string_state) &&
                 status.caught[lane] == alone.caught && status.snapped_taut[lane] == alone.snapped_taut &&
                 status.overstretched[lane] == alone.overstretched;
        }
      }
      CHECK(same);
    }
  }
}
