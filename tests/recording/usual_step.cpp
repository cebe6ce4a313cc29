// SPDX-License-Identifier: MIT
#include "diabolo/recording/usual_step.hpp"

#include <random>

#include "catch.hpp"

using namespace diabolo;

TEST_CASE("Even times step by what they step by, whatever their number") {
  for (const Eigen::Index size : {2, 3, 10, 5000}) {
    CAPTURE(size);
    const Eigen::VectorXd time =
        Eigen::VectorXd::LinSpaced(size, 5.0, 5.0 + static_cast<double>(size - 1) / 119.88);
    CHECK(usual_step(time) == Approx(1.0 / 119.88).epsilon(1e-3));
  }
}

TEST_CASE("The step is found where three of four rows are missing and the median is three steps") {
  std::mt19937 generator(8);
  std::bernoulli_distribution is_there(0.25);
  std::normal_distribution<double> jitter(0.0, 0.5e-3);
  std::vector<double> stamps;
  for (int i = 0; i < 2000; ++i)
    if (is_there(generator)) stamps.push_back(0.01 * i + jitter(generator));
  const Eigen::VectorXd time = Eigen::Map<const Eigen::VectorXd>(stamps.data(), std::ssize(stamps));
  CHECK(median_step(time) > 0.018);
  CHECK(usual_step(time) == Approx(0.01).epsilon(0.01));
}

TEST_CASE("A pattern of missing rows is no step, however long it lasts") {
  for (const int size : {900, 1500, 4000}) {
    std::vector<double> stamps{0.0};
    for (int i = 2; std::ssize(stamps) < size; ++i)
      if (i % 3 != 1) stamps.push_back(i / 120.0);
    CAPTURE(size);
    CHECK(usual_step(Eigen::Map<const Eigen::VectorXd>(stamps.data(), size)) ==
          Approx(1.0 / 120.0).epsilon(1e-3));
  }
}
