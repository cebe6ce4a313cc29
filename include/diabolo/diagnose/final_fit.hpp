// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/fit.hpp"
#include "diabolo/model.hpp"

namespace diabolo {

/// Where a diagnosis ended: what it fitted, and to what. Another question may go on from there.
struct FinalFit {
  Model physics;   ///< that the unknowns add to; learnt laws are in it
  Fit fit;         ///< with the takes and the systems of their windows
  ActiveSet free;  ///< which unknowns were
  Bank bank{};     ///< what may be there, but for what data that were held out deny
  UnknownVector axle = UnknownVector::Zero(), axle_deviation = axle;  ///< of laws that turn it, fitted beside
  bool stands = true;  ///< else what was found is withdrawn, and the model is the base
};

}  // namespace diabolo
