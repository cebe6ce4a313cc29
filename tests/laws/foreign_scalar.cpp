// SPDX-License-Identifier: MIT
// The Scalar contract, written out: a type with what scalar.hpp lists, and nothing else, rolls out.

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/rollout.hpp"

namespace foreign {

/// A double that converts to nothing and from nothing by itself.
struct Plain {
  double number = 0.0;
  Plain() = default;
  explicit Plain(double x) : number(x) {}

  Plain& operator+=(Plain b) { return number += b.number, *this; }
  Plain& operator-=(Plain b) { return number -= b.number, *this; }
  friend Plain operator-(Plain a) { return Plain(-a.number); }
  friend Plain operator+(Plain a, Plain b) { return Plain(a.number + b.number); }
  friend Plain operator-(Plain a, Plain b) { return Plain(a.number - b.number); }
  friend Plain operator*(Plain a, Plain b) { return Plain(a.number * b.number); }
  friend Plain operator/(Plain a, Plain b) { return Plain(a.number / b.number); }

  friend bool operator<(Plain a, Plain b) { return a.number < b.number; }
  friend bool operator>(Plain a, Plain b) { return a.number > b.number; }
  friend bool operator<=(Plain a, Plain b) { return a.number <= b.number; }
  friend bool operator>=(Plain a, Plain b) { return a.number >= b.number; }
  friend bool operator==(Plain a, Plain b) { return a.number == b.number; }

  friend Plain sqrt(Plain x) { return Plain(std::sqrt(x.number)); }
  friend Plain exp(Plain x) { return Plain(std::exp(x.number)); }
  friend Plain log(Plain x) { return Plain(std::log(x.number)); }
  friend Plain sin(Plain x) { return Plain(std::sin(x.number)); }
  friend Plain cos(Plain x) { return Plain(std::cos(x.number)); }
  friend Plain tanh(Plain x) { return Plain(std::tanh(x.number)); }
  friend Plain atan2(Plain y, Plain x) { return Plain(std::atan2(y.number, x.number)); }

  friend Plain select(bool condition, Plain a, Plain b) { return condition ? a : b; }
  friend bool is_finite(Plain x) { return std::isfinite(x.number); }
  friend bool is_constant_zero(Plain x) { return x.number == 0.0; }
};

}  // namespace foreign

template <>
struct diabolo::ScalarTraits<foreign::Plain> {
  using Mask = bool;
  using Value = double;
  static constexpr int kLanes = 1;
};

template <>
struct Eigen::NumTraits<foreign::Plain> : Eigen::GenericNumTraits<foreign::Plain> {
  using Real = foreign::Plain;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

using namespace diabolo;

namespace {

template <class Scalar>
Vector3<Scalar> vector(double x, double y, double z) {
  return {Scalar(x), Scalar(y), Scalar(z)};
}

/// A second under moving tips, every field of every effect at this share of its largest value.
template <class Scalar>
State<Scalar> rolled_out(const Parameters<Scalar>& parameters, double share) {
  AllEffects<Scalar> effects;
  const auto turn_on = [&]<class Effect>(Effect& effect) {
    Effect::for_each(effect,
                     [&](const ParameterInfo& info, Scalar& field) { field = Scalar(share * info.maximum); });
  };
  std::apply([&](auto&... effect) { (turn_on(effect), ...); }, effects.members);
  TipMotion<Scalar> motion(
      {0.0, 0.3, 1.0},
      {vector<Scalar>(0.0, 0.3, 1.0), vector<Scalar>(0.1, 0.4, 1.2), vector<Scalar>(0.0, 0.3, 0.9)},
      {vector<Scalar>(0.0, -0.3, 1.0), vector<Scalar>(0.0, -0.4, 0.8), vector<Scalar>(0.1, -0.3, 1.1)},
      Interpolation::kSpline);
  const std::vector<Vector3<Scalar>> sticks(3, vector<Scalar>(0.8, 0.6, 0.0));
  motion.point_along(sticks, sticks);
  State<Scalar> start;
  start.position = vector<Scalar>(0.05, 0.1, 0.4);
  start.spin = Scalar(90.0);
  return rollout(FullPredictor<Scalar>(parameters, effects), start, motion, {0.0, 1e-3, 1000});
}

}  // namespace

TEST_CASE("a scalar with what the contract lists rolls out to the bits that double gives") {
  using foreign::Plain;
  for (const double share : {0.0, 0.005}) {
    const auto check = [&](const State<double>& expected, const State<Plain>& given) {
      for (int k = 0; k < 3; ++k) {
        CHECK(given.position[k].number == expected.position[k]);
        CHECK(given.velocity[k].number == expected.velocity[k]);
      }
      CHECK(given.spin.number == expected.spin);
      CHECK(given.string_state == expected.string_state);
    };
    check(rolled_out(Parameters<double>::consistent(), share),
          rolled_out(Parameters<Plain>::consistent(), share));
    check(rolled_out(Parameters<double>::paper(), share), rolled_out(Parameters<Plain>::paper(), share));
    check(rolled_out(Parameters<double>::published(), share),
          rolled_out(Parameters<Plain>::published(), share));
  }
}
