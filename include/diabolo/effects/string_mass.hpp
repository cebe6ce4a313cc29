// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// A string that weighs something. While it is loose, half of it hangs on the diabolo (the other half on the
/// tips) and pulls it down: a = -g linear_density L / (2 m), some 0.05 to 0.1 m/s^2 for the paper's diabolos.
/// While it is taut its inertia adds linear_density L / 3 to the diabolo's, a share of about 1 / 300, which
/// is left out, as are its waves and its shape. Polyester of 1.5 mm: 1.5 to 3 g/m.
template <class Scalar>
struct StringMass : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "string_mass";
  static constexpr std::array kLaws{NamedLaw{
      "string_mass", "the weight of the loose string", "vertical", {"string_mass"}, {}, "linear_density"}};
  Scalar linear_density{0};  ///< [kg/m], >= 0

  bool neutral() const { return is_constant_zero(linear_density); }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>&, const Scalar&,
                               const Parameters<Scalar>& parameters) const {
    const Scalar weight =
        parameters.gravity * linear_density * parameters.string_length / (Scalar(2) * parameters.mass);
    return {Scalar(0), Scalar(0),
            select(is(state.string_state, StringState::kLoose), Scalar(-weight), Scalar(0))};
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(
        ParameterInfo{
            "linear_density", "kg/m", 0.0, 0.1, "of the string", {"string_mass", 1e-3, 3e-3, 0.0, 0.1}},
        self.linear_density);
  }
};

}  // namespace diabolo
