// SPDX-License-Identifier: MIT
#include "diabolo/plan/player.hpp"
#include "diabolo/plan/aim_again.hpp"
#include "diabolo/plan/plan_action.hpp"

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/learn/planned_starts.hpp"
#include "diabolo/model.hpp"
#include "diabolo/plan/success_rate.hpp"
#include "diabolo/robot/motion/plan_limits.hpp"
#include "diabolo/text/shown.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupt.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using Vector = Vector3<double>;
using Column = TipColumn<double>;
using Spline = StickSpline<double>;
using Path = TipPath<double>;

template <template <class> class... Effects>
PlanProblem<Effects...> problem_type(const Predictor<double, Effects...>&);
template <template <class> class... Effects>
RecedingHorizon<Effects...> horizon_type(const Predictor<double, Effects...>&);
using Simulator = FullPredictor<double>;
using Problem = decltype(problem_type(std::declval<Simulator>()));
using FullRecedingHorizon = decltype(horizon_type(std::declval<Simulator>()));

Column column(const Vector& left, const Vector& right) {
  Column both;
  both << left, right;
  return both;
}

Goals make_goals(std::vector<Waypoint> waypoints, std::optional<Waypoint> final_state,
                 std::optional<double> spin, double spin_weight, std::optional<double> taut,
                 std::optional<double> apex, std::optional<Vector> landing, std::optional<double> caught) {
  Goals goals;
  goals.waypoints = std::move(waypoints);
  goals.final_state = std::move(final_state);
  if (spin) goals.spin = Target{*spin, spin_weight};
  goals.taut = taut;
  if (apex) goals.apex = Target{*apex};
  if (landing) goals.landing = Landing{*landing};
  goals.caught = caught;
  goals.validate();
  return goals;
}

Spline make_spline(const std::vector<double>& times, const Array& left, const Array& right, bool loop,
                   const std::optional<std::pair<Column, Column>>& start, const Column& sticks) {
  const py::ssize_t size = static_cast<py::ssize_t>(times.size());
  const std::vector<Vector> lefts = to_rows(left, "left", size), rights = to_rows(right, "right", size);
  Spline spline;
  spline.ends = loop ? SplineEnds::kPeriodic : SplineEnds::kClamped;
  if (!times.empty()) spline.begin = times.front();
  for (std::size_t i = 0; i < times.size(); ++i) {
    spline.points.push_back(column(lefts[i], rights[i]));
    if (i > 0) spline.durations.push_back(times[i] - times[i - 1]);
  }
  if (start) spline.start = SplineStart<double>{start->first, start->second};
  spline.sticks = sticks;
  spline.validate();
  return spline;
}

std::vector<double> times_of(const Spline& spline) {
  std::vector<double> times{spline.begin};
  for (const double duration : spline.durations) times.push_back(times.back() + duration);
  return times;
}

/// One stick's part of the points, shape (M, 3).
Eigen::MatrixXd points_of(const Spline& spline, int side) {
  Eigen::MatrixXd points(static_cast<Eigen::Index>(spline.points.size()), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points.row(i) = spline.points[static_cast<std::size_t>(i)].segment<3>(3 * side);
  return points;
}

/// Position and three derivatives at each time, shape (4, N, 6).
Array derivatives_of(const Path& path, const Array& times) {
  expect_shape(times, "times", {kAny});
  expect_finite(times, "times");
  Array result({py::ssize_t{4}, times.shape(0), py::ssize_t{6}});
  for (py::ssize_t i = 0; i < times.shape(0); ++i) {
    const auto derivatives = path.derivatives_at(times.data()[i]);
    for (py::ssize_t k = 0; k < 4; ++k)
      for (py::ssize_t c = 0; c < 6; ++c)
        result.mutable_at(k, i, c) = derivatives[static_cast<std::size_t>(k)][c];
  }
  return result;
}

/// Numbers of each instant of a play, one array each.
struct PlayArrays {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::VectorXd time;
  Rows states, axis, left, right;
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1> codes;

  explicit PlayArrays(const Play<double>& play) {
    const Eigen::Index size = static_cast<Eigen::Index>(play.instants.size());
    time.resize(size);
    codes.resize(size);
    states.resize(size, 7);
    axis.resize(size, 3);
    left.resize(size, 3);
    right.resize(size, 3);
    for (Eigen::Index i = 0; i < size; ++i) {
      const PlayInstant<double>& instant = play.instants[static_cast<std::size_t>(i)];
      time[i] = instant.time;
      states.row(i) << instant.state.position.transpose(), instant.state.velocity.transpose(),
          instant.state.spin;
      axis.row(i) = instant.state.axis;
      codes[i] = static_cast<std::uint8_t>(instant.state.string_state);
      left.row(i) = instant.tips.left;
      right.row(i) = instant.tips.right;
    }
  }
};

/// Time, states, string states, left and right tips of what a plan leads to.
py::tuple play_of(const Play<double>& play) {
  const PlayArrays arrays(play);
  return py::make_tuple(arrays.time, arrays.states, arrays.codes, arrays.left, arrays.right);
}

Simulator simulator(const Model& model) { return Simulator(model.parameters, model.effects); }

std::vector<Simulator> simulators(const std::vector<Model>& models) {
  std::vector<Simulator> result;
  for (const Model& model : models) result.push_back(simulator(model));
  return result;
}

/// `starts`: one for all models, or one for each.
Problem make_problem(const std::vector<Model>& models, const std::vector<State<double>>& starts,
                     const Spline& seed, const Goals& goals, const TipLimits& limits, const Freedom& freedom,
                     double dt) {
  if (starts.empty()) throw std::invalid_argument("plan: no start state; at least one expected");
  Problem problem{simulators(models), starts.front(), seed, goals, limits, freedom, dt};
  if (starts.size() > 1) problem.starts = starts;
  return problem;
}

/// Of a path to foresee, which takes 0.2 kB an instant [s].
constexpr double kLongestPath = 3600.0;

Plan make_plan(const std::vector<Model>& models, const std::vector<State<double>>& starts, const Spline& seed,
               const Goals& goals, const TipLimits& limits, const Freedom& freedom, const std::string& solver,
               int evaluations, double seconds, std::uint64_t random_seed, double dt) {
  const Problem problem = make_problem(models, starts, seed, goals, limits, freedom, dt);
  SearchOptions options{.solver = solver_named(solver),
                        .evaluations = evaluations,
                        .seconds = seconds,
                        .random_seed = random_seed,
                        .dt = dt};
  Plan plan;
  run_interruptibly([&](const std::atomic<bool>& cancel) {
    options.cancelled = [&cancel] { return cancel.load(); };
    plan = searched(problem, options);
  });
  return plan;
}

PlannedPlay make_action(const std::string& action, const std::vector<Model>& models,
                        const std::optional<State<double>>& start, int cycles, double spin, double size,
                        double pace, std::optional<double> height, std::optional<double> sideways,
                        std::optional<double> spin_gain, const TipLimits& limits, const std::string& solver,
                        double seconds, std::uint64_t random_seed, double dt, const Column& sticks) {
  ActionRequest wanted{
      .action = action,
      .cycles = cycles,
      .spin = spin,
      .size = size,
      .pace = pace,
      .height = height,
      .sideways = sideways,
      .spin_gain = spin_gain,
      .start = start,
      .limits = limits,
      .search = {.solver = solver_named(solver), .seconds = seconds, .random_seed = random_seed, .dt = dt},
      .sticks = sticks};
  const std::vector<Simulator> by = simulators(models);
  PlannedPlay planned;
  run_interruptibly([&](const std::atomic<bool>& cancel) {
    wanted.search.cancelled = [&cancel] { return cancel.load(); };
    planned = plan_action(wanted, by);
  });
  return planned;
}

/// With a period of the agent [s], starts with the plans; without, moments along them.
std::vector<EpisodeStart> make_taught_starts(const std::string& task, const std::vector<Model>& models,
                                             int plays, std::uint64_t seed, const HandLimits& limits,
                                             std::optional<double> period) {
  const std::vector<Simulator> by = simulators(models);
  LessonOptions options{.plays = plays, .seed = seed, .limits = limits};
  if (period) ArenaOptions{.period = *period}.validate();
  std::vector<EpisodeStart> starts;
  run_interruptibly([&](const std::atomic<bool>& cancel) {
    options.cancelled = [&cancel] { return cancel.load(); };
    starts = period ? planned_starts(task, by, options, *period) : taught_starts(task, by, options);
  });
  return starts;
}

HandPlan make_hand_plan(const PlannedPlay& planned, double string_length, const HandLimits& limits,
                        double period) {
  limits.validate();
  ArenaOptions{.period = period}.validate();
  expect_positive("string_length", string_length, kFarthest);
  return planned_hands(planned, shift_to(limits.centre, planned), limits, string_length, period);
}

py::list lessons() {
  py::list tasks;
  for (const Lesson& lesson : kLessons) tasks.append(lesson.task);
  return tasks;
}

/// What a path leads to by a model.
py::tuple foresee(const Model& model, const State<double>& start, const Path& path, double dt, double flight,
                  double down_to) {
  if (!(dt >= 1e-5 && dt <= 0.1))
    throw std::invalid_argument("dt: " + shown(dt) + " s; must be within 0.00001 and 0.1 s");
  if (!(flight >= 0.0 && flight <= 60.0))
    throw std::invalid_argument("flight: " + shown(flight) + " s; must be within 0 and 60 s");
  check_state("start", start);
  if (path.end() - path.begin() > kLongestPath)
    throw std::invalid_argument("tip path: lasts " + shown(path.end() - path.begin()) + " s; expected " +
                                shown(kLongestPath) + " s at most");
  const Simulator by = simulator(model);  // copies: others may change theirs meanwhile
  const State<double> from = start;
  Play<double> seen;
  {
    const py::gil_scoped_release free;
    seen = play(by, from, path, {.dt = dt, .flight = flight, .down_to = down_to});
  }
  return play_of(seen);
}

/// The paper's residual of a path, for solvers of one's own; infinite where it breaks a limit.
double cost(const std::vector<Model>& models, const State<double>& start, const Spline& motion,
            const Goals& goals, const TipLimits& limits, double dt) {
  const Problem problem = make_problem(models, {start}, motion, goals, limits, Freedom{}, dt);
  problem.validate();
  const Path path = path_of(motion);
  return keeps(path, limits, problem.string_length()) ? problem.cost(path, dt, false) : INFINITY;
}

void bind_goals(py::module_& module) {
  py::class_<Waypoint>(module, "Waypoint",
                       "A state of the diabolo that is wanted: position [m] and velocity [m/s], and the "
                       "weights of the paper's costs: distance, difference of speeds, angle.")
      .def(py::init([](const Vector& position, const Vector& velocity, double by_position, double by_speed,
                       double by_direction) {
             return Waypoint{position, velocity, by_position, by_speed, by_direction};
           }),
           "position"_a, "velocity"_a = Vector(Vector::Zero()), "position_weight"_a = 1.0,
           "velocity_weight"_a = 0.0, "direction_weight"_a = 0.0)
      .def_readwrite("position", &Waypoint::position)
      .def_readwrite("velocity", &Waypoint::velocity)
      .def_readwrite("position_weight", &Waypoint::position_weight)
      .def_readwrite("velocity_weight", &Waypoint::velocity_weight)
      .def_readwrite("direction_weight", &Waypoint::direction_weight);
  py::class_<Goals>(module, "Goals",
                    R"(What a plan shall achieve; what is not given does not count.

waypoints are passed in this order; final_state and spin [rad/s] hold at the end; taut is the weight of slack;
apex [m], above the tips, and landing [m] are those of the flight that the motion ends in; caught is the weight
of missing a diabolo that flies.)")
      .def(py::init(&make_goals), "waypoints"_a = std::vector<Waypoint>(), "final_state"_a = py::none(),
           "spin"_a = py::none(), "spin_weight"_a = 0.02, "taut"_a = py::none(), "apex"_a = py::none(),
           "landing"_a = py::none(), "caught"_a = py::none())
      .def_readonly("waypoints", &Goals::waypoints)
      .def_readonly("final_state", &Goals::final_state)
      .def_readonly("taut", &Goals::taut)
      .def_readonly("caught", &Goals::caught)
      .def_property_readonly(
          "spin", [](const Goals& g) { return g.spin ? std::optional(g.spin->value) : std::nullopt; })
      .def_property_readonly(
          "apex", [](const Goals& g) { return g.apex ? std::optional(g.apex->value) : std::nullopt; })
      .def_property_readonly("landing", [](const Goals& g) {
        return g.landing ? std::optional(g.landing->position) : std::nullopt;
      });
}

void bind_path(py::module_& module) {
  py::class_<Path>(module, "TipPath", "Planned motion of the tips: piecewise cubics.")
      .def_property_readonly("begin", &Path::begin, "[s]")
      .def_property_readonly("end", &Path::end, "[s]")
      .def("derivatives", &derivatives_of, "times"_a,
           "Tips, left over right [m], and their velocity, acceleration and jerk at times of the shape (N,): "
           "shape (4, N, 6).")
      .def(
          "tips", [](const Path& path, double interval) { return sampled(path, interval); },
          "interval"_a = 2e-3, "The same motion in samples [s], for predictions.")
      .def(
          "followed_by",
          [](Path path, const Path& next) {
            path.append(next);
            return path;
          },
          "next"_a,
          "This path and then another one, moved in time to this one's end, where their tips and velocities "
          "must meet.");
}

/// RobotLimits as they are, without the interpreter, or what a function in Python returns.
PathLimits path_limits(const py::object& given) {
  if (given.is_none()) return {};
  if (py::isinstance<RobotLimits>(given)) return given.cast<RobotLimits>();
  if (!PyCallable_Check(given.ptr()))
    throw std::invalid_argument("limits, others: " + std::string(py::repr(given)).substr(0, 60) +
                                "; expected a function of a TipPath");
  return [call = given.cast<std::function<std::vector<LimitUse>(const Path&)>>()](const Path& path) {
    try {
      return call(path);
    } catch (const py::cast_error&) {
      throw std::invalid_argument("limits, others: what it returned is no list of LimitUse");
    }
  };
}

void bind_limits(py::module_& module) {
  py::class_<LimitUse>(module, "LimitUse",
                       "How much of a limit a path uses: value, limit, and the excess, at most zero where it "
                       "is kept, as a share or in metres.")
      .def(py::init<std::string, double, double, std::string, double, double>(), "name"_a, "value"_a,
           "limit"_a, "unit"_a, "time"_a, "excess"_a)
      .def_readonly("name", &LimitUse::name)
      .def_readonly("value", &LimitUse::value)
      .def_readonly("limit", &LimitUse::limit)
      .def_readonly("unit", &LimitUse::unit)
      .def_readonly("time", &LimitUse::time)
      .def_readonly("excess", &LimitUse::excess);
  py::class_<TipLimits>(module, "TipLimits",
                        R"(What the tips may do; every plan keeps it.

speed [m/s], acceleration [m/s^2] and jerk [m/s^3] of either tip; string_margin [m]: the tips stay closer than
the string is long by this; least_gap [m]: the left tip stays to the left of the right one by this; lowest and
highest [m]: corners of the workspace; others: called with a TipPath, returns a list of LimitUse, such as a
robot's.)")
      .def(py::init([](double speed, double acceleration, double jerk, double string_margin, double least_gap,
                       const Vector& lowest, const Vector& highest, const py::object& others) {
             TipLimits limits{speed,     acceleration, jerk,    string_margin,
                              least_gap, lowest,       highest, path_limits(others)};
             limits.validate();
             return limits;
           }),
           "speed"_a = TipLimits{}.speed, "acceleration"_a = TipLimits{}.acceleration,
           "jerk"_a = TipLimits::kNone, "string_margin"_a = TipLimits{}.string_margin,
           "least_gap"_a = TipLimits{}.least_gap, "lowest"_a = TipLimits{}.lowest,
           "highest"_a = TipLimits{}.highest, "others"_a = py::none())
      .def_readonly("speed", &TipLimits::speed)
      .def_readonly("acceleration", &TipLimits::acceleration)
      .def_readonly("jerk", &TipLimits::jerk)
      .def_readonly("string_margin", &TipLimits::string_margin)
      .def_readonly("least_gap", &TipLimits::least_gap)
      .def_readonly("lowest", &TipLimits::lowest)
      .def_readonly("highest", &TipLimits::highest);
  module.def("limit_uses", &limit_uses, "path"_a, "limits"_a, "string_length"_a, Unlocked(),
             "How much a path uses of each limit, from its exact maxima.");
  py::class_<Freedom>(module, "Freedom",
                      "What a solver may change of a seed: x too, durations, the last point; up to a reach "
                      "[m] of each coordinate and a stretch of each duration, as a share.")
      .def(py::init([](bool forward, bool times, bool last_point, double reach, double stretch) {
             Freedom freedom{forward, times, last_point, reach, stretch};
             freedom.validate();
             return freedom;
           }),
           "forward"_a = false, "times"_a = true, "last_point"_a = true, "reach"_a = 0.4, "stretch"_a = 0.25)
      .def_readonly("forward", &Freedom::forward)
      .def_readonly("times", &Freedom::times)
      .def_readonly("last_point", &Freedom::last_point)
      .def_readonly("reach", &Freedom::reach)
      .def_readonly("stretch", &Freedom::stretch);
}

void bind_motions(py::module_& module) {
  py::class_<Spline>(module, "StickSpline",
                     R"(A motion of the tips by control points: a clamped or periodic cubic spline.

times [s], shape (M,); left and right [m], shape (M, 3); loop: it ends as it begins; start: velocity and
acceleration of both tips that it goes on from, two arrays of the shape (6,), left over right; sticks: their
directions, unit vectors, likewise, zero where not known; StickFlex alone looks at them.)")
      .def(py::init(&make_spline), "times"_a, "left"_a, "right"_a, "loop"_a = false, "start"_a = py::none(),
           "sticks"_a = Column(Column::Zero()))
      .def_property_readonly("times", &times_of)
      .def_property_readonly("left", [](const Spline& s) { return points_of(s, 0); })
      .def_property_readonly("right", [](const Spline& s) { return points_of(s, 1); })
      .def_readonly("sticks", &Spline::sticks)
      .def("path", &path_of<double>, "The TipPath through the points.");
  py::class_<Action>(module, "Action", "A figure of play: seed motion, freedom and goals.")
      .def_readonly("name", &Action::name)
      .def_readonly("seed", &Action::seed)
      .def_readonly("freedom", &Action::freedom)
      .def_readonly("goals", &Action::goals);
  const std::vector<std::string_view> planned = planned_actions();
  module.attr("PLANNED_ACTIONS") = py::tuple(py::cast(planned));
  py::dict wanted;
  for (const Aim& aim : aims()) wanted[py::cast(aim.name)] = py::tuple(py::cast(aim.actions));
  module.attr("AIMS") = wanted;
  module.def(
      "home_pose",
      [](const std::string& name, double string_length) {
        const Column home = home_pose(name, string_length);
        return std::pair<Vector, Vector>(home.head<3>(), home.tail<3>());
      },
      "name"_a, "string_length"_a, "Where the tips start a figure [m]: left and right.");
  module.def(
      "hanging_state",
      [](const Vector& left, const Vector& right, double string_length, double spin) {
        return hanging_state(left, right, string_length, spin);
      },
      "left"_a, "right"_a, "string_length"_a, "spin"_a = 0.0,
      "A diabolo that hangs at rest at the lowest point between the tips.");
  module.def(
      "hang_at_rest",
      [](const Model& model, const Vector& left, const Vector& right, double spin, const Column& sticks) {
        return hang_at_rest(simulator(model), column(left, right), spin, sticks);
      },
      "model"_a, "left"_a, "right"_a, "spin"_a = 0.0, "sticks"_a = Column(Column::Zero()),
      "See diabolo.hang_at_rest.");
  module.def(
      "action",
      [](const std::string& name, const Vector& left, const Vector& right, const State<double>& start,
         double string_length, double size, double pace, double height, double sideways,
         std::optional<double> spin_gain, const Column& sticks) {
        Action action = action_named(name, column(left, right), start, string_length,
                                     {size, pace, height, sideways, spin_gain});
        action.seed.sticks = sticks;
        return action;
      },
      "name"_a, "left"_a, "right"_a, "start"_a, "string_length"_a, "size"_a = 1.0, "pace"_a = 1.0,
      "height"_a = 0.5, "sideways"_a = 0.3, "spin_gain"_a = py::none(), "sticks"_a = Column(Column::Zero()),
      "The figure of that name from a pose of the tips and a state of the diabolo.");
}

void bind_played(py::module_& module) {
  py::class_<PlannedPlay>(module, "PlannedPlay",
                          "A planned motion, and what it leads to by the model that it was planned with.")
      .def_readonly("action", &PlannedPlay::action)
      .def_readonly("path", &PlannedPlay::path, "Of the tips.")
      .def_readonly("plans", &PlannedPlay::plans,
                    "One a cycle; of a throw and catch, two, or one where there is nothing to catch.")
      .def_property_readonly(
          "wanted", [](const PlannedPlay& p) { return std::vector<Goals>{p.wanted}; },
          "The goals of the first cycle.")
      .def_readonly("start", &PlannedPlay::start, "State of the diabolo.")
      .def_property_readonly(
          "time", [](const PlannedPlay& p) { return PlayArrays(p.play).time; }, "[s], shape (N,).")
      .def_property_readonly(
          "states", [](const PlannedPlay& p) { return PlayArrays(p.play).states; },
          "Position [m], velocity [m/s] and spin [rad/s], shape (N, 7).")
      .def_property_readonly(
          "axis", [](const PlannedPlay& p) { return PlayArrays(p.play).axis; },
          "Direction of the axle, shape (N, 3).")
      .def_property_readonly(
          "string_states", [](const PlannedPlay& p) { return PlayArrays(p.play).codes; },
          "As in StringState, shape (N,).")
      .def_property_readonly(
          "left", [](const PlannedPlay& p) { return PlayArrays(p.play).left; }, "Left tip [m], shape (N, 3).")
      .def_property_readonly(
          "right", [](const PlannedPlay& p) { return PlayArrays(p.play).right; },
          "Right tip [m], shape (N, 3).")
      .def_readonly("planning_time", &PlannedPlay::planning_time, "Of all plans together [s].")
      .def_readonly("ended", &PlannedPlay::ended,
                    "Why there are fewer cycles than were asked for; empty where there are not.")
      .def_property_readonly("reached", &PlannedPlay::reached,
                             "Whether every goal of every cycle is reached.")
      .def_property_readonly(
          "answer", &PlannedPlay::answer,
          "The same in a sentence: that of the first plan that misses a goal, or why there are no more.")
      .def("__repr__", [](const PlannedPlay& p) {
        return "<PlannedPlay " + p.action + ", " + shown_rounded(p.path.end() - p.path.begin()) +
               " s: " + p.answer() + ">";
      });
  module.def("plan_action", &make_action, "action"_a, "models"_a, "start"_a, "cycles"_a, "spin"_a, "size"_a,
             "pace"_a, "height"_a, "sideways"_a, "spin_gain"_a, "limits"_a, "solver"_a, "seconds"_a,
             "random_seed"_a, "dt"_a, "sticks"_a, "See diabolo.plan_action.");
  module.def("taught_starts", &make_taught_starts, "task"_a, "models"_a, "plays"_a, "seed"_a, "limits"_a,
             "period"_a = py::none(), "See diabolo.envs.taught_starts and diabolo.envs.planned_starts.");
  module.def("hand_plan", &make_hand_plan, "planned"_a, "string_length"_a, "limits"_a, "period"_a,
             "See diabolo.envs.hand_plan.");
  module.def("lessons", &lessons, "Tasks that the player teaches.");
  module.def(
      "success_rate",
      [](const PlannedPlay& planned, const std::vector<Model>& models) {
        const std::vector<Simulator> by = simulators(models);
        const py::gil_scoped_release free;
        return success_rate(planned, by);
      },
      "play"_a, "models"_a, "See diabolo.success_rate.");
}

ThrowAim throw_aim(const Array& array, const std::string& name) {
  expect_shape(array, name, {2});
  expect_finite(array, name);
  return {array.data()[0], array.data()[1]};
}

void bind_plans(py::module_& module) {
  py::class_<GoalCost>(module, "GoalCost", "How far a plan is off one goal.")
      .def_readonly("name", &GoalCost::name)
      .def_readonly("weight", &GoalCost::weight)
      .def_readonly("error", &GoalCost::error)
      .def_readonly("tolerance", &GoalCost::tolerance)
      .def_readonly("unit", &GoalCost::unit, "Of error and tolerance; empty for a share.")
      .def_readonly("reached", &GoalCost::reached);
  py::class_<Plan>(module, "Plan", "A motion that was found, and what it leads to. It keeps its limits.")
      .def_readonly("motion", &Plan::motion)
      .def_readonly("path", &Plan::path)
      .def_readonly("goals", &Plan::goals)
      .def_readonly("cost", &Plan::cost)
      .def_readonly("limits", &Plan::limits)
      .def_readonly("reached", &Plan::reached)
      .def_readonly("answer", &Plan::answer)
      .def_readonly("evaluations", &Plan::evaluations)
      .def_property_readonly(
          "play", [](const Plan& plan) { return play_of(plan.play); },
          "Times, states (N, 7), string states, left and right tips.")
      .def_property_readonly(
          "end", [](const Plan& plan) { return plan.play.end().state; }, "State at the end of the motion.");
  module.def("plan", &make_plan, "models"_a, "starts"_a, "seed"_a, "goals"_a, "limits"_a, "freedom"_a,
             "solver"_a, "evaluations"_a, "seconds"_a, "random_seed"_a, "dt"_a, "See diabolo.plan.");
  module.def(
      "foresee", &foresee, "model"_a, "start"_a, "path"_a, "dt"_a = 1e-3, "flight"_a = 0.0,
      "down_to"_a = -TipLimits::kNone,
      "What a path leads to by a model: times, states (N, 7), string states, left and right tips. A flight "
      "at its end is followed for `flight` seconds, or until it falls through the height `down_to`.");
  module.def("plan_cost", &cost, "models"_a, "start"_a, "motion"_a, "goals"_a, "limits"_a, "dt"_a = 4e-3,
             "The paper's residual of a motion; infinite where it breaks a limit.");
  module.def(
      "aimed_again",
      [](const Array& aim, const Array& wanted, const Array& came) {
        const ThrowAim next =
            aimed_again(throw_aim(aim, "aim"), throw_aim(wanted, "wanted"), throw_aim(came, "came"));
        return py::make_tuple(next.height, next.sideways);
      },
      "aim"_a, "wanted"_a, "came"_a, "See diabolo.aimed_again.");
  py::class_<Seam>(module, "Seam", "Where a new piece of motion sets in.")
      .def_readonly("time", &Seam::time)
      .def_readonly("state", &Seam::state)
      .def("joined", &joined_at, "seed"_a, "A seed moved there, which goes on from the tips' motion.")
      .def_property_readonly("left", [](const Seam& s) { return Vector(s.tips.head<3>()); })
      .def_property_readonly("right", [](const Seam& s) { return Vector(s.tips.tail<3>()); })
      .def(
          "catch",
          [](const Seam& seam, const Vector& left, const Vector& right, const Model& model,
             const std::vector<State<double>>& others) {
            return catch_action(seam, column(left, right), model.parameters.string_length,
                                model.parameters.catch_slack, model.parameters.gravity, others);
          },
          "home_left"_a, "home_right"_a, "model"_a, "others"_a = std::vector<State<double>>(),
          "The action that catches the diabolo, which flies, as it is or as in one of the other states.");
  py::class_<FullRecedingHorizon>(module, "RecedingHorizon",
                                  R"(Motion that is planned piece by piece while it is played.

    seam = horizon.seam(now)         # where a plan that is begun now can set in
    piece = ...                      # a plan from seam.state, its seed seam.joined(...)
    horizon.join(seam, piece, now, planning_time)  # False where it comes too late)")
      .def(py::init([](const Model& model, const Vector& left, const Vector& right,
                       const State<double>& state, double begin, const Column& sticks) {
             return FullRecedingHorizon(simulator(model), column(left, right), state, begin, sticks);
           }),
           "model"_a, "left"_a, "right"_a, "state"_a, "begin"_a = 0.0, "sticks"_a = Column(Column::Zero()))
      .def_property_readonly("path", &FullRecedingHorizon::path)
      .def("observe", &FullRecedingHorizon::observe, "time"_a, "state"_a,
           "Takes over an observed state; predictions begin with the latest one.")
      .def("seam", &FullRecedingHorizon::seam, "now"_a)
      .def("seam_at", &FullRecedingHorizon::seam_at, "time"_a)
      .def("join", &FullRecedingHorizon::join, "seam"_a, "plan"_a, "now"_a, "planning_time"_a);
}

}  // namespace

void bind_player(py::module_& module) {
  bind_goals(module);
  bind_path(module);
  bind_limits(module);
  bind_motions(module);
  bind_plans(module);
  bind_played(module);
}

}  // namespace diabolo::python
