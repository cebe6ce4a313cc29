// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "diabolo/parameters.hpp"

namespace diabolo::python {

/// Calls `visit(name, member, meaning)` for every field of Parameters that is not a number.
template <class Visitor>
void for_each_rule_member(Visitor&& visit) {
  using P = Parameters<double>;
  visit("string_law", &P::string_law, "how the string acts on the diabolo");
  visit("projection", &P::projection, "where a diabolo outside the spheroid is put back");
  visit("normal_rule", &P::normal_rule, "which direction counts as the spheroid's normal");
  visit("flight_rule", &P::flight_rule, "when the diabolo leaves the string and comes back to it");
  visit("thin_rule", &P::thin_rule, "what happens to the pull when the spheroid is thin");
  visit("spin_rule", &P::spin_rule, "how passing string drives the spin");
  visit("integrator", &P::integrator, "of the free motion");
  visit("per_step", &P::per_step,
        "apply the factors as if every step were a reference step, so that the motion depends on the step");
  visit("release_when_overstretched", &P::release_when_overstretched,
        "let go where the tips are farther apart than the string, instead of holding the diabolo");
  visit("planar", &P::planar, "keep the diabolo in the plane through its start square to plane_normal");
  visit("plane_normal", &P::plane_normal, "unit vector, shape (3,)");
}

/// Reads keyword arguments into fields. Throws py::type_error about unknown names and wrong types,
/// std::invalid_argument about values out of their range.
void assign_fields(Parameters<double>& parameters, const pybind11::kwargs& fields);

}  // namespace diabolo::python
