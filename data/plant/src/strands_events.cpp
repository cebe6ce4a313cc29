// SPDX-License-Identifier: MIT
#include "strands.hpp"

#include <cmath>
#include <stdexcept>

namespace plant {
namespace {

constexpr double kEventTolerance = 1e-10;  // [s]
constexpr double kReleaseHeight = 0.04;    // above the line of the tips, about a cup's radius [m]
constexpr int kMostEvents = 100;           // within a step
constexpr double kSlipDepth = 0.05;        // below that line, with the string not under the axle: lost [m]
constexpr double kCatchMargin = 0.01;      // of the cups that a catch must leave free [m]

}  // namespace

bool StrandsPlant::is_taut(const StringShape& shape, double time) const {
  const StringParameters string = parameters_.string.at(time);
  return shape.length > string.length && shape.wrap > 0.0 && string_tensions(string, shape).left > 0.0;
}

double StrandsPlant::height_above_chord(const Moment& moment) const {
  return height_above(tips(moment.state, motion_.at(moment.time)), moment.state.col(kPosition));
}

/// Whether the moment's mode still describes it.
bool StrandsPlant::stays(const Moment& moment) const {
  if (moment.mode == Mode::kFlying) return height_above_chord(moment) > 0.0;
  const StringShape now = shape(moment, moment.state, motion_.at(moment.time));
  const bool taut = is_taut(now, moment.time);
  if (moment.mode == Mode::kOnString) return taut;
  if (taut) return false;
  if (parameters_.string.wraps > 0) return true;
  const double height = height_above_chord(moment);
  return now.wrap > 0.0 ? height <= kReleaseHeight : height <= 0.0 && height >= -kSlipDepth;
}

void StrandsPlant::switch_mode(Moment& moment) const {
  switch (moment.mode) {
    case Mode::kOnString:
      moment.mode = Mode::kLoose;
      break;
    case Mode::kLoose:
      if (is_taut(shape(moment, moment.state, motion_.at(moment.time)), moment.time)) {
        moment.mode = Mode::kOnString;
      } else {
        moment.mode = Mode::kFlying;
        moment.missed = height_above_chord(moment) <= 0.0;
      }
      break;
    case Mode::kFlying:
      land(moment);
      break;
  }
}

/// The centre has come down to the line between the tips: the string catches it when it passes between the
/// cups.
void StrandsPlant::land(Moment& moment) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  const Pair<Vec3> ends = tips(moment.state, motion_.at(moment.time));
  const Vec3 centre = moment.state.col(kPosition);
  const Vec3 axis = moment.state.col(kAxis);
  const Vec3 chord = ends[1] - ends[0];
  const double share = chord.dot(centre - ends[0]) / chord.squaredNorm();
  const double along = axis.dot(ends[0] + share * chord - centre);
  const double slant = axis.dot(chord) / perpendicular_part(chord, axis).norm();
  const double reach = std::abs(along) + 0.5 * diabolo.diameter * std::abs(slant);
  const double margin = diabolo.diameter / chord.norm();
  if (share > margin && share < 1.0 - margin && reach < 0.5 * diabolo.length - kCatchMargin) {
    moment.mode = Mode::kLoose;
    moment.chirality = axis.dot(chord.cross(up())) > 0.0 ? 1.0 : -1.0;
    moment.wrap_reference = 0.0;
  } else {
    moment.missed = true;
  }
}

Moment StrandsPlant::advanced(Moment moment, double step) const {
  double left = step;
  int events = 0;
  while (!moment.missed) {
    const Moment whole = stepped(moment, left);
    if (stays(whole)) return whole;
    double before = 0.0;
    double after = left;
    Moment changed = whole;
    while (after - before > kEventTolerance) {
      const double middle = 0.5 * (before + after);
      const Moment trial = stepped(moment, middle);
      if (stays(trial)) {
        before = middle;
      } else {
        after = middle;
        changed = trial;
      }
    }
    moment = changed;
    left -= after;
    if (++events > kMostEvents) throw std::domain_error("the string tautens and slackens without end");
    switch_mode(moment);
    if (!(left > 0.0)) break;
  }
  return moment;
}

}  // namespace plant
