// SPDX-License-Identifier: MIT
#include "diabolo/paper/pull_velocity.hpp"

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

constexpr double kWhole = 1.45, kStep = 1e-3;

Spheroid<double> spheroid_at(const Vector& center, double distance) {
  const Vector half(0.0, 0.5 * distance, 0.0);
  return {center + half, center - half, kWhole};
}

const Vector kOrigin(0.0, 0.0, 1.0), kDown(0.0, 0.0, -1.0);

}  // namespace

TEST_CASE("the cap is the speed of a centre that moves inwards") {
  const Spheroid<double> before = spheroid_at(kOrigin, 0.4);
  const auto cap = [&](const Vector& shift) {
    return pull_cap(before, spheroid_at(kOrigin + shift, 0.4), kDown, kStep);
  };
  CHECK(cap({0.0, 0.0, 2e-3}) == Approx(2.0));                // upwards, against the outward normal
  CHECK(cap({0.0, 0.0, -2e-3}) == Approx(0.0).margin(1e-9));  // the diabolo is left behind
  CHECK(cap({3e-3, 0.0, 4e-3}) == Approx(5.0));               // whole speed, as published
  CHECK(cap({3e-3, 0.0, -4e-3}) == Approx(0.0).margin(1e-9));
  CHECK(cap(Vector::Zero()) == 0.0);
}

TEST_CASE("the cap adds the speed at which the semi-minor axis shrinks") {
  const Spheroid<double> before = spheroid_at(kOrigin, 0.4), wider = spheroid_at(kOrigin, 0.41);
  const double shrinking = before.semi_minor() - wider.semi_minor();
  REQUIRE(shrinking > 0.0);
  CHECK(pull_cap(before, wider, kDown, kStep) == Approx(shrinking / kStep));
  CHECK(pull_cap(wider, before, kDown, kStep) == 0.0);
  const Spheroid<double> both = spheroid_at(kOrigin + Vector(0.0, 0.0, 2e-3), 0.41);
  CHECK(pull_cap(before, both, kDown, kStep) == Approx(shrinking / kStep + 2.0));
}

TEST_CASE("the pull is the damped displacement along the normal, capped, and never pushes outwards") {
  Random random(40);
  for (int i = 0; i < 300; ++i) {
    const Vector displacement = random.vector(0.01), normal = random.direction();
    const double scale = random.unit(), limit = random.uniform(0.0, 2.0);
    const Vector pull = capped_pull<double>(displacement, normal, normal * -limit, kStep, scale);
    const double inward = -displacement.dot(normal) / kStep * scale;
    if (inward <= 0.0)
      CHECK(pull.norm() == 0.0);
    else if (inward < limit)
      CHECK((pull + normal * inward).norm() < 1e-12);
    else
      CHECK((pull + normal * limit).norm() < 1e-12);
  }
}

TEST_CASE("damping before the cap scales the pull, damping of the cap its limit") {
  const Vector displacement(0.0, 0.0, 1e-3), normal = kDown;
  const Vector free_cap = normal * -1e3;
  CHECK(capped_pull<double>(displacement, normal, free_cap, kStep, 1.0).z() == Approx(1.0));
  CHECK(capped_pull<double>(displacement, normal, free_cap, kStep, 0.13).z() == Approx(0.13));
  CHECK(capped_pull<double>(displacement, normal, normal * -0.05, kStep, 0.13).z() == Approx(0.05));
  CHECK(capped_pull<double>(displacement, normal, Vector::Zero(), kStep, 0.13).norm() == 0.0);
}

TEST_CASE("over a thin spheroid the paper's pull keeps only the normal of the plane of tips and world x") {
  Random random(41);
  for (int i = 0; i < 200; ++i) {
    const Vector left = random.vector(1.0), right = random.vector(1.0), pull = random.vector(2.0);
    const Vector kept = pull_across_plane(pull, left, right);
    const Vector across = Vector::UnitX().cross(left - right).normalized();
    CHECK((kept - across * across.dot(pull)).norm() < 1e-12);
    CHECK((pull_across_plane(kept, left, right) - kept).norm() < 1e-12);
    CHECK(std::abs(kept.x()) < 1e-12);
  }
}

TEST_CASE("the published pull loses its part across the vertical plane of the tips and keeps its length") {
  Random random(42);
  for (int i = 0; i < 200; ++i) {
    const Vector left = random.vector(1.0), right = random.vector(1.0), pull = random.vector(2.0);
    const Vector kept = pull_in_vertical_plane(pull, left, right);
    const Vector sideways = (left - right).cross(Vector::UnitZ()).normalized();
    CHECK(std::abs(kept.dot(sideways)) < 1e-12);
    CHECK(kept.norm() == Approx(pull.norm()).epsilon(1e-12));
    CHECK(kept.normalized().isApprox((pull - sideways * sideways.dot(pull)).normalized(), 1e-9));
  }
}

TEST_CASE("thin spheroids in odd places give finite pulls") {
  const Vector up(0.0, 0.0, 0.7), none = Vector::Zero(), along_x(0.7, 0.0, 0.0), along_y(0.0, 0.7, 0.0);
  for (const Vector& left : {up, none, along_x, along_y})
    for (const Vector& pull : {none, up, along_x, along_y}) {
      const Vector right = -left;
      CHECK(pull_across_plane(pull, left, right).allFinite());
      CHECK(pull_in_vertical_plane(pull, left, right).allFinite());
      CHECK(pull_in_vertical_plane(pull, left, right).norm() <= pull.norm() * (1.0 + 1e-12));
    }
}
