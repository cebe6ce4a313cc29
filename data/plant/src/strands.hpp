// SPDX-License-Identifier: MIT
#pragma once

#include "plant.hpp"

namespace plant {

/// The string as two explicit springs around a finite axle; the integrator is Runge-Kutta of order four with
/// a fixed step, cut where the string tautens, slackens or parts.
class StrandsPlant final : public Plant {
 public:
  using Plant::Plant;

  Moment begin(const Start& start) const override;
  Moment advanced(Moment moment, double step) const override;
  Reading read(const Moment& moment) const override;

 private:
  Pair<Vec3> tips(const State& state, const Pair<Stick>& sticks) const;
  StringShape shape(const Moment& moment, const State& state, const Pair<Stick>& sticks) const;
  State rate(const Moment& moment, double time, const State& state, const Pair<Stick>& sticks) const;
  State runge_kutta(const Moment& moment, double step) const;
  Moment stepped(const Moment& moment, double step) const;
  bool is_taut(const StringShape& shape, double time) const;
  double height_above_chord(const Moment& moment) const;
  bool stays(const Moment& moment) const;
  void switch_mode(Moment& moment) const;
  void land(Moment& moment) const;
  void hang(Moment& moment) const;
  double energy(const State& state) const;
};

}  // namespace plant
