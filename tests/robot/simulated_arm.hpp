// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "diabolo/robot/arm/joint_limits.hpp"
#include "diabolo/robot/control/arm_link.hpp"

/// An arm with a servo that follows late, as a UR5e's does with its default gain: qdd = K (target - q - T
/// qd), K gain, T lookahead. It trips a protective stop where speed or step are too large, or a number is
/// none.
class SimulatedArm : public diabolo::ArmLink {
 public:
  using Joints = diabolo::Joints<double>;

  explicit SimulatedArm(const Joints& joints, double gain = 2000, double lookahead = 0.03)
      : gain_(gain), lookahead_(lookahead), joints_(joints), published_(joints), target_(joints) {
    reading_.safety_normal = true;
    reading_.program_running = true;
  }

  void begin_connect() override {
    reading_.link = diabolo::LinkState::kConnecting;
    connecting_ = connect_ticks;
  }

  diabolo::ArmReading read() override {
    reading_.actual = published_;
    return reading_;
  }

  bool servo(const Joints& setpoint) override {
    if (refuses || !reading_.program_running || !reading_.safety_normal) return false;
    setpoints.push_back(setpoint);
    if (!setpoint.allFinite() || (servoing_ && (setpoint - target_).cwiseAbs().maxCoeff() > 0.1)) {
      protective_stop();
      return true;
    }
    target_ = setpoint;
    servoing_ = true;
    return true;
  }

  bool begin_move(const Joints& goal) override {
    moves.push_back(goal);
    target_ = goal;
    servoing_ = false;
    reading_.moving = true;
    return true;
  }

  void stop() override {
    ++stops;
    servoing_ = false;
    reading_.moving = false;
  }

  bool begin_unlock() override {
    ++unlocks;
    reading_.protective_stop = false;
    reading_.safety_normal = !reading_.emergency_stop;
    reading_.program_running = true;
    return true;
  }

  /// A tick of the controller.
  void tick() {
    if (connecting_ > 0 && --connecting_ == 0) reading_.link = diabolo::LinkState::kConnected;
    published_ = joints_;
    const Joints before = joints_;
    if (reading_.moving) {
      const Joints gap = target_ - joints_;
      const double largest = gap.cwiseAbs().maxCoeff(), step = 0.5 * diabolo::kTick;
      joints_ += gap * (largest > step ? step / largest : 1.0);
      reading_.moving = largest > step;
      speed_.setZero();
    } else if (servoing_) {
      constexpr int kParts = 8;
      for (int i = 0; i < kParts; ++i) {
        const double h = diabolo::kTick / kParts;
        speed_ += h * gain_ * (target_ - joints_ - lookahead_ * speed_);
        joints_ += h * speed_;
      }
      if (speed_.cwiseAbs().maxCoeff() > 3.35) protective_stop();
    } else {  // the controller brakes at 10 rad/s^2
      for (int i = 0; i < 6; ++i)
        speed_[i] -= std::clamp(speed_[i], -10 * diabolo::kTick, 10 * diabolo::kTick);
      joints_ += diabolo::kTick * speed_;
    }
    fastest = std::max(fastest, (joints_ - before).cwiseAbs().maxCoeff() / diabolo::kTick);
    if (silent_for > 0)
      --silent_for;
    else
      reading_.controller_time += diabolo::kTick;
  }

  void protective_stop() {
    reading_.protective_stop = true;
    reading_.safety_normal = reading_.program_running = false;
    servoing_ = false;
    ++trips;
  }
  void emergency_stop(bool pressed) {
    reading_.emergency_stop = pressed;
    reading_.safety_normal = !pressed;
    reading_.program_running = false;
    servoing_ = false;
  }
  void end_program() { reading_.program_running = false; }
  void reduce_safety() { reading_.safety_normal = false; }
  void lose_link() { reading_.link = diabolo::LinkState::kLost; }
  void scale_speed(double scaling) { reading_.speed_scaling = scaling; }
  void push(const Joints& by) { joints_ += by; }

  const Joints& joints() const { return joints_; }
  double speed() const { return speed_.cwiseAbs().maxCoeff(); }

  int connect_ticks = 50, silent_for = 0, stops = 0, unlocks = 0, trips = 0;
  bool refuses = false;
  double fastest = 0;             ///< [rad/s]
  std::vector<Joints> setpoints;  ///< all that came
  std::vector<Joints> moves;

 private:
  double gain_, lookahead_;
  Joints joints_, published_, target_;
  Joints speed_ = Joints::Zero();
  diabolo::ArmReading reading_;
  bool servoing_ = false;
  int connecting_ = 0;
};
