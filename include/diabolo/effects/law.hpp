// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/math/formula.hpp"

namespace diabolo {

/// What a law's formula is the size of. Accelerations come first.
enum class Acts {
  kForward,   ///< acceleration along the world's x [m/s^2]
  kLeft,      ///< along y [m/s^2]
  kUp,        ///< along z [m/s^2]
  kAgainst,   ///< against the velocity [m/s^2]
  kAlong,     ///< in the string's plane, towards the right tip [m/s^2]
  kAcross,    ///< square to the string's plane, forwards [m/s^2]
  kLift,      ///< along omega x v [m/s^2]
  kSpin,      ///< rate of change of the spin [rad/s^2]
  kString,    ///< added to the string's length [m]
  kFriction,  ///< added to the coefficient of the string's friction [1]
};

/// Their names, in the order of their numbers from 0.
inline constexpr std::array<std::string_view, 10> names_of(Acts) {
  return {"forward", "left", "up", "against", "along", "across", "lift", "spin", "string", "friction"};
}

inline bool is_acceleration(Acts acts) { return acts < Acts::kSpin; }

inline std::string_view unit_of(Acts acts) {
  switch (acts) {
    case Acts::kSpin:
      return "rad/s^2";
    case Acts::kString:
      return "m";
    case Acts::kFriction:
      return "1";
    default:
      return "m/s^2";
  }
}

/// What a formula may ask of the state and the tips at a step's beginning.
struct LawVariable {
  std::string_view name, unit, meaning;
  bool by_spin = false;  ///< unknown where nobody sees the diabolo turn
};
inline constexpr std::array<LawVariable, 22> kLawVariables{{
    {"t", "s", "time of the recording, or of the tips' motion"},
    {"x", "m", "position of the diabolo, forwards"},
    {"y", "m", "the same to the left"},
    {"z", "m", "the same upwards"},
    {"vx", "m/s", "velocity, forwards"},
    {"vy", "m/s", "the same to the left"},
    {"vz", "m/s", "the same upwards"},
    {"speed", "m/s", "size of the velocity"},
    {"spin", "rad/s", "spin with its sign", true},
    {"axis_x", "1", "direction of the axle, forwards", true},
    {"axis_y", "1", "the same to the left", true},
    {"axis_z", "1", "the same upwards", true},
    {"pull", "m/s^2", "acceleration by the string in the last step"},
    {"taut", "1", "1 on the taut string, else 0"},
    {"flying", "1", "1 where it has left the string, else 0"},
    {"left", "m", "distance to the left tip"},
    {"right", "m", "distance to the right tip"},
    {"left_speed", "m/s", "speed of the left tip"},
    {"right_speed", "m/s", "speed of the right tip"},
    {"passing", "m/s", "speed of the string over the axle, towards the right tip"},
    {"slip", "m/s", "speed of the axle's surface against the string, towards the right tip", true},
    {"apart", "m", "distance between the tips"},
}};

/// A number of a law: its amplitude, or what gives it its shape.
struct LawNumber {
  std::string name, unit;
  double usual = 1.0;     ///< a usual size; a fit expects no more than some three times that
  double expected = 0.0;  ///< what a fit begins with; zero of an amplitude
  double minimum = -1e6, maximum = 1e6;

  double within(double value) const { return std::clamp(value, minimum, maximum); }

  bool operator==(const LawNumber&) const = default;
};

/// A law by a formula of numbers and of kLawVariables. The first number is its amplitude: where that is zero,
/// there is nothing.
struct Law {
  static constexpr double kLeastUsual = 1e-12;
  static constexpr std::size_t kMostNumbers = 6;  ///< of all laws of a model

  std::string name, plain;  ///< as in files, and in words
  Acts acts = Acts::kForward;
  std::vector<LawNumber> numbers;
  Formula formula;

  /// Throws std::invalid_argument that names the law, what was found and what was expected.
  Law(std::string law_name, std::string words, Acts what, const std::string& text, std::vector<LawNumber> own)
      : name(std::move(law_name)), plain(std::move(words)), acts(what), numbers(std::move(own)) {
    const std::string here = "law " + shown(name) + ": ";
    if (!is_word(name)) throw std::invalid_argument(here + "name; expected letters, digits and _");
    if (plain.empty()) plain = name;
    if (numbers.empty() || numbers.size() > kMostNumbers)
      throw std::invalid_argument(here + std::to_string(numbers.size()) + " numbers; expected 1 to " +
                                  std::to_string(kMostNumbers));
    std::vector<std::string> names;
    names.reserve(kLawVariables.size() + numbers.size());
    for (const LawVariable& variable : kLawVariables) names.emplace_back(variable.name);
    numbers.front().expected = 0.0;
    for (const LawNumber& number : numbers) {
      check(number, here + "number " + shown(number.name) + ": ");
      if (std::ranges::find(names, number.name) != names.end())
        throw std::invalid_argument(here + "number " + shown(number.name) + ": the name is taken");
      names.push_back(number.name);
    }
    try {
      formula = Formula(text, names);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(here + error.what());
    }
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (!formula.uses(kLawVariables.size() + i))
        throw std::invalid_argument(here + "number " + shown(numbers[i].name) + " is not in the formula");
    check_amplitude(here);
  }

  bool operator==(const Law& other) const {
    return name == other.name && plain == other.plain && acts == other.acts && numbers == other.numbers &&
           formula.text() == other.formula.text();
  }

  /// Whether nothing is seen of it unless the diabolo is seen to turn, and its axle with it.
  bool by_spin() const {
    if (acts == Acts::kLift || acts == Acts::kSpin) return true;
    for (std::size_t i = 0; i < kLawVariables.size(); ++i)
      if (kLawVariables[i].by_spin && formula.uses(i)) return true;
    return false;
  }

  /// A negative amplitude is against it.
  bool positive() const { return numbers.front().minimum >= 0.0; }

 private:
  static bool is_word(const std::string& text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    });
  }
  /// Where the amplitude is zero there must be nothing: asked at some values of all variables.
  void check_amplitude(const std::string& here) const {
    for (const double variable : {0.3, -0.7, 2.0}) {
      const double size = formula.value<double>([&](std::size_t i) {
        return i < kLawVariables.size() ? variable : numbers[i - kLawVariables.size()].expected;
      });
      if (std::abs(size) > 1e-9)
        throw std::invalid_argument(here + "the formula is " + shown(size) + " where " +
                                    shown(numbers.front().name) +
                                    " is 0; expected 0, since the first number is the amplitude");
    }
  }
  static void check(const LawNumber& number, const std::string& here) {
    if (!is_word(number.name)) throw std::invalid_argument(here + "name; expected letters, digits and _");
    if (!(number.usual >= kLeastUsual && number.usual <= 1.0 / kLeastUsual))
      throw std::invalid_argument(here + "usual " + shown(number.usual) + "; expected " + shown(kLeastUsual) +
                                  " to " + shown(1.0 / kLeastUsual));
    if (!(number.minimum < number.maximum) || !std::isfinite(number.maximum - number.minimum))
      throw std::invalid_argument(here + "minimum " + shown(number.minimum) + " and maximum " +
                                  shown(number.maximum) + "; expected the one below the other");
    if (!(number.expected >= number.minimum && number.expected <= number.maximum))
      throw std::invalid_argument(here + "expected " + shown(number.expected) + "; expected within " +
                                  shown(number.minimum) + " and " + shown(number.maximum));
  }
};

/// Throws std::invalid_argument where names repeat, or there are more numbers than kMostNumbers.
inline void check_laws(const std::vector<Law>& laws) {
  std::set<std::string> names;
  std::size_t numbers = 0;
  for (const Law& law : laws) {
    if (!names.insert(law.name).second)
      throw std::invalid_argument("law " + shown(law.name) + ": the name is there twice");
    numbers += law.numbers.size();
  }
  if (numbers > Law::kMostNumbers)
    throw std::invalid_argument("laws: " + std::to_string(numbers) + " numbers; expected at most " +
                                std::to_string(Law::kMostNumbers) + " of all laws together");
}

}  // namespace diabolo
