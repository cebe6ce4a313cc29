// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// A spring in series with the string.
template <class Scalar>
struct Spring {
  Scalar compliance{0};    ///< extension of the path length per tension [m/N]
  Scalar damping_time{0};  ///< damping over stiffness [s]
  Scalar inertia{0};       ///< tension per acceleration of that extension, of what it moves [kg]
};

/// The string as a step sees it.
template <class Scalar>
struct StringNow {
  Scalar length;           ///< in the strands [m]
  Scalar compliance{0};    ///< extension of the path length per tension/mass [s^2]
  Scalar damping_time{0};  ///< damping over stiffness [s]
  Scalar restitution{0};   ///< share of the path's rate that a catch gives back
  Scalar inertia{0};       ///< sum of inertia over the diabolo's mass times compliance^2 [s^4]

  /// In a row. Of an extension each spring takes its share of the compliance.
  void add(const Spring<Scalar>& spring, const Scalar& mass) {
    const Scalar own = spring.compliance * mass, sum = compliance + own;
    damping_time =
        (compliance * damping_time + own * spring.damping_time) / maximum(sum, Scalar(tiny<Scalar>()));
    inertia += own * own * spring.inertia / mass;
    compliance = sum;
  }
};

}  // namespace diabolo
