// SPDX-License-Identifier: MIT
// Compiled once for each length of the duals, whose index is DIABOLO_DIAGNOSE_LENGTH.
#include "diabolo/diagnose/compiled.hpp"

namespace diabolo {

using D = diagnose_detail::CompiledDual<DIABOLO_DIAGNOSE_LENGTH>;

template diagnose_detail::FitModel<D> diagnose_detail::fit_model(const Model&, const Recording&,
                                                                 const diagnose_detail::DualUnknowns<D>&);
template WindowSystem window_system(const Take&, const FitWindow&, const diagnose_detail::FitModel<D>&,
                                    const diagnose_detail::DualUnknowns<D>&, Delay, bool);

}  // namespace diabolo
