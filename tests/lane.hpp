// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/math/pack.hpp"

// One lane of a scalar, vector or mask as a plain number, and back; a plain scalar is its only lane.

template <class Scalar>
double lane(const Scalar& x, int i) {
  if constexpr (diabolo::ScalarTraits<Scalar>::kLanes == 1)
    return static_cast<double>(x);
  else
    return static_cast<double>(x[i]);
}
template <class Scalar>
diabolo::Vector3<double> lane(const diabolo::Vector3<Scalar>& v, int i) {
  return {lane<Scalar>(v[0], i), lane<Scalar>(v[1], i), lane<Scalar>(v[2], i)};
}
inline bool lane(bool x, int /*i*/) { return x; }
template <class T, int Lanes>
bool lane(const diabolo::PackMask<T, Lanes>& x, int i) {
  return x[i];
}
template <class Scalar>
void set_lane(Scalar& x, int i, double value) {
  if constexpr (diabolo::ScalarTraits<Scalar>::kLanes == 1)
    x = static_cast<Scalar>(value);
  else
    x.set(i, static_cast<diabolo::ValueOf<Scalar>>(value));
}
template <class Scalar>
void set_lane(diabolo::Vector3<Scalar>& v, int i, const diabolo::Vector3<double>& value) {
  for (int k = 0; k < 3; ++k) set_lane(v[k], i, value[k]);
}
