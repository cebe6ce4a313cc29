// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "diabolo/math/scalar.hpp"

namespace diabolo::lane_detail {

// Functions of all lanes of a Pack at once, from + - * / alone: so every instruction set gives the same bits.
// For doubles tanh is within 2 units in the last place, atan2 within 6 (tests/math/lane_functions.cpp).
// Rational approximations: Moshier, Cephes mathematical library 2.8. Reduction of the exponential: Cody and
// Waite 1980, "Software manual for the elementary functions".

/// The polynomial with these coefficients, the highest power first.
template <class Pack, class... Coefficients>
[[gnu::always_inline]] inline Pack polynomial(const Pack& x, double first, Coefficients... others) {
  Pack sum(first);
  ((sum = sum * x + Pack(others)), ...);
  return sum;
}

/// `size`, not negative, with the sign of `other`, also of its zero.
template <class Pack>
[[gnu::always_inline]] inline Pack with_sign_of(const Pack& size, const Pack& other) {
  using Vector = typename Pack::Vector;
  using Bits = typename Pack::Mask::Bits;
  const Bits sign = Bits(other.lanes) & Bits(Pack(-0.0).lanes);
  return Pack(Vector(Bits(size.lanes) | sign));
}

/// exp(x) where it is neither too large nor too small to be a normal number.
template <class Pack>
[[gnu::always_inline]] inline Pack exponential(const Pack& x) {
  using Vector = typename Pack::Vector;
  using Bits = typename Pack::Mask::Bits;
  constexpr int kMantissa = std::numeric_limits<ValueOf<Pack>>::digits - 1;
  const Pack shift(1.5 / static_cast<double>(std::numeric_limits<ValueOf<Pack>>::epsilon()));
  const Pack shifted = x * Pack(std::numbers::log2e) + shift;  // its last bits are the nearest whole number
  const Pack whole = shifted - shift;
  const Pack rest = (x - whole * Pack(0.693145751953125)) - whole * Pack(1.42860682030941723212e-6);
  const Pack power(Vector((Bits(shifted.lanes) << kMantissa) + Bits(Pack(1.0).lanes)));
  const Pack square = rest * rest;
  const Pack even = polynomial(square, 1.0 / 479001600, 1.0 / 3628800, 1.0 / 40320, 1.0 / 720, 1.0 / 24, 0.5,
                               1.0),
             odd = polynomial(square, 1.0 / 39916800, 1.0 / 362880, 1.0 / 5040, 1.0 / 120, 1.0 / 6, 1.0);
  return power * (even + rest * odd);
}

template <class Pack>
[[gnu::always_inline]] inline Pack hyperbolic_tangent(const Pack& x) {
  const Pack size = absolute(x), square = x * x;
  const Mask<Pack> small = size < Pack(0.625);
  Pack begin = size,
       above = size * square *
               polynomial(square, -9.64399179425052238628e-1, -9.92877231001918586564e1,
                          -1.61468768441708447952e3),
       below = polynomial(square, 1.0, 1.12811678491632931402e2, 2.23548839060100448583e3,
                          4.84406305325125486048e3);
  if (!all(small)) {  // 1 - 2 / (exp(2 x) + 1), which is one to the last bit beyond 20
    const Pack grown = exponential<Pack>(Pack(2) * select(size > Pack(20), Pack(20), size));
    begin = select(small, begin, Pack(1));
    above = select(small, above, Pack(-2));
    below = select(small, below, Pack(grown + Pack(1)));
  }
  return with_sign_of<Pack>(begin + above / below, x);
}

/// The angle of the point (x, y), as atan2(y, x) has it.
template <class Pack>
[[gnu::always_inline]] inline Pack angle_of(const Pack& y, const Pack& x) {
  using std::numbers::pi;
  const Pack wide = absolute(x), high = absolute(y);
  const Mask<Pack> steep = high > wide;
  const Pack small = select(steep, wide, high), large = select(steep, high, wide);
  // Turned by an eighth of the circle where that brings it nearer to the axis. Two that are infinite have no
  // difference.
  const Mask<Pack> alike = small == large && large > Pack(0);
  const Mask<Pack> turned = alike || small > Pack(std::numbers::sqrt2 - 1.0) * large;
  const Pack beside = select(turned, select(alike, Pack(0), Pack(small - large)), small),
             along = select(turned, Pack(small + large), select(large == Pack(0), Pack(1), large));
  const Pack tangent = beside / along, square = tangent * tangent;
  const Pack bent =
      polynomial(square, -8.750608600031904122785e-1, -1.615753718753365076637e1, -7.500855792314704667340e1,
                 -1.228866684490136173410e2, -6.485021904942025371773e1) /
      polynomial(square, 1.0, 2.485846490142306297962e1, 1.650270098316988542046e2, 4.328810604912902668951e2,
                 4.853903996359136964868e2, 1.945506571482613964425e2);
  Pack angle = select(turned, Pack(0.25 * pi), Pack(0)) + (tangent + tangent * square * bent);
  angle = select(steep, Pack(Pack(0.5 * pi) - angle), angle);
  // Also for a zero that is negative.
  const Mask<Pack> behind = with_sign_of<Pack>(Pack(1), x) < Pack(0);
  return with_sign_of<Pack>(select(behind, Pack(Pack(pi) - angle), angle), y);
}

}  // namespace diabolo::lane_detail
