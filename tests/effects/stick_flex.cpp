// SPDX-License-Identifier: MIT
#include "diabolo/effects/stick_flex.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

Full bending(double compliance, double damping = 0.0) {
  return full<StickFlex>([&](auto& flex) {
    flex.compliance = compliance;
    flex.damping = damping;
  });
}

Tips<double> pointing(const Vector& left, const Vector& right) {
  Tips<double> tips;
  tips.left = Vector(0.0, 0.3, 1.2);
  tips.right = Vector(0.0, -0.25, 1.25);
  tips.left_direction = left.normalized();
  tips.right_direction = right.normalized();
  return tips;
}

/// After twenty seconds with some damping.
State<double> rested(const Full& model, const Tips<double>& tips) {
  State<double> state;
  state.position = Vector(0.0, 0.02, 0.6);
  Numbers numbers = model.parameters();
  numbers.dissipation_rate = 2.0;
  const Full damped(numbers, model.effects());
  for (int k = 0; k < 20000; ++k) damped.step(state, tips, tips, 1e-3);
  return state;
}

}  // namespace

TEST_CASE("sticks that do not bend change no bit") {
  const unsigned seed = 1010;
  CAPTURE(seed);
  Full::Set set;
  set.get<StickFlex>().damping = 3.0;
  CHECK(differing_steps(set, seed) == 0);
  set.get<StickFlex>().compliance = 1e-5;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("sticks of unknown direction are a string of twice their compliance") {
  const unsigned seed = 1011;
  CAPTURE(seed);
  Random random(seed);
  const Full string =
      full<StringElasticity>([](auto& elasticity) { elasticity = elasticity.of_stiffness(100.0, 1.5); });
  const Full sticks = bending(1.0 / 200.0, 3.0);
  for (int episode = 0; episode < 10; ++episode) {
    const Scene scene = hanging_scene(random);
    const auto tips = [&](double time) { return scene.tips.at(time); };
    CHECK(difference(run(string, scene.start, tips, 1.0, 1000), run(sticks, scene.start, tips, 1.0, 1000)) <
          1e-9);
    CHECK(difference(run(Full(Numbers()), scene.start, tips, 1.0, 1000),
                     run(sticks, scene.start, tips, 1.0, 1000)) > 1e-3);
  }
}

TEST_CASE("a diabolo at rest hangs from tips that its weight has bent") {
  const Tips<double> tips = pointing(Vector(1.0, 0.8, 0.1), Vector(1.0, -0.3, 0.6));
  const double compliance = 1.0 / 70.0, mass = Numbers().mass;
  const State<double> state = rested(bending(compliance), tips);
  CHECK(state.velocity.norm() < 1e-6);
  // From the statics of bent tips: the pull is the same in both strands and their sum carries the weight.
  Tips<double> bent = tips;
  double pull = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vector left = (state.position - bent.left).normalized(),
                 right = (state.position - bent.right).normalized();
    pull = mass * kStandardGravity / (left + right).norm();
    const auto square = [](const Vector& v, const Vector& stick) { return Vector(v - stick * stick.dot(v)); };
    bent.left = tips.left + square(left, tips.left_direction) * (pull * compliance);
    bent.right = tips.right + square(right, tips.right_direction) * (pull * compliance);
  }
  const StringPath<double> path(state.position, bent);
  CHECK(path.length() == Approx(Numbers().string_length).margin(1e-5));
  const Vector sum = path.gradient() * pull;
  CHECK((sum + Vector(0.0, 0.0, mass * kStandardGravity)).norm() < 1e-4 * mass * kStandardGravity);
  CHECK((state.position - rested(Full(Numbers()), tips).position).norm() > 0.5 * pull * compliance);
}

TEST_CASE("sticks in line with their strands do not give") {
  // The strands of a diabolo at rest, found without bending.
  Tips<double> tips = pointing(Vector::UnitX(), Vector::UnitX());
  const State<double> rigid = rested(Full(Numbers()), tips);
  tips.left_direction = (tips.left - rigid.position).normalized();
  tips.right_direction = (tips.right - rigid.position).normalized();
  CHECK((rested(bending(1.0 / 100.0), tips).position - rigid.position).norm() < 1e-6);
}

TEST_CASE("sticks that bend keep the energy of a swing, and lose it by their damping alone") {
  const Tips<double> tips = pointing(Vector(1.0, 0.0, 0.0), Vector(1.0, 0.0, 0.0));
  const double compliance = 1.0 / 200.0;
  const auto energy = [&](const State<double>& state) {
    const double stretch = StringPath<double>(state.position, tips).length() - Numbers().string_length;
    const double elastic = 0.5 * stretch * stretch / (2.0 * compliance) / Numbers().mass;
    return 0.5 * state.velocity.squaredNorm() + kStandardGravity * state.position.z() + elastic;
  };
  const auto lost = [&](double damping) {
    const Full model = bending(compliance, damping);
    State<double> state;
    state.position = Vector(0.0, 0.1, 0.58);  // just slack: the fall makes the sticks swing
    const auto taut = [&] {
      return StringPath<double>(state.position, tips).length() > Numbers().string_length;
    };
    while (!taut()) model.step(state, tips, tips, 1e-4);
    const double before = energy(state);
    for (int k = 0; k < 10000 || !taut(); ++k) model.step(state, tips, tips, 1e-4);
    return before - energy(state);
  };
  CAPTURE(lost(0.0), lost(2.0));
  CHECK(std::abs(lost(0.0)) < 2e-3);
  CHECK(lost(2.0) > 2e-2);
}

namespace {

/// Period of a small bounce on sticks across the strands [s], in so many steps a second.
double bounce_period(double tip_mass, double steps_per_second) {
  const Full model = full<StickFlex>([&](auto& flex) {
    flex.compliance = 1.0 / 300.0;
    flex.tip_mass = tip_mass;
  });
  Tips<double> tips = pointing(Vector::UnitX(), Vector::UnitX());
  tips.left.z() = tips.right.z() = 1.2;
  tips.left.y() = 0.3, tips.right.y() = -0.3;
  State<double> state = rested(model, tips);
  state.velocity.z() = -0.03;
  std::vector<double> upwards;  // when it turns from falling to rising
  for (int k = 1; upwards.size() < 11; ++k) {
    const double before = state.velocity.z();
    model.step(state, tips, tips, 1.0 / steps_per_second);
    const double now = state.velocity.z();
    if (before < 0.0 && now >= 0.0) upwards.push_back((k - now / (now - before)) / steps_per_second);
  }
  return (upwards.back() - upwards.front()) / 10.0;
}

}  // namespace

TEST_CASE("the mass of the tips makes a bounce slower, as a mass beside the diabolo's would") {
  // A path that grows by s moves the diabolo by s / g and each tip by s / 2: of M / g^2 and m / 2 the one is
  // added to the other, while the stiffness stays.
  Tips<double> tips = pointing(Vector::UnitX(), Vector::UnitX());
  tips.left.z() = tips.right.z() = 1.2;
  tips.left.y() = 0.3, tips.right.y() = -0.3;
  const double square =
      StringPath<double>(rested(bending(1.0 / 300.0), tips).position, tips).gradient().squaredNorm();
  const double tip_mass = 0.02, slower = std::sqrt(1.0 + 0.5 * tip_mass * square / Numbers().mass);
  const double fine = bounce_period(tip_mass, 16000.0) / bounce_period(0.0, 16000.0),
               coarse = bounce_period(tip_mass, 2000.0) / bounce_period(0.0, 2000.0);
  CAPTURE(slower, fine, coarse);
  CHECK(slower > 1.05);
  CHECK(fine == Approx(slower).epsilon(1e-3));
  CHECK(std::abs(fine - slower) < 0.3 * std::abs(coarse - slower) + 1e-5);
  CHECK(bounce_period(tip_mass, 240.0) / bounce_period(0.0, 240.0) == Approx(slower).epsilon(2e-3));
}

TEST_CASE(
    "tips with mass hang by their own weight lower, and where nothing bends their mass changes nothing") {
  const Tips<double> tips = pointing(Vector(1.0, 0.8, 0.1), Vector(1.0, -0.3, 0.6));
  const auto lowered = [&tips](double by) {
    const auto down = [by](const Vector& stick) {
      return Vector(by * (stick * stick.z() - Vector::UnitZ()));
    };
    Tips<double> low = tips;
    low.left += down(tips.left_direction);
    low.right += down(tips.right_direction);
    return low;
  };
  const auto massive = [](double compliance) {
    return full<StickFlex>([&](auto& flex) {
      flex.compliance = compliance;
      flex.tip_mass = 0.012;
    });
  };
  const double by = 0.012 * kStandardGravity / 250.0;
  CHECK((rested(massive(1.0 / 250.0), tips).position - rested(bending(1.0 / 250.0), lowered(by)).position)
            .norm() < 1e-6);
  // The stiffer, the nearer to no bending at all.
  Random random(1012);
  const Scene scene = hanging_scene(random);
  const auto moving = [&](double time) { return scene.tips.at(time); };
  const State<double> rigid = run(Full(Numbers()), scene.start, moving, 0.5, 500);
  const double stiff = apart(run(massive(1e-7), scene.start, moving, 0.5, 500), rigid),
               stiffer = apart(run(massive(1e-9), scene.start, moving, 0.5, 500), rigid);
  CAPTURE(stiff, stiffer);
  CHECK(stiff < 1e-3);
  CHECK(stiffer < 0.1 * stiff);
}

TEST_CASE("tips with mass keep the energy of a bounce") {
  const Tips<double> tips = pointing(Vector::UnitX(), Vector::UnitX());
  const double compliance = 1.0 / 200.0, tip_mass = 0.012;
  const Full model = full<StickFlex>([&](auto& flex) {
    flex.compliance = compliance;
    flex.tip_mass = tip_mass;
  });
  Tips<double> hanging = tips;  // under their own weight
  hanging.left.z() -= tip_mass * kStandardGravity * compliance;
  hanging.right.z() -= tip_mass * kStandardGravity * compliance;
  const auto energy = [&](const State<double>& state) {
    const StringPath<double> path(state.position, hanging);
    const double stretch = path.length() - Numbers().string_length,
                 rate = path.gradient().dot(state.velocity);
    return 0.5 * state.velocity.squaredNorm() + kStandardGravity * state.position.z() +
           (0.5 * stretch * stretch / (2.0 * compliance) + 0.25 * tip_mass * rate * rate) / Numbers().mass;
  };
  const auto drift = [&](double speed, double dt) {
    State<double> state = rested(model, tips);
    state.velocity.z() = -speed;
    const double before = energy(state);
    double most = 0.0;
    for (int k = 0; k < std::lround(2.0 / dt); ++k) {
      model.step(state, tips, tips, dt);
      most = std::max(most, std::abs(energy(state) - before));
    }
    return most;
  };
  CHECK(drift(0.3, 1e-4) < 1e-3);  // the string comes slack for a moment
  const double coarse = drift(0.25, 4e-4), fine = drift(0.25, 1e-4);
  CAPTURE(coarse, fine);
  CHECK(fine < 1e-4);
  CHECK(fine < 0.1 * coarse);
}

TEST_CASE("a catch shares the rate of the path with tips that were at rest, and loses no more") {
  const double compliance = 1.0 / 200.0, tip_mass = 0.02, mass = Numbers().mass;
  Tips<double> tips = pointing(Vector::UnitX(), Vector::UnitX());
  tips.left.z() = tips.right.z() = 1.2;
  tips.left.y() = 0.3, tips.right.y() = -0.3;
  const Full model = full<StickFlex>([&](auto& flex) {
    flex.compliance = compliance;
    flex.tip_mass = tip_mass;
  });
  State<double> state;
  state.position = Vector(0.0, 0.0, 1.2 - std::sqrt(0.25 * std::pow(Numbers().string_length, 2) - 0.09));
  state.position.z() += 1e-4 - tip_mass * kStandardGravity * compliance;
  state.velocity.z() = -1.5;
  state.string_state = StringState::kLoose;
  const Vector gradient = StringPath<double>(state.position, tips).gradient();
  const double before = gradient.dot(state.velocity);
  model.step(state, tips, tips, 1.2e-4);
  const double inertia = 0.5 * tip_mass * gradient.squaredNorm() / mass;
  CHECK(inertia > 0.1);
  CHECK(gradient.dot(state.velocity) == Approx(before / (1.0 + inertia)).epsilon(5e-3));
}

TEST_CASE("mirrored with their sticks, bending tips act as before") {
  const Full model = bending(1.0 / 150.0, 1.0);
  const Vector flip(1.0, -1.0, 1.0);
  const Tips<double> tips = pointing(Vector(1.0, 0.8, 0.1), Vector(1.0, -0.3, 0.6));
  Tips<double> mirror;
  mirror.left = tips.right.cwiseProduct(flip);
  mirror.right = tips.left.cwiseProduct(flip);
  mirror.left_direction = tips.right_direction.cwiseProduct(flip);
  mirror.right_direction = tips.left_direction.cwiseProduct(flip);
  State<double> a;
  a.position = Vector(0.05, 0.1, 0.55);
  a.velocity = Vector(0.3, 0.2, 0.0);
  State<double> b = a;
  b.position = a.position.cwiseProduct(flip);
  b.velocity = a.velocity.cwiseProduct(flip);
  for (int k = 0; k < 2000; ++k) {
    model.step(a, tips, tips, 1e-3);
    model.step(b, mirror, mirror, 1e-3);
  }
  CHECK((a.position.cwiseProduct(flip) - b.position).norm() < 1e-9);
  CHECK(a.position.allFinite());
}

TEST_CASE("a motion goes on from its whole state; without the string's pull, off by a step of it") {
  const Full model = bending(1.0 / 60.0);
  const auto tips = [](double t) {
    Tips<double> swung = pointing({1.0, 0.3, 0.3}, {1.0, -0.3, 0.3});
    const Vector swing(0.0, 0.1, 0.0);
    swung.left += swing * std::sin(5.0 * t);
    swung.right += swing * std::sin(5.0 * t);
    swung.left_velocity = swung.right_velocity = swing * 5.0 * std::cos(5.0 * t);
    return swung;
  };
  const auto later = [&](double t) { return tips(t + 0.5); };
  const auto off = [&](int count) {
    const State<double> start = rested(model, tips(0.0));
    const State<double> half = run(model, start, tips, 0.5, count);
    State<double> forgetful = half;
    forgetful.string_acceleration.setZero();
    const State<double> whole = run(model, start, tips, 1.0, 2 * count);
    CHECK(apart(run(model, half, later, 0.5, count), whole) < 1e-9);  // times round otherwise
    return apart(run(model, forgetful, later, 0.5, count), whole);
  };
  const double coarse = off(500), fine = off(2000);
  CHECK(coarse < 2e-4);
  CHECK(coarse / fine == Approx(4.0).epsilon(0.1));
}
