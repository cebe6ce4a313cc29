// SPDX-License-Identifier: MIT
#pragma once

namespace diabolo {

/// A throw: its apex above the tips, and where it comes down to the left [m].
struct ThrowAim {
  double height = 0.5, sideways = 0.0;
};

/// What to aim at next, where a throw aimed at `aim` came to `came` instead of `wanted`: Newton's method on
/// the throw's own error, with the identity for the derivative of what comes by what is aimed at. Each throw
/// leaves the share of the error by which the model's derivative is wrong, so that a model that is off by a
/// tenth needs two.
inline ThrowAim aimed_again(const ThrowAim& aim, const ThrowAim& wanted, const ThrowAim& came) {
  return {aim.height + wanted.height - came.height, aim.sideways + wanted.sideways - came.sideways};
}

}  // namespace diabolo
