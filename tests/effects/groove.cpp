// SPDX-License-Identifier: MIT
#include "diabolo/effects/groove.hpp"

#include "diabolo/math/pack.hpp"
#include "diabolo/string/hanging.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

constexpr double kProfile = 0.006, kWidth = 0.003;

Full grooved(double profile, double width, double brake = 0.0, double gain = 0.0) {
  Numbers parameters;
  parameters.spin_coupling = 0.0;
  Full::Set set;
  set.get<Groove>().profile_radius = profile;
  set.get<Groove>().half_width = width;
  set.get<Groove>().flank_brake = brake;
  set.get<GyroscopicTilt>().gain = gain;
  return Full(parameters, set);
}

/// Where the string lies on an axle that is tilted so far [rad] and hangs on it.
double climbed(double tilt) { return std::min(kWidth, std::max(-kWidth, kProfile * std::sin(tilt))); }

/// Hangs between level tips, the axle tilted so far [rad].
State<double> leaning(const Tips<double>& tips, double tilt, double spin = 100.0) {
  State<double> state = hanging_state(tips.left, tips.right, 1.45, spin);
  state.axis = {std::cos(tilt), 0.0, std::sin(tilt)};
  state.position -= state.axis * climbed(tilt);
  return state;
}

State<double> held_for(const Full& model, const State<double>& start, const Tips<double>& tips,
                       double duration) {
  return run(
      model, start, [&](double) { return tips; }, duration, static_cast<int>(1000 * duration));
}

}  // namespace

TEST_CASE("a groove without width or without a bottom changes no bit") {
  const unsigned seed = 820;
  CAPTURE(seed);
  Full::Set set;
  set.get<Groove>().profile_radius = kProfile;
  CHECK(differing_steps(set, seed) == 0);
  set.get<Groove>().half_width = kWidth;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("the string climbs to where the groove is square to its pull, and no farther than its edge") {
  const Tips<double> tips = level(0.6);
  for (const double tilt : {0.1, -0.2, 0.3, 0.6}) {
    CAPTURE(tilt);
    const State<double> start = leaning(tips, tilt);
    const State<double> end = held_for(grooved(kProfile, kWidth), start, tips, 2.0);
    // It stays where the strands meet at the climbed place, under the middle of the tips.
    CHECK((end.position - start.position).norm() < 3e-5);
    CHECK(end.velocity.norm() < 1e-4);
    CHECK(std::abs(climbed(tilt)) > 5e-4);
  }
}

TEST_CASE("a string on the flank yaws the axle as its levers say") {
  const Tips<double> tips = level(0.6);
  const double gain = 3.5, spin = 120.0, tilt = 0.2, dt = 1e-4;
  const Full model = grooved(kProfile, kWidth, 0.0, gain);
  State<double> state = held_for(grooved(kProfile, kWidth), leaning(tips, tilt, spin), tips, 1.0);
  const Vector axle = state.axis;
  model.step(state, tips, tips, dt);
  // By cross products, from where the strands leave the axle; each has the same part of the weight.
  const double z = climbed(tilt) / model.parameters().axle_radius;
  const Vector contact = state.position + axle * climbed(tilt), left = (tips.left - contact).normalized(),
               right = (tips.right - contact).normalized();
  const double pull = kStandardGravity / (left + right).norm();
  const auto torque = [&](const Vector& strand, const Vector& side) -> Vector {
    Vector normal = axle.cross(strand).normalized();
    if (normal.dot(side) < 0.0) normal = -normal;
    return (z * axle + normal).cross(pull * strand);
  };
  Vector total = torque(left, Vector::UnitY()) + torque(right, -Vector::UnitY());
  total -= axle * axle.dot(total);
  const Vector expected = -gain / spin * total, rate = (state.axis - axle) / dt;
  CHECK((rate - expected).norm() < 0.02 * expected.norm());
  CHECK(std::abs(rate.y()) > 100.0 * std::abs(rate.z()));
}

TEST_CASE("beyond the edge the string brakes the spin, either way round, and never turns it") {
  const Tips<double> tips = level(0.6);
  const double brake = 0.5, tilt = 0.8;
  for (const double spin : {60.0, -60.0}) {
    const Full model = grooved(kProfile, kWidth, brake);
    const State<double> end = held_for(model, leaning(tips, tilt, spin), tips, 0.5);
    const double lost = brake * kStandardGravity * std::sin(tilt) * 0.5;
    CHECK(std::abs(spin) - std::abs(end.spin) == Approx(lost).epsilon(0.02));
    CHECK(end.spin * spin > 0.0);
  }
  const State<double> within =
      held_for(grooved(kProfile, kWidth, brake), leaning(tips, 0.1, 60.0), tips, 0.5);
  CHECK(within.spin == 60.0);
  const State<double> slow = held_for(grooved(kProfile, kWidth, 50.0), leaning(tips, tilt, 3.0), tips, 2.0);
  CHECK(std::abs(slow.spin) < 1e-12);
}

TEST_CASE("a lane without a groove is as it is alone beside one that has it") {
  using P = Pack<double, 4>;
  const Tips<double> tips = level(0.6);
  const State<double> start = leaning(tips, 0.8, 60.0);
  const Full with = grooved(kProfile, kWidth, 5.0), without = grooved(kProfile, 0.0, 5.0);
  State<P> state = state_in<P>(start);
  FullPredictor<P>::Set set;
  for (int lane = 0; lane < 4; ++lane) {
    const auto& from = (lane % 2 ? with : without).effects().get<Groove>();
    set.get<Groove>().profile_radius.set(lane, from.profile_radius);
    set.get<Groove>().half_width.set(lane, from.half_width);
    set.get<Groove>().flank_brake.set(lane, from.flank_brake);
  }
  const FullPredictor<P> packed(parameters_in<P>(with.parameters()), set, FullPredictor<P>::AlreadyValid{});
  Tips<P> wide;
  for (int k = 0; k < 3; ++k) {
    wide.left[k] = P(tips.left[k]);
    wide.right[k] = P(tips.right[k]);
  }
  for (int i = 0; i < 300; ++i) packed.step(state, wide, wide, P(1e-3));
  const double alone[] = {held_for(without, start, tips, 0.3).spin, held_for(with, start, tips, 0.3).spin};
  for (int lane = 0; lane < 4; ++lane) CHECK(state.spin[lane] == Approx(alone[lane % 2]).epsilon(1e-9));
  CHECK(alone[0] - alone[1] > 1.0);
}

TEST_CASE("a groove is the same in a mirror, turned, and as the step goes to zero") {
  const unsigned seed = 821;
  CAPTURE(seed);
  const Full model = grooved(kProfile, kWidth, 0.3, 3.5);
  const auto mirror_tips = [](const Tips<double>& tips) { return mirrored(tips); };
  const auto mirror_state = [](const State<double>& state) { return mirrored(state); };
  CHECK(worst_of_symmetry(model, model, mirror_tips, mirror_state, seed) < 1e-9);
  const Eigen::Matrix3d turn = about_vertical(0.9);
  CHECK(worst_of_symmetry(
            model, model, [&](const Tips<double>& tips) { return turned(tips, turn); },
            [&](const State<double>& state) { return turned(state, turn); }, seed) < 1e-9);
  Random random(seed);
  const Scene scene = hanging_scene(random);
  CHECK(halving_ratio(model, scene, 250, apart) > 1.8);
}
