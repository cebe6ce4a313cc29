// SPDX-License-Identifier: MIT
#include "plant.hpp"

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "chain.hpp"
#include "strands.hpp"

namespace plant {
namespace {

constexpr double kFastest = 1000.0;  // far beyond play: the integrator has lost it [m/s]

}  // namespace

std::unique_ptr<Plant> make_plant(PlantParameters parameters, Motion motion) {
  if (parameters.structure == Structure::kChain) {
    return std::make_unique<ChainPlant>(std::move(parameters), std::move(motion));
  }
  return std::make_unique<StrandsPlant>(std::move(parameters), std::move(motion));
}

Vec3 Plant::up() const {
  const double strength = parameters_.gravity.norm();
  return strength > 0.0 ? Vec3(-parameters_.gravity / strength) : Vec3(Vec3::UnitZ());
}

double Plant::height_above(const Pair<Vec3>& ends, const Vec3& place) const {
  const Vec3 chord = (ends[1] - ends[0]).normalized();
  return perpendicular_part(up(), chord).normalized().dot(place - ends[0]);
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
        Moment moment = *next > now.time ? plant.advanced(now, *next - now.time) : now;
        if (moment.missed) return moments;
        moments.push_back(std::move(moment));
      }
      const double left = end - now.time;
      now = plant.advanced(std::move(now), left);
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
