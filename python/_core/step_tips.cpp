// SPDX-License-Identifier: MIT
#include "step_tips.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace diabolo::python {

namespace {

/// A stick's direction: a unit vector, or zero where it is not known.
Vector3<double> to_direction(const Array& array, const std::string& name) {
  const Vector3<double> direction = to_vector3(array, name);
  if (!is_direction(direction))
    throw std::invalid_argument(name + ": norm " + std::to_string(direction.norm()) +
                                "; expected a unit vector, or zero where it is not known");
  return direction;
}

}  // namespace

StepTips::StepTips(const Array& left0, const Array& right0, const Array& left1, const Array& right1,
                   double dt, const std::optional<std::array<Array, 4>>& velocities,
                   const std::optional<std::array<Array, 4>>& directions, double time) {
  if (!std::isfinite(time)) throw std::invalid_argument("time: not finite");
  if (!(dt > 0.0) || !std::isfinite(dt))
    throw std::invalid_argument("dt: " + std::to_string(dt) + " s; must be positive and finite");
  begin.time = time;
  end.time = time + dt;
  begin.left = to_vector3(left0, "left0");
  begin.right = to_vector3(right0, "right0");
  end.left = to_vector3(left1, "left1");
  end.right = to_vector3(right1, "right1");
  if (velocities) {
    begin.left_velocity = to_vector3((*velocities)[0], "velocities[0]");
    begin.right_velocity = to_vector3((*velocities)[1], "velocities[1]");
    end.left_velocity = to_vector3((*velocities)[2], "velocities[2]");
    end.right_velocity = to_vector3((*velocities)[3], "velocities[3]");
  } else {
    begin.left_velocity = end.left_velocity = (end.left - begin.left) * (1.0 / dt);
    begin.right_velocity = end.right_velocity = (end.right - begin.right) * (1.0 / dt);
  }
  if (directions) {
    begin.left_direction = to_direction((*directions)[0], "directions[0]");
    begin.right_direction = to_direction((*directions)[1], "directions[1]");
    end.left_direction = to_direction((*directions)[2], "directions[2]");
    end.right_direction = to_direction((*directions)[3], "directions[3]");
  }
}

}  // namespace diabolo::python
