// SPDX-License-Identifier: MIT
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "diabolo/batch/kernels.hpp"
#include "diabolo/json/agent_file.hpp"
#include "diabolo/learn/arena.hpp"
#include "diabolo/learn/follow_pointers.hpp"
#include "diabolo/learn/live_agent.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "choices.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using Actions = py::array_t<float, py::array::c_style | py::array::forcecast>;

using GivenPlan = std::optional<std::shared_ptr<const HandPlan>>;

/// One name or several.
using Names = std::variant<std::string, std::vector<std::string>>;

std::vector<std::string> list_of(const Names& names) {
  if (const auto* one = std::get_if<std::string>(&names)) return {*one};
  return std::get<std::vector<std::string>>(names);
}

std::unique_ptr<Arena> make_arena(const Names& tasks, std::vector<Model> models, std::size_t count,
                                  double period, int steps, const std::string& autoreset, int threads,
                                  const HandLimits& limits, const std::optional<Camera>& camera,
                                  std::vector<EpisodeStart> starts, double start_share, bool free_axis) {
  const ArenaOptions options{.tasks = list_of(tasks),
                             .count = count,
                             .period = period,
                             .steps = steps,
                             .autoreset = choice_from_python<Autoreset>(autoreset, "autoreset"),
                             .threads = threads,
                             .limits = limits,
                             .camera = camera,
                             .starts = std::move(starts),
                             .start_share = start_share,
                             .free_axis = free_axis};
  return std::make_unique<Arena>(options, std::move(models), batch_kernel_for(count));
}

/// What an arena writes, an entry for each environment: not copied, and no longer lived than the arena.
template <class T>
py::array view_of(const py::object& arena, std::vector<T>& numbers, py::ssize_t count) {
  const auto width = static_cast<py::ssize_t>(numbers.size()) / count;
  return width == 1 ? py::array_t<T>({count}, numbers.data(), arena)
                    : py::array_t<T>({count, width}, numbers.data(), arena);
}

template <class Member>
auto viewed(Member member) {
  return [member](const py::object& self) {
    auto& arena = self.cast<Arena&>();
    return view_of(self, arena.*member, static_cast<py::ssize_t>(arena.count()));
  };
}

void step(Arena& arena, const Actions& actions) {
  expect_shape(actions, "actions", {static_cast<py::ssize_t>(arena.count()), 6});
  const float* const from = actions.data();
  const py::gil_scoped_release unlocked;
  arena.step(from);
}

std::size_t checked(const Arena& arena, std::size_t i) {
  if (i >= arena.count())
    throw std::invalid_argument("environment: " + std::to_string(i) + "; expected less than " +
                                std::to_string(arena.count()));
  return i;
}

/// Throws std::invalid_argument where there are more numbers than a goal has.
Goal goal_of(const std::vector<double>& numbers, std::size_t least, std::size_t most) {
  if (numbers.size() < least || numbers.size() > most)
    throw std::invalid_argument("goal: " + std::to_string(numbers.size()) + " numbers; expected " +
                                (least < most ? "at most " : "") + std::to_string(most));
  Goal goal{};
  std::ranges::copy(numbers, goal.begin());
  return goal;
}

std::size_t goal_size(const TaskInfo& task) {
  return static_cast<std::size_t>(
      std::ranges::count_if(task.goal, [](const GoalInfo& info) { return !info.name.empty(); }));
}

/// `task`: as episodes draw one of several, it is given beside a goal.
void reset(Arena& arena, std::size_t i, const std::optional<State<double>>& state,
           const std::optional<std::vector<double>>& goal, const std::optional<std::size_t>& model,
           const std::optional<std::size_t>& task) {
  const std::vector<std::string>& tasks = arena.options().tasks;
  Given given{.state = state, .goal = {}, .model = model, .task = task};
  if (goal && !task && tasks.size() > 1)
    throw std::invalid_argument("goal: given without a task; expected both, as there are several tasks");
  if (goal && task.value_or(0) < tasks.size()) {
    const std::size_t size = goal_size(*task_named(tasks[task.value_or(0)]).info);
    given.goal = goal_of(*goal, size, size);
  }
  arena.reset(checked(arena, i), given);
}

py::tuple pose(const Arena& arena, std::size_t i) {
  const Episode& episode = arena.episode(checked(arena, i));
  return py::make_tuple(episode.state, episode.hands.position[0], episode.hands.position[1]);
}

/// What an episode has come to, for tables.
py::dict outcome(const Arena& arena, std::size_t i) {
  const Episode& episode = arena.episode(checked(arena, i));
  std::size_t numbers = 0;  // of the longest goal: as many in each environment
  for (const std::string& task : arena.options().tasks)
    numbers = std::max(numbers, goal_size(*task_named(task).info));
  const std::vector<double> goal(episode.goal.begin(),
                                 episode.goal.begin() + static_cast<std::ptrdiff_t>(numbers));
  return py::dict("worth"_a = episode.worth, "seconds"_a = episode.periods * arena.options().period,
                  "over"_a = episode.over, "dropped"_a = episode.dropped, "first_spin"_a = episode.first_spin,
                  "spin"_a = episode.state.spin, "flights"_a = episode.memory.flights,
                  "apex"_a = episode.memory.apex, "level"_a = episode.memory.level, "goal"_a = goal,
                  "model"_a = episode.model, "task"_a = arena.task(i).name);
}

constexpr int kMostCounted = 1000;  // stages and flights of an episode's start

EpisodeStart make_start(const State<double>& state, const Vector3<double>& left, const Vector3<double>& right,
                        const Vector3<double>& left_velocity, const Vector3<double>& right_velocity,
                        const std::optional<std::vector<double>>& goal, int stage, int flights,
                        const std::string& task, const GivenPlan& plan) {
  for (const auto& [name, number] : {std::pair("stage", stage), std::pair("flights", flights)})
    if (number < 0 || number > kMostCounted)
      throw std::invalid_argument(std::string(name) + ": " + std::to_string(number) + "; expected 0 to " +
                                  std::to_string(kMostCounted));
  EpisodeStart start{state,
                     {{left, right}, {left_velocity, right_velocity}},
                     {},
                     stage,
                     flights,
                     task,
                     plan.value_or(nullptr)};
  if (goal) start.goal = goal_of(*goal, 1, kMostGoalNumbers);
  return start;
}

LiveAgent make_live(const Agent& agent, const Vector3<double>& left, const Vector3<double>& right,
                    const std::vector<double>& goal, const HandLimits& limits, double string_length,
                    double gravity, const std::optional<Camera>& camera, std::uint64_t seed,
                    const std::string& task, const GivenPlan& plan) {
  const std::size_t size = goal_size(*task_named(agent.tasks[task_number(agent, task)]).info);
  const LiveOptions options{goal_of(goal, size, size), limits, string_length, gravity, camera, seed, task,
                            plan.value_or(nullptr)};
  return {agent, Hands{{left, right}, {Vector3<double>::Zero(), Vector3<double>::Zero()}}, options};
}

using Weights = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Agent make_agent(const Names& names, double period, int steps,
                 const std::vector<std::pair<Weights, Eigen::VectorXf>>& layers, bool corrects) {
  const std::vector<std::string> tasks = list_of(names);
  ArenaOptions{.tasks = tasks, .period = period, .steps = steps}.validate();
  const std::size_t seen = observation_size(seen_too(tasks, corrects));
  std::vector<Layer> own;
  own.reserve(layers.size());
  for (const auto& [weights, bias] : layers) own.push_back({weights, bias});
  return {tasks, period, steps, Policy(std::move(own), seen), corrects};
}

py::list layers_of(const Agent& agent) {
  py::list layers;
  for (const Layer& layer : agent.policy.layers()) layers.append(py::make_tuple(layer.weights, layer.bias));
  return layers;
}

py::array_t<float> act(const Agent& agent, const Actions& observations) {
  const py::ssize_t seen_numbers = agent.policy.inputs();
  const bool one = observations.ndim() == 1;
  const py::ssize_t count = one || observations.ndim() == 0 ? 1 : observations.shape(0);
  expect_shape(observations, "observations",
               one ? std::vector<py::ssize_t>{seen_numbers} : std::vector<py::ssize_t>{count, seen_numbers});
  py::array_t<float> result(one ? std::vector<py::ssize_t>{Policy::kActions}
                                : std::vector<py::ssize_t>{count, Policy::kActions});
  const Eigen::Map<const Eigen::MatrixXf> seen(observations.data(), seen_numbers, count);
  Eigen::Map<Eigen::MatrixXf> done(result.mutable_data(), Policy::kActions, count);
  const py::gil_scoped_release unlocked;
  done = agent.policy.act(seen);
  return result;
}

py::list task_infos() {
  py::list tasks;
  for (const Task& task : kTasks) {
    py::list goal;
    for (const GoalInfo& number : task.info->goal)
      if (!number.name.empty())
        goal.append(py::dict("name"_a = number.name, "unit"_a = number.unit, "low"_a = number.low,
                             "high"_a = number.high, "meaning"_a = number.meaning,
                             "seen_over"_a = number.seen_over));
    tasks.append(py::dict("name"_a = task.info->name, "meaning"_a = task.info->meaning,
                          "reward"_a = task.info->reward, "seconds"_a = task.info->seconds, "goal"_a = goal,
                          "spin"_a = py::make_tuple(task.info->least_spin, task.info->most_spin)));
  }
  return tasks;
}

py::list observation_infos(const Names& tasks, bool corrects) {
  const SeenToo too = seen_too(list_of(tasks), corrects);
  py::list infos;
  const auto append = [&infos](const auto& some) {
    for (const ObservationInfo& info : some)
      infos.append(py::dict("name"_a = info.name, "unit"_a = info.unit, "size"_a = info.size,
                            "meaning"_a = info.meaning));
  };
  append(kObservations);
  if (too.axle) append(kAxleObservations);
  for (std::size_t i = 0; i < too.tasks; ++i)
    append(std::array{ObservationInfo{"task", "1", 1, "1 where the task is this one of several"}});
  if (corrects) append(kPlanObservations);
  return infos;
}

void bind_hand_plan(py::module_& module) {
  py::class_<HandPlan, std::shared_ptr<HandPlan>>(
      module, "HandPlan",
      "A planned play for an agent's hands to play and to correct, a period [s] at "
      "a time. left and right [m]: the tips at first.")
      .def_readonly("period", &HandPlan::period)
      .def_property_readonly("left", [](const HandPlan& plan) { return plan.at(0).hands.position[0]; })
      .def_property_readonly("right", [](const HandPlan& plan) { return plan.at(0).hands.position[1]; })
      .def("__len__", [](const HandPlan& plan) { return plan.moments.size(); })
      .def(py::pickle(
          [](const HandPlan& plan) {
            py::list moments;
            for (const HandPlan::Moment& m : plan.moments)
              moments.append(
                  py::make_tuple(m.hands.position, m.hands.velocity, m.position, m.velocity, m.shares));
            return py::make_tuple(plan.period, moments);
          },
          [](const py::tuple& t) {
            HandPlan plan{.period = t[0].cast<double>(), .moments = {}};
            for (const py::handle one : t[1]) {
              const auto m = one.cast<py::tuple>();
              plan.moments.push_back({{m[0].cast<Hands::Pair>(), m[1].cast<Hands::Pair>()},
                                      m[2].cast<Vector3<double>>(),
                                      m[3].cast<Vector3<double>>(),
                                      m[4].cast<HandShares>()});
            }
            return plan;
          }));
}

/// Both hands, left over right, a step later: their places and velocities, shape (2, 3) each.
std::pair<Array, Array> follow(const Array& position, const Array& velocity, const Array& pointers,
                               double string_length, double dt) {
  const auto both = [](const Array& rows, const char* name) {
    const std::vector<Vector3<double>> read = to_rows(rows, name, 2);
    python::expect_finite(rows, name);
    return Hands::Pair{read[0], read[1]};
  };
  for (const auto& [name, value] : {std::pair{"string_length", string_length}, {"dt", dt}})
    if (!(value > 0.0 && std::isfinite(value)))
      throw std::invalid_argument(std::string(name) + ": " + shown(value) + "; expected more than 0");
  Hands hands{both(position, "position"), both(velocity, "velocity")};
  follow_pointers(hands, both(pointers, "pointers"), string_length, dt);
  const auto rows_of = [](const Hands::Pair& pair) {
    Array rows({2, 3});
    for (py::ssize_t side = 0; side < 2; ++side)
      std::copy_n(pair[static_cast<std::size_t>(side)].data(), 3, rows.mutable_data(side, 0));
    return rows;
  };
  return {rows_of(hands.position), rows_of(hands.velocity)};
}

}  // namespace

void bind_learn(py::module_& module) {
  const HandLimits usual;
  py::class_<HandLimits>(module, "HandLimits",
                         R"(What the tips may do under an agent.

speed [m/s] and acceleration [m/s^2] of either tip along each axis; gap [m]: between the tips along y;
string_margin [m]: the tips stay closer than the string is long by this; centre and half [m]: of the box, whose
left half (along y) the left tip keeps to, and the right tip to the other.)")
      .def(py::init([](double speed, double acceleration, double gap, double string_margin,
                       const Vector3<double>& centre, const Vector3<double>& half) {
             const HandLimits limits{speed, acceleration, gap, string_margin, centre, half};
             limits.validate();
             return limits;
           }),
           "speed"_a = usual.speed, "acceleration"_a = usual.acceleration, "gap"_a = usual.gap,
           "string_margin"_a = usual.string_margin, "centre"_a = usual.centre, "half"_a = usual.half)
      .def(py::pickle(
          [](const HandLimits& l) {
            return py::make_tuple(l.speed, l.acceleration, l.gap, l.string_margin, l.centre, l.half);
          },
          [](const py::tuple& t) {
            return HandLimits{t[0].cast<double>(),          t[1].cast<double>(),
                              t[2].cast<double>(),          t[3].cast<double>(),
                              t[4].cast<Vector3<double>>(), t[5].cast<Vector3<double>>()};
          }))
      .def_readonly("speed", &HandLimits::speed)
      .def_readonly("acceleration", &HandLimits::acceleration)
      .def_readonly("gap", &HandLimits::gap)
      .def_readonly("string_margin", &HandLimits::string_margin)
      .def_readonly("centre", &HandLimits::centre)
      .def_readonly("half", &HandLimits::half);
  const Camera eyes;
  py::class_<Camera>(
      module, "Camera",
      R"(How an agent sees the diabolo: with noise, late, and not in every frame. A frame is a period.

noise [m] of each coordinate, spin_noise [rad/s] and axle_noise of each coordinate of the axle's direction, where that
is seen: standard deviations; dropouts: share of the frames in which
nothing is seen; least_delay to most_delay [frames]: each episode draws one.)")
      .def(py::init([](double noise, double spin_noise, double dropouts, int least_delay, int most_delay,
                       double axle_noise) {
             const Camera camera{noise, spin_noise, axle_noise, dropouts, least_delay, most_delay};
             camera.validate();
             return camera;
           }),
           "noise"_a = eyes.noise, "spin_noise"_a = eyes.spin_noise, "dropouts"_a = eyes.dropouts,
           "least_delay"_a = eyes.least_delay, "most_delay"_a = eyes.most_delay,
           "axle_noise"_a = eyes.axle_noise)
      .def(py::pickle(
          [](const Camera& c) {
            return py::make_tuple(c.noise, c.spin_noise, c.axle_noise, c.dropouts, c.least_delay,
                                  c.most_delay);
          },
          [](const py::tuple& t) {
            return Camera{t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>(),
                          t[3].cast<double>(), t[4].cast<int>(),    t[5].cast<int>()};
          }))
      .def_readonly("noise", &Camera::noise)
      .def_readonly("spin_noise", &Camera::spin_noise)
      .def_readonly("axle_noise", &Camera::axle_noise)
      .def_readonly("dropouts", &Camera::dropouts)
      .def_readonly("least_delay", &Camera::least_delay)
      .def_readonly("most_delay", &Camera::most_delay);
  bind_hand_plan(module);
  const Vector3<double> none = Vector3<double>::Zero();
  py::class_<EpisodeStart>(
      module, "EpisodeStart",
      "What an episode may begin with in place of a hanging diabolo, as in the middle of somebody's play: "
      "the diabolo's state, the tips' places [m] and velocities [m/s], the goal (None: it is drawn), the "
      "stage "
      "of a task that has several, and how many flights were caught.")
      .def(py::init(&make_start), "state"_a, "left"_a, "right"_a, "left_velocity"_a = none,
           "right_velocity"_a = none, "goal"_a = py::none(), "stage"_a = 0, "flights"_a = 0, "task"_a = "",
           "plan"_a = py::none())
      .def(py::pickle(
          [](const EpisodeStart& s) {
            return py::make_tuple(s.state, s.hands.position, s.hands.velocity, s.goal, s.stage, s.flights,
                                  s.task, s.plan);
          },
          [](const py::tuple& t) {
            return EpisodeStart{t[0].cast<State<double>>(),
                                {t[1].cast<Hands::Pair>(), t[2].cast<Hands::Pair>()},
                                t[3].cast<std::optional<Goal>>(),
                                t[4].cast<int>(),
                                t[5].cast<int>(),
                                t[6].cast<std::string>(),
                                t[7].cast<std::shared_ptr<HandPlan>>()};
          }));
  py::class_<Arena>(module, "Arena",
                    "Environments side by side, in the compiled core: what diabolo.envs is made of. Its "
                    "arrays are its own memory, which each step overwrites.")
      .def(py::init(&make_arena), "task"_a, "models"_a, "count"_a = 1, "period"_a = 0.01, "steps"_a = 10,
           "autoreset"_a = "next_step", "threads"_a = 1, py::arg_v("limits", usual, "HandLimits()"),
           "camera"_a = py::none(), "starts"_a = std::vector<EpisodeStart>(), "start_share"_a = 0.0,
           "free_axis"_a = false)
      .def(
          "seed",
          [](Arena& arena, std::size_t i, std::uint64_t seed) { arena.seed(checked(arena, i), seed); },
          "environment"_a, "seed"_a, "Its episodes begin anew with this seed.")
      .def("reset", &reset, "environment"_a, "state"_a = py::none(), "goal"_a = py::none(),
           "model"_a = py::none(), "task"_a = py::none(),
           "Begins its next episode, with what is given in place of what is drawn.")
      .def("step", &step, "actions"_a,
           "Plays a period. actions: shares of the tips' accelerations, shape (count, 6).")
      .def("pose", &pose, "environment"_a, "State of the diabolo, left tip and right tip.")
      .def(
          "model_of",
          [](const Arena& arena, std::size_t i) { return arena.episode(checked(arena, i)).model; },
          "environment"_a, "Number of the model that it plays with.")
      .def("outcome", &outcome, "environment"_a,
           "What its episode has come to: worth (the sum of its rewards), seconds, over, dropped, first_spin "
           "and spin [rad/s], flights that ended in a catch, apex [m] of the last, level (how long the axle "
           "has "
           "been level by now [s], in a task that levels it), goal, model.")
      .def_property_readonly("count", &Arena::count)
      .def_property_readonly("observations", viewed(&Arena::observations),
                             "float32, shape (count, numbers of an observation).")
      .def_property_readonly("final_observations", viewed(&Arena::final_observations),
                             "Of episodes that the same step has reset.")
      .def_property_readonly("rewards", viewed(&Arena::rewards))
      .def_property_readonly("terminated", viewed(&Arena::terminated))
      .def_property_readonly("truncated", viewed(&Arena::truncated));
  py::class_<Agent>(
      module, "Agent",
      R"(An agent: a network that sees observations and gives actions, and what it was trained for.

task: its name; period [s] between its actions; steps of the simulation in a period; layers: (weights, bias) of each,
weights of the shape (outputs, inputs), with tanh between them. Outputs are cut off at -1 and 1. corrects: whether
they are added to a plan's motion.)")
      .def(py::init(&make_agent), "task"_a, "period"_a, "steps"_a, "layers"_a, "corrects"_a = false)
      .def_static("load", &load_agent, "path"_a, Unlocked(), "Reads a file of the schema diabolo.agent/1.")
      .def("to_json", &write_agent, "decimals"_a = py::none(),
           "The text of its file; with its numbers rounded to so many decimals (1 to 6) it is a third as "
           "large.")
      .def("act", &act, "observations"_a,
           "Actions, shape (6,) or (n, 6), of observations, shape (k,) or (n, k), of k numbers each.")
      .def_readonly("tasks", &Agent::tasks)
      .def_readonly("period", &Agent::period)
      .def_readonly("steps", &Agent::steps)
      .def_readonly("corrects", &Agent::corrects)
      .def_property_readonly("layers", &layers_of)
      .def("__repr__",
           [](const Agent& agent) {
             std::string text = "Agent(";
             for (const std::string& task : agent.tasks) text.append(task).append(", ");
             text += "every " + shown(agent.period) + " s: " + std::to_string(agent.policy.inputs());
             for (const Layer& layer : agent.policy.layers())
               text.append("-").append(std::to_string(layer.bias.size()));
             return text + ")";
           })
      .def(py::pickle([](const Agent& agent) { return write_agent(agent); },
                      [](const std::string& text) { return read_agent(text, "pickle"); }));
  const LiveOptions live;
  py::class_<LiveAgent>(module, "LiveAgent",
                        R"(An agent at the sticks of a robot or of somebody else's simulator.

left and right [m]: where the tips are at first, at rest; goal: as many numbers as the task has; string_length [m];
gravity [m/s^2]; camera: it sees what that makes of the states that it is shown, with noise of this seed; task: one of the
agent's, where it knows several; plan: that it corrects, which begins with these tips. Raises ValueError where the
tips are not within the limits.)")
      .def(py::init(&make_live), "agent"_a, "left"_a, "right"_a, "goal"_a = std::vector<double>(),
           py::arg_v("limits", usual, "HandLimits()"), "string_length"_a = live.string_length,
           "gravity"_a = live.gravity, "camera"_a = py::none(), "seed"_a = 0, "task"_a = "",
           "plan"_a = py::none())
      .def_property_readonly("agent", &LiveAgent::agent)
      .def(
          "act",
          [](LiveAgent& agent, const State<double>& state) {
            const Hands& hands = agent.act(state);
            return py::make_tuple(hands.position[0], hands.position[1], hands.velocity[0], hands.velocity[1]);
          },
          "state"_a,
          "Shows it the diabolo, once a period: left tip, right tip and their velocities at the period's "
          "end. "
          "Until then their accelerations are constant.");
  module.def(
      "follow_pointers", &follow, "position"_a, "velocity"_a, "pointers"_a, "string_length"_a, "dt"_a,
      "Where the hands of a live play are after a step of `dt` [s], and how fast: both of the shape (2, 3), "
      "left over right [m, m/s], as they go after the pointers, shape (2, 3) [m].");
  module.def("task_infos", &task_infos,
             "What can be played: name, meaning, reward, seconds, goal and first spin of each.");
  module.def("observation_infos", &observation_infos, "task"_a = std::vector<std::string>(),
             "corrects"_a = false,
             "What an agent of these tasks sees: name, unit, size and meaning. Last what one that corrects "
             "plans does.");
}

}  // namespace diabolo::python
