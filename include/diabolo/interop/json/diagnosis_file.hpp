// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/diagnosis.hpp"
#include "diabolo/interop/json/fields.hpp"
#include "diabolo/interop/json/finding.hpp"
#include "diabolo/version.hpp"

namespace diabolo {

inline constexpr const char* kDiagnosisSchema = "diabolo.diagnosis/1";

namespace detail {

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

inline const char* text_of(StringState state) {
  return state == StringState::kOnString ? "ON_STRING" : state == StringState::kLoose ? "LOOSE" : "FLYING";
}

/// In which direction a candidate acts.
inline const char* direction_of(const Candidate& candidate) {
  switch (first_of(candidate)) {
    case Unknown::kCompliance:
    case Unknown::kStickCompliance:
    case Unknown::kRestitution:
      return "string_normal";
    case Unknown::kWindX:
      return "horizontal";
    case Unknown::kStringMass:
      return "vertical";
    case Unknown::kGravity:
      return candidate.kind == CandidateKind::kPhysics ? "vertical" : "measurement";
    case Unknown::kPlacebo:
      return "horizontal";
    case Unknown::kFriction:
    case Unknown::kWraps:
    case Unknown::kStringTangent:
      return "string_tangent";
    case Unknown::kGyroscopicGain:
      return "axle";
    case Unknown::kLinearDrag:
    case Unknown::kQuadraticDrag:
      return "against_v";
    case Unknown::kLift:
      return "axis_x_v";
    case Unknown::kSpinCoupling:
    case Unknown::kSpinAir:
    case Unknown::kSpinAxle:
      return "spin";
    default:
      return "measurement";
  }
}

/// Where a finding matters: modes, direction, and joined intervals of time.
inline Json where_of(const Finding& f, const std::vector<WindowFinding>& windows) {
  Json modes = Json::array(), intervals = Json::array();
  std::size_t recording = 0;
  for (const std::size_t w : f.windows) {
    const WindowFinding& window = windows[w];
    const Json mode = text_of(window.mode);
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) modes.push_back(mode);
    if (!intervals.empty() && recording == window.recording &&
        window.begin - intervals.back()[1].get<double>() < 0.2)
      intervals.back()[1] = window.end;
    else
      intervals.push_back({window.begin, window.end});
    recording = window.recording;
  }
  return {{"modes", modes}, {"direction", direction_of(*f.candidate)}, {"intervals", intervals}};
}

inline Json intervals_of(const std::vector<std::optional<Interval>>& intervals) {
  Json list = Json::array();
  for (const std::optional<Interval>& interval : intervals)
    list.push_back(interval ? Json({interval->low, interval->high}) : Json(nullptr));
  return list;
}

inline Json effect_of(const Finding& f, const Diagnosis& d, double given_length, double given_gravity) {
  const bool physics = f.candidate->kind == CandidateKind::kPhysics, of_spin = is_of_spin(*f.candidate);
  return {{"name", f.candidate->name},
          {"kind", physics ? "physics" : "measurement"},
          {"material", f.material},
          {"tied_with", f.tied_with},
          {"p_value", f.p_value},
          {"confidence", f.confidence},
          {"parameters", parameters_of(f, given_length, given_gravity)},
          {"where", where_of(f, d.windows)},
          {"worse_without_ci95_m", intervals_of(f.worsening_ci95)},
          // As a constant acceleration would: x = a t^2 / 2 at half a second, four times that at one.
          {"size",
           {{"acceleration_mps2", of_spin ? Json(nullptr) : Json(8.0 * f.size)},
            {"position_1s_m", of_spin ? Json(nullptr) : Json(4.0 * f.size)},
            {"position_05s_m", of_spin ? Json(nullptr) : Json(f.size)},
            {"spin_share_1s", of_spin ? Json(f.size / kSpinTime) : Json(nullptr)}}}};
}

inline Json ladder_of(const Finding& f) {
  // The unknown that stands out most stands for a candidate of several.
  Unknown shown_unknown = first_of(*f.candidate);
  double most = -1.0;
  for (const Unknown u : f.candidate->unknowns) {
    const double deviation = f.deviation[index_of(u)];
    const double out = deviation > 0.0 ? std::abs(f.estimate[index_of(u)]) / deviation : 0.0;
    if (out > most) most = out, shown_unknown = u;
  }
  return {{"name", f.candidate->name},
          {"kind", f.candidate->kind == CandidateKind::kPhysics ? "physics" : "measurement"},
          {"parameter", f.swapped > 0 ? "frames" : info_of(shown_unknown).name},
          {"estimate", f.swapped > 0 ? static_cast<double>(f.swapped) : f.estimate[index_of(shown_unknown)]},
          {"unit", f.swapped > 0 ? "1" : info_of(shown_unknown).unit},
          {"z", f.z},
          {"p_value", f.p_value},
          {"size_m", is_of_spin(*f.candidate) ? Json(nullptr) : Json(f.size)},
          {"claimed", f.claimed},
          {"reason", f.reason}};
}

inline Json unnamed_of(const Leftover& l) {
  const PowerLaw& law = l.law;
  const std::string name(info_of(l.unknown).name), unit(info_of(l.unknown).unit), scalar(law.scalar);
  const auto rounded = [](double value) {
    std::ostringstream text;
    text << std::setprecision(2) << value;
    return text.str();
  };
  const bool told = !law.curve.empty() && law.deviation <= kVagueExponent;
  const std::string text =
      !told ? rounded(l.value) + " " + unit + " along " + name + "; how it grows cannot be told"
            : rounded(law.value) + " " + unit + " along " + name + " at " + rounded(law.at) + " " +
                  std::string(law.unit) + " of " + scalar + ", growing as " + scalar + "^(" +
                  rounded(law.exponent) + " ± " + rounded(law.deviation) + ")";
  return {{"where", {{"direction", name}}},
          {"law", text},
          {"value", l.value},
          {"deviation", l.deviation},
          {"unit", unit},
          {"z", l.z},
          {"size_m", l.size},
          {"scalar", scalar},
          {"scalar_unit", law.unit},
          {"exponent", law.exponent},
          {"exponent_deviation", law.deviation},
          {"curve", law.curve},
          {"explained", l.in_model ? Json(nullptr) : Json(law.explained)},
          {"in_model", l.in_model},
          {"worse_without_ci95_m", intervals_of(l.worsening_ci95)}};
}

inline Json heldout_of(const HeldOut& h) {
  Json base = Json::array(), augmented = base, start = base;
  for (std::size_t i = 0; i < h.base_error.size(); ++i) {
    base.push_back(number_or_null(h.base_error[i]));
    augmented.push_back(number_or_null(h.augmented_error[i]));
    start.push_back(number_or_null(h.start_error[i]));
  }
  return {{"heldout", h.whole_recordings ? "recordings" : "blocks"},
          {"horizons_s", h.horizons},
          {"base_error_m", base},
          {"augmented_error_m", augmented},
          {"improvement_ci95_m", intervals_of(h.improvement_ci95)},
          {"start_error_m", start},
          {"windows", h.windows}};
}

}  // namespace detail

/// A diagnosis as JSON of the schema diabolo.diagnosis/1 (docs/diagnosis.md), less what only its caller
/// knows: files and time. `recordings` are those that were diagnosed.
inline nlohmann::ordered_json diagnosis_to_json(const Diagnosis& d,
                                                const std::vector<Recording>& recordings) {
  using detail::Json;
  const double length = d.base_string_length;
  Json effects = Json::array(), ladder = effects, limits = effects, nuisances = effects, unnamed = effects,
       windows = effects, directions = effects, noise = effects, experiments = effects;
  if (d.numerical && *d.numerical > 0.1)
    effects.push_back(
        {{"name", "solver_artefact"},
         {"kind", "numerical"},
         {"material", true},
         {"tied_with", Json::array()},
         {"p_value", nullptr},
         {"confidence", nullptr},
         {"parameters",
          Json::array({{{"name", "share"}, {"value", *d.numerical}, {"unit", "1"}, {"ci90", nullptr}}})},
         {"where", {{"modes", {"ON_STRING"}}, {"direction", "string_normal"}, {"intervals", Json::array()}}},
         {"size", Json::object()}});
  for (const Finding& f : d.findings) {
    ladder.push_back(detail::ladder_of(f));
    if (f.claimed) {
      effects.push_back(detail::effect_of(f, d, length, d.base_gravity));
      continue;
    }
    if (f.candidate->kind != CandidateKind::kPhysics) continue;
    const int u = index_of(f.candidate->unknowns.front());
    if (!(f.deviation[u] > 0.0)) continue;
    const double limit = std::max(0.0, std::abs(f.estimate[u]) + detail::kNormal95 * f.deviation[u]);
    limits.push_back({{"name", f.candidate->name},
                      {"parameter", info_of(f.candidate->unknowns.front()).name},
                      {"limit95", limit},
                      {"unit", info_of(f.candidate->unknowns.front()).unit}});
  }
  for (int u = 0; u <= index_of(Unknown::kAxleRadius) && d.reason.empty(); ++u) {
    const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(u)];
    nuisances.push_back(
        detail::with_deviation(std::string(info.name), d.at[u], d.deviation[u], std::string(info.unit)));
  }
  for (const Leftover& l : d.leftovers) unnamed.push_back(detail::unnamed_of(l));
  for (int k = 0; k < kLatents; ++k) {
    const UnknownInfo& info = info_of(static_cast<Unknown>(kLatentFirst + k));
    const bool on_string = k < 2 || k == 5;
    directions.push_back(
        {{"name", info.name}, {"mode", on_string ? "ON_STRING" : "FLYING"}, {"unit", info.unit}});
  }
  for (const WindowFinding& w : d.windows) {
    Json z = Json::array();
    for (const double value : w.z) z.push_back(detail::number_or_null(value));
    windows.push_back({{"recording", recordings[w.recording].name},
                       {"begin_s", w.begin},
                       {"end_s", w.end},
                       {"mode", detail::text_of(w.mode)},
                       {"residual_before_m", w.residual_before},
                       {"residual_after_m", w.residual_after},
                       {"z", z}});
  }
  for (const Proposal& p : d.proposals)
    experiments.push_back({{"motion", p.experiment->motion},
                           {"what", p.experiment->plain},
                           {"parts", p.parts},
                           {"odds", detail::number_or_null(p.odds)},
                           {"seconds", p.experiment->seconds}});
  Json fit = detail::heldout_of(d.heldout);
  if (d.windows.size() < d.windows_seen && !d.windows.empty())  // else all were fitted
    fit.update({{"fitted_windows", d.windows.size()}, {"of_windows", d.windows_seen}});
  for (const auto& [name, n] : d.noise)
    noise.push_back({{"recording", name}, {"position_m", n.position}, {"spin_rad_s", n.spin}});
  return {{"schema", kDiagnosisSchema},
          {"headline", detail::text_of(d.headline)},
          {"sentence", d.sentence},
          {"base", d.base},
          {"effects", effects},
          {"unnamed", unnamed},
          {"upper_limits", limits},
          {"nuisances", nuisances},
          {"fit", fit},
          {"next_experiment", experiments},
          {"not_done", d.not_done},
          {"ladder", ladder},
          {"locate", {{"directions", directions}, {"windows", windows}}},
          {"noise", noise},
          {"model", nullptr},
          {"version", kVersion}};
}

}  // namespace diabolo
