// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "diabolo/estimate/chart.hpp"
#include "diabolo/estimate/measurements.hpp"

namespace diabolo {

/// Standard deviations of what is known at the beginning.
struct Spread {
  double position = 0.02;  ///< of each coordinate [m]
  double velocity = 0.1;   ///< of each coordinate [m/s]
  double spin = 10.0;      ///< [rad/s]
  double axle = 0.05;      ///< [rad]

  void validate() const {
    expect_positive("start spread, position", position);
    expect_positive("start spread, velocity", velocity);
    expect_positive("start spread, spin", spin);
    expect_positive("start spread, axle", axle);
  }
};

/// What the model does not know. The first three are white: their effect grows with the root of time.
struct ProcessNoise {
  double acceleration = 0.05;   ///< unknown, of the diabolo [m/s^2/sqrt(Hz)]: [m/s] after a second
  double spin = 2.0;            ///< unknown, of the spin [rad/s^2/sqrt(Hz)]
  double axle = 0.02;           ///< unknown turning of the axle [rad/s/sqrt(Hz)]
  double tension = 0.05;        ///< of a strand's tension, a share of it
  double direction = 4e-3;      ///< of a strand [rad]
  double string_length = 3e-3;  ///< error and stretch [m]
  double string_rate = 0.1;     ///< at which the string stretches [m/s]

  void validate() const {
    expect_positive("process noise, acceleration", acceleration);
    expect_positive("process noise, spin", spin);
    expect_positive("process noise, axle", axle);
    expect_positive("process noise, tension", tension);
    expect_positive("process noise, direction", direction);
    expect_positive("process noise, string_length", string_length);
    expect_positive("process noise, string_rate", string_rate);
  }
};

/// The diabolo at a time, as far as it is known.
template <bool kAxle>
struct Belief {
  using Chart = StateChart<kAxle>;
  static constexpr int kSize = Chart::kSize;

  double time = 0.0;  ///< [s]
  State<double> state;
  MatrixOf<kSize> factor = MatrixOf<kSize>::Identity();  ///< lower; see covariance()
  /// How likely the string is taut, loose or off, in the order of StringState.
  std::array<double, 3> string_weights{};
  bool pulled = false;  ///< the string pulled in the last step
  /// Of the last pulls: squared innovation over its covariance, of each number; 1 expected.
  double normalized_innovation_squared = 0.0;
  int gated =
      0;  ///< above zero: a tension failed the gate, so that measured ones move the diabolo; see TickFilter

  static Belief begin(double time, const State<double>& state, const Spread& spread) {
    ColumnOf<kSize> deviations;
    deviations.template segment<3>(Chart::kPosition).setConstant(spread.position);
    deviations.template segment<3>(Chart::kVelocity).setConstant(spread.velocity);
    deviations[Chart::kSpin] = spread.spin;
    if constexpr (kAxle) deviations.template tail<2>().setConstant(spread.axle);
    Belief belief;
    belief.time = time;
    belief.state = state;
    belief.factor = deviations.asDiagonal();
    belief.string_weights[static_cast<std::size_t>(state.string_state)] = 1.0;
    belief.pulled = state.string_state == StringState::kOnString;
    return belief;
  }

  /// Of StateChart's numbers, in their units.
  MatrixOf<kSize> covariance() const { return factor * factor.transpose(); }
  /// Their standard deviations: an interval of 90 % is 1.645 of these to both sides.
  ColumnOf<kSize> deviations() const { return factor.rowwise().norm(); }

  /// The measurement update.
  void update(const Correction<kSize>& correction) {
    state = Chart::at(state, correction.shift);
    factor = correction.factor;
  }
};

}  // namespace diabolo
