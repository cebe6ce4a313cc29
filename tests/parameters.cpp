// SPDX-License-Identifier: MIT
#include "diabolo/parameters.hpp"

#include <limits>
#include <set>
#include <string>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

using Numbers = Parameters<double>;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// The message that validation gives once field number `index` has been set; empty when it is content.
std::string complaint(int index, double value) {
  Numbers parameters;
  int i = 0;
  Numbers::for_each(parameters, [&](const ParameterInfo&, double& field) {
    if (i++ == index) field = value;
  });
  try {
    parameters.validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEMPLATE_TEST_CASE("the presets are valid", "", double, float, (Dual<double, 2>), (Pack<double, 4>)) {
  CHECK_NOTHROW(Parameters<TestType>::consistent().validate());
  CHECK_NOTHROW(Parameters<TestType>::paper().validate());
  CHECK_NOTHROW(Parameters<TestType>::published().validate());
}

TEST_CASE("the published preset is the recipe of the published evaluation") {
  const Numbers p = Numbers::published();
  CHECK(p.string_length == 1.46);
  CHECK(p.gravity == 9.8);
  CHECK(p.axle_radius == 0.0065);
  CHECK(p.pull.pull_scale == 0.13);
  CHECK(p.pull.cap_scale == 0.13);
  CHECK(p.pull.pull_scale_after_cap == 0.07);
  CHECK(std::exp(-p.dissipation_rate * p.pull.reference_step) == Approx(0.9999).epsilon(1e-15));
  CHECK(p.spin_coupling * p.pull.reference_step == Approx(0.00015));
  CHECK(p.catch_slack == 0.03);
  CHECK(p.catch_distance == 0.10);
  CHECK(p.pull.thin_slack == 0.03);
  CHECK(p.pull.per_step);
  CHECK(p.pull.release_when_overstretched);
  CHECK(p.string_law == StringLaw::kPullVelocity);
  CHECK(p.pull.projection == Projection::kRadial);
  CHECK(p.pull.normal_rule == NormalRule::kPublished);
  CHECK(p.pull.flight_rule == FlightRule::kPublished);
  CHECK(p.pull.thin_rule == ThinRule::kPublished);
  CHECK(p.pull.spin_rule == SpinRule::kSlip);
  CHECK(p.pull.integrator == Integrator::kParabolic);
}

TEST_CASE("the paper's preset is the paper's text") {
  const Numbers p = Numbers::paper();
  CHECK(p.string_length == 1.45);
  CHECK(p.loose_distance == 0.01);
  CHECK(p.flying_distance == 0.05);
  CHECK(p.pull.thin_slack == 0.05);
  CHECK(p.pull.mu_acceleration == 154.0);
  CHECK(p.pull.mu_deceleration == 154.0);
  CHECK(p.string_law == StringLaw::kPullVelocity);
  CHECK(p.pull.projection == Projection::kClosestPoint);
  CHECK(p.pull.normal_rule == NormalRule::kTrue);
  CHECK(p.pull.flight_rule == FlightRule::kPaper);
  CHECK(p.pull.thin_rule == ThinRule::kPaper);
  CHECK(p.pull.spin_rule == SpinRule::kLengthChange);
  CHECK(p.pull.integrator == Integrator::kEuler);
}

TEST_CASE("the consistent preset has standard gravity and no dissipation, and its factors are rates") {
  const Numbers p = Numbers::consistent();
  CHECK(p.gravity == 9.80665);
  CHECK(p.dissipation_rate == 0.0);
  CHECK(p.string_law == StringLaw::kInextensible);
  CHECK_FALSE(p.pull.per_step);
}

TEST_CASE("every number has a name of its own, a meaning and a range that its default lies in") {
  std::set<std::string> names;
  std::size_t count = 0;
  const Numbers parameters;
  Numbers::for_each(parameters, [&](const ParameterInfo& info, const double& field) {
    names.emplace(info.name);
    ++count;
    CHECK_FALSE(info.unit.empty());
    CHECK_FALSE(info.meaning.empty());
    CHECK(info.minimum <= field);
    CHECK(field <= info.maximum);
  });
  CHECK(names.size() == count);
  CHECK(count == 18);
}

TEST_CASE("a number out of its range is refused by name, value and range") {
  int index = 0;
  const Numbers defaults;
  Numbers::for_each(defaults, [&](const ParameterInfo& info, const double&) {
    const std::string name(info.name), range = "must be within [";
    CAPTURE(name);
    const double below = info.minimum > 0.0 ? 0.5 * info.minimum : -1e-9, above = info.maximum * 1.001;
    CHECK_THAT(complaint(index, below), StartsWith(name + ": ") && Contains(range));
    CHECK_THAT(complaint(index, above), StartsWith(name + ": ") && Contains(range));
    CHECK_THAT(complaint(index, kNoNumber), StartsWith(name + ": ") && Contains("nan"));
    CHECK_THAT(complaint(index, std::numeric_limits<double>::infinity()), StartsWith(name + ": "));
    // One limit of two fields is bound by their product; the others stand by themselves.
    if (name != "spin_coupling" && name != "reference_step") CHECK(complaint(index, info.maximum).empty());
    CHECK(complaint(index, info.minimum).empty());
    ++index;
  });
  CHECK(complaint(0, 0.0) == "string_length: 0 m; must be within [0.05, 20] m");
}

TEST_CASE("slip that a published step would overshoot is refused") {
  Numbers parameters = Numbers::published();
  parameters.spin_coupling = 1e3;
  CHECK_NOTHROW(parameters.validate());
  parameters.pull.reference_step = 2e-3;
  CHECK_THROWS_WITH(parameters.validate(), Contains("spin_coupling") && Contains("reference_step"));
}

TEST_CASE("a plane needs a unit normal") {
  Numbers parameters;
  parameters.plane_normal = {1.0, 1.0, 0.0};
  CHECK_NOTHROW(parameters.validate());
  parameters.planar = true;
  CHECK_THROWS_WITH(parameters.validate(), Contains("plane_normal") && Contains("unit"));
  parameters.plane_normal = {kNoNumber, 0.0, 0.0};
  CHECK_THROWS_AS(parameters.validate(), std::invalid_argument);
  parameters.plane_normal = {0.6, 0.0, 0.8};
  CHECK_NOTHROW(parameters.validate());
}

TEST_CASE("one bad lane or one bad derivative's value is refused too") {
  Parameters<Pack<double, 4>> packed;
  packed.mass.set(3, -1.0);
  CHECK_THROWS_WITH(packed.validate(), StartsWith("mass: "));
  Parameters<Dual<double, 2>> dual;
  dual.gravity.value = kNoNumber;
  CHECK_THROWS_WITH(dual.validate(), StartsWith("gravity: "));
}

TEST_CASE("rules are carried over and compared without the numbers") {
  Parameters<float> copy;
  const Numbers published = Numbers::published();
  CHECK_FALSE(copy.same_rules(published));
  copy.copy_rules(published);
  CHECK(copy.same_rules(published));
  CHECK(copy.gravity == Parameters<float>().gravity);
  copy.planar = true;
  CHECK_FALSE(copy.same_rules(published));
}
