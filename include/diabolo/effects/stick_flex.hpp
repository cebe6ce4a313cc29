// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/string_path.hpp"

namespace diabolo {

/// Sticks that bend: each tip gives by `compliance` times the string's pull, square to its stick (a stick
/// does not stretch). Along the string that is a spring in series with it; the rest moves the tip aside, so
/// that the strands point elsewhere. Where the sticks' directions are not known (Tips) the tips give in all
/// directions, and without tip_mass the effect is StringElasticity of twice the compliance. Wooden and
/// plastic sticks: 60 to 600 N/m at the tip.
///
/// A tip moves with the string on it, and has a mass of its own (8 to 15 g): with e_j the part of strand j
/// that is square to its stick, tip_mass / (e_1^2 + e_2^2) is the spring's inertia. The bounce on such sticks
/// is slower than their stiffness alone makes it, by some 3 %. Its weight bends the stick as well.
template <class Scalar>
struct StickFlex : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "stick_flex";
  static constexpr std::array kLaws{NamedLaw{"stick_flex",
                                             "the bending of the sticks",
                                             "string_normal",
                                             {"stick_compliance"},
                                             {"stick_damping", "tip_mass"}}};
  /// A tip is moved aside by no more than this [m]: beyond, sticks do not bend in proportion.
  static constexpr double kFarthest = 0.08;
  static constexpr int kTurns = 2;  ///< what is left is some (bend / length of a strand)^4 of the bend
  Scalar compliance{0};             ///< of one tip [m/N], >= 0
  Scalar damping{0};                ///< of one tip [N s/m], >= 0
  Scalar tip_mass{0};               ///< that moves with one tip [kg], >= 0

  bool neutral() const { return is_constant_zero(compliance); }

  Spring<Scalar> spring_at(const State<Scalar>& state, const Tips<Scalar>& tips) const {
    const StringPath<Scalar> path(state.position, tips);
    const Scalar moving = give(path, tips);
    return {compliance * moving, compliance * damping, tip_mass / maximum(moving, Scalar(0.05))};
  }

  /// Bends and directions of the strands depend on each other, and are brought together in a few turns. What
  /// a bend takes off along its strand is left to spring_at().
  TipShift<Scalar> tip_shift(const State<Scalar>& state, const Tips<Scalar>& tips,
                             const Parameters<Scalar>& parameters) const {
    // Exactly none of a slack string, whose norm() would be so small that processors take long for its
    // square.
    const Scalar pull = select(squared_norm(state.string_acceleration) > Scalar(0),
                               Scalar(parameters.mass * norm(state.string_acceleration)), Scalar(0));
    const Vector3<Scalar> weight(Scalar(0), Scalar(0), Scalar(-tip_mass * parameters.gravity));
    TipShift<Scalar> bends, shift;
    for (int i = 0; i < kTurns; ++i) {
      Tips<Scalar> there = tips;
      there.left += bends.left;
      there.right += bends.right;
      const StringPath<Scalar> path(state.position, there);
      const Scalar tension = pull / maximum(norm(path.gradient()), Scalar(0.02));
      const auto turn = [&](Vector3<Scalar>& bend, const Vector3<Scalar>& from_tip, const Scalar& length,
                            const Vector3<Scalar>& stick) {
        const Vector3<Scalar> strand = from_tip * Scalar(Scalar(1) / length);
        const Vector3<Scalar> load = strand * tension + weight;
        const Vector3<Scalar> missing = square_to(stick, load) * compliance - bend;
        const Vector3<Scalar> across = square_to(strand, missing);
        // A tip that gives way across its strand turns the strand against that.
        const Scalar against = compliance * tension / length;
        bend += missing - across * Scalar(against / (Scalar(1) + against));
        // No tip comes to its diabolo by bending.
        const Scalar farthest = length * length * Scalar(0.25);
        bend = bend * positive_sqrt<Scalar>(
                          minimum(Scalar(1), Scalar(farthest / (squared_norm(bend) + Scalar(1e-12)))));
        const Scalar along = compliance * tension * squared_norm(square_to(stick, strand));
        return within_reach(bend - strand * along);
      };
      shift.left = turn(bends.left, path.from_left, path.left_length, tips.left_direction);
      shift.right = turn(bends.right, path.from_right, path.right_length, tips.right_direction);
    }
    return shift;
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"compliance",
                        "m/N",
                        0.0,
                        1.0,
                        "of one tip, square to its stick",
                        {"stick_compliance", 1e-3, 3e-3, 0.0, 1.0 / 30.0}},
          self.compliance);
    visit(ParameterInfo{"damping", "N s/m", 0.0, 1e4, "of one tip", {"stick_damping", 1.0, 2.0, 0.0, 1e3}},
          self.damping);
    visit(
        ParameterInfo{
            "tip_mass", "kg", 0.0, 1.0, "that moves with one tip", {"tip_mass", 0.01, 0.004, 0.0, 0.1}},
        self.tip_mass);
  }

 private:
  /// By how much a pull of one lets the path grow, per compliance.
  static Scalar give(const StringPath<Scalar>& path, const Tips<Scalar>& tips) {
    return squared_norm(bent(path.from_left, path.left_length, tips.left_direction)) +
           squared_norm(bent(path.from_right, path.right_length, tips.right_direction));
  }
  /// Where a pull of one along the strand takes the tip, per compliance: its part square to the stick.
  static Vector3<Scalar> bent(const Vector3<Scalar>& from_tip, const Scalar& length,
                              const Vector3<Scalar>& stick) {
    return square_to(stick, from_tip * Scalar(Scalar(1) / length));
  }
  static Vector3<Scalar> square_to(const Vector3<Scalar>& axis, const Vector3<Scalar>& vector) {
    return vector - axis * dot<Scalar>(axis, vector);
  }
  static Vector3<Scalar> within_reach(const Vector3<Scalar>& move) {
    const Scalar square = squared_norm(move) / Scalar(kFarthest * kFarthest);
    return move / positive_sqrt<Scalar>(positive_sqrt<Scalar>(Scalar(Scalar(1) + square * square)));
  }
};

}  // namespace diabolo
