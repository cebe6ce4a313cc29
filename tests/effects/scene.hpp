// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "catch.hpp"
#include "diabolo/full_predictor.hpp"
#include "smooth_tips.hpp"

/// What the tests of single effects have in common: scenes, runs, and the laws that hold for every effect.
namespace effect_scene {

using namespace diabolo;
using Vector = Vector3<double>;
using Numbers = Parameters<double>;
using Full = FullPredictor<double>;

/// A full model with one effect set up by `change(effect)`.
template <template <class> class Effect, class Change>
Full full(Change&& change, const Numbers& parameters = {}) {
  Full::Set set;
  change(set.template get<Effect>());
  return Full(parameters, set);
}

/// Tips at rest at a height of 1 m, so far apart.
inline Tips<double> level(double distance) {
  return {{0.0, 0.5 * distance, 1.0}, {0.0, -0.5 * distance, 1.0}};
}

inline Numbers weightless() {
  Numbers parameters;
  parameters.gravity = 0.0;
  return parameters;
}

struct Scene {
  SmoothTips tips;
  State<double> start;
};

/// Tips that move, and a diabolo that hangs on the string between them, moves and spins.
inline Scene hanging_scene(Random& random, double length = 1.45) {
  Scene scene;
  scene.tips = SmoothTips::random(random, random.uniform(0.3, 0.8), 0.06, 6.0);
  const Tips<double> begin = scene.tips.at(0.0);
  const Spheroid<double> spheroid(begin.left, begin.right, length);
  TautReference taut;
  taut.tips = scene.tips;
  taut.position = spheroid.closest_point(spheroid.center() + random.vector(0.2) - Vector(0.0, 0.0, 1.0));
  taut.velocity = random.vector(0.5);
  taut.make_consistent();
  scene.start.position = taut.position;
  scene.start.velocity = taut.velocity;
  scene.start.spin = random.uniform(40.0, 120.0) * (random.chance(0.5) ? 1.0 : -1.0);
  scene.start.axis = (Vector::UnitX() + random.vector(0.1)).normalized();
  scene.start.string_state = StringState::kOnString;
  return scene;
}

/// High above the string, so that nothing but gravity and air acts.
inline State<double> flying(const Vector& velocity, double spin = 0.0) {
  State<double> state;
  state.position = Vector(0.0, 0.0, 100.0);
  state.velocity = velocity;
  state.spin = spin;
  state.string_state = StringState::kFlying;
  return state;
}

/// The state after `duration` [s] in `count` steps under tips given as a function of time.
template <class Model, class TipsAt>
State<double> run(const Model& model, State<double> state, TipsAt&& tips, double duration, int count) {
  for (int i = 0; i < count; ++i)
    model.step(state, tips(i * duration / count), tips((i + 1) * duration / count), duration / count);
  return state;
}

/// The same with both tips at rest where they are by default; for flights.
template <class Model>
State<double> fly(const Model& model, const State<double>& state, double duration, int count) {
  return run(
      model, state, [](double) { return Tips<double>(); }, duration, count);
}

inline bool same_bits(const State<double>& a, const State<double>& b) {
  return a.position == b.position && a.velocity == b.velocity && a.spin == b.spin && a.axis == b.axis &&
         a.tumble == b.tumble && a.string_state == b.string_state &&
         a.string_acceleration == b.string_acceleration;
}

/// Steps of random plays under every preset, in all string states, after which the full model with this set
/// and the predictor without effects differ in any bit.
inline int differing_steps(const Full::Set& set, unsigned seed) {
  Random random(seed);
  int differing = 0;
  for (const auto preset : {&Numbers::consistent, &Numbers::paper, &Numbers::published})
    for (int episode = 0; episode < 20; ++episode) {
      const Numbers parameters = preset();
      const Predictor<double> plain(parameters);
      const Full full_model(parameters, set);
      const SmoothTips player = SmoothTips::random(random, random.uniform(0.1, 1.44), 0.2, 12.0);
      const Tips<double> begin = player.at(0.0);
      State<double> a;
      a.position = random.reachable({begin.left, begin.right, parameters.string_length});
      a.velocity = random.vector(3.0);
      a.spin = random.uniform(-100.0, 100.0);
      a.string_state = static_cast<StringState>(random.index(3));
      State<double> b = a;
      for (int k = 0; k < 300; ++k) {
        plain.step(a, player.at(k * 1e-3), player.at((k + 1) * 1e-3), 1e-3);
        full_model.step(b, player.at(k * 1e-3), player.at((k + 1) * 1e-3), 1e-3);
        differing += !same_bits(a, b);
      }
    }
  return differing;
}

/// Whether the effect acts at all: the laws below would hold for one that does nothing.
inline double difference(const State<double>& a, const State<double>& b) {
  return (a.position - b.position).norm() + std::abs(a.spin - b.spin);
}

/// Left and right exchanged: y -> -y, the spin the other way round.
inline Vector mirrored(const Vector& v) { return {v.x(), -v.y(), v.z()}; }
inline Tips<double> mirrored(const Tips<double>& tips) {
  return {mirrored(tips.right), mirrored(tips.left), mirrored(tips.right_velocity),
          mirrored(tips.left_velocity)};
}
inline State<double> mirrored(State<double> state) {
  state.position = mirrored(state.position);
  state.velocity = mirrored(state.velocity);
  state.axis = mirrored(state.axis);
  state.tumble = -mirrored(state.tumble);  // as every angular velocity
  state.spin = -state.spin;
  return state;
}

/// Turned about the vertical, or any other way.
inline Tips<double> turned(const Tips<double>& tips, const Eigen::Matrix3d& turn) {
  return {turn * tips.left, turn * tips.right, turn * tips.left_velocity, turn * tips.right_velocity};
}
inline State<double> turned(State<double> state, const Eigen::Matrix3d& turn) {
  state.position = turn * state.position;
  state.velocity = turn * state.velocity;
  state.axis = turn * state.axis;
  state.tumble = turn * state.tumble;
  return state;
}
inline Eigen::Matrix3d about_vertical(double angle) {
  return Eigen::AngleAxisd(angle, Vector::UnitZ()).toRotationMatrix();
}

/// Half a second of hanging scenes, once as they are under `model` and once carried over by `tips` and
/// `state` under `carried`; the worst difference of the ends carried over. The two round differently, which
/// the motion lets grow: 1e-9 m and rad/s are 1e7 roundings.
template <class MoveTips, class MoveState>
double worst_of_symmetry(const Full& model, const Full& carried, MoveTips&& tips, MoveState&& state,
                         unsigned seed) {
  Random random(seed);
  double worst = 0.0;
  for (int episode = 0; episode < 20; ++episode) {
    const Scene scene = hanging_scene(random);
    const auto at = [&](double t) { return scene.tips.at(t); };
    const auto there = [&](double t) { return tips(scene.tips.at(t)); };
    const State<double> a = state(run(model, scene.start, at, 0.5, 500));
    const State<double> b = run(carried, state(scene.start), there, 0.5, 500);
    worst = std::max(worst, difference(a, b));
  }
  return worst;
}

/// Ratios of successive halvings of the step: distance of n to 2n steps over that of 2n to 4n. About 2 to
/// the power of the order.
template <class Distance>
double halving_ratio(const Full& model, const Scene& scene, int count, Distance&& distance,
                     double duration = 0.5) {
  const auto at = [&](double t) { return scene.tips.at(t); };
  const State<double> a = run(model, scene.start, at, duration, count),
                      b = run(model, scene.start, at, duration, 2 * count),
                      c = run(model, scene.start, at, duration, 4 * count);
  return distance(a, b) / distance(b, c);
}

inline double apart(const State<double>& a, const State<double>& b) {
  return (a.position - b.position).norm();
}

}  // namespace effect_scene
