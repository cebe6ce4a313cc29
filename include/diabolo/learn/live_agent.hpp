// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/learn/agent.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What an agent plays with where it is not in an arena.
struct LiveOptions {
  Goal goal{};
  HandLimits limits{};
  double string_length = 1.45;        ///< [m]
  double gravity = kStandardGravity;  ///< [m/s^2]
  std::optional<Camera> camera{};     ///< none: an agent sees what it is shown, not what a camera makes of it
  std::uint64_t seed = 0;             ///< of the camera's noise, dropouts and delay
  std::string task{};                 ///< one of the agent's, where it knows several
  std::shared_ptr<const HandPlan> plan{};  ///< which it corrects, from its first moment on; null: none
};

/// An agent at the sticks of a robot or of somebody else's simulator. Once a period it is shown the diabolo
/// and says where the tips go, as it would in an arena.
class LiveAgent {
 public:
  /// `hands`: where the tips are at first. Throws std::invalid_argument where they are not within the limits.
  LiveAgent(Agent agent, const Hands& hands, const LiveOptions& options)
      : agent_(std::move(agent)),
        options_(options),
        seen_too_(seen_too(agent_.tasks, agent_.corrects)),
        task_(task_named(agent_.tasks.at(task_number(agent_, options.task)))) {
    options_.limits.validate();
    if (options_.camera) options_.camera->validate();
    options_.limits.expect_within(hands, "hands");
    if (!((hands.position[0] - hands.position[1]).norm() <= options.string_length))
      throw std::invalid_argument("hands: farther apart than the string is long, " +
                                  shown(options.string_length) + " m");
    expect_plan(hands);
    episode_.hands = hands;
    episode_.plan = options.plan;
    episode_.task = task_number(agent_, options.task);
    episode_.goal = options.goal;
    episode_.draw = Draw(options.seed, 0);
  }

  const Agent& agent() const { return agent_; }
  const Hands& hands() const { return episode_.hands; }

  /// Shows the diabolo: the tips at the end of the period that begins now, and their velocities. Until then
  /// their accelerations are constant (tips_between). Throws std::invalid_argument where a number is not
  /// finite.
  const Hands& act(const State<double>& state) {
    if (!is_finite(state)) throw std::invalid_argument("state: not finite; expected numbers");
    const State<double> before = begun_ ? episode_.state : state;
    episode_.state = state;
    if (begun_) {
      ++episode_.periods;
      episode_.pull = mean_pull(episode_, before, options_.gravity, agent_.period);
      task_.judge(moment_of(episode_, before, options_.limits.centre, options_.gravity, agent_.period),
                  episode_.memory);
      if (options_.camera)
        episode_.sight.look(*options_.camera, state, agent_.period, seen_too_.axle, episode_.draw);
    } else {
      begun_ = true;
      episode_.rest = state.position;
      episode_.pull = first_pull(state, options_.gravity);
      if (options_.camera) episode_.sight = Sight(*options_.camera, state, episode_.draw);
    }
    Eigen::VectorXf seen(agent_.policy.inputs());
    observe(episode_, *task_.info, seen_too_, options_.limits.centre, options_.camera.has_value(),
            seen.data());
    const Eigen::MatrixXf action = agent_.policy.act(seen);
    move_hands(episode_, action.data(), options_.limits, options_.string_length, agent_.period);
    return episode_.hands;
  }

 private:
  /// Throws std::invalid_argument where there is no plan for an agent that corrects one, one for another, or
  /// one that does not begin with these hands or with the agent's period.
  void expect_plan(const Hands& hands) const {
    constexpr double kSame = 1e-6;  // [m]
    const HandPlan* const plan = options_.plan.get();
    if (agent_.corrects != (plan != nullptr))
      throw std::invalid_argument(plan ? "plan: given, to an agent that corrects none; expected none"
                                       : "plan: none, for an agent that corrects one; expected one");
    if (!plan) return;
    if (plan->period != agent_.period)
      throw std::invalid_argument("plan: for a period of " + shown(plan->period) +
                                  " s; expected the agent's, " + shown(agent_.period) + " s");
    for (std::size_t side = 0; side < 2; ++side)
      if (!((hands.position[side] - plan->at(0).hands.position[side]).norm() <= kSame))
        throw std::invalid_argument("hands: not where the plan begins; expected its tips, moved together");
  }

  Agent agent_;
  LiveOptions options_;
  SeenToo seen_too_;
  const Task& task_;
  Episode episode_;
  bool begun_ = false;  ///< it was shown a state
};

}  // namespace diabolo
