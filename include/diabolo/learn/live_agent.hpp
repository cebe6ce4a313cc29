// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
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
};

/// An agent at the sticks of a robot or of somebody else's simulator. Once a period it is shown the diabolo
/// and says where the tips go, as it would in an arena.
class LiveAgent {
 public:
  /// `hands`: where the tips are at first. Throws std::invalid_argument where they are not within the limits.
  LiveAgent(Agent agent, const Hands& hands, const LiveOptions& options)
      : agent_(std::move(agent)), options_(options), task_(task_named(agent_.task)) {
    options_.limits.validate();
    if (options_.camera) options_.camera->validate();
    options_.limits.expect_within(hands, "hands");
    if (!((hands.position[0] - hands.position[1]).norm() <= options.string_length))
      throw std::invalid_argument("hands: farther apart than the string is long, " +
                                  shown(options.string_length) + " m");
    episode_.hands = hands;
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
    const State<double> before = episode_.periods > 0 ? episode_.state : state;
    episode_.state = state;
    if (episode_.periods++ > 0) {
      episode_.pull = mean_pull(episode_, before, options_.gravity, agent_.period);
      task_.judge(moment_of(episode_, before, options_.limits.centre, options_.gravity, agent_.period),
                  episode_.memory);
      if (options_.camera)
        episode_.sight.look(*options_.camera, state, agent_.period, task_.info->axle, episode_.draw);
    } else {
      episode_.rest = state.position;
      episode_.pull = first_pull(state, options_.gravity);
      if (options_.camera) episode_.sight = Sight(*options_.camera, state, episode_.draw);
    }
    Eigen::VectorXf seen(agent_.policy.inputs());
    observe(episode_, *task_.info, options_.limits.centre, options_.camera.has_value(), seen.data());
    const Eigen::MatrixXf action = agent_.policy.act(seen);
    move_hands(episode_.hands, action.data(), options_.limits, options_.string_length, agent_.period);
    return episode_.hands;
  }

 private:
  Agent agent_;
  LiveOptions options_;
  const Task& task_;
  Episode episode_;
};

}  // namespace diabolo
