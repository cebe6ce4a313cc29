// SPDX-License-Identifier: MIT
// Kinematics of the arm beside Orocos KDL's, in one run: divide by `kdl_forward`.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <diabolo/robot/arm/build_seed_grid.hpp>
#include <diabolo/robot/arm/inverse_near.hpp>
#include <diabolo/robot/arm/stick_map.hpp>

#include "support/job.hpp"

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

constexpr double kDrawn = 1024;

/// `work(input)` for each of the drawn inputs.
template <class Input, class Work>
std::unique_ptr<Job> each(std::vector<Input> inputs, Work work, std::map<std::string, double> figures = {}) {
  return std::make_unique<Calls>(
      kDrawn,
      [inputs = std::move(inputs), work = std::move(work)]() mutable {
        for (const Input& input : inputs) work(input);
      },
      std::move(figures));
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

std::unique_ptr<Job> kdl_forward() {
  const auto chain = std::make_shared<const KDL::Chain>(kdl_arm());  // solvers hold a reference
  const auto solver = std::make_shared<KDL::ChainFkSolverPos_recursive>(*chain);
  return each(kdl_joints(), [chain, solver](const KDL::JntArray& q) {
    KDL::Frame flange;
    solver->JntToCart(q, flange);
    benchmark::DoNotOptimize(flange);
  });
}

std::unique_ptr<Job> forward() {
  return each(drawn(), [chain = ur5e_nominal<double>()](const Joints<double>& q) {
    benchmark::DoNotOptimize(chain.forward(q));
  });
}

std::unique_ptr<Job> kdl_jacobian() {
  const auto chain = std::make_shared<const KDL::Chain>(kdl_arm());
  const auto solver = std::make_shared<KDL::ChainJntToJacSolver>(*chain);
  return each(kdl_joints(), [chain, solver, jacobian = KDL::Jacobian(6)](const KDL::JntArray& q) mutable {
    solver->JntToJac(q, jacobian);
    benchmark::DoNotOptimize(jacobian.data.data());
  });
}

std::unique_ptr<Job> jacobian() {
  return each(drawn(), [chain = ur5e_nominal<double>()](const Joints<double>& q) {
    benchmark::DoNotOptimize(chain.jacobian(q, kTip));
  });
}

std::unique_ptr<Job> inverse_all_8() {
  const Chain<double> chain = ur5e_nominal<double>();
  std::vector<Pose<double>> flanges;
  for (const Joints<double>& q : drawn()) flanges.push_back(chain.forward(q));
  return each(flanges, [](const Pose<double>& flange) { benchmark::DoNotOptimize(inverse(flange)); });
}

/// An arm that is off by 1 mm and 1 mrad in every link.
Chain<double> calibrated_chain() {
  Ur5eCalibration calibration = nominal_calibration();
  for (LinkCalibration& link : calibration) {
    link.y += 1e-3;
    link.roll += 1e-3;
  }
  return ur5e_from_calibration<double>(calibration);
}

std::unique_ptr<Job> inverse_of_a_calibrated_arm() {
  const Chain<double> chain = calibrated_chain();
  std::vector<std::pair<Pose<double>, Joints<double>>> inputs;
  for (const Joints<double>& q : drawn()) inputs.emplace_back(chain.forward(q), q);
  return each(inputs, [chain](const auto& input) {
    benchmark::DoNotOptimize(inverse_near(chain, input.first, input.second));
  });
}

std::unique_ptr<Job> stick_task_in_closed_form() {
  const Chain<double> chain = ur5e_nominal<double>();
  std::vector<std::pair<Vector3<double>, Joints<double>>> inputs;
  for (const Joints<double>& q : drawn()) inputs.emplace_back(chain.forward(q) * kTip, q);
  return each(inputs, [](const auto& input) {
    benchmark::DoNotOptimize(stick_inverse<double>(input.first, kTip, posture_of(input.second)));
  });
}

/// Looking up the seed and solving, nominal arm or calibrated; `p99_us` and `worst_us` of single calls.
std::unique_ptr<Job> seed_grid_look_up(bool calibrated, bool counted) {
  StickArm arm = paper_arm(Side::kRight);
  if (calibrated) arm.chain = calibrated_chain();
  const auto map = std::make_shared<const StickMap>(arm, build_seed_grid(arm, paper_box(arm)));
  const GridBox& box = map->grid().box();
  std::vector<Vector3<double>> points;
  for (const Joints<double>& q : drawn()) {
    const Vector3<double> share = (q.head<3>().array() / (2.0 * kPi) + 0.5).matrix();
    points.emplace_back(box.lower + Vector3<double>(share.cwiseProduct(box.upper - box.lower)));
  }
  std::vector<double> times(counted ? 1 : 100000);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(map->at(points[i % points.size()]));
    times[i] = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }
  std::ranges::sort(times);
  return each(points, [map](const Vector3<double>& point) { benchmark::DoNotOptimize(map->at(point)); },
              {{"p99_us", times[times.size() * 99 / 100]}, {"worst_us", times.back()}});
}

std::unique_ptr<Job> build_a_seed_grid() {
  return std::make_unique<Calls>(1.0, [arm = paper_arm(Side::kRight)] {
    benchmark::DoNotOptimize(build_seed_grid(arm, paper_box(arm)));
  });
}

}  // namespace
}  // namespace diabolo

int main(int argc, char** argv) {
  using namespace diabolo;
  const bool counted = argc > 1 && std::string_view(argv[1]) == "--count";
  return run_jobs({{"kdl_forward", kdl_forward},
                   {"forward", forward},
                   {"kdl_jacobian", kdl_jacobian},
                   {"jacobian", jacobian},
                   {"inverse_all_8", inverse_all_8},
                   {"inverse_of_a_calibrated_arm", inverse_of_a_calibrated_arm},
                   {"stick_task_in_closed_form", stick_task_in_closed_form},
                   {"seed_grid_look_up/nominal", [=] { return seed_grid_look_up(false, counted); }},
                   {"seed_grid_look_up/calibrated", [=] { return seed_grid_look_up(true, counted); }},
                   {"build_a_seed_grid", build_a_seed_grid}},
                  argc, argv);
}
