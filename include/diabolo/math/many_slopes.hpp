// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace diabolo {

/// The derivatives of a Dual that has many. They know where there are none, as of a constant, which then
/// costs next to nothing. Work on them is not inlined: a call costs less than code that no cache holds.
template <class Slope, int N>
class ManySlopes {
  static constexpr int kPadded = (N + 3) / 4 * 4;  ///< whole registers; what is beyond N stays zero
  using Array = Eigen::Array<Slope, kPadded, 1>;

 public:
  using Scalar = Slope;
  static constexpr int SizeAtCompileTime = N;  // NOLINT(readability-identifier-naming): as of an Eigen::Array

  /// Derivatives times a number.
  struct Scaled {
    const ManySlopes& of;
    Slope by;

    bool any() const { return of.some_ && by != Slope(0); }
  };
  template <std::size_t Terms>
  using Sum = std::array<Scaled, Terms>;

  ManySlopes() {}  // NOLINT: there are none, and the array is not initialised
  ManySlopes(const ManySlopes& other) { *this = other; }
  ManySlopes& operator=(const ManySlopes& other) {
    some_ = other.some_;
    if (some_) array_ = other.array_;
    return *this;
  }

  Slope operator[](Eigen::Index i) const { return some_ ? array_[i] : Slope(0); }
  Slope& operator[](Eigen::Index i) {
    if (!some_) array_.setConstant(Slope(0));
    some_ = true;
    return array_[i];
  }

  ManySlopes& operator=(const Scaled& a) {
    some_ = a.any();
    if (some_) scale(a.of.array_, a.by);
    return *this;
  }
  ManySlopes& operator=(const Sum<2>& sum) {
    const auto& [a, b] = sum;
    if (!b.any()) return *this = a;
    if (!a.any()) return *this = b;
    some_ = true;
    add(a.of.array_, a.by, b.of.array_, b.by);
    return *this;
  }
  /// Term by term in pairs.
  ManySlopes& operator=(const Sum<6>& sum) {
    some_ = false;
    for (const Scaled& a : sum) some_ |= a.any();
    if (some_) add(sum);
    return *this;
  }

  /// Whether any is not zero.
  bool any() const { return some_ && !(array_ == Slope(0)).all(); }
  bool finite() const { return !some_ || array_.allFinite(); }

 private:
  [[gnu::noinline]] void scale(const Array& a, Slope by_a) { array_ = a * by_a; }
  [[gnu::noinline]] void add(const Array& a, Slope by_a, const Array& b, Slope by_b) {
    array_ = a * by_a + b * by_b;
  }
  [[gnu::noinline]] void add(const Sum<6>& s) {
    const auto own = [](const Scaled& a) -> const Array& { return a.of.some_ ? a.of.array_ : kNone; };
    array_ = ((own(s[0]) * s[0].by + own(s[1]) * s[1].by) + (own(s[2]) * s[2].by + own(s[3]) * s[3].by)) +
             (own(s[4]) * s[4].by + own(s[5]) * s[5].by);
  }

  inline static const Array kNone = Array::Zero();
  bool some_ = false;
  Array array_;
};

}  // namespace diabolo
