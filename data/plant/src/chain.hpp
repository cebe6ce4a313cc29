// SPDX-License-Identifier: MIT
#pragma once

#include "bight.hpp"
#include "chain_measures.hpp"
#include "chain_tension.hpp"
#include "plant.hpp"

namespace plant {

/// The string as a chain of lumps of mass joined by springs, over which the axle slides with Coulomb
/// friction. Each step drifts, kicks and drifts: the kick is implicit in the tensions and in friction,
/// explicit in all else; the diabolo's own rotation is exact.
class ChainPlant final : public Plant {
 public:
  ChainPlant(PlantParameters parameters, Motion motion)
      : Plant(std::move(parameters), std::move(motion)),
        measures_(parameters_.string, parameters_.diabolo.groove) {}

  Moment begin(const Start& start) const override;
  Moment advanced(Moment moment, double step) const override;
  Reading read(const Moment& moment) const override;

 private:
  // chain_step.cpp
  void drift(Moment& moment, double step) const;
  void kick(Moment& moment, double step) const;
  void place_tips(Moment& moment, const Pair<Stick>& sticks) const;

  // chain_calm.cpp
  void straighten(Moment& moment, double step) const;
  void calm(Moment& moment, double step) const;
  void guide(Moment& moment) const;

  // chain_springs.cpp
  Bight bight(const Moment& moment) const;
  std::vector<Spring> springs(const Moment& moment, const Bight& bight, const Pair<Stick>& sticks) const;
  void measure_rates(const Moment& moment, double Spring::*rate, std::vector<Spring>& springs) const;
  Vec3 yield(std::size_t node, const Vec3& pull, const Pair<Stick>& sticks) const;

  // chain_friction.cpp
  double slip(const Moment& moment, const Bight& bight) const;
  double resting_friction(const Moment& moment, const Bight& bight) const;
  double rub(const Moment& moment, const Bight& bight, const TensionSystem& system,
             const std::vector<Spring>& springs, double step, std::vector<double>& tensions) const;

  // chain_events.cpp
  void settle(Moment& moment) const;
  void make_way(Moment& moment) const;
  void pass_node(Moment& moment, const Bight& bight, std::size_t side) const;
  Pair<Vec3> ends(const Moment& moment) const;

  // chain_catch.cpp
  void move_patch(Moment& moment, double coordinate) const;
  void follow(Moment& moment) const;
  void touch(Moment& moment) const;

  // chain_begin.cpp and chain_hang.cpp
  void lay(Moment& moment) const;
  void lay_around_axle(Moment& moment) const;
  Moment hanging(Moment moment) const;
  void read_pull(Moment& moment) const;
  /// Shares of the full friction and stiffness.
  struct Easing {
    double friction;
    double stiffness;
  };
  Eigen::VectorXd forces(const Moment& moment, const Easing& easing) const;

  ChainMeasures measures_;
};

}  // namespace plant
