// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "tool_pose.hpp"
#include "variables.hpp"

namespace stand_in {

/// Commands that ur_rtde writes into the first integer register, by its published numbers; what is not named
/// here is answered and has no effect on the arm.
enum Command : std::int32_t {
  kNone = 0,
  kMoveJ = 1,
  kMoveJPose = 2,
  kMoveL = 3,
  kMoveLJoints = 4,
  kForce = 6,
  kSpeedJ = 9,
  kSpeedL = 10,
  kServoJ = 11,
  kSpeedStop = 15,
  kServoStop = 16,
  kServoL = 24,
  kToolContact = 25,
  kStepTime = 26,
  kJointHistory = 27,
  kSetTcp = 29,
  kInverse = 30,
  kProtectiveStop = 31,
  kStopL = 33,
  kStopJ = 34,
  kSetWatchdog = 35,
  kPoseWithinLimits = 36,
  kJointsWithinLimits = 37,
  kTorques = 38,
  kPoseTrans = 39,
  kTcpOffset = 40,
  kForwardNow = 43,
  kForward = 44,
  kInverseNow = 46,
  kIsSteady = 47,
  kFlangePose = 58,
  kHasInverseNow = 60,
  kHasInverse = 61,
  kStopScript = 255,
};

/// What ur_rtde's script on the controller does, written anew from its behaviour: each tick it looks at the
/// command register, and says through the first output register 1: ready, or 2: done.
class ControlScript {
 public:
  ControlScript(Variables& inputs, Variables& outputs, ServoArm& arm)
      : inputs_(inputs), outputs_(outputs), arm_(arm) {}

  bool running() const { return running_; }
  std::string command_register() const { return register_name("input_int_register_", 0); }
  /// Least frequency of writes to the command register [Hz]; zero: not watched.
  double watchdog() const { return watchdog_; }

  JointVector servo_target() { return input_joints(0); }

  /// `offset` is that of its registers, 0 or 24.
  void start(int offset) {
    *this = ControlScript(inputs_, outputs_, arm_, offset);
    async_status(-1);
    output_int(0) = 1;
  }
  void stop() { running_ = false; }

  /// One turn; returns why the controller must stop for safety, an empty text where it must not.
  std::string turn() {
    if (async_ && !arm_.moving()) {
      async_ = false;
      async_status(-1);
    }
    if (waiting_) {
      if (!arm_.resting()) return {};
      waiting_ = false;
      output_int(0) = 2;
    }
    const std::int32_t command = input_int(0);
    std::string trouble;
    if (in_real_time(command)) {
      trouble = execute(command);
      output_int(0) = 1;
    } else if (command == kNone) {
      executing_ = false;
      output_int(0) = 1;
    } else if (!executing_) {
      executing_ = true;
      trouble = execute(command);
      if (command == kStopScript)
        running_ = false;
      else if (!waiting_)
        output_int(0) = 2;
    }
    return trouble;
  }

 private:
  ControlScript(Variables& inputs, Variables& outputs, ServoArm& arm, int offset)
      : inputs_(inputs), outputs_(outputs), arm_(arm), offset_(offset), running_(true) {}
  ControlScript& operator=(const ControlScript& other) {
    tool_ = other.tool_;
    offset_ = other.offset_;
    operations_ = other.operations_;
    watchdog_ = other.watchdog_;
    running_ = other.running_;
    executing_ = waiting_ = async_ = false;
    return *this;
  }

  static bool in_real_time(std::int32_t command) {
    return command == kForce || command == kSpeedJ || command == kSpeedL || command == kServoJ ||
           (command >= kServoL && command <= kJointHistory) || command == kTorques ||
           command == kFlangePose || (command >= 66 && command <= 71);
  }

  std::string register_name(const char* kind, int i) const { return kind + std::to_string(i + offset_); }
  std::int32_t input_int(int i) { return inputs_.get<std::int32_t>(register_name("input_int_register_", i)); }
  double input(int i) { return inputs_.get<double>(register_name("input_double_register_", i)); }
  std::int32_t& output_int(int i) {
    return outputs_.get<std::int32_t>(register_name("output_int_register_", i));
  }
  ToolPose input_six(int from) {
    ToolPose six;
    for (int i = 0; i < 6; ++i) six[static_cast<std::size_t>(i)] = input(from + i);
    return six;
  }
  JointVector input_joints(int from) { return Eigen::Map<const JointVector>(input_six(from).data()); }
  void put_six(const ToolPose& six) {
    for (int i = 0; i < 6; ++i)
      outputs_.get<double>(register_name("output_double_register_", i)) = six[static_cast<std::size_t>(i)];
  }
  void put_six(const JointVector& joints) {
    ToolPose six;
    Eigen::Map<JointVector>(six.data()) = joints;
    put_six(six);
  }

  /// Bits 24 to 30 number the operation, 16 to 22 count writes, 15 says that it runs, the rest its progress.
  void async_status(int progress) {
    writes_ = (writes_ + 1) % 128;
    if (progress == 0) operations_ = (operations_ + 1) % 128;
    output_int(2) = writes_ * 65536 + operations_ * 16777216 + (progress >= 0 ? progress + 32768 : 0);
  }

  /// Goes on when the arm rests, or at once where the client asked for that.
  void begin(bool at_once) {
    waiting_ = !at_once;
    if (!at_once) return;
    async_ = true;
    async_status(0);
  }

  std::string servo(const JointVector& target) {
    if (!target.allFinite()) return "a servo target is not a number";
    if (const double jump = arm_.jump_to(target); jump > kLargestJump)
      return "C204A1: Path sanity check: sudden change in target position by " + std::to_string(jump) +
             " rad";
    arm_.servo(target, input(9), input(10));
    return {};
  }

  std::string execute(std::int32_t command) {
    switch (command) {
      case kMoveJ:
      case kMoveLJoints:
        arm_.move(input_joints(0), input(6), input(7));
        begin(input_int(1) == 1);
        break;
      case kMoveJPose:
      case kMoveL:
        if (const auto goal = backward(input_six(0), tool_, arm_.joints()))
          arm_.move(*goal, input(6), input(7));
        begin(input_int(1) == 1);
        break;
      case kSpeedJ:
        arm_.turn(input_joints(0), input(6));
        break;
      case kServoJ:
        return servo(input_joints(0));
      case kServoL:
        if (const auto target = backward(input_six(0), tool_, arm_.joints())) return servo(*target);
        return "C154A1: no joints for a servo target";
      case kSpeedStop:
      case kServoStop:
        arm_.brake(input(0));
        begin(false);
        break;
      case kStopL:
      case kStopJ:
        arm_.brake(input(0));
        begin(input_int(1) == 1);
        break;
      case kProtectiveStop:
        return "a protective stop that the client asked for";
      default:
        answer(command);
    }
    return {};
  }

  /// What moves nothing; payload, force, teaching and the like are answered with nothing in it.
  void answer(std::int32_t command) {
    switch (command) {
      case kStepTime:
        put_six(ToolPose{diabolo::kTick});
        break;
      case kJointHistory:
        put_six(arm_.published());
        break;
      case kSetTcp:
        tool_ = input_six(0);
        break;
      case kTcpOffset:
        put_six(tool_);
        break;
      case kInverse:
        put_six(backward(input_six(0), tool_, input_joints(6)).value_or(JointVector::Zero()));
        break;
      case kInverseNow:
        put_six(backward(input_six(0), tool_, arm_.joints()).value_or(JointVector::Zero()));
        break;
      case kHasInverse:
        output_int(1) = backward(input_six(0), tool_, input_joints(6)).has_value();
        break;
      case kHasInverseNow:
      case kPoseWithinLimits:
        output_int(1) = backward(input_six(0), tool_, arm_.joints()).has_value();
        break;
      case kJointsWithinLimits:
        output_int(1) = diabolo::kUr5eRanges.contain(input_joints(0));
        break;
      case kForwardNow:
        put_six(forward(arm_.joints(), tool_));
        break;
      case kForward:
        put_six(forward(input_joints(0), input_six(6)));
        break;
      case kFlangePose:
        put_six(forward(arm_.published(), {}));
        break;
      case kPoseTrans:
        put_six(tool_pose(pose_of(input_six(0)) * pose_of(input_six(6))));
        break;
      case kTorques:
        put_six(JointVector(JointVector::Zero()));
        break;
      case kIsSteady:
        output_int(1) = arm_.resting();
        break;
      case kSetWatchdog:
        watchdog_ = input(0);
        break;
      default:
        break;
    }
  }

  static constexpr double kLargestJump = 0.1;  // [rad] of a servo target in a tick

  Variables &inputs_, &outputs_;
  ServoArm& arm_;
  ToolPose tool_{};
  int offset_ = 0, writes_ = 0, operations_ = 0;
  double watchdog_ = 0;
  bool running_ = false, executing_ = false;
  bool waiting_ = false;  ///< until the arm rests
  bool async_ = false;    ///< a move of which the client does not wait for the end
};

}  // namespace stand_in
