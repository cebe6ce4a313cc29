// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/robot/control/arm_link.hpp"
#include "diabolo/robot/control/control_fault.hpp"

namespace diabolo {

/// Follows what one arm's controller says and when it said something new.
class ArmMonitor {
 public:
  ArmMonitor(Side side, double stale_after) : side_(side), stale_after_(stale_after) {}

  /// The loop's reading at its time `now` [s].
  void update(const ArmReading& reading, double now) {
    if (!heard_ || reading.controller_time != reading_.controller_time) heard_at_ = now;
    heard_ = true;
    reading_ = reading;
  }

  const ArmReading& reading() const { return reading_; }
  bool connected() const { return heard_ && reading_.link == LinkState::kConnected; }

  /// What speaks against moving this arm now.
  ControlFault fault(double now) const {
    const auto is = [&](ControlFaultKind kind) { return ControlFault{kind, side_, now}; };
    if (!connected()) return is(ControlFaultKind::kLost);
    if (now - heard_at_ > stale_after_) return is(ControlFaultKind::kStale);
    if (reading_.emergency_stop) return is(ControlFaultKind::kEmergencyStop);
    if (reading_.protective_stop) return is(ControlFaultKind::kProtectiveStop);
    if (!reading_.safety_normal) return is(ControlFaultKind::kSafety);
    if (!reading_.program_running) return is(ControlFaultKind::kProgram);
    if (!all_finite(reading_.actual)) return is(ControlFaultKind::kNotFinite);
    return {};
  }

 private:
  Side side_;
  double stale_after_;
  ArmReading reading_;
  double heard_at_ = 0;
  bool heard_ = false;
};

}  // namespace diabolo
