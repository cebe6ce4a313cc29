// SPDX-License-Identifier: MIT
#include "strands.hpp"

namespace plant {
Pair<Vec3> StrandsPlant::tips(const State& state, const Pair<Stick>& sticks) const {
  return {sticks[0].tip + state.col(kLeftBend), sticks[1].tip + state.col(kRightBend)};
}

StringShape StrandsPlant::shape(const Moment& moment, const State& state, const Pair<Stick>& sticks) const {
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

/// Rate of a state at a time [s], in the moment's mode.
State StrandsPlant::rate(const Moment& moment, double time, const State& state,
                         const Pair<Stick>& sticks) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  const StringParameters string = parameters_.string.at(time);
  State rate = State::Zero();
  rate.col(kPosition) = state.col(kVelocity);
  rate.col(kVelocity) = parameters_.gravity;
  add_rotation(diabolo, state, rate);
  const Vec3 tips_velocity =
      0.5 * (sticks[0].velocity + state.col(kLeftBendRate) + sticks[1].velocity + state.col(kRightBendRate));
  add_drags(diabolo, parameters_.air, meeting(diabolo, state, time, tips_velocity), rate);

  Pair<Vec3> pulls{Vec3::Zero(), Vec3::Zero()};
  if (moment.mode == Mode::kOnString) {
    const StringShape taut = shape(moment, state, sticks);
    const Tensions tensions = bearing_limited(diabolo, string, moment.chirality,
                                              spin_about_axis(diabolo, state), string_tensions(string, taut));
    add_string_pull(diabolo, taut, tensions, moment.chirality * string.lay, state, rate);
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

State StrandsPlant::runge_kutta(const Moment& moment, double step) const {
  const double middle = moment.time + 0.5 * step;
  const double end = moment.time + step;
  const Pair<Stick> at_start = motion_.at(moment.time);
  const Pair<Stick> at_middle = motion_.at(middle);
  const Pair<Stick> at_end = motion_.at(end);
  const State& state = moment.state;
  const State k1 = rate(moment, moment.time, state, at_start);
  const State k2 = rate(moment, middle, state + 0.5 * step * k1, at_middle);
  const State k3 = rate(moment, middle, state + 0.5 * step * k2, at_middle);
  const State k4 = rate(moment, end, state + step * k3, at_end);
  return state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// One smooth step in the present mode.
Moment StrandsPlant::stepped(const Moment& moment, double step) const {
  Moment next = moment;
  next.time += step;
  next.state = runge_kutta(moment, step);
  next.state.col(kAxis).normalize();
  next.state.col(kReference) =
      perpendicular_part(next.state.col(kReference), next.state.col(kAxis)).normalized();
  if (next.mode != Mode::kFlying) next.wrap_reference = shape(next, next.state, motion_.at(next.time)).wrap;
  return next;
}

}  // namespace plant
