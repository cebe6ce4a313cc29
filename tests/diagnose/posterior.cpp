// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/posterior.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"

#include "played.hpp"

using namespace diabolo;

namespace {

const Diagnosis& diagnosed() {
  static const Diagnosis once = [] {
    AllEffects<double> effects;
    effects.get<StringFriction>().coefficient = 0.3;
    DiagnosisOptions options;
    options.bank = {"string_friction", "air_drag_linear", "spin_drag"};
    return diagnose({played(effects, 14.0, 8)}, options);
  }();
  return once;
}

const Finding& found(std::string_view name) {
  for (const Finding& f : diagnosed().findings)
    if (f.candidate->name == name) return f;
  throw std::invalid_argument("not asked");
}

double friction_of(const Model& model) { return model.effects.get<StringFriction>().coefficient; }

}  // namespace

TEST_CASE("models that are drawn spread as the interval of what was found does") {
  const Finding& friction = found("string_friction");
  REQUIRE(friction.claimed);
  const int u = index_of(friction.candidate->unknowns.front());
  constexpr std::size_t kCount = 4000;
  double sum = 0.0, squares = 0.0;
  for (const Model& model : Posterior(diagnosed(), 0.0).draw(kCount, 1)) {
    const double off = (friction_of(model) - friction.estimate[u]) / friction.deviation[u];
    sum += off / kCount;
    squares += off * off / kCount;
    CHECK(model.effects.get<Air>().linear_drag == diagnosed().model.effects.get<Air>().linear_drag);
  }
  CHECK(std::abs(sum) < 0.1);
  CHECK(squares == Approx(1.0).epsilon(0.1));
}

TEST_CASE("what is not claimed may be there, as large as is not excluded") {
  const Finding& drag = found("air_drag_linear");
  REQUIRE(!drag.claimed);
  const int u = index_of(drag.candidate->unknowns.front());
  const double limit = std::abs(drag.estimate[u]) + 4.0 * drag.deviation[u];
  std::size_t with_drag = 0, with_loss = 0;
  const std::vector<Model> models = Posterior(diagnosed(), 1.0).draw(400, 2);
  for (const Model& model : models) {
    const double own = model.effects.get<Air>().linear_drag;
    CHECK(own >= 0.0);
    CHECK(own < limit);
    with_drag += own > 0.0 ? 1 : 0;
    with_loss += model.effects.get<SpinLoss>().air > 0.0 ? 1 : 0;
    CHECK(friction_of(model) > 0.2);
  }
  CHECK(with_drag > 40);
  CHECK(with_loss > 40);
}

TEST_CASE("the same seed draws the same models, and without a fit there is only the one") {
  const Posterior posterior(diagnosed());
  const std::vector<Model> once = posterior.draw(5, 3), again = posterior.draw(5, 3);
  for (std::size_t i = 0; i < 5; ++i) CHECK(friction_of(once[i]) == friction_of(again[i]));
  CHECK(friction_of(once[0]) != friction_of(once[1]));
  Diagnosis empty;
  empty.model.parameters.gravity = 7.0;
  for (const Model& model : Posterior(empty).draw(3, 1)) CHECK(model.parameters.gravity == 7.0);
}
