// SPDX-License-Identifier: MIT
// Kinematics of the arm beside Orocos KDL's, in one run: divide by `kdl_forward`.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <random>
#include <vector>

#include <diabolo/robot/build_seed_grid.hpp>
#include <diabolo/robot/inverse_near.hpp>
#include <diabolo/robot/stick_map.hpp>

#include "support/heap.hpp"

namespace diabolo {
namespace {

const Vector3<double> kTip{0.0055, -0.043, 0.356};

std::vector<Joints<double>> drawn() {
  std::mt19937_64 engine(1);
  std::vector<Joints<double>> all(1024);
  for (Joints<double>& q : all)
    for (int k = 0; k < kJointCount; ++k)
      q[k] = kPi * (2.0 * static_cast<double>(engine() >> 11U) * 0x1p-53 - 1.0);
  return all;
}

/// Runs `work(i)` over the drawn inputs; counts what it allocates.
template <class Work>
void measure(benchmark::State& state, const Work& work) {
  const long before = allocations();
  std::size_t i = 0;
  for (auto _ : state) work(i++ % 1024);
  state.counters["allocations"] = static_cast<double>(allocations() - before);
}

KDL::Chain kdl_arm() {
  const Ur5eLengths l;
  const double d[] = {l.d1, 0, 0, l.d4, l.d5, l.d6}, a[] = {0, l.a2, l.a3, 0, 0, 0};
  const double alpha[] = {kPi / 2, 0, 0, kPi / 2, -kPi / 2, 0};
  KDL::Chain chain;
  for (int i = 0; i < 6; ++i)
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(a[i], alpha[i], d[i], 0)));
  return chain;
}

std::vector<KDL::JntArray> kdl_joints() {
  std::vector<KDL::JntArray> all;
  for (const Joints<double>& q : drawn()) {
    all.emplace_back(6);
    all.back().data = q;
  }
  return all;
}

void kdl_forward(benchmark::State& state) {
  const KDL::Chain chain = kdl_arm();
  const std::vector<KDL::JntArray> joints = kdl_joints();
  KDL::ChainFkSolverPos_recursive solver(chain);
  KDL::Frame flange;
  measure(state, [&](std::size_t i) {
    solver.JntToCart(joints[i], flange);
    benchmark::DoNotOptimize(flange);
  });
}
BENCHMARK(kdl_forward);

void forward(benchmark::State& state) {
  const Chain<double> chain = ur5e_nominal<double>();
  const std::vector<Joints<double>> joints = drawn();
  measure(state, [&](std::size_t i) { benchmark::DoNotOptimize(chain.forward(joints[i])); });
}
BENCHMARK(forward);

void kdl_jacobian(benchmark::State& state) {
  const KDL::Chain chain = kdl_arm();
  const std::vector<KDL::JntArray> joints = kdl_joints();
  KDL::ChainJntToJacSolver solver(chain);
  KDL::Jacobian jacobian(6);
  measure(state, [&](std::size_t i) {
    solver.JntToJac(joints[i], jacobian);
    benchmark::DoNotOptimize(jacobian.data.data());
  });
}
BENCHMARK(kdl_jacobian);

void jacobian(benchmark::State& state) {
  const Chain<double> chain = ur5e_nominal<double>();
  const std::vector<Joints<double>> joints = drawn();
  measure(state, [&](std::size_t i) { benchmark::DoNotOptimize(chain.jacobian(joints[i], kTip)); });
}
BENCHMARK(jacobian);

void inverse_all_8(benchmark::State& state) {
  const Chain<double> chain = ur5e_nominal<double>();
  std::vector<Pose<double>> flanges;
  for (const Joints<double>& q : drawn()) flanges.push_back(chain.forward(q));
  measure(state, [&](std::size_t i) { benchmark::DoNotOptimize(inverse(flanges[i])); });
}
BENCHMARK(inverse_all_8);

void inverse_of_a_calibrated_arm(benchmark::State& state) {
  Ur5eCalibration calibration = nominal_calibration();
  for (LinkCalibration& link : calibration) {
    link.y += 1e-3;
    link.roll += 1e-3;
  }
  const Chain<double> chain = ur5e_from_calibration<double>(calibration);
  const std::vector<Joints<double>> joints = drawn();
  std::vector<Pose<double>> flanges;
  for (const Joints<double>& q : joints) flanges.push_back(chain.forward(q));
  measure(state,
          [&](std::size_t i) { benchmark::DoNotOptimize(inverse_near(chain, flanges[i], joints[i])); });
}
BENCHMARK(inverse_of_a_calibrated_arm);

void stick_task_in_closed_form(benchmark::State& state) {
  const Chain<double> chain = ur5e_nominal<double>();
  const std::vector<Joints<double>> joints = drawn();
  std::vector<Vector3<double>> targets;
  for (const Joints<double>& q : joints) targets.push_back(chain.forward(q) * kTip);
  measure(state, [&](std::size_t i) {
    benchmark::DoNotOptimize(stick_inverse<double>(targets[i], kTip, posture_of(joints[i])));
  });
}
BENCHMARK(stick_task_in_closed_form);

/// Looking up the seed and solving, nominal arm or calibrated; `p99_us` and `worst_us` of single calls.
void seed_grid_look_up(benchmark::State& state, bool calibrated) {
  StickArm arm = paper_arm(Side::kRight);
  if (calibrated) {
    Ur5eCalibration calibration = nominal_calibration();
    for (LinkCalibration& link : calibration) {
      link.y += 1e-3;
      link.roll += 1e-3;
    }
    arm.chain = ur5e_from_calibration<double>(calibration);
  }
  const StickMap map(arm, build_seed_grid(arm, paper_box(arm)));
  const GridBox& box = map.grid().box();
  std::vector<Vector3<double>> points;
  for (const Joints<double>& q : drawn()) {
    const Vector3<double> share = (q.head<3>().array() / (2.0 * kPi) + 0.5).matrix();
    points.emplace_back(box.lower + Vector3<double>(share.cwiseProduct(box.upper - box.lower)));
  }
  std::vector<double> times(100000);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(map.at(points[i % 1024]));
    times[i] = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }
  measure(state, [&](std::size_t i) { benchmark::DoNotOptimize(map.at(points[i])); });
  std::ranges::sort(times);
  state.counters["p99_us"] = times[times.size() * 99 / 100];
  state.counters["worst_us"] = times.back();
}
BENCHMARK_CAPTURE(seed_grid_look_up, nominal, false);
BENCHMARK_CAPTURE(seed_grid_look_up, calibrated, true);

void build_a_seed_grid(benchmark::State& state) {
  const StickArm arm = paper_arm(Side::kRight);
  for (auto _ : state) benchmark::DoNotOptimize(build_seed_grid(arm, paper_box(arm)));
}
BENCHMARK(build_a_seed_grid)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace diabolo
