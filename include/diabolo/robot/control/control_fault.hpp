// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "diabolo/robot/arm/stick_arm.hpp"

namespace diabolo {

/// Where the control of two arms stands.
enum class ControlState {
  kDisconnected,
  kConnecting,
  kIdle,        ///< connected; the arms may be anywhere
  kHoming,      ///< one arm after the other moves slowly to where a plan begins
  kReady,       ///< at the beginning of a plan
  kRunning,     ///< plays a plan
  kStopping,    ///< both arms are coming to rest
  kFaulted,     ///< at rest, and stays so until a person has it recover
  kRecovering,  ///< protective stops are being released
};

inline const char* name_of(ControlState state) {
  constexpr const char* kNames[] = {"disconnected", "connecting", "idle",    "homing",    "ready",
                                    "running",      "stopping",   "faulted", "recovering"};
  return kNames[static_cast<int>(state)];
}

/// What made the arms stop.
enum class ControlFaultKind {
  kNone,
  kConnect,  ///< no connection in time
  kLost,     ///< the connection broke
  kStale,    ///< the controller has fallen silent
  kProtectiveStop,
  kEmergencyStop,
  kSafety,   ///< another safety state than normal
  kProgram,  ///< the program on the controller does not run
  kRefused,  ///< a setpoint was refused
  kLate,     ///< the control loop itself missed its ticks
  kHome,     ///< an arm did not arrive in time
  kNotFinite,
  kRange,      ///< a joint would leave its range
  kStep,       ///< a setpoint would break speed, acceleration or jerk
  kTracking,   ///< an arm is not where it was sent
  kBox,        ///< a tip would leave its box
  kClearance,  ///< the arms would come too close to each other
  kString,     ///< the tips would be farther apart than the string is long
  kRecovery,   ///< the safety state did not become normal
};

/// The first thing that went wrong; later ones follow from the stop itself.
struct ControlFault {
  ControlFaultKind kind = ControlFaultKind::kNone;
  Side side = Side::kLeft;  ///< of the arm, where it is one's
  double time = 0;          ///< [s] of the loop's clock
};

/// A sentence for the person at the arms.
inline std::string text_of(const ControlFault& fault) {
  const std::string arm = std::string(name_of(fault.side)) + " arm: ";
  switch (fault.kind) {
    case ControlFaultKind::kNone:
      return "no fault";
    case ControlFaultKind::kConnect:
      return arm + "no connection in time; is it powered, and in remote control?";
    case ControlFaultKind::kLost:
      return arm + "the connection broke";
    case ControlFaultKind::kStale:
      return arm + "the controller has fallen silent";
    case ControlFaultKind::kProtectiveStop:
      return arm + "protective stop";
    case ControlFaultKind::kEmergencyStop:
      return arm + "emergency stop";
    case ControlFaultKind::kSafety:
      return arm + "its safety state is not normal";
    case ControlFaultKind::kProgram:
      return arm + "the program on the controller does not run";
    case ControlFaultKind::kRefused:
      return arm + "the controller refused a setpoint";
    case ControlFaultKind::kLate:
      return "the control loop missed its ticks";
    case ControlFaultKind::kHome:
      return arm + "it did not arrive at the start in time";
    case ControlFaultKind::kNotFinite:
      return arm + "a setpoint is not finite";
    case ControlFaultKind::kRange:
      return arm + "a joint would leave its range";
    case ControlFaultKind::kStep:
      return arm + "a setpoint would break the limits of speed, acceleration or jerk";
    case ControlFaultKind::kTracking:
      return arm + "it is not where it was sent";
    case ControlFaultKind::kBox:
      return arm + "the stick would leave its box";
    case ControlFaultKind::kClearance:
      return "the arms would come too close to each other";
    case ControlFaultKind::kString:
      return "the tips would be farther apart than the string is long";
    case ControlFaultKind::kRecovery:
      return arm + "its safety state did not become normal";
  }
  return "";
}

}  // namespace diabolo
