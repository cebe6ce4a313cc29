// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "diabolo/math/lane_functions.hpp"

namespace diabolo {

/// A bool per lane: all bits set where true (GCC and Clang vector extensions).
template <class T, int Lanes, class Tag = void>
struct PackMask {
  using Integer = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
  typedef Integer Bits __attribute__((vector_size(sizeof(Integer) * Lanes)));
  Bits bits{};

  PackMask() = default;
  PackMask(bool all) : bits(Bits{} - Integer(all ? 1 : 0)) {}  // NOLINT: a bool is the same in every lane
  explicit PackMask(const Bits& b) : bits(b) {}
  bool operator[](int lane) const { return bits[lane] != 0; }

  [[gnu::always_inline]] friend inline PackMask operator&&(PackMask a, PackMask b) {
    return PackMask(Bits(a.bits & b.bits));
  }
  [[gnu::always_inline]] friend inline PackMask operator||(PackMask a, PackMask b) {
    return PackMask(Bits(a.bits | b.bits));
  }
  [[gnu::always_inline]] friend inline PackMask operator!(PackMask a) { return PackMask(Bits(~a.bits)); }
  [[gnu::always_inline]] friend inline bool any(PackMask a) {
    // Halving keeps the work in vector registers.
    if constexpr (Lanes > 2) {
      typedef typename PackMask<T, Lanes / 2, Tag>::Bits Half;
      Half low, high;
      std::memcpy(&low, &a.bits, sizeof(Half));
      std::memcpy(&high, reinterpret_cast<const char*>(&a.bits) + sizeof(Half), sizeof(Half));
      return any(PackMask<T, Lanes / 2, Tag>(Half(low | high)));
    } else {
      Integer sum = a.bits[0];
      for (int i = 1; i < Lanes; ++i) sum |= a.bits[i];
      return sum != 0;
    }
  }
  [[gnu::always_inline]] friend inline bool all(PackMask a) { return !any(!a); }
};

/// `Lanes` numbers that go through the same operations at once. The compiler maps it to whatever vector
/// registers the translation unit is compiled for; the value of a lane does not depend on the other lanes. It
/// is that of a Scalar of one lane to the last bit, but for tanh and atan2 (lane_functions.hpp).
///
/// Code that is compiled for one instruction set inside a program for several gives a `Tag` of its own, so
/// that the linker never mixes its functions with others.
template <class T, int Lanes, class Tag = void>
struct Pack {
  // Never aligned more strictly than Eigen aligns an array of them, which must not be less than its element.
  static constexpr std::size_t kAlignment =
      std::min(sizeof(T) * Lanes, std::max<std::size_t>(EIGEN_MAX_STATIC_ALIGN_BYTES, alignof(T)));
  typedef T Vector __attribute__((vector_size(sizeof(T) * Lanes), aligned(kAlignment)));
  using Mask = PackMask<T, Lanes, Tag>;
  Vector lanes{};

  Pack() = default;
  Pack(double x) : lanes(static_cast<T>(x) - Vector{}) {}  // NOLINT: a constant is the same in every lane
  explicit Pack(const Vector& v) : lanes(v) {}
  T operator[](int lane) const { return lanes[lane]; }
  void set(int lane, T x) { lanes[lane] = x; }

  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  Pack& operator*=(Pack b) { return *this = *this * b; }
  Pack& operator/=(Pack b) { return *this = *this / b; }

  [[gnu::always_inline]] friend inline Pack operator-(Pack a) { return Pack(Vector(-a.lanes)); }
  [[gnu::always_inline]] friend inline Pack operator+(Pack a, Pack b) {
    return Pack(Vector(a.lanes + b.lanes));
  }
  [[gnu::always_inline]] friend inline Pack operator-(Pack a, Pack b) {
    return Pack(Vector(a.lanes - b.lanes));
  }
  [[gnu::always_inline]] friend inline Pack operator*(Pack a, Pack b) {
    return Pack(Vector(a.lanes * b.lanes));
  }
  [[gnu::always_inline]] friend inline Pack operator/(Pack a, Pack b) {
    return Pack(Vector(a.lanes / b.lanes));
  }

  [[gnu::always_inline]] friend inline Mask operator<(Pack a, Pack b) {
    return Mask(typename Mask::Bits(a.lanes < b.lanes));
  }
  [[gnu::always_inline]] friend inline Mask operator>(Pack a, Pack b) {
    return Mask(typename Mask::Bits(a.lanes > b.lanes));
  }
  [[gnu::always_inline]] friend inline Mask operator<=(Pack a, Pack b) {
    return Mask(typename Mask::Bits(a.lanes <= b.lanes));
  }
  [[gnu::always_inline]] friend inline Mask operator>=(Pack a, Pack b) {
    return Mask(typename Mask::Bits(a.lanes >= b.lanes));
  }
  [[gnu::always_inline]] friend inline Mask operator==(Pack a, Pack b) {
    return Mask(typename Mask::Bits(a.lanes == b.lanes));
  }
  [[gnu::always_inline]] friend inline Mask operator!=(Pack a, Pack b) {
    return Mask(typename Mask::Bits(a.lanes != b.lanes));
  }

  [[gnu::always_inline]] friend inline Pack sqrt(Pack x) {
    return each(x, [](T t) { return std::sqrt(t); });
  }
  [[gnu::always_inline]] friend inline Pack exp(Pack x) {
    return each(x, [](T t) { return std::exp(t); });
  }
  [[gnu::always_inline]] friend inline Pack log(Pack x) {
    return each(x, [](T t) { return std::log(t); });
  }
  [[gnu::always_inline]] friend inline Pack sin(Pack x) {
    return each(x, [](T t) { return std::sin(t); });
  }
  [[gnu::always_inline]] friend inline Pack cos(Pack x) {
    return each(x, [](T t) { return std::cos(t); });
  }
  [[gnu::always_inline]] friend inline Pack tanh(Pack x) { return lane_detail::hyperbolic_tangent(x); }
  [[gnu::always_inline]] friend inline Pack atan2(Pack y, Pack x) { return lane_detail::angle_of(y, x); }

  [[gnu::always_inline]] friend inline Pack select(Mask condition, Pack a, Pack b) {
    return Pack(Vector(condition.bits ? a.lanes : b.lanes));
  }
  [[gnu::always_inline]] friend inline Mask is_finite(Pack x) { return (x - x) == Pack(0.0); }
  [[gnu::always_inline]] friend inline bool is_constant_zero(Pack x) { return all(x == Pack(0.0)); }
  [[gnu::always_inline]] friend inline Pack value_of(Pack x) { return x; }

 private:
  template <class Function>
  [[gnu::always_inline]] static inline Pack each(Pack x, Function function) {
    Pack result;
    for (int i = 0; i < Lanes; ++i) result.lanes[i] = function(x.lanes[i]);
    return result;
  }
};

template <class T, int Lanes, class Tag>
struct ScalarTraits<Pack<T, Lanes, Tag>> {
  using Mask = PackMask<T, Lanes, Tag>;
  using Value = T;
  static constexpr int kLanes = Lanes;
};

}  // namespace diabolo

template <class T, int Lanes, class Tag>
struct Eigen::NumTraits<diabolo::Pack<T, Lanes, Tag>>
    : Eigen::GenericNumTraits<diabolo::Pack<T, Lanes, Tag>> {
  using Real = diabolo::Pack<T, Lanes, Tag>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
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
