// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "diabolo/full_predictor.hpp"
#include "diabolo/plan/ranges.hpp"
#include "diabolo/plan/tip_path.hpp"
#include "diabolo/predictor.hpp"

namespace diabolo {

/// What a plan leads to, at an instant.
template <class Scalar>
struct PlayInstant {
  double time;  ///< [s]
  State<Scalar> state;
  Tips<Scalar> tips;
  bool caught = false;  ///< in the step that ended here
};

/// A prediction, step by step.
template <class Scalar>
struct Play {
  std::vector<PlayInstant<Scalar>> instants;  ///< the start first
  std::size_t planned = 0;                    ///< instants within the path; later ones see the flight's end
  double gravity = kStandardGravity;          ///< [m/s^2]

  const PlayInstant<Scalar>& end() const { return instants[planned - 1]; }
};

/// How a play is predicted.
struct PlayOptions {
  double dt = 4e-3;     ///< longest step [s]
  double flight = 0.0;  ///< of a diabolo that flies at the end of the path, so much more is predicted [s],
  double down_to =
      -std::numeric_limits<double>::infinity();  ///< but no more once it falls below this height [m]
};

/// Throws std::invalid_argument where a diabolo in play cannot be in that state.
inline void check_state(const std::string& what, const State<double>& state) {
  check_size(what + ", position", state.position.stableNorm(), kFarthest, "m");
  check_size(what + ", velocity", state.velocity.stableNorm(), kFastest, "m/s");
  check_size(what + ", spin", state.spin, kMostSpin, "rad/s");
}

/// Predicts what a path leads to from `start`, the state at its begin; the sticks' tips then rest. A flight
/// is followed for PlayOptions::flight after the path.
template <class Scalar, template <class> class... Effects>
Play<Scalar> play(const Predictor<Scalar, Effects...>& predictor, const State<double>& start,
                  const TipPath<Scalar>& path, const PlayOptions& options) {
  Play<Scalar> result;
  result.gravity = static_cast<double>(value_of(predictor.parameters().gravity));
  // Times carry derivatives too: a change of the path's duration moves all instants with it.
  const Scalar begin = path.begin(), duration = path.end() - path.begin();
  const auto number = [](const Scalar& x) { return static_cast<double>(value_of(x)); };
  const auto count =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(number(duration) / options.dt - 1e-9)));
  const Scalar dt = duration * Scalar(1.0 / static_cast<double>(count));
  std::size_t hint = 0;
  result.instants.reserve(count + 1);
  result.instants.push_back({number(begin), state_in<Scalar>(start), path.at(begin, hint)});
  const auto step = [&](const Scalar& time, const Scalar& length) {
    PlayInstant<Scalar> next = result.instants.back();
    next.time = number(time);
    next.tips = path.at(time, hint);
    next.caught = predictor.step(next.state, result.instants.back().tips, next.tips, length).caught;
    result.instants.push_back(next);
  };
  for (std::size_t i = 1; i <= count; ++i)
    step(i == count ? path.end() : Scalar(begin + dt * Scalar(static_cast<double>(i))), dt);
  result.planned = result.instants.size();
  const auto more = static_cast<std::size_t>(options.flight / options.dt);
  const auto flies_on = [&] {
    const State<Scalar>& state = result.instants.back().state;
    const bool below = number(state.velocity.z()) <= 0.0 && number(state.position.z()) <= options.down_to;
    return is(state.string_state, StringState::kFlying) && !below;
  };
  for (std::size_t i = 1; i <= more && flies_on(); ++i)
    step(path.end() + Scalar(options.dt * static_cast<double>(i)), Scalar(options.dt));
  return result;
}

}  // namespace diabolo
