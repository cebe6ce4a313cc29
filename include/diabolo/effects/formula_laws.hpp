// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "diabolo/effects/effect.hpp"
#include "diabolo/effects/law.hpp"
#include "diabolo/math/soft_unit.hpp"

namespace diabolo {

/// Laws that somebody wrote down, or that a diagnosis learnt: each a formula (see Law), with the numbers of
/// all laws one after the other. No law of nature: they may do work.
template <class Scalar>
struct FormulaLaws : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "formula_laws";
  static constexpr bool kHasText = true;
  static constexpr std::size_t kMost = Law::kMostNumbers;

  /// Lanes refer to the laws of what they were gathered from, which outlives them: what is compiled for some
  /// processors alone must leave no function behind that others would call.
  using Laws = std::conditional_t<ScalarTraits<Scalar>::kLanes == 1, std::shared_ptr<const std::vector<Law>>,
                                  const std::vector<Law>*>;
  Laws laws{};  ///< none: nothing is at work
  std::array<Scalar, kMost> numbers{};

  FormulaLaws() { numbers.fill(Scalar(0)); }

  /// Laws as a fit begins with them: no amplitude, and what is expected of their shape. Throws
  /// std::invalid_argument; see check_laws().
  explicit FormulaLaws(std::vector<Law> list) : FormulaLaws() {
    check_laws(list);
    std::size_t i = 0;
    for (const Law& law : list)
      for (const LawNumber& number : law.numbers) numbers[i++] = Scalar(number.expected);
    if (!list.empty()) laws = std::make_shared<const std::vector<Law>>(std::move(list));
  }

  /// Takes over another Scalar's laws, not their numbers.
  template <class Other>
  void take_text(const FormulaLaws<Other>& other) {
    if constexpr (std::is_assignable_v<Laws&, const typename FormulaLaws<Other>::Laws&>)
      laws = other.laws;
    else
      laws = other.laws.get();
  }

  [[gnu::always_inline]] inline bool neutral() const {  // as each()
    bool none = true;
    each([&](const Law&, std::size_t first) { none = none && is_constant_zero(numbers[first]); });
    return none;
  }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>& tips, const Scalar& dt,
                               const Parameters<Scalar>& parameters) const {
    Vector3<Scalar> sum = Vector3<Scalar>::Constant(Scalar(0));
    each([&](const Law& law, std::size_t first) {
      if (!is_acceleration(law.acts)) return;
      const Scalar size = value(law, first, state, tips, parameters);
      // No step takes more than all of the velocity.
      const Scalar most = law.acts == Acts::kAgainst ? norm(state.velocity) / dt : Scalar(kHardest);
      sum = sum + direction(law.acts, state, tips) *
                      minimum(maximum(size, Scalar(-kHardest)), Scalar(minimum(most, Scalar(kHardest))));
    });
    return sum;
  }

  Scalar bound_length(const State<Scalar>& state, const Tips<Scalar>& tips,
                      const Parameters<Scalar>& parameters) const {
    return -sum_of(Acts::kString, kLongest, state, tips, parameters);
  }

  Scalar spin_acceleration(const Scalar&, const State<Scalar>& state, const Tips<Scalar>& tips, const Scalar&,
                           const Parameters<Scalar>& parameters) const {
    return sum_of(Acts::kSpin, kHardest, state, tips, parameters);
  }

  bool rubs() const {
    bool rubs = false;
    each([&](const Law& law, std::size_t first) {
      rubs |= law.acts == Acts::kFriction && !is_constant_zero(numbers[first]);
    });
    return rubs;
  }

  Scalar friction(const State<Scalar>& state, const Tips<Scalar>& tips,
                  const Parameters<Scalar>& parameters) const {
    return sum_of(Acts::kFriction, kRoughest, state, tips, parameters);
  }

  /// Calls `visit(info, field)` for every number of the laws that are there.
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    self.each([&](const Law& law, std::size_t first) {
      for (const LawNumber& number : law.numbers)
        visit(ParameterInfo{number.name, number.unit, number.minimum, number.maximum, law.plain},
              self.numbers[first++]);
    });
  }

  /// Calls `visit(law, first)` for every law, `first` the place of its first number. (Inlined, lest a unit
  /// for some processors alone leave a function of doubles behind.)
  template <class Visit>
  [[gnu::always_inline]] inline void each(const Visit& visit) const {
    if (!laws) return;
    std::size_t first = 0;
    for (const Law& law : *laws) {
      visit(law, first);
      first += law.numbers.size();
    }
  }

 private:
  static constexpr double kHardest = 1e3, kLongest = 0.5,
                          kRoughest = 3.0;  ///< [m/s^2] or [rad/s^2], [m], [1]

  static Vector3<Scalar> direction(Acts acts, const State<Scalar>& state, const Tips<Scalar>& tips) {
    const Scalar zero(0), one(1);
    switch (acts) {
      case Acts::kForward:
        return {one, zero, zero};
      case Acts::kLeft:
        return {zero, one, zero};
      case Acts::kUp:
        return {zero, zero, one};
      case Acts::kAgainst:
        return soft_unit<Scalar>(state.velocity) * Scalar(-1);
      case Acts::kLift:
        return soft_unit<Scalar>(cross(state.axis, state.velocity)) *
               Scalar(select(state.spin > Scalar(0), Scalar(-1), Scalar(1)));
      default: {
        const Vector3<Scalar> left = soft_unit<Scalar>(tips.left - state.position),
                              right = soft_unit<Scalar>(tips.right - state.position);
        return acts == Acts::kAlong ? soft_unit<Scalar>(right - left) : soft_unit<Scalar>(cross(left, right));
      }
    }
  }

  Scalar sum_of(Acts acts, double most, const State<Scalar>& state, const Tips<Scalar>& tips,
                const Parameters<Scalar>& parameters) const {
    Scalar sum(0);
    each([&](const Law& law, std::size_t first) {
      if (law.acts == acts) sum = sum + value(law, first, state, tips, parameters);
    });
    return minimum(maximum(sum, Scalar(-most)), Scalar(most));
  }

  Scalar value(const Law& law, std::size_t first, const State<Scalar>& state, const Tips<Scalar>& tips,
               const Parameters<Scalar>& parameters) const {
    return law.formula.template value<Scalar>([&](std::size_t name) {
      return name < kLawVariables.size() ? variable(name, state, tips, parameters)
                                         : numbers[first + name - kLawVariables.size()];
    });
  }

  /// Number `name` of kLawVariables.
  static Scalar variable(std::size_t name, const State<Scalar>& state, const Tips<Scalar>& tips,
                         const Parameters<Scalar>& parameters) {
    if (name == 0) return tips.time;
    if (name < 4) return state.position[static_cast<int>(name) - 1];
    if (name < 7) return state.velocity[static_cast<int>(name) - 4];
    switch (name) {
      case 7:
        return norm(state.velocity);
      case 8:
        return state.spin;
      case 9:
      case 10:
      case 11:
        return state.axis[static_cast<int>(name) - 9];
      case 12:
        return norm(state.string_acceleration);
      case 13:
        return select(Mask<Scalar>(is(state.string_state, StringState::kOnString)), Scalar(1), Scalar(0));
      case 14:
        return select(Mask<Scalar>(is(state.string_state, StringState::kFlying)), Scalar(1), Scalar(0));
      case 15:
        return norm<Scalar>(tips.left - state.position);
      case 16:
        return norm<Scalar>(tips.right - state.position);
      case 17:
        return norm(tips.left_velocity);
      case 18:
        return norm(tips.right_velocity);
      case 21:
        return norm<Scalar>(tips.right - tips.left);
      default: {
        const Vector3<Scalar> to_tip = soft_unit<Scalar>(tips.right - state.position);
        const Scalar passing = to_tip.dot(Vector3<Scalar>(tips.right_velocity - state.velocity));
        return name == 19 ? passing : Scalar(state.spin * parameters.axle_radius - passing);
      }
    }
  }
};

/// Whether two sets hold the same laws, whatever their numbers.
template <class Scalar>
bool same_laws(const FormulaLaws<Scalar>& a, const FormulaLaws<Scalar>& b) {
  return a.laws == b.laws || (a.laws && b.laws && *a.laws == *b.laws);
}

}  // namespace diabolo
