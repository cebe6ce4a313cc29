// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace diabolo {

/// A law that a diagnosis may find to be at work, made of fields of the effect that lists it: they go by the
/// names of their unknowns, see Sought.
struct NamedLaw {
  std::string_view name, plain;
  std::string_view direction;                    ///< in which it acts
  std::array<std::string_view, 2> amplitudes;    ///< without them it does nothing
  std::array<std::string_view, 2> companions{};  ///< that count only beside them
  std::string_view number{};                     ///< what a result calls its one amplitude
  bool positive = true;                          ///< a negative amplitude is against physics
  bool by_spin = false;                          ///< nothing is seen of it without the spin
};

}  // namespace diabolo
