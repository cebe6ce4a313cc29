// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/effects/law.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A law that may be what is left over, and what is asked of windows to see whether it is: laws of one number
/// each, together as good as the law with its shape as it is begun with.
struct LawGuess {
  Law law;
  std::vector<Law> probes;
  std::vector<double> named_powers{};  ///< with which it is a law that has a name
};

namespace diagnose_detail {

/// A size rounded to one digit, to be read in a formula; 1 where there is none but of rounding.
inline double one_digit(double x) {
  if (!(x > 1e-6)) return 1.0;
  const double power = std::floor(std::log10(x));
  return power < 0.0 ? std::round(x * std::pow(10.0, -power)) / std::pow(10.0, -power)
                     : std::round(x / std::pow(10.0, power)) * std::pow(10.0, power);
}

/// In words, as the end of "a force that has no name".
inline std::string direction_in_words(Acts acts) {
  switch (acts) {
    case Acts::kForward:
      return "forwards";
    case Acts::kLeft:
      return "to the left";
    case Acts::kUp:
      return "upwards";
    case Acts::kAgainst:
      return "against the velocity";
    case Acts::kAlong:
      return "along the string";
    case Acts::kAcross:
      return "across the string's plane";
    case Acts::kLift:
      return "square to axle and velocity";
    case Acts::kSpin:
      return "on the spin";
    case Acts::kFriction:
      return "on the string's friction";
    default:
      return "on the string's length";
  }
}

/// Makes guesses one by one.
class Guesses {
 public:
  std::vector<LawGuess> list;

  /// amplitude * factor, as it is.
  void fixed(Acts acts, const std::string& factor, const std::string& words) {
    const Law law = made(acts, product(factor), words, {amplitude(acts)});
    list.push_back({law, {law}});
  }

  /// rate * factor * t.
  void trending(Acts acts, const std::string& factor, const std::string& words = ", growing in time") {
    LawNumber rate = amplitude(acts);
    rate.name = "rate";
    rate.unit = per_second(acts);
    rate.usual *= 0.1;
    const Law law = made(acts, joined("rate", joined(factor, "t")), words, {rate});
    list.push_back({law, {law}});
  }

  /// amplitude * factor * base^power, begun with `power`.
  void growing(Acts acts, const std::string& factor, const std::string& base, double power,
               const std::string& words, const std::vector<double>& named = {}) {
    const std::string begun = product(joined(factor, "(" + base + ")^" + shown(power)));
    const LawNumber free{"power", "1", 0.5, power, -4.0, 4.0};
    list.push_back(
        {made(acts, product(joined(factor, "(" + base + ")^power")), words, {amplitude(acts), free}),
         {made(acts, begun, words, {amplitude(acts)})},
         named});
  }

  /// amplitude * factor * sin(2 pi frequency t + phase).
  void swinging(Acts acts, const std::string& factor, double frequency, double span,
                const std::string& words) {
    const std::vector<LawNumber> numbers{amplitude(acts),
                                         {"frequency", "Hz", 0.1 / span, frequency,
                                          std::max(0.0, frequency - 1.0 / span), frequency + 1.0 / span},
                                         {"phase", "rad", 0.3, 0.0, -10.0, 10.0}};
    list.push_back(
        {made(acts, product(joined(factor, "sin(2 * pi * frequency * t + phase)")), words, numbers),
         quadratures(acts, factor, frequency, words)});
  }

  /// amplitude * factor from the time `onset` on, between `first` and `last` of the law's clock; within a
  /// second, which is what windows see.
  void starting(Acts acts, const std::string& factor, double onset, double first, double last) {
    const auto step = [&](const std::string& begin) {
      return product(joined(factor, "(1 + tanh((t - " + begin + ") / 0.5)) / 2"));
    };
    const std::string words = ", from a moment on";
    list.push_back(
        {made(acts, step("onset"), words, {amplitude(acts), {"onset", "s", 0.2, onset, first, last}}),
         {made(acts, step(shown(onset)), words, {amplitude(acts)})}});
  }

  /// amplitude * exp(-base / decay), begun with `decay`: what warms up, dries or settles, or slips fast.
  void decaying(Acts acts, const std::string& base, double decay, const std::string& unit,
                const std::string& words) {
    const auto by = [&](const std::string& scale) { return product("exp(-" + base + " / " + scale + ")"); };
    list.push_back({made(acts, by("decay"), words,
                         {amplitude(acts), {"decay", unit, 0.5 * decay, decay, 0.1 * decay, 8.0 * decay}}),
                    {made(acts, by(shown(decay)), words, {amplitude(acts)})}});
  }

  /// amplitude * (place - centre): towards a plane across `place`, or away from it.
  void off_place(Acts acts, const std::string& place, double centre) {
    const auto off = [&](const std::string& from) { return product("(" + place + " - " + from + ")"); };
    const std::string words = ", growing with the way from a place along " + place + " (at 1 m from it)";
    list.push_back({made(acts, off("centre"), words,
                         {amplitude(acts), {"centre", "m", 0.1, centre, centre - 10.0, centre + 10.0}}),
                    {made(acts, off("(" + shown(centre) + ")"), words, {amplitude(acts)})}});
  }

  /// amplitude beyond a plane across `place`, within a width that is known no better.
  void beyond_place(Acts acts, const std::string& place, double edge, double width) {
    const auto step = [&](const std::string& where) {
      return product("(1 + tanh((" + place + " - " + where + ") / " + shown(width) + ")) / 2");
    };
    const std::string words = ", beyond a place along " + place;
    list.push_back(
        {made(acts, step("edge"), words,
              {amplitude(acts), {"edge", "m", width, edge, edge - 5.0 * width, edge + 5.0 * width}}),
         {made(acts, step("(" + shown(edge) + ")"), words, {amplitude(acts)})}});
  }

  /// amplitude * exp(-((place - centre) / width)^2): near a plane across `place`.
  void close_to(Acts acts, const std::string& place, double centre, double width) {
    const auto bump = [&](const std::string& where, const std::string& wide) {
      return product("exp(-((" + place + " - " + where + ") / " + wide + ")^2)");
    };
    const std::string words = ", near a place along " + place;
    list.push_back({made(acts, bump("centre", "width"), words,
                         {amplitude(acts),
                          {"centre", "m", 0.5 * width, centre, centre - 2.0 * width, centre + 2.0 * width},
                          {"width", "m", 0.3 * width, width, 0.2 * width, 3.0 * width}}),
                    {made(acts, bump("(" + shown(centre) + ")", shown(width)), words, {amplitude(acts)})}});
  }

  /// amplitude * factor * sin(2 pi frequency t), and the same of the cosine.
  static std::vector<Law> quadratures(Acts acts, const std::string& factor, double frequency,
                                      const std::string& words) {
    const std::string angle = "(2 * pi * " + shown(frequency) + " * t)";
    return {made(acts, product(joined(factor, "sin" + angle)), words, {amplitude(acts)}),
            made(acts, product(joined(factor, "cos" + angle)), words, {amplitude(acts)})};
  }

 private:
  static LawNumber amplitude(Acts acts) {
    const double usual = acts == Acts::kSpin       ? 5.0
                         : acts == Acts::kString   ? 2e-3
                         : acts == Acts::kFriction ? 0.03
                                                   : 0.3;
    return {"size", std::string(unit_of(acts)), usual, 0.0, -1e3, 1e3};
  }
  static const char* per_second(Acts acts) {
    switch (acts) {
      case Acts::kSpin:
        return "rad/s^3";
      case Acts::kString:
        return "m/s";
      case Acts::kFriction:
        return "1/s";
      default:
        return "m/s^3";
    }
  }
  static std::string joined(const std::string& a, const std::string& b) {
    return a.empty() ? b : b.empty() ? a : a + " * " + b;
  }
  static std::string product(const std::string& factor) { return joined("size", factor); }
  static Law made(Acts acts, const std::string& formula, const std::string& words,
                  std::vector<LawNumber> numbers) {
    return {"learnt", direction_in_words(acts) + words, acts, formula, std::move(numbers)};
  }
};

}  // namespace diagnose_detail

}  // namespace diabolo
