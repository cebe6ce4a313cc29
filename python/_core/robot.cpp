// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "diabolo/diagnose/smooth_tips.hpp"
#include "diabolo/learn/arm_hands.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/robot/arm/build_seed_grid.hpp"
#include "diabolo/robot/arm/gravity_torque.hpp"
#include "diabolo/robot/arm/inverse_near.hpp"
#include "diabolo/robot/arm/seed_grid_file.hpp"
#include "diabolo/robot/motion/check_plan.hpp"
#include "diabolo/robot/motion/plan_limits.hpp"
#include "diabolo/robot/motion/tip_plan_file.hpp"
#include "diabolo/robot/motion/tip_speed.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

Side to_side(const std::string& name) {
  if (name == "left") return Side::kLeft;
  if (name == "right") return Side::kRight;
  throw std::invalid_argument("side: '" + name + "'; expected 'left' or 'right'");
}

StickArm make_arm(const std::string& side, double height, double spacing, double forward,
                  const py::object& calibration) {
  StickArm arm = paper_arm(to_side(side), {height, spacing, forward});
  if (calibration.is_none()) return arm;
  const Array rows = Array::ensure(calibration);
  if (!rows) throw std::invalid_argument("calibration: not of numbers; expected the shape (6, 6)");
  expect_shape(rows, "calibration", {kJointCount, 6});
  Ur5eCalibration links;
  const double* from = rows.data();
  for (LinkCalibration& link : links) {
    link = {from[0], from[1], from[2], from[3], from[4], from[5]};
    from += 6;
  }
  arm.chain = ur5e_from_calibration<double>(links);
  return arm;
}

/// Calls `write(row, out)` for each row of an array of the shape (..., `columns`), finite; the result's shape
/// ends in `rest` in the place of the columns.
template <int columns, class Write>
Array map_rows(const Array& given, const std::string& name, const std::vector<py::ssize_t>& rest,
               const Write& write) {
  std::vector<py::ssize_t> shape = shape_of(given);
  if (shape.empty() || shape.back() != columns)
    throw std::invalid_argument(name + ": shape " + shape_text(shape) + "; expected (..., " +
                                std::to_string(columns) + ")");
  expect_finite(given, name);
  shape.pop_back();
  py::ssize_t size = 1;
  for (const py::ssize_t extent : rest) size *= extent;
  shape.insert(shape.end(), rest.begin(), rest.end());
  Array result(shape);
  const double* from = given.data();
  double* to = result.mutable_data();
  const py::ssize_t rows = given.size() / columns;
  const py::gil_scoped_release unlocked;
  for (py::ssize_t i = 0; i < rows; ++i, from += columns, to += size)
    write(Eigen::Map<const Eigen::Matrix<double, columns, 1>>(from), to);
  return result;
}

void put(const Pose<double>& pose, double* to) {
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(to);
  matrix.setIdentity();
  matrix.topLeftCorner<3, 3>() = pose.rotation;
  matrix.topRightCorner<3, 1>() = pose.position;
}

Array from_pose(const Pose<double>& pose) {
  Array result(std::vector<py::ssize_t>{4, 4});
  put(pose, result.mutable_data());
  return result;
}

Pose<double> to_pose(const Array& matrix) {
  expect_shape(matrix, "flange", {4, 4});
  expect_finite(matrix, "flange");
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> from(matrix.data());
  const Pose<double> pose{from.topLeftCorner<3, 3>(), from.topRightCorner<3, 1>()};
  if (check_pose(pose) != PoseFault::kNone)
    throw std::invalid_argument(
        "flange: its upper left 3 x 3 is no rotation; expected orthogonal unit columns");
  return pose;
}

Array nominal_solutions(const Array& flange) {
  const InverseSolutions<double> solutions = inverse(to_pose(flange));
  Array result(std::vector<py::ssize_t>{solutions.count, kJointCount});
  double* to = result.mutable_data();
  for (const InverseSolution<double>& solution : solutions)
    to = std::copy_n(solution.joints.data(), kJointCount, to);
  return result;
}

Array inverse_of_arm(const StickArm& arm, const Array& flange, const Array& seed) {
  expect_shape(seed, "seed", {kJointCount});
  expect_finite(seed, "seed");
  const Refined<double> found =
      inverse_near<double>(arm.chain, to_pose(flange), Eigen::Map<const Joints<double>>(seed.data()));
  if (!found.converged)
    throw std::invalid_argument("flange: out of the " + std::string(name_of(arm.side)) + " arm's reach");
  Array result(kJointCount);
  std::copy_n(found.joints.data(), kJointCount, result.mutable_data());
  return result;
}

IkSeedGrid build_grid(const StickArm& arm, const py::object& lower, const py::object& upper,
                      const std::array<int, 3>& knots) {
  GridBox box = paper_box(arm);
  const auto corner = [](const py::object& given, const std::string& name) {
    const Array array = Array::ensure(given);
    if (!array) throw std::invalid_argument(name + ": not of numbers; expected the shape (3,)");
    return to_vector3(array, name);
  };
  if (!lower.is_none()) box.lower = corner(lower, "lower");
  if (!upper.is_none()) box.upper = corner(upper, "upper");
  box.knots = knots;
  const py::gil_scoped_release unlocked;
  return build_seed_grid(arm, box);
}

py::tuple solve(const StickMap& map, const Array& points) {
  std::vector<py::ssize_t> shape = shape_of(points);
  if (!shape.empty()) shape.pop_back();
  py::array_t<std::uint8_t> faults(shape);
  std::uint8_t* fault = faults.mutable_data();
  Array joints = map_rows<3>(points, "points", {kJointCount}, [&](const Vector3<double>& point, double* to) {
    const StickMap::Point found = map.at(point);
    *fault++ = static_cast<std::uint8_t>(found.fault);
    const Joints<double> none = Joints<double>::Constant(std::numeric_limits<double>::quiet_NaN());
    std::copy_n((found.fault == StickFault::kNone ? found.joints : none).data(), kJointCount, to);
  });
  return py::make_tuple(std::move(joints), std::move(faults));
}

Array slopes(const StickMap& map, const Array& points) {
  return map_rows<3>(points, "points", {kJointCount, 3}, [&](const Vector3<double>& point, double* to) {
    const StickMap::Point found = map.at(point);
    Eigen::Map<Eigen::Matrix<double, kJointCount, 3, Eigen::RowMajor>> matrix(to);
    matrix = found.slopes;
    if (found.fault != StickFault::kNone) matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
  });
}

/// Of slopes, for each point that has joints.
template <class Speed>
Array tip_speeds(const StickMap& map, const Array& points, const Speed& speed) {
  return map_rows<3>(points, "points", {}, [&](const Vector3<double>& point, double* to) {
    const StickMap::Point found = map.at(point);
    *to = found.fault == StickFault::kNone ? speed(found.slopes) : std::numeric_limits<double>::quiet_NaN();
  });
}

Array tip_speed_along(const StickMap& map, const Array& points, const Array& direction) {
  const Vector3<double> along = to_vector3(direction, "direction");
  return tip_speeds(map, points, [&](const StickMap::Slopes& slopes) { return tip_speed(slopes, along); });
}

Array slowest_tip_speeds(const StickMap& map, const Array& points) {
  return tip_speeds(map, points, [](const StickMap::Slopes& slopes) { return slowest_tip_speed(slopes); });
}

TipMotion<double> recorded_plan(Recording recording) {
  recording.left = smoothed(recording.left, recording.rate);
  recording.right = smoothed(recording.right, recording.rate);
  return tip_motion(recording, Interpolation::kSpline);
}

JointLimits to_limits(double speed, double acceleration, double jerk) {
  const JointLimits limits = JointLimits::uniform(speed, acceleration, jerk);
  check_limits(limits);
  return limits;
}

py::tuple limit(const Array& joints, double speed, double acceleration, double jerk) {
  expect_shape(joints, "joints", {kAny, 2 * kJointCount});
  expect_finite(joints, "joints");
  std::vector<PairJoints> points(static_cast<std::size_t>(joints.shape(0)));
  const double* from = joints.data();
  for (PairJoints& point : points) {
    std::copy_n(from, 2 * kJointCount, point.data());
    from += 2 * kJointCount;
  }
  const LimitedMotion motion = [&] {
    const py::gil_scoped_release unlocked;
    return keep_limits(JointPath(std::move(points)), to_limits(speed, acceleration, jerk));
  }();
  if (!motion.within)
    throw std::invalid_argument(
        "joints: no play a hundred times slower keeps the limits; the path has a corner");
  Array setpoints({static_cast<py::ssize_t>(motion.setpoints.size()), py::ssize_t{2 * kJointCount}});
  double* to = setpoints.mutable_data();
  for (const PairJoints& setpoint : motion.setpoints) to = std::copy_n(setpoint.data(), 2 * kJointCount, to);
  Array planned(static_cast<py::ssize_t>(motion.planned.size()));
  std::copy(motion.planned.begin(), motion.planned.end(), planned.mutable_data());
  return py::make_tuple(std::move(setpoints), std::move(planned));
}

py::dict check(const StickMap& left, const StickMap& right, const TipMotion<double>& motion, double speed,
               double acceleration, double jerk, double least_clearance) {
  const StickPlanner planner(left, right, to_limits(speed, acceleration, jerk));
  PlanCheck found;
  {
    const py::gil_scoped_release unlocked;
    found = check_plan(planner, motion, least_clearance);
  }
  py::list troubles;
  for (const PlanTrouble& trouble : found.troubles)
    troubles.append(py::dict("from_s"_a = trouble.from, "to_s"_a = trouble.to, "who"_a = trouble.who,
                             "why"_a = trouble.why, "tip_m"_a = from_vector3(trouble.tip)));
  py::dict result("playable"_a = found.playable(), "troubles"_a = troubles);
  const bool reached = found.as_played > 0;
  const auto number = [&](const char* name, double value) {
    if (reached)
      result[name] = value;
    else
      result[name] = py::none();
  };
  number("as_planned_s", found.as_planned);
  number("as_played_s", found.as_played);
  number("worst_factor", found.worst_factor);
  number("worst_at_s", found.worst_at);
  number("least_clearance_m", found.least_clearance);
  result["nearest_parts"] = found.nearest_parts;
  return result;
}

void bind_arm(py::module_& module) {
  const Mounts mounts;
  py::class_<StickArm>(module, "StickArm",
                       R"(A UR5e where it stands, with the stick in its flange, as in the paper.

`side` is 'left' or 'right'; `height`, `spacing` (between the two bases) and `forward` (x of the bases) are [m],
world frame. `calibration` has a row of x, y, z [m], roll, pitch, yaw [rad] for each of the six links, shape
(6, 6), as the ROS driver extracts it; None is the arm of the data sheet. Joints are [rad], base to last wrist.)")
      .def(py::init(&make_arm), "side"_a, "height"_a = mounts.height, "spacing"_a = mounts.spacing,
           "forward"_a = mounts.forward, "calibration"_a = py::none())
      .def_property_readonly("side", [](const StickArm& arm) { return name_of(arm.side); })
      .def_property_readonly(
          "base", [](const StickArm& arm) { return from_pose(arm.base); },
          "Pose of the controller's base frame in the world, shape (4, 4).")
      .def_property_readonly(
          "tip", [](const StickArm& arm) { return from_vector3(arm.tip); },
          "The stick's tip in the frame of the flange [m], shape (3,).")
      .def_property_readonly(
          "links",
          [](const StickArm& arm) {
            std::vector<Array> poses;
            for (const Pose<double>& link : arm.chain.links()) poses.push_back(from_pose(link));
            return poses;
          },
          "How each of the six links stands against the one before while its joint, about z, is at zero: "
          "poses of "
          "the shape (4, 4).")
      .def_property_readonly(
          "link_masses",
          [](const StickArm&) {
            std::vector<std::array<double, 4>> masses;
            for (const LinkMass<double>& link : ur5e_masses<double>())
              masses.push_back({link.mass, link.center.x(), link.center.y(), link.center.z()});
            return masses;
          },
          "Of each link its mass [kg] and the centre of that in the link's frame [m], as its maker publishes "
          "them.")
      .def(
          "flange",
          [](const StickArm& arm, const Array& joints) {
            return map_rows<kJointCount>(joints, "joints", {4, 4}, [&](const Joints<double>& q, double* to) {
              put(arm.chain.forward(q), to);
            });
          },
          "joints"_a,
          "Poses of the flange in the controller's base frame, shape (..., 4, 4), of joints (..., 6).")
      .def(
          "tip_position",
          [](const StickArm& arm, const Array& joints) {
            return map_rows<kJointCount>(joints, "joints", {3}, [&](const Joints<double>& q, double* to) {
              std::copy_n(arm.tip_at(q).data(), 3, to);
            });
          },
          "joints"_a, "The stick's tip [m, world], shape (..., 3), of joints (..., 6).")
      .def(
          "jacobian",
          [](const StickArm& arm, const Array& joints) {
            return map_rows<kJointCount>(joints, "joints", {6, 6}, [&](const Joints<double>& q, double* to) {
              Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> matrix(to);
              matrix = arm.chain.jacobian(q, arm.tip);
            });
          },
          "joints"_a,
          "Velocity of the tip (rows 0-2, [m/rad]) and rotation of the flange (rows 3-5) over the joints, "
          "controller's base frame, shape (..., 6, 6).")
      .def("inverse", &inverse_of_arm, "flange"_a, "seed"_a,
           "Joints, shape (6,), near `seed` that bring the flange to a pose in the controller's base frame, "
           "shape "
           "(4, 4). Raises ValueError where the arm does not reach it.")
      .def("__repr__", [](const StickArm& arm) {
        return py::str("<StickArm '{}' at ({:.3f}, {:.3f}, {:.3f}) m>")
            .format(name_of(arm.side), arm.base.position.x(), arm.base.position.y(), arm.base.position.z());
      });
  module.def(
      "ur5e_inverse", &nominal_solutions, "flange"_a,
      "Every joint vector of the data sheet's UR5e, shape (N, 6) with N up to 8, whose flange has a pose in "
      "the controller's base frame, shape (4, 4).");
}

void bind_seed_grid(py::module_& module) {
  py::class_<IkSeedGrid, std::shared_ptr<IkSeedGrid>>(
      module, "SeedGrid", "Joint configurations at the key points of a box, and cubic splines between them.")
      .def_static(
          "build", &build_grid, "arm"_a, "lower"_a = py::none(), "upper"_a = py::none(),
          "knots"_a = std::array<int, 3>{6, 7, 7},
          "For a box from `lower` to `upper` [m, world], each of the shape (3,); default: the paper's. "
          "Raises ValueError with the point that the arm does not reach.")
      .def_static(
          "load", [](const std::filesystem::path& path) { return load_seed_grid(path); }, "path"_a,
          Unlocked(), "What save() wrote.")
      .def(
          "save",
          [](const IkSeedGrid& grid, const std::filesystem::path& path) { save_seed_grid(path, grid); },
          "path"_a, Unlocked(), "Write a CSV of x, y, z [m] and q1 to q6 [rad], a line for each key point.")
      .def_property_readonly(
          "lower", [](const IkSeedGrid& grid) { return from_vector3(grid.box().lower); },
          "[m, world], shape (3,).")
      .def_property_readonly(
          "upper", [](const IkSeedGrid& grid) { return from_vector3(grid.box().upper); },
          "[m, world], shape (3,).")
      .def_property_readonly(
          "knots", [](const IkSeedGrid& grid) { return grid.box().knots; }, "Key points along x, y and z.")
      .def_property_readonly(
          "joints",
          [](const IkSeedGrid& grid) {
            const std::array<int, 3>& n = grid.box().knots;
            Array result(std::vector<py::ssize_t>{n[0], n[1], n[2], kJointCount});
            double* to = result.mutable_data();
            for (const Joints<double>& q : grid.joints()) to = std::copy_n(q.data(), kJointCount, to);
            return result;
          },
          "Of the key points [rad], shape (x, y, z, 6).")
      .def(
          "seed",
          [](const IkSeedGrid& grid, const Array& points) {
            return map_rows<3>(points, "points", {kJointCount},
                               [&](const Vector3<double>& point, double* to) {
                                 std::copy_n(grid.at(point).joints.data(), kJointCount, to);
                               });
          },
          "points"_a,
          "Interpolated joints [rad], shape (..., 6), at points (..., 3); outside, of the nearest point.");
}

void bind_stick_map(py::module_& module) {
  py::class_<StickMap, std::shared_ptr<StickMap>>(
      module, "StickMap", "The joints of an arm as a function of its stick's tip, without drift.")
      .def(py::init<StickArm, IkSeedGrid>(), "arm"_a, "grid"_a)
      .def_property_readonly("arm", &StickMap::arm)
      .def_property_readonly("grid", &StickMap::grid)
      .def("solve", &solve, "points"_a,
           "Joints [rad], shape (..., 6), with the tip at points [m, world], shape (..., 3), and a code for "
           "each, "
           "shape (...): 0 reached, 1 outside the grid's box, 2 out of reach, 3 outside a joint's range; "
           "there "
           "the joints are NaN.")
      .def("slopes", &slopes, "points"_a,
           "How the joints follow the tip [rad/m], shape (..., 6, 3); NaN where solve() has a code.")
      .def(
          "tip_speed", &tip_speed_along, "points"_a, "direction"_a,
          "How fast the tip may go in a direction of any length, shape (3,), before a joint exceeds pi rad/s "
          "[m/s], shape (...); NaN where solve() has a code.")
      .def("slowest_tip_speed", &slowest_tip_speeds, "points"_a,
           "The same in the slowest direction: there one joint alone sets the pace.");
}

void bind_robot_limits(py::module_& module) {
  const JointLimits limits = JointLimits::uniform();
  py::class_<RobotLimits>(
      module, "RobotLimits",
      R"(What two arms, each a StickMap, ask of a path: TipLimits(others=RobotLimits(left, right)).

Reach, the joints' speed [rad/s], acceleration [rad/s^2] and jerk [rad/s^3], of which `share` may be used up, and
what must stay between the arms [m]. Called with a TipPath, it returns a list of LimitUse.)")
      .def(py::init([](const StickMap& left, const StickMap& right, double speed, double acceleration,
                       double jerk, double least_clearance, double share) {
             return RobotLimits(StickPlanner(left, right, to_limits(speed, acceleration, jerk)),
                                least_clearance, share);
           }),
           "left"_a, "right"_a, "speed"_a = limits.speed[0], "acceleration"_a = limits.acceleration[0],
           "jerk"_a = limits.jerk[0], "least_clearance"_a = 0.10, "share"_a = 0.97)
      .def("__call__", &RobotLimits::operator(), "path"_a, Unlocked());

  module.def(
      "arm_hand_limits",
      [](const StickMap& left, const StickMap& right, double speed, double acceleration,
         const std::optional<HandLimits>& room) {
        const py::gil_scoped_release unlocked;
        return arm_hand_limits(left, right, JointLimits::uniform(speed, acceleration),
                               room.value_or(arm_room()));
      },
      "left"_a, "right"_a, "speed"_a = limits.speed[0], "acceleration"_a = limits.acceleration[0],
      "room"_a = py::none(),
      R"(HandLimits of an agent under which no joint of two arms, each a StickMap, exceeds `speed` [rad/s] or
`acceleration` [rad/s^2], wherever in its part of a box a tip is. The box is that of `room`, HandLimits whose speed and acceleration do not
count; None is one in front of the paper's arms. Jerk is not limited. Raises ValueError where an arm does not
reach its part.)");

  module.def("keep_limits", &limit, "joints"_a, "speed"_a = limits.speed[0],
             "acceleration"_a = limits.acceleration[0], "jerk"_a = limits.jerk[0],
             R"(Play a path slowly enough.

`joints` [rad] of both arms, left and then right, 2 ms apart, shape (N, 12). Gives setpoints 2 ms apart of the same
curve, shape (M, 12), whose speed [rad/s], acceleration [rad/s^2] and jerk [rad/s^3] keep the limits, and the time
of the path that each belongs to [s], shape (M,). Raises ValueError where no play is slow enough.)");
  module.def(
      "load_tip_plan", &load_tip_plan, "path"_a, Unlocked(),
      "The TipMotion of a CSV with the columns time, left_x ... right_z [s, m], or a tidy recording's.");
  module.def(
      "recorded_plan", &recorded_plan, "recording"_a, Unlocked(),
      "The TipMotion of a recording whose tips are smoothed: a camera's noise of 0.1 mm asks for more jerk "
      "than an arm's limits allow.");
  module.def("check_plan", &check, "left"_a, "right"_a, "motion"_a, "speed"_a = limits.speed[0],
             "acceleration"_a = limits.acceleration[0], "jerk"_a = limits.jerk[0], "least_clearance"_a = 0.10,
             "Whether two arms, each a StickMap, can play a TipMotion from rest to rest, where not and why.");
}

}  // namespace

void bind_robot(py::module_& module) {
  bind_arm(module);
  bind_seed_grid(module);
  bind_stick_map(module);
  bind_robot_limits(module);
}

}  // namespace diabolo::python
