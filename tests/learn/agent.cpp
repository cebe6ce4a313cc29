// SPDX-License-Identifier: MIT
#include "diabolo/learn/agent.hpp"

#include <cmath>

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;

namespace {

constexpr Eigen::Index kSeen = static_cast<Eigen::Index>(kObservationSize);

Layer layer(Random& random, Eigen::Index outputs, Eigen::Index inputs) {
  const auto drawn = [&] { return static_cast<float>(random.uniform(-0.5, 0.5)); };
  return {Eigen::MatrixXf::NullaryExpr(outputs, inputs, drawn), Eigen::VectorXf::NullaryExpr(outputs, drawn)};
}

}  // namespace

TEST_CASE("a policy is its layers with tanh between them, cut off") {
  Random random(2406);
  const Policy policy({layer(random, 7, kSeen), layer(random, 6, 7)});
  const Eigen::MatrixXf seen =
      Eigen::MatrixXf::NullaryExpr(kSeen, 5, [&] { return static_cast<float>(random.uniform(-4.0, 4.0)); });
  const Eigen::MatrixXf done = policy.act(seen);
  REQUIRE(done.rows() == 6);
  REQUIRE(done.cols() == 5);
  bool cut_off = false;
  for (Eigen::Index k = 0; k < 5; ++k)
    for (Eigen::Index out = 0; out < 6; ++out) {
      const Layer &first = policy.layers()[0], &second = policy.layers()[1];
      double sum = second.bias[out];
      for (Eigen::Index j = 0; j < 7; ++j) {
        double hidden = first.bias[j];
        for (Eigen::Index i = 0; i < kSeen; ++i)
          hidden += static_cast<double>(first.weights(j, i)) * static_cast<double>(seen(i, k));
        sum += static_cast<double>(second.weights(out, j)) * std::tanh(hidden);
      }
      cut_off = cut_off || std::abs(sum) > 1.0;
      CHECK(done(out, k) == Approx(std::clamp(sum, -1.0, 1.0)).margin(1e-4));
    }
  CHECK(cut_off);
}

TEST_CASE("layers that do not fit are refused") {
  Random random(2407);
  CHECK_THROWS_WITH(Policy({}), "layers: 0 outputs; expected 6");
  CHECK_THROWS_WITH(Policy({layer(random, 5, kSeen)}), "layers: 5 outputs; expected 6");
  CHECK_THROWS_WITH(Policy({layer(random, 5, kSeen), layer(random, 6, 4)}),
                    "layer 1: 6 x 4 weights and 6 biases; expected 5 inputs, and a bias for each output");
  Layer broken = layer(random, 6, kSeen);
  broken.weights(1, 2) = NAN;
  CHECK_THROWS_WITH(Policy({broken}), "layer 0: a number that is not finite; expected finite ones");
}
