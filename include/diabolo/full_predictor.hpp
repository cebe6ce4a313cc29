// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <type_traits>

#include "diabolo/effects/all.hpp"
#include "diabolo/predictor.hpp"

namespace diabolo {

namespace face_detail {

template <class Set>
struct PredictorWith;
template <class Scalar, template <class> class... Effects>
struct PredictorWith<EffectSet<Scalar, Effects...>> {
  using Type = Predictor<Scalar, Effects...>;
};

}  // namespace face_detail

/// The predictor with every effect of the library, for models that are chosen at run time (model files,
/// Python). With all amplitudes at zero it gives the bits of the plain one.
template <class Scalar>
using FullPredictor = typename face_detail::PredictorWith<AllEffects<Scalar>>::Type;

/// Gives each effect of `to` the values that it has in `from`, which may know fewer.
template <class From, class To>
void copy_effects(const From& from, To& to) {
  const auto copy = []<class One, class Other>(const One& one, Other& other) {
    if constexpr (One::kName == Other::kName) {
      if constexpr (One::kHasText) other.take_text(one);
      copy_fields(one, other);
    }
  };
  const auto to_all = [&](const auto& one) {
    std::apply([&](auto&... other) { (copy(one, other), ...); }, to.members);
  };
  std::apply([&](const auto&... one) { (to_all(one), ...); }, from.members);
}

/// The same parameters in another Scalar.
template <class To>
Parameters<To> parameters_in(const Parameters<double>& from) {
  Parameters<To> to;
  to.copy_rules(from);
  copy_fields(from, to);
  return to;
}

/// The same predictor in another Scalar, such as a dual number.
template <class To, template <class> class... Effects>
Predictor<To, Effects...> predictor_in(const Predictor<double, Effects...>& from) {
  EffectSet<To, Effects...> effects;
  copy_effects(from.effects(), effects);
  using Result = Predictor<To, Effects...>;
  return Result(parameters_in<To>(from.parameters()), effects, typename Result::AlreadyValid{});
}

/// The same state in another Scalar.
template <class To>
State<To> state_in(const State<double>& from) {
  State<To> to;
  to.position = from.position.cast<To>();
  to.velocity = from.velocity.cast<To>();
  to.spin = To(from.spin);
  to.string_state = from.string_state;
  to.axis = from.axis.cast<To>();
  to.string_acceleration = from.string_acceleration.cast<To>();
  to.tumble = from.tumble.cast<To>();
  to.turns = To(from.turns);
  return to;
}

}  // namespace diabolo
