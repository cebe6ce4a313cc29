// SPDX-License-Identifier: MIT
#include "live.hpp"

#include <array>
#include <cmath>
#include <istream>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "recording.hpp"

namespace plant {
namespace {

constexpr double kLongestPeriod = 1.0;        // [s]
constexpr double kMostAcceleration = 1000.0;  // of a hand [m/s^2]

/// A period of the hands.
struct Period {
  double duration = 0.0;  ///< [s]
  Pair<Vec3> accelerations{Vec3::Zero(), Vec3::Zero()};
};

Period read_period(const std::string& line) {
  std::istringstream words(line);
  std::array<double, 7> n{};
  for (double& number : n) words >> number;
  std::string more;
  bool good = !words.fail() && !(words >> more) && n[0] > 0.0 && n[0] <= kLongestPeriod;
  for (std::size_t i = 1; i < n.size(); ++i) good = good && std::abs(n[i]) <= kMostAcceleration;
  if (!good) {
    throw std::invalid_argument("period: found '" + line +
                                "'; expected a duration up to 1 s and six accelerations");
  }
  return {n[0], {Vec3(n[1], n[2], n[3]), Vec3(n[4], n[5], n[6])}};
}

void write_moment(std::ostream& out, const PlantParameters& parameters, const Moment& moment,
                  const Motion& motion) {
  out << moment.time << ' ' << (moment.missed ? "MISSED" : mode_name(moment.mode));
  const auto write = [&](const Vec3& vector) {
    out << ' ' << vector.x() << ' ' << vector.y() << ' ' << vector.z();
  };
  write(moment.state.col(kPosition));
  write(moment.state.col(kVelocity));
  out << ' ' << play_spin(parameters.diabolo, moment.state);
  for (const Stick& stick : motion.at(moment.time)) write(stick.tip);
  write(moment.state.col(kAxis));
  out << std::endl;
}

/// The hands' state where a push ends.
Push followed(const Push& push, const Period& next) {
  Push result{push.end, push.end + next.duration, {}, {}, next.accelerations};
  const double time = push.end - push.begin;
  for (std::size_t side = 0; side < 2; ++side) {
    result.tips[side] =
        push.tips[side] + time * (push.velocities[side] + 0.5 * time * push.accelerations[side]);
    result.velocities[side] = push.velocities[side] + time * push.accelerations[side];
  }
  return result;
}

}  // namespace

void play_live(const Scenario& scenario, std::istream& in, std::ostream& out) {
  const PlantParameters& parameters = scenario.plant;
  out.precision(12);
  const Pair<Stick> home = scenario.motion.at(0.0);
  Push push{0.0, 0.0, {home[0].tip, home[1].tip}, {Vec3::Zero(), Vec3::Zero()}, {Vec3::Zero(), Vec3::Zero()}};
  Motion motion = scenario.motion.pushed(push);
  Moment now = make_plant(parameters, motion)->begin(scenario.start);
  write_moment(out, parameters, now, motion);
  const double longest = 1.0 / parameters.steps_per_second;
  for (std::string line; !now.missed && std::getline(in, line);) {
    push = followed(push, read_period(line));
    motion = scenario.motion.pushed(push);
    const std::unique_ptr<Plant> plant = make_plant(parameters, motion);
    const auto steps = static_cast<int>(std::ceil((push.end - push.begin) / longest));
    for (int step = 1; step <= steps && !now.missed; ++step) {
      const double end = push.begin + (push.end - push.begin) * step / steps;
      now = plant->advanced(std::move(now), end - now.time);
    }
    write_moment(out, parameters, now, motion);
  }
}

}  // namespace plant
