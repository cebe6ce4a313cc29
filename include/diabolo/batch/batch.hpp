// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/batch/lanes.hpp"
#include "diabolo/math/parallel.hpp"
#include "diabolo/rollout.hpp"

namespace diabolo {

/// Many rollouts that differ in their initial states and, if wanted, in parameters, effects and tip motions.
struct Batch {
  std::vector<State<double>> initial;              ///< n
  std::vector<Parameters<double>> parameters;      ///< 1 or n
  std::vector<AllEffects<double>> effects = {{}};  ///< 1 or n
  std::vector<const TipMotion<double>*> motions;   ///< 1 or n
  Steps steps;
  std::size_t record_every = 0;  ///< a record after each so many steps; 0: final states only
  bool forces = false;           ///< whether the records have the string's forces on the tips, too
  bool axles = false;            ///< whether they have the axle and the string's turns, too

  std::size_t records() const { return record_every == 0 ? 0 : steps.count / record_every; }

  /// Of rollout number `i`.
  const Parameters<double>& parameters_of(std::size_t i) const { return shared_or_own(parameters, i); }
  const AllEffects<double>& effects_of(std::size_t i) const { return shared_or_own(effects, i); }

  /// Throws std::invalid_argument when a size is neither 1 nor n, a tip motion is missing, a state is not
  /// finite, or a Predictor would refuse its parameters and effects.
  void validate() const {
    const auto check = [&](std::size_t size, const char* what) {
      if (size != 1 && size != initial.size())
        throw std::invalid_argument(std::string("batch: ") + std::to_string(size) + " " + what + " for " +
                                    std::to_string(initial.size()) + " initial states; must be 1 or as many");
    };
    check(parameters.size(), "parameter sets");
    check(effects.size(), "effect sets");
    check(motions.size(), "tip motions");
    steps.validate();
    for (const TipMotion<double>* motion : motions)
      if (!motion) throw std::invalid_argument("batch: a tip motion is a null pointer");
    for (const State<double>& s : initial) {
      if (!is_finite(s)) throw std::invalid_argument("batch: an initial state is not finite");
      if (std::abs(s.turns) > kMostTurns)
        throw std::invalid_argument("batch: an initial state has " + std::to_string(s.turns) +
                                    " turns of the string; expected -10 to 10");
    }
    const std::size_t models = initial.empty() ? 0 : std::max(parameters.size(), effects.size());
    for (std::size_t i = 0; i < models; ++i) {
      parameters_of(i).validate();
      effects_of(i).validate();
      if (!same_texts(effects_of(0), effects_of(i)))
        throw std::invalid_argument("batch: effect set " + std::to_string(i) +
                                    " has other laws by formulas or another residual than the first; must be "
                                    "the same");
    }
  }

 private:
  template <class T>
  static const T& shared_or_own(const std::vector<T>& values, std::size_t i) {
    return values[values.size() == 1 ? 0 : i];
  }
};

/// What a batch gives: final states, and records of 7 numbers (position [m], velocity [m/s], spin [rad/s]).
struct BatchResult {
  std::vector<State<double>> final_states;  ///< n
  std::vector<double> records;              ///< n x records x 7
  std::vector<StringState> record_states;   ///< n x records
  std::vector<double> forces;  ///< n x records x 6: on the left and the right tip in a record's last step [N]
  std::vector<double> axles;   ///< n x records x 7: axis, tumble [rad/s], turns, as in State
};

/// The kernel that any processor runs; `batch/kernels.hpp` has faster ones. A template, so that only
/// who calls it compiles it.
template <int Lanes = 2>
BatchKernel portable_batch_kernel() {
  return {Lanes, &run_lanes<Pack<double, Lanes>>, "portable"};
}

namespace batch_detail {

/// Rollouts [first, last) of a batch, one after the other in groups of the kernel's lanes.
class BatchWorker {
 public:
  BatchWorker(const Batch& batch, const BatchKernel& kernel, BatchResult& result)
      : batch_(batch), kernel_(kernel), result_(result) {}

  /// Returns early once `cancel` is set.
  void run(std::size_t first, std::size_t last, const std::atomic<bool>& cancel) {
    const std::size_t lanes = static_cast<std::size_t>(kernel_.lanes);
    const bool shared = batch_.motions.size() == 1;
    for (std::size_t done = 0; done < batch_.steps.count && !cancel; done += kChunk) {
      const std::size_t steps = std::min(kChunk, batch_.steps.count - done);
      if (shared) sample(0, *batch_.motions[0], done, steps);
      for (std::size_t i = first; i < last && !cancel;) {
        std::size_t used = 1;
        while (used < lanes && i + used < last &&
               batch_.parameters_of(i + used).same_rules(batch_.parameters_of(i)))
          ++used;
        if (!shared)
          for (std::size_t lane = 0; lane < used; ++lane)
            sample(lane, *batch_.motions[i + lane], done, steps);
        run_group(i, used, done, steps);
        i += used;
      }
    }
  }

 private:
  static constexpr std::size_t kChunk = 256;

  void sample(std::size_t lane, const TipMotion<double>& motion, std::size_t done, std::size_t steps) {
    std::vector<Tips<double>>& tips = tips_[lane];
    tips.resize(kChunk + 1);
    for (std::size_t k = 0; k <= steps; ++k) tips[k] = motion.at(batch_.steps.time(done + k), hints_[lane]);
  }

  void run_group(std::size_t first, std::size_t used, std::size_t done, std::size_t steps) {
    State<double> spare[kMostLanes];
    std::vector<double>& records = spare_records_;
    std::vector<StringState>& record_states = spare_record_states_;
    records.resize(7 * batch_.records());
    if (batch_.forces) spare_forces_.resize(6 * batch_.records());
    if (batch_.axles) spare_axles_.resize(7 * batch_.records());
    record_states.resize(batch_.records());
    LaneBlock block{};
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(kernel_.lanes); ++lane) {
      const std::size_t i = first + std::min(lane, used - 1);
      const bool real = lane < used;
      spare[lane] = result_.final_states[i];
      block.parameters[lane] = &batch_.parameters_of(i);
      block.effects[lane] = &batch_.effects_of(i);
      block.states[lane] = real ? &result_.final_states[i] : &spare[lane];
      block.tips[lane] = tips_[batch_.motions.size() == 1 ? 0 : std::min(lane, used - 1)].data();
      block.records[lane] = real ? result_.records.data() + 7 * batch_.records() * i : records.data();
      if (batch_.forces)
        block.forces[lane] = real ? result_.forces.data() + 6 * batch_.records() * i : spare_forces_.data();
      if (batch_.axles)
        block.axles[lane] = real ? result_.axles.data() + 7 * batch_.records() * i : spare_axles_.data();
      block.record_states[lane] =
          real ? result_.record_states.data() + batch_.records() * i : record_states.data();
    }
    block.shared_tips = batch_.motions.size() == 1;
    block.dt = batch_.steps.dt;
    block.steps = steps;
    block.first_step = done;
    block.record_every = batch_.record_every;
    kernel_.run(block);
  }

  const Batch& batch_;
  const BatchKernel& kernel_;
  BatchResult& result_;
  std::array<std::vector<Tips<double>>, kMostLanes> tips_;
  std::array<std::size_t, kMostLanes> hints_{};
  std::vector<double> spare_records_, spare_forces_, spare_axles_;
  std::vector<StringState> spare_record_states_;
};

}  // namespace batch_detail

/// Runs a batch with a kernel on some threads (0: one for every processor). A rollout's result depends
/// neither on the number of threads nor on its neighbours. Once `cancel` is set it returns within some
/// milliseconds, its result being void.
inline BatchResult rollout_batch(const Batch& batch, const BatchKernel& kernel, int threads,
                                 const std::atomic<bool>& cancel) {
  check_threads(threads);
  batch.validate();
  const std::size_t n = batch.initial.size();
  BatchResult result{batch.initial, std::vector<double>(n * batch.records() * 7),
                     std::vector<StringState>(n * batch.records()),
                     std::vector<double>(batch.forces ? n * batch.records() * 6 : 0),
                     std::vector<double>(batch.axles ? n * batch.records() * 7 : 0)};
  // One share for each thread, of whole groups, since a worker reads shared tip motions anew.
  const auto parts = [](std::size_t whole, std::size_t part) { return (whole + part - 1) / part; };
  const std::size_t lanes = static_cast<std::size_t>(kernel.lanes);
  const std::size_t share = std::max<std::size_t>(1, parts(parts(n, lanes), thread_count(threads))) * lanes;
  for_each_index(parts(n, share), threads, {}, [&](std::size_t i) {
    batch_detail::BatchWorker(batch, kernel, result).run(i * share, std::min((i + 1) * share, n), cancel);
  });
  return result;
}

}  // namespace diabolo
