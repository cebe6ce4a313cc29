// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/columns.hpp"

#include <fstream>

#include "catch.hpp"
#include "diabolo/json/recording_file.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

/// A CSV of somebody's own: ms, mm, another order, columns and a comment that nobody needs.
const char* const kOwn =
    "note,t [ms],LX,LY,LZ,RX,RY,RZ,diabolo_x,DY[cm],DZ,LX\n"
    "start,0,100,300,1000,100,-300,1000,0.1,0,40,1\n"
    ",10,100,300,1010,100,-300,990,,,,1\n"
    "end,20,100,300,1020,100,-300,980,0.1,1,41,1\n";
const char* const kMap =
    "time=t [ms],left_x=LX[mm],left_y=LY[mm],left_z=LZ[mm],right_x=RX[mm],right_y=RY[mm],right_z=RZ[mm],"
    "diabolo_y=DY[cm],diabolo_z=DZ[cm]";

Recording read(const std::string& map) {
  return read_tidy(kOwn, "own.csv", {kRedDiabolo, 1.46, 0.0}, columns_of(map));
}

}  // namespace

TEST_CASE("A CSV of one's own is mapped, with units, and other columns are left alone") {
  // "t [ms]" is the column's whole name here; its unit counts as well.
  const Recording r = read(kMap);
  CHECK(r.rate == 100.0);
  CHECK(r.time.isApprox(Eigen::Vector3d(0.0, 0.01, 0.02)));
  CHECK(r.left.position.col(1).isApprox(Eigen::Vector3d(0.1, 0.3, 1.01)));
  CHECK(r.diabolo.position.col(2).isApprox(Eigen::Vector3d(0.1, 0.01, 0.41)));
  CHECK(!r.diabolo.valid[1]);
  CHECK(!r.diabolo_orientation.valid.any());
}

TEST_CASE("What cannot be mapped is named") {
  CHECK(complaint([] { columns_of("left_w=a"); }) ==
        "columns: \"left_w\"; expected time, left_x, diabolo_qw and the like");
  CHECK(complaint([] { columns_of("time"); }) ==
        "columns: \"time\"; expected TIDY=NAME[UNIT], such as left_x=lx[mm]");
  CHECK(complaint([] { columns_of("time=t[mm]"); }) ==
        "columns: time=t[mm]: unit \"mm\"; expected s, ms, us or ns");
  CHECK(complaint([] { columns_of("left_x=x[ms]"); }) ==
        "columns: left_x=x[ms]: unit \"ms\"; expected m, cm, mm, in or ft");
  CHECK(complaint([] { columns_of("left_qx=x[m]"); }) ==
        "columns: left_qx=x[m]: unit \"m\"; expected none, of a quaternion");
  CHECK(complaint([] { columns_of("left_x="); }) == "columns: left_x=; expected the name of a column");
  CHECK(complaint([] {
          read("time=zeit[ms]");
        }).starts_with("own.csv, line 1: no column \"zeit\" for time; the file has \"note\", \"t [ms]\""));
  CHECK(complaint([] { read("time=t [ms],time=LX"); }) ==
        "own.csv, line 1: columns: time is mapped to \"t [ms]\" and to \"LX\"; expected one of them");
  CHECK(complaint([] { read("left_x=LX[mm],right_x=LX[mm]"); }) ==
        "own.csv, line 1: columns: \"LX\" is mapped to left_x and to right_x; expected a column for each");
  CHECK(complaint([] { read("time=t [ms]"); }) == "own.csv, line 1: column \"left_x\" is missing");
  CHECK(complaint([] { read(std::string(kMap) + ",right_qx=note"); }) ==
        "own.csv, line 1: column \"right_qy\" is missing");
}

TEST_CASE("Without JSON beside it, string and diabolo are the calibration's, or assumed") {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "own.csv") << kOwn;
  Calibration calibration = published_calibration();
  calibration.string_length = 1.3;
  const Recording r = load_recording(folder / "own.csv", calibration, {{}, columns_of(kMap)});
  CHECK(r.string_length == 1.3);
  CHECK(r.rate == 100.0);
  CHECK(r.assumed.empty());
  const Recording untold = load_recording(folder / "own.csv", {}, {{}, columns_of(kMap)});
  CHECK(untold.string_length == kPublishedStringLength);
  CHECK(untold.assumed == std::vector<std::string>{"string_length", "diabolo"});
  CHECK(complaint([&] {
          load_recording(folder / "own.csv", calibration);
        }).ends_with("--columns maps other names"));
}
