// SPDX-License-Identifier: MIT
#include "player.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "catching.hpp"
#include "steering.hpp"

namespace plant {
namespace {

constexpr double kLook = 0.5;  // between two looks at the axis, and of each move of the hands [s]
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

Motion played_by(const Player& player, const PlantParameters& parameters, const Start& start,
                 const Motion& planned, double duration) {
  Motion motion = planned;
  if (!player.catches && !player.steers) return motion;
  Moment now = make_plant(parameters, motion)->begin(start);
  double offset = 0.0;
  const double rate = parameters.steps_per_second;
  while (now.time < duration && !now.missed) {
    const double look = kLook * (std::floor(now.time / kLook + 1e-6) + 1.0);
    const std::unique_ptr<Plant> plant = make_plant(parameters, motion);
    while (now.time < std::min(look, duration) && !now.missed) {
      const bool was_flying = now.mode == Mode::kFlying;
      now = plant->advanced(std::move(now), 1.0 / rate);
      if (player.catches && !was_flying && now.mode == Mode::kFlying) break;
    }
    if (player.catches && now.mode == Mode::kFlying && now.time < look) {
      motion = with_catch(parameters, motion, now, duration);
    } else if (player.steers) {
      const double wanted = steering_offset(parameters.diabolo, now.state);
      const Vec3 change((wanted - offset), 0.0, 0.0);
      motion = motion.reaching({now.time, now.time + kLook, kNever, kNever, {change, -change}});
      offset = wanted;
    }
  }
  return motion;
}

}  // namespace plant
