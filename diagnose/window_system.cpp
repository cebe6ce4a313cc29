// SPDX-License-Identifier: MIT
// Compiled once for each length of the duals, whose index is DIABOLO_DIAGNOSE_LENGTH.
#include "diabolo/diagnose/compiled.hpp"

namespace diabolo {

using D = detail::CompiledDual<DIABOLO_DIAGNOSE_LENGTH>;

template WindowSystem window_system(const Stage&, const std::vector<StageTips>&, const FitWindow&,
                                    const detail::FitModel<D>&, const detail::Carried<D>&, Delay, bool);

}  // namespace diabolo
