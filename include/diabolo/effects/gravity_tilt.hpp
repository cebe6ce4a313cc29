// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// Gravity that does not point along -z of the recording's frame, but along (x, y, -sqrt(1 - x^2 - y^2)): a
/// floor that is not level, or a camera system that was calibrated on one. Its magnitude stays. x and y are
/// the sines of the tilt towards the axes; one degree is 0.0175.
template <class Scalar>
struct GravityTilt : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "gravity_tilt";
  Scalar x{0}, y{0};  ///< horizontal components of gravity's direction [1]

  bool neutral() const { return is_constant_zero(x) && is_constant_zero(y); }

  Vector3<Scalar> acceleration(const State<Scalar>&, const Tips<Scalar>&, const Scalar&,
                               const Parameters<Scalar>& parameters) const {
    using std::sqrt;
    const Scalar square = x * x + y * y;
    const Scalar less = square / (Scalar(1) + sqrt(Scalar(1) - square));  // 1 - sqrt(1 - square)
    return Vector3<Scalar>(x, y, less) * parameters.gravity;
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"x", "1", -0.5, 0.5, "gravity's direction, forward"}, self.x);
    visit(ParameterInfo{"y", "1", -0.5, 0.5, "gravity's direction, to the left"}, self.y);
  }
};

}  // namespace diabolo
