// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace diabolo {

/// X of A X = B for a symmetric, semidefinite A, n x n, and B, n x m. (One function for all sizes: a program
/// that includes this library compiles one decomposition and not one for each.)
inline Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.ldlt().solve(b);
}

}  // namespace diabolo
