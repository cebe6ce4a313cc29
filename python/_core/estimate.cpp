// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "diabolo/estimate/arm_forces.hpp"
#include "diabolo/estimate/estimator.hpp"
#include "diabolo/model.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

template <class Set>
struct EstimatorWith;
template <template <class> class... Effects>
struct EstimatorWith<EffectSet<double, Effects...>> {
  using Type = Estimator<true, Effects...>;
};
using FullEstimator = EstimatorWith<AllEffects<double>>::Type;
using FullBelief = Belief<true>;

Tips<double> tips_at(const Array& left, const Array& right, const Array& left_velocity,
                     const Array& right_velocity, double time) {
  Tips<double> tips;
  tips.left = to_vector3(left, "left");
  tips.right = to_vector3(right, "right");
  tips.left_velocity = to_vector3(left_velocity, "left_velocity");
  tips.right_velocity = to_vector3(right_velocity, "right_velocity");
  tips.time = time;
  return tips;
}

std::string name_of(MeasurementStatus status) {
  switch (status) {
    case MeasurementStatus::kAccepted:
      return "accepted";
    case MeasurementStatus::kTooOld:
      return "too_old";
    case MeasurementStatus::kTooNew:
      return "too_new";
    default:
      return "duplicate";
  }
}

FullEstimator make(const Model& model, const State<double>& start, const Array& left, const Array& right,
                   const std::array<double, 4>& spread, const std::array<double, 7>& noise, double time,
                   std::size_t history) {
  const Array still = from_vector3(Vector3<double>::Zero());
  return FullEstimator(FullPredictor<double>(model.parameters, model.effects),
                       {noise[0], noise[1], noise[2], noise[3], noise[4], noise[5], noise[6]}, start,
                       {spread[0], spread[1], spread[2], spread[3]}, tips_at(left, right, still, still, time),
                       time, history);
}

ForceMeasurement force_measurement(const Array& left, const Array& right, double noise) {
  return {{to_vector3(left, "left"), to_vector3(right, "right")},
          noise * MatrixOf<3>::Identity(),
          noise * MatrixOf<3>::Identity()};
}

Joints<double> to_joints(const Array& array, const std::string& name) {
  expect_shape(array, name, {6});
  return Eigen::Map<const Joints<double>>(array.data());
}

/// The end of the last step, where no time is given.
double at(const FullEstimator& estimator, const std::optional<double>& time) {
  return time.value_or(estimator.now().time);
}

}  // namespace

void bind_estimate(py::module_& module) {
  py::class_<FullBelief>(module, "Belief", "See diabolo.estimate.Estimate.")
      .def_readonly("time", &FullBelief::time)
      .def_property_readonly("state", [](const FullBelief& belief) { return belief.state; })
      .def_property_readonly("covariance",
                             [](const FullBelief& belief) {
                               constexpr int kSize = FullBelief::kSize;
                               const MatrixOf<kSize> covariance = belief.covariance();  // symmetric
                               return Array({kSize, kSize}, covariance.data());
                             })
      .def_readonly("string_weights", &FullBelief::string_weights)
      .def_readonly("normalized_innovation_squared", &FullBelief::normalized_innovation_squared)
      .def_property_readonly("gated", [](const FullBelief& belief) { return belief.gated > 0; });

  py::class_<FullEstimator>(module, "Estimator", "See diabolo.estimate.Estimator.")
      .def("__copy__", [](const FullEstimator& own) { return own; })
      .def(
          "__deepcopy__", [](const FullEstimator& own, const py::dict&) { return own; }, "memo"_a)
      .def(py::init(&make), "model"_a, "start"_a, "left"_a, "right"_a, "spread"_a, "noise"_a, "time"_a,
           "history"_a)
      .def(
          "step",
          [](FullEstimator& estimator, const Array& left, const Array& right, const Array& left_velocity,
             const Array& right_velocity, double dt) {
            estimator.step(tips_at(left, right, left_velocity, right_velocity, estimator.now().time + dt),
                           dt);
          },
          "left"_a, "right"_a, "left_velocity"_a, "right_velocity"_a, "dt"_a)
      .def(
          "update_by_forces",
          [](FullEstimator& estimator, const Array& left, const Array& right, double noise,
             const std::optional<double>& time) {
            return name_of(estimator.update(force_measurement(left, right, noise), at(estimator, time)));
          },
          "left"_a, "right"_a, "noise"_a, "time"_a)
      .def(
          "update_by_tensions",
          [](FullEstimator& estimator, double left, double right, double noise,
             const std::optional<double>& time) {
            return name_of(estimator.update(TensionMeasurement{left, right, noise}, at(estimator, time)));
          },
          "left"_a, "right"_a, "noise"_a, "time"_a)
      .def(
          "update_by_torques",
          [](FullEstimator& estimator, const std::array<StickArm, 2>& arms,
             const std::array<Array, 2>& joints, const std::array<Array, 2>& torques, double noise,
             const std::optional<double>& time) {
            const auto read = [&](std::size_t i) {
              return JointTorques{to_joints(joints[i], "joints"), to_joints(torques[i], "torques"), noise};
            };
            const ForceMeasurement forces = forces_by_torques(arms[0], read(0), arms[1], read(1));
            return name_of(estimator.update(forces, at(estimator, time)));
          },
          "arms"_a, "joints"_a, "torques"_a, "noise"_a, "time"_a)
      .def(
          "update_by_camera",
          [](FullEstimator& estimator, double time, const Array& position, double noise,
             const std::optional<Array>& axle, double axle_noise, const std::optional<double>& spin,
             double spin_noise) {
            CameraMeasurement measured{
                .time = time, .position = to_vector3(position, "position"), .noise = noise};
            if (axle) measured.axle = to_vector3(*axle, "axle");
            measured.axle_noise = axle_noise;
            measured.spin = spin;
            measured.spin_noise = spin_noise;
            return name_of(estimator.update(measured));
          },
          "time"_a, "position"_a, "noise"_a, "axle"_a, "axle_noise"_a, "spin"_a, "spin_noise"_a)
      .def("now", [](const FullEstimator& estimator) { return estimator.now(); })
      .def("history", &FullEstimator::history)
      .def(
          "past", [](const FullEstimator& estimator, std::size_t ago) { return estimator.past(ago); },
          "ago"_a);
}

}  // namespace diabolo::python
