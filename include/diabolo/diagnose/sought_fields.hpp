// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "diabolo/diagnose/latent_force.hpp"
#include "diabolo/effects/all.hpp"

// One unknown is one field of an effect: whether it is looked for, and how, stands beside the field. Here
// they are numbered, once, when the program is compiled.
namespace diabolo {

/// What is known of an unknown before a recording is looked at.
struct UnknownInfo {
  std::string_view name, unit;
  double scale;             ///< a usual size: all linear algebra is done in it
  double prior;             ///< standard deviation of what a well made measurement has; 0: not known at all
  double minimum, maximum;  ///< search bounds
};

namespace diagnose_detail {

/// All effects that a diagnosis knows.
using SoughtEffects =
    std::type_identity<decltype(MotionEffects<double, LatentForce, GyroscopicTilt, Unbalance>::members)>;

/// Calls `visit(info)` for every field that is looked for, in their order.
template <class Effect, class Visit>
constexpr void visit_sought(const Visit& visit) {
  if constexpr (!Effect::kHasText) {  // laws of somebody's own are numbered apart
    const Effect effect{};
    Effect::for_each(effect, [&](const ParameterInfo& info, const double&) {
      const Sought& s = info.sought;
      if (!s.name.empty()) visit(UnknownInfo{s.name, info.unit, s.usual, s.prior, s.minimum, s.maximum});
    });
  }
}

template <class Visit>
constexpr void for_each_sought(const Visit& visit) {
  [&]<class... Effects>(std::type_identity<std::tuple<Effects...>>) {
    (visit_sought<Effects>(visit), ...);
  }(SoughtEffects{});
}

inline constexpr std::size_t kSoughtFields = [] {
  std::size_t count = 0;
  for_each_sought([&](const UnknownInfo&) { ++count; });
  return count;
}();

inline constexpr std::array<UnknownInfo, kSoughtFields> kSought = [] {
  std::array<UnknownInfo, kSoughtFields> infos{};
  std::size_t next = 0;
  for_each_sought([&](const UnknownInfo& info) { infos[next++] = info; });
  return infos;
}();

/// Which of them has this name.
constexpr int field_named(std::string_view name) {
  for (std::size_t i = 0; i < kSoughtFields; ++i)
    if (kSought[i].name == name) return static_cast<int>(i);
  throw std::invalid_argument("no field of an effect is looked for under this name");
}

/// The laws of all effects, in their order.
inline std::vector<NamedLaw> named_laws() {
  std::vector<NamedLaw> laws;
  [&]<class... Effects>(std::type_identity<std::tuple<Effects...>>) {
    (laws.insert(laws.end(), Effects::kLaws.begin(), Effects::kLaws.end()), ...);
  }(SoughtEffects{});
  return laws;
}

}  // namespace diagnose_detail

}  // namespace diabolo
