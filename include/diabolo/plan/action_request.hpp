// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/plan/motions.hpp"
#include "diabolo/plan/planned_play.hpp"
#include "diabolo/plan/search.hpp"

namespace diabolo {

/// What plan_action() can plan: kActionNames, and a throw with its catch.
inline std::vector<std::string_view> planned_actions() {
  std::vector<std::string_view> names(kActionNames.begin(), kActionNames.end());
  names.push_back(kThrowAndCatch);
  return names;
}

/// Something that may be wanted of an action, and the actions that can aim at it.
struct Aim {
  std::string_view name;
  std::vector<std::string_view> actions;
};

inline const std::array<Aim, 3>& aims() {
  static const std::array<Aim, 3> all{
      {{"height", {"hop", "throw", "side_throw", kThrowAndCatch}},
       {"sideways", {"swing", "side_throw", kThrowAndCatch}},
       {"spin_gain", {"linear_acceleration", "wind_up", "one_turn_low", "circular_acceleration"}}}};
  return all;
}

namespace plan_detail {

inline std::string listed(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

}  // namespace plan_detail

/// A figure of play that is wanted, from its home pose.
struct ActionRequest {
  static constexpr int kMostCycles = 1000;

  std::string action;                    ///< one of planned_actions()
  int cycles = 1;                        ///< in a row, each planned from the predicted end of the one before
  double spin = 100.0;                   ///< at the start, where none is given [rad/s]
  double size = 1.0, pace = 1.0;         ///< of the seed's hands, relative to the usual ones
  std::optional<double> height{};        ///< of a throw's apex above the tips, or of a hop [m]
  std::optional<double> sideways{};      ///< how far to the left a swing goes or a throw comes down [m]
  std::optional<double> spin_gain{};     ///< of each cycle of acceleration [rad/s]
  std::optional<State<double>> start{};  ///< of the diabolo; else it hangs, see hang_at_rest()
  TipLimits limits{};                    ///< that every plan keeps
  SearchOptions search{};                ///< of each plan
  TipColumn<double> sticks = TipColumn<double>::Zero();  ///< directions, left over right; zero: not known

  bool catches() const { return action == kThrowAndCatch; }

  /// The figure of kActionNames that is planned.
  std::string figure() const {
    return !catches() ? action : sideways.value_or(0.0) != 0.0 ? "side_throw" : "throw";
  }

  /// Throws std::invalid_argument where nobody can plan that.
  void validate() const {
    const auto has = [](const std::vector<std::string_view>& names, std::string_view name) {
      return std::ranges::find(names, name) != names.end();
    };
    if (!has(planned_actions(), action))
      throw std::invalid_argument("action '" + action + "'; expected one of " +
                                  plan_detail::listed(planned_actions()));
    const std::array<bool, 3> given{height.has_value(), sideways.has_value(), spin_gain.has_value()};
    for (std::size_t i = 0; i < given.size(); ++i)
      if (const Aim& aim = aims()[i]; given[i] && !has(aim.actions, action))
        throw std::invalid_argument(std::string(aim.name) + ": nothing that " + action +
                                    " can aim at; expected with " + plan_detail::listed(aim.actions));
    if (catches() && search.solver != Solver::kGradient)
      throw std::invalid_argument("solver: 'walk'; throw_and_catch is planned by 'gradient' only");
    if (cycles < 1 || cycles > kMostCycles)
      throw std::invalid_argument("cycles: " + std::to_string(cycles) +
                                  "; expected a whole number from 1 to " + std::to_string(kMostCycles));
    if ((action == "throw" || action == "side_throw") && cycles > 1)
      throw std::invalid_argument("cycles: " + std::to_string(cycles) +
                                  "; a throw that is not caught has one");
  }
};

}  // namespace diabolo
