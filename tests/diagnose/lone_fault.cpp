// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/lone_fault.hpp"

#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"

#include "claimed.hpp"
#include "played.hpp"

using namespace diabolo;

namespace {

constexpr int kLengthAt = index_of(Unknown::kStringLength), kScaleAt = index_of(Unknown::kLengthScale);

/// Windows that see the string's length and the scale of lengths nearly alike, where they are off by so many
/// of their usual sizes.
Fit seen_alike(double length, double scale) {
  Fit fit;
  UnknownVector truth = UnknownVector::Zero();
  truth[kLengthAt] = length;
  truth[kScaleAt] = scale;
  for (int w = 0; w < 40; ++w) {
    UnknownVector seen = UnknownVector::Zero();
    seen[kLengthAt] = 20.0;
    seen[kScaleAt] = 20.0 * (1.45 + 1e-3 * (w % 5 - 2));
    WindowScore score;
    score.information = seen * seen.transpose();
    score.score = score.information * truth;
    fit.scores.push_back(std::move(score));
  }
  return fit;
}

/// What is fitted along, as find() leaves it.
Diagnosis fitted_along() {
  Diagnosis d;
  for (const Candidate& candidate : candidates()) {
    if (candidate.kind != CandidateKind::kMeasurement || candidate.unknowns.empty()) continue;
    Finding f;
    f.candidate = &candidate;
    d.findings.push_back(f);
  }
  return d;
}

Diagnosis asked(const Fit& fit) {
  Diagnosis d = fitted_along();
  claim_lone_fault(d, Evidence(fit), nuisances());
  return d;
}

/// Play with friction, its diabolo recorded so far off its centre, in its own frame [m].
Recording off_centre(const Vector3<double>& offset) {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.15;
  Recording r = played(effects, 14.0, 71);
  for (Eigen::Index i = 0; i < r.time.size(); ++i) {
    const Eigen::Vector4d q = r.diabolo_orientation.quaternion.col(i);
    r.diabolo.position.col(i) += Eigen::Quaterniond(q) * Eigen::Vector3d(offset[0], offset[1], offset[2]);
  }
  return r;
}

}  // namespace

TEST_CASE("of faults that share what one of them does, the one is claimed that needs no other") {
  const Estimates shared = estimates_of(Evidence(seen_alike(0.0, 3.0)), nuisances());
  for (const std::string_view name : {"length_scale", "string_length"})  // of neither is a fit of both sure
    CHECK_FALSE(speaks_for(candidate_of(name), significance(candidate_of(name), shared)));
  const Diagnosis scale = asked(seen_alike(0.0, 3.0));
  const Finding* found = claimed(scale, "length_scale");
  REQUIRE(found != nullptr);
  CHECK(found->estimate[kScaleAt] == Approx(0.03).margin(0.006));
  CHECK(found->z > kSignificanceOfFault);
  CHECK(scale.findings.front().candidate == found->candidate);
}

TEST_CASE("faults within their floors are not claimed, alone or together") {
  for (const auto& [length, scale] : {std::pair(0.0, 0.0), {0.35, 0.0}, {0.0, 0.25}, {0.3, 0.2}})
    for (const Finding& f : asked(seen_alike(length, scale)).findings) CHECK_FALSE(f.claimed);
}

TEST_CASE("a centre that lies 16 mm off its axle is told, and not taken for noise") {
  const Diagnosis d = diagnose({off_centre({0.0, 0.016, 0.0})});
  CAPTURE(d.sentence);
  const Finding* marker = claimed(d, "marker_offset");
  REQUIRE(marker != nullptr);
  CHECK(marker->estimate[index_of(Unknown::kMarkerY)] == Approx(0.016).margin(5e-4));
  const Finding* friction = claimed(d, "string_friction");
  REQUIRE(friction != nullptr);
  CHECK(friction->estimate[index_of(Unknown::kFriction)] == Approx(0.15).margin(0.02));
}

TEST_CASE("a centre that lies 16 mm along its axle is told, or tips as far fore or aft") {
  const Diagnosis d = diagnose({off_centre({0.016, 0.0, 0.0})});
  CAPTURE(d.sentence);
  const Finding *marker = claimed(d, "marker_offset"), *tips = claimed(d, "stick_tip_offset");
  REQUIRE((marker != nullptr || tips != nullptr));
  if (tips != nullptr && marker == nullptr)
    CHECK(d.sentence.find(candidate_of("marker_offset").plain) != std::string::npos);
}
