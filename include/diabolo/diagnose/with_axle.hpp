// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/model.hpp"

namespace diabolo {

/// Half the width of a groove whose string nobody has seen at its edge [m].
inline constexpr double kRoomyGroove = 0.01;

/// Whether no law of the axle is at work in a model without another gain.
inline bool needs_gain(const Model& model) { return model.effects.get<GyroscopicTilt>().gain == 0.0; }

/// The model with what laws of the axle add to its fields; `at` is zero but for their unknowns. An axle that
/// turns is where the strands begin: they leave it square to it, wherever it points.
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
