// SPDX-License-Identifier: MIT
// ur_rtde's own classes, unchanged, on a stand-in controller.
#include <ur_rtde/dashboard_client.h>
#include <ur_rtde/rtde_control_interface.h>
#include <ur_rtde/rtde_io_interface.h>
#include <ur_rtde/rtde_receive_interface.h>

#include "../../../tests/catch.hpp"
#include "../stand_in/server.hpp"
#include "loopback.hpp"

using namespace ur_rtde;

namespace {

const stand_in::JointVector kStart = (stand_in::JointVector() << 3.0, -1.0, 1.3, -1.9, 3.1, 0.0).finished();

}  // namespace

TEST_CASE("the client's four classes connect with all they ask for by default") {
  const std::string host = loopback_address(0);
  stand_in::Server server(host, kStart, 40);
  RTDEReceiveInterface receive(host);
  RTDEControlInterface control(host);
  RTDEIOInterface io(host);
  DashboardClient dashboard(host);
  dashboard.connect();
  CHECK(control.isProgramRunning());
  CHECK(receive.getActualQ() == std::vector<double>(kStart.begin(), kStart.end()));
  CHECK(receive.getRuntimeState() == 2);
  CHECK(receive.getSafetyStatusBits() == 1);
  CHECK(receive.getRobotMode() == 7);
  CHECK(receive.getJointTemperatures().size() == 6);
  CHECK(dashboard.isInRemoteControl());
  CHECK(dashboard.safetystatus() == "Safetystatus: NORMAL");
  CHECK(io.setSpeedSlider(0.5));
  CHECK(io.setStandardDigitalOut(3, true));
  CHECK(server.uploads() == 1);

  std::vector<double> goal(kStart.begin(), kStart.end());
  goal[1] += 0.1;
  CHECK(control.moveJ(goal, 1.0, 4.0));
  CHECK(control.isSteady());
  CHECK(control.isJointsWithinSafetyLimits(goal));
  CHECK(control.setPayload(0.5, {0, 0, 0.05}));
  CHECK(control.setTcp({0, 0, 0.1, 0, 0, 0}));
  CHECK(control.getTCPOffset()[2] == 0.1);
  const std::vector<double> pose = receive.getActualTCPPose();
  const std::vector<double> back =
      control.getInverseKinematics(control.poseTrans(pose, {0, 0, 0.1, 0, 0, 0}), goal);
  REQUIRE(back.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK(back[i] == Approx(goal[i]).margin(1e-6));
  CHECK(server.complaint().empty());
}

TEST_CASE("servo setpoints arrive as they were sent, and a stop leaves the program running") {
  for (const bool upper : {false, true}) {
    const std::string host = loopback_address(0);
    stand_in::Server server(host, kStart, 20);
    std::uint16_t flags = RTDEControlInterface::FLAG_UPLOAD_SCRIPT;
    if (upper) flags |= RTDEControlInterface::FLAG_UPPER_RANGE_REGISTERS;
    RTDEControlInterface control(host, 500, flags);
    std::vector<double> target(kStart.begin(), kStart.end());
    for (int i = 0; i < 100; ++i) {
      target[4] += 0.001;
      REQUIRE(control.servoJ(target, 0, 0, 0.002, 0.05, 500));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    CHECK(control.servoStop(10));
    CHECK(control.isProgramRunning());
    const std::vector<stand_in::Arrival> arrivals = server.arrivals();
    REQUIRE(arrivals.size() == 100);
    CHECK(arrivals.back().setpoint[4] == Approx(3.2).margin(1e-12));
    CHECK(arrivals.back().setpoint[0] == kStart[0]);
    control.stopScript();
    CHECK_FALSE(control.isProgramRunning());
    CHECK(server.reason() == "its client stopped it");
  }
}

TEST_CASE("a second control client is told that the registers are in use") {
  const std::string host = loopback_address(0);
  stand_in::Server server(host, kStart, 20);
  RTDEControlInterface first(host);
  CHECK_THROWS_WITH(RTDEControlInterface(host), Catch::Matchers::Contains("already in use"));
  CHECK(first.isProgramRunning());
}

TEST_CASE("a client is refused where the pendant keeps the control") {
  const std::string host = loopback_address(0);
  stand_in::Server server(host, kStart, 20);
  server.order("remote off");
  CHECK_THROWS_WITH(RTDEControlInterface(host), Catch::Matchers::Contains("remote control"));
}
