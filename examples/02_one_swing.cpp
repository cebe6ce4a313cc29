// SPDX-License-Identifier: MIT
// 2. One swing: move both hands sideways once, and see how far the diabolo swings.
//
// The hands go 10 cm to the left and stay there; the diabolo, which hung still, swings on. How far depends on
// how long the hands took, so the example tries 200 durations in one batch.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "diabolo/batch/batch.hpp"
#include "diabolo/string/hanging.hpp"

namespace {

constexpr double kSideways = 0.10, kHalfSpan = 0.25, kHeight = 1.2;  // [m]

/// Both tips to the left within `duration` [s], smoothly.
diabolo::TipMotion<double> sway(double duration) {
  std::vector<double> times;
  std::vector<diabolo::Vector3<double>> left, right;
  for (int i = 0; i <= 600; ++i) {
    const double time = 0.01 * i, s = std::min(time / duration, 1.0);
    const double y = kSideways * s * s * (3.0 - 2.0 * s);
    times.push_back(time);
    left.emplace_back(0.0, y + kHalfSpan, kHeight);
    right.emplace_back(0.0, y - kHalfSpan, kHeight);
  }
  return {times, left, right, diabolo::Interpolation::kSpline};
}

}  // namespace

int main() {
  constexpr std::size_t kCount = 200;
  const auto duration = [](std::size_t i) { return 0.2 + 2.8 * static_cast<double>(i) / (kCount - 1); };
  std::vector<diabolo::TipMotion<double>> motions;
  for (std::size_t i = 0; i < kCount; ++i) motions.push_back(sway(duration(i)));

  diabolo::Batch batch;
  batch.parameters.resize(1);  // the default: an inextensible string of 1.45 m
  const diabolo::Tips<double> tips = motions[0].at(0.0);
  batch.initial.assign(
      kCount, diabolo::hanging_state(tips.left, tips.right, batch.parameters[0].string_length, 100.0));
  for (const diabolo::TipMotion<double>& motion : motions) batch.motions.push_back(&motion);
  batch.steps = {.begin = 0.0, .dt = 1e-3, .count = 6000};
  batch.record_every = 10;

  const std::atomic<bool> cancel = false;
  const diabolo::BatchResult result = rollout_batch(batch, diabolo::portable_batch_kernel(), 0, cancel);
  std::printf("%zu rollouts of %.0f s each: %zu states\n", kCount, batch.steps.time(batch.steps.count),
              result.records.size() / 7);

  // Once the hands rest, the swing has the width that it will keep: nothing takes energy from it.
  std::vector<double> amplitude;
  for (std::size_t i = 0; i < kCount; ++i) {
    double leftmost = -1.0, rightmost = 1.0;
    for (std::size_t frame = 300; frame < batch.records(); ++frame) {
      const double y = result.records[7 * (i * batch.records() + frame) + 1];
      leftmost = std::max(leftmost, y);
      rightmost = std::min(rightmost, y);
    }
    amplitude.push_back(0.5 * (leftmost - rightmost));
  }
  const std::size_t calmest =
      static_cast<std::size_t>(std::ranges::min_element(amplitude) - amplitude.begin());
  std::printf("hands that take %.2f s leave a swing of +-%.1f cm,\n", duration(0), 100.0 * amplitude[0]);
  std::printf("the calmest ones take %.2f s: +-%.1f cm\n", duration(calmest), 100.0 * amplitude[calmest]);
}
