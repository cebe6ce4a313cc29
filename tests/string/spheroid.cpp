// SPDX-License-Identifier: MIT
#include "diabolo/string/spheroid.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "random.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

/// Tip distances over string length: coinciding, close, any, nearly taut, taut.
constexpr double kRatios[] = {0.0, 1e-12, 1e-8, 1e-4,       0.1,        0.3,        0.5,
                              0.7, 0.9,   0.99, 1.0 - 1e-3, 1.0 - 1e-6, 1.0 - 1e-9, 1.0 - 1e-12};

struct Shape {
  Vector left, right;
  double length;
  Spheroid<double> spheroid() const { return {left, right, length}; }
};

Shape random_shape(Random& random, double ratio) {
  const double length = random.uniform(0.3, 3.0);
  const Vector center = random.vector(1.0), half = random.direction() * (0.5 * ratio * length);
  return {center + half, center - half, length};
}

Shape random_shape(Random& random) { return random_shape(random, kRatios[random.index(std::size(kRatios))]); }

double path(const Shape& shape, const Vector& p) {
  return (p - shape.left).norm() + (p - shape.right).norm();
}

/// Distance from a point to the surface, found without the library: the ellipse in the plane through the axis
/// and the point, by a scan over its angle and golden-section search, in long double.
double distance_by_search(const Shape& shape, const Vector& point) {
  using Number = long double;
  const Vector center = (shape.left + shape.right) / 2.0;
  const Number a = shape.length / 2.0L, c = (shape.left - shape.right).norm() / 2.0L;
  const Number b = std::sqrt(std::max((a - c) * (a + c), 0.0L));
  const Vector axis = c > 0.0L ? Vector((shape.left - shape.right).normalized()) : Vector(Vector::UnitX());
  const Number u = axis.dot(point - center), v = (point - center - axis * axis.dot(point - center)).norm();
  const auto squared = [&](Number t) {
    const Number du = a * std::cos(t) - u, dv = b * std::sin(t) - v;
    return du * du + dv * dv;
  };
  constexpr int kScan = 200;
  const Number quarter = 3.14159265358979323846L / kScan;
  int best = 0;
  for (int i = 0; i <= kScan; ++i)
    if (squared(i * quarter) < squared(best * quarter)) best = i;
  Number low = (best - 1) * quarter, high = (best + 1) * quarter;
  const Number golden = 0.61803398874989484820L;
  for (int i = 0; i < 80; ++i) {
    const Number first = high - golden * (high - low), second = low + golden * (high - low);
    if (squared(first) < squared(second))
      high = second;
    else
      low = first;
  }
  return static_cast<double>(std::sqrt(squared((low + high) / 2.0L)));
}

/// Everything that the closest point promises, for one point. Lengths are of order 1 m: rounding of 1e-15 in
/// the coordinates appears in the path length; 1e-13 leaves room for some tens of operations. Closer to the
/// axis than 1e-12 of the semi-major axis a point counts as on it, which may cost as much in distance.
void check_closest(const Shape& shape, const Vector& point) {
  CAPTURE(shape.left.transpose(), shape.right.transpose(), shape.length, point.transpose());
  const Spheroid<double> spheroid = shape.spheroid();
  const Vector closest = spheroid.closest_point(point);
  REQUIRE(closest.allFinite());
  CHECK(path(shape, closest) == Approx(shape.length).epsilon(0).margin(1e-13 * (1.0 + shape.length)));
  const double found = (closest - point).norm(), searched = distance_by_search(shape, point);
  const double margin = 1e-12 * shape.length;
  CHECK(found == Approx(searched).epsilon(0).margin(margin));
  const double signed_distance = spheroid.signed_distance(point);
  CHECK(std::abs(signed_distance) == Approx(searched).epsilon(0).margin(margin));
  const double slack = shape.length - path(shape, point);
  if (std::abs(slack) > 1e-15 * shape.length) CHECK((signed_distance > 0.0) == (slack > 0.0));
}

}  // namespace

TEST_CASE("the tips are the foci and the string's length is the major axis") {
  Random random(10);
  for (int i = 0; i < 200; ++i) {
    const Shape shape = random_shape(random);
    const Spheroid<double> spheroid = shape.spheroid();
    const double distance = (shape.left - shape.right).norm();
    CHECK(spheroid.tip_distance() == Approx(distance).margin(1e-15));
    CHECK(spheroid.string_length() == shape.length);
    CHECK(spheroid.semi_major() == 0.5 * shape.length);
    const double a = 0.5 * shape.length, c = 0.5 * distance;
    // b^2 = a^2 - c^2 and not, as printed, a - c.
    CHECK(spheroid.semi_minor() * spheroid.semi_minor() == Approx((a - c) * (a + c)).epsilon(1e-12));
    CHECK(spheroid.center().isApprox((shape.left + shape.right) / 2.0, 1e-15));
    if (distance > 1e-9) CHECK(spheroid.axis().isApprox((shape.left - shape.right).normalized(), 1e-12));
    CHECK_FALSE(spheroid.overstretched());
    CHECK(spheroid.left() == shape.left);
    CHECK(spheroid.right() == shape.right);
  }
}

TEST_CASE("points made from the axes lie on the surface") {
  Random random(11);
  for (int i = 0; i < 500; ++i) {
    const Shape shape = random_shape(random);
    const Vector point = random.reachable(shape.spheroid(), 1.0);
    if ((shape.left - shape.right).norm() < 1e-6) continue;  // the axis of a sphere has no direction
    CHECK(shape.spheroid().path_length(point) == Approx(shape.length).epsilon(0).margin(1e-13));
  }
}

TEST_CASE("the path's gradient is its derivative, of norm 2 cos(half the angle between the strands)") {
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    const Shape shape = random_shape(random);
    const Vector point = random.vector(2.0);
    if ((point - shape.left).norm() < 0.05 || (point - shape.right).norm() < 0.05) continue;
    const Spheroid<double> spheroid = shape.spheroid();
    const Vector gradient = spheroid.path_gradient(point);
    const double h = 1e-5;  // curvature below 1 / 0.05: error h^2 / 0.05^2 = 4e-8
    for (int k = 0; k < 3; ++k) {
      const Vector step = Vector::Unit(k) * h;
      CHECK(gradient[k] ==
            Approx((path(shape, point + step) - path(shape, point - step)) / (2.0 * h)).margin(1e-7));
    }
    const double angle = std::acos(
        std::clamp((shape.left - point).normalized().dot((shape.right - point).normalized()), -1.0, 1.0));
    CHECK(gradient.norm() == Approx(2.0 * std::cos(0.5 * angle)).margin(1e-7));
    CHECK(spheroid.normal(point).norm() == Approx(1.0));
    if (gradient.norm() > 1e-6) CHECK(spheroid.normal(point).isApprox(gradient.normalized(), 1e-9));
  }
}

TEST_CASE("the normal on the surface is (x/b^2, y/a^2, z/b^2) and the published one (x/b, y/a, z/b)") {
  Random random(13);
  for (int i = 0; i < 300; ++i) {
    const Shape shape = random_shape(random, random.uniform(0.0, 0.99));
    const Spheroid<double> spheroid = shape.spheroid();
    const Vector point = random.reachable(spheroid, 1.0), offset = point - spheroid.center();
    const double a = spheroid.semi_major(), b = spheroid.semi_minor(), along = offset.dot(spheroid.axis());
    const Vector across = offset - spheroid.axis() * along;
    const Vector normal = (across / (b * b) + spheroid.axis() * (along / (a * a))).normalized();
    const Vector published = (across / b + spheroid.axis() * (along / a)).normalized();
    CHECK((spheroid.normal(point) - normal).norm() < 1e-11);
    CHECK((spheroid.published_normal(point) - published).norm() < 1e-11);
  }
}

TEST_CASE("the closest point is that of an independent search") {
  Random random(14);
  for (const double ratio : kRatios)
    for (int i = 0; i < 20; ++i) {
      const Shape shape = random_shape(random, ratio);
      const Spheroid<double> spheroid = shape.spheroid();
      const Vector anywhere = spheroid.center() + random.arrow(0.1, 2.0) * shape.length;
      check_closest(shape, anywhere);
      check_closest(shape, random.reachable(spheroid, 0.0));
      const Vector on_surface = random.reachable(spheroid, 1.0);
      check_closest(shape, on_surface);
      check_closest(shape, on_surface + random.arrow(1e-14, 1e-2));
    }
}

TEST_CASE("the closest point from the centre, the foci, the vertices and the axis") {
  Random random(15);
  for (const double ratio : kRatios)
    for (int i = 0; i < 4; ++i) {
      const Shape shape = random_shape(random, ratio);
      const Spheroid<double> spheroid = shape.spheroid();
      const Vector major = spheroid.axis() * spheroid.semi_major();
      const Vector any_axis = ratio > 0.0 ? spheroid.axis() : Vector(Vector::UnitX());
      const Vector minor = any_axis.unitOrthogonal() * spheroid.semi_minor();
      check_closest(shape, spheroid.center());
      check_closest(shape, shape.left);
      check_closest(shape, shape.right);
      for (const double share : {0.3, 0.9, 1.0, 1.7}) {
        check_closest(shape, spheroid.center() + major * share);
        check_closest(shape, spheroid.center() - major * share);
        check_closest(shape, spheroid.center() + minor * share);
      }
    }
}

TEST_CASE("the closest point from within rounding of the centre") {
  Random random(22);
  for (const double ratio : {0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 0.5})
    for (const double offset : {1e-200, 1e-100, 1e-30, 1e-17, 1e-16, 1e-15, 1e-13})
      for (int i = 0; i < 4; ++i) {
        const Shape shape = random_shape(random, ratio);
        check_closest(shape, shape.spheroid().center() + random.direction() * offset);
      }
}

TEST_CASE("of equally close points the lowest is chosen") {
  const Spheroid<double> level({0.0, 0.4, 1.0}, {0.0, -0.4, 1.0}, 1.4);
  CHECK(level.closest_point(level.center()).z() < 1.0);
  CHECK(level.closest_point(level.center()).x() == Approx(0.0).margin(1e-15));
  const Spheroid<double> sphere({0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, 1.4);
  const Vector lowest = sphere.closest_point(sphere.center());
  CHECK(lowest.isApprox(Vector(0.1, 0.2, 0.3 - 0.7), 1e-12));
  const Spheroid<double> upright({0.0, 0.0, 0.5}, {0.0, 0.0, -0.5}, 1.4);
  CHECK(upright.closest_point({0.0, 0.0, 0.0}).allFinite());
}

TEST_CASE("tips a string length apart or farther leave the segment between them") {
  Random random(16);
  for (const double ratio : {1.0, 1.0 + 1e-12, 1.1, 3.0})
    for (int i = 0; i < 50; ++i) {
      const Shape shape = random_shape(random, ratio);
      const Spheroid<double> spheroid = shape.spheroid();
      if (ratio > 1.0) CHECK(spheroid.overstretched());
      const Vector point = random.vector(2.0), span = shape.left - shape.right;
      const double along = std::clamp((point - shape.right).dot(span) / span.squaredNorm(), 0.0, 1.0);
      const Vector on_segment = shape.right + span * along;
      CAPTURE(shape.left.transpose(), shape.right.transpose(), shape.length, point.transpose());
      // The spheroid is kept 1e-10 of its semi-major axis thick; tips that are a string length apart but for
      // rounding leave sqrt(1e-16) of it.
      const double thickness = ratio > 1.0 ? 1e-9 : 1e-7;
      CHECK((spheroid.closest_point(point) - on_segment).norm() < thickness * shape.length * ratio);
      CHECK(spheroid.signed_distance(point) < 0.0);
      CHECK(spheroid.normal(point).allFinite());
      CHECK(spheroid.published_normal(point).allFinite());
      CHECK(spheroid.radial_point(point).allFinite());
    }
}

TEST_CASE("the signed distance changes no faster than the point moves") {
  Random random(17);
  double worst = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Shape shape = random_shape(random);
    const Spheroid<double> spheroid = shape.spheroid();
    const Vector p = random.vector(1.5), q = p + random.arrow(1e-6, 1.0);
    const double change = std::abs(spheroid.signed_distance(p) - spheroid.signed_distance(q));
    worst = std::max(worst, change - (p - q).norm());
  }
  CHECK(worst < 5e-14);  // rounding of lengths of order 1 m
}

TEST_CASE("the radial point is on the surface and on the ray from the centre") {
  Random random(18);
  for (int i = 0; i < 500; ++i) {
    const Shape shape = random_shape(random);
    const Spheroid<double> spheroid = shape.spheroid();
    const Vector offset = random.arrow(1e-3, 3.0);
    const Vector point = spheroid.center() + offset, radial = spheroid.radial_point(point);
    CAPTURE(shape.left.transpose(), shape.right.transpose(), shape.length, point.transpose());
    CHECK(path(shape, radial) == Approx(shape.length).epsilon(0).margin(1e-12));
    CHECK((radial - spheroid.center()).normalized().dot(offset.normalized()) == Approx(1.0).epsilon(1e-9));
  }
}

TEST_CASE("turning, shifting, scaling and exchanging the tips carries every answer along") {
  Random random(19);
  for (int i = 0; i < 300; ++i) {
    const Shape shape = random_shape(random, random.uniform(0.05, 0.99));
    const Vector point = random.vector(1.5), shift = random.vector(2.0);
    const Eigen::Matrix3d turn = random.rotation();
    const double scale = random.uniform(0.2, 5.0);
    const auto move = [&](const Vector& v) { return Vector(turn * v * scale + shift); };
    const Spheroid<double> before = shape.spheroid();
    const Spheroid<double> after(move(shape.left), move(shape.right), shape.length * scale);
    const Spheroid<double> exchanged(shape.right, shape.left, shape.length);
    const double margin = 1e-12 * (1.0 + scale);
    CAPTURE(shape.left.transpose(), shape.right.transpose(), shape.length, point.transpose());
    CHECK((after.closest_point(move(point)) - move(before.closest_point(point))).norm() < margin * 10.0);
    CHECK((after.radial_point(move(point)) - move(before.radial_point(point))).norm() < margin * 10.0);
    CHECK((after.normal(move(point)) - turn * before.normal(point)).norm() < 1e-10);
    CHECK(after.signed_distance(move(point)) == Approx(scale * before.signed_distance(point)).margin(margin));
    CHECK((exchanged.closest_point(point) - before.closest_point(point)).norm() < 1e-12);
  }
}

TEST_CASE("the derivative of every answer agrees with central differences") {
  using D = Dual<double, 10>;  // point, tips, length
  Random random(20);
  for (int i = 0; i < 200; ++i) {
    const Shape shape = random_shape(random, random.uniform(0.05, 0.95));
    const Vector point = shape.spheroid().center() + random.arrow(0.2, 2.0);
    if (std::abs(shape.spheroid().signed_distance(point)) < 0.02) continue;  // its kink
    const Vector from_center = point - shape.spheroid().center(), axis = shape.spheroid().axis();
    if ((from_center - axis * axis.dot(from_center)).norm() < 0.1) continue;  // the axis is a cut locus
    if (std::abs(axis.dot(from_center)) < 0.05) continue;                     // and so may be the equator
    Eigen::Matrix<double, 10, 1> x;
    x << point, shape.left, shape.right, shape.length;
    const auto answers = [](const auto& v) {
      using T = typename std::decay_t<decltype(v)>::Scalar;
      const Vector3<T> p = v.template segment<3>(0), left = v.template segment<3>(3),
                       right = v.template segment<3>(6);
      const Spheroid<T> spheroid(left, right, v[9]);
      Eigen::Matrix<T, 17, 1> all;
      all << spheroid.closest_point(p), spheroid.radial_point(p), spheroid.normal(p),
          spheroid.published_normal(p), spheroid.path_gradient(p), spheroid.signed_distance(p),
          spheroid.semi_minor();
      return all;
    };
    Eigen::Matrix<D, 10, 1> seeded;
    for (int k = 0; k < 10; ++k) seeded[k] = D::variable(x[k], k);
    const Eigen::Matrix<D, 17, 1> dual = answers(seeded);
    CAPTURE(shape.left.transpose(), shape.right.transpose(), shape.length, point.transpose());
    for (int k = 0; k < 10; ++k) {
      const double h = 1e-5;
      Eigen::Matrix<double, 10, 1> up = x, down = x;
      up[k] += h;
      down[k] -= h;
      const Eigen::Matrix<double, 17, 1> difference = (answers(up) - answers(down)) / (2.0 * h);
      // Curvatures up to 1 / 0.02 m: third derivatives times h^2 stay below 1e-5 of the value.
      for (int j = 0; j < 17; ++j)
        CHECK(dual[j].gradient[k] == Approx(difference[j]).epsilon(1e-4).margin(2e-6));
    }
  }
}

TEST_CASE("single precision agrees with double, and lanes with scalars") {
  Random random(21);
  for (int i = 0; i < 300; ++i) {
    using Packed = Pack<double, 4>;
    Shape shapes[4];
    Vector points[4];
    Vector3<Packed> left, right, point;
    Packed length;
    for (int lane = 0; lane < 4; ++lane) {
      shapes[lane] = random_shape(random);
      points[lane] = random.vector(1.5);
      for (int k = 0; k < 3; ++k) {
        left[k].set(lane, shapes[lane].left[k]);
        right[k].set(lane, shapes[lane].right[k]);
        point[k].set(lane, points[lane][k]);
      }
      length.set(lane, shapes[lane].length);
    }
    const Vector3<Packed> packed = Spheroid<Packed>(left, right, length).closest_point(point);
    for (int lane = 0; lane < 4; ++lane) {
      const Shape& shape = shapes[lane];
      const Vector exact = shape.spheroid().closest_point(points[lane]);
      for (int k = 0; k < 3; ++k) CHECK(packed[k][lane] == exact[k]);
      const Spheroid<float> single(shape.left.cast<float>(), shape.right.cast<float>(),
                                   static_cast<float>(shape.length));
      const Vector3<float> rough = single.closest_point(points[lane].cast<float>());
      REQUIRE(rough.allFinite());
      // Rounding the tips moves the spheroid's thickness by sqrt(2 a * 3e-7 m) where it is thinnest.
      CHECK(path(shape, rough.cast<double>()) == Approx(shape.length).epsilon(0).margin(2e-6));
    }
  }
}
