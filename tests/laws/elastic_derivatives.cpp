// SPDX-License-Identifier: MIT
// Derivatives of an elastic string's motion with respect to its compliance and damping, at amplitude zero
// too.

#include "catch.hpp"
#include "diabolo/effects/string_elasticity.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/predictor.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

/// Position after half a second from a start on the string.
template <class Scalar>
Vector3<Scalar> swing(const SmoothTips& player, const Vector& start, const Scalar& compliance,
                      const Scalar& damping) {
  EffectSet<Scalar, StringElasticity> effects;
  effects.template get<StringElasticity>().compliance_per_newton = compliance;
  effects.template get<StringElasticity>().damping = damping;
  const Predictor<Scalar, StringElasticity> predictor(Parameters<Scalar>::consistent(), effects);
  const auto cast = [](const Vector& v) { return Vector3<Scalar>(Scalar(v[0]), Scalar(v[1]), Scalar(v[2])); };
  const auto tips_at = [&](double t) {
    const Tips<double> tips = player.at(t);
    return Tips<Scalar>{cast(tips.left), cast(tips.right), cast(tips.left_velocity),
                        cast(tips.right_velocity)};
  };
  State<Scalar> state;
  state.position = cast(start);
  state.string_state = StringState::kOnString;
  for (int i = 0; i < 500; ++i)
    predictor.step(state, tips_at(i * 1e-3), tips_at((i + 1) * 1e-3), Scalar(1e-3));
  return state.position;
}

using D = Dual<double, 2>;

struct Play {
  SmoothTips player;
  Vector start;
};

Play random_play(Random& random) {
  Play play;
  play.player = SmoothTips::random(random, 0.4, 0.08, 6.0);
  const Tips<double> begin = play.player.at(0.0);
  const Spheroid<double> spheroid(begin.left, begin.right, 1.45);
  play.start = spheroid.closest_point(spheroid.center() + random.vector(0.2) - Vector(0.0, 0.0, 1.0));
  return play;
}

Vector gradient(const Vector3<D>& v, int index) {
  return {v[0].gradient[index], v[1].gradient[index], v[2].gradient[index]};
}

}  // namespace

TEST_CASE("a rigid string's derivative with respect to the compliance is not zero, and right") {
  Random random(920);
  for (int i = 0; i < 5; ++i) {
    const Play play = random_play(random);
    const Vector3<D> dual = swing<D>(play.player, play.start, D::variable(0.0, 0), D(0.0));
    const double h = 1e-8;
    const Vector difference =
        (swing<double>(play.player, play.start, h, 0.0) - swing<double>(play.player, play.start, 0.0, 0.0)) /
        h;
    CHECK(difference.norm() > 0.1);
    // Positions solved to 1e-10 m or better, over 1e-8.
    CHECK((gradient(dual, 0) - difference).norm() < 1e-2 * difference.norm());
  }
}

TEST_CASE("derivatives with respect to compliance and damping of a string that stretches") {
  Random random(921);
  for (const double stiffness : {60.0, 400.0, 3000.0})
    for (int i = 0; i < 3; ++i) {
      const Play play = random_play(random);
      // Damped: undamped, a string that snaps bounces on and on, and every difference grows.
      const double compliance = 1.0 / stiffness, damping = 0.1 * std::sqrt(stiffness * 0.2845);
      const Vector3<D> dual =
          swing<D>(play.player, play.start, D::variable(compliance, 0), D::variable(damping, 1));
      const auto at = [&](double c, double d) { return swing<double>(play.player, play.start, c, d); };
      const double dc = 1e-5 * compliance, dd = 1e-4 * damping;
      const Vector by_compliance = (at(compliance + dc, damping) - at(compliance - dc, damping)) / (2.0 * dc);
      const Vector by_damping = (at(compliance, damping + dd) - at(compliance, damping - dd)) / (2.0 * dd);
      CAPTURE(stiffness, i);
      CHECK((gradient(dual, 0) - by_compliance).norm() < 2e-3 * by_compliance.norm() + 1e-10 / dc);
      CHECK((gradient(dual, 1) - by_damping).norm() < 2e-3 * by_damping.norm() + 1e-10 / dd);
    }
}
