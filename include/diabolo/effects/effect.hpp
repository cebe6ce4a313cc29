// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <tuple>
#include <type_traits>

#include "diabolo/effects/named_law.hpp"
#include "diabolo/parameters.hpp"
#include "diabolo/state.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/string/spring.hpp"
#include "diabolo/string/string_path.hpp"
#include "diabolo/string/string_step.hpp"

namespace diabolo {

/// Displacements of the two tips [m].
template <class Scalar>
struct TipShift {
  Vector3<Scalar> left = Vector3<Scalar>::Constant(Scalar(0)), right = Vector3<Scalar>::Constant(Scalar(0));

  void move(Tips<Scalar>& tips) const {
    tips.left = tips.left + left;
    tips.right = tips.right + right;
  }
};

/// What goes with the string's tension in a step.
template <class Scalar>
struct Contact {
  Vector3<Scalar> impulse = Vector3<Scalar>::Constant(Scalar(0));  ///< change of velocity [m/s]
  Scalar spin{0};                                                  ///< change of spin [rad/s]
  Scalar pull_difference{0};  ///< right strand's tension less the left one's, over mass [m/s^2]
};

/// Of the string on the diabolo, over its mass [m/s^2]: along the bisector, and what the strands differ by.
template <class Scalar>
Vector3<Scalar> force_of_string(const Tips<Scalar>& tips, const StringStepResult<Scalar>& result,
                                const Scalar& pull_difference) {
  const auto [left, right] = StringPath<Scalar>(result.position, tips).directions();
  return result.string_acceleration + (left - right) * Scalar(Scalar(0.5) * pull_difference);
}

/// What an effect changes when it changes nothing. An effect is a struct template over Scalar that derives
/// from this, holds its parameters (amplitude zero by default: then it changes no bit of the result) and
/// hides neutral() and the hooks that it needs. What a diagnosis looks for are its fields that are `sought`
/// and its kLaws. All hooks are const, allocate nothing and know no time but the step's length dt [s].
template <class Scalar>
struct NeutralEffect {
  /// Whether it holds more than numbers; then its fields are not all of it, and it has a take_text() for the
  /// rest.
  static constexpr bool kHasText = false;
  /// What a diagnosis may find of it.
  static constexpr std::array<NamedLaw, 0> kLaws{};
  /// Whether all amplitudes are zero, in every lane and with every derivative; then nobody asks the hooks.
  bool neutral() const { return false; }
  /// Acceleration beside gravity and string, its mean over a step from the given state [m/s^2].
  Vector3<Scalar> acceleration(const State<Scalar>&, const Tips<Scalar>&, const Scalar& /*dt*/,
                               const Parameters<Scalar>&) const {
    return Vector3<Scalar>::Constant(Scalar(0));
  }
  /// Where the string's strands begin, relative to the given tips at the beginning of a step; the same for
  /// its end.
  TipShift<Scalar> tip_shift(const State<Scalar>&, const Tips<Scalar>&, const Parameters<Scalar>&) const {
    return {};
  }
  /// String that is not in the strands [m], at the beginning of a step; `tips` are shifted.
  Scalar bound_length(const State<Scalar>&, const Tips<Scalar>&, const Parameters<Scalar>&) const {
    return Scalar(0);
  }
  /// Wherever the diabolo is.
  Spring<Scalar> spring() const { return {}; }
  /// Where it is at the beginning of a step; beside spring().
  Spring<Scalar> spring_at(const State<Scalar>&, const Tips<Scalar>&) const { return {}; }
  /// Share of the path's rate that a catch gives back, from 0 to 1.
  Scalar restitution() const { return Scalar(0); }
  /// Whether it changes the coefficient of the string's friction; then by how much [1].
  bool rubs() const { return false; }
  Scalar friction(const State<Scalar>&, const Tips<Scalar>&, const Parameters<Scalar>&) const {
    return Scalar(0);
  }
  /// Of what goes with the string's tension, as friction does; others add `friction` to its coefficient.
  Contact<Scalar> contact(const State<Scalar>&, const Tips<Scalar>&, const StringStepResult<Scalar>&,
                          const Scalar& /*dt*/, const Parameters<Scalar>&, const Scalar& /*friction*/) const {
    return {};
  }
  /// Torque of the string about the diabolo's centre, mean over a step, less what is along the axle; over the
  /// diabolo's mass and the axle's radius [m/s^2]. `tips` are those of the step's end, `pull_difference` is
  /// that of all contacts.
  Vector3<Scalar> axle_torque(const State<Scalar>&, const Tips<Scalar>& /*tips*/,
                              const StringStepResult<Scalar>&, const Scalar& /*pull_difference*/,
                              const Parameters<Scalar>&) const {
    return Vector3<Scalar>::Constant(Scalar(0));
  }
  /// Turns the axle, `axis` and `tumble` of the state, for a step under the torque of all effects.
  void turn_axle(State<Scalar>&, const Vector3<Scalar>& /*torque*/, const Scalar& /*dt*/) const {}
  /// Whether the axle turns where no string pulls, too.
  bool tumbles() const { return false; }
  /// Rate of change of the given spin [rad/s] beside the string's, its mean over a step [rad/s^2]. The spin
  /// is what string and other effects have made of the state's.
  Scalar spin_acceleration(const Scalar& /*spin*/, const State<Scalar>&, const Tips<Scalar>&,
                           const Scalar& /*dt*/, const Parameters<Scalar>&) const {
    return Scalar(0);
  }
};

/// Whether an effect hides a hook of NeutralEffect: `hides(&Effect::contact,
/// &NeutralEffect<Scalar>::contact)`.
template <class Own, class Neutral>
constexpr bool hides(Own, Neutral) {
  return !std::is_same_v<Own, Neutral>;
}

/// Any number of effects at once; the predictor asks the set, the set asks those effects that have the hook,
/// so that a hook that nobody uses costs nothing.
template <class Scalar, template <class> class... Effects>
struct EffectSet {
  using Neutral = NeutralEffect<Scalar>;
  /// Whether an effect says where the string begins, what of it is not in the strands, or how it gives in a
  /// place: these are asked together, before a step.
  template <class Effect>
  static constexpr bool kChangesStrands = hides(&Effect::tip_shift, &Neutral::tip_shift) ||
                                          hides(&Effect::bound_length, &Neutral::bound_length) ||
                                          hides(&Effect::spring_at, &Neutral::spring_at);
  static constexpr bool kChangesTips = (kChangesStrands<Effects<Scalar>> || ...);

  static constexpr bool kTouches = (hides(&Effects<Scalar>::contact, &Neutral::contact) || ...);

  static constexpr bool kTurnsAxle = (hides(&Effects<Scalar>::turn_axle, &Neutral::turn_axle) || ...);

  std::tuple<Effects<Scalar>...> members;

  template <template <class> class Effect>
  Effect<Scalar>& get() {
    return std::get<Effect<Scalar>>(members);
  }
  template <template <class> class Effect>
  const Effect<Scalar>& get() const {
    return std::get<Effect<Scalar>>(members);
  }

  /// Gravity and all accelerations [m/s^2].
  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>& given, const Scalar& dt,
                               const Parameters<Scalar>& parameters) const {
    Vector3<Scalar> sum(Scalar(0), Scalar(0), Scalar(-parameters.gravity));
    each([&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::acceleration, &Neutral::acceleration))
        sum = sum + effect.acceleration(state, given, dt, parameters);
    });
    return sum;
  }
  TipShift<Scalar> tip_shift(const State<Scalar>& state, const Tips<Scalar>& given,
                             const Parameters<Scalar>& parameters) const {
    TipShift<Scalar> sum;
    each([&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::tip_shift, &Neutral::tip_shift)) {
        const TipShift<Scalar> own = effect.tip_shift(state, given, parameters);
        sum.left = sum.left + own.left;
        sum.right = sum.right + own.right;
      }
    });
    return sum;
  }
  Scalar bound_length(const State<Scalar>& state, const Tips<Scalar>& shifted,
                      const Parameters<Scalar>& parameters) const {
    Scalar sum{0};
    each([&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::bound_length, &Neutral::bound_length))
        sum += effect.bound_length(state, shifted, parameters);
    });
    return sum;
  }
  /// Whether no effect is at work.
  bool neutral() const {
    return std::apply([](const auto&... effect) { return (effect.neutral() && ...); }, members);
  }
  /// Whether any effect that is at work changes the strands before a step.
  bool moves_tips() const {
    bool moves = false;
    each([&]<class Effect>(const Effect&) { moves |= kChangesStrands<Effect>; });
    return moves;
  }
  /// Whether any effect that is at work changes the coefficient of the string's friction.
  bool rubs() const {
    return std::apply([](const auto&... effect) { return (effect.rubs() || ...); }, members);
  }
  /// Whether any effect has a contact impulse.
  bool touches() const {
    bool touches = rubs();
    each([&]<class Effect>(const Effect&) { touches |= hides(&Effect::contact, &Neutral::contact); });
    return touches;
  }
  /// The string with what makes it softer wherever the diabolo is.
  StringNow<Scalar> string(const Parameters<Scalar>& parameters) const {
    StringNow<Scalar> string{parameters.string_length};
    each([&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::spring, &Neutral::spring)) string.add(effect.spring(), parameters.mass);
      string.restitution += effect.restitution();
    });
    return string;
  }
  /// The same, and what depends on where it is; `tips` are shifted.
  StringNow<Scalar> string_at(StringNow<Scalar> string, const State<Scalar>& state, const Tips<Scalar>& tips,
                              const Parameters<Scalar>& parameters) const {
    string.length = string.length - bound_length(state, tips, parameters);
    each([&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::spring_at, &Neutral::spring_at))
        string.add(effect.spring_at(state, tips), parameters.mass);
    });
    return string;
  }
  /// Adds all contact impulses to velocity and spin; returns the difference of the tensions over mass
  /// [m/s^2].
  Scalar touch(Vector3<Scalar>& velocity, Scalar& spin, const State<Scalar>& state, const Tips<Scalar>& given,
               const StringStepResult<Scalar>& result, const Scalar& dt,
               const Parameters<Scalar>& parameters) const {
    Scalar pull_difference{0}, friction{0};
    const bool changed = rubs();  // of a string that else is smooth, too
    if (changed) each([&](const auto& effect) { friction += effect.friction(state, given, parameters); });
    const auto touch_one = [&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::contact, &Neutral::contact)) {
        if (effect.neutral() && !changed) return;
        const Contact<Scalar> own = effect.contact(state, given, result, dt, parameters, friction);
        velocity = velocity + own.impulse;
        spin += own.spin;
        pull_difference += own.pull_difference;
      }
    };
    std::apply([&](const auto&... effect) { (touch_one(effect), ...); }, members);
    return pull_difference;
  }
  bool tumbles() const {
    return std::apply([](const auto&... effect) { return ((!effect.neutral() && effect.tumbles()) || ...); },
                      members);
  }
  /// Turns the axle of the state at a step's beginning.
  void turn_axle(State<Scalar>& state, const Tips<Scalar>& given, const StringStepResult<Scalar>& result,
                 const Scalar& pull_difference, const Scalar& dt,
                 const Parameters<Scalar>& parameters) const {
    Vector3<Scalar> torque = Vector3<Scalar>::Constant(Scalar(0));
    if (any(result.taut || result.snapped_taut))
      each([&]<class Effect>(const Effect& effect) {
        if constexpr (hides(&Effect::axle_torque, &Neutral::axle_torque))
          torque = torque + effect.axle_torque(state, given, result, pull_difference, parameters);
      });
    each([&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::turn_axle, &Neutral::turn_axle)) effect.turn_axle(state, torque, dt);
    });
  }
  /// The spin after all torques.
  Scalar after_torques(Scalar spin, const State<Scalar>& state, const Tips<Scalar>& given, const Scalar& dt,
                       const Parameters<Scalar>& parameters) const {
    each([&]<class Effect>(const Effect& effect) {
      if constexpr (hides(&Effect::spin_acceleration, &Neutral::spin_acceleration))
        spin += effect.spin_acceleration(spin, state, given, dt, parameters) * dt;
    });
    return spin;
  }
  /// Throws std::invalid_argument naming effect, field, value and range.
  void validate() const {
    std::apply([](const auto&... effect) { (validate_one(effect), ...); }, members);
  }

 private:
  template <class Effect>
  static void validate_one(const Effect& effect) {
    validate_fields<Scalar>(effect, std::string(Effect::kName).append(" "));
  }
  template <class Function>
  void each(Function&& function) const {
    std::apply([&](const auto&... effect) { ((effect.neutral() ? void() : function(effect)), ...); },
               members);
  }
};

}  // namespace diabolo
