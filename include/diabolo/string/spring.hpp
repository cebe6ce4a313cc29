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
  Scalar inertia{0};       ///< of what a change of the path length moves, over the diabolo's mass

  /// In a row each spring extends by its share of the compliance, and its inertia counts with that squared.
  void add(const Spring<Scalar>& spring, const Scalar& mass) {
    const Scalar own = spring.compliance * mass, sum = compliance + own;
    const Scalar per_sum = Scalar(1) / maximum(sum, Scalar(tiny<Scalar>()));
    const Scalar before = compliance * per_sum, added = own * per_sum;
    damping_time = before * damping_time + added * spring.damping_time;
    inertia = before * before * inertia + added * added * spring.inertia / mass;
    compliance = sum;
  }
};

}  // namespace diabolo
