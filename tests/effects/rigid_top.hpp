// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <cmath>

/// A rigid body of revolution on two springs, by Euler's equations in the body's frame and the method of
/// Runge and Kutta; it shares nothing with the library. The springs run from the tips to the two points where
/// they leave the axle, and an arc lies between these.
struct RigidTop {
  using Vector = Eigen::Vector3d;

  double mass = 0.29, axial = 5.4e-4, transverse = 6.5e-4;  ///< [kg], [kg m^2]
  double radius = 0.0065;                                   ///< of the axle [m]
  double profile = 0.0, half_width = 0.0;                   ///< of the groove [m]
  double length = 1.45;                                     ///< of the string [m]
  double stiffness = 1e5, damping = 60.0;                   ///< of the whole string [N/m], [N s/m]

  /// Place, velocity, the body's axes in its columns, of which the first is the axle, and the angular
  /// velocity in them.
  struct Body {
    Vector place, velocity;
    Eigen::Matrix3d axes;
    Vector turning;
    Body plus(const Body& rate, double dt) const {
      return {place + dt * rate.place, velocity + dt * rate.velocity, axes + dt * rate.axes,
              turning + dt * rate.turning};
    }
  };
  struct Ends {
    Vector left, right, left_velocity, right_velocity;
  };

  /// At rest beside the spin [rad/s], positive about the axle's negative direction.
  static Body begin(const Vector& place, const Vector& velocity, const Vector& axle, double spin) {
    Body body{place, velocity, Eigen::Matrix3d::Zero(), {-spin, 0.0, 0.0}};
    body.axes.col(0) = axle;
    body.axes.col(1) = Vector::UnitZ().cross(axle).normalized();
    body.axes.col(2) = axle.cross(body.axes.col(1));
    return body;
  }

  /// The point of the axle's circle at `arm` where a straight line from a tip touches it, on the side that is
  /// turned from `other`.
  Vector touching(const Vector& axle, const Vector& to_tip, const Vector& down) const {
    const Vector flat = to_tip - axle * axle.dot(to_tip);
    const double distance = flat.norm(), along = radius * radius / distance,
                 aside = radius * std::sqrt(1.0 - along / distance);
    Vector square = axle.cross(flat / distance);
    if (square.dot(down) < 0.0) square = -square;
    return flat / distance * along + square * aside;
  }

  Body rate(const Body& body, const Ends& ends) const {
    const Vector axle = body.axes.col(0);
    const Vector to_left = ends.left - body.place, to_right = ends.right - body.place;
    const Vector up = to_left.normalized() + to_right.normalized();
    const double climbed = profile * axle.dot(up.normalized());
    const Vector middle = axle * std::min(half_width, std::max(-half_width, climbed));
    const Vector on_left = touching(axle, to_left - middle, -up),
                 on_right = touching(axle, to_right - middle, -up);
    const Vector left = to_left - middle - on_left, right = to_right - middle - on_right;
    const double arc = radius * std::acos(on_left.normalized().dot(on_right.normalized()));
    const double longer = left.norm() + right.norm() + arc - length;
    const double rate = left.normalized().dot(ends.left_velocity - body.velocity) +
                        right.normalized().dot(ends.right_velocity - body.velocity);
    const double tension = longer > 0.0 ? std::max(0.0, stiffness * longer + damping * rate) : 0.0;
    const Vector pull_left = tension * left.normalized(), pull_right = tension * right.normalized();
    Vector torque = (middle + on_left).cross(pull_left) + (middle + on_right).cross(pull_right);
    torque -= axle * axle.dot(torque);  // without friction all that pushes the axle points at its middle

    const Vector turning = body.axes * body.turning;
    Body change;
    change.place = body.velocity;
    change.velocity = (pull_left + pull_right) / mass - 9.80665 * Vector::UnitZ();
    for (int k = 0; k < 3; ++k) change.axes.col(k) = turning.cross(body.axes.col(k));
    const Vector inertia{axial, transverse, transverse};
    const Vector momentum = inertia.cwiseProduct(body.turning);
    change.turning = (body.axes.transpose() * torque - body.turning.cross(momentum)).cwiseQuotient(inertia);
    return change;
  }

  /// After `count` steps of `dt` from the time `begin`; `ends` is a function of the time.
  template <class EndsAt>
  Body advanced(Body body, EndsAt&& ends, double begin, double dt, int count) const {
    for (int i = 0; i < count; ++i) {
      const double t = begin + i * dt;
      const Ends first = ends(t), middle = ends(t + 0.5 * dt), last = ends(t + dt);
      const Body a = rate(body, first), b = rate(body.plus(a, 0.5 * dt), middle),
                 c = rate(body.plus(b, 0.5 * dt), middle), d = rate(body.plus(c, dt), last);
      body = body.plus(a, dt / 6.0).plus(b, dt / 3.0).plus(c, dt / 3.0).plus(d, dt / 6.0);
      body.axes.col(0).normalize();
      body.axes.col(1) =
          (body.axes.col(1) - body.axes.col(0) * body.axes.col(0).dot(body.axes.col(1))).normalized();
      body.axes.col(2) = body.axes.col(0).cross(body.axes.col(1));
    }
    return body;
  }
};
