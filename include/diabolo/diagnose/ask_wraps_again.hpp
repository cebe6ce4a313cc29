// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "diabolo/diagnose/alternatives.hpp"

namespace diabolo {

/// Takes the string off the axle again where, beside laws that were learnt since, it does as well without.
template <class D = diagnose_detail::FitDual>
void ask_wraps_again(Fit& fit, const ActiveSet& set, std::vector<Replacement>& exchanged, const Model& base,
                     int threads, const FitWatch& watch) {
  if (fit.at[index_of(Unknown::kWraps)] == 0.0) return;
  Fit trial =
      diagnose_detail::refitted<D>(fit, wrapped("string_friction", fit, set, 0.0), base, threads, watch);
  if (watch.is_enough() || trial.cost - fit.cost >= kAsGood * fit.dispersion) return;
  linearize<D>(trial, base, threads, watch);
  fit = std::move(trial);
  std::erase_if(exchanged, [](const Replacement& exchange) { return exchange.name == "string_wrap"; });
}

}  // namespace diabolo
