// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

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

/// The number of one of these tasks, drawn so that each is played for about as long. Of one, nothing is
/// drawn.
inline std::size_t drawn_task(const std::vector<const Task*>& tasks, Draw& draw) {
  if (tasks.size() == 1) return 0;
  double sum = 0.0;
  for (const Task* task : tasks) sum += 1.0 / task->info->seconds;
  double left = draw.uniform(0.0, sum);
  for (std::size_t number = 0; number + 1 < tasks.size(); ++number)
    if (left -= 1.0 / tasks[number]->info->seconds; left < 0.0) return number;
  return tasks.size() - 1;
}

}  // namespace diabolo
