// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "diabolo/predictor.hpp"

namespace diabolo {

/// Every number of one set of parameters or of one effect, given to another Scalar's.
template <class From, class To>
void copy_fields(const From& from, To& to) {
  std::vector<double> values;
  From::for_each(from, [&](const ParameterInfo&, double value) { values.push_back(value); });
  std::size_t next = 0;
  To::for_each(to, [&](const ParameterInfo&, auto& field) {
    field = std::remove_reference_t<decltype(field)>(values[next++]);
  });
}

/// The same for each effect of `from`; `to` begins with the same effects and may have more.
template <class From, class To>
void copy_effects(const From& from, To& to) {
  const auto copy = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (copy_fields(std::get<I>(from.members), std::get<I>(to.members)), ...);
  };
  copy(std::make_index_sequence<std::tuple_size_v<decltype(from.members)>>{});
}

/// The same predictor in another Scalar, such as a dual number.
template <class To, template <class> class... Effects>
Predictor<To, Effects...> predictor_in(const Predictor<double, Effects...>& from) {
  Parameters<To> parameters;
  parameters.copy_rules(from.parameters());
  copy_fields(from.parameters(), parameters);
  EffectSet<To, Effects...> effects;
  copy_effects(from.effects(), effects);
  using Result = Predictor<To, Effects...>;
  return Result(parameters, effects, typename Result::AlreadyValid{});
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
  return to;
}

}  // namespace diabolo
