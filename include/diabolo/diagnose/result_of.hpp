// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/adequacy_words.hpp"
#include "diabolo/diagnose/diagnosis_result.hpp"
#include "diabolo/diagnose/finding_parameters.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/located.hpp"
#include "diabolo/diagnose/own_laws.hpp"
#include "diabolo/diagnose/significance.hpp"

namespace diabolo {

/// In files and in Python.
inline const char* text_of(Headline headline) {
  switch (headline) {
    case Headline::kInsufficientData:
      return "INSUFFICIENT_DATA";
    case Headline::kTie:
      return "TIE";
    case Headline::kNamed:
      return "NAMED";
    case Headline::kMeasurementFault:
      return "MEASUREMENT_FAULT";
    case Headline::kNumerical:
      return "NUMERICAL";
    case Headline::kUnnamedStructure:
      return "UNNAMED_STRUCTURE";
    default:
      return "NOTHING_MISSING";
  }
}

namespace diagnose_detail {

inline std::string kind_of(const Candidate& candidate) {
  return candidate.kind == CandidateKind::kPhysics ? "physics" : "measurement";
}

/// In which direction a candidate acts.
inline std::string direction_of(const Candidate& candidate) {
  if (candidate.law != nullptr)
    return std::string(names_of(Acts{})[static_cast<std::size_t>(candidate.law->acts)]);
  return std::string(candidate.direction);
}

/// Where a finding matters: modes, direction, and joined intervals of time.
inline EffectPlace place_of(const Finding& f, const std::vector<WindowFinding>& windows) {
  EffectPlace place;
  place.direction = direction_of(*f.candidate);
  // A window in which the string's state changes does not say in which of them it matters.
  const bool calm = std::ranges::any_of(f.windows, [&](std::size_t w) { return !windows[w].eventful; });
  std::size_t recording = 0;
  for (const std::size_t w : f.windows) {
    const WindowFinding& window = windows[w];
    const bool counts = !(calm && window.eventful);
    if (counts && std::ranges::find(place.modes, text_of(window.mode)) == place.modes.end())
      place.modes.emplace_back(text_of(window.mode));
    if (!place.intervals.empty() && recording == window.recording &&
        window.begin - place.intervals.back().high < 0.2)
      place.intervals.back().high = window.end;
    else
      place.intervals.push_back({window.begin, window.end});
    recording = window.recording;
  }
  return place;
}

inline ClaimedEffect effect_of(const Finding& f, const Diagnosis& d) {
  ClaimedEffect effect;
  effect.name = f.candidate->name;
  effect.kind = kind_of(*f.candidate);
  effect.material = f.material;
  effect.tied_with = f.tied_with;
  effect.p_value = f.p_value;
  effect.confidence = f.confidence;
  effect.parameters = parameters_of(f, d.base_string_length, d.base_gravity);
  effect.where = place_of(f, d.windows);
  effect.worse_without_ci95_m = f.worsening_ci95;
  effect.spin_worse_without_ci95_radps = f.spin_worsening_ci95;
  effect.axle_worse_without_ci95_rad = f.axle_worsening_ci95;
  if (is_of_axle(*f.candidate))
    effect.size.axle_1s_rad = f.size;
  else if (is_of_spin(*f.candidate))
    effect.size.spin_share_1s = f.size / kSpinTime;
  else  // as a constant acceleration would: x = a t^2 / 2 at half a second, four times that at one
    effect.size = {8.0 * f.size, 4.0 * f.size, f.size, std::nullopt, std::nullopt};
  return effect;
}

/// Something of which recordings ask for different values.
inline DifferingEffect differing_of(const Differing& differing, const Diagnosis& d) {
  DifferingEffect result;
  result.name = differing.candidate->name;
  result.kind = kind_of(*differing.candidate);
  result.what = differing.candidate->plain;
  result.z = differing.z;
  for (const FittedAlone& alone : differing.alone) {
    Finding f;
    f.candidate = differing.candidate;
    f.estimate = alone.estimate;
    f.deviation = alone.deviation;
    result.recordings.push_back({alone.recording, parameters_of(f, d.base_string_length, d.base_gravity)});
  }
  return result;
}

inline ClaimedEffect solver_artefact(double share) {
  ClaimedEffect effect;
  effect.name = "solver_artefact";
  effect.kind = "numerical";
  effect.material = true;
  effect.parameters = {Estimate{"share", share, "1", std::nullopt}};
  effect.where = {{"ON_STRING"}, "string_normal", {}};
  return effect;
}

inline LadderRow row_of(const Finding& f) {
  // The unknown that stands out most stands for a candidate of several.
  Unknown shown_unknown = first_of(*f.candidate);
  double most = -1.0;
  for (const Unknown u : f.candidate->unknowns) {
    const double deviation = f.deviation[index_of(u)];
    const double out = deviation > 0.0 ? std::abs(f.estimate[index_of(u)]) / deviation : 0.0;
    if (out > most) most = out, shown_unknown = u;
  }
  LadderRow row;
  row.name = f.candidate->name;
  row.kind = kind_of(*f.candidate);
  row.parameter = f.swapped > 0 ? "frames" : info_of(shown_unknown).name;
  row.estimate = f.swapped > 0 ? static_cast<double>(f.swapped) : f.estimate[index_of(shown_unknown)];
  row.unit = f.swapped > 0 ? "1" : info_of(shown_unknown).unit;
  if (f.candidate->law != nullptr) {
    const OwnNumber own = own_number_of(*f.candidate, shown_unknown);
    row.parameter = own.number->name;
    row.estimate = own.value(row.estimate);
    row.unit = own.number->unit;
  }
  row.z = f.z;
  row.p_value = f.p_value;
  if (!is_of_spin(*f.candidate) && !is_of_axle(*f.candidate)) row.size_m = f.size;
  row.claimed = f.claimed;
  row.reason = f.reason;
  return row;
}

/// How much of physics that is not claimed may be there; nothing where the data cannot say.
inline std::optional<UpperLimit> limit_of(const Finding& f) {
  if (f.claimed || f.candidate->kind != CandidateKind::kPhysics) return {};
  const UnknownInfo& info = info_of(f.candidate->unknowns.front());
  const int u = index_of(f.candidate->unknowns.front());
  if (!(f.deviation[u] > 0.0)) return {};
  // What the data put below zero, of what cannot be, is none.
  const bool positive = f.candidate->positive && !is_of_axle(*f.candidate);
  const double size = positive ? std::max(0.0, f.estimate[u]) : std::abs(f.estimate[u]);
  const double limit = size + kNormal95 * f.deviation[u];
  if (f.candidate->law != nullptr) {
    const LawNumber& own = f.candidate->law->numbers.front();
    return UpperLimit{std::string(f.candidate->name), own.name, limit * own.usual, own.unit};
  }
  return UpperLimit{std::string(f.candidate->name), std::string(info.name), limit, std::string(info.unit)};
}

inline UnnamedStructure unnamed_of(const UnexplainedForce& l) {
  const PowerLaw& law = l.law;
  const auto rounded = [](double value) {
    std::ostringstream text;
    text << std::setprecision(2) << value;
    return text.str();
  };
  UnnamedStructure found;
  found.where.direction = info_of(l.unknown).name;
  found.value = l.value;
  found.deviation = l.deviation;
  found.unit = info_of(l.unknown).unit;
  found.z = l.z;
  found.size_m = l.size;
  found.scalar = law.scalar;
  found.scalar_unit = law.unit;
  found.exponent = law.exponent;
  found.exponent_deviation = law.deviation;
  for (const auto& [x, value] : law.curve) found.curve.push_back({x, value});
  found.explained = law.explained;
  const std::string along = " " + found.unit + " along " + found.where.direction;
  const bool told = !law.curve.empty() && law.deviation <= kVagueExponent;
  found.law = !told ? rounded(l.value) + along + "; how it grows cannot be told"
                    : rounded(law.value) + along + " at " + rounded(law.at) + " " + found.scalar_unit +
                          " of " + found.scalar + ", growing as " + found.scalar + "^(" +
                          rounded(law.exponent) + " ± " + rounded(law.deviation) + ")";
  return found;
}

}  // namespace diagnose_detail

/// What a diagnosis says, less what only its caller knows: files and time. `recordings` are those that were
/// diagnosed, `unused` names of held-out recordings on which nothing can be compared, see
/// comparable_windows().
inline DiagnosisResult result_of(const Diagnosis& d, const std::vector<Recording>& recordings,
                                 std::vector<std::string> unused = {}) {
  DiagnosisResult result;
  result.headline = text_of(d.headline);
  result.sentence = d.sentence;
  result.base = d.base;
  if (d.numerical && *d.numerical > kNumericalShare)
    result.effects.push_back(diagnose_detail::solver_artefact(*d.numerical));
  for (const Finding& f : d.findings) {
    result.ladder.push_back(diagnose_detail::row_of(f));
    if (f.claimed) result.effects.push_back(diagnose_detail::effect_of(f, d));
    if (const std::optional<UpperLimit> limit = diagnose_detail::limit_of(f))
      result.upper_limits.push_back(*limit);
  }
  for (int u = 0; u <= index_of(Unknown::kAxleRadius) && d.reason.empty(); ++u) {
    const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(u)];
    result.nuisances.push_back(diagnose_detail::with_deviation(std::string(info.name), d.at[u],
                                                               d.deviation[u], std::string(info.unit)));
  }
  for (const UnexplainedForce& l : d.unexplained_forces)
    result.unnamed.push_back(diagnose_detail::unnamed_of(l));
  for (const Learnt& learnt : d.learnt) result.learnt.push_back(diagnose_detail::learnt_of(learnt));
  for (const Differing& differing : d.differing)
    result.differing.push_back(diagnose_detail::differing_of(differing, d));
  const auto heldout = [](bool whole_recordings) { return whole_recordings ? "recordings" : "blocks"; };
  result.fit = {heldout(d.heldout.whole_recordings),
                d.heldout.horizons,
                d.heldout.position.base_error,
                d.heldout.position.augmented_error,
                d.heldout.position.improvement_ci95,
                d.heldout.position.start_error,
                d.heldout.spin.base_error,
                d.heldout.spin.augmented_error,
                d.heldout.spin.improvement_ci95,
                d.heldout.spin.start_error,
                {},
                {},
                {},
                {},
                {},
                {},
                d.heldout.windows,
                std::move(unused),
                d.windows.size(),
                d.windows_seen};
  if (d.heldout.axle) {
    result.fit.axle_heldout = heldout(d.heldout.axle->whole_recordings);
    result.fit.axle_ahead_s = d.heldout.axle->seconds;
    result.fit.constant_axle_error_rad = d.heldout.axle->constant_error;
    result.fit.base_axle_error_rad = d.heldout.axle->base_error;
    result.fit.augmented_axle_error_rad = d.heldout.axle->augmented_error;
    result.fit.axle_improvement_ci95_rad = d.heldout.axle->improvement_ci95;
  }
  for (const Proposal& p : d.proposals)
    result.next_experiment.push_back({std::string(p.experiment->motion), std::string(p.experiment->plain),
                                      p.parts, p.odds, p.experiment->seconds});
  result.adequacy = d.adequacy;
  result.catch_rule = d.catch_rule;
  result.not_done = d.not_done;
  result.locate = diagnose_detail::located(d, recordings);
  for (const auto& [name, noise] : d.noise) result.noise.push_back({name, noise.position, noise.spin});
  return result;
}

/// Starts from which a recording that is held out can be compared, as compare_held_out() would take them at
/// their least distance.
/// Throws RecordingError where the recording is none.
inline std::size_t comparable_windows(const Recording& recording, const Model& base) {
  check_recording(recording);
  HorizonOptions options;
  options.starts_every = kStartsEvery;
  options.horizons = HeldOut{}.horizons;
  return HorizonTask(recording, base, options).size();
}

}  // namespace diabolo
