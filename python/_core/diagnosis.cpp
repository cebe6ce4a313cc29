// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/compiled.hpp"

#include <pybind11/stl.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/posterior.hpp"
#include "diabolo/diagnose/result_of.hpp"
#include "diabolo/diagnose/simulator.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupt.hpp"
#include "state.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

using namespace py::literals;

using AnyState = std::vector<State<double>>;

/// Runs `work(watch)` while Ctrl-C and `progress` are served; fractions lie from `begin` to `end`.
template <class Work>
void run_watched(const py::object& progress, double begin, double end, const Work& work) {
  std::mutex mutex;
  std::pair<std::string, double> now{"", begin};
  run_interruptibly(
      [&](const std::atomic<bool>& cancel) {
        DiagnosisWatch watch;
        watch.cancelled = [&] { return cancel.load(); };
        watch.progress = [&](const std::string& step, double done) {
          const std::scoped_lock lock(mutex);
          now = {step, begin + (end - begin) * done};
        };
        work(watch);
      },
      [&] {
        if (progress.is_none()) return;
        std::pair<std::string, double> seen;
        {
          const std::scoped_lock lock(mutex);
          seen = now;
        }
        progress(seen.first, seen.second);
      });
}

DiagnosisOptions options_of(const std::vector<Recording>& recordings, const Model& base,
                            const std::vector<Recording>& holdout, const std::vector<std::string>& bank,
                            const FormulaLaws<double>& laws, double budget, std::uint64_t seed, int threads) {
  for (const Recording& recording : recordings) check_recording(recording);
  for (const Recording& recording : holdout) check_recording(recording);
  return {.base = base,
          .holdout = holdout,
          .bank = bank,
          .laws = laws.laws ? *laws.laws : std::vector<Law>{},
          .budget = budget,
          .seed = seed,
          .threads = threads};
}

std::vector<std::string> unused_of(const DiagnosisOptions& options) {
  std::vector<std::string> unused;
  for (const Recording& recording : options.holdout)
    if (comparable_windows(recording, options.base) == 0) unused.push_back(recording.name);
  return unused;
}

/// What is said, the model with what was found, and `draws` others that would do as well.
py::tuple diagnose(const std::vector<Recording>& recordings, const Model& base,
                   const std::vector<Recording>& holdout, const std::vector<std::string>& bank,
                   const FormulaLaws<double>& laws, double budget, std::uint64_t seed, int threads,
                   const py::object& progress, std::size_t draws) {
  const DiagnosisOptions options = options_of(recordings, base, holdout, bank, laws, budget, seed, threads);
  std::vector<std::string> unused;
  Diagnosis result;
  run_watched(progress, 0.0, 1.0, [&](const DiagnosisWatch& watch) {
    unused = unused_of(options);
    result = diabolo::diagnose(recordings, options, watch);
  });
  return py::make_tuple(result_of(result, recordings, std::move(unused)), result.model,
                        draws > 0 ? Posterior(result).draw(draws, seed) : std::vector<Model>());
}

/// `rows`, shape (N, 3) or (N, 7), positions [m] or states; NaN where the spin is not known, and of the axle.
AnyState to_states(const Array& rows) {
  const bool whole = rows.ndim() == 2 && rows.shape(1) == 7;
  if (!whole) expect_shape(rows, "simulate", {kAny, 3});
  AnyState states(static_cast<std::size_t>(rows.shape(0)));
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    const double* numbers = rows.data(i, 0);
    State<double>& state = states[static_cast<std::size_t>(i)];
    state.position = {numbers[0], numbers[1], numbers[2]};
    if (whole) state.velocity = {numbers[3], numbers[4], numbers[5]};
    state.spin = whole ? numbers[6] : kNaN;
    state.axis.setConstant(kNaN);
  }
  return states;
}

/// Asks a simulator of Python's.
Simulate simulate_by(const py::object& simulate) {
  return [simulate](const State<double>& start, const TipMotion<double>& tips, const Eigen::VectorXd& times) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const py::object given = simulate(state_array(start), std::make_shared<TipMotion<double>>(tips),
                                      Array(times.size(), times.data()));
    const Array rows = Array::ensure(given);
    if (!rows)
      throw std::invalid_argument("simulate: it gave " + std::string(py::str(py::type::of(given))) +
                                  "; expected an array of the shape (N, 7) or (N, 3), a row for each time");
    return to_states(rows);
  };
}

/// What is said, and the models of reality and of the simulator. Of `simulated` and `simulate` one is given.
py::tuple compare(const std::vector<Recording>& recordings, std::vector<Recording> simulated,
                  const py::object& simulate, const Model& base, const std::vector<Recording>& holdout,
                  const std::vector<std::string>& bank, const FormulaLaws<double>& laws, double budget,
                  std::uint64_t seed, int threads, const py::object& progress) {
  DiagnosisOptions options = options_of(recordings, base, holdout, bank, laws, budget, seed, threads);
  std::vector<std::string> unused;
  Diagnosis real, theirs;
  run_watched(progress, 0.0, 0.5, [&](const DiagnosisWatch& watch) {
    unused = unused_of(options);
    real = diabolo::diagnose(recordings, options, watch);
  });
  std::vector<TakeToPlay> takes;
  Played played;
  if (!simulate.is_none()) {
    takes = takes_to_play(real, holdout);
    played = play(takes, simulate_by(simulate));
    simulated = played_takes(takes, played);
    options.axle = knows_axle(played);
  }
  options.holdout.clear();
  SimulatorComparison result;
  run_watched(progress, 0.5, 1.0, [&](const DiagnosisWatch& watch) {
    for (const Recording& recording : simulated) check_recording(recording);
    theirs = simulated.empty() ? nothing_played() : diabolo::diagnose(simulated, options, watch);
    result = compare_simulator(real, theirs, result_of(real, recordings, std::move(unused)),
                               result_of(theirs, simulated), threads, {{}, watch.cancelled});
    if (!played.empty()) result.fit = simulator_errors(takes, played, theirs.model, seed);
  });
  return py::make_tuple(result, real.model, theirs.model);
}

}  // namespace

void bind_diagnosis(py::module_& module) {
  module.def(
      "stretch_starts",
      [](const Recording& recording) {
        check_recording(recording);
        py::list starts;
        for (const Stretch& stretch : stretches_of(recording))
          starts.append(py::make_tuple(stretch.first, state_array(stretch.start)));
        return starts;
      },
      "recording"_a, "Rows from which a simulator is asked to play, each with its state, shape (7,).");
  module.def("diagnose", &diagnose, "recordings"_a, "base"_a, "holdout"_a, "bank"_a, "laws"_a, "budget"_a,
             "seed"_a, "threads"_a, "progress"_a, "draws"_a, "See diabolo.diagnose.");
  module.def("compare_simulator", &compare, "recordings"_a, "simulated"_a, "simulate"_a, "base"_a,
             "holdout"_a, "bank"_a, "laws"_a, "budget"_a, "seed"_a, "threads"_a, "progress"_a,
             "See diabolo.compare_simulator.");
}

}  // namespace diabolo::python
