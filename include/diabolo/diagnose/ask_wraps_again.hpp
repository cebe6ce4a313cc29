// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "diabolo/diagnose/alternatives.hpp"

namespace diabolo {

/// Takes the string off the axle again where, beside laws that were learnt since, it does as well without:
/// the wrap is a tie where it leaves less, and else nothing.
template <class D = diagnose_detail::FitDual>
void ask_wraps_again(Fit& fit, const ActiveSet& set, std::vector<Replacement>& exchanged, const Model& base,
                     int threads, const FitWatch& watch) {
  if (fit.at[index_of(Unknown::kWraps)] == 0.0) return;
  descend<D>(fit, base, set, kMostIterations, threads, watch);  // so that costs can be compared
  linearize<D>(fit, base, threads, watch);
  Fit trial =
      diagnose_detail::refitted<D>(fit, wrapped("string_friction", fit, set, 0.0), base, threads, watch);
  if (watch.is_enough() || trial.cost - fit.cost >= kAsGood * fit.dispersion) return;
  linearize<D>(trial, base, threads, watch);
  const auto wrap = std::ranges::find(exchanged, "string_wrap", &Replacement::name);
  if (wrap != exchanged.end() && trial.cost > fit.cost)
    *wrap = {"string_friction", {"string_wrap"}, wrap->z};
  else if (wrap != exchanged.end())
    exchanged.erase(wrap);
  fit = std::move(trial);
}

}  // namespace diabolo
