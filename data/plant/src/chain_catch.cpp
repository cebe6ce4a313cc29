// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "chain.hpp"

namespace plant {
namespace {

constexpr double kSlipDepth = 0.05;    // below all of the string, and not on it: lost [m]
constexpr double kCatchMargin = 0.01;  // of the cups that a catch must leave free [m]
constexpr double kCatchDepth = 0.005;  // how far past the axle's surface the string may be found [m]
constexpr double kMostWrapCaught = 1.1 * std::numbers::pi;  // [rad]

}  // namespace

/// Cuts the string anew, with the patch around the place at `coordinate` [m of string from the left tip].
void ChainPlant::move_patch(Moment& moment, double coordinate) const {
  ChainState& chain = moment.chain;
  const ChainState old = chain;
  chain.bight = measures_.bight_at(coordinate);
  std::size_t segment = 0;
  for (std::size_t i = 1; i + 1 < chain.places.size(); ++i) {
    const double wanted = measures_.coordinate(i, chain.bight);
    while (measures_.coordinate(segment + 1, old.bight) < wanted) ++segment;
    const double share =
        (wanted - measures_.coordinate(segment, old.bight)) / measures_.rest(segment == old.bight);
    chain.places[i] = (1.0 - share) * old.places[segment] + share * old.places[segment + 1];
    chain.velocities[i] = (1.0 - share) * old.velocities[segment] + share * old.velocities[segment + 1];
  }
}

/// Keeps the patch where the string is nearest to an axle that is not on it.
void ChainPlant::follow(Moment& moment) const {
  const ChainState& chain = moment.chain;
  const Vec3 centre = moment.state.col(kPosition);
  const Vec3 axis = moment.state.col(kAxis);
  double nearest = measures_.spacing;
  double coordinate = -1.0;
  for (std::size_t i = 0; i + 1 < chain.places.size(); ++i) {
    const Vec3 across = perpendicular_part(chain.places[i + 1] - chain.places[i], axis);
    const Vec3 away = perpendicular_part(centre - chain.places[i], axis);
    const double share = std::clamp(across.dot(away) / across.squaredNorm(), 0.0, 1.0);
    const double distance = (away - share * across).norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    coordinate = measures_.coordinate(i, chain.bight) + share * measures_.rest(i == chain.bight);
  }
  const double margin = 0.2 * measures_.patch;
  const bool is_in_patch = coordinate > measures_.coordinate(chain.bight, chain.bight) + margin &&
                           coordinate < measures_.coordinate(chain.bight + 1, chain.bight) - margin;
  if (coordinate >= 0.0 && !is_in_patch) move_patch(moment, coordinate);
}

/// The axle comes down on the string, or the string up to the axle: it holds when it passes between the cups.
void ChainPlant::touch(Moment& moment) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  follow(moment);
  ChainState& chain = moment.chain;
  const Vec3 centre = moment.state.col(kPosition);
  const Vec3 axis = moment.state.col(kAxis);
  const Pair<Vec3> tips = ends(moment);
  const Vec3& place = chain.places[chain.bight];
  const Vec3 along = chain.places[chain.bight + 1] - place;
  const Vec3 across = perpendicular_part(along, axis);
  const double width = across.norm();
  const double share = across.dot(centre - place) / (width * width);
  const double chirality = axis.dot((tips[1] - tips[0]).cross(up())) > 0.0 ? 1.0 : -1.0;
  const Vec3 inwards = chirality / width * axis.cross(across);
  const double height = inwards.dot(centre - place) - measures_.contact_radius;
  const Vec3 velocity =
      (1.0 - share) * chain.velocities[chain.bight] + share * chain.velocities[chain.bight + 1];
  const double aside = axis.dot(place + share * along - centre);
  const double wrap = bight_around({centre, axis, chirality, aside}, diabolo.groove, measures_.contact_radius,
                                   {place, chain.places[chain.bight + 1]})
                          .wrap;
  if (height <= 0.0 && height > -kCatchDepth && share > 0.0 && share < 1.0 && wrap > 0.0 &&
      wrap < kMostWrapCaught && inwards.dot(moment.state.col(kVelocity) - velocity) < 0.0) {
    // The slant of the whole string counts: a slack one is wavy, but the cups guide it.
    const Vec3 chord = tips[1] - tips[0];
    const double slant = std::abs(axis.dot(chord)) / perpendicular_part(chord, axis).norm();
    const double reach = std::abs(aside) + 0.5 * diabolo.diameter * slant;
    const double to_tip = std::min((tips[0] - centre).norm(), (tips[1] - centre).norm());
    chain.touching = reach < 0.5 * diabolo.length - kCatchMargin && to_tip > diabolo.diameter;
    moment.missed = !chain.touching;
    moment.chirality = chirality;
    chain.aside = aside;
    return;
  }
  double lowest = up().dot(tips[1]);
  for (const Vec3& node : chain.places) lowest = std::min(lowest, up().dot(node));
  moment.missed = up().dot(centre) < lowest - kSlipDepth;
}

}  // namespace plant
