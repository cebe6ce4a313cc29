// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>

// Square-root unscented filtering (van der Merwe and Wan, ICASSP 2001) of Gaussians that are kept as a lower
// Cholesky factor L of their covariance L L'. All weights are positive, so that one triangularisation gives
// gain and factor together (Arasaratnam and Haykin, IEEE TAC 2009, eq. 38-44): the downdates of the original,
// which may fail by rounding, are not needed.
namespace diabolo {

template <int Size>
using ColumnOf = Eigen::Matrix<double, Size, 1>;
template <int Rows, int Columns = Rows>
using MatrixOf = Eigen::Matrix<double, Rows, Columns>;

namespace estimate_detail {

/// Makes all below the diagonal zero and keeps A' A, by Householder's reflections. Takes any size, so that it
/// compiles once, and never allocates.
inline void make_upper(Eigen::Ref<Eigen::MatrixXd> a) {
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    auto mirror = a.col(i).tail(a.rows() - i);
    const double norm = mirror.norm(), turned = -std::copysign(norm, mirror[0]);
    mirror[0] -= turned;
    for (Eigen::Index j = i + 1; norm != 0.0 && j < a.cols(); ++j) {
      auto column = a.col(j).tail(a.rows() - i);
      column += mirror * (mirror.dot(column) / (mirror[0] * turned));
    }
    mirror.setZero();
    mirror[0] = turned;
  }
}

}  // namespace estimate_detail

/// The lower triangular L with no negative diagonal and L L' = A A'. Never allocates.
template <int Rows, int Columns>
MatrixOf<Rows> lower_factor(const MatrixOf<Rows, Columns>& a) {
  static_assert(Columns >= Rows);
  MatrixOf<Columns, Rows> upper = a.transpose();
  estimate_detail::make_upper(upper);
  MatrixOf<Rows> lower = upper.template topRows<Rows>().transpose();
  for (int i = 0; i < Rows; ++i)
    if (lower(i, i) < 0.0) lower.col(i) = -lower.col(i);
  return lower;
}

/// The points that stand for a Gaussian of N numbers: its mean, and two along each column of its factor.
template <int N>
struct SigmaPoints {
  static constexpr int kCount = 2 * N + 1;
  static constexpr double kCentre = 1.0;  ///< kappa of Julier and Uhlmann; above zero, so that weights are

  static double weight(int point) { return (point == 0 ? kCentre : 0.5) / (N + kCentre); }

  /// Of a point from the mean.
  static ColumnOf<N> offset(const MatrixOf<N>& factor, int point) {
    if (point == 0) return ColumnOf<N>::Zero();
    const double reach = std::sqrt(N + kCentre) * (point % 2 == 1 ? 1.0 : -1.0);
    return factor.col((point - 1) / 2) * reach;
  }

  /// Values at the points, as columns, become deviations from their mean times the roots of the weights: S
  /// with S S' their covariance. Returns the mean.
  template <int Rows>
  static ColumnOf<Rows> deviate(MatrixOf<Rows, kCount>& values) {
    ColumnOf<Rows> mean = ColumnOf<Rows>::Zero();
    for (int i = 0; i < kCount; ++i) mean += values.col(i) * weight(i);
    for (int i = 0; i < kCount; ++i) values.col(i) = (values.col(i) - mean) * std::sqrt(weight(i));
    return mean;
  }
};

/// What K measured numbers say of N others.
template <int N>
struct Correction {
  ColumnOf<N> shift;                       ///< of the mean
  MatrixOf<N> factor;                      ///< of the covariance that is left
  double normalized_innovation_squared{};  ///< innovation squared over its covariance; K on average
};

/// Conditions N numbers on K measured ones that are off by `innovation` from what was expected. `x` and `y`
/// are deviations of both, M columns that belong together; `noise` is a factor of the measurement's
/// covariance.
template <int N, int K, int M>
Correction<N> condition(const MatrixOf<N, M>& x, const MatrixOf<K, M>& y, const MatrixOf<K>& noise,
                        const ColumnOf<K>& innovation) {
  MatrixOf<K + N, M + K> both;
  both << y, noise, x, MatrixOf<N, K>::Zero();
  const MatrixOf<K + N> lower = lower_factor<K + N, M + K>(both);
  const ColumnOf<K> white =
      lower.template topLeftCorner<K, K>().template triangularView<Eigen::Lower>().solve(innovation);
  return {lower.template bottomLeftCorner<N, K>() * white, lower.template bottomRightCorner<N, N>(),
          white.squaredNorm()};
}

}  // namespace diabolo
