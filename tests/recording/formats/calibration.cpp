// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/calibration.hpp"

#include <charconv>
#include <map>

#include "catch.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/spin_line.hpp"
#include "diabolo/recording/spin.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;
using test::motive_text;

namespace {

/// One body of the authors' processed files (three header lines, pandas): world frame, empty cells as NaN.
struct Processed {
  std::vector<long> frame;
  std::map<std::string, Eigen::MatrixXd> body;  ///< 7 x N: quaternion over position
  std::vector<double> spin;                     ///< [rad/s]
};

Processed read_processed(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  CsvReader csv(text, path.string());
  const std::vector<std::string_view> names = csv.next_cells(), kinds = csv.next_cells();
  csv.next_line();
  Processed result;
  std::vector<double> row(names.size());
  const Eigen::Index size = csv.lines_left();
  for (Eigen::Index i = 0; i < size; ++i) {
    csv.next_numbers(row);
    result.frame.push_back(static_cast<long>(row[1]));
    result.spin.push_back(row.back());
    for (std::size_t c = 3; c + 6 < row.size(); ++c) {
      if (kinds[c] != "Rotation" || names[c] == names[c - 1]) continue;
      Eigen::MatrixXd& body = result.body[std::string(names[c])];
      if (body.size() == 0) body.resize(7, size);
      for (std::size_t k = 0; k < 7; ++k) body(static_cast<Eigen::Index>(k), i) = row[c + k];
    }
  }
  return result;
}

/// The rows of `recording` that a processed file has too.
Recording rows_of(const Recording& recording, const Processed& processed) {
  const auto first = std::ranges::find(recording.frame, processed.frame.front());
  REQUIRE(first != recording.frame.end());
  const Eigen::Index row = first - recording.frame.begin();
  return cut(recording, row, row + static_cast<Eigen::Index>(processed.frame.size()) - 1);
}

/// Largest distance [m] between a track and a processed body, which must drop out together.
double largest_distance(const Track& track, const Eigen::MatrixXd& body) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < body.cols(); ++i) {
    REQUIRE(track.valid[i] == !std::isnan(body(4, i)));
    if (track.valid[i]) largest = std::max(largest, (track.position.col(i) - body.col(i).tail<3>()).norm());
  }
  return largest;
}

}  // namespace

TEST_CASE("Points and axes of the bodies land in the world frame") {
  Calibration calibration = published_calibration();
  calibration.left = {{"stick_left"}, {0.1, 0.02, 0.03}, Eigen::Vector3d::UnitX()};
  calibration.diabolo = {{"diabolo_red"}, {0.0, 0.0, 0.05}, -Eigen::Vector3d::UnitZ()};
  const Recording recording = apply(calibration, read_motive(motive_text(), "folder/two beats.csv"));
  CHECK(recording.name == "two beats");
  CHECK(recording.rate == 120.0);
  CHECK(recording.frame == std::vector<long>{40, 41, 42});
  CHECK(recording.string_length == 1.46);
  CHECK(recording.properties.mass == 0.2845);
  // Rz(-90 degrees): the capture's y becomes x, its x becomes -y.
  CHECK((recording.left.position.col(0) - Eigen::Vector3d(0.52 + 0.1, 0.15 - 0.2, 1.03 + 0.3)).norm() <
        1e-15);
  // The diabolo's first quaternion is half a turn about x, so body z points down.
  CHECK((recording.diabolo.position.col(0) - Eigen::Vector3d(0.7, -0.21, 0.75)).norm() < 1e-15);
  CHECK(!recording.diabolo.valid[1]);
  CHECK(recording.diabolo.position.col(1).array().isNaN().all());
  CHECK(!recording.diabolo_orientation.valid[1]);
  const Eigen::Quaterniond orientation(Eigen::Vector4d(recording.diabolo_orientation.quaternion.col(0)));
  CHECK((orientation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitZ()).norm() < 1e-15);
  const Eigen::Quaterniond stick(Eigen::Vector4d(recording.left_orientation.quaternion.col(0)));
  CHECK((stick * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm() < 1e-15);
}

TEST_CASE("Moving the capture frame moves the recording with it") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const TrackedTake take = read_motive(motive_text(), "take.csv");
  const Calibration calibration = published_calibration();
  const double angle = 3.0 * draw(generator);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d shift(draw(generator), draw(generator), draw(generator));
  TrackedTake moved = take;
  for (TrackedBody& body : moved.bodies)
    for (Eigen::Index i = 0; i < moved.time.size(); ++i) {
      body.position.col(i) = turn * Eigen::Vector3d(body.position.col(i)) + shift;
      body.quaternion.col(i) = (turn * Eigen::Quaterniond(Eigen::Vector4d(body.quaternion.col(i)))).coeffs();
    }
  Calibration undone = calibration;
  undone.world_yaw -= angle;
  undone.world_offset -= Eigen::AngleAxisd(undone.world_yaw, Eigen::Vector3d::UnitZ()) * shift;
  const Recording a = apply(calibration, take), b = apply(undone, moved);
  CHECK((a.left.position - b.left.position).norm() < 1e-14);
  CHECK((a.right.position - b.right.position).norm() < 1e-14);
  CHECK((a.diabolo.position.col(2) - b.diabolo.position.col(2)).norm() < 1e-14);
  CHECK(std::abs(
            std::abs(a.diabolo_orientation.quaternion.col(2).dot(b.diabolo_orientation.quaternion.col(2))) -
            1.0) < 1e-14);
}

TEST_CASE("Names of bodies are tried in order, and a missing body is told with all names") {
  const TrackedTake take = read_motive(motive_text(), "take.csv");
  Calibration calibration = published_calibration();
  calibration.left.bodies = {"stick_left_2020_10", "stick_left"};
  CHECK(apply(calibration, take).left.valid.all());
  TrackedTake other = take;
  other.bodies[2].name = "stick";
  calibration.right.bodies = {"right", "stick_right_2010_10"};
  CHECK(complaint([&] { apply(calibration, other); }) ==
        "take.csv: no rigid body for the right stick: tried \"right\", \"stick_right_2010_10\"; the file has "
        "\"stick_left\", \"diabolo_red\", \"stick\"");
  TrackedTake empty = take;
  empty.bodies.clear();
  CHECK(complaint([&] { apply(calibration, empty); }).ends_with("the file has none"));
}

TEST_CASE("A body by a telling name is taken where it is the only one") {
  const Calibration calibration = published_calibration();
  const TrackedTake take = read_motive(motive_text(), "take.csv");
  TrackedTake other = take;
  other.bodies[1].name = "Diabolo_blue_2020_10";
  other.bodies[2].name = "stick_right_2010_10";
  const Recording found = apply(calibration, other), given = apply(calibration, take);
  CHECK(found.right.position == given.right.position);
  CHECK(found.notes ==
        std::vector<std::string>{
            "\"stick_right_2010_10\" is taken for the right stick, by its name; the calibration "
            "is of \"stick_right\"",
            "\"Diabolo_blue_2020_10\" is taken for the diabolo, by its name; the calibration is "
            "of \"diabolo_red\""});
  CHECK(given.notes.empty());
  other.bodies.push_back(other.bodies[1]);
  other.bodies.back().name = "diabolo_green";
  CHECK(complaint([&] { apply(calibration, other); }) ==
        "take.csv: several rigid bodies may be the diabolo: \"Diabolo_blue_2020_10\", \"diabolo_green\"; "
        "expected "
        "one, or its name in a calibration");
  other.bodies.back().name = "diabolo_red";  // by name, whatever else is there
  CHECK(apply(calibration, other).notes.size() == 1);
  other.bodies.back().name = "left_diabolo";  // tells two things, so that it tells neither
  CHECK(apply(calibration, other).notes.size() == 2);
}

TEST_CASE("Unusable calibrations are refused") {
  const auto says = [](const auto& breaking) {
    Calibration calibration = published_calibration();
    breaking(calibration);
    return complaint([&] { check_calibration(calibration, "c"); });
  };
  CHECK(says([](Calibration&) {}) == "(no complaint)");
  CHECK(says([](Calibration& c) { c.left.bodies.clear(); }) ==
        "c: left.body is empty; expected the name of a rigid body");
  CHECK(says([](Calibration& c) { c.right.point.x() = kNaN; }) ==
        "c: right.point [m] must be finite and within 100 m");
  CHECK(says([](Calibration& c) { c.diabolo.axis *= 2.0; }) == "c: diabolo.axis has norm 2; expected 1");
  CHECK(says([](Calibration& c) { c.world_yaw = kNaN; }) == "c: the world's yaw must be finite");
  CHECK(says([](Calibration& c) { c.world_offset.z() = 1e9; }) ==
        "c: world.offset [m] must be finite and within 100 m");
  CHECK(says([](Calibration& c) { c.diabolo.bodies.push_back("stick_right"); }) ==
        "c: right.body and diabolo.body are both \"stick_right\"; expected different rigid bodies");
  CHECK(says([](Calibration& c) { c.properties.axle_radius = 1.0; }) ==
        "c: diabolo.axle_radius [m] 1; expected 1e-04 to 0.1");
  CHECK(says([](Calibration& c) { c.string_length = 0.0; }) == "c: string_length [m] 0; expected 0.05 to 20");
  CHECK(says([](Calibration& c) { c.assumed = {"mass"}; }).starts_with("c: assumed: \"mass\"; expected"));
}

TEST_CASE("String and diabolo that a calibration assumes are another's, as far as that tells them") {
  Calibration setup = plain_calibration(), calibration = plain_calibration();
  setup.string_length = 1.3;
  setup.properties = kGreenDiabolo;
  calibration.right.bodies = {"mine"};
  const auto found = [&](std::vector<std::string> told, std::vector<std::string> assumed) {
    setup.assumed = std::move(told);
    calibration.assumed = std::move(assumed);
    return completed(calibration, setup);
  };
  const Calibration both = found({}, {"string_length", "diabolo"});
  CHECK(both.string_length == 1.3);
  CHECK(both.properties.mass == kGreenDiabolo.mass);
  CHECK(both.assumed.empty());
  CHECK(both.right.bodies == std::vector<std::string>{"mine"});
  const Calibration one = found({"diabolo"}, {"string_length", "diabolo"});
  CHECK(one.string_length == 1.3);
  CHECK(one.assumed == std::vector<std::string>{"diabolo"});
  const Calibration none = found({}, {});
  CHECK(none.string_length == calibration.string_length);
  CHECK(none.properties.mass == calibration.properties.mass);
}

TEST_CASE("The published processed files are reproduced to 1e-11 m") {
  const auto folder = test::recordings_folder("reproducing the published processed files");
  if (!folder) return;
  struct Pair {
    std::string raw, processed;
    bool diabolo;  ///< whether the diabolo's columns are processed too
  };
  const std::string july = "2020-07-11_basic_physics/", september = "2020-09-14_motion_extraction/";
  for (const Pair& pair :
       {Pair{july + "z_hop_1", july + "z_hop_1_cut", true},
        Pair{september + "circular_accel_stick_motion", july + "circ_accel_cut", true},
        Pair{september + "circular_accel_stick_motion", september + "circular_accel_stick_motion", false},
        Pair{september + "circular_accel_left_stick_motion", september + "circular_accel_left_stick_motion",
             false},
        Pair{september + "circular_accel_right_stick_motion", september + "circular_accel_right_stick_motion",
             false},
        Pair{september + "linear_accel_stick_motion", september + "linear_accel_stick_motion", false}}) {
    INFO(pair.raw << " to " << pair.processed);
    const Processed processed = read_processed(*folder / ("processed/" + pair.processed + ".csv"));
    const Recording recording =
        rows_of(apply(published_calibration(), load_motive(*folder / (pair.raw + ".csv"))), processed);
    CHECK(largest_distance(recording.left, processed.body.at("stick_left")) < 1e-11);
    CHECK(largest_distance(recording.right, processed.body.at("stick_right")) < 1e-11);
    const Eigen::MatrixXd& diabolo = processed.body.at("diabolo_red");
    if (pair.diabolo) {
      CHECK(largest_distance(recording.diabolo, diabolo) < 1e-11);
      for (Eigen::Index i = 0; i < recording.size(); ++i) {
        if (!recording.diabolo.valid[i]) continue;
        const Eigen::Quaterniond ours(Eigen::Vector4d(recording.diabolo_orientation.quaternion.col(i)));
        const Eigen::Quaterniond theirs(Eigen::Vector4d(diabolo.col(i).head<4>()));
        CHECK((ours * Eigen::Vector3d::UnitX() - theirs * Eigen::Vector3d::UnitX()).norm() < 1e-10);
      }
    }
    // Their column repeats the last value over dropouts and at the end.
    const Spin spin = unsigned_spin(recording);
    for (Eigen::Index i = 0; i < recording.size(); ++i)
      if (spin.valid[i])
        CHECK(spin.value[i] == Approx(processed.spin[static_cast<std::size_t>(i)]).margin(1e-8));
  }
}

TEST_CASE("The calibration of the blue take is what its own spin shows") {
  const auto folder = test::recordings_folder("the calibration of the blue take");
  if (!folder) return;
  const TrackedTake take = load_motive(*folder / "2020-11-12_dia_blue_inclination" /
                                       "Take 2020-11-12 dia_blue inclination data 1 soft linear.csv");
  const Calibration calibration = blue_calibration();
  const SpinLine line = find_spin_line(take, *body_of_name(take, calibration.diabolo.bodies));
  CHECK((line.point - calibration.diabolo.point).norm() < 1e-5);
  CHECK((line.axis - calibration.diabolo.axis).norm() < 1e-5);
  CHECK(apply(calibration, take).size() == 19165);
}
