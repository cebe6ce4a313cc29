// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "diabolo/estimate/passage_noise.hpp"

namespace diabolo {

namespace estimate_detail {

/// What a strand's tension may be off by, in reading and model [N].
inline double tension_noise(const ProcessNoise& noise, const StrandPull& read) {
  return std::hypot(read.noise.row(0).norm(), noise.tension * read.tension);
}

/// The noise of a strand's reading with what the model's tension and direction may be off by [N]. A model's
/// error lasts, where a sensor's noise is another at each step: it counts kLasting times.
inline MatrixOf<3> noise_with_model(const ProcessNoise& noise, const StrandPull& read) {
  constexpr double kLasting = 4.0;
  MatrixOf<3> result = read.noise;
  result.row(0) *= std::hypot(1.0, kLasting * noise.tension * read.tension / result.row(0).norm());
  for (int across = 1; across < 3; ++across)
    result.row(across) *=
        std::hypot(1.0, kLasting * noise.direction * read.tension / result.row(across).norm());
  return result;
}

}  // namespace estimate_detail

/// The innovation gate: whether a tension is so far from what the string would have that it is of one that
/// gives, and bounces.
template <bool kAxle>
bool fails_gate(const ProcessNoise& noise, const Passage<kAxle>& passage, const StrandPulls& read) {
  using Points = typename Passage<kAxle>::Points;
  constexpr double kGate = 5.0;  // standard deviations
  constexpr int kPulls = Passage<kAxle>::kPulls;
  MatrixOf<kPulls, Points::kCount> pulls = passage.pulls;
  const ColumnOf<kPulls> expected = Points::deviate(pulls);
  for (int side = 0; side < 2; ++side) {
    const StrandPull& one = read[static_cast<std::size_t>(side)];
    const double deviation =
        std::hypot(pulls.row(3 * side).norm(), estimate_detail::tension_noise(noise, one));
    if (std::abs(one.tension - expected[3 * side]) > kGate * deviation) return true;
  }
  return false;
}

/// Updates a belief by pulls that were measured at the end of a step; `spread` are the deviations there.
template <bool kAxle>
void pull_update(const ProcessNoise& noise, const StrandPulls& read, const Passage<kAxle>& passage,
                 const StepDeviations<kAxle>& spread, Belief<kAxle>& now) {
  using Points = typename Passage<kAxle>::Points;
  constexpr int kSize = Belief<kAxle>::kSize, kPulls = Passage<kAxle>::kPulls;
  constexpr int kColumns = StepDeviations<kAxle>::ColsAtCompileTime;
  MatrixOf<kPulls, Points::kCount> pulls = passage.pulls;
  ColumnOf<kPulls> innovation = -Points::deviate(pulls);
  MatrixOf<kPulls> read_noise = MatrixOf<kPulls>::Zero();
  for (int side = 0; side < 2; ++side) {
    const StrandPull& one = read[static_cast<std::size_t>(side)];
    innovation[3 * side] += one.tension;
    read_noise.template block<3, 3>(3 * side, 3 * side) = estimate_detail::noise_with_model(noise, one);
  }
  MatrixOf<kPulls, kColumns> deviations = MatrixOf<kPulls, kColumns>::Zero();
  deviations.template leftCols<Points::kCount>() = pulls;
  const Correction<kSize> correction =
      condition<kSize, kPulls, kColumns>(spread, deviations, read_noise, innovation);
  now.normalized_innovation_squared = correction.normalized_innovation_squared / kPulls;
  now.update(correction);
}

}  // namespace diabolo
