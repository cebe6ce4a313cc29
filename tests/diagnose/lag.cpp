// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/fit_take.hpp"

using namespace diabolo;

namespace {

constexpr double kStep = 2e-3;

/// Tips that are told to follow `path(t)`, left and right alike, at each substep.
template <class Path>
std::vector<FitTips> commanded(const Path& path, int count) {
  std::vector<FitTips> grid(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const double t = static_cast<double>(k) * kStep, h = 1e-5;
    grid[k].tips.left = grid[k].tips.right = path(t);
    grid[k].tips.left_velocity = grid[k].tips.right_velocity = (path(t + h) - path(t - h)) / (2.0 * h);
  }
  return grid;
}

const Vector3<double> kBegin(0.1, 0.3, 1.2), kSpeed(0.4, -0.2, 0.1);

}  // namespace

TEST_CASE("tips that lag are tau behind a straight command") {
  const double tau = 0.03;
  std::vector<FitTips> grid = commanded([](double t) { return Vector3<double>(kBegin + kSpeed * t); }, 200);
  lag_behind(grid, kStep, tau);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const double t = static_cast<double>(k) * kStep;
    CHECK((grid[k].tips.left - (kBegin + kSpeed * (t - tau))).norm() < 1e-12);
    CHECK((grid[k].tips.right_velocity - kSpeed).norm() < 1e-9);
    CHECK((grid[k].left_by_lag + kSpeed).norm() < 1e-9);
    CHECK(grid[k].right_velocity_by_lag.norm() < 1e-6);
  }
}

TEST_CASE("of a swing a lag passes the amplitude and phase of a low pass of first order") {
  const double tau = 0.025, omega = 2.0 * std::numbers::pi * 2.0;
  std::vector<FitTips> grid =
      commanded([&](double t) { return Vector3<double>(kBegin + kSpeed * std::sin(omega * t)); }, 1000);
  lag_behind(grid, kStep, tau);
  const double gain = 1.0 / std::hypot(1.0, omega * tau), phase = std::atan(omega * tau);
  for (std::size_t k = 300; k < grid.size(); ++k) {  // once the start is forgotten
    const double t = static_cast<double>(k) * kStep;
    const Vector3<double> expected = kBegin + kSpeed * gain * std::sin(omega * t - phase);
    CHECK((grid[k].tips.left - expected).norm() < 2e-4 * kSpeed.norm());
  }
}

TEST_CASE("what a longer lag changes is what its derivatives say") {
  const auto path = [](double t) {
    return Vector3<double>(kBegin + kSpeed * std::sin(9.0 * t) +
                           Vector3<double>(0.0, 0.1, 0.2) * std::cos(4.0 * t));
  };
  const double tau = 0.02, more = 1e-5;
  std::vector<FitTips> grid = commanded(path, 300), shorter = grid, longer = grid;
  lag_behind(grid, kStep, tau);
  lag_behind(shorter, kStep, tau - more);
  lag_behind(longer, kStep, tau + more);
  for (std::size_t k = 20; k < grid.size(); ++k) {
    const Vector3<double> place = (longer[k].tips.left - shorter[k].tips.left) / (2.0 * more),
                          velocity =
                              (longer[k].tips.left_velocity - shorter[k].tips.left_velocity) / (2.0 * more);
    CHECK((grid[k].left_by_lag - place).norm() < 5e-3 * kSpeed.norm());
    CHECK((grid[k].left_velocity_by_lag - velocity).norm() < 5e-2 * kSpeed.norm() * 9.0);
  }
}
