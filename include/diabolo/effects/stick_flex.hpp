// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/string_path.hpp"

namespace diabolo {

/// Sticks that bend: each tip gives by `compliance` times the string's pull, square to its stick (a stick
/// does not stretch), without inertia. Along the string that is a spring in series with it; the rest moves
/// the tip aside, so that the strands point elsewhere. Where the sticks' directions are not known (Tips) the
/// tips give in all directions, and the effect is StringElasticity of twice the compliance. Wooden and
/// plastic sticks: 60 to 600 N/m at the tip.
template <class Scalar>
struct StickFlex : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "stick_flex";
  /// A tip is moved aside by no more than this [m]: beyond, sticks do not bend in proportion.
  static constexpr double kFarthest = 0.05;
  Scalar compliance{0};  ///< of one tip [m/N], >= 0
  Scalar damping{0};     ///< of one tip [N s/m], >= 0

  bool neutral() const { return is_constant_zero(compliance); }

  Spring<Scalar> spring_at(const State<Scalar>& state, const Tips<Scalar>& tips) const {
    const StringPath<Scalar> path(state.position, tips);
    const Scalar give = squared_norm(bent(path.from_left, path.left_length, tips.left_direction)) +
                        squared_norm(bent(path.from_right, path.right_length, tips.right_direction));
    return {compliance * give, compliance * damping};
  }

  TipShift<Scalar> tip_shift(const State<Scalar>& state, const Tips<Scalar>& tips,
                             const Parameters<Scalar>& parameters) const {
    const StringPath<Scalar> path(state.position, tips);
    const Scalar pull =
        parameters.mass * norm(state.string_acceleration) / maximum(norm(path.gradient()), Scalar(0.02));
    const auto aside = [&](const Vector3<Scalar>& from_tip, const Scalar& length,
                           const Vector3<Scalar>& stick) {
      const Vector3<Scalar> strand = from_tip * Scalar(Scalar(1) / length);
      const Vector3<Scalar> give = bent(from_tip, length, stick);
      const Vector3<Scalar> move = (give - strand * dot<Scalar>(give, strand)) * Scalar(compliance * pull);
      return Vector3<Scalar>(
          move / positive_sqrt<Scalar>(Scalar(1) + squared_norm(move) / Scalar(kFarthest * kFarthest)));
    };
    return {aside(path.from_left, path.left_length, tips.left_direction),
            aside(path.from_right, path.right_length, tips.right_direction)};
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"compliance", "m/N", 0.0, 1.0, "of one tip, square to its stick"}, self.compliance);
    visit(ParameterInfo{"damping", "N s/m", 0.0, 1e4, "of one tip"}, self.damping);
  }

 private:
  /// Where a pull of one along the strand takes the tip, per compliance: its part square to the stick.
  static Vector3<Scalar> bent(const Vector3<Scalar>& from_tip, const Scalar& length,
                              const Vector3<Scalar>& stick) {
    const Vector3<Scalar> strand = from_tip * Scalar(Scalar(1) / length);
    return strand - stick * dot<Scalar>(stick, strand);
  }
};

}  // namespace diabolo
