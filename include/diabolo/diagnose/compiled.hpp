// SPDX-License-Identifier: MIT
#pragma once

#include <iterator>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/window_rollout.hpp"

// What diabolo::diagnose has compiled of a diagnosis' parts. A program that links it and calls fit.hpp,
// refine.hpp and others itself includes this header too, and compiles them in a fraction of the time.
namespace diabolo {

namespace diagnose_detail {

// As many as linearize() tells apart, as are declared below, and as diagnose/CMakeLists.txt lists for its
// units.
static_assert(std::size(kLengths) == 4);

/// The duals of a diagnosis, by the index of their length.
template <int Index>
using CompiledDual = Shortened<FitDual, kLengths[Index]>;

}  // namespace diagnose_detail

extern template Diagnosis diagnose<diagnose_detail::FitDual>(std::vector<Recording>, DiagnosisOptions,
                                                             const DiagnosisWatch&);

extern template diagnose_detail::FitModel<diagnose_detail::CompiledDual<0>> diagnose_detail::fit_model(
    const Model&, const Recording&, const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<0>>&);
extern template diagnose_detail::FitModel<diagnose_detail::CompiledDual<1>> diagnose_detail::fit_model(
    const Model&, const Recording&, const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<1>>&);
extern template diagnose_detail::FitModel<diagnose_detail::CompiledDual<2>> diagnose_detail::fit_model(
    const Model&, const Recording&, const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<2>>&);
extern template diagnose_detail::FitModel<diagnose_detail::CompiledDual<3>> diagnose_detail::fit_model(
    const Model&, const Recording&, const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<3>>&);

extern template WindowSystem window_system(
    const Take&, const FitWindow&, const diagnose_detail::FitModel<diagnose_detail::CompiledDual<0>>&,
    const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<0>>&, Delay, bool);
extern template WindowSystem window_system(
    const Take&, const FitWindow&, const diagnose_detail::FitModel<diagnose_detail::CompiledDual<1>>&,
    const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<1>>&, Delay, bool);
extern template WindowSystem window_system(
    const Take&, const FitWindow&, const diagnose_detail::FitModel<diagnose_detail::CompiledDual<2>>&,
    const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<2>>&, Delay, bool);
extern template WindowSystem window_system(
    const Take&, const FitWindow&, const diagnose_detail::FitModel<diagnose_detail::CompiledDual<3>>&,
    const diagnose_detail::DualUnknowns<diagnose_detail::CompiledDual<3>>&, Delay, bool);

}  // namespace diabolo
