// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "diabolo/parameters.hpp"
#include "diabolo/state.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/taut_string.hpp"

namespace diabolo {

/// What an effect changes when it changes nothing. An effect is a struct template over Scalar that derives
/// from this, holds its parameters (amplitude zero by default: then it changes no bit of the result) and
/// hides the hooks that it needs. All hooks are const, allocate nothing and know no time.
template <class Scalar>
struct NeutralEffect {
  /// Acceleration beside gravity and string [m/s^2].
  Vector3<Scalar> acceleration(const State<Scalar>&, const Tips<Scalar>&, const Parameters<Scalar>&) const {
    return Vector3<Scalar>::Constant(Scalar(0));
  }
  /// The tips that the string is really fixed to.
  Tips<Scalar> tips(const Tips<Scalar>& given) const { return given; }
  /// Addition to the string's length [m].
  Scalar added_length(const Parameters<Scalar>&) const { return Scalar(0); }
  /// Extension of the path length per tension [m/N].
  Scalar compliance() const { return Scalar(0); }
  /// Damping over stiffness of the path length [s].
  Scalar damping_time() const { return Scalar(0); }
  /// Change of velocity [m/s] by what goes with the string's tension, such as friction along the string.
  Vector3<Scalar> contact_impulse(const State<Scalar>&, const Tips<Scalar>&, const StringStepResult<Scalar>&,
                                  const Scalar& /*dt*/, const Parameters<Scalar>&) const {
    return Vector3<Scalar>::Constant(Scalar(0));
  }
  /// Rate of change of the spin beside the string's [rad/s^2].
  Scalar spin_acceleration(const State<Scalar>&, const Parameters<Scalar>&) const { return Scalar(0); }

  void validate() const {}
};

/// Any number of effects at once; the predictor asks the set, the set asks each.
template <class Scalar, template <class> class... Effects>
struct EffectSet {
  std::tuple<Effects<Scalar>...> members;

  template <template <class> class Effect>
  Effect<Scalar>& get() {
    return std::get<Effect<Scalar>>(members);
  }
  template <template <class> class Effect>
  const Effect<Scalar>& get() const {
    return std::get<Effect<Scalar>>(members);
  }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>& given,
                               const Parameters<Scalar>& parameters) const {
    Vector3<Scalar> sum(Scalar(0), Scalar(0), Scalar(-parameters.gravity));
    each([&](const auto& effect) { sum += effect.acceleration(state, given, parameters); });
    return sum;
  }
  Tips<Scalar> tips(Tips<Scalar> given) const {
    each([&](const auto& effect) { given = effect.tips(given); });
    return given;
  }
  Scalar string_length(const Parameters<Scalar>& parameters) const {
    Scalar sum = parameters.string_length;
    each([&](const auto& effect) { sum += effect.added_length(parameters); });
    return sum;
  }
  Scalar compliance() const {
    Scalar sum{0};
    each([&](const auto& effect) { sum += effect.compliance(); });
    return sum;
  }
  Scalar damping_time() const {
    Scalar sum{0};
    each([&](const auto& effect) { sum += effect.damping_time(); });
    return sum;
  }
  Vector3<Scalar> contact_impulse(const State<Scalar>& state, const Tips<Scalar>& given,
                                  const StringStepResult<Scalar>& result, const Scalar& dt,
                                  const Parameters<Scalar>& parameters) const {
    Vector3<Scalar> sum = Vector3<Scalar>::Constant(Scalar(0));
    each([&](const auto& effect) { sum += effect.contact_impulse(state, given, result, dt, parameters); });
    return sum;
  }
  Scalar spin_acceleration(const State<Scalar>& state, const Parameters<Scalar>& parameters) const {
    Scalar sum{0};
    each([&](const auto& effect) { sum += effect.spin_acceleration(state, parameters); });
    return sum;
  }
  void validate() const {
    each([](const auto& effect) { effect.validate(); });
  }

 private:
  template <class Function>
  void each(Function&& function) const {
    std::apply([&](const auto&... effect) { (function(effect), ...); }, members);
  }
};

}  // namespace diabolo
