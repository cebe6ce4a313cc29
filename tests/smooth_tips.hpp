// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "diabolo/sticks.hpp"
#include "random.hpp"

/// One tip on a closed curve: center + amplitude * sin(rate * t + phase), component by component.
struct SmoothTip {
  using Vector = diabolo::Vector3<double>;
  Vector center = Vector::Zero(), amplitude = Vector::Zero(), phase = Vector::Zero();
  double rate = 0.0;  ///< [rad/s]

  Vector position(double t) const { return center + amplitude.cwiseProduct(sines(t, 0.0)); }
  Vector velocity(double t) const { return amplitude.cwiseProduct(sines(t, M_PI_2)) * rate; }
  Vector acceleration(double t) const { return -amplitude.cwiseProduct(sines(t, 0.0)) * rate * rate; }

 private:
  Vector sines(double t, double ahead) const { return (phase.array() + (rate * t + ahead)).sin().matrix(); }
};

/// Both tips of a player who moves them smoothly, as exact functions of time.
struct SmoothTips {
  SmoothTip left, right;

  static SmoothTips random(Random& random, double distance, double amplitude, double fastest_rate) {
    SmoothTips tips;
    const diabolo::Vector3<double> half(0.0, 0.5 * distance, 0.0), center(0.0, 0.0, 1.0);
    tips.left = {center + half, random.vector(amplitude), random.vector(M_PI),
                 random.uniform(1.0, fastest_rate)};
    tips.right = {center - half, random.vector(amplitude), random.vector(M_PI),
                  random.uniform(1.0, fastest_rate)};
    return tips;
  }

  diabolo::Tips<double> at(double t) const {
    return {left.position(t), right.position(t), left.velocity(t), right.velocity(t)};
  }
};

/// A point mass on a taut string, by its equation with the constraint differentiated twice: the acceleration
/// along the bisector n of the strands' directions e_j (towards the tips) is
/// [sum a_j.e_j + |v_j across e_j|^2 / l_j] / |e_1 + e_2|, with a_j, v_j of the tip (v_j relative to the
/// diabolo); across n it is gravity's. Integrated by the classical Runge-Kutta method.
struct TautReference {
  using Vector = diabolo::Vector3<double>;
  SmoothTips tips;
  Vector gravity{0.0, 0.0, -diabolo::kStandardGravity};
  Vector position = Vector::Zero(), velocity = Vector::Zero();
  double time = 0.0;

  /// Acceleration by string and gravity [m/s^2], and the tension over the mass [m/s^2].
  std::pair<Vector, double> acceleration(const Vector& p, const Vector& v, double t) const {
    Vector sum = Vector::Zero();
    double wanted = 0.0;
    for (const SmoothTip* tip : {&tips.left, &tips.right}) {
      const Vector strand = tip->position(t) - p, relative = tip->velocity(t) - v;
      const double length = strand.norm();
      const Vector e = strand / length;
      wanted += tip->acceleration(t).dot(e) + (relative - e * e.dot(relative)).squaredNorm() / length;
      sum += e;
    }
    const Vector n = sum.normalized();
    const double along = wanted / sum.norm(), by_gravity = gravity.dot(n);
    return {gravity + n * (along - by_gravity), (along - by_gravity) / sum.norm()};
  }

  double tension() const { return acceleration(position, velocity, time).second; }

  /// Advances to `end` in equal steps of about `dt`; returns the least tension over mass on the way.
  double advance(double end, double dt) {
    const int count = std::max(1, static_cast<int>(std::lround((end - time) / dt)));
    const double h = (end - time) / count, begin = time;
    double least = tension();
    for (int i = 0; i < count; ++i) {
      time = begin + i * h;
      const Vector a1 = acceleration(position, velocity, time).first;
      const Vector v2 = velocity + a1 * (0.5 * h);
      const Vector a2 = acceleration(position + velocity * (0.5 * h), v2, time + 0.5 * h).first;
      const Vector v3 = velocity + a2 * (0.5 * h);
      const Vector a3 = acceleration(position + v2 * (0.5 * h), v3, time + 0.5 * h).first;
      const Vector v4 = velocity + a3 * h;
      const Vector a4 = acceleration(position + v3 * h, v4, time + h).first;
      position += (velocity + 2.0 * v2 + 2.0 * v3 + v4) * (h / 6.0);
      velocity += (a1 + 2.0 * a2 + 2.0 * a3 + a4) * (h / 6.0);
      time = begin + (i + 1) * h;
      least = std::min(least, tension());
    }
    return least;
  }

  /// Removes the part of the velocity that would change the path's length: a state that the string allows.
  void make_consistent() {
    const Vector l = position - tips.left.position(time), r = position - tips.right.position(time);
    const Vector e1 = l.normalized(), e2 = r.normalized(), gradient = e1 + e2;
    const double rate =
        e1.dot(velocity - tips.left.velocity(time)) + e2.dot(velocity - tips.right.velocity(time));
    velocity -= gradient * (rate / gradient.squaredNorm());
  }
};
