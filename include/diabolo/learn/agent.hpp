// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/learn/observe.hpp"

namespace diabolo {

/// A layer of a network: weights * input + bias.
struct Layer {
  Eigen::MatrixXf weights;  ///< outputs x inputs
  Eigen::VectorXf bias;
};

/// What an agent does where it sees something: a network of layers with tanh between them, whose outputs,
/// cut off at -1 and 1, are an action (see move_hands).
class Policy {
 public:
  static constexpr Eigen::Index kActions = 6;

  /// `seen`: how many numbers it sees (observation_size). Throws std::invalid_argument where layers do not
  /// fit each other, what is seen or what is done.
  explicit Policy(std::vector<Layer> layers, std::size_t seen = kObservationSize)
      : layers_(std::move(layers)) {
    Eigen::Index inputs = static_cast<Eigen::Index>(seen);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const auto& [weights, bias] = layers_[i];
      const std::string here = "layer " + std::to_string(i) + ": ";
      if (weights.cols() != inputs || weights.rows() != bias.size() || weights.rows() < 1)
        throw std::invalid_argument(here + std::to_string(weights.rows()) + " x " +
                                    std::to_string(weights.cols()) + " weights and " +
                                    std::to_string(bias.size()) + " biases; expected " +
                                    std::to_string(inputs) + " inputs, and a bias for each output");
      if (!weights.allFinite() || !bias.allFinite())
        throw std::invalid_argument(here + "a number that is not finite; expected finite ones");
      inputs = weights.rows();
    }
    if (layers_.empty() || inputs != kActions)
      throw std::invalid_argument("layers: " + std::to_string(layers_.empty() ? 0 : inputs) +
                                  " outputs; expected " + std::to_string(kActions));
  }

  const std::vector<Layer>& layers() const { return layers_; }
  /// How many numbers it sees.
  Eigen::Index inputs() const { return layers_.front().weights.cols(); }

  /// Actions, 6 x n, of observations, inputs() x n. Throws std::invalid_argument where a number is
  /// not finite, or so large that the layers give none that is.
  Eigen::MatrixXf act(const Eigen::Ref<const Eigen::MatrixXf>& observations) const {
    if (!observations.allFinite()) throw std::invalid_argument("observations: not finite; expected numbers");
    Eigen::MatrixXf values = observations;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      values = (layers_[i].weights * values).colwise() + layers_[i].bias;
      if (i + 1 < layers_.size()) values = values.array().tanh();
    }
    if (!values.allFinite())
      throw std::invalid_argument("layers: they give what is not finite; expected smaller weights");
    return values.cwiseMax(-1.0F).cwiseMin(1.0F);
  }

 private:
  std::vector<Layer> layers_;
};

/// A policy, and what it was trained for.
struct Agent {
  std::vector<std::string> tasks;  ///< which one is played, it sees where there are several
  double period;                   ///< between actions [s]
  int steps;                       ///< of the simulation in a period
  Policy policy;
  bool corrects = false;  ///< plans: its actions are added to theirs
};

/// The number of one of its tasks; of its only one, where no name is given. Throws std::invalid_argument
/// where it does not know it, or no name is given of several.
inline std::size_t task_number(const Agent& agent, const std::string& name) {
  if (name.empty() && agent.tasks.size() == 1) return 0;
  const auto found = std::ranges::find(agent.tasks, name);
  if (found != agent.tasks.end()) return static_cast<std::size_t>(found - agent.tasks.begin());
  std::string known;
  for (const std::string& task : agent.tasks) known += (known.empty() ? "" : ", ") + task;
  throw std::invalid_argument("task: found " + shown(name) + "; expected one that the agent knows, " + known);
}

}  // namespace diabolo
