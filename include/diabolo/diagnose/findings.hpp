// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/evidence.hpp"
#include "diabolo/diagnose/experiments.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/diagnose/open_law.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"

namespace diabolo {

/// What a window says of the latent accelerations that are not in the fit, in standard deviations; NaN where
/// it says nothing.
inline std::array<double, kLatents> latent_z(const WindowScore& score) {
  std::array<double, kLatents> z;
  for (int k = 0; k < kLatents; ++k) {
    const double information = score.information(kLatentFirst + k, kLatentFirst + k);
    z[static_cast<std::size_t>(k)] =
        information > 1e-6 ? score.score[kLatentFirst + k] / std::sqrt(information) : kNaN;
  }
  return z;
}

/// Takes down how the base alone does, window by window.
inline void remember_before(Diagnosis& result, const Fit& fit) {
  std::size_t i = 0;
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s)
    for (const FitWindow& window : fit.fit_takes[s].windows) {
      const WindowSystem& system = fit.systems[i++];
      WindowFinding found{};
      found.recording = s;
      found.begin = fit.fit_takes[s].take->times[window.first];
      found.end = fit.fit_takes[s].take->times[window.last];
      found.mode = window.start.string_state;
      found.eventful = changes_state(*fit.fit_takes[s].take, window);
      found.residual_before = system.position_residual();
      if (system.spin_numbers > 0) found.spin_before = std::sqrt(system.spin_square / system.spin_numbers);
      found.z.fill(kNaN);
      found.z_after.fill(kNaN);
      result.windows.push_back(found);
    }
}

/// Takes down what is left out direction by direction, of the base alone, whose windows were `before`, and
/// with what was found: both in units of the noise as it is known at the end.
inline void remember_directions(Diagnosis& result, const std::vector<WindowSystem>& before, const Fit& fit) {
  for (std::size_t i = 0; i < result.windows.size(); ++i) {
    WindowFinding& window = result.windows[i];
    if (!before[i].failed) window.z = latent_z(without_start(before[i], fit.noise[window.recording]));
    if (!fit.systems[i].failed) window.z_after = latent_z(fit.scores[i]);
  }
}

/// Why a candidate is claimed or not.
inline constexpr const char *kNotSignificant = "not significant",
                            *kImmaterial = "significant, but too small to matter",
                            *kWithinFloor = "significant, but perhaps no more than any measurement is off by",
                            *kMaterial = "significant, and large enough to matter",
                            *kDenied = "does not improve predictions of held-out data",
                            *kNotComparable =
                                "too few data were left out to tell whether it improves predictions";

/// The chance that any of so many normal variables is beyond z.
inline double family_wise(double z) {
  return std::min(1.0, static_cast<double>(candidates().size()) * std::erfc(std::abs(z) / std::sqrt(2.0)));
}

/// The chance that the name of a claim is right that stands out by so many standard deviations. From the
/// sealed batches second and third (docs/proof.md): 21 of 30 were right below 11 deviations, 66 of 72 above
/// 15; what is wrong then is a law that resembles the right one, which no number of deviations mends.
inline double confidence_of(double z) {
  return 0.65 + 0.28 * (1.0 - std::exp(-(std::max(z, kSignificance) - kSignificance) / 6.0));
}

/// An explanation does as well that costs no more than three standard deviations' worth [dispersions].
inline constexpr double kAsGood = 9.0;

/// Whether another explanation does as well, and is as sure.
inline bool is_tied(const Evidence& evidence, const ActiveSet& set, const Candidate& one,
                    const Candidate& other) {
  if (is_in(set, other)) return false;
  const ActiveSet exchanged = with(with(set, one, false), other);
  if (!speaks_for(other, significance(other, estimates_of(evidence, exchanged)))) return false;
  return evidence.cost(exchanged) - evidence.cost(set) < kAsGood * evidence.dispersion();
}

/// Windows that leave so many times more than the middle one are not explained; from this share on, that is
/// said.
inline constexpr double kUnexplainedWindow = 5.0, kUnexplainedShare = 0.2;

/// The share of the windows whose residual is far beyond the middle one's, and beyond what nobody would
/// notice.
inline double unexplained_share(const std::vector<WindowFinding>& windows) {
  std::vector<double> residuals;
  for (const WindowFinding& w : windows)
    if (std::isfinite(w.residual_after)) residuals.push_back(w.residual_after);
  if (residuals.empty()) return 0.0;
  std::ranges::sort(residuals);
  const double far = kUnexplainedWindow * std::max(quantile(residuals, 0.5), kImmaterialPosition);
  const auto count = std::ranges::count_if(residuals, [&](double r) { return r > far; });
  return static_cast<double>(count) / static_cast<double>(residuals.size());
}

/// Whether what a candidate comes out as lies within its search bounds, or a standard deviation beyond.
inline bool is_possible(const Candidate& candidate, const Estimates& standing) {
  return std::ranges::all_of(candidate.unknowns, [&](Unknown u) {
    const double value = standing.estimate[index_of(u)], more = standing.deviation(index_of(u));
    return value > info_of(u).minimum - more && value < info_of(u).maximum + more;
  });
}

/// Whether a force without a name is told: it needs no less than a fault does, and twice the size.
inline bool stands_out(double z, double size) {
  return std::abs(z) > kSignificanceOfFault && size > 2.0 * kSmallestReach;
}

/// Claims first.
inline void surest_first(std::vector<Finding>& findings) {
  std::ranges::stable_sort(findings, [](const Finding& a, const Finding& b) {
    if (a.claimed != b.claimed) return a.claimed;
    return std::abs(a.z) > std::abs(b.z);
  });
}

/// Judges every candidate at the final fit.
inline void find(Diagnosis& result, const Fit& fit, const Evidence& evidence, const Bank& bank,
                 const ActiveSet& set) {
  std::size_t i = 0;
  for (WindowFinding& window : result.windows) window.residual_after = fit.systems[i++].position_residual();
  result.unexplained = unexplained_share(result.windows);
  const Estimates final_standing = estimates_of(evidence, set);
  for (int u = 0; u < kUnknowns; ++u)
    if (set[u]) result.deviation[u] = final_standing.deviation(u);
  for (const Candidate* member : bank) {
    const Candidate& candidate = *member;
    Finding f;
    f.candidate = member;
    const Estimates own =
        is_in(set, candidate) ? final_standing : estimates_of(evidence, with(set, candidate));
    f.estimate = is_in(set, candidate) ? fit.at : own.estimate;  // what the model holds, within its bounds
    for (int u = 0; u < kUnknowns; ++u) f.deviation[u] = own.deviation(u);
    f.z = significance(candidate, own);
    f.p_value = family_wise(f.z);
    f.size = size_of(candidate, f.estimate, fit.systems);
    const double smallest = is_of_spin(candidate) ? kSmallestSpinShare : kSmallestReach;
    for (std::size_t w = 0; w < fit.systems.size(); ++w)
      if (size_of(candidate, f.estimate, {&fit.systems[w], 1}) > smallest) f.windows.push_back(w);
    f.sure = speaks_for(candidate, f.z);
    f.material = candidate.floor == 0.0 ? f.size > smallest : is_beyond_floor(candidate, own);
    f.possible = candidate.kind == CandidateKind::kPhysics || is_possible(candidate, own);
    f.claimed = f.sure && f.material && is_in(set, candidate);
    f.reason = !f.sure ? (candidate.positive && f.z < -kSignificance ? "against physics: it would give energy"
                                                                     : kNotSignificant)
               : !f.material ? (candidate.kind == CandidateKind::kMeasurement ? kWithinFloor : kImmaterial)
                             : kMaterial;
    if (f.claimed && candidate.kind == CandidateKind::kPhysics)
      for (const Candidate* other : bank)
        if (is_law(*other) && other != member && is_tied(evidence, set, candidate, *other))
          f.tied_with.emplace_back(other->name);
    f.confidence = !f.claimed ? 0.0 : !f.tied_with.empty() ? 0.5 : confidence_of(std::abs(f.z));
    result.findings.push_back(f);
  }
  for (int k = 0; k < kLatents; ++k) {
    if (set[kLatentFirst + k]) continue;  // a placebo
    ActiveSet with_latent = set;
    with_latent[kLatentFirst + k] = true;
    const Estimates own = estimates_of(evidence, with_latent);
    const int u = kLatentFirst + k;
    const double deviation = own.deviation(u);
    if (!(deviation > 0.0)) continue;
    const Candidate latent{"", "", CandidateKind::kPhysics, {static_cast<Unknown>(u)}, 0.0, false};
    const double z = own.estimate[u] / deviation, size = size_of(latent, own.estimate, fit.systems);
    if (k < kLatentForces && stands_out(z, size))
      result.unexplained_forces.push_back({static_cast<Unknown>(u), own.estimate[u], deviation, z, size,
                                           open_law(fit, static_cast<Unknown>(u))});
  }
  surest_first(result.findings);
}

/// Residual of the positions in the middle window [m].
inline double left_over(const Fit& fit) {
  std::vector<double> sizes;
  for (const WindowSystem& system : fit.systems) sizes.push_back(system.position_residual());
  return median_of(sizes);
}

/// Which share of what the base leaves over beside what was found its numerical rules make: one less the
/// ratio of what the consistent rules leave to what the base's do, starts fitted to each. Not above one.
template <class D = diagnose_detail::FitDual>
double compare_rules(const Fit& fit, const Model& base, const Model& physics, int threads,
                     const FitWatch& watch = {}) {
  const auto rest = [&](Fit trial, const Model& model) {
    approach<D>(trial, model, ActiveSet::Constant(false), 3, threads, watch);
    return left_over(trial);
  };
  return 1.0 - rest(fit, physics) / std::max(rest(fit, base), 1e-9);
}

}  // namespace diabolo
