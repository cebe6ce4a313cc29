// SPDX-License-Identifier: MIT
#include "plant.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace plant {
namespace {

constexpr double kEventTolerance = 1e-10;  // [s]
constexpr double kReleaseHeight = 0.04;    // above the line of the tips, about a cup's radius [m]
constexpr double kCatchMargin = 0.01;      // of the cups that a catch must leave free [m]

constexpr Pair<int> kBend{kLeftBend, kRightBend};
constexpr Pair<int> kBendRate{kLeftBendRate, kRightBendRate};

}  // namespace

Pair<Vec3> Plant::tips(const State& state, const Pair<Stick>& sticks) const {
  return {sticks[0].tip + state.col(kLeftBend), sticks[1].tip + state.col(kRightBend)};
}

StringShape Plant::shape(const Moment& moment, const State& state, const Pair<Stick>& sticks) const {
  StringEnds ends;
  ends.centre = state.col(kPosition);
  ends.velocity = state.col(kVelocity);
  ends.axis = state.col(kAxis).normalized();
  ends.spin = spin_about_axis(parameters_.diabolo, state);
  ends.tips = tips(state, sticks);
  ends.tip_velocities = {sticks[0].velocity + state.col(kLeftBendRate),
                         sticks[1].velocity + state.col(kRightBendRate)};
  ends.chirality = moment.chirality;
  ends.wrap_reference = moment.wrap_reference;
  return string_shape(parameters_.string, parameters_.diabolo.groove, ends);
}

State Plant::rate(const Moment& moment, const State& state, const Pair<Stick>& sticks) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  const StringParameters& string = parameters_.string;
  State rate = State::Zero();
  rate.col(kPosition) = state.col(kVelocity);
  rate.col(kVelocity) = parameters_.gravity;
  add_rotation(diabolo, state, rate);
  add_air(diabolo, parameters_.air, state, rate);

  Pair<Vec3> pulls{Vec3::Zero(), Vec3::Zero()};
  if (moment.mode == Mode::kOnString) {
    const StringShape taut = shape(moment, state, sticks);
    const Tensions tensions = bearing_limited(diabolo, string, moment.chirality,
                                              spin_about_axis(diabolo, state), string_tensions(string, taut));
    add_string_pull(diabolo, taut, tensions, state, rate);
    pulls = {-tensions.left * taut.strands[0].direction, -tensions.right * taut.strands[1].direction};
  } else if (moment.mode == Mode::kLoose) {
    rate.col(kVelocity) += 0.5 * string.linear_density * string.length / diabolo.mass * parameters_.gravity;
  }

  if (parameters_.sticks.bending_stiffness) {
    for (int side = 0; side < 2; ++side) {
      rate.col(kBend[side]) = state.col(kBendRate[side]);
      rate.col(kBendRate[side]) =
          bend_acceleration(parameters_.sticks, sticks[side], state.col(kBend[side]),
                            state.col(kBendRate[side]), pulls[side], parameters_.gravity);
    }
  }
  return rate;
}

State Plant::runge_kutta(const Moment& moment, double step) const {
  const Pair<Stick> at_start = motion_.at(moment.time);
  const Pair<Stick> at_middle = motion_.at(moment.time + 0.5 * step);
  const Pair<Stick> at_end = motion_.at(moment.time + step);
  const State& state = moment.state;
  const State k1 = rate(moment, state, at_start);
  const State k2 = rate(moment, state + 0.5 * step * k1, at_middle);
  const State k3 = rate(moment, state + 0.5 * step * k2, at_middle);
  const State k4 = rate(moment, state + step * k3, at_end);
  return state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// One smooth step in the present mode.
Moment Plant::stepped(const Moment& moment, double step) const {
  Moment next = moment;
  next.time += step;
  next.state = runge_kutta(moment, step);
  next.state.col(kAxis).normalize();
  next.state.col(kReference) =
      perpendicular_part(next.state.col(kReference), next.state.col(kAxis)).normalized();
  if (next.mode != Mode::kFlying) next.wrap_reference = shape(next, next.state, motion_.at(next.time)).wrap;
  return next;
}

bool Plant::is_taut(const Moment& moment, const StringShape& shape) const {
  return shape.length > parameters_.string.length && shape.wrap > 0.0 &&
         string_tensions(parameters_.string, shape).left > 0.0 && moment.mode != Mode::kFlying;
}

Vec3 Plant::up() const {
  const double strength = parameters_.gravity.norm();
  return strength > 0.0 ? Vec3(-parameters_.gravity / strength) : Vec3(Vec3::UnitZ());
}

double Plant::height_above_chord(const Moment& moment) const {
  const Pair<Vec3> ends = tips(moment.state, motion_.at(moment.time));
  const Vec3 chord = (ends[1] - ends[0]).normalized();
  return perpendicular_part(up(), chord).normalized().dot(moment.state.col(kPosition) - ends[0]);
}

/// Whether the moment's mode still describes it.
bool Plant::stays(const Moment& moment) const {
  if (moment.mode == Mode::kFlying) return height_above_chord(moment) > 0.0;
  const StringShape now = shape(moment, moment.state, motion_.at(moment.time));
  const bool taut = is_taut(moment, now);
  if (moment.mode == Mode::kOnString) return taut;
  const bool parts =
      parameters_.string.wraps == 0 && (now.wrap <= 0.0 || height_above_chord(moment) > kReleaseHeight);
  return !taut && !parts;
}

void Plant::switch_mode(Moment& moment) const {
  switch (moment.mode) {
    case Mode::kOnString:
      moment.mode = Mode::kLoose;
      break;
    case Mode::kLoose:
      moment.mode = is_taut(moment, shape(moment, moment.state, motion_.at(moment.time))) ? Mode::kOnString
                                                                                          : Mode::kFlying;
      break;
    case Mode::kFlying:
      land(moment);
      break;
  }
}

/// The centre has come down to the line between the tips: the string catches it when it passes between the
/// cups.
void Plant::land(Moment& moment) const {
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

Moment Plant::advanced(Moment moment, double step) const {
  double left = step;
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
    switch_mode(moment);
    if (!(left > 0.0)) break;
  }
  return moment;
}

/// Newton's method on the forces at rest: hanging position and bends of the sticks.
void Plant::hang(Moment& moment) const {
  const Pair<Stick> sticks = motion_.at(moment.time);
  const std::vector<int> unknown = parameters_.sticks.bending_stiffness
                                       ? std::vector<int>{kPosition, kLeftBend, kRightBend}
                                       : std::vector<int>{kPosition};
  const std::vector<int> forces = parameters_.sticks.bending_stiffness
                                      ? std::vector<int>{kVelocity, kLeftBendRate, kRightBendRate}
                                      : std::vector<int>{kVelocity};
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(unknown.size());
  const auto residual = [&](const State& state) {
    const State accelerations = rate(moment, state, sticks);
    Eigen::VectorXd result(size);
    for (std::size_t i = 0; i < forces.size(); ++i) {
      result.segment<3>(3 * static_cast<Eigen::Index>(i)) = accelerations.col(forces[i]);
    }
    return result;
  };

  const double half_distance = 0.5 * (sticks[1].tip - sticks[0].tip).norm();
  const double half_length = 0.5 * parameters_.string.length - parameters_.diabolo.groove.radius;
  if (!(half_distance < half_length))
    throw std::invalid_argument("the tips start further apart than the string is long");
  const double sag = std::sqrt(half_length * half_length - half_distance * half_distance);
  moment.state.col(kPosition) = 0.5 * (sticks[0].tip + sticks[1].tip) - sag * up();

  constexpr double kDifference = 1e-7;  // [m]
  constexpr double kLongestStep = 0.02;
  constexpr int kIterations = 200;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXd force = residual(moment.state);
    if (force.norm() < 1e-8) {
      moment.wrap_reference = shape(moment, moment.state, sticks).wrap;
      return;
    }
    Eigen::MatrixXd jacobian(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      State shifted = moment.state;
      shifted(i % 3, unknown[static_cast<std::size_t>(i / 3)]) += kDifference;
      jacobian.col(i) = (residual(shifted) - force) / kDifference;
    }
    Eigen::VectorXd change = -jacobian.partialPivLu().solve(force);
    change *= std::min(1.0, kLongestStep / change.norm());
    for (Eigen::Index i = 0; i < size; ++i) {
      moment.state(i % 3, unknown[static_cast<std::size_t>(i / 3)]) += change(i);
    }
  }
  throw std::invalid_argument("the diabolo finds no place to hang at rest from the tips' first position");
}

Moment Plant::begin(const Start& start) const {
  const Pair<Stick> sticks = motion_.at(0.0);
  const Vec3 axis = direction_from_angles(start.yaw, start.pitch);
  Moment moment;
  moment.state.col(kAxis) = axis;
  moment.state.col(kReference) = axis.cross(Vec3(-std::sin(start.yaw), std::cos(start.yaw), 0.0));
  moment.state.col(kAngularMomentum) = -parameters_.diabolo.axial_inertia * start.spin * axis;
  moment.chirality = axis.dot((sticks[1].tip - sticks[0].tip).cross(up())) > 0.0 ? 1.0 : -1.0;
  moment.wrap_reference = 2.0 * std::numbers::pi * parameters_.string.wraps + 0.5 * std::numbers::pi;
  if (!start.position) {
    hang(moment);
    return moment;
  }
  moment.state.col(kPosition) = *start.position;
  moment.state.col(kVelocity) = start.velocity;
  if (start.flying) {
    moment.mode = Mode::kFlying;
  } else {
    const StringShape now = shape(moment, moment.state, sticks);
    moment.wrap_reference = now.wrap;
    moment.mode = is_taut(moment, now) ? Mode::kOnString : Mode::kLoose;
  }
  return moment;
}

Reading Plant::read(const Moment& moment) const {
  const State& state = moment.state;
  const DiaboloParameters& diabolo = parameters_.diabolo;
  const StringParameters& string = parameters_.string;
  const Pair<Stick> sticks = motion_.at(moment.time);
  Reading reading;
  reading.tips = tips(state, sticks);

  const Vec3 momentum = state.col(kAngularMomentum);
  const double along = momentum.dot(state.col(kAxis));
  reading.energy =
      0.5 * diabolo.mass * state.col(kVelocity).squaredNorm() -
      diabolo.mass * parameters_.gravity.dot(state.col(kPosition)) +
      0.5 * along * along / diabolo.axial_inertia +
      0.5 * (momentum.squaredNorm() - along * along) / (diabolo.axial_inertia * diabolo.inertia_ratio);
  if (parameters_.sticks.bending_stiffness) {
    for (int side = 0; side < 2; ++side) {
      reading.energy += 0.5 * *parameters_.sticks.bending_stiffness * state.col(kBend[side]).squaredNorm() +
                        0.5 * parameters_.sticks.tip_mass * state.col(kBendRate[side]).squaredNorm() -
                        parameters_.sticks.tip_mass * parameters_.gravity.dot(state.col(kBend[side]));
    }
  }
  if (moment.mode == Mode::kFlying) {
    reading.stretch = std::numeric_limits<double>::quiet_NaN();
    return reading;
  }
  const StringShape now = shape(moment, state, sticks);
  reading.stretch = now.length - string.length;
  reading.wrap = now.wrap;
  if (moment.mode == Mode::kOnString) {
    reading.slip = now.slip;
    reading.tensions = bearing_limited(diabolo, string, moment.chirality, spin_about_axis(diabolo, state),
                                       string_tensions(string, now));
    reading.energy += string.stiffness * reading.stretch * reading.stretch / string.length *
                      (0.5 + reading.stretch / (3.0 * string.stiffening_stretch));
  }
  return reading;
}

std::vector<Moment> simulate(const Plant& plant, const Start& start, const std::vector<double>& times) {
  const double rate = plant.parameters().steps_per_second;
  std::vector<Moment> moments;
  moments.reserve(times.size());
  Moment now = plant.begin(start);
  auto next = times.begin();
  try {
    for (std::int64_t step = 1; next != times.end() && !now.missed; ++step) {
      const double end = static_cast<double>(step) / rate;
      for (; next != times.end() && *next < end; ++next) {
        const Moment moment = *next > now.time ? plant.advanced(now, *next - now.time) : now;
        if (moment.missed) return moments;
        moments.push_back(moment);
      }
      now = plant.advanced(now, end - now.time);
    }
  } catch (const std::domain_error& error) {
    std::ostringstream message;
    message << error.what() << " near " << now.time << " s";
    throw std::domain_error(message.str());
  }
  return moments;
}

}  // namespace plant
