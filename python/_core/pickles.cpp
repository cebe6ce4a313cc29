// SPDX-License-Identifier: MIT
#include "pickles.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/plan/goals.hpp"
#include "diabolo/plan/limits.hpp"
#include "diabolo/plan/motion_unknowns.hpp"
#include "diabolo/plan/stick_spline.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/robot/motion/plan_limits.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

/// Pickles a class that is bound already by what `to_state` gives and `from_state` takes, and copies its
/// values.
template <class T, class ToState, class FromState>
void by_state(const ToState& to_state, const FromState& from_state) {
  auto cls = py::reinterpret_borrow<py::class_<T>>(py::type::of<T>());
  cls.def("__copy__", [](const T& value) { return value; });
  cls.def(
      "__deepcopy__", [](const T& value, const py::dict&) { return value; }, py::arg("memo"));
  cls.def(py::pickle(to_state, [from_state](const py::tuple& state) {
    try {
      return from_state(state);
    } catch (const std::exception&) {
      throw std::invalid_argument(std::string(py::str(py::type::of<T>().attr("__name__"))) +
                                  ": a state that is none; expected what a pickle of it holds");
    }
  }));
}

/// For protocols 0 and 1 copyreg makes an instance of pybind11's own base class, which ends the interpreter:
/// they get what protocol 2 does.
void use_protocol_2() {
  const py::object base = py::type::of<Waypoint>().attr("__base__"),
                   object = py::module_::import("builtins").attr("object");
  base.attr("__reduce_ex__") = py::cpp_function(
      [object](const py::object& self, int protocol) {
        return object.attr("__reduce_ex__")(self, std::max(2, protocol));
      },
      py::name("__reduce_ex__"), py::is_method(base), py::arg("protocol"));
}

/// Pickles it by its members.
template <class T, class... Members>
void by_members(Members T::*... members) {
  by_state<T>([members...](const T& value) { return py::make_tuple(value.*members...); },
              [members...](const py::tuple& state) {
                T value{};
                std::size_t next = 0;
                ((value.*members = state[next++].template cast<Members>()), ...);
                return value;
              });
}

std::optional<std::pair<double, double>> pair_of(const std::optional<Target>& target) {
  return target ? std::optional(std::pair(target->value, target->weight)) : std::nullopt;
}

std::optional<Target> target_of(const py::handle& state) {
  const auto pair = state.cast<std::optional<std::pair<double, double>>>();
  return pair ? std::optional(Target{pair->first, pair->second}) : std::nullopt;
}

py::tuple state_of(const Goals& goals) {
  using Place = std::optional<std::pair<Vector3<double>, double>>;
  const Goals::Tolerances& t = goals.tolerances;
  return py::make_tuple(
      goals.waypoints, goals.final_state, pair_of(goals.spin), goals.taut, pair_of(goals.apex),
      goals.landing ? Place(std::pair(goals.landing->position, goals.landing->weight)) : Place(),
      goals.caught, py::make_tuple(t.position, t.velocity, t.direction, t.spin, t.taut));
}

Goals goals_of(const py::tuple& state) {
  Goals goals;
  goals.waypoints = state[0].cast<std::vector<Waypoint>>();
  goals.final_state = state[1].cast<std::optional<Waypoint>>();
  goals.spin = target_of(state[2]);
  goals.taut = state[3].cast<std::optional<double>>();
  goals.apex = target_of(state[4]);
  if (const auto landing = state[5].cast<std::optional<std::pair<Vector3<double>, double>>>())
    goals.landing = Landing{landing->first, landing->second};
  goals.caught = state[6].cast<std::optional<double>>();
  const auto t = state[7].cast<std::vector<double>>();
  goals.tolerances = {t.at(0), t.at(1), t.at(2), t.at(3), t.at(4)};
  goals.validate();
  return goals;
}

/// `others` of robots is pickled with them; a function of the program that made it is copied, no more.
void pickle_tip_limits() {
  using L = TipLimits;
  by_state<L>(
      [](const L& l) {
        const RobotLimits* const robots = l.others.target<RobotLimits>();
        if (l.others && !robots)
          throw py::type_error(
              "TipLimits: others is a function, which cannot be pickled; expected limits without others");
        return py::make_tuple(l.speed, l.acceleration, l.jerk, l.string_margin, l.least_gap, l.lowest,
                              l.highest, robots ? py::cast(*robots) : py::object(py::none()));
      },
      [](const py::tuple& state) {
        L limits{state[0].cast<double>(),         state[1].cast<double>(), state[2].cast<double>(),
                 state[3].cast<double>(),         state[4].cast<double>(), state[5].cast<Vector3<double>>(),
                 state[6].cast<Vector3<double>>()};
        if (!state[7].is_none()) limits.others = state[7].cast<RobotLimits>();
        limits.validate();
        return limits;
      });
}

void pickle_spline() {
  using Spline = StickSpline<double>;
  using Column = TipColumn<double>;
  using Start = std::optional<std::pair<Column, Column>>;
  by_state<Spline>(
      [](const Spline& s) {
        return py::make_tuple(s.begin, s.durations, s.points, static_cast<int>(s.ends),
                              s.start ? Start(std::pair(s.start->velocity, s.start->acceleration)) : Start(),
                              s.sticks);
      },
      [](const py::tuple& state) {
        Spline spline;
        spline.begin = state[0].cast<double>();
        spline.durations = state[1].cast<std::vector<double>>();
        spline.points = state[2].cast<std::vector<Column>>();
        spline.ends = static_cast<SplineEnds>(state[3].cast<int>());
        if (const auto start = state[4].cast<Start>())
          spline.start = SplineStart<double>{start->first, start->second};
        spline.sticks = state[5].cast<Column>();
        spline.validate();
        return spline;
      });
}

void pickle_calibration() {
  using C = Calibration;
  const auto of_point = [](const BodyPoint& p) { return py::make_tuple(p.bodies, p.point, p.axis); };
  const auto to_point = [](const py::handle& state) {
    const py::tuple t = py::reinterpret_borrow<py::tuple>(state);
    return BodyPoint{t[0].cast<std::vector<std::string>>(), t[1].cast<Eigen::Vector3d>(),
                     t[2].cast<Eigen::Vector3d>()};
  };
  by_state<C>(
      [of_point](const C& c) {
        return py::make_tuple(of_point(c.left), of_point(c.right), of_point(c.diabolo), c.world_yaw,
                              c.world_offset, c.properties, c.string_length);
      },
      [to_point](const py::tuple& state) {
        return C{.left = to_point(state[0]),
                 .right = to_point(state[1]),
                 .diabolo = to_point(state[2]),
                 .world_yaw = state[3].cast<double>(),
                 .world_offset = state[4].cast<Eigen::Vector3d>(),
                 .properties = state[5].cast<DiaboloProperties>(),
                 .string_length = state[6].cast<double>()};
      });
}

using Numbers = std::vector<double>;

/// The arm of the paper where it stands, with its own links.
void pickle_arm() {
  by_state<StickArm>(
      [](const StickArm& arm) {
        Numbers links;
        for (const Pose<double>& link : arm.chain.links()) {
          links.insert(links.end(), link.rotation.data(), link.rotation.data() + 9);
          links.insert(links.end(), link.position.data(), link.position.data() + 3);
        }
        const Vector3<double>& at = arm.base.position;
        return py::make_tuple(arm.side == Side::kRight, at.z(), 2.0 * std::abs(at.y()), at.x(), links);
      },
      [](const py::tuple& state) {
        StickArm arm = paper_arm(state[0].cast<bool>() ? Side::kRight : Side::kLeft,
                                 {state[1].cast<double>(), state[2].cast<double>(), state[3].cast<double>()});
        const auto numbers = state[4].cast<Numbers>();
        Chain<double>::Links links;
        if (numbers.size() != 12 * links.size()) throw py::value_error("StickArm: expected six links");
        const double* from = numbers.data();
        for (Pose<double>& link : links) {
          link.rotation = Eigen::Map<const Matrix3<double>>(from);
          link.position = Eigen::Map<const Vector3<double>>(from + 9);
          from += 12;
        }
        arm.chain = Chain<double>(links);
        return arm;
      });
}

void pickle_grid() {
  by_state<IkSeedGrid>(
      [](const IkSeedGrid& grid) {
        const GridBox& box = grid.box();
        return py::make_tuple(box.lower, box.upper, box.knots, grid.joints(),
                              static_cast<int>(grid.interpolation()));
      },
      [](const py::tuple& state) {
        return IkSeedGrid({.lower = state[0].cast<Vector3<double>>(),
                           .upper = state[1].cast<Vector3<double>>(),
                           .knots = state[2].cast<std::array<int, 3>>()},
                          state[3].cast<std::vector<Joints<double>>>(),
                          static_cast<GridInterpolation>(state[4].cast<int>()));
      });
}

void pickle_robots() {
  pickle_arm();
  pickle_grid();
  by_state<StickMap>([](const StickMap& map) { return py::make_tuple(map.arm(), map.grid()); },
                     [](const py::tuple& state) {
                       return StickMap(state[0].cast<StickArm>(), state[1].cast<IkSeedGrid>());
                     });
  using Each = std::array<double, kJointCount>;
  by_state<RobotLimits>(
      [](const RobotLimits& robots) {
        const StickPlanner& planner = robots.planner();
        const JointLimits& limits = planner.limits();
        return py::make_tuple(planner.left(), planner.right(), limits.speed, limits.acceleration, limits.jerk,
                              robots.least_clearance(), robots.share());
      },
      [](const py::tuple& state) {
        const JointLimits limits{state[2].cast<Each>(), state[3].cast<Each>(), state[4].cast<Each>()};
        return RobotLimits(StickPlanner(state[0].cast<StickMap>(), state[1].cast<StickMap>(), limits),
                           state[5].cast<double>(), state[6].cast<double>());
      });
}

}  // namespace

void bind_pickles() {
  use_protocol_2();
  by_members(&Waypoint::position, &Waypoint::velocity, &Waypoint::position_weight, &Waypoint::velocity_weight,
             &Waypoint::direction_weight);
  by_state<Goals>(&state_of, &goals_of);
  by_members(&LimitUse::name, &LimitUse::value, &LimitUse::limit, &LimitUse::unit, &LimitUse::time,
             &LimitUse::excess);
  pickle_tip_limits();
  by_members(&Freedom::forward, &Freedom::times, &Freedom::last_point, &Freedom::reach, &Freedom::stretch);
  pickle_spline();
  by_members(&DiaboloProperties::mass, &DiaboloProperties::diameter, &DiaboloProperties::length,
             &DiaboloProperties::axle_radius);
  pickle_calibration();
  pickle_robots();
}

}  // namespace diabolo::python
