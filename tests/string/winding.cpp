// SPDX-License-Identifier: MIT
#include "diabolo/string/winding.hpp"

#include "diabolo/math/dual.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

Numbers following(double wraps = 0.0) {
  Numbers numbers;
  numbers.wraps = wraps;
  numbers.follow_turns = true;
  return numbers;
}

/// Tips on circles around the diabolo at the origin, in the plane of the axle; angles from straight up,
/// positive to the left [rad].
Tips<double> tips_around(double left, double right, double radius = 0.7) {
  return {{0.0, radius * std::sin(left), radius * std::cos(left)},
          {0.0, radius * std::sin(right), radius * std::cos(right)}};
}

double angle_at(const State<double>& state, const Tips<double>& tips, const Numbers& numbers) {
  return wound_angle(state, StringPath<double>(state.position, tips), numbers);
}

/// Wound angle after the right tip has gone around the diabolo from `begin` to `end`, counted every 0.05 rad.
double after_circling(double begin, double end, double wraps = 0.0) {
  const Numbers numbers = following(wraps);
  State<double> state;
  double angle = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double right = begin + (end - begin) * i / 1000.0;
    angle = angle_at(state, tips_around(0.3, right), numbers);
    state.turns = angle / (2.0 * std::numbers::pi) - wraps;
  }
  return angle;
}

}  // namespace

TEST_CASE("a start without turns touches the axle over the angle between the strands") {
  const unsigned seed = 1501;
  CAPTURE(seed);
  Random random(seed);
  for (int trial = 0; trial < 100; ++trial) {
    const Tips<double> tips =
        tips_around(random.uniform(-M_PI, M_PI), random.uniform(-M_PI, M_PI), random.uniform(0.1, 1.0));
    const StringPath<double> path(Vector::Zero(), tips);
    CHECK(winding(State<double>(), path, following()).angle == Approx(contact_angle(path)));
    CHECK(winding(State<double>(), path, Numbers()).angle == contact_angle(path));
  }
}

TEST_CASE("a tip that circles around the diabolo winds the string on, and off the other way") {
  const double hanging = M_PI - 0.6;
  // Positive angles are to the left: the right tip that goes left over the left one crosses the strands.
  CHECK(after_circling(-0.3, 0.9) == Approx(hanging + 1.2));
  CHECK(after_circling(-0.3, -0.3 + 2.0 * M_PI) == Approx(hanging + 2.0 * M_PI));
  CHECK(after_circling(-0.3, -0.3 + 6.0 * M_PI) == Approx(hanging + 6.0 * M_PI));
  CHECK(after_circling(-0.3, -0.3 - 2.0 * M_PI) == Approx(hanging - 2.0 * M_PI));
  CHECK(after_circling(-0.3, -0.3 - 2.0 * M_PI, 1.0) == Approx(hanging));
  CHECK(after_circling(-0.3, -0.3 - 6.0 * M_PI, 1.0) == Approx(hanging - 4.0 * M_PI));
}

TEST_CASE("tips that turn around the diabolo together wind nothing on") {
  State<double> state;
  const Numbers numbers = following(1.0);
  for (int i = 0; i < 200; ++i) {
    const double angle = angle_at(state, tips_around(0.4 + 0.1 * i, -0.2 + 0.1 * i), numbers);
    CHECK(angle == Approx(3.0 * M_PI - 0.6));
    state.turns = angle / (2.0 * std::numbers::pi) - numbers.wraps;
  }
}

TEST_CASE("the angle is seen along the axle") {
  State<double> state;
  state.axis = Vector(0.8, 0.0, 0.6);
  const Tips<double> tips = tips_around(0.3, -0.4);
  const double angle = angle_at(state, tips, following());
  for (const double shift : {-0.5, 0.2}) {
    Tips<double> moved = tips;
    moved.left += state.axis * shift;
    CHECK(angle_at(state, moved, following()) == Approx(angle));
  }
}

TEST_CASE("mirrored, the string lies around the axle over the same angle on the same side") {
  const unsigned seed = 1502;
  CAPTURE(seed);
  Random random(seed);
  for (int trial = 0; trial < 50; ++trial) {
    const Tips<double> tips = tips_around(random.uniform(-M_PI, M_PI), random.uniform(-M_PI, M_PI));
    State<double> state;
    state.turns = random.uniform(-3.0, 3.0);
    CHECK(angle_at(state, mirrored(tips), following()) == Approx(angle_at(state, tips, following())));
  }
}

TEST_CASE("the angle has the derivatives of its strands") {
  using D = Dual<double, 1>;
  const Numbers numbers = following(1.0);
  State<double> state;
  state.turns = 0.3;
  const auto angle = [&](double y) {
    State<double> moved = state;
    moved.position.y() = y;
    return angle_at(moved, tips_around(0.4, -0.5), numbers);
  };
  State<D> dual = state_in<D>(state);
  dual.position.y().value = 0.1;
  dual.position.y().gradient[0] = 1.0;
  Tips<D> tips;
  tips.left = tips_around(0.4, -0.5).left.cast<D>();
  tips.right = tips_around(0.4, -0.5).right.cast<D>();
  const D found = wound_angle(dual, StringPath<D>(dual.position, tips), parameters_in<D>(numbers));
  CHECK(found.value == Approx(angle(0.1)));
  CHECK(found.gradient[0] == Approx((angle(0.1 + 1e-6) - angle(0.1 - 1e-6)) / 2e-6).epsilon(1e-8));
}

TEST_CASE("turns that are not followed neither change nor matter, bit for bit") {
  const unsigned seed = 1503;
  CAPTURE(seed);
  Random random(seed);
  Full::Set set;
  set.get<StringFriction>().coefficient = 0.2;
  set.get<FiniteAxle>().radius = 0.0073;
  const Full model(Numbers(), set);
  for (int trial = 0; trial < 10; ++trial) {
    const Scene scene = hanging_scene(random);
    State<double> plain = scene.start, told = scene.start;
    told.turns = 1.4;
    const auto at = [&](double t) { return scene.tips.at(t); };
    plain = run(model, plain, at, 0.3, 300);
    told = run(model, told, at, 0.3, 300);
    CHECK(same_bits(plain, told));
    CHECK(told.turns == 1.4);
  }
}

TEST_CASE("followed turns without a law that knows them change no bit of where play with open strands goes") {
  const unsigned seed = 1504;
  CAPTURE(seed);
  Random random(seed);
  for (int trial = 0; trial < 10; ++trial) {
    const Scene scene = hanging_scene(random);
    const auto at = [&](double t) { return scene.tips.at(t); };
    const State<double> followed = run(Predictor<double>(following()), scene.start, at, 0.3, 300);
    State<double> plain = run(Predictor<double>(Numbers()), scene.start, at, 0.3, 300);
    // What has passed is measured once more, to the last bit of the place: the spin follows it.
    CHECK(followed.spin == Approx(plain.spin).epsilon(1e-6));
    plain.spin = followed.spin;
    CHECK(same_bits(followed, plain));
    CHECK(followed.turns ==
          Approx(contact_angle(StringPath<double>(followed.position, at(0.3))) / (2.0 * M_PI)).epsilon(1e-2));
  }
}

TEST_CASE("the paper's string has no turns to follow") {
  Numbers numbers = Numbers::paper();
  numbers.follow_turns = true;
  CHECK_THROWS_WITH(Predictor<double>(numbers),
                    "follow_turns: true under the string law 'pull_velocity'; expected 'inextensible'");
}
