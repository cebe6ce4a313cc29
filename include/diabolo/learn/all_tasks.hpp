// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "diabolo/learn/flight_tasks.hpp"
#include "diabolo/learn/level_task.hpp"
#include "diabolo/learn/staged_tasks.hpp"
#include "diabolo/learn/string_tasks.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A task chosen at run time.
struct Task {
  const TaskInfo* info;
  Worth (*judge)(const Moment&, Memory&);
  void (*prepare)(Beginning&);  ///< changes what an episode begins with; null: nothing
};

namespace learn_detail {

template <class T>
constexpr Task task_of() {
  if constexpr (requires { &T::prepare; })
    return {&T::kInfo, &T::judge, &T::prepare};
  else
    return {&T::kInfo, &T::judge, nullptr};
}

template <class... Tasks>
constexpr std::array<Task, sizeof...(Tasks)> listed() {
  return {task_of<Tasks>()...};
}

}  // namespace learn_detail

/// All tasks, the easy ones first, and then those of a free axle. A new one is a struct with kInfo and
/// judge(), and prepare() where it begins in a way of its own, and its name here.
inline constexpr std::array kTasks =
    learn_detail::listed<HoldTask, SwingTask, SpinUpTask, SpinUpCircleTask, HopTask, ThrowTask,
                         ThrowAndCatchTask, PassTask, RoutineTask, LevelTask>();

/// The task of that name. Throws std::invalid_argument where there is none.
inline const Task& task_named(std::string_view name) {
  std::string known;
  for (const Task& task : kTasks) {
    if (task.info->name == name) return task;
    known += (known.empty() ? "" : ", ") + std::string(task.info->name);
  }
  throw std::invalid_argument("task: found " + shown(name) + "; expected one of " + known);
}

}  // namespace diabolo
