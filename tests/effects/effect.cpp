// SPDX-License-Identifier: MIT
#include "diabolo/effects/effect.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "diabolo/effects/all.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "diabolo/predictor.hpp"
#include "random.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

// One effect for each hook, as anyone might write it.

template <class Scalar>
struct Wind : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "wind";
  Scalar push{0};  ///< along x [m/s^2]
  Vector3<Scalar> acceleration(const State<Scalar>&, const Tips<Scalar>&, const Scalar&,
                               const Parameters<Scalar>&) const {
    return {push, Scalar(0), Scalar(0)};
  }
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"push", "m/s^2", -5.0, 5.0, "wind along x"}, self.push);
  }
};

template <class Scalar>
struct TipOffset : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "tip_offset";
  Scalar height{0};  ///< of both real tips above the given ones [m]
  bool neutral() const { return is_constant_zero(height); }
  TipShift<Scalar> tip_shift(const State<Scalar>&, const Tips<Scalar>&, const Parameters<Scalar>&) const {
    TipShift<Scalar> shift;
    shift.left[2] = shift.right[2] = height;
    return shift;
  }
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"height", "m", -1.0, 1.0, "offset of the tips"}, self.height);
  }
};

/// Takes a share of the velocity while the string is taut.
template <class Scalar>
struct Brake : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "brake";
  Scalar rate{0};  ///< [1/s]
  Contact<Scalar> contact(const State<Scalar>& state, const Tips<Scalar>&,
                          const StringStepResult<Scalar>& result, const Scalar& dt, const Parameters<Scalar>&,
                          const Scalar&) const {
    return {state.velocity * select(result.taut, Scalar(-rate * dt), Scalar(0)), Scalar(0)};
  }
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"rate", "1/s", 0.0, 10.0, "decay of the velocity"}, self.rate);
  }
};

template <class Scalar>
struct SpinDrag : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "spin_drag";
  Scalar deceleration{0};  ///< [rad/s^2]
  Scalar spin_acceleration(const Scalar&, const State<Scalar>&, const Tips<Scalar>&, const Scalar&,
                           const Parameters<Scalar>&) const {
    return -deceleration;
  }
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"deceleration", "rad/s^2", 0.0, 100.0, "of the spin"}, self.deceleration);
  }
};

using Numbers = Parameters<double>;

constexpr auto kPresets = {&Numbers::consistent, &Numbers::paper, &Numbers::published};

/// States at the end of a play of one second under each of some draws of start and tips.
template <class Predict>
std::vector<State<double>> play(const Predict& predictor, unsigned seed = 800) {
  std::vector<State<double>> states;
  Random random(seed);
  for (int episode = 0; episode < 10; ++episode) {
    const SmoothTips player = SmoothTips::random(random, random.uniform(0.1, 1.2), 0.15, 8.0);
    const Tips<double> begin = player.at(0.0);
    State<double> state;
    state.position = random.reachable({begin.left, begin.right, 1.4}) - Vector(0.0, 0.0, 0.1);
    state.velocity = random.vector(1.0);
    state.spin = 100.0;
    for (int k = 0; k < 500; ++k) predictor.step(state, player.at(k * 1e-3), player.at((k + 1) * 1e-3), 1e-3);
    states.push_back(state);
  }
  return states;
}

double difference(const std::vector<State<double>>& a, const std::vector<State<double>>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max({worst, (a[i].position - b[i].position).norm(), (a[i].velocity - b[i].velocity).norm(),
                      std::abs(a[i].spin - b[i].spin), a[i].string_state == b[i].string_state ? 0.0 : 1.0});
  return worst;
}

template <class Set>
void turn_on(Set& set) {
  set.template get<Wind>().push = 1.5;
  set.template get<TipOffset>().height = 0.03;
  set.template get<Brake>().rate = 0.5;
  set.template get<SpinDrag>().deceleration = 20.0;
}

}  // namespace

TEST_CASE("effects of amplitude zero change no bit, under any preset") {
  for (const auto preset : kPresets) {
    const Numbers parameters = preset();
    const auto plain = play(Predictor<double>(parameters));
    CHECK(difference(play(Predictor<double, Wind>(parameters)), plain) == 0.0);
    CHECK(difference(play(Predictor<double, TipOffset>(parameters)), plain) == 0.0);
    CHECK(difference(play(Predictor<double, Brake>(parameters)), plain) == 0.0);
    CHECK(difference(play(Predictor<double, SpinDrag>(parameters)), plain) == 0.0);
    CHECK(difference(play(Predictor<double, Wind, TipOffset, Brake, SpinDrag, StringElasticity>(parameters)),
                     plain) == 0.0);
  }
}

TEST_CASE("wind blows a flying diabolo along a parabola and hangs a caught one aslant") {
  for (const auto preset : kPresets) {
    Predictor<double, Wind>::Set set;
    set.get<Wind>().push = 1.5;
    const Predictor<double, Wind> predictor(preset(), set);
    Tips<double> tips;
    State<double> state;
    state.position = Vector(0.0, 0.0, 10.0);
    state.string_state = StringState::kFlying;
    for (int i = 0; i < 1000; ++i) predictor.step(state, tips, tips, 1e-3);
    CHECK(state.velocity.x() == Approx(1.5));
    // Forward Euler lags by half a step of velocity.
    CHECK(state.position.x() == Approx(0.75).epsilon(2e-3));
  }
  Predictor<double, Wind>::Set set;
  set.get<Wind>().push = 1.5;
  Numbers parameters;
  parameters.dissipation_rate = 5.0;
  const Predictor<double, Wind> predictor(parameters, set);
  Tips<double> tips;
  tips.left = tips.right = Vector(0.0, 0.0, 1.0);
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.275);
  for (int i = 0; i < 10000; ++i) predictor.step(state, tips, tips, 1e-3);
  CHECK(state.position.x() / (1.0 - state.position.z()) == Approx(1.5 / kStandardGravity).epsilon(1e-6));
}

TEST_CASE("raised tips are the same as tips that are higher") {
  for (const auto preset : kPresets) {
    Predictor<double, TipOffset>::Set set;
    set.get<TipOffset>().height = 0.25;
    const Predictor<double, TipOffset> raised(preset(), set);
    const Predictor<double> plain(preset());
    Random random(801);
    const SmoothTips player = SmoothTips::random(random, 0.4, 0.15, 8.0);
    SmoothTips higher = player;
    higher.left.center.z() += 0.25;
    higher.right.center.z() += 0.25;
    State<double> a;
    a.position = Vector(0.0, 0.1, 0.6);
    State<double> b = a;
    for (int k = 0; k < 500; ++k) {
      raised.step(a, player.at(k * 1e-3), player.at((k + 1) * 1e-3), 1e-3);
      plain.step(b, higher.at(k * 1e-3), higher.at((k + 1) * 1e-3), 1e-3);
    }
    CHECK((a.position - b.position).norm() < 1e-9);
    CHECK(a.string_state == b.string_state);
  }
}

TEST_CASE("a contact impulse acts while the string is taut") {
  Predictor<double, Brake>::Set set;
  set.get<Brake>().rate = 2.0;
  Numbers parameters;
  parameters.gravity = 0.0;
  const Predictor<double, Brake> predictor(parameters, set);
  Tips<double> tips;  // in one place: the diabolo goes round
  State<double> state;
  state.position = Vector(0.725, 0.0, 0.0);
  state.velocity = Vector(0.0, 1.0, 0.0);
  state.string_state = StringState::kOnString;
  for (int i = 0; i < 500; ++i) predictor.step(state, tips, tips, 1e-3);
  CHECK(state.velocity.norm() == Approx(std::exp(-2.0 * 0.5)).epsilon(2e-3));
  State<double> loose;
  loose.velocity = Vector(0.0, 1.0, 0.0);
  for (int i = 0; i < 500; ++i) predictor.step(loose, tips, tips, 1e-3);
  CHECK(loose.velocity.norm() == 1.0);
}

TEST_CASE("spin drag acts in every state") {
  for (const auto preset : kPresets)
    for (const StringState string_state :
         {StringState::kOnString, StringState::kLoose, StringState::kFlying}) {
      Predictor<double, SpinDrag>::Set set;
      set.get<SpinDrag>().deceleration = 20.0;
      Numbers parameters = preset();
      parameters.spin_coupling = 0.0;
      const Predictor<double, SpinDrag> predictor(parameters, set);
      Tips<double> tips;
      tips.left = Vector(0.0, 0.2, 1.0);
      tips.right = Vector(0.0, -0.2, 1.0);
      State<double> state;
      state.position = Vector(0.0, 0.0, 0.5);
      state.spin = 100.0;
      state.string_state = string_state;
      for (int i = 0; i < 100; ++i) predictor.step(state, tips, tips, 1e-3);
      CHECK(state.spin == Approx(98.0));
    }
}

TEST_CASE("effects act together, in any order") {
  for (const auto preset : kPresets) {
    using Forward = Predictor<double, Wind, TipOffset, Brake, SpinDrag>;
    using Backward = Predictor<double, SpinDrag, Brake, TipOffset, Wind>;
    using Mixed = Predictor<double, StringElasticity, SpinDrag, Wind, Brake, TipOffset>;
    Forward::Set forward;
    Backward::Set backward;
    Mixed::Set mixed;
    turn_on(forward);
    turn_on(backward);
    turn_on(mixed);
    const auto expected = play(Forward(preset(), forward));
    CHECK(difference(play(Backward(preset(), backward)), expected) == 0.0);
    CHECK(difference(play(Mixed(preset(), mixed)), expected) == 0.0);
    CHECK(difference(play(Predictor<double>(preset())), expected) > 0.01);
  }
}

TEST_CASE("an effect's number out of range is refused by effect, field, value and range") {
  Predictor<double, SpinDrag, Wind>::Set set;
  set.get<Wind>().push = 7.0;
  CHECK_THROWS_WITH((Predictor<double, SpinDrag, Wind>(Numbers(), set)),
                    "wind push: 7 m/s^2; must be within [-5, 5] m/s^2");
  set.get<Wind>().push = std::nan("");
  CHECK_THROWS_AS((Predictor<double, SpinDrag, Wind>(Numbers(), set)), std::invalid_argument);
}

TEST_CASE("a set is neutral where no lane and no derivative of any amplitude is at work") {
  CHECK(AllEffects<double>().neutral());
  AllEffects<double> one;
  one.get<MagnusLift>().coefficient = 1e-3;
  CHECK_FALSE(one.neutral());
  AllEffects<Pack<double, 4>> lanes;
  CHECK(lanes.neutral());
  lanes.get<StickFlex>().compliance.set(3, 1e-3);
  CHECK_FALSE(lanes.neutral());
  AllEffects<Dual<double, 2>> seeded;
  CHECK(seeded.neutral());
  seeded.get<StringFriction>().coefficient = Dual<double, 2>::variable(0.0, 1);
  CHECK_FALSE(seeded.neutral());
}

TEST_CASE("a set knows its effects by their types") {
  EffectSet<double, Wind, SpinDrag> set;
  set.get<SpinDrag>().deceleration = 5.0;
  const EffectSet<double, Wind, SpinDrag>& constant = set;
  CHECK(constant.get<SpinDrag>().deceleration == 5.0);
  CHECK_FALSE(decltype(set)::kChangesTips);
  CHECK(EffectSet<double, Wind, TipOffset>::kChangesTips);
  CHECK(set.string(Numbers()).length == Numbers().string_length);
  CHECK(set.string(Numbers()).compliance == 0.0);
}
