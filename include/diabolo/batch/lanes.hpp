// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "diabolo/full_predictor.hpp"
#include "diabolo/math/pack.hpp"
#include "diabolo/strand_tensions.hpp"

namespace diabolo {

/// Most rollouts that one kernel call takes.
inline constexpr int kMostLanes = 8;

/// Some steps of a few rollouts at once, as plain data between the batch and its kernels. Every pointer is to
/// one rollout's data; unused lanes repeat a used one.
struct LaneBlock {
  const Parameters<double>* parameters[kMostLanes];  ///< validated; rules equal in all lanes
  const AllEffects<double>* effects[kMostLanes];
  State<double>* states[kMostLanes];       ///< in and out
  const Tips<double>* tips[kMostLanes];    ///< steps + 1 poses each, or two; lanes may share them
  double* records[kMostLanes];             ///< 7 numbers a record: position, velocity, spin; null: none
  double* forces[kMostLanes];              ///< 6 numbers a record: on the left and the right tip; null: none
  double* axles[kMostLanes];               ///< 7 numbers a record: axis, tumble, turns; null: none
  StringState* record_states[kMostLanes];  ///< one a record
  bool shared_tips;                        ///< all lanes have the same tips
  double dt;                               ///< [s]
  double evenly;  ///< [s] that a block of two poses takes, see tips_between(); 0: all poses are given
  std::size_t steps;
  std::size_t first_step;    ///< number of steps done before this block
  std::size_t record_every;  ///< a record after each so many steps; 0: none
};

/// Advances a LaneBlock of the kernel's number of lanes.
struct BatchKernel {
  int lanes;
  void (*run)(const LaneBlock&);
  const char* instruction_set;
};

namespace batch_detail {

template <class Pack, class Get>
Pack gather(Get&& get) {
  Pack pack;
  for (int lane = 0; lane < ScalarTraits<Pack>::kLanes; ++lane) pack.set(lane, get(lane));
  return pack;
}

template <class Pack, class Get>
Vector3<Pack> gather3(Get&& get) {
  Vector3<Pack> v;
  for (int k = 0; k < 3; ++k) v[k] = gather<Pack>([&](int lane) { return get(lane)[k]; });
  return v;
}

/// Whether a pointer of each lane is the same in all.
template <class Pack, class T>
bool shared(const T* const (&of)[kMostLanes]) {
  return std::all_of(of, of + ScalarTraits<Pack>::kLanes, [&](const T* one) { return one == of[0]; });
}

/// Copies the numeric fields of a struct of doubles for each lane, `from(lane)`, into one of packs; in all
/// lanes the same where they share it.
template <class Pack, class From, class To>
void gather_fields(From&& from, bool share, To& to) {
  if (share) return copy_fields(from(0), to);
  for (int lane = 0; lane < ScalarTraits<Pack>::kLanes; ++lane)
    copy_fields(from(lane), to, [lane](auto& field, double value) { field.set(lane, value); });
}

template <class Pack>
Parameters<Pack> gather_parameters(const LaneBlock& block) {
  Parameters<Pack> packed;
  packed.copy_rules(*block.parameters[0]);
  gather_fields<Pack>(
      [&](int lane) -> const auto& { return *block.parameters[lane]; }, shared<Pack>(block.parameters),
      packed);
  return packed;
}

/// Whether no effect is at work in any lane.
template <class Pack>
bool neutral(const LaneBlock& block) {
  const auto at_rest = [](const AllEffects<double>* effects) { return effects->neutral(); };
  if (shared<Pack>(block.effects)) return at_rest(block.effects[0]);
  return std::all_of(block.effects, block.effects + ScalarTraits<Pack>::kLanes, at_rest);
}

template <class Pack>
AllEffects<Pack> gather_effects(const LaneBlock& block) {
  AllEffects<Pack> packed;
  packed.template get<FormulaLaws>().take_text(block.effects[0]->get<FormulaLaws>());
  packed.template get<ResidualForce>().take_text(block.effects[0]->get<ResidualForce>());
  const bool share = shared<Pack>(block.effects);
  const auto copy = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (gather_fields<Pack>(
         [&](int lane) -> const auto& { return std::get<I>(block.effects[lane]->members); }, share,
         std::get<I>(packed.members)),
     ...);
  };
  copy(std::make_index_sequence<std::tuple_size_v<decltype(packed.members)>>{});
  return packed;
}

template <class Pack>
void gather_tips(const LaneBlock& block, std::size_t i, Tips<Pack>& to) {
  const auto fill = [&](auto&& get) {
    to.time = get([](const Tips<double>& tips) { return tips.time; });
    for (int k = 0; k < 3; ++k) {
      to.left[k] = get([k](const Tips<double>& tips) { return tips.left[k]; });
      to.right[k] = get([k](const Tips<double>& tips) { return tips.right[k]; });
      to.left_velocity[k] = get([k](const Tips<double>& tips) { return tips.left_velocity[k]; });
      to.right_velocity[k] = get([k](const Tips<double>& tips) { return tips.right_velocity[k]; });
      to.left_direction[k] = get([k](const Tips<double>& tips) { return tips.left_direction[k]; });
      to.right_direction[k] = get([k](const Tips<double>& tips) { return tips.right_direction[k]; });
    }
  };
  if (block.shared_tips)
    fill([&](auto&& component) { return Pack(component(block.tips[0][i])); });
  else
    fill([&](auto&& component) {
      return gather<Pack>([&](int lane) { return component(block.tips[lane][i]); });
    });
}

/// The tips of a block, pose by pose.
template <class Pack>
class LaneTips {
 public:
  explicit LaneTips(const LaneBlock& block) : block_(block) {
    if (block.evenly == 0.0) return;
    gather_tips(block, 0, first_);
    gather_tips(block, 1, last_);
  }

  void read(std::size_t i, Tips<Pack>& to) const {
    if (block_.evenly == 0.0) return gather_tips(block_, i, to);
    const double share = static_cast<double>(i) / static_cast<double>(block_.steps);
    to = tips_between(first_, last_, share, block_.evenly);
  }

 private:
  const LaneBlock& block_;
  Tips<Pack> first_, last_;
};

template <class Pack>
State<Pack> gather_state(const LaneBlock& block) {
  State<Pack> state;
  state.position = gather3<Pack>([&](int l) -> const Vector3<double>& { return block.states[l]->position; });
  state.velocity = gather3<Pack>([&](int l) -> const Vector3<double>& { return block.states[l]->velocity; });
  state.string_acceleration =
      gather3<Pack>([&](int l) -> const Vector3<double>& { return block.states[l]->string_acceleration; });
  state.axis = gather3<Pack>([&](int l) -> const Vector3<double>& { return block.states[l]->axis; });
  state.tumble = gather3<Pack>([&](int l) -> const Vector3<double>& { return block.states[l]->tumble; });
  state.spin = gather<Pack>([&](int l) { return block.states[l]->spin; });
  state.turns = gather<Pack>([&](int l) { return block.states[l]->turns; });
  state.string_state.code =
      gather<Pack>([&](int l) { return static_cast<double>(block.states[l]->string_state); });
  return state;
}

template <class Pack>
void scatter_state(const State<Pack>& state, const LaneBlock& block) {
  for (int lane = 0; lane < ScalarTraits<Pack>::kLanes; ++lane) {
    State<double>& to = *block.states[lane];
    for (int k = 0; k < 3; ++k) {
      to.position[k] = state.position[k][lane];
      to.velocity[k] = state.velocity[k][lane];
      to.string_acceleration[k] = state.string_acceleration[k][lane];
      to.axis[k] = state.axis[k][lane];
      to.tumble[k] = state.tumble[k][lane];
    }
    to.spin = state.spin[lane];
    to.turns = state.turns[lane];
    to.string_state = static_cast<StringState>(static_cast<int>(state.string_state.code[lane]));
  }
}

template <class Pack>
void scatter_record(const State<Pack>& state, const LaneBlock& block, std::size_t index) {
  for (int lane = 0; lane < ScalarTraits<Pack>::kLanes; ++lane) {
    double* to = block.records[lane] + 7 * index;
    for (int k = 0; k < 3; ++k) {
      to[k] = state.position[k][lane];
      to[3 + k] = state.velocity[k][lane];
    }
    to[6] = state.spin[lane];
    block.record_states[lane][index] =
        static_cast<StringState>(static_cast<int>(state.string_state.code[lane]));
  }
}

template <class Pack>
void scatter_forces(const TipForces<Pack>& forces, const LaneBlock& block, std::size_t index) {
  for (int lane = 0; lane < ScalarTraits<Pack>::kLanes; ++lane)
    for (int k = 0; k < 3; ++k) {
      block.forces[lane][6 * index + static_cast<std::size_t>(k)] = forces.left[k][lane];
      block.forces[lane][6 * index + static_cast<std::size_t>(k) + 3] = forces.right[k][lane];
    }
}

template <class Pack>
void scatter_axle(const State<Pack>& state, const LaneBlock& block, std::size_t index) {
  for (int lane = 0; lane < ScalarTraits<Pack>::kLanes; ++lane) {
    double* to = block.axles[lane] + 7 * index;
    for (int k = 0; k < 3; ++k) {
      to[k] = state.axis[k][lane];
      to[3 + k] = state.tumble[k][lane];
    }
    to[6] = state.turns[lane];
  }
}

template <class Pack, class P>
void run_with(const P& predictor, const LaneBlock& block) {
  State<Pack> state = gather_state<Pack>(block), before;
  const LaneTips<Pack> given(block);
  Tips<Pack> tips[2];
  given.read(0, tips[0]);
  for (std::size_t i = 1; i <= block.steps; ++i) {
    const Tips<Pack>& now = tips[(i - 1) % 2];
    Tips<Pack>& next = tips[i % 2];
    given.read(i, next);
    const std::size_t done = block.first_step + i;
    const bool records = block.record_every > 0 && done % block.record_every == 0;
    const bool pulls = records && block.forces[0];
    if (pulls) before = state;
    predictor.step(state, now, next, Pack(block.dt));
    if (!records) continue;
    const std::size_t index = done / block.record_every - 1;
    scatter_record(state, block, index);
    if (block.axles[0]) scatter_axle(state, block, index);
    if (pulls) scatter_forces(tip_forces(predictor, before, state, now, next, Pack(block.dt)), block, index);
  }
  scatter_state(state, block);
}

}  // namespace batch_detail

/// The kernel for a Pack of doubles. Where no effect is at work a predictor that knows none does the same,
/// bit for bit, and does not ask at every step.
template <class Pack>
void run_lanes(const LaneBlock& block) {
  const Parameters<Pack> parameters = batch_detail::gather_parameters<Pack>(block);
  if (batch_detail::neutral<Pack>(block))
    batch_detail::run_with<Pack>(Predictor<Pack>(parameters, {}, typename Predictor<Pack>::AlreadyValid{}),
                                 block);
  else
    batch_detail::run_with<Pack>(FullPredictor<Pack>(parameters, batch_detail::gather_effects<Pack>(block),
                                                     typename FullPredictor<Pack>::AlreadyValid{}),
                                 block);
}

}  // namespace diabolo
