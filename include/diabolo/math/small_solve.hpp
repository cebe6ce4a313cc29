// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// Solves a x = b by elimination with pivots chosen on the values, for the few unknowns of an arm and any
/// Scalar; false, with `b` in no certain state, where `a` is singular to the last digit. `b` becomes x.
template <class Scalar, int N>
bool solve_in_place(Eigen::Matrix<Scalar, N, N> a, Eigen::Matrix<Scalar, N, 1>& b) {
  for (int k = 0; k < N; ++k) {
    int pivot = k;
    for (int row = k + 1; row < N; ++row)
      if (std::abs(plain(a(row, k))) > std::abs(plain(a(pivot, k)))) pivot = row;
    if (!(std::abs(plain(a(pivot, k))) > 0.0)) return false;
    if (pivot != k) {
      for (int column = k; column < N; ++column) std::swap(a(k, column), a(pivot, column));
      std::swap(b[k], b[pivot]);
    }
    for (int row = k + 1; row < N; ++row) {
      const Scalar factor = a(row, k) / a(k, k);
      for (int column = k + 1; column < N; ++column) a(row, column) -= factor * a(k, column);
      b[row] -= factor * b[k];
    }
  }
  for (int k = N - 1; k >= 0; --k) {
    for (int column = k + 1; column < N; ++column) b[k] -= a(k, column) * b[column];
    b[k] /= a(k, k);
  }
  return true;
}

}  // namespace diabolo
