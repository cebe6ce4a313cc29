// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "motions.hpp"

namespace diabolo {

/// A point mass on an inextensible massless string, integrated independently of the library: the constraint
/// differentiated twice and solved for the tension (index reduction), classical Runge-Kutta of fourth order,
/// slackening and snapping taut located within the step. The catch is inelastic along the string.
class Reference {
 public:
  Reference(const Motion& motion, const State<double>& start, double gravity)
      : motion_(motion), gravity_(0.0, 0.0, -gravity), x_(start.position), v_(start.velocity) {}

  /// Advances by `dt` [s].
  void step(double dt) {
    for (int events = 0; dt > 0.0 && events < kMaximumEvents; ++events) dt = taut_ ? taut(dt) : slack(dt);
    drift_ = std::max(drift_, string(time_, x_, v_).length - kStringLength);
  }

  const Vector3<double>& position() const { return x_; }  ///< [m]
  double slack_time() const { return slack_time_; }       ///< [s]
  double snap_speed() const { return snap_speed_; }       ///< greatest that a catch took away [m/s]
  double drift() const { return drift_; }  ///< most that the string was ever longer than it is [m]

 private:
  static constexpr int kMaximumEvents = 8;

  struct String {
    Vector3<double> pull;     ///< sum of the unit vectors towards the tips
    double length, rate;      ///< [m], [m/s]
    double tension_per_mass;  ///< that keeps the second derivative of the length zero [m/s^2]
  };

  String string(double time, const Vector3<double>& x, const Vector3<double>& v) const {
    const TipSample tips = motion_.at(time);
    const Vector3<double> to_left = tips.left - x, to_right = tips.right - x;
    const double left = to_left.norm(), right = to_right.norm();
    const Vector3<double> e1 = to_left / left, e2 = to_right / right;
    const Vector3<double> v1 = tips.left_velocity - v, v2 = tips.right_velocity - v;
    const double r1 = e1.dot(v1), r2 = e2.dot(v2);
    const double centripetal = (v1.squaredNorm() - r1 * r1) / left + (v2.squaredNorm() - r2 * r2) / right;
    const double wanted = e1.dot(tips.left_acceleration) + e2.dot(tips.right_acceleration) + centripetal;
    const Vector3<double> pull = e1 + e2;
    return {pull, left + right, r1 + r2, (wanted - gravity_.dot(pull)) / pull.squaredNorm()};
  }

  Vector3<double> acceleration(double time, const Vector3<double>& x, const Vector3<double>& v) const {
    const String s = string(time, x, v);
    return gravity_ + s.pull * s.tension_per_mass;
  }

  void runge_kutta(double dt, Vector3<double>& x, Vector3<double>& v) const {
    const double h = 0.5 * dt;
    const Vector3<double> a1 = acceleration(time_, x_, v_);
    const Vector3<double> v2 = v_ + a1 * h, a2 = acceleration(time_ + h, x_ + v_ * h, v2);
    const Vector3<double> v3 = v_ + a2 * h, a3 = acceleration(time_ + h, x_ + v2 * h, v3);
    const Vector3<double> v4 = v_ + a3 * dt, a4 = acceleration(time_ + dt, x_ + v3 * dt, v4);
    x = x_ + (v_ + (v2 + v3) * 2.0 + v4) * (dt / 6.0);
    v = v_ + (a1 + (a2 + a3) * 2.0 + a4) * (dt / 6.0);
  }

  void fall(double dt, Vector3<double>& x, Vector3<double>& v) const {
    x = x_ + v_ * dt + gravity_ * (0.5 * dt * dt);
    v = v_ + gravity_ * dt;
  }

  void accept(double dt, const Vector3<double>& x, const Vector3<double>& v) {
    x_ = x;
    v_ = v;
    time_ += dt;
  }

  /// Part of `dt` up to the sign change of `outside`, which is false at 0 and true at `dt`.
  template <class Outside>
  static double locate(double dt, Outside&& outside) {
    double low = 0.0, high = dt;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (outside(middle) ? high : low) = middle;
    }
    return high;
  }

  /// Advances on the taut string; returns what is left of `dt` when it slackens.
  double taut(double dt) {
    Vector3<double> x, v;
    const auto slackens = [&](double part) {
      runge_kutta(part, x, v);
      return string(time_ + part, x, v).tension_per_mass < 0.0;
    };
    if (slackens(0.0)) {
      taut_ = false;
      return dt;
    }
    if (!slackens(dt)) {
      accept(dt, x, v);
      return 0.0;
    }
    const double part = locate(dt, slackens);
    runge_kutta(part, x, v);
    accept(part, x, v);
    taut_ = false;
    return dt - part;
  }

  /// Falls freely; returns what is left of `dt` when the string snaps taut.
  double slack(double dt) {
    Vector3<double> x, v;
    const auto snaps = [&](double part) {
      fall(part, x, v);
      const String s = string(time_ + part, x, v);
      return s.length > kStringLength && s.rate > 0.0;
    };
    const double part = snaps(dt) ? locate(dt, snaps) : dt;
    const bool snapped = snaps(part);
    accept(part, x, v);
    slack_time_ += part;
    if (snapped) {
      const String s = string(time_, x_, v_);
      v_ += s.pull * (s.rate / s.pull.squaredNorm());
      taut_ = true;
      snap_speed_ = std::max(snap_speed_, s.rate);
    }
    return dt - part;
  }

  const Motion& motion_;
  Vector3<double> gravity_, x_, v_;
  double time_ = 0.0, slack_time_ = 0.0, snap_speed_ = 0.0, drift_ = 0.0;
  bool taut_ = true;
};

}  // namespace diabolo
