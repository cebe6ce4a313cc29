// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "diabolo/robot/arm/joint_limits.hpp"
#include "diabolo/robot/control/arm_link.hpp"

/// What goes between RtdeArm and the process that speaks to the arm's controller: whole messages on a local
/// socket, of one program's two halves on one machine.
namespace ur5e {

/// The first message to the process.
struct ArmSettings {
  std::array<char, 256> host{};
  double lookahead = 0.03, gain = 2000;  ///< of servoj: [s], and a number within [100, 2000]
  double move_speed = 0.5;               ///< of moves [rad/s]
  double move_acceleration = 0.5;        ///< [rad/s^2]
  double watchdog = 25;     ///< [Hz]: the controller stops its program when nothing comes for longer
  double slow_call = 0.01;  ///< [s]: a servo call that takes longer has lost its connection meanwhile
  double payload = 0;       ///< [kg] with its centre [m] in the flange; zero leaves the controller's own
  std::array<double, 3> payload_centre{};
  bool upper_registers = false;  ///< 24 to 47, where a fieldbus has the lower ones
  bool talkative = false;        ///< lets the client library print
};

enum class ArmCommand : std::uint8_t { kServo, kMove, kStop, kUnlock };

struct ArmRequest {
  ArmCommand command;
  std::array<double, diabolo::kJointCount> joints{};
};

struct ArmReport {
  diabolo::LinkState link = diabolo::LinkState::kConnecting;
  double controller_time = 0, speed_scaling = 1;
  std::array<double, diabolo::kJointCount> actual{};
  bool safety_normal = false, protective_stop = false, emergency_stop = false;
  bool program_running = false, moving = false;
  bool refused = false;             ///< the last setpoint
  std::array<char, 200> trouble{};  ///< what went wrong last, a sentence
};

}  // namespace ur5e
