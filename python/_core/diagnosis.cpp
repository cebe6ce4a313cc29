// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/compiled.hpp"

#include <pybind11/stl.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/json/diagnosis_file.hpp"

#include "bindings.hpp"
#include "interrupt.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

using namespace py::literals;

/// JSON text and the model with what was found.
py::tuple diagnose(const std::vector<Recording>& recordings, const Model& base,
                   const std::vector<Recording>& holdout, const std::vector<std::string>& bank, double budget,
                   std::uint64_t seed, int threads, const py::object& progress) {
  for (const Recording& recording : recordings) check_recording(recording);
  for (const Recording& recording : holdout) check_recording(recording);
  const DiagnosisOptions options{
      .base = base, .holdout = holdout, .bank = bank, .budget = budget, .seed = seed, .threads = threads};
  std::mutex mutex;
  std::pair<std::string, double> now{"", 0.0};
  Diagnosis result;
  run_interruptibly(
      [&](const std::atomic<bool>& cancel) {
        DiagnosisWatch watch;
        watch.cancelled = [&] { return cancel.load(); };
        watch.progress = [&](const std::string& step, double done) {
          const std::scoped_lock lock(mutex);
          now = {step, done};
        };
        result = diabolo::diagnose(recordings, options, watch);
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
  return py::make_tuple(json_text(diagnosis_to_json(result, recordings), "diagnosis"), result.model);
}

/// Starts from which a recording that is held out can be compared, as compare_held_out() would take them.
std::size_t comparable_windows(const Recording& recording, const Model& base) {
  check_recording(recording);
  HorizonOptions options;
  options.starts_every = 0.2;
  options.horizons = HeldOut{}.horizons;
  return HorizonTask(recording, base, options).size();
}

}  // namespace

void bind_diagnosis(py::module_& module) {
  module.def("diagnose", &diagnose, "recordings"_a, "base"_a, "holdout"_a, "bank"_a, "budget"_a, "seed"_a,
             "threads"_a, "progress"_a, "See diabolo.diagnose.");
  module.def("comparable_windows", &comparable_windows, "recording"_a, "base"_a, Unlocked(),
             "Starts from which a recording that is held out can be compared; see diabolo.diagnose.");
}

}  // namespace diabolo::python
