// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "controller.hpp"

namespace stand_in {

inline constexpr const char* kDashboardGreeting = "Connected: Universal Robots Dashboard Server\n";

/// The answer to a line on the dashboard's port, both without the line's end.
inline std::string dashboard_answer(Controller& controller, std::string_view line) {
  const bool running = controller.runtime() == Controller::kPlaying;
  const auto begins = [line](std::string_view start) { return line.starts_with(start); };
  if (line == "PolyscopeVersion") return "URSoftware 5.12.4.1101661 (Sep 08 2022)";
  if (line == "get serial number") return "20205500000";
  if (line == "get robot model") return "UR5";
  if (line == "is in remote control") return controller.remote ? "true" : "false";
  if (line == "robotmode") return controller.powered() ? "Robotmode: RUNNING" : "Robotmode: POWER_OFF";
  if (line == "safetystatus" || line == "safetymode") {
    const char* state = controller.safety() == Controller::kNormal       ? "NORMAL"
                        : controller.safety() == Controller::kProtective ? "PROTECTIVE_STOP"
                                                                         : "ROBOT_EMERGENCY_STOP";
    return (line == "safetymode" ? "Safetymode: " : "Safetystatus: ") + std::string(state);
  }
  if (line == "running") return running ? "Program running: true" : "Program running: false";
  if (line == "programState") return running ? "PLAYING rtde_control" : "STOPPED rtde_control";
  if (line == "get loaded program") return "No program loaded";
  if (line == "isProgramSaved") return "True";
  if (line == "quit") return "Disconnected";
  if (line == "close safety popup") return "closing safety popup";
  if (line == "close popup") return "closing popup";
  if (begins("popup")) return "showing popup";
  if (begins("addToLog")) return "Added log message";
  if (begins("load"))
    return "File not found: " + std::string(line.substr(std::min<std::size_t>(5, line.size())));
  if (line == "stop") {
    controller.stop_program("the dashboard");
    return "Stopped";
  }
  if (line == "pause") return controller.pause() ? "Pausing program" : "Failed to execute: pause";
  if (line == "play") return controller.play() ? "Starting program" : "Failed to execute: play";
  if (line == "unlock protective stop")
    return controller.unlock()
               ? "Protective stop releasing"
               : "Cannot unlock protective stop until 5s after occurrence. Always inspect cause "
                 "of protective stop before unlocking";
  if (line == "power on" || line == "power off") {
    if (line == "power off") controller.stop_program("power off");
    controller.power(line == "power on" && controller.safety() == Controller::kNormal);
    return line == "power on" ? "Powering on" : "Powering off";
  }
  if (line == "brake release") return "Brake releasing";
  if (line == "restart safety") return "Restarting safety";
  return "could not understand: '" + std::string(line) + "'";
}

}  // namespace stand_in
