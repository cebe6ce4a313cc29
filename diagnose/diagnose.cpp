// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/diagnosis.hpp"

namespace diabolo {

template Diagnosis diagnose<diagnose_detail::FitDual>(std::vector<Recording>, DiagnosisOptions,
                                                      const DiagnosisWatch&);

}  // namespace diabolo
