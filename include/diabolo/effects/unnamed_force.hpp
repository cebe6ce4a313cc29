// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/math/soft_unit.hpp"

namespace diabolo {

/// A force that nobody has a name for, as a diagnosis sees it: accelerations in the directions that tell
/// physics apart, by the string's state, times powers of speed and spin. No law of nature: it may do work.
/// Beyond the bounds below of speed and spin it stays what it is there.
template <class Scalar>
struct UnnamedForce : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "unnamed_force";
  static constexpr double kLeastSpeed = 0.05, kMostSpeed = 20.0;           ///< [m/s]
  static constexpr double kLeastSpin = 1.0, kMostSpin = 1e3, kSpin = 1e2;  ///< [rad/s]
  static constexpr double kLargestPower = 4.0;                             ///< of either, and of its inverse
  Scalar string_tangent{0};   ///< ON_STRING, in the string's plane, towards the right tip [m/s^2]
  Scalar string_binormal{0};  ///< ON_STRING, square to the string's plane [m/s^2]
  Scalar flight_against{0};   ///< off the string, against the velocity [m/s^2]
  Scalar flight_vertical{0};  ///< off the string, up [m/s^2]
  Scalar flight_lift{0};      ///< off the string, along omega x v [m/s^2]
  Scalar speed_exponent{0};   ///< of the speed over 1 m/s
  Scalar spin_exponent{0};    ///< of the spin's magnitude over 100 rad/s

  bool neutral() const {
    return is_constant_zero(string_tangent) && is_constant_zero(string_binormal) &&
           is_constant_zero(flight_against) && is_constant_zero(flight_vertical) &&
           is_constant_zero(flight_lift);
  }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>& tips, const Scalar& dt,
                               const Parameters<Scalar>&) const {
    const Vector3<Scalar> left = soft_unit<Scalar>(tips.left - state.position),
                          right = soft_unit<Scalar>(tips.right - state.position);
    const Vector3<Scalar> taut = soft_unit<Scalar>(right - left) * string_tangent +
                                 soft_unit<Scalar>(cross(left, right)) * string_binormal;
    const Scalar sign = select(state.spin > Scalar(0), Scalar(-1), Scalar(1));
    const Scalar grown = growth(state);
    // No step takes more than all of the velocity.
    const Scalar against = minimum(Scalar(flight_against * grown), Scalar(norm(state.velocity) / dt));
    const Vector3<Scalar> free =
        (soft_unit<Scalar>(cross(state.axis, state.velocity)) * Scalar(flight_lift * sign) +
         Vector3<Scalar>(Scalar(0), Scalar(0), flight_vertical)) *
            grown -
        soft_unit<Scalar>(state.velocity) * against;
    return select<Scalar>(is(state.string_state, StringState::kOnString), Vector3<Scalar>(taut * grown),
                          free);
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    constexpr std::string_view kAmplitude = "m/s^2", kNumber = "1";
    const auto sought = [](std::string_view name) { return Sought{name, 0.1, 0.0, -100.0, 100.0}; };
    visit(ParameterInfo{"string_tangent", kAmplitude, -100.0, 100.0,
                        "on the string, along it towards the right tip, at 1 m/s and 100 rad/s",
                        sought("string_tangent")},
          self.string_tangent);
    visit(ParameterInfo{"string_binormal", kAmplitude, -100.0, 100.0,
                        "on the string, square to its plane, forwards", sought("string_binormal")},
          self.string_binormal);
    visit(ParameterInfo{"flight_against", kAmplitude, -100.0, 100.0, "off the string, against the velocity",
                        sought("flight_against_v")},
          self.flight_against);
    visit(ParameterInfo{"flight_vertical", kAmplitude, -100.0, 100.0, "off the string, up",
                        sought("flight_vertical")},
          self.flight_vertical);
    visit(ParameterInfo{"flight_lift", kAmplitude, -100.0, 100.0, "off the string, along omega x v",
                        sought("flight_axis_x_v")},
          self.flight_lift);
    visit(ParameterInfo{"speed_exponent", kNumber, -kLargestPower, kLargestPower,
                        "power of the speed over 1 m/s"},
          self.speed_exponent);
    visit(ParameterInfo{"spin_exponent", kNumber, -kLargestPower, kLargestPower,
                        "power of the spin over 100 rad/s"},
          self.spin_exponent);
  }

 private:
  Scalar growth(const State<Scalar>& state) const {
    using std::exp, std::log;
    const auto power = [](const Scalar& x, const Scalar& exponent, double least, double most) {
      if (is_constant_zero(exponent)) return Scalar(1);
      return Scalar(exp(exponent * log(minimum(maximum(x, Scalar(least)), Scalar(most)))));
    };
    return power(norm(state.velocity), speed_exponent, kLeastSpeed, kMostSpeed) *
           power(Scalar(absolute<Scalar>(state.spin) / Scalar(kSpin)), spin_exponent, kLeastSpin / kSpin,
                 kMostSpin / kSpin);
  }
};

}  // namespace diabolo
