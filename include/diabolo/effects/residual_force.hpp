// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include "diabolo/effects/effect.hpp"
#include "diabolo/effects/residual_law.hpp"
#include "diabolo/effects/residual_scene.hpp"

namespace diabolo {

/// A force that was learnt from what named physics leaves: see ResidualLaw. It fades out where nothing was
/// seen, is never larger than it was there, and does no more work. No law of nature.
template <class Scalar>
struct ResidualForce : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "residual_force";
  static constexpr bool kHasText = true;

  /// Lanes refer to the law of what they were gathered from, which outlives them.
  using LawOf = std::conditional_t<ScalarTraits<Scalar>::kLanes == 1, std::shared_ptr<const ResidualLaw>,
                                   const ResidualLaw*>;
  LawOf law{};  ///< none: nothing is at work

  ResidualForce() = default;

  /// Throws std::invalid_argument; see ResidualLaw::validate().
  explicit ResidualForce(const ResidualLaw& given) : law(std::make_shared<const ResidualLaw>(given)) {
    given.validate();
  }

  /// Takes over another Scalar's law.
  template <class Other>
  void take_text(const ResidualForce<Other>& other) {
    if constexpr (std::is_assignable_v<LawOf&, const typename ResidualForce<Other>::LawOf&>)
      law = other.law;
    else
      law = other.law.get();
  }

  bool neutral() const { return !law; }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>& tips, const Scalar&,
                               const Parameters<Scalar>& parameters) const {
    const ResidualScene<Scalar> scene = residual_scene(state, tips, parameters);
    const Mask<Scalar> taut = is(state.string_state, StringState::kOnString);
    Vector3<Scalar> push;
    if (all(taut))
      push = push_of(law->on_string, scene);
    else if (all(!taut))
      push = push_of(law->off_string, scene);
    else
      push = select<Scalar>(taut, push_of(law->on_string, scene), push_of(law->off_string, scene));
    return bounded(push, state.velocity);
  }

  /// It has no numbers that a fit or a file would know one by one.
  template <class Self, class Visitor>
  static constexpr void for_each(Self&, Visitor&&) {}

 private:
  static Vector3<Scalar> push_of(const ResidualPart& part, const ResidualScene<Scalar>& scene) {
    const Vector3<Scalar> push = scene.axes[0] * along<0>(part, scene) +
                                 scene.axes[1] * along<1>(part, scene) +
                                 scene.axes[2] * along<2>(part, scene);
    return push * fade(part, scene);
  }

  /// The push in one direction. Two sums, since each waits for the one before.
  template <std::size_t kAxis>
  static Scalar along(const ResidualPart& part, const ResidualScene<Scalar>& scene) {
    std::array<Scalar, 2> sums{Scalar(0), Scalar(0)};
    for (std::size_t i = residual_begin(kAxis); i < residual_begin(kAxis + 1); ++i)
      sums[i % 2] += scene.terms[i] * Scalar(part.weights[i]);
    return sums[0] + sums[1];
  }

  /// 1 in the ranges, and smoothly to 0 where one is left by half its width.
  static Scalar fade(const ResidualPart& part, const ResidualScene<Scalar>& scene) {
    Mask<Scalar> inside(true);
    for (std::size_t i = 0; i < kResidualInputs; ++i)
      inside = inside && scene.inputs[i] >= Scalar(part.low[i]) && scene.inputs[i] <= Scalar(part.high[i]);
    if (all(inside)) return Scalar(1);
    Scalar beyond(0);
    for (std::size_t i = 0; i < kResidualInputs; ++i) {
      const double middle = 0.5 * (part.low[i] + part.high[i]), half = 0.5 * (part.high[i] - part.low[i]);
      const Scalar off = absolute<Scalar>(scene.inputs[i] - Scalar(middle)) - Scalar(half);
      const Scalar widths = maximum(off, Scalar(0)) * Scalar(1.0 / (half + 1e-9));
      beyond += widths * widths;
    }
    const Scalar kept = maximum(Scalar(Scalar(1) - beyond), Scalar(0));
    return kept * kept;
  }

  Vector3<Scalar> bounded(const Vector3<Scalar>& push, const Vector3<Scalar>& velocity) const {
    const Scalar largest = Scalar(law->largest);
    Vector3<Scalar> held = push;
    if (any(squared_norm(push) > largest * largest))
      held = held * Scalar(largest / maximum(norm(push), largest));
    const Scalar too_much = dot<Scalar>(held, velocity) - Scalar(law->power);
    if (any(too_much > Scalar(0)))
      held =
          held - velocity * Scalar(maximum(too_much, Scalar(0)) / (squared_norm(velocity) + tiny<Scalar>()));
    return held;
  }
};

/// Whether two forces follow the same law.
template <class Scalar>
bool same_residual(const ResidualForce<Scalar>& a, const ResidualForce<Scalar>& b) {
  return a.law == b.law || (a.law && b.law && *a.law == *b.law);
}

}  // namespace diabolo
