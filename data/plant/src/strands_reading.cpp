// SPDX-License-Identifier: MIT
#include <limits>

#include "strands.hpp"

namespace plant {

/// All but the string's energy [J].
double StrandsPlant::energy(const State& state) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  const Vec3 momentum = state.col(kAngularMomentum);
  const double along = momentum.dot(state.col(kAxis));
  const double across_squared = momentum.squaredNorm() - along * along;
  double energy = 0.5 * diabolo.mass * state.col(kVelocity).squaredNorm() -
                  diabolo.mass * parameters_.gravity.dot(state.col(kPosition)) +
                  0.5 * (along * along + across_squared / diabolo.inertia_ratio) / diabolo.axial_inertia;
  if (parameters_.sticks.bending_stiffness) {
    for (std::size_t side = 0; side < 2; ++side) {
      energy += 0.5 * *parameters_.sticks.bending_stiffness * state.col(kBend[side]).squaredNorm() +
                0.5 * parameters_.sticks.tip_mass * state.col(kBendRate[side]).squaredNorm() -
                parameters_.sticks.tip_mass * parameters_.gravity.dot(state.col(kBend[side]));
    }
  }
  return energy;
}

Reading StrandsPlant::read(const Moment& moment) const {
  const StringParameters string = parameters_.string.at(moment.time);
  const Pair<Stick> sticks = motion_.at(moment.time);
  Reading reading;
  reading.tips = tips(moment.state, sticks);
  reading.energy = energy(moment.state);
  if (moment.mode == Mode::kFlying) {
    reading.stretch = std::numeric_limits<double>::quiet_NaN();
    return reading;
  }
  const StringShape now = shape(moment, moment.state, sticks);
  reading.stretch = now.length - string.length;
  reading.wrap = now.wrap;
  if (reading.stretch > 0.0) {
    reading.energy += string.stiffness * reading.stretch * reading.stretch / string.length *
                      (0.5 + reading.stretch / (3.0 * string.stiffening_stretch));
  }
  if (moment.mode == Mode::kOnString) {
    reading.slip = now.slip;
    reading.tensions =
        bearing_limited(parameters_.diabolo, string, moment.chirality,
                        spin_about_axis(parameters_.diabolo, moment.state), string_tensions(string, now));
    reading.on_tips = {-reading.tensions.left * now.strands[0].direction,
                       -reading.tensions.right * now.strands[1].direction};
  }
  return reading;
}

}  // namespace plant
