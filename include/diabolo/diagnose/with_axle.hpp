// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/model.hpp"

namespace diabolo {

/// Half the width of a groove whose string nobody has seen at its edge [m].
inline constexpr double kRoomyGroove = 0.01;

/// Whether no law of the axle is at work in a model without another gain.
inline bool needs_gain(const Model& model) { return model.effects.get<GyroscopicTilt>().gain == 0.0; }

/// Whether strands leave the axle square to it, as a rigid diabolo's do, wherever it points.
inline bool strands_follow_axle(const Model& model) {
  return model.effects.get<FiniteAxle>().follows_axis > 0.5;
}

/// What a model has of a law of the axle.
inline double own_of_axle(const Model& model, int law) {
  double own = 0.0;
  for_each_unknown(model.effects, [&](Unknown u, double field) {
    if (index_of(u) == law) own = field;
  });
  return own;
}

/// What may be added to that: its search bounds, and down to nothing of what the model has.
inline Interval addition_to_axle(const Model& model, int law) {
  const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(law)];
  const double none = -own_of_axle(model, law);
  return {std::min(info.minimum, none), std::max(info.maximum, none)};
}

/// The model with what laws of the axle add to its fields; `at` is zero but for their unknowns. An axle that
/// turns is where the strands begin: they follow it, whether the model has them do so or not.
inline Model with_axle(const Model& model, const UnknownVector& at) {
  Model result = model;
  for_each_unknown(result.effects, [&](Unknown u, double& field) { field += at[index_of(u)]; });
  if (!needs_gain(result)) result.effects.get<FiniteAxle>().follows_axis = 1.0;
  auto& groove = result.effects.get<Groove>();
  if (at[index_of(Unknown::kGrooveProfile)] > 0.0 && groove.half_width == 0.0)
    groove.half_width = kRoomyGroove;
  return result;
}

}  // namespace diabolo
