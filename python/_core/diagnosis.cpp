// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/compiled.hpp"

#include <pybind11/stl.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/result_of.hpp"
#include "diabolo/json/diagnosis_file.hpp"

#include "bindings.hpp"
#include "interrupt.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

using namespace py::literals;

/// What is said, and the model with what was found.
py::tuple diagnose(const std::vector<Recording>& recordings, const Model& base,
                   const std::vector<Recording>& holdout, const std::vector<std::string>& bank,
                   const FormulaLaws<double>& laws, double budget, std::uint64_t seed, int threads,
                   const py::object& progress) {
  for (const Recording& recording : recordings) check_recording(recording);
  for (const Recording& recording : holdout) check_recording(recording);
  const DiagnosisOptions options{.base = base,
                                 .holdout = holdout,
                                 .bank = bank,
                                 .laws = laws.laws ? *laws.laws : std::vector<Law>{},
                                 .budget = budget,
                                 .seed = seed,
                                 .threads = threads};
  std::vector<std::string> unused;
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
        for (const Recording& recording : holdout)
          if (comparable_windows(recording, base) == 0) unused.push_back(recording.name);
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
  return py::make_tuple(result_of(result, recordings, std::move(unused)), result.model);
}

}  // namespace

void bind_diagnosis(py::module_& module) {
  module.def("diagnose", &diagnose, "recordings"_a, "base"_a, "holdout"_a, "bank"_a, "laws"_a, "budget"_a,
             "seed"_a, "threads"_a, "progress"_a, "See diabolo.diagnose.");
}

}  // namespace diabolo::python
