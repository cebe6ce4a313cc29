// SPDX-License-Identifier: MIT
// What a step costs in a batch: each kernel, one thread and two, one tip motion for all or one for each.

#include <stdexcept>

#include <diabolo/batch/batch.hpp>
#include <diabolo/batch/kernels.hpp>

#include "support/job.hpp"
#include "support/play.hpp"

namespace diabolo {
namespace {

constexpr std::size_t kRollouts = 256;

struct Setting {
  BatchKernel kernel;
  int threads = 1;
  bool own_tips = false;
  std::size_t steps = 1000;
  bool alike = false;  ///< all begin in the same state, so that the work of a step does not change with time

  std::string name() const {
    return std::string("batch/") + kernel.instruction_set + "/" + std::to_string(threads) +
           (threads == 1 ? " thread/" : " threads/") + (own_tips ? "own tips" : "shared tips") + "/" +
           std::to_string(steps) + " steps" + (alike ? "/alike" : "");
  }
};

/// Rollouts of the beat, which begin some tenths of a millimetre apart.
class BatchJob : public Job {
 public:
  explicit BatchJob(const Setting& setting) : setting_(setting) {
    Parameters<double> parameters = Parameters<double>::consistent();
    parameters.string_length = Play::kStringLength;
    const Play play = beat(1e-3 * static_cast<double>(setting.steps));
    for (std::size_t i = 0; i < (setting.own_tips ? kRollouts : 1); ++i)
      motions_.push_back(play.motion<double>());
    for (const TipMotion<double>& motion : motions_) batch_.motions.push_back(&motion);
    for (std::size_t i = 0; i < kRollouts; ++i)
      batch_.initial.push_back(play.start_of(setting.alike ? 0 : i));
    batch_.parameters = {parameters};
    batch_.steps = {0.0, Play::kStep, setting.steps};
  }

  double steps() const override { return static_cast<double>(kRollouts * setting_.steps); }
  void run() override { result_ = rollout_batch(batch_, setting_.kernel, setting_.threads, cancel_); }

  std::map<std::string, double> check() override {
    batch_.record_every = 1;
    run();
    batch_.record_every = 0;
    const auto on_string = std::ranges::count(result_.record_states, StringState::kOnString);
    const double share = static_cast<double>(on_string) / steps();
    result_ = {};  // its records are not to be given back while the clock runs
    if (share < 0.9)
      throw std::runtime_error("the diabolos are on the string for less than 90 % of the steps");
    return {{"on_string", share}};
  }

 private:
  Setting setting_;
  std::vector<TipMotion<double>> motions_;
  Batch batch_;
  BatchResult result_;
  std::atomic<bool> cancel_ = false;
};

}  // namespace
}  // namespace diabolo

int main(int argc, char** argv) {
  using namespace diabolo;
  std::vector<Setting> settings;
  std::vector<BatchKernel> kernels = batch_kernels();
  kernels.insert(kernels.begin(), portable_batch_kernel());
  for (const BatchKernel& kernel : kernels)
    for (const int threads : {1, 2})
      for (const bool own_tips : {false, true}) settings.push_back({kernel, threads, own_tips, 1000});
  for (const std::size_t steps : {1000, 2000, 4000})
    settings.push_back({best_batch_kernel(), 1, false, steps, true});

  std::vector<NamedJob> jobs;
  for (const Setting& setting : settings)
    jobs.push_back(
        {setting.name(), [setting] { return std::make_unique<BatchJob>(setting); }, setting.threads > 1});
  return run_jobs(jobs, argc, argv);
}
