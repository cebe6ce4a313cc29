// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// The direction of a vector, of length one; shorter than that below 1e-3, smoothly, down to nothing.
template <class Scalar>
Vector3<Scalar> soft_unit(const Vector3<Scalar>& v) {
  using std::sqrt;
  return v * Scalar(Scalar(1) / sqrt(squared_norm(v) + Scalar(1e-6)));
}

}  // namespace diabolo
