// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/candidates.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include "catch.hpp"
#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/fit_model.hpp"

using namespace diabolo;

namespace {

bool asks(double gravity, const std::vector<std::string>& names, std::string_view name) {
  Parameters<double> base;
  base.gravity = gravity;
  const Bank bank = bank_for(base, names);
  return std::ranges::any_of(bank, [&](const Candidate* candidate) { return candidate->name == name; });
}

}  // namespace

TEST_CASE("the bank asks for the gravity or the scale of lengths, which no motion tells apart") {
  CHECK(asks(kStandardGravity, {}, "length_scale"));
  CHECK_FALSE(asks(kStandardGravity, {}, "gravity_magnitude"));
  CHECK(asks(7.0, {}, "gravity_magnitude"));
  CHECK_FALSE(asks(7.0, {}, "length_scale"));
}

TEST_CASE("a bank that names the scale of lengths keeps it") {
  CHECK(asks(kStandardGravity, {"length_scale"}, "length_scale"));
  CHECK(asks(7.0, {"length_scale"}, "length_scale"));
  CHECK_FALSE(asks(7.0, {"length_scale"}, "gravity_magnitude"));
}

TEST_CASE("each law of an effect is a candidate of unknowns that are its fields") {
  std::set<std::string_view> names, fields;
  for (const UnknownInfo& info : kUnknownInfos) {
    CAPTURE(info.name);
    CHECK(fields.insert(info.name).second);
    CHECK(info.scale > 0.0);
    CHECK(info.minimum < info.maximum);
  }
  for (const Candidate& candidate : candidates()) {
    CAPTURE(candidate.name);
    CHECK(names.insert(candidate.name).second);
    CHECK_FALSE(candidate.plain.empty());
    CHECK(candidate.unknowns.size() + (candidate.name == "body_swap") > 0);
  }
  for (const NamedLaw& law : diagnose_detail::named_laws()) {
    const Candidate& candidate = candidate_of(law.name);
    CHECK(info_of(first_of(candidate)).name == law.amplitudes.front());
    CHECK(candidate.direction == law.direction);
    CHECK(candidate.companions.size() ==
          static_cast<std::size_t>(2 - std::ranges::count(law.companions, "")));
  }
}

TEST_CASE("a fit and the model that comes of it hold the same physics") {
  Recording recording;
  recording.string_length = 1.45;
  Model base = consistent_model();
  base.effects.get<Air>().linear_drag = 0.02;
  UnknownVector at = UnknownVector::Zero();
  for (int u = 0; u < index_of(Unknown::kOwn); ++u)
    if (u != index_of(Unknown::kLengthScale)) at[u] = info_of(static_cast<Unknown>(u)).scale;
  using D = diagnose_detail::FitDual;
  const diagnose_detail::DualUnknowns<D> x(at, ActiveSet::Constant(true));
  const diagnose_detail::FitModel<D> fitted = diagnose_detail::fit_model(base, recording, x);
  const Model model = augmented_model(base, at, "augmented");
  std::map<Unknown, double> in_model;
  for_each_unknown(model.effects, [&](Unknown u, double field) { in_model[u] = field; });
  for_each_unknown(fitted.effects, [&](Unknown u, const D& field) {
    const UnknownInfo& info = info_of(u);
    CAPTURE(info.name);
    CHECK(field.value != 0.0);
    CHECK(field.gradient[kStartUnknowns + index_of(u)] == Approx(info.scale));
    if (in_model.contains(u)) CHECK(field.value == in_model[u]);  // (LatentForce is in no model)
  });
  CHECK(model.effects.get<Air>().linear_drag == 0.02 + info_of(Unknown::kLinearDrag).scale);
}

TEST_CASE("what counts only beside something is left out of the model without it") {
  UnknownVector at = UnknownVector::Zero();
  at[index_of(Unknown::kSpinGain)] = at[index_of(Unknown::kDamping)] = 5.0;
  const Model without = augmented_model(consistent_model(), at, "without");
  CHECK(without.effects.get<StringFriction>().spin_gain == 0.0);
  CHECK(without.effects.get<StringElasticity>().damping == 0.0);
  at[index_of(Unknown::kFriction)] = 0.1;
  CHECK(augmented_model(consistent_model(), at, "with").effects.get<StringFriction>().spin_gain == 5.0);
}

TEST_CASE("forms that no law has are asked about by name alone") {
  CHECK_FALSE(asks(kStandardGravity, {}, "placebo_drag"));
  CHECK(asks(kStandardGravity, {"placebo_drag"}, "placebo_drag"));
  CHECK_FALSE(asks(kStandardGravity, {"placebo_drag"}, "placebo_push"));
}
