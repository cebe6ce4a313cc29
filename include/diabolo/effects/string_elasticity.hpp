// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// A string that stretches: tension = stiffness * e + damping * de/dt while positive, with e the path length
/// beyond the string's length. One spring stands for string, sticks and their holders in series (the paper's
/// robot: about 60 N/m); twine of 1.5 mm lies at 400, braided polyester at 1000 to 4000 N/m for 1.45 m. The
/// amplitude is the compliance, so that zero is the rigid string. Only compliance times the diabolo's mass
/// acts on the motion.
template <class Scalar>
struct StringElasticity : NeutralEffect<Scalar> {
  Scalar compliance_per_newton{0};  ///< 1 / stiffness [m/N], >= 0
  Scalar damping{0};                ///< [N s/m], >= 0

  /// Stiffness [N/m] and damping [N s/m] of the path length.
  static StringElasticity of_stiffness(const Scalar& stiffness, const Scalar& damping_of_path = Scalar(0)) {
    StringElasticity elasticity;
    elasticity.compliance_per_newton = Scalar(1) / stiffness;
    elasticity.damping = damping_of_path;
    return elasticity;
  }

  Scalar compliance() const { return compliance_per_newton; }
  Scalar damping_time() const { return damping * compliance_per_newton; }

  void validate() const {
    if (!all(compliance_per_newton >= Scalar(0)) || !all(compliance_per_newton <= Scalar(1)))
      throw std::invalid_argument("string_elasticity: stiffness must be at least 1 N/m");
    if (!all(damping >= Scalar(0)) || !all(damping <= Scalar(1e4)))
      throw std::invalid_argument("string_elasticity: damping must be within [0, 10000] N s/m");
  }
};

}  // namespace diabolo
