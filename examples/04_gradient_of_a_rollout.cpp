// SPDX-License-Identifier: MIT
// 4. Gradient of a rollout: ask which way the start would have to change for a prediction to come true.
//
// The prediction of half a second from step 3 misses the recorded diabolo. The same predictor, run on dual
// numbers, carries the derivatives of its end with respect to the start's velocity and to the string's
// length; Gauss and Newton's method finds the smallest change that brings the end where it was measured.

#include <Eigen/QR>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <vector>

#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/json/recording_file.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/rollout.hpp"

namespace {

using Dual = diabolo::Dual<double, 4>;  // a number and its derivatives by three velocities and a length
using Vector = diabolo::Vector3<Dual>;
constexpr Eigen::Index kStart = 300, kEnd = 360;  // rows of the recording, half a second apart

/// The end of the prediction, with derivatives.
Vector end_of(const diabolo::Recording& recording, const diabolo::State<double>& start,
              const diabolo::TipMotion<Dual>& motion, const Eigen::Vector4d& inputs) {
  diabolo::Parameters<Dual> parameters;
  parameters.string_length = Dual::variable(inputs[3], 3);
  parameters.mass = recording.properties.mass;
  diabolo::State<Dual> state;
  state.position = start.position.cast<Dual>();
  for (int k = 0; k < 3; ++k) state.velocity[k] = Dual::variable(inputs[k], k);
  state.spin = start.spin;
  state.string_state = start.string_state;
  const double begin = recording.time[kStart] - recording.time[0];
  const double duration = recording.time[kEnd] - recording.time[kStart];
  const diabolo::Steps steps{
      .begin = begin, .dt = 1e-3, .count = static_cast<std::size_t>(std::lround(duration / 1e-3))};
  return rollout(diabolo::Predictor<Dual>(parameters), state, motion, steps).position;
}

/// The recorded tips as a motion of dual numbers.
diabolo::TipMotion<Dual> tips_of(const diabolo::Recording& recording) {
  std::vector<double> times;
  std::vector<Vector> left, right;
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    if (!recording.left.valid[i] || !recording.right.valid[i]) continue;
    times.push_back(recording.time[i] - recording.time[0]);
    left.push_back(recording.left.position.col(i).cast<Dual>());
    right.push_back(recording.right.position.col(i).cast<Dual>());
  }
  return {times, left, right, diabolo::Interpolation::kSpline};
}

}  // namespace

int main(int argc, char** argv) try {
  const std::filesystem::path here = std::filesystem::path(__FILE__).parent_path();
  const std::filesystem::path path = argc > 1 ? argv[1] : here.parent_path() / "data/recordings/swing.csv";
  const diabolo::Recording recording = diabolo::load_recording(path);
  const diabolo::TipMotion<Dual> motion = tips_of(recording);
  const diabolo::StartStates starts(recording, true);
  const diabolo::State<double> start = starts.at(diabolo::Start::kFair, kStart);
  const Eigen::Vector3d target = recording.diabolo.position.col(kEnd);

  Eigen::Vector4d inputs(start.velocity.x(), start.velocity.y(), start.velocity.z(), recording.string_length);
  const Eigen::Vector4d measured = inputs;
  for (int iteration = 0; iteration < 5; ++iteration) {
    const Vector end = end_of(recording, start, motion, inputs);
    Eigen::Vector3d miss;
    Eigen::Matrix<double, 3, 4> derivative;
    for (int k = 0; k < 3; ++k) {
      miss[k] = target[k] - end[k].value;
      derivative.row(k) = end[k].gradient;
    }
    std::printf("iteration %d: the end is off by %8.3f mm\n", iteration, 1000.0 * miss.norm());
    // Four unknowns for three numbers: of all solutions the smallest change, 1 m/s counting like 1 m.
    inputs += derivative.completeOrthogonalDecomposition().solve(miss);
  }
  const Eigen::Vector4d change = inputs - measured;
  std::printf("velocity of the start changed by (%.3f, %.3f, %.3f) m/s, string length by %.1f mm\n",
              change[0], change[1], change[2], 1000.0 * change[3]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
