// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/estimate/tick.hpp"

namespace diabolo {

/// What became of a measurement.
enum class MeasurementStatus {
  kAccepted,
  kTooOld,    ///< from before the history
  kTooNew,    ///< from after the last step
  kDuplicate  ///< its step has one of that kind already
};

/// The last ticks of an estimator, in a ring. Number 0 is the last one; the first of all is the beginning,
/// without a step. Allocates in its constructor alone.
template <bool kAxle>
class TickHistory {
 public:
  /// Throws std::invalid_argument where the steps that may be gone back are too many.
  TickHistory(std::size_t steps, const Belief<kAxle>& start, const Tips<double>& tips)
      : ticks_(checked(steps) + 1) {
    Tick<kAxle>& first = ticks_.front();
    first.before = first.after = start;
    first.begin = first.end = tips;
  }

  Tick<kAxle>& operator[](std::size_t ago) { return ticks_[(count_ - 1 - ago) % ticks_.size()]; }
  const Tick<kAxle>& operator[](std::size_t ago) const { return ticks_[(count_ - 1 - ago) % ticks_.size()]; }
  /// How many steps may be gone back by now.
  std::size_t steps() const { return std::min(count_, ticks_.size()) - 1; }

  /// Adds a step to these tips in `dt` [s], of which nothing is measured yet.
  Tick<kAxle>& add(const Tips<double>& tips, double dt) {
    const Belief<kAxle> before = (*this)[0].after;
    const Tips<double> begin = (*this)[0].end;
    ++count_;
    Tick<kAxle>& next = (*this)[0];
    next.before = before;
    next.begin = begin;
    next.end = tips;
    next.dt = dt;
    next.pulls = {};
    next.camera.reset();
    return next;
  }

  /// The tick whose end is nearest to a time [s].
  MeasurementStatus find(double time, std::size_t& ago) const {
    const double half = 0.5 * (*this)[0].dt + 1e-9;
    if (time > (*this)[0].after.time + half) return MeasurementStatus::kTooNew;
    ago = 0;
    while (ago < steps() && time < middle(ago)) ++ago;
    return time < middle(ago) - 1e-9 ? MeasurementStatus::kTooOld : MeasurementStatus::kAccepted;
  }

 private:
  static constexpr std::size_t kLongest = 100'000;  // steps

  static std::size_t checked(std::size_t steps) {
    if (steps <= kLongest) return steps;
    throw std::invalid_argument("estimator, history: " + std::to_string(steps) + " steps; expected at most " +
                                std::to_string(kLongest));
  }

  double middle(std::size_t ago) const { return (*this)[ago].after.time - 0.5 * (*this)[ago].dt; }

  std::vector<Tick<kAxle>> ticks_;
  std::size_t count_ = 1;  ///< of ticks ever
};

}  // namespace diabolo
