// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "control_script.hpp"

namespace stand_in {

/// What a tick of the controller looked like.
struct Tick {
  double time = 0;  ///< [s] of the machine's steady clock
  JointVector joints, speed, target;
  int commands = 0;  ///< servo commands that came since the tick before
  std::uint32_t runtime = 0, safety = 0;
};

/// A controller without its sockets: the arm, the program on it and the safety state.
class Controller {
 public:
  static constexpr std::uint32_t kStopped = 1, kPlaying = 2, kPaused = 4;      // runtime_state
  static constexpr std::uint32_t kNormal = 1, kProtective = 1 << 2 | 1 << 10,  // safety_status_bits
      kEmergency = 1 << 6 | 1 << 7 | 1 << 10;

  explicit Controller(const JointVector& joints) : arm_(joints), script_(inputs_, outputs_, arm_) {}
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  Variables& outputs() { return outputs_; }
  Variables& inputs() { return inputs_; }
  const ServoArm& arm() const { return arm_; }
  std::uint32_t runtime() const { return runtime_; }
  std::uint32_t safety() const { return safety_; }
  bool powered() const { return powered_; }
  const std::string& reason() const { return reason_; }  ///< of the last stop
  std::string command_register() const { return script_.command_register(); }
  int uploads() const { return uploads_; }

  bool remote = true;    ///< the switch on the pendant
  bool frozen = false;   ///< the state is told, and stands still
  double scaling = 1.0;  ///< how fast the controller lets time pass

  /// A program, whole. Without power, in a stop or in local control nothing starts.
  void upload(std::string_view program) {
    ++uploads_;
    if (!program.starts_with("def rtde_control()") || !powered_ || safety_ != kNormal || !remote) return;
    // The client puts the number of its first register on the line below this one.
    const std::size_t line = program.find('\n', program.find("global reg_offset_int ="));
    int offset = -1;
    if (line != program.npos)
      std::from_chars(program.data() + line + 1, program.data() + program.size(), offset);
    if (offset != 0 && offset != 24) return;
    script_.start(offset);
    runtime_ = kPlaying;
    since_command_ = 0;
  }
  /// A client has written the command register.
  void command_written() {
    since_command_ = 0;
    commands_ += inputs_.get<std::int32_t>(command_register()) == kServoJ;
  }

  /// What the client's last servo command asks for [rad].
  JointVector servo_target() { return script_.servo_target(); }

  void stop_program(std::string_view reason) {
    reason_ = reason;
    script_.stop();
    runtime_ = kStopped;
    arm_.brake(kBrake);
  }
  bool pause() {
    if (runtime_ != kPlaying) return false;
    runtime_ = kPaused;
    arm_.brake(kBrake);
    return true;
  }
  bool play() {
    if (runtime_ != kPaused) return false;
    runtime_ = kPlaying;
    return true;
  }
  void protective_stop(std::string_view reason) {
    if (safety_ != kNormal) return;
    stop_program(reason);
    safety_ = kProtective;
    since_stop_ = 0;
    arm_.brake(kHardBrake);
  }
  /// False within the first five seconds, as on the real one.
  bool unlock() {
    if (safety_ != kProtective || since_stop_ < 5) return false;
    safety_ = kNormal;
    return true;
  }
  void emergency_stop(bool pressed) {
    if (pressed) {
      stop_program("emergency stop");
      arm_.brake(kHardBrake);
    }
    safety_ = pressed ? kEmergency : kNormal;
    powered_ = powered_ && !pressed;
  }
  void power(bool on) { powered_ = on; }

  void tick() {
    if (!frozen) time_ += diabolo::kTick;
    since_stop_ += diabolo::kTick;
    since_command_ += diabolo::kTick;
    if (runtime_ == kPlaying) {
      if (const std::string trouble = script_.turn(); !trouble.empty()) protective_stop(trouble);
      if (!script_.running() && runtime_ == kPlaying) stop_program("its client stopped it");
      if (script_.watchdog() > 0 && since_command_ > 1 / script_.watchdog() && runtime_ == kPlaying)
        stop_program("the watchdog");
    }
    arm_.tick(scaling);
    if (arm_.speed().cwiseAbs().maxCoeff() > kFastest) protective_stop("a joint is too fast");
    if (!diabolo::kUr5eRanges.contain(arm_.joints())) protective_stop("a joint is beyond its limit");
    if (!frozen) publish();
  }

  /// The state since the last call.
  Tick look(double now) {
    Tick tick{now, arm_.joints(), arm_.speed(), arm_.target(), commands_, runtime_, safety_};
    commands_ = 0;
    return tick;
  }

 private:
  static constexpr double kFastest = 3.35;  // [rad/s]
  static constexpr double kBrake = 10;      // [rad/s^2]
  static constexpr double kHardBrake = 30;  // [rad/s^2]

  void set_six(const char* name, const JointVector& joints) {
    Eigen::Map<JointVector>(outputs_.get<std::array<double, 6>>(name).data()) = joints;
  }
  void publish() {
    outputs_.get<double>("timestamp") = time_;
    set_six("target_q", arm_.joints());
    set_six("target_qd", arm_.speed());
    set_six("actual_q", arm_.published());
    set_six("actual_qd", arm_.speed());
    outputs_.get<std::array<double, 6>>("actual_TCP_pose") = forward(arm_.published(), {});
    outputs_.get<double>("speed_scaling") = scaling;
    outputs_.get<double>("target_speed_fraction") = 1;
    outputs_.get<std::int32_t>("robot_mode") = powered_ ? 7 : 3;
    outputs_.get<std::int32_t>("safety_mode") = safety_ == kNormal ? 1 : safety_ == kProtective ? 3 : 7;
    outputs_.get<std::uint32_t>("runtime_state") = runtime_;
    outputs_.get<std::uint32_t>("robot_status_bits") =
        (powered_ ? 1u : 0u) | (runtime_ == kPlaying ? 2u : 0u);
    outputs_.get<std::uint32_t>("safety_status_bits") = safety_;
  }

  Variables inputs_ = input_variables(), outputs_ = output_variables();
  ServoArm arm_;
  ControlScript script_;
  std::uint32_t runtime_ = kStopped, safety_ = kNormal;
  bool powered_ = true;
  double time_ = 0, since_stop_ = 0, since_command_ = 0;
  int commands_ = 0, uploads_ = 0;
  std::string reason_;
};

}  // namespace stand_in
