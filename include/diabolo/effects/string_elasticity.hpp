// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// A string that stretches: tension = stiffness * e + damping * de/dt while positive, with e the path length
/// beyond the string's length. One spring stands for string, sticks and their holders in series (the paper's
/// robot: about 60 N/m); twine of 1.5 mm lies at 400, braided polyester at 1000 to 4000 N/m for 1.45 m. The
/// amplitude is the compliance, so that zero is the rigid string. Only compliance times the diabolo's mass
/// acts on the motion.
template <class Scalar>
struct StringElasticity : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "string_elasticity";
  static constexpr std::array kLaws{
      NamedLaw{"string_elasticity", "the string's stretch", "string_normal", {"compliance"}, {"damping"}}};
  Scalar compliance_per_newton{0};  ///< 1 / stiffness [m/N], >= 0
  Scalar damping{0};                ///< [N s/m], >= 0

  /// Stiffness [N/m] and damping [N s/m] of the path length.
  static StringElasticity of_stiffness(const Scalar& stiffness, const Scalar& damping_of_path = Scalar(0)) {
    StringElasticity elasticity;
    elasticity.compliance_per_newton = Scalar(1) / stiffness;
    elasticity.damping = damping_of_path;
    return elasticity;
  }

  bool neutral() const { return is_constant_zero(compliance_per_newton); }

  Spring<Scalar> spring() const { return {compliance_per_newton, damping * compliance_per_newton}; }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"compliance",
                        "m/N",
                        0.0,
                        1.0,
                        "extension of the path length per tension",
                        {"compliance", 1e-3, 3e-3, 0.0, 1.0 / 30.0}},
          self.compliance_per_newton);
    visit(ParameterInfo{"damping",
                        "N s/m",
                        0.0,
                        1e4,
                        "tension per rate of the path length",
                        {"damping", 10.0, 10.0, 0.0, 1e3}},
          self.damping);
  }
};

}  // namespace diabolo
