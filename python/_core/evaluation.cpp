// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/evaluation.hpp"
#include "diabolo/evaluate/predict.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupt.hpp"
#include "state.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

Start start_from_python(const std::string& start) {
  if (start == "fair") return Start::kFair;
  if (start == "published") return Start::kPublished;
  throw std::invalid_argument("start: '" + start + "'; expected 'fair' or 'published'");
}

/// What `work(watch)` gives. Ctrl-C ends it.
template <class Work>
auto watched(const Work& work) {
  decltype(work(Watch{})) result;
  run_interruptibly([&](const std::atomic<bool>& cancel) {
    result = work(Watch{.progress = {}, .cancelled = [&] { return cancel.load(); }});
  });
  return result;
}

/// States, string states, forces on the tips, and axis, tumble and turns at each row; before the start NaN,
/// and as at the start.
py::tuple predicted_rows(const Recording& recording, const Model& model,
                         std::optional<Eigen::Index> start_row, const std::string& start) {
  const Start rule = start_from_python(start);
  const Prediction predicted =
      watched([&](const Watch& watch) { return predict(recording, model, rule, start_row, watch); });
  Array states({recording.size(), Eigen::Index{7}});
  Array forces({recording.size(), Eigen::Index{2}, Eigen::Index{3}});
  Array axles({recording.size(), Eigen::Index{7}});
  py::array_t<std::uint8_t> codes(recording.size());
  std::fill_n(states.mutable_data(), states.size(), kNaN);
  std::fill_n(forces.mutable_data(), forces.size(), kNaN);
  std::fill_n(axles.mutable_data(), axles.size(), kNaN);
  std::fill_n(codes.mutable_data(), codes.size(),
              static_cast<std::uint8_t>(predicted.states.front().string_state));
  Eigen::Index row = predicted.first;
  for (const State<double>& state : predicted.states) {
    double* to = std::copy_n(state.position.data(), 3, states.mutable_data(row, 0));
    to = std::copy_n(state.velocity.data(), 3, to);
    *to = state.spin;
    const TipForces<double>& on_tips = predicted.forces[static_cast<std::size_t>(row - predicted.first)];
    double* force = std::copy_n(on_tips.left.data(), 3, forces.mutable_data(row, 0, 0));
    std::copy_n(on_tips.right.data(), 3, force);
    double* axle = std::copy_n(state.axis.data(), 3, axles.mutable_data(row, 0));
    axle = std::copy_n(state.tumble.data(), 3, axle);
    *axle = state.turns;
    codes.mutable_at(row++) = static_cast<std::uint8_t>(state.string_state);
  }
  return py::make_tuple(states, codes, forces, axles);
}

std::vector<HorizonScore> horizons(const std::vector<Recording>& recordings, const Model& model,
                                   const HorizonOptions& options, const py::object& progress) {
  std::vector<const Recording*> pointers;
  for (const Recording& recording : recordings) pointers.push_back(&recording);
  std::vector<HorizonScore> scores;
  std::atomic<double> done = 0.0;
  run_interruptibly(
      [&](const std::atomic<bool>& cancel) {
        const Watch watch{.progress = [&](double fraction) { done = fraction; },
                          .cancelled = [&] { return cancel.load(); }};
        scores = score_horizons(pointers, model, options, watch);
      },
      [&] {
        if (!progress.is_none()) progress(done.load());
      });
  return scores;
}

void bind_scores(py::module_& module) {
  py::class_<ExcerptScore>(module, "ExcerptScore",
                           "Position error of one rollout over a recording, as the paper's table counts it.")
      .def_readonly("recording", &ExcerptScore::recording, "Name of the take.")
      .def_readonly("motion", &ExcerptScore::motion,
                    "As the paper calls it; empty where it has no such excerpt.")
      .def_readonly("model", &ExcerptScore::model, "Name.")
      .def_readonly("rows", &ExcerptScore::rows, "Of the excerpt.")
      .def_readonly("start_row", &ExcerptScore::start_row, "0 unless the diabolo or a tip is missing there.")
      .def_readonly("scored", &ExcerptScore::scored, "Rows compared.")
      .def_readonly("skipped", &ExcerptScore::skipped,
                    "Rows after the start whose diabolo, or the one before, is missing.")
      .def_readonly("duration", &ExcerptScore::duration, "From the start to the last row compared [s].")
      .def_readonly("error", &ExcerptScore::error,
                    "Mean distance to the recorded diabolo [m]; None where the prediction diverged.")
      .def_readonly("diverged", &ExcerptScore::diverged, "When the prediction left the world [s], or None.")
      .def_readonly("baseline_error", &ExcerptScore::baseline_error, "Of the lowest-point baseline [m].")
      .def_readonly("paper_error", &ExcerptScore::paper_error, "As the paper prints it [m], or None.")
      .def_readonly("program_error", &ExcerptScore::program_error,
                    "Of the authors' program, run again [m], or None.");

  py::class_<Interval>(module, "Interval", "From low to high.")
      .def_readonly("low", &Interval::low)
      .def_readonly("high", &Interval::high)
      .def("__repr__", [](const Interval& i) { return py::str("[{:.4g}, {:.4g}]").format(i.low, i.high); });

  py::class_<ErrorSummary>(module, "ErrorSummary", "What a set of position errors looks like.")
      .def_readonly("windows", &ErrorSummary::windows, "How many errors.")
      .def_readonly("mean", &ErrorSummary::mean, "[m]")
      .def_readonly("median", &ErrorSummary::median, "[m]")
      .def_readonly("percentile_90", &ErrorSummary::percentile_90, "[m]")
      .def_readonly("mean_ci95", &ErrorSummary::mean_ci95,
                    "Block-bootstrap interval of the mean [m]; None where the errors are too few to tell.");

  py::class_<HorizonScore>(module, "HorizonScore", "Position errors at one horizon, over all starts.")
      .def_readonly("horizon", &HorizonScore::horizon, "After the start [s].")
      .def_readonly("windows", &HorizonScore::windows, "Starts that could be compared.")
      .def_readonly("failed", &HorizonScore::failed, "Of these: the prediction diverged; not in `model`.")
      .def_readonly("missed_catches", &HorizonScore::missed_catches,
                    "Of these: predicted in flight below the tips, so never caught.")
      .def_readonly("model", &HorizonScore::model, "ErrorSummary, or None where nothing could be compared.")
      .def_readonly("baseline", &HorizonScore::baseline, "Of the lowest-point baseline, over all windows.")
      .def_readonly("advantage", &HorizonScore::advantage,
                    "How much smaller the model's error is than the baseline's in the same window, mean [m].")
      .def_readonly("advantage_ci95", &HorizonScore::advantage_ci95);
}

}  // namespace

void bind_evaluation(py::module_& module) {
  bind_scores(module);
  module.def(
      "score_excerpt",
      [](const Recording& recording, const Model& model) {
        return watched([&](const Watch& watch) { return score_excerpt(recording, model, watch); });
      },
      "recording"_a, "model"_a, "See diabolo.evaluate.");
  module.def(
      "score_excerpts",
      [](const Recording& recording, const Model& model) {
        return watched([&](const Watch& watch) { return score_excerpts(recording, model, watch); });
      },
      "recording"_a, "model"_a, "See diabolo.evaluate.");
  module.def(
      "score_horizons",
      [](const std::vector<Recording>& recordings, const Model& model, double starts_every,
         const std::vector<double>& at, const std::string& start, std::uint64_t seed, int threads,
         const py::object& progress) {
        return horizons(recordings, model,
                        {.starts_every = starts_every,
                         .horizons = at,
                         .start = start_from_python(start),
                         .seed = seed,
                         .threads = threads},
                        progress);
      },
      "recordings"_a, "model"_a, "starts_every"_a, "horizons"_a, "start"_a, "seed"_a, "threads"_a,
      "progress"_a, "See diabolo.evaluate.");
  module.def("model_for", &model_for, "model"_a, "recording"_a, "See diabolo.model_for.");
  module.def("predict", &predicted_rows, "recording"_a, "model"_a, "row"_a, "start"_a,
             "See diabolo.predict.");
  module.def(
      "start_state",
      [](const Recording& recording, Eigen::Index row, const std::string& start, bool signed_spin) {
        return start_state(recording, StartStates(recording, signed_spin), start_from_python(start), row);
      },
      "recording"_a, "row"_a, "start"_a = "fair", "signed_spin"_a = true,
      "State at a row of a recording: 'fair', from the rows up to it, or 'published', by the rules of the "
      "authors' program.");
  module.def(
      "baseline",
      [](const Recording& recording) {
        const Track track = baseline_track(recording);
        Array array({track.position.cols(), Eigen::Index{3}});
        std::copy_n(track.position.data(), array.size(), array.mutable_data());
        return array;
      },
      "recording"_a, "The lowest points of the spheroid [m], shape (N, 3): what every model has to beat.");
}

}  // namespace diabolo::python
