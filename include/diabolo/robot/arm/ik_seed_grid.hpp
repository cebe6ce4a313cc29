// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/robot/arm/joints.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A box of the workspace and how many key points it has along x, y and z.
struct GridBox {
  Vector3<double> lower, upper;  ///< [m, world]
  std::array<int, 3> knots{6, 7, 7};

  bool contains(const Vector3<double>& point) const {
    for (int axis = 0; axis < 3; ++axis)
      if (!(point[axis] >= lower[axis] && point[axis] <= upper[axis])) return false;
    return true;
  }
  double spacing(int axis) const {
    return (upper[axis] - lower[axis]) / (knots[static_cast<std::size_t>(axis)] - 1);
  }
  std::size_t size() const {
    return static_cast<std::size_t>(knots[0]) * static_cast<std::size_t>(knots[1]) *
           static_cast<std::size_t>(knots[2]);
  }
  /// The key point with these numbers [m].
  Vector3<double> knot(int x, int y, int z) const {
    const std::array<int, 3> index{x, y, z};
    Vector3<double> point;
    for (int axis = 0; axis < 3; ++axis) {
      const int i = index[static_cast<std::size_t>(axis)];
      point[axis] =
          i + 1 == knots[static_cast<std::size_t>(axis)] ? upper[axis] : lower[axis] + i * spacing(axis);
    }
    return point;
  }
  /// Its place in a list that runs along z first and along x last.
  std::size_t place(int x, int y, int z) const {
    const auto size = [](int count) { return static_cast<std::size_t>(count); };
    return (size(x) * size(knots[1]) + size(y)) * size(knots[2]) + size(z);
  }
};

/// How joints are read between the key points.
enum class GridInterpolation {
  kLinear,  ///< in each direction (the authors' program): the joints' speed jumps from cell to cell
  kCubic,   ///< a natural cubic spline in each direction: continuous up to the second derivative
};

/// A joint configuration at each key point of a box, and in between: where the solver starts, so that it
/// always comes out at the same way of holding the stick (paper, section III-D).
class IkSeedGrid {
 public:
  using Slopes = Eigen::Matrix<double, kJointCount, 3>;
  struct Seed {
    Joints<double> joints;  ///< [rad]
    Slopes slopes;          ///< over the point [rad/m]
  };

  /// `joints` [rad] in the order of GridBox::place. Throws std::invalid_argument where the box is empty, has
  /// less than two key points along an axis or more than a thousand, or the joints are not as many or not
  /// finite.
  IkSeedGrid(const GridBox& box, std::vector<Joints<double>> joints,
             GridInterpolation interpolation = GridInterpolation::kCubic)
      : box_(box), joints_(std::move(joints)), interpolation_(interpolation) {
    check();
    weights_ = joints_;
    if (interpolation_ == GridInterpolation::kCubic)
      for (int axis = 0; axis < 3; ++axis) weigh(axis);
  }

  const GridBox& box() const { return box_; }
  const std::vector<Joints<double>>& joints() const { return joints_; }
  GridInterpolation interpolation() const { return interpolation_; }

  /// At a point [m, world]; outside the box, that of its nearest point.
  Seed at(const Vector3<double>& point) const {
    std::array<Stencil, 3> stencils;
    for (int axis = 0; axis < 3; ++axis)
      stencils[static_cast<std::size_t>(axis)] = stencil(axis, point[axis]);
    const auto& [x, y, z] = stencils;
    Seed seed;
    seed.joints.setZero();
    seed.slopes.setZero();
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const double xy = x.weight[i] * y.weight[j];
        const double dx = x.slope[i] * y.weight[j], dy = x.weight[i] * y.slope[j];
        Joints<double> line = Joints<double>::Zero(), rise = line;
        for (std::size_t k = 0; k < 4; ++k) {
          const Joints<double>& value = weights_[box_.place(x.knot[i], y.knot[j], z.knot[k])];
          line += value * z.weight[k];
          rise += value * z.slope[k];
        }
        seed.joints += xy * line;
        seed.slopes.col(0) += dx * line;
        seed.slopes.col(1) += dy * line;
        seed.slopes.col(2) += xy * rise;
      }
    return seed;
  }

 private:
  /// The four key points that count along an axis, and how much.
  struct Stencil {
    std::array<int, 4> knot;
    std::array<double, 4> weight, slope;
  };

  Stencil stencil(int axis, double coordinate) const {
    const int last = box_.knots[static_cast<std::size_t>(axis)] - 1;
    const double h = box_.spacing(axis);
    const double at = std::clamp((coordinate - box_.lower[axis]) / h, 0.0, static_cast<double>(last));
    const int cell = std::min(static_cast<int>(at), last - 1);
    const double u = at - cell, v = 1.0 - u;
    Stencil w{};
    w.knot = {cell - 1, cell, cell + 1, cell + 2};
    if (interpolation_ == GridInterpolation::kLinear) {
      w.weight = {0, v, u, 0};
      w.slope = {0, -1 / h, 1 / h, 0};
    } else {
      w.weight = {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6,
                  u * u * u / 6};
      w.slope = {-v * v / (2 * h), (3 * u * u - 4 * u) / (2 * h), -(3 * v * v - 4 * v) / (2 * h),
                 u * u / (2 * h)};
    }
    // A natural spline goes on in a straight line: the weight beyond the end is twice the last less the next.
    if (cell == 0) fold(w, 0, 1, 2);
    if (cell == last - 1) fold(w, 3, 2, 1);
    return w;
  }

  static void fold(Stencil& w, std::size_t beyond, std::size_t end, std::size_t next) {
    for (std::array<double, 4>* values : {&w.weight, &w.slope}) {
      (*values)[end] += 2 * (*values)[beyond];
      (*values)[next] -= (*values)[beyond];
      (*values)[beyond] = 0;
    }
    w.knot[beyond] = w.knot[end];
  }

  /// Solves (c[i-1] + 4 c[i] + c[i+1]) / 6 = value along an axis; the two ends are their own weights.
  void weigh(int axis) {
    std::array<int, 3> n = box_.knots;
    const int count = std::exchange(n[static_cast<std::size_t>(axis)], 1);
    std::vector<double> factor(static_cast<std::size_t>(count));
    for (int x = 0; x < n[0]; ++x)
      for (int y = 0; y < n[1]; ++y)
        for (int z = 0; z < n[2]; ++z) {
          const auto weight = [&](int i) -> Joints<double>& {
            return weights_[box_.place(axis == 0 ? i : x, axis == 1 ? i : y, axis == 2 ? i : z)];
          };
          factor[0] = 0;
          for (int i = 1; i + 1 < count; ++i) {
            const std::size_t k = static_cast<std::size_t>(i);
            const double pivot = 4 - factor[k - 1];
            factor[k] = 1 / pivot;
            weight(i) = (6 * weight(i) - weight(i - 1)) / pivot;
          }
          for (int i = count - 2; i > 0; --i)
            weight(i) -= factor[static_cast<std::size_t>(i)] * weight(i + 1);
        }
  }

  void check() const {
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name = std::string("grid, ") + "xyz"[axis] + ": ";
      const int knots = box_.knots[static_cast<std::size_t>(axis)];
      if (!(box_.lower[axis] < box_.upper[axis]) || !std::isfinite(box_.upper[axis] - box_.lower[axis]))
        throw std::invalid_argument(name + shown(box_.lower[axis]) + " to " + shown(box_.upper[axis]) +
                                    " m; must grow");
      if (knots < 2 || knots > 1000)
        throw std::invalid_argument(name + std::to_string(knots) + " key points; must be within [2, 1000]");
    }
    if (joints_.size() != box_.size())
      throw std::invalid_argument("grid: " + std::to_string(joints_.size()) +
                                  " joint configurations; expected " + std::to_string(box_.size()) +
                                  ", one for each key point");
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (!all_finite(joints_[i]))
        throw std::invalid_argument("grid, key point " + std::to_string(i) + ": an angle is not finite");
  }

  GridBox box_;
  std::vector<Joints<double>> joints_, weights_;
  GridInterpolation interpolation_;
};

}  // namespace diabolo
