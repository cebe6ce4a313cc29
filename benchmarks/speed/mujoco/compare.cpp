// SPDX-License-Identifier: MIT
// The compiled loops behind compare.py, which explains them.
//
//   compare reference MOTION STEPS             positions of the reference; slack time, snap speed, drift
//   compare diabolo MOTION STEPS               positions of the library
//   compare mujoco MOTION STEPS MODEL          positions of MuJoCo
//   compare time MOTION STEPS MUJOCO_STEPS MODEL REPEATS    seconds per second of motion of both, in turns
//   compare repeat SIMULATOR MOTION STEPS TIMES [MODEL]     runs only, for an instruction counter

#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "reference.hpp"
#include "simulators.hpp"

namespace diabolo {
namespace {

void print(const Vector3<double>& position) {
  std::printf("%.17g %.17g %.17g\n", position.x(), position.y(), position.z());
}

template <class Simulator>
void print_positions(Simulator&& simulator) {
  simulator.reset();
  const int part = simulator.steps() / kChecks;
  for (int i = 0; i < kChecks; ++i) {
    simulator.run(i * part, (i + 1) * part);
    print(simulator.position());
  }
}

void print_reference(const Motion& motion, int steps, double gravity) {
  Reference reference(motion, motion.initial_state(), gravity);
  for (int i = 1; i <= steps; ++i) {
    reference.step(kDuration / steps);
    if (i % (steps / kChecks) == 0) print(reference.position());
  }
  std::printf("%.17g %.17g %.17g\n", reference.slack_time(), reference.snap_speed(), reference.drift());
}

/// Seconds that a run over the whole motion takes, over enough runs to make `kShortest`.
template <class Simulator>
double run_time(Simulator& simulator) {
  constexpr double kShortest = 0.02;  // [s]
  using Clock = std::chrono::steady_clock;
  double spent = 0.0;
  int runs = 0;
  while (spent < kShortest) {
    simulator.reset();
    const Clock::time_point begin = Clock::now();
    simulator.run(0, simulator.steps());
    spent += std::chrono::duration<double>(Clock::now() - begin).count();
    ++runs;
  }
  return spent / runs;
}

template <class Simulator>
void repeat(Simulator&& simulator, int times) {
  for (int i = 0; i < times; ++i) {
    simulator.reset();
    simulator.run(0, simulator.steps());
  }
}

/// A positive multiple of kChecks.
int steps_of(const std::string& text) {
  const int steps = std::stoi(text);
  if (steps <= 0 || steps % kChecks != 0)
    throw std::invalid_argument(text + " steps: must be a positive multiple of " + std::to_string(kChecks));
  return steps;
}

void run(const std::vector<std::string>& words) {
  Parameters<double> parameters = Parameters<double>::consistent();
  parameters.string_length = kStringLength;
  const std::string& command = words.at(0);
  if (command == "repeat") {
    const Motion motion = motion_of_name(words.at(2));
    const int steps = steps_of(words.at(3)), times = std::stoi(words.at(4));
    if (words.at(1) == "diabolo") return repeat(OurSimulator(motion, steps, parameters), times);
    return repeat(MujocoSimulator(motion, steps, words.at(5)), times);
  }
  const Motion motion = motion_of_name(words.at(1));
  const int steps = steps_of(words.at(2));
  if (command == "reference") {
    print_reference(motion, steps, parameters.gravity);
  } else if (command == "diabolo") {
    print_positions(OurSimulator(motion, steps, parameters));
  } else if (command == "mujoco") {
    print_positions(MujocoSimulator(motion, steps, words.at(3)));
  } else if (command == "time") {
    OurSimulator ours(motion, steps, parameters);
    MujocoSimulator theirs(motion, steps_of(words.at(3)), words.at(4));
    for (int i = std::stoi(words.at(5)); i > 0; --i)
      std::printf("%.9g %.9g\n", run_time(ours), run_time(theirs));
  } else {
    throw std::invalid_argument("unknown command '" + command + "'");
  }
}

}  // namespace
}  // namespace diabolo

int main(int argc, char** argv) {
  try {
    diabolo::run({argv + 1, argv + argc});
  } catch (const std::out_of_range&) {
    std::cerr << "compare: an argument is missing\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "compare: " << error.what() << '\n';
    return 2;
  }
}
