// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/adequacy.hpp"
#include "diabolo/diagnose/catch_rule.hpp"
#include "diabolo/diagnose/diagnosis_options.hpp"
#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/effects/law.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/recording.hpp"

// What diagnose() is asked and what it answers. A program that includes this header alone compiles fast and
// links diabolo::diagnose; one that includes diagnosis.hpp compiles the whole diagnosis itself.
namespace diabolo {

enum class CandidateKind { kPhysics, kMeasurement };

/// Something that may be missing, under the name that a result gives it, with the unknowns that it is made
/// of.
struct Candidate {
  std::string_view name, plain;
  CandidateKind kind;
  std::vector<Unknown> unknowns;  ///< none of body_swap, which is seen without a fit
  double floor = 0.0;     ///< claimed only beyond, in any of its unknowns; of physics see kSmallestReach
  bool positive = false;  ///< a negative amplitude is against physics
  std::vector<Unknown> companions{};           ///< free with it, and nothing without it
  std::string_view direction = "measurement";  ///< in which it acts
  std::string_view number{};                   ///< what a result calls its one unknown
  bool by_spin = false;                        ///< nothing is seen of it without the spin
  const Law* law = nullptr;  ///< of somebody's own; its numbers are the unknowns and the companions
};

/// Standard deviations of what a camera reports.
struct CameraNoise {
  double position = 1e-3;  ///< one coordinate [m]
  double spin = 3.0;       ///< [rad/s]

  bool operator==(const CameraNoise&) const = default;
};

/// How a force without a name grows: value at `at`, times (x / at)^exponent, x a scalar of the motion.
struct PowerLaw {
  std::string_view scalar, unit;           ///< x and its unit
  double exponent = 0.0, deviation = 0.0;  ///< and its standard deviation; a vague one is zero
  double at = 0.0, value = 0.0;            ///< a usual x, and the force there, in the unit of its unknown
  double explained = 0.0;                  ///< share of what the windows say beyond nothing
  std::vector<std::pair<double, double>> curve;  ///< x, and the mean of what the windows around it say
};

/// Errors of the base and with what was found, horizon by horizon: of positions [m], or of the spin [rad/s].
struct ErrorsByHorizon {
  std::vector<std::optional<double>> base_error, augmented_error;  ///< means
  std::vector<std::optional<Interval>> improvement_ci95;           ///< of base less augmented
  /// What the start's noise alone would put the augmented model off by, mean.
  std::vector<std::optional<double>> start_error;
  /// Of what the augmented model's error grows by where one claim is taken out of it and all else fitted
  /// again: claim by claim, horizon by horizon.
  std::vector<std::vector<std::optional<Interval>>> worsening_ci95;
};

/// How far the axle's direction is off a while after it was seen, on stretches that were not fitted: angles
/// [rad], means, of an axle that keeps its direction, of the base and with what was found.
struct AxleAhead {
  bool whole_recordings = false;  ///< held out, or left out one by one; else blocks of rows
  double seconds = 0.0;           ///< that while, a mean
  double constant_error = 0.0, base_error = 0.0, augmented_error = 0.0;
  std::optional<Interval> improvement_ci95;  ///< of base less augmented
  bool lets_strands_follow = false;  ///< the model has them leave the axle square to it, the base has not
};

/// Errors on data that the model was not fitted to.
struct HeldOut {
  bool whole_recordings = false;                      ///< left out one by one; else blocks of rows
  std::vector<double> horizons{0.1, 0.25, 0.5, 1.0};  ///< [s]
  ErrorsByHorizon position, spin;
  std::vector<std::optional<double>>
      augmented_median;                 ///< of the distances of those that did not diverge [m]
  std::vector<ResidualAndNoise> ahead;  ///< position and spin, at each horizon of kAhead and more
  std::optional<AxleAhead> axle;        ///< nothing where it was not seen
  std::size_t windows = 0;
};

/// What something comes out as where one recording is fitted by itself, SI units.
struct FittedAlone {
  std::string recording;
  UnknownVector estimate, deviation;  ///< those of the candidate's unknowns count
};

/// Something of which recordings ask for different values.
struct Differing {
  const Candidate* candidate = nullptr;
  double z = 0.0;  ///< of the two that differ most, in standard deviations
  std::vector<FittedAlone> alone;
};

/// A candidate and what speaks for it and against it.
struct Finding {
  const Candidate* candidate = nullptr;
  UnknownVector estimate = UnknownVector::Zero();   ///< SI units; those of the candidate's unknowns count
  UnknownVector deviation = UnknownVector::Zero();  ///< standard deviations
  double z = 0.0;                                   ///< significance in standard deviations
  double p_value = 1.0;                             ///< over all candidates
  double size = 0.0;                                ///< see size_of()
  bool sure = false;                                ///< by its significance
  bool material = false;                            ///< by its size
  bool possible = true;                             ///< no farther off than a measurement may be
  bool claimed = false;                             ///< sure and material, and part of the model
  double confidence = 0.0;
  long swapped = 0;  ///< frames, of body_swap
  std::vector<std::string> tied_with;
  std::vector<std::size_t> windows;  ///< in which it matters
  /// By how much what was left out is predicted worse without it, horizon by horizon [m], [rad/s]; of claims.
  std::vector<std::optional<Interval>> worsening_ci95, spin_worsening_ci95;
  std::optional<Interval> axle_worsening_ci95;  ///< the same of the axle's direction [rad], of what turns it
  std::string reason;                           ///< why it is claimed, or not
};

/// A force that is left over, without a name.
struct UnexplainedForce {
  Unknown unknown;
  double value, deviation, z, size;
  PowerLaw law;  ///< how it grows
};

/// An unknown of which a diagnosis asks whether it changes in time, as what it is told, and in which unit.
struct MayChange {
  Unknown unknown;
  const char *name, *unit;
  double factor = 1.0;     ///< of the unit in that of the unknown
  double smallest = 8e-3;  ///< that matters, in the unit: an acceleration of 1 mm in half a second
};

/// Accelerations in the world by gravity's direction and size, forces, torques, the string's length and its
/// friction; and the delay between diabolo and sticks, last.
inline constexpr std::array kMayChange{
    MayChange{Unknown::kTiltX, "acceleration_forward", "m/s^2", kStandardGravity},
    MayChange{Unknown::kTiltY, "acceleration_left", "m/s^2", kStandardGravity},
    MayChange{Unknown::kGravity, "acceleration_up", "m/s^2"},
    MayChange{Unknown::kStringTangent, "string_tangent", "m/s^2"},
    MayChange{Unknown::kStringBinormal, "string_binormal", "m/s^2"},
    MayChange{Unknown::kFlightAgainst, "flight_against_v", "m/s^2"},
    MayChange{Unknown::kFlightVertical, "flight_vertical", "m/s^2"},
    MayChange{Unknown::kFlightLift, "flight_axis_x_v", "m/s^2"},
    MayChange{Unknown::kSpinString, "spin_on_string", "rad/s^2", 1.0, 0.5},
    MayChange{Unknown::kSpinFree, "spin_off_string", "rad/s^2", 1.0, 0.5},
    MayChange{Unknown::kStringLength, "string_length", "m", 1.0, 1e-3},
    MayChange{Unknown::kFriction, "string_friction", "1", 1.0, 0.02},
    MayChange{Unknown::kTimeOffset, "time_offset", "s", 1.0, 1e-3}};

/// Whether a law depends on what its formula says, see dependence_of().
struct Dependence {
  double gain;      ///< of windows that were left out, by strengths as the law says, in chi^2
  double permuted;  ///< the same where these are exchanged among the windows, the median
  double p_value;   ///< the chance that exchanged ones gain as much
};

/// A law by a formula that was learnt from what is left over, and is in the model.
struct Learnt {
  Law law;
  std::vector<double> value{}, deviation{};  ///< of its numbers, in their units
  std::size_t first = 0;                     ///< place of its first number among those of the model's laws
  double gain = 0.0;                         ///< what chi^2 falls by, in units of the dispersion
  std::optional<Dependence> dependence{};
  std::vector<std::optional<Interval>> worsening_ci95{}, spin_worsening_ci95{};  ///< see Finding
};

inline const char* text_of(StringState state) {
  return state == StringState::kOnString ? "ON_STRING" : state == StringState::kLoose ? "LOOSE" : "FLYING";
}

/// What was seen in a window before anything was added, and what is left.
struct WindowFinding {
  std::size_t recording;
  double begin, end;  ///< [s]
  StringState mode;
  double residual_before, residual_after;   ///< root mean square, position [m]
  std::array<double, kLatents> z, z_after;  ///< of the latent accelerations; NaN where they say nothing
  /// Of kMayChange with what was found: half the slope and half the curvature of -chi^2, in the scales of
  /// kUnknownInfos.
  std::array<double, kMayChange.size()> slope{}, curvature{};
  bool eventful = false;                                            ///< the string's state changes in it
  double residual_noise = kNaN;                                     ///< what noise alone would leave [m]
  double spin_before = kNaN, spin_after = kNaN, spin_noise = kNaN;  ///< the three of the spin [rad/s]
  std::array<double, 3> beyond_noise{kNaN, kNaN,
                                     kNaN};  ///< mean square forward, left, up, less noise's [m^2]
};

/// A part of a motion, as for a string of 1.45 m: tips by the time [s], and a start; on the string it hangs
/// at rest.
struct MotionPart {
  double seconds;
  std::function<Tips<double>(double)> tips;  ///< positions and directions of the sticks
  double spin;                               ///< [rad/s]
  Vector3<double> velocity;                  ///< of a throw [m/s]; zero: on the string
};

/// A motion that somebody may record.
struct Experiment {
  std::string_view motion, plain;
  double seconds;  ///< to record
  std::vector<MotionPart> parts;
};

/// What to record next, and the odds that it would give against the wrong one of what it parts.
struct Proposal {
  const Experiment* experiment;
  std::vector<std::string> parts;  ///< names
  std::optional<double> odds;      ///< not told of faults of measurement
};

enum class Headline {
  kInsufficientData,
  kTie,
  kNamed,
  kMeasurementFault,
  kNumerical,
  kUnnamedStructure,
  kNothingMissing
};

/// Laws of somebody's own, as candidates.
struct OwnCandidates {
  FormulaLaws<double> laws;
  std::vector<Candidate> list;
};

struct FinalFit;  // final_fit.hpp

/// The answer.
struct Diagnosis {
  Headline headline = Headline::kNothingMissing;
  std::string base, sentence, reason;
  double base_gravity = kStandardGravity;  ///< [m/s^2]
  double base_string_length = 0.0;         ///< [m]
  double base_spin_coupling = 0.0;         ///< [1/s]
  std::vector<Finding> findings;           ///< of every candidate, the surest first
  std::vector<UnexplainedForce> unexplained_forces;
  std::vector<Learnt> learnt;        ///< in the order in which they were
  std::vector<Differing> differing;  ///< the surest first
  std::vector<WindowFinding> windows;
  std::vector<std::pair<std::string, CameraNoise>> noise;
  UnknownVector at = UnknownVector::Zero();
  UnknownVector deviation = UnknownVector::Zero();
  Model model;
  HeldOut heldout;
  std::vector<Proposal> proposals;
  Adequacy adequacy;                    ///< of what was found
  std::optional<CatchRule> catch_rule;  ///< that the base's is too strict
  double unexplained = 0.0;             ///< share of the windows that are far off after all
  bool withdrawn = false;               ///< physics that stands out, but does not help on what was left out
  std::optional<double> numerical;      ///< share of the base's error that its numerical rules make
  std::vector<std::string> not_done;    ///< what budget, base or recordings kept from being asked
  std::size_t windows_seen = 0;         ///< in the recordings, of which `windows` were fitted
  std::shared_ptr<const OwnCandidates> own;   ///< to which findings may point
  std::shared_ptr<const FinalFit> final_fit;  ///< that all of it was read from; null where nothing was fitted
};

/// Numbers of a window's start: position, velocity and spin.
inline constexpr int kStartUnknowns = 7;

namespace diagnose_detail {

/// Derivatives only show the way of a fit and its spread: seven digits are enough.
using FitDual = Dual<double, kStartUnknowns + kUnknowns, float>;
/// A dual with fewer.
template <class D, int N>
using Shortened = Dual<decltype(D::value), N, typename D::Gradient::Scalar>;
/// Derivatives that are carried, as few as will do: a step costs about as much as it has.
inline constexpr int kLengths[] = {8, 32, 40, kStartUnknowns + kUnknowns};

}  // namespace diagnose_detail

/// Finds what a simulator leaves out. Throws RecordingError where a recording cannot be used at all,
/// std::invalid_argument about options, and Cancelled.
template <class D = diagnose_detail::FitDual>
Diagnosis diagnose(std::vector<Recording> recordings, DiagnosisOptions options = {},
                   const DiagnosisWatch& watch = {});

}  // namespace diabolo
