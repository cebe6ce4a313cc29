// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/learn/taught_starts.hpp"

namespace diabolo {

/// Starts for episodes in which an agent corrects such plays, each at its play's begin: the goal is what the
/// play aims at, whether it comes to it or not. `period` [s] of the agent. Skips plays that the hands' limits
/// do not let through. Throws as plan_lesson() does.
template <template <class> class... Effects>
std::vector<EpisodeStart> planned_starts(std::string_view task,
                                         const std::vector<Predictor<double, Effects...>>& models,
                                         const LessonOptions& options, double period) {
  constexpr double kFollowed = 5e-3;  // [m]
  const Lesson& lesson = lesson_for(task);
  std::vector<EpisodeStart> starts;
  plan_lesson(task, models, options, [&](const PlannedPlay& planned, const Goal& goal, double farthest) {
    const HandLimits& limits = options.limits;
    const Vector3<double> shift = shift_to(limits.centre, planned);
    const auto plan = std::make_shared<HandPlan>(
        planned_hands(planned, shift, limits, farthest + limits.string_margin, period));
    if (farthest_off(*plan, planned, shift) > kFollowed) return;
    EpisodeStart start{.state = planned.start,
                       .hands = plan->moments.front().hands,
                       .goal = goal,
                       .stage = lesson.stage,
                       .flights = lesson.flights,
                       .task = std::string(task),
                       .plan = plan};
    start.state.position += shift;
    if (limits.allow(start.hands)) starts.push_back(start);
  });
  learn_detail::expect_some(starts);
  return starts;
}

}  // namespace diabolo
