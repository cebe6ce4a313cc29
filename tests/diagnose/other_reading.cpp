// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/other_reading.hpp"

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/diagnosis.hpp"

#include "claimed.hpp"
#include "played.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

TEST_CASE(
    "of a play that runs backwards nothing is concluded, whether it is seen which stick is which or not") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  const Recording forwards = played(effects, 14.0, 2), backwards = with_time_reversed(forwards);
  CHECK(claimed(diagnose({forwards}), "string_friction") != nullptr);
  CHECK(with_time_reversed(backwards).diabolo.position == forwards.diabolo.position);
  CHECK(with_time_reversed(backwards).time.isApprox(forwards.time));
  CHECK(backwards.diabolo_orientation.quaternion.col(0) ==
        forwards.diabolo_orientation.quaternion.col(forwards.size() - 1));
  Recording told = backwards;  // sticks that point forwards tell which is which
  told.left_orientation = told.right_orientation = OrientationTrack::missing(told.size());
  for (OrientationTrack* track : {&told.left_orientation, &told.right_orientation}) {
    track->quaternion.colwise() = Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
    track->valid.setConstant(true);
  }
  for (const Recording& recording : {backwards, told}) {
    const Diagnosis d = diagnose({recording});
    CAPTURE(d.sentence);
    CHECK(d.headline == Headline::kInsufficientData);
    CHECK_THAT(d.reason, Contains("time seems to run backwards"));
    CHECK(d.findings.empty());
  }
}

TEST_CASE("what drives a play forwards is no time that runs backwards") {
  AllEffects<double> effects;
  FormulaLaws<double> driving({Law("motor", "a motor", Acts::kAlong, "size * taut * tanh(slip / 0.05)",
                                   {{"size", "m/s^2", 0.5, 0.0, -100.0, 100.0}})});
  driving.numbers[0] = 1.0;
  effects.get<FormulaLaws>() = driving;
  const Diagnosis d = diagnose({played(effects, 14.0, 2)});
  CAPTURE(d.sentence);
  CHECK(d.headline != Headline::kInsufficientData);
}
