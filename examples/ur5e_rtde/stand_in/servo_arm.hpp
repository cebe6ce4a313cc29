// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "diabolo/robot/arm/joint_limits.hpp"

namespace stand_in {

using JointVector = diabolo::Joints<double>;

/// The joints of an arm, as its controller moves them. A servo follows late: qdd = gain (target - q -
/// lookahead qd), a model that behaves as a UR5e's servoj is seen to, and no more than that.
class ServoArm {
 public:
  explicit ServoArm(const JointVector& joints) : joints_(joints), before_(joints), target_(joints) {}

  const JointVector& joints() const { return joints_; }
  const JointVector& published() const { return before_; }  ///< what sensors say: a tick old
  const JointVector& speed() const { return speed_; }
  const JointVector& target() const { return target_; }
  bool servoing() const { return mode_ == Mode::kServo; }
  bool moving() const { return mode_ == Mode::kMove; }
  bool resting() const { return mode_ == Mode::kBrake && speed_.isZero(); }

  /// How far the target would jump from the one before, or from where the arm is [rad].
  double jump_to(const JointVector& target) const {
    return (target - (servoing() ? target_ : joints_)).cwiseAbs().maxCoeff();
  }
  void servo(const JointVector& target, double lookahead, double gain) {
    mode_ = Mode::kServo;
    target_ = target;
    lookahead_ = lookahead;
    gain_ = gain;
  }
  /// A straight line of the joints from rest to rest; the joint with the longest way has this speed and
  /// acceleration.
  void move(const JointVector& goal, double speed, double acceleration) {
    mode_ = Mode::kMove;
    from_ = joints_;
    target_ = goal;
    move_speed_ = speed;
    move_acceleration_ = acceleration;
    moved_for_ = 0;
  }
  void turn(const JointVector& speed, double acceleration) {
    mode_ = Mode::kTurn;
    wanted_speed_ = speed;
    deceleration_ = acceleration;
  }
  void brake(double deceleration) {
    mode_ = Mode::kBrake;
    deceleration_ = std::max(deceleration, 0.1);
  }

  /// A tick; `scaling` is how fast the controller lets time pass.
  void tick(double scaling) {
    const double h = diabolo::kTick * scaling;
    before_ = joints_;
    switch (mode_) {
      case Mode::kServo: {
        constexpr int kParts = 8;
        for (int i = 0; i < kParts; ++i) {
          speed_ += h / kParts * gain_ * (target_ - joints_ - lookahead_ * speed_);
          joints_ += h / kParts * speed_;
        }
        break;
      }
      case Mode::kMove: {
        moved_for_ += h;
        const double way = (target_ - from_).cwiseAbs().maxCoeff(), gone = way_after(way, moved_for_);
        joints_ = way > 0 ? JointVector(from_ + (target_ - from_) * (gone / way)) : target_;
        speed_ = (joints_ - before_) / diabolo::kTick;
        if (gone >= way) {
          speed_.setZero();
          mode_ = Mode::kBrake;
        }
        break;
      }
      case Mode::kTurn:
      case Mode::kBrake: {
        const JointVector wanted = mode_ == Mode::kTurn ? wanted_speed_ : JointVector::Zero();
        const JointVector change = wanted - speed_;
        speed_ += change.cwiseMin(deceleration_ * h).cwiseMax(-deceleration_ * h);
        joints_ += h * speed_;
        break;
      }
    }
  }

 private:
  enum class Mode { kBrake, kServo, kMove, kTurn };

  /// Of a move with constant acceleration, speed and deceleration [rad].
  double way_after(double way, double time) const {
    const double a = move_acceleration_, v = std::min(move_speed_, std::sqrt(way * a));
    if (way <= 0) return way;
    const double ramp = v / a, whole = way / v + ramp;
    if (time >= whole) return way;
    if (time < ramp) return 0.5 * a * time * time;
    if (time > whole - ramp) return way - 0.5 * a * (whole - time) * (whole - time);
    return v * (time - 0.5 * ramp);
  }

  JointVector joints_, before_, target_;
  JointVector speed_ = JointVector::Zero(), from_ = JointVector::Zero(), wanted_speed_ = JointVector::Zero();
  Mode mode_ = Mode::kBrake;
  double lookahead_ = 0.1, gain_ = 300, deceleration_ = 10, moved_for_ = 0;
  double move_speed_ = 1, move_acceleration_ = 1;
};

}  // namespace stand_in
