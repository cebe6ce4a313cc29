// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// A catch that is not perfectly inelastic: of the rate at which the path length grows when a slack string
/// comes taut, the diabolo keeps `coefficient` in the other direction (Newton's law of impact along the
/// string). Hands and string damping leave 0 to 0.4. For a string without resolved springs, which bounce by
/// themselves.
template <class Scalar>
struct LandingRestitution : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "landing_restitution";
  static constexpr std::array kLaws{NamedLaw{
      "landing_restitution", "the bounce of a catch", "string_normal", {"restitution"}, {}, "coefficient"}};
  Scalar coefficient{0};  ///< 0: inelastic; 1: no energy is lost with resting tips

  bool neutral() const { return is_constant_zero(coefficient); }

  /// At the instant of the catch; the rest of the step is flight, or the taut string where the bounce is over
  /// before the step is. Energy never rises while the tips rest.
  Scalar restitution() const { return coefficient; }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"coefficient",
                        "1",
                        0.0,
                        1.0,
                        "of the string's rate of stretch that a catch gives back",
                        {"restitution", 0.1, 0.2, 0.0, 1.0}},
          self.coefficient);
  }
};

}  // namespace diabolo
