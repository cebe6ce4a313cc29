// SPDX-License-Identifier: MIT
#include "plant.hpp"

#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace plant {
namespace {

constexpr double kFastest = 1000.0;  // far beyond play: the integrator has lost it [m/s]

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
  add_drags(diabolo, parameters_.air, state, rate);

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
    for (std::size_t side = 0; side < 2; ++side) {
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
      if (!(now.state.col(kVelocity).norm() < kFastest)) {
        throw std::domain_error("the play diverges: too few steps per second");
      }
    }
  } catch (const std::domain_error& error) {
    std::ostringstream message;
    message << error.what() << " near " << now.time << " s";
    throw std::domain_error(message.str());
  }
  return moments;
}

}  // namespace plant
