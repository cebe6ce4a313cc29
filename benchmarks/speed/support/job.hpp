// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "heap.hpp"

namespace diabolo {

/// Something whose speed is measured, beginning from the same state at every run.
class Job {
 public:
  virtual ~Job() = default;
  virtual void run() = 0;
  /// How many a run takes: steps of a diabolo, or calls.
  virtual double steps() const = 0;
  /// Figures that say what was run, such as the share of the steps on the string. Throws std::runtime_error
  /// when it was not what the job's name says.
  virtual std::map<std::string, double> check() { return {}; }
};

/// Work on so many inputs, one after the other; `figures` say what was seen of it apart.
class Calls : public Job {
 public:
  Calls(double count, std::function<void()> work, std::map<std::string, double> figures = {})
      : count_(count), work_(std::move(work)), figures_(std::move(figures)) {}
  void run() override { work_(); }
  double steps() const override { return count_; }
  std::map<std::string, double> check() override { return figures_; }

 private:
  double count_;
  std::function<void()> work_;
  std::map<std::string, double> figures_;
};

/// Makes a job, which may take memory, only when its turn has come.
struct NamedJob {
  std::string name;
  std::function<std::unique_ptr<Job>()> make;
  bool threads = false;  ///< runs threads of its own, so that the processor's time is the whole process's
};

}  // namespace diabolo

/// callgrind counts what happens in here (run_all.py); not in the namespace, so that its name is plain.
extern "C" [[gnu::noinline]] inline void counted_run(diabolo::Job* job) { job->run(); }

namespace diabolo {

/// Without arguments of its own, Google Benchmark's program over the jobs. With `--count [FILTER]` each job
/// runs twice, the second time inside `counted_run`, and its name and steps are printed.
inline int run_jobs(const std::vector<NamedJob>& jobs, int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--count") {
    const std::regex filter(argc > 2 ? argv[2] : "");
    for (const NamedJob& named : jobs) {
      if (!std::regex_search(named.name, filter)) continue;
      const std::unique_ptr<Job> job = named.make();
      job->run();
      counted_run(job.get());
      std::printf("%s %.0f\n", named.name.c_str(), job->steps());
    }
    return 0;
  }
  for (const NamedJob& named : jobs) {
    benchmark::internal::Benchmark* timed =
        benchmark::RegisterBenchmark(named.name.c_str(), [named](benchmark::State& state) {
          const std::unique_ptr<Job> job = named.make();
          std::map<std::string, double> figures;
          try {
            figures = job->check();
          } catch (const std::exception& error) {
            state.SkipWithError(error.what());
            return;
          }
          long allocated = 0;
          for (auto _ : state) {
            const long before = allocations();
            job->run();
            allocated += allocations() - before;
          }
          for (const auto& [name, value] : figures) state.counters[name] = value;
          state.counters["steps"] = job->steps();
          state.counters["allocations"] = static_cast<double>(allocated);
          state.counters["M_steps/s"] =
              benchmark::Counter(1e-6 * job->steps(), benchmark::Counter::kIsIterationInvariantRate);
        });
    timed->Unit(benchmark::kMicrosecond);
    if (named.threads) timed->MeasureProcessCPUTime()->UseRealTime();
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace diabolo
