// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/robot/arm/joints.hpp"

namespace diabolo {

/// Whether there is a way to an arm's controller.
enum class LinkState {
  kDisconnected,
  kConnecting,
  kConnected,
  kLost,  ///< it was there; a new connection must be made
};

/// What an arm's controller said last.
struct ArmReading {
  LinkState link = LinkState::kDisconnected;
  double controller_time = 0;                      ///< [s] of the controller's own clock, when it was said
  Joints<double> actual = Joints<double>::Zero();  ///< [rad]
  double speed_scaling = 1;                        ///< of the controller: below 1 it plays more slowly
  bool safety_normal = false;                      ///< no stop of any kind
  bool protective_stop = false, emergency_stop = false;
  bool program_running = false;  ///< the arm takes setpoints
  bool moving = false;           ///< a move of its own is under way
};

/// One arm as the control loop sees it. No call may block: what takes time is begun, and seen in a reading.
class ArmLink {
 public:
  virtual ~ArmLink() = default;

  virtual void begin_connect() = 0;
  virtual ArmReading read() = 0;

  /// The setpoint of this tick [rad]; false where the controller refuses it.
  virtual bool servo(const Joints<double>& setpoint) = 0;
  /// A slow move in joint space.
  virtual bool begin_move(const Joints<double>& goal) = 0;
  /// The controller itself brings the arm to rest and takes no more setpoints until the next servo().
  virtual void stop() = 0;
  /// Releases a protective stop and starts the program again; only ever called because a person asked.
  virtual bool begin_unlock() = 0;

 protected:
  ArmLink() = default;
  ArmLink(const ArmLink&) = default;
  ArmLink& operator=(const ArmLink&) = default;
};

}  // namespace diabolo
