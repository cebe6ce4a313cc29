// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/math/scalar.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A formula such as "k * speed^2 * sin(2 * pi * f * t)" that is read once and evaluated in any Scalar,
/// without the heap. It knows numbers, the given names, pi, + - * / ^, parentheses, and abs cos exp log max
/// min sign sin sqrt tanh. It is finite wherever it is asked: a divisor counts as 1e-9 at least (with its
/// sign), a root and a logarithm as that of 1e-12 at least, a power that is no whole number is that of 1e-12
/// at least, exp that of 50 at most, the whole lies within +-1e6.
class Formula {
 public:
  static constexpr std::size_t kLongest = 128;  ///< steps of an evaluation
  static constexpr std::size_t kDeepest = 12;   ///< numbers that wait for their operator

  Formula() = default;

  /// Throws std::invalid_argument that tells the place in the text, what was found and what was expected.
  Formula(std::string_view text, const std::vector<std::string>& names) : text_(text), names_(&names) {
    sum();
    if (!at_end()) fail("an operator, or the end");
    names_ = nullptr;
  }

  const std::string& text() const { return text_; }

  /// Whether the name of that index is in it.
  bool uses(std::size_t name) const {
    return std::ranges::any_of(
        steps_, [&](const Step& step) { return step.code == Code::kName && step.name == name; });
  }

  /// The value where name number i is `of(i)`.
  template <class Scalar, class Values>
  Scalar value(const Values& of) const {
    std::array<Scalar, kDeepest> stack;
    std::size_t size = 0;
    for (const Step& step : steps_) {
      if (step.code == Code::kNumber)
        stack[size++] = Scalar(step.number);
      else if (step.code == Code::kName)
        stack[size++] = of(step.name);
      else if (step.code < Code::kAdd)
        stack[size - 1] = changed<Scalar>(step, stack[size - 1]);
      else
        --size, stack[size - 1] = joined<Scalar>(step.code, stack[size - 1], stack[size]);
    }
    const Scalar result = size == 1 ? stack[0] : Scalar(0);
    return select(is_finite(result), minimum(maximum(result, Scalar(-kMost)), Scalar(kMost)), Scalar(0));
  }

 private:
  static constexpr double kMost = 1e6, kLeastDivisor = 1e-9, kLeastRoot = 1e-12, kMostExponent = 50.0;

  /// What takes none, one and two numbers.
  enum class Code : std::uint8_t {
    kNumber,
    kName,
    kMinus,
    kWhole,
    kAbs,
    kCos,
    kExp,
    kLog,
    kSign,
    kSin,
    kSqrt,
    kTanh,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kMin,
    kMax
  };
  struct Step {
    Code code;
    std::uint16_t name = 0;
    double number = 0.0;
  };
  struct Function {
    std::string_view name;
    Code code;
    int arguments;
  };
  static constexpr std::array<Function, 10> kFunctions{{{"abs", Code::kAbs, 1},
                                                        {"cos", Code::kCos, 1},
                                                        {"exp", Code::kExp, 1},
                                                        {"log", Code::kLog, 1},
                                                        {"max", Code::kMax, 2},
                                                        {"min", Code::kMin, 2},
                                                        {"sign", Code::kSign, 1},
                                                        {"sin", Code::kSin, 1},
                                                        {"sqrt", Code::kSqrt, 1},
                                                        {"tanh", Code::kTanh, 1}}};

  template <class Scalar>
  static Scalar changed(const Step& step, const Scalar& x) {
    using std::cos, std::exp, std::log, std::sin, std::sqrt, std::tanh;
    switch (step.code) {
      case Code::kMinus:
        return -x;
      case Code::kWhole: {
        Scalar power(1);
        for (int i = 0; i < std::abs(static_cast<int>(step.number)); ++i) power = power * x;
        return step.number < 0.0 ? joined<Scalar>(Code::kDivide, Scalar(1), power) : power;
      }
      case Code::kAbs:
        return absolute<Scalar>(x);
      case Code::kCos:
        return cos(x);
      case Code::kExp:
        return exp(minimum(x, Scalar(kMostExponent)));
      case Code::kLog:
        return log(maximum(x, Scalar(kLeastRoot)));
      case Code::kSign:
        return select(x > Scalar(0), Scalar(1), select(x < Scalar(0), Scalar(-1), Scalar(0)));
      case Code::kSin:
        return sin(x);
      case Code::kSqrt:
        return sqrt(maximum(x, Scalar(kLeastRoot)));
      default:
        return tanh(x);
    }
  }

  template <class Scalar>
  static Scalar joined(Code code, const Scalar& a, const Scalar& b) {
    using std::exp, std::log;
    switch (code) {
      case Code::kAdd:
        return a + b;
      case Code::kSubtract:
        return a - b;
      case Code::kMultiply:
        return a * b;
      case Code::kDivide:
        return a /
               select(b < Scalar(0), minimum(b, Scalar(-kLeastDivisor)), maximum(b, Scalar(kLeastDivisor)));
      case Code::kPower: {
        const Scalar exponent = b * Scalar(log(maximum(a, Scalar(kLeastRoot))));
        return exp(minimum(exponent, Scalar(kMostExponent)));
      }
      case Code::kMin:
        return minimum(a, b);
      default:
        return maximum(a, b);
    }
  }

  // ---- reading: each takes the longest text that it can, and adds its steps ----

  void sum() {
    product();
    for (;;)
      if (take('+'))
        product(), add({Code::kAdd});
      else if (take('-'))
        product(), add({Code::kSubtract});
      else
        return;
  }

  void product() {
    factor();
    for (;;)
      if (take('*'))
        factor(), add({Code::kMultiply});
      else if (take('/'))
        factor(), add({Code::kDivide});
      else
        return;
  }

  void factor() {
    if (++nested_ > kLongest) fail("fewer signs and parentheses");
    if (take('-')) {
      factor();
      add({Code::kMinus});
    } else {
      single();
      if (take('^')) power();
    }
    --nested_;
  }

  /// A whole number as an exponent may have a base of any sign.
  void power() {
    const std::size_t before = steps_.size();
    factor();
    const bool negative = steps_.size() == before + 2 && steps_.back().code == Code::kMinus;
    const Step& first = steps_[before];
    const bool constant = first.code == Code::kNumber && (negative || steps_.size() == before + 1);
    if (constant && first.number == std::floor(first.number) && first.number <= 8.0) {
      const double exponent = negative ? -first.number : first.number;
      steps_.resize(before);
      --waiting_;
      add({Code::kWhole, 0, exponent});
    } else {
      add({Code::kPower});
    }
  }

  void single() {
    if (take('(')) {
      sum();
      expect(')');
      return;
    }
    if (at_end()) fail("a number, a name or \"(\"");
    if (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.') return number();
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    const std::string_view word = std::string_view(text_).substr(begin, at_ - begin);
    if (word.empty()) fail("a number, a name or \"(\"");
    const auto function = std::ranges::find(kFunctions, word, &Function::name);
    if (function != kFunctions.end()) return call(*function);
    if (word == "pi") return add({Code::kNumber, 0, std::numbers::pi});
    const auto name = std::ranges::find(*names_, word);
    if (name == names_->end()) {
      at_ = begin;
      std::string known;
      for (const std::string& one : *names_) known.append(known.empty() ? "" : ", ").append(one);
      fail("one of " + known + ", pi or a function");
    }
    add({Code::kName, static_cast<std::uint16_t>(name - names_->begin())});
  }

  void call(const Function& function) {
    expect('(');
    sum();
    if (function.arguments == 2) {
      expect(',');
      sum();
    }
    expect(')');
    add({function.code});
  }

  void number() {
    Step step{Code::kNumber};
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), step.number);
    if (error != std::errc() || !std::isfinite(step.number)) fail("a number that is finite");
    at_ = static_cast<std::size_t>(end - text_.data());
    add(step);
  }

  void add(const Step& step) {
    if (step.code <= Code::kName && ++waiting_ > kDeepest) fail("fewer nested operations");
    if (step.code >= Code::kAdd) --waiting_;
    steps_.push_back(step);
    if (steps_.size() > kLongest) fail("a shorter formula");
  }

  bool at_end() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ == text_.size();
  }
  bool take(char c) {
    if (at_end() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(std::string("\"") + c + "\"");
  }
  [[noreturn]] void fail(const std::string& expected) {
    const std::string found = at_end() ? "it ends" : shown(text_.substr(at_, 1)) + " is found";
    throw std::invalid_argument("formula " + shown(text_) + ", character " + std::to_string(at_ + 1) + ": " +
                                found + "; expected " + expected);
  }

  std::string text_;
  std::vector<Step> steps_;
  const std::vector<std::string>* names_ = nullptr;  // while it is read
  std::size_t at_ = 0, waiting_ = 0, nested_ = 0;
};

}  // namespace diabolo
