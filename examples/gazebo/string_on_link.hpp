// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/hosts/seen_tips.hpp"
#include "diabolo/text/shown.hpp"
#include "string_element.hpp"

namespace diabolo_gazebo {

using diabolo::Tips;
using diabolo::Vector3;

/// A vector of Gazebo's mathematics.
template <class GazeboVector>
Vector3<double> vector_of(const GazeboVector& v) {
  return {v.X(), v.Y(), v.Z()};
}

/// What Gazebo integrates: the link that the string pulls, and the one that spins on it.
struct Body {
  double mass;           ///< of both [kg]
  double axial_inertia;  ///< of the one that spins, about x [kg m^2]
};

/// Of the inertia of the link, and of the one that spins; the same one, where it spins itself. Throws
/// std::invalid_argument where a centre of mass is beside the link's origin, or a link weighs nothing.
template <class Inertial>
Body body_of(const Inertial& link, const Inertial& spinning) {
  for (const Inertial* inertial : {&link, &spinning}) {
    if (!(inertial->MassMatrix().Mass() > 0.0))
      throw std::invalid_argument("<link>: a mass of " + diabolo::shown(inertial->MassMatrix().Mass()) +
                                  " kg; expected more than 0");
    if (vector_of(inertial->Pose().Pos()).norm() > 1e-9)
      throw std::invalid_argument("<link>: its centre of mass is beside its origin; expected it there");
  }
  const double mass = link.MassMatrix().Mass();
  return {&link == &spinning ? mass : mass + spinning.MassMatrix().Mass(), spinning.Moi()(0, 0)};
}

/// Throws std::invalid_argument where the diabolo's model has further links, whose mass nobody would count.
inline void check_links(std::uint64_t count, bool spins_itself) {
  if (count != (spins_itself ? 1 : 2))
    throw std::invalid_argument("<link>: the model has " + std::to_string(count) + " links; expected <link>" +
                                (spins_itself ? "" : " and <spinning_link>") + " alone");
}

/// Our string on a link, by whoever moves it: the engine alone, or a Gazebo server.
class StringOnLink {
 public:
  /// `model` is that of the element's attributes. Throws std::invalid_argument where a number is out of its
  /// range.
  StringOnLink(const diabolo::Model& model, const Body& body, const Vector3<double>& gravity)
      : string_(diabolo::attach_string(model, body.mass, body.axial_inertia, gravity,
                                       diabolo::HostMotion::kNewVelocity)) {}

  const diabolo::Parameters<double>& parameters() const { return string_.predictor().parameters(); }

  /// Forgets the steps before, as after a jump of the link.
  void reset() {
    memory_.reset();
    tips_ = {};
  }

  /// What acts over the step of `dt` [s] that begins now. Throws std::runtime_error where the link or a tip
  /// is not at a finite place.
  diabolo::StringWrench step(const diabolo::HostBody& body, const Tips<double>& begin,
                             const Tips<double>& end, double dt) {
    if (!memory_) memory_ = string_.begin(body.position, begin);
    const diabolo::StringWrench wrench = string_.step(body, begin, end, dt, *memory_);
    if (!wrench.force.allFinite() || !wrench.torque.allFinite() || !wrench.on_left.allFinite() ||
        !wrench.on_right.allFinite())
      throw std::runtime_error("the link or a tip is not at a finite place " + std::to_string(begin.time) +
                               " s after the start");
    return wrench;
  }

  /// A tip as Gazebo shows it before a step.
  struct SeenTip {
    Vector3<double> place, velocity, direction;
    bool placed;  ///< whether `place` is where it is to be after the step
  };

  /// A step whose tips are seen only from step to step; see diabolo::placed_tip() and moving_tip().
  diabolo::StringWrench step(const diabolo::HostBody& body, const std::array<SeenTip, 2>& tips, double time,
                             double dt) {
    std::array<diabolo::TipStep, 2> steps;
    for (std::size_t k = 0; k < 2; ++k) {
      const SeenTip& tip = tips[k];
      steps[k] = tip.placed ? diabolo::placed_tip(tip.place, dt, tips_[k])
                            : diabolo::moving_tip(tip.place, tip.velocity, dt, tips_[k]);
      steps[k].direction = tip.direction;
    }
    const auto [begin, end] = diabolo::tips_of_step(steps[0], steps[1], time, dt);
    return step(body, begin, end, dt);
  }

  diabolo::StringState state() const {
    return memory_ ? memory_->string_state : diabolo::StringState::kLoose;
  }

 private:
  diabolo::AttachedString string_;
  std::optional<diabolo::StringMemory> memory_;
  std::array<std::optional<diabolo::TipMemory>, 2> tips_;
};

}  // namespace diabolo_gazebo
