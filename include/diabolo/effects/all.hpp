// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/effects/string_elasticity.hpp"
#include "diabolo/predictor.hpp"

namespace diabolo {

/// Every effect of the library.
template <class Scalar>
using AllEffects = EffectSet<Scalar, StringElasticity>;

/// The predictor with every effect of the library, for models that are chosen at run time (model files,
/// Python). With all amplitudes at zero it gives the bits of the plain one.
template <class Scalar>
using FullPredictor = Predictor<Scalar, StringElasticity>;

}  // namespace diabolo
