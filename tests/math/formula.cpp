// SPDX-License-Identifier: MIT
#include "diabolo/math/formula.hpp"

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "diabolo/math/dual.hpp"

#include "catch.hpp"

using namespace diabolo;

namespace {

const std::vector<std::string> kNames{"a", "b", "c"};

double value(const std::string& text, std::array<double, 3> x = {2.0, -3.0, 0.5}) {
  return Formula(text, kNames).value<double>([&](std::size_t i) { return x[i]; });
}

std::string complaint(const std::string& text) {
  try {
    Formula(text, kNames);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("a formula means what it means on paper") {
  CHECK(value("1 + 2 * 3") == 7.0);
  CHECK(value("(1 + 2) * 3") == 9.0);
  CHECK(value("8 / 4 / 2") == 1.0);
  CHECK(value("5 - 2 - 1") == 2.0);
  CHECK(value("2^3^2") == Approx(512.0));
  CHECK(value("-2^2") == -4.0);
  CHECK(value("b^2") == 9.0);
  CHECK(value("b^3") == -27.0);
  CHECK(value("a^-2") == 0.25);
  CHECK(value("a^c") == Approx(std::sqrt(2.0)));
  CHECK(value("a*-b") == 6.0);
  CHECK(value("max(a, b) + min(a, b)") == -1.0);
  CHECK(value("sign(b) * abs(b) + sqrt(4)") == -1.0);
  CHECK(value("sin(pi / 2) + cos(0) + exp(0) + log(1) + tanh(0)") == Approx(3.0));
  CHECK(value(" 1.5e1 ") == 15.0);
}

TEST_CASE("a formula is finite wherever it is asked") {
  for (const char* text : {"1 / 0", "0 / 0", "sqrt(-1)", "log(0)", "log(-1)", "exp(1e9)", "0^-1", "b^c",
                           "exp(50)^8 - exp(50)^8", "exp(50)^8 / exp(50)^8 - exp(exp(50))^8"}) {
    CAPTURE(text);
    CHECK(std::isfinite(value(text)));
    CHECK(std::abs(value(text)) <= 1e6);
  }
}

TEST_CASE("its derivatives are those of its values") {
  using ThreeDual = Dual<double, 3>;
  const unsigned seed = 51;
  CAPTURE(seed);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> draw(0.3, 2.0);
  for (const char* text : {"a * b^2 * sin(2 * pi * c)", "a^b / (c + 1)", "exp(-a * b) * sqrt(c)",
                           "tanh(a - b) * abs(b - c) * log(a)", "b^-3 + max(a, a * a)", "a^(b + c)"}) {
    CAPTURE(text);
    const Formula formula(text, kNames);
    const std::array<double, 3> x{draw(generator), draw(generator), draw(generator)};
    const ThreeDual dual = formula.value<ThreeDual>([&](std::size_t i) {
      ThreeDual d(x[i]);
      d.gradient[static_cast<Eigen::Index>(i)] = 1.0;
      return d;
    });
    CHECK(dual.value == Approx(value(text, x)));
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<double, 3> more = x, less = x;
      more[i] += 1e-6;
      less[i] -= 1e-6;
      CHECK(dual.gradient[static_cast<Eigen::Index>(i)] ==
            Approx((value(text, more) - value(text, less)) / 2e-6).margin(1e-7).epsilon(1e-5));
    }
  }
}

TEST_CASE("what is no formula is told with its place") {
  CHECK(complaint("a +") == "formula \"a +\", character 4: it ends; expected a number, a name or \"(\"");
  CHECK(complaint("a b") == "formula \"a b\", character 3: \"b\" is found; expected an operator, or the end");
  CHECK(complaint("2 * d") ==
        "formula \"2 * d\", character 5: \"d\" is found; expected one of a, b, c, pi or a function");
  CHECK(complaint("sin a") == "formula \"sin a\", character 5: \"a\" is found; expected \"(\"");
  CHECK(complaint("max(a)") == "formula \"max(a)\", character 6: \")\" is found; expected \",\"");
  CHECK(complaint("1e999") ==
        "formula \"1e999\", character 1: \"1\" is found; expected a number that is finite");
  CHECK(complaint("") == "formula \"\", character 1: it ends; expected a number, a name or \"(\"");
  CHECK(complaint(std::string(100000, '(')).find("expected fewer signs and parentheses") !=
        std::string::npos);
  CHECK(complaint(std::string(1000, '-').append("a")).find("expected fewer signs") != std::string::npos);
  std::string deep = "a", longer = "a";
  for (int i = 0; i < 20; ++i) deep = std::string("a + (").append(deep).append(")");
  for (int i = 0; i < 200; ++i) longer.append(" + a");
  CHECK(complaint(deep).find("expected fewer nested operations") != std::string::npos);
  CHECK(complaint(longer).find("expected a shorter formula") != std::string::npos);
}
