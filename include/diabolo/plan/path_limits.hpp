// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "diabolo/plan/tip_path.hpp"

namespace diabolo {

/// How much of a limit a path uses up.
struct LimitUse {
  std::string name;  ///< such as "left tip speed"
  double value;      ///< the largest over the path (of a lower limit, the smallest)
  double limit;
  std::string unit;
  double time;    ///< where it is reached [s]
  double excess;  ///< how far beyond the limit, as a share of it or of a metre; <= 0 where it is kept
};

/// What can be asked how much a path uses up of its limits.
template <class Look>
concept LooksAtPaths = std::is_invocable_r_v < std::vector<LimitUse>,
const Look&, const TipPath<double>& > ;

/// Limits that a path uses up, from whatever can be called with a TipPath<double> and returns a vector of
/// LimitUse, always the same ones in the same order, such as RobotLimits. If that has a function
/// `near(path, beside, uses)` too, it looks at each limit only where the uses of a path beside this one say
/// that it is reached: enough for differences, and sooner done.
class PathLimits {
 public:
  using Uses = std::vector<LimitUse>;

  PathLimits() = default;
  template <LooksAtPaths Look>
  PathLimits(Look look) : look_(look) {  // NOLINT: whatever can be called is such limits
    using Path = TipPath<double>;
    if constexpr (requires(const Path& path, const Uses& uses) { look.near(path, path, uses); })
      near_ = [look](const Path& path, const Path& beside, const Uses& uses) {
        return look.near(path, beside, uses);
      };
  }

  explicit operator bool() const { return static_cast<bool>(look_); }

  /// What they were made of, where that is a Look; else null.
  template <LooksAtPaths Look>
  const Look* target() const {
    return look_.template target<Look>();
  }

  /// What a path uses up; nothing where there are no limits. Throws std::invalid_argument where a number of
  /// theirs is none.
  Uses operator()(const TipPath<double>& path) const { return look_ ? checked(look_(path)) : Uses{}; }

  /// The same for a path with another one beside it, of which `uses` are.
  Uses near(const TipPath<double>& path, const TipPath<double>& beside, const Uses& uses) const {
    return near_ ? checked(near_(path, beside, uses)) : (*this)(path);
  }

 private:
  static Uses checked(Uses uses) {
    for (const LimitUse& use : uses)
      for (const auto& [what, number] :
           {std::pair{"value", use.value}, {"limit", use.limit}, {"time", use.time}, {"excess", use.excess}})
        if (std::isnan(number))
          throw std::invalid_argument("limits, " + use.name + ": its " + what + " is not a number");
    return uses;
  }

  std::function<Uses(const TipPath<double>&)> look_;
  std::function<Uses(const TipPath<double>&, const TipPath<double>&, const Uses&)> near_;
};

}  // namespace diabolo
