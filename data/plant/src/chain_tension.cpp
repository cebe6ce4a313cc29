// SPDX-License-Identifier: MIT
#include "chain_tension.hpp"

namespace plant {

TensionSystem::TensionSystem(const std::vector<Spring>& springs, double step)
    : springs_(springs),
      step_(step),
      gains_(springs.size()),
      lower_(springs.size()),
      upper_(springs.size()),
      pivots_(springs.size()) {
  const std::size_t count = springs.size();
  double eliminated = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Spring& spring = springs[i];
    const bool pulls = spring.excess > 0.0;
    gains_[i] = pulls ? 0.25 * step * spring.stiffness + spring.damping : 0.0;
    const double gain = gains_[i] * step;
    const double own =
        spring.pulls[0].dot(spring.yields[0]) + spring.pulls[1].dot(spring.yields[1]) + spring.axle_yield;
    lower_[i] = i > 0 ? gain * spring.pulls[0].dot(springs[i - 1].yields[1]) : 0.0;
    pivots_[i] = 1.0 / (1.0 + gain * own - lower_[i] * eliminated);
    upper_[i] = i + 1 < count ? pivots_[i] * gain * spring.pulls[1].dot(springs[i + 1].yields[0]) : 0.0;
    eliminated = upper_[i];
  }
}

void TensionSystem::solve(std::vector<double>& values) const {
  values[0] *= pivots_[0];
  for (std::size_t i = 1; i < values.size(); ++i) {
    values[i] = (values[i] - lower_[i] * values[i - 1]) * pivots_[i];
  }
  for (std::size_t i = values.size() - 1; i-- > 0;) values[i] -= upper_[i] * values[i + 1];
}

std::vector<double> TensionSystem::tensions() const {
  std::vector<double> values(springs_.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Spring& spring = springs_[i];
    if (!(spring.excess > 0.0)) continue;
    values[i] = spring.stiffness * (spring.excess + 0.25 * step_ * (spring.free_rate - spring.rate)) +
                spring.damping * spring.free_rate;
  }
  solve(values);
  return values;
}

std::vector<double> TensionSystem::response(std::vector<double> rate_changes) const {
  for (std::size_t i = 0; i < rate_changes.size(); ++i) rate_changes[i] *= gains_[i];
  solve(rate_changes);
  return rate_changes;
}

}  // namespace plant
