// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/batch/lanes.hpp"
#include "diabolo/learn/arena_options.hpp"
#include "diabolo/learn/free_axle.hpp"
#include "diabolo/math/worker_pool.hpp"
#include "diabolo/model.hpp"
#include "diabolo/plan/hang_at_rest.hpp"

namespace diabolo {

/// Environments in which agents play, side by side: actions in, observations and rewards out. Each plays the
/// same bits alone and among others, with any number of threads. A step takes no memory.
class Arena {
 public:
  // One entry (observations: observation_size(seen_too())) for each environment, written by reset() and
  // step().
  std::vector<float> observations, final_observations;
  std::vector<double> rewards;
  std::vector<std::uint8_t> terminated, truncated;

  /// Each episode draws its model from `models`, which have the same rules. Throws std::invalid_argument.
  Arena(const ArenaOptions& options, std::vector<Model> models, const BatchKernel& kernel)
      : observations(options.count * observation_size(diabolo::seen_too(options.tasks, options.corrects()))),
        final_observations(observations),
        rewards(options.count),
        terminated(options.count),
        truncated(options.count),
        options_(options),
        seen_too_(diabolo::seen_too(options.tasks, options.corrects())),
        models_(std::move(models)),
        kernel_(kernel),
        workers_(options.threads),
        episodes_((options.validate(), options.count)),
        free_(options.free_axis || seen_too_.axle ? options.count : 0) {
    for (const std::string& name : options.tasks) tasks_.push_back(&task_named(name));
    if (models_.empty()) throw std::invalid_argument("models: none; expected at least one");
    for (const Model& model : models_) {
      if (!model.parameters.same_rules(models_.front().parameters) ||
          !same_texts(model.effects, models_.front().effects))
        throw std::invalid_argument(
            "models: they differ in rules, formulas or residual; expected the same in all");
      const double longest = model.parameters.string_length - limits().string_margin;
      if (!(limits().gap < longest))
        throw std::invalid_argument("limits, gap: " + shown(limits().gap) + " m; expected less than " +
                                    shown(longest) + " m, as for the string");
      const FullPredictor<double> predictor(model.parameters, model.effects);
      for (const Task* task : tasks_)
        hanging_.push_back(
            hang_at_rest(predictor, home(model), 0.5 * (task->info->least_spin + task->info->most_spin)));
    }
    for (std::size_t i = 0; i < options.starts.size(); ++i) expect_held(options.starts[i], i);
    for (const std::string& task : options.tasks) {
      std::vector<const EpisodeStart*>& known = starts_of_.emplace_back();
      for (const EpisodeStart& start : options_.starts)
        if (start.is_of(task)) known.push_back(&start);
    }
    for (std::size_t i = 0; i < episodes_.size(); ++i) episodes_[i].seed = i;
  }

  const ArenaOptions& options() const { return options_; }
  const HandLimits& limits() const { return options_.limits; }
  const SeenToo& seen_too() const { return seen_too_; }
  std::size_t count() const { return episodes_.size(); }
  /// What environment `i` plays, and with what.
  const TaskInfo& task(std::size_t i) const { return *tasks_[episodes_.at(i).task]->info; }
  const AllEffects<double>& effects_of(std::size_t i) const {
    return free_axis(i) ? free_.at(i) : models_[episodes_.at(i).model].effects;
  }
  const Episode& episode(std::size_t i) const { return episodes_.at(i); }

  /// Environment `i` begins its episodes anew with this seed.
  void seed(std::size_t i, std::uint64_t seed) {
    episodes_.at(i).seed = seed;
    episodes_[i].number = 0;
  }

  /// Begins the next episode of environment `i`, with what `given` has in place of what is drawn. Throws
  /// std::invalid_argument where a number of it is not finite, or there is no such model or task.
  void reset(std::size_t i, const Given& given = {}) {
    Episode& episode = episodes_.at(i);
    const auto expect_known = [](const std::string& what, std::optional<std::size_t> number,
                                 std::size_t count) {
      if (number && *number >= count)
        throw std::invalid_argument(what + ": found " + std::to_string(*number) + "; expected less than " +
                                    std::to_string(count) + ", the number of " + what + "s");
    };
    expect_known("model", given.model, models_.size());
    expect_known("task", given.task, tasks_.size());
    for (const double number : given.goal.value_or(Goal{}))
      if (!std::isfinite(number)) throw std::invalid_argument("goal: not finite; expected numbers");
    if (given.state && !is_finite(*given.state))
      throw std::invalid_argument("state: not finite; expected numbers");
    begin(i, given.model, given.task);
    if (given.goal) episode.goal = *given.goal;
    if (given.state) set_state(episode, *given.state);
    observe_into(observations, i);
  }

  /// Plays a period. `actions`: 6 shares of the tips' acceleration (see move_hands) for each environment.
  /// Throws std::invalid_argument, before anything moves, where one is not a number.
  void step(const float* actions) {
    for (std::size_t k = 0; k < 6 * count(); ++k)
      if (!std::isfinite(actions[k]))
        throw std::invalid_argument("actions, environment " + std::to_string(k / 6) + ", number " +
                                    std::to_string(k % 6) + ": not finite; expected -1 to 1");
    const std::size_t lanes = static_cast<std::size_t>(kernel_.lanes), groups = (count() + lanes - 1) / lanes;
    workers_.run([&](std::size_t thread) {
      for (std::size_t group = thread; group < groups; group += workers_.threads())
        play_group(group * lanes, std::min(lanes, count() - group * lanes), actions);
    });
  }

 private:
  /// Where the tips are at first, left over right, but for the shift that each episode draws.
  TipColumn<double> home(const Model& model) const {
    TipColumn<double> tips;
    const double aside = std::min(0.4 * limits().half.y(), 0.2 * model.parameters.string_length);
    const Vector3<double> apart(0.0, std::max(aside, 0.5 * limits().gap), 0.0);
    tips << limits().centre + apart, limits().centre - apart;
    return tips;
  }

  /// Throws std::invalid_argument where a start holds numbers that are not finite, or a string too short.
  void expect_held(const EpisodeStart& start, std::size_t number) const {
    const std::string here = "starts, " + std::to_string(number) + ": ";
    for (const double one : start.goal.value_or(Goal{}))
      if (!std::isfinite(one)) throw std::invalid_argument(here + "goal: not finite; expected numbers");
    if (!is_finite(start.state)) throw std::invalid_argument(here + "state: not finite; expected numbers");
    const auto& [left, right] = start.hands.position;
    double longest = INFINITY;
    for (const Model& model : models_)
      longest = std::min(longest, model.parameters.string_length - limits().string_margin);
    if (!((left - right).norm() <= longest))
      throw std::invalid_argument(here + "tips " + shown((left - right).norm()) +
                                  " m apart; expected at most " + shown(longest) + " m, as for the string");
  }

  /// Whether environment `i` has a free axle in this episode.
  bool free_axis(std::size_t i) const { return options_.free_axis || task(i).axle; }

  void begin(std::size_t i, const std::optional<std::size_t>& model = {},
             const std::optional<std::size_t>& task_number = {}) {
    Episode& episode = episodes_[i];
    Draw draw(episode.seed, episode.number);
    const std::uint64_t seed = episode.seed, number = episode.number + 1;
    episode = {};
    episode.seed = seed;
    episode.number = number;
    const std::size_t drawn_number = drawn_task(tasks_, draw), drawn = draw.index(models_.size());
    episode.task = task_number.value_or(drawn_number);
    const Task& task = *tasks_[episode.task];
    const TaskInfo& info = *task.info;
    episode.model = model.value_or(drawn);
    const Vector3<double>& half = limits().half;
    const Vector3<double> shift(0.0, draw.uniform(-0.2, 0.2) * half.y(), draw.uniform(-0.3, 0.3) * half.z());
    const TipColumn<double> tips = home(models_[episode.model]);
    episode.hands.position = {tips.head<3>() + shift, tips.tail<3>() + shift};
    episode.state = hanging_[episode.model * tasks_.size() + episode.task];
    episode.state.position += shift;
    episode.state.spin = draw.uniform(info.least_spin, info.most_spin);
    episode.rest = episode.state.position;
    for (std::size_t k = 0; k < kMostGoalNumbers; ++k)
      episode.goal[k] = draw.uniform(info.goal[k].low, info.goal[k].high);
    State<double> state = episode.state;
    Beginning beginning{state, limits().centre, models_[episode.model].parameters.gravity, draw};
    if (task.prepare) task.prepare(beginning);
    const std::vector<const EpisodeStart*>& starts = starts_of_[episode.task];
    if (!starts.empty() && options_.start_share > 0.0 && draw.uniform(0.0, 1.0) < options_.start_share) {
      const EpisodeStart& start = *starts[draw.index(starts.size())];
      state = start.state;
      episode.hands = start.hands;
      episode.rest = state.position;
      if (start.goal) episode.goal = *start.goal;
      episode.memory.stage = start.stage;
      episode.memory.flights = start.flights;
      episode.plan = start.plan;
    }
    if (free_axis(i)) {
      free_[i] = models_[episode.model].effects;
      draw_free_axle(free_[i], draw);
    }
    episode.draw = draw;
    set_state(episode, state);
  }

  /// Also to the camera's eyes.
  void set_state(Episode& episode, const State<double>& state) const {
    episode.state = state;
    episode.first_spin = state.spin;
    episode.pull = first_pull(state, models_[episode.model].parameters.gravity);
    if (options_.camera) episode.sight = Sight(*options_.camera, state, episode.draw);
  }

  void observe_into(std::vector<float>& to, std::size_t i) {
    const Episode& episode = episodes_[i];
    observe(episode, task(i), seen_too_, limits().centre, options_.camera.has_value(),
            to.data() + observation_size(seen_too_) * i);
  }

  /// Environments [first, first + used) play a period, a lane each; unused lanes repeat the last one.
  void play_group(std::size_t first, std::size_t used, const float* actions) {
    State<double> after[kMostLanes];
    Tips<double> tips[kMostLanes][2];
    LaneBlock block{};
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(kernel_.lanes); ++lane) {
      const std::size_t i = first + std::min(lane, used - 1);
      Episode& episode = episodes_[i];
      if (lane < used) {
        const double time = options_.period * episode.periods;
        tips[lane][0] = tips_of(episode.hands, time);
        if (!episode.over)
          move_hands(episode, actions + 6 * i, limits(), models_[episode.model].parameters.string_length,
                     options_.period);
        tips[lane][1] = tips_of(episode.hands, time + options_.period);
      }
      after[lane] = episode.state;
      block.parameters[lane] = &models_[episode.model].parameters;
      block.effects[lane] = &effects_of(i);
      block.states[lane] = &after[lane];
      block.tips[lane] = tips[std::min(lane, used - 1)];
    }
    block.dt = options_.period / options_.steps;
    block.evenly = options_.period;
    block.steps = static_cast<std::size_t>(options_.steps);
    kernel_.run(block);
    for (std::size_t lane = 0; lane < used; ++lane) conclude(first + lane, after[lane]);
  }

  /// Takes over what environment `i` played.
  void conclude(std::size_t i, const State<double>& after) {
    Episode& episode = episodes_[i];
    rewards[i] = 0.0;
    terminated[i] = truncated[i] = 0;
    if (episode.over) {
      if (options_.autoreset == Autoreset::kNextStep) begin(i);
      observe_into(observations, i);
      return;
    }
    const Parameters<double>& parameters = models_[episode.model].parameters;
    const State<double> before = std::exchange(episode.state, after);
    const bool failed = !is_finite(after);
    if (failed) episode.state = before;
    ++episode.periods;
    episode.pull = mean_pull(episode, before, parameters.gravity, options_.period);
    Worth worth;
    if (!failed)
      worth = tasks_[episode.task]->judge(
          moment_of(episode, before, limits().centre, parameters.gravity, options_.period), episode.memory);
    if (options_.camera)
      episode.sight.look(*options_.camera, episode.state, options_.period, seen_too_.axle, episode.draw);
    const bool lost =
        failed || (!worth.achieved && dropped(episode, limits().centre, parameters.string_length));
    episode.dropped = lost;
    rewards[i] = worth.reward - (lost ? kDropCosts : 0.0);
    episode.worth += rewards[i];
    terminated[i] = lost || worth.achieved;
    truncated[i] =
        !terminated[i] && episode.periods * options_.period > task(i).seconds - 0.5 * options_.period;
    episode.over = terminated[i] || truncated[i];
    if (episode.over && options_.autoreset == Autoreset::kSameStep) {
      observe_into(final_observations, i);
      begin(i);
    }
    observe_into(observations, i);
  }

  static constexpr double kDropCosts = 1.0;

  ArenaOptions options_;
  SeenToo seen_too_;
  std::vector<const Task*> tasks_;
  std::vector<Model> models_;
  std::vector<std::vector<const EpisodeStart*>> starts_of_;  ///< each task, among options_
  std::vector<State<double>> hanging_;  ///< below the tips at home, for each task of each model
  BatchKernel kernel_;
  WorkerPool workers_;
  std::vector<Episode> episodes_;
  std::vector<AllEffects<double>> free_;  ///< effects of each environment, where its axle is free
};

}  // namespace diabolo
