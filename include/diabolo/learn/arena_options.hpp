// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/learn/observe.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What happens once an episode is over (the words of Gymnasium).
enum class Autoreset {
  kNextStep,  ///< the next step resets it, whatever its action
  kSameStep,  ///< the step that ends it resets it; what it ended with is kept aside
  kDisabled,  ///< its owner resets it; until then its steps do nothing
};

inline constexpr std::array<std::string_view, 3> names_of(Autoreset) {
  return {"next_step", "same_step", "disabled"};
}

/// Throws std::invalid_argument where there are none, one is unknown, or one is there twice.
inline void expect_tasks(const std::vector<std::string>& tasks) {
  if (tasks.empty()) throw std::invalid_argument("task: none; expected at least one");
  for (const std::string& task : tasks)
    if (task_named(task); std::count(tasks.begin(), tasks.end(), task) > 1)
      throw std::invalid_argument("task: " + task + " twice; expected each once");
}

/// What is played in an arena.
struct ArenaOptions {
  std::vector<std::string> tasks{"Hold"};  ///< each episode draws one, each of them for about as long
  std::size_t count = 1;                   ///< of environments
  double period = 0.01;                    ///< between actions [s]
  int steps = 10;                          ///< of the simulation in a period
  Autoreset autoreset = Autoreset::kNextStep;
  int threads = 1;  ///< 0: one for every processor
  HandLimits limits{};
  std::optional<Camera> camera{};      ///< none: an agent sees the exact state
  std::vector<EpisodeStart> starts{};  ///< that episodes of their tasks may begin with
  double start_share = 0.0;            ///< of the episodes that do; all, where starts have plans
  bool free_axis = false;              ///< each episode draws a free axle (draw_free_axle) in every task

  /// Whether agents correct plans, which all starts have then.
  bool corrects() const { return !starts.empty() && starts.front().plan; }

  /// Throws std::invalid_argument naming what is out of its range.
  void validate() const {
    expect_tasks(tasks);
    if (count < 1) throw std::invalid_argument("count: 0; expected at least one environment");
    if (!(period >= 1e-3 && period <= 0.1))
      throw std::invalid_argument("period: " + shown(period) + " s; expected 0.001 to 0.1 s");
    if (steps < 1 || steps > 1000)
      throw std::invalid_argument("steps: " + std::to_string(steps) + "; expected 1 to 1000");
    if (!(start_share >= 0.0 && start_share <= (starts.empty() ? 0.0 : 1.0)))
      throw std::invalid_argument("start_share: " + shown(start_share) + "; expected 0 to " +
                                  (starts.empty() ? "0, since there are no starts" : "1"));
    limits.validate();
    if (camera) camera->validate();
    for (std::size_t i = 0; i < starts.size(); ++i) expect_start(starts[i], "starts, " + std::to_string(i));
    if (!corrects()) return;
    if (start_share != 1.0)
      throw std::invalid_argument("start_share: " + shown(start_share) +
                                  "; expected 1, as starts have plans");
    for (const std::string& task : tasks)
      if (!std::ranges::any_of(starts, [&](const EpisodeStart& start) { return start.is_of(task); }))
        throw std::invalid_argument("starts: none of " + task + "; expected plans for each task");
  }

 private:
  void expect_start(const EpisodeStart& start, const std::string& here) const {
    limits.expect_within(start.hands, here);
    if (!std::ranges::any_of(tasks, [&](const std::string& task) { return start.is_of(task); }))
      throw std::invalid_argument(here + ": of the task " + start.task + "; expected one that is played");
    if ((start.plan != nullptr) != corrects())
      throw std::invalid_argument(here + ": expected a plan in all starts, or in none");
    if (start.plan && start.plan->period != period)
      throw std::invalid_argument(here + ": a plan for a period of " + shown(start.plan->period) +
                                  " s; expected " + shown(period) + " s");
  }
};

/// What an episode begins with in place of what it would draw.
struct Given {
  std::optional<State<double>> state{};
  std::optional<Goal> goal{};
  std::optional<std::size_t> model{}, task{};  ///< their numbers
};

}  // namespace diabolo
