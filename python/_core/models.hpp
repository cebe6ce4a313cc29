// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "diabolo/effects/all.hpp"

namespace diabolo::python {

/// What is to be simulated: parameters, and effects beyond the paper.
struct Model {
  Parameters<double> parameters;
  AllEffects<double> effects;
};

/// Calls `visit(effect)` for each effect of a set.
template <class Set, class Visitor>
void for_each_effect(Set& set, Visitor&& visit) {
  std::apply([&](auto&... effect) { (visit(effect), ...); }, set.members);
}

}  // namespace diabolo::python
