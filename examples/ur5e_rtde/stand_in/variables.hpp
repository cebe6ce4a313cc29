// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "wire.hpp"

namespace stand_in {

/// Variables by the names that RTDE gives them. A pointer to one stays good, as its type does.
class Variables {
 public:
  Value* find(std::string_view name) {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : &found->second;
  }
  template <class T>
  T& get(std::string_view name) {
    return std::get<T>(values_.find(name)->second);
  }
  void add(std::string_view name, Value value) { values_.emplace(name, value); }

 private:
  std::map<std::string, Value, std::less<>> values_;
};

inline constexpr int kRegisters = 48;  ///< of each kind; the upper half is meant for clients of RTDE

/// What a controller of PolyScope 5.12 tells, all zero.
inline Variables output_variables() {
  Variables all;
  for (const char* name :
       {"timestamp", "actual_execution_time", "speed_scaling", "target_speed_fraction", "actual_momentum",
        "actual_main_voltage", "actual_robot_voltage", "actual_robot_current", "standard_analog_input0",
        "standard_analog_input1", "standard_analog_output0", "standard_analog_output1", "payload"})
    all.add(name, 0.0);
  for (const char* name :
       {"target_q", "target_qd", "target_qdd", "target_current", "target_moment", "actual_q", "actual_qd",
        "actual_current", "joint_control_output", "actual_TCP_pose", "actual_TCP_speed", "actual_TCP_force",
        "target_TCP_pose", "target_TCP_speed", "joint_temperatures", "actual_joint_voltage", "ft_raw_wrench",
        "payload_inertia"})
    all.add(name, std::array<double, 6>{});
  for (const char* name : {"actual_tool_accelerometer", "payload_cog"})
    all.add(name, std::array<double, 3>{});
  for (const char* name : {"actual_digital_input_bits", "actual_digital_output_bits"})
    all.add(name, std::uint64_t{0});
  for (const char* name : {"runtime_state", "robot_status_bits", "safety_status_bits",
                           "output_bit_registers0_to_31", "output_bit_registers32_to_63"})
    all.add(name, std::uint32_t{0});
  for (const char* name : {"robot_mode", "safety_mode"}) all.add(name, std::int32_t{0});
  all.add("joint_mode", std::array<std::int32_t, 6>{});
  for (int i = 0; i < kRegisters; ++i) {
    all.add("output_int_register_" + std::to_string(i), std::int32_t{0});
    all.add("output_double_register_" + std::to_string(i), 0.0);
  }
  return all;
}

/// What clients may write, all zero; it stays when they have gone.
inline Variables input_variables() {
  Variables all;
  for (int i = 0; i < kRegisters; ++i) {
    all.add("input_int_register_" + std::to_string(i), std::int32_t{0});
    all.add("input_double_register_" + std::to_string(i), 0.0);
  }
  all.add("external_force_torque", std::array<double, 6>{});
  all.add("speed_slider_mask", std::uint32_t{0});
  for (const char* name : {"speed_slider_fraction", "standard_analog_output_0", "standard_analog_output_1"})
    all.add(name, 0.0);
  for (const char* name :
       {"standard_digital_output_mask", "standard_digital_output", "tool_digital_output_mask",
        "tool_digital_output", "configurable_digital_output_mask", "configurable_digital_output",
        "standard_analog_output_mask", "standard_analog_output_type"})
    all.add(name, std::uint8_t{0});
  return all;
}

}  // namespace stand_in
