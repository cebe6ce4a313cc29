// SPDX-License-Identifier: MIT
#include "diabolo/json/agent_file.hpp"

#include "catch.hpp"
#include "random.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

Agent drawn_agent() {
  Random random(2408);
  constexpr Eigen::Index kSeen = static_cast<Eigen::Index>(kObservationSize);
  const auto drawn = [&] { return static_cast<float>(random.uniform(-0.5, 0.5)); };
  return {{"SpinUp"},
          0.02,
          20,
          Policy({{Eigen::MatrixXf::NullaryExpr(6, kSeen, drawn), Eigen::VectorXf::NullaryExpr(6, drawn)}})};
}

/// What is said of the file of an agent in which one piece of text stands for another.
std::string agent_complaint(const std::string& what, const std::string& by) {
  std::string text = write_agent(drawn_agent());
  const std::size_t place = text.find(what);
  REQUIRE(place != std::string::npos);
  text.replace(place, what.size(), by);
  return complaint([&] { read_agent(text, "a.json"); });
}

}  // namespace

TEST_CASE("an agent reads back as it was written, bit for bit") {
  const Agent agent = drawn_agent(), again = read_agent(write_agent(agent), "a.json");
  CHECK(again.tasks == agent.tasks);
  CHECK(again.period == agent.period);
  CHECK(again.steps == agent.steps);
  CHECK(again.policy.layers()[0].weights == agent.policy.layers()[0].weights);
  CHECK(again.policy.layers()[0].bias == agent.policy.layers()[0].bias);
  CHECK(write_agent(again) == write_agent(agent));
}

TEST_CASE("an agent of several tasks that corrects plans reads back as well") {
  Agent agent = drawn_agent();
  agent.tasks = {"Hop", "Throw"};
  agent.corrects = true;
  const std::size_t seen = observation_size(seen_too(agent.tasks, true));
  CHECK(seen == kObservationSize + 2 + kPlanSize);
  agent.policy =
      Policy({{Eigen::MatrixXf::Ones(6, static_cast<Eigen::Index>(seen)), Eigen::VectorXf::Zero(6)}}, seen);
  const std::string text = write_agent(agent);
  const Agent again = read_agent(text, "a.json");
  CHECK(again.tasks == agent.tasks);
  CHECK(again.corrects);
  const auto told = [&](const std::string& what, const std::string& by) {
    std::string other = text;
    return complaint([&] { read_agent(other.replace(other.find(what), what.size(), by), "a.json"); });
  };
  CHECK(told("true", "1") == "a.json: field \"corrects\" is 1; expected true");
  CHECK(told(R"("Hop","Throw")", R"("Hop","Hop")") == "a.json: task: Hop twice; expected each once");
  CHECK(told(R"("Hop","Throw")", "3").find("expected a name, or a list of names") != std::string::npos);
  CHECK(told(R"("Hop","Throw")", R"("Hop")").find("expected " + std::to_string(seen - 2) + " inputs") !=
        std::string::npos);
}

TEST_CASE("an agent of few decimals is nearly the same, in a smaller file") {
  const Agent agent = drawn_agent(), again = read_agent(write_agent(agent, 3), "a.json");
  CHECK((again.policy.layers()[0].weights - agent.policy.layers()[0].weights).cwiseAbs().maxCoeff() <
        5.1e-4f);
  CHECK(write_agent(again, 3) == write_agent(agent, 3));
  CHECK(2 * write_agent(agent, 3).size() < write_agent(agent).size());
  CHECK_THROWS_WITH(write_agent(agent, 0), "decimals: 0; expected 1 to 6");
  CHECK(agent_complaint("\"layers\"", "\"unit\":0,\"layers\"").find("unit") != std::string::npos);
}

TEST_CASE("what is no agent is told with its file and field") {
  CHECK(agent_complaint("SpinUp", "Fly").starts_with("a.json: task: found \"Fly\"; expected one of Hold"));
  CHECK(agent_complaint("0.02", "3") == "a.json: period: 3 s; expected 0.001 to 0.1 s");
  CHECK(agent_complaint("\"steps\":20", "\"steps\":2.5") ==
        "a.json: field \"steps\" is 2.5; expected a whole number up to 1000");
  CHECK(agent_complaint("\"bias\":[", "\"bias\":[0.0,") ==
        "a.json: layer 0: 6 x " + std::to_string(kObservationSize) + " weights and 7 biases; expected " +
            std::to_string(kObservationSize) + " inputs, and a bias for each output");
  CHECK(agent_complaint("],[", ",0.0],[").find("expected rows of the same length") != std::string::npos);
  CHECK(agent_complaint("\"weights\":[[", "\"weights\":[[\"a\",").find("expected numbers") !=
        std::string::npos);
  CHECK(agent_complaint("\"bias\":[", "\"bias\":[null,").find("expected numbers") != std::string::npos);
  CHECK(agent_complaint("\"layers\"", "\"lairs\"") == "a.json: unknown field \"lairs\"");
  CHECK(complaint([] { read_agent("{", "a.json"); }).starts_with("a.json"));
}
