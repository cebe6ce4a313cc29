// SPDX-License-Identifier: MIT
#include "catching.hpp"

#include <algorithm>
#include <utility>

namespace plant {
namespace {

constexpr double kClose = 0.002;          // a catch that needs no more aiming [m]
constexpr double kFarthestReach = 0.5;    // [m]
constexpr double kMiddle = 0.2;           // least share of the string that a catch leaves at either side
constexpr double kShortestFlight = 0.08;  // that anyone can react to [s]
constexpr double kEarly = 0.02;           // the hands are there so long before the landing [s]
constexpr double kStay = 0.4;             // they stay so long after it [s]
constexpr double kReturn = 0.8;           // and take so long to come home [s]
constexpr int kAims = 4;

Moment landing(const Plant& plant, Moment moment, double end) {
  const double step = 1.0 / plant.parameters().steps_per_second;
  while (moment.time < end && !moment.missed && moment.mode == Mode::kFlying) {
    moment = plant.advanced(std::move(moment), step);
  }
  return moment;
}

/// From the string's middle part to the diabolo [m].
Vec3 distance_from_middle(const Motion& motion, const Moment& moment) {
  const Pair<Stick> sticks = motion.at(moment.time);
  const Vec3 chord = sticks[1].tip - sticks[0].tip;
  const Vec3 centre = moment.state.col(kPosition);
  const double share = chord.dot(centre - sticks[0].tip) / chord.squaredNorm();
  return centre - sticks[0].tip - std::clamp(share, kMiddle, 1.0 - kMiddle) * chord;
}

}  // namespace

Motion with_catch(const PlantParameters& parameters, const Motion& planned, Moment& moment, double end) {
  const Moment release = moment;
  Motion motion = planned;
  Vec3 offset = Vec3::Zero();
  for (int aim = 0; aim <= kAims; ++aim) {
    moment = landing(*make_plant(parameters, motion), release, end);
    const bool has_landed = moment.missed || moment.mode != Mode::kFlying;
    const Vec3 error = distance_from_middle(motion, moment);
    if (!has_landed || moment.time - release.time < kShortestFlight || error.norm() < kClose) break;
    if ((offset + error).norm() > kFarthestReach || aim == kAims) break;
    offset += error;
    const double time = moment.time;
    motion = planned.reaching(
        {release.time, time - kEarly, time + kStay, time + kStay + kReturn, {offset, offset}});
  }
  return motion;
}

}  // namespace plant
