// SPDX-License-Identifier: MIT
// The stand-in controller by a client of our own: its protocol, its script and its faults.
#include "../stand_in/server.hpp"

#include "../../../tests/catch.hpp"
#include "loopback.hpp"
#include "rtde_client.hpp"

using namespace stand_in;

namespace {

const JointVector kStart = (JointVector() << 3.0, -1.0, 1.3, -1.9, 3.1, 0.0).finished();

/// What ur_rtde's upload begins with, as far as a stand-in looks at it.
std::string program(int offset = 0) {
  return "def rtde_control():\n    global reg_offset_int = # int register offset\n" + std::to_string(offset) +
         "    textmsg(\"here\")\n    end\nend\n";
}

/// A client that has the script running and may send commands.
struct Commander {
  explicit Commander(const std::string& address, int offset = 0)
      : rtde(address), script(address, 30003), first(offset) {
    const auto name = [&](const char* kind, int i) { return kind + std::to_string(i + first) + ","; };
    rtde.outputs("runtime_state," + name("output_int_register_", 0) + name("output_int_register_", 1) +
                 name("output_int_register_", 2));
    std::string recipe = name("input_int_register_", 0) + name("input_int_register_", 1);
    for (int i = 0; i < 14; ++i) recipe += name("input_double_register_", i);
    rtde.inputs(recipe);
    rtde.ask(PacketType::kStart);
    script.send(program(offset));
    wait_for(0, 2);
    wait_for(1, 1);
  }
  /// Until an output has the value; false after 600 states.
  bool wait_for(std::size_t output, std::int32_t value) {
    for (int i = 0; i < 600; ++i)
      if (state = rtde.state<std::int32_t>(); state[output] == value) return true;
    return false;
  }
  void send(std::int32_t command, std::vector<double> arguments = {}, std::int32_t number = 0) {
    arguments.resize(14);
    std::vector<Value> values{command, number};
    for (const double argument : arguments) values.push_back(argument);
    rtde.write(1, values);
  }
  /// A command that the client waits for.
  bool done(std::int32_t command, const std::vector<double>& arguments = {}, std::int32_t number = 0) {
    send(command, arguments, number);
    const bool reached = wait_for(1, 2);
    send(0);
    return wait_for(1, 1) && reached;
  }
  static std::vector<double> servo(JointVector joints, double lookahead = 0.03, double gain = 2000) {
    std::vector<double> all(joints.begin(), joints.end());
    all.insert(all.end(), {0, 0, 0.002, lookahead, gain});
    return all;
  }

  RtdeClient rtde;
  TestSocket script;
  int first;
  std::vector<std::int32_t> state;
};

}  // namespace

TEST_CASE("a session is byte for byte the protocol's") {
  Variables outputs = output_variables(), inputs = input_variables();
  InputHolders holders;
  RtdeSession session(outputs, inputs, holders);
  outputs.get<double>("timestamp") = 1.5;
  outputs.get<std::uint32_t>("runtime_state") = 2;
  const auto answer = [&session](std::string_view bytes) {
    PacketReader reader;
    reader.append(bytes);
    return session.answer(reader.next().value());
  };
  using namespace std::string_literals;
  CHECK(answer("\0\5V\0\2"s) == "\0\4V\1"s);
  CHECK(answer("\0\3v"s) == "\0\x13v\0\0\0\5\0\0\0\x0c\0\0\0\4\0\x10\xcf\x5d"s);
  CHECK(answer("\0\x23O\x40\x7f\x40\0\0\0\0\0timestamp,runtime_state,"s) == "\0\x11O\1DOUBLE,UINT32"s);
  CHECK(answer("\0\x2eIinput_int_register_0,input_double_register_3,"s.replace(1, 1, 1, '\x30')) ==
        "\0\x10I\1INT32,DOUBLE"s);
  CHECK(session.data().empty());
  CHECK(answer("\0\3S"s) == "\0\4S\1"s);
  CHECK(session.data() == "\0\x10U\1\x3f\xf8\0\0\0\0\0\0\0\0\0\2"s);
  CHECK(answer("\0\x10U\1\0\0\0\x0b\xc0\x04\0\0\0\0\0\0"s).empty());
  CHECK(inputs.get<std::int32_t>("input_int_register_0") == 11);
  CHECK(inputs.get<double>("input_double_register_3") == -2.5);
  CHECK(answer("\0\3P"s) == "\0\4P\1"s);
  CHECK(session.data().empty());
}

TEST_CASE("a program that is played is byte for byte the protocol's, tick by tick") {
  Controller controller(kStart);
  InputHolders holders;
  RtdeSession session(controller.outputs(), controller.inputs(), holders);
  std::string all;  // what the client gets
  const auto say = [&](PacketType type, std::string_view payload) {
    PacketReader reader;
    reader.append(packed(type, payload));
    all += session.answer(reader.next().value());
    if (type == PacketType::kData) controller.command_written();
  };
  const auto tick = [&](int times = 1) {
    for (int i = 0; i < times; ++i) controller.tick(), all += session.data();
  };
  std::string recipe;
  put(recipe, 500.0);
  say(PacketType::kOutputs, recipe + "runtime_state,output_int_register_0,output_int_register_1,");
  say(PacketType::kInputs, "input_int_register_0,input_double_register_0,");
  say(PacketType::kStart, "");
  const auto command = [&](char number) {
    using namespace std::string_literals;
    say(PacketType::kData, "\1\0\0\0"s + number + "\x40\x39\0\0\0\0\0\0"s);  // 25.0
  };
  tick();
  controller.upload(program());
  tick(2);
  command(static_cast<char>(kSetWatchdog));
  tick();
  command(0);
  tick();
  command(static_cast<char>(kStopScript));
  tick(2);
  say(PacketType::kPause, "");
  tick();
  std::string hex;
  for (const char c : all) hex += "0123456789abcdef"[(c >> 4) & 15], hex += "0123456789abcdef"[c & 15];
  CHECK(hex ==
        "00164f0155494e5433322c494e5433322c494e543332"  // UINT32,INT32,INT32
        "00104901494e5433322c444f55424c45"              // INT32,DOUBLE
        "00045301"
        "00105501000000010000000000000000"  // stopped
        "00105501000000020000000100000000"  // plays, and waits for a command
        "00105501000000020000000100000000"
        "00105501000000020000000200000000"  // the command is done
        "00105501000000020000000100000000"  // it waits again
        "00105501000000010000000100000000"  // stopped
        "00105501000000010000000100000000"
        "00045001");
}

TEST_CASE("variables that are not there are named, and a slower client gets every n-th state") {
  Server server(loopback_address(0), kStart, 20);
  RtdeClient client(loopback_address(0));
  CHECK(client.outputs("timestamp,moon_phase,") == std::string("\0DOUBLE,NOT_FOUND", 17));
  CHECK(client.inputs("input_int_register_48,") == std::string("\0NOT_FOUND", 10));
  CHECK(client.outputs("timestamp,", 125).substr(1) == "DOUBLE");

  Variables outputs = output_variables(), inputs = input_variables();
  InputHolders holders;
  RtdeSession session(outputs, inputs, holders);
  std::string frequency;
  put(frequency, 125.0);
  session.answer({PacketType::kOutputs, frequency + "timestamp,"});
  session.answer({PacketType::kStart, ""});
  std::string told;
  for (int i = 0; i < 12; ++i) told += session.data().empty() ? '-' : 'U';
  CHECK(told == "---U---U---U");
}

TEST_CASE("a packet of the wrong size closes its connection and no other") {
  Server server(loopback_address(0), kStart, 20);
  for (const std::string& wrong :
       {packed(PacketType::kData, std::string("\1\0\0\0", 4)),
        packed(PacketType::kData, std::string("\1\0\0\0\0\0", 6)), packed(PacketType::kData, "\2\0\0\0\0"),
        std::string("\0\2U", 3), packed(PacketType::kText, "hello")}) {
    RtdeClient good(loopback_address(0)), bad(loopback_address(0));
    bad.inputs("input_int_register_0,");
    bad.send(wrong);
    CHECK(bad.closed());
    CHECK_FALSE(server.complaint().empty());
    CHECK(good.ask(PacketType::kProtocolVersion, std::string("\0\2", 2)) == "\1");
  }
}

TEST_CASE("an input has one writer at a time, and keeps its value when the writer has gone") {
  Server server(loopback_address(0), kStart, 20);
  RtdeClient second(loopback_address(0));
  {
    RtdeClient first(loopback_address(0));
    CHECK(first.inputs("input_int_register_0,").substr(1) == "INT32");
    CHECK(first.inputs("input_int_register_0,input_double_register_0,").substr(1) == "INT32,DOUBLE");
    first.write(1, {std::int32_t{77}});
    CHECK(second.inputs("input_int_register_0,input_int_register_30,") == std::string("\0IN_USE,INT32", 13));
  }
  std::string types;
  for (int i = 0; i < 100 && types.substr(0, 1) != "\1"; ++i) types = second.inputs("input_int_register_0,");
  CHECK(types == "\1INT32");
}

TEST_CASE("the dashboard answers a line with a line") {
  Server server(loopback_address(0), kStart, 20);
  TestSocket dashboard(loopback_address(0), 29999);
  CHECK(dashboard.line() == "Connected: Universal Robots Dashboard Server");
  CHECK(dashboard.ask("PolyscopeVersion") == "URSoftware 5.12.4.1101661 (Sep 08 2022)");
  CHECK(dashboard.ask("is in remote control") == "true");
  CHECK(dashboard.ask("safetystatus") == "Safetystatus: NORMAL");
  CHECK(dashboard.ask("stop") == "Stopped");
  CHECK(dashboard.ask("sing") == "could not understand: 'sing'");
  CHECK(server.order("remote off") == "ok");
  CHECK(dashboard.ask("is in remote control") == "false");
  CHECK(server.order("pstop") == "ok");
  CHECK(dashboard.ask("unlock protective stop").starts_with("Cannot unlock"));
  CHECK(server.order("moon").starts_with("'moon'; expected drop"));
  CHECK(TestSocket(loopback_address(0), 29998).ask("freeze 0.1") == "ok");
}

TEST_CASE("every command number is answered, with registers from 0 and from 24") {
  for (const int offset : {0, 24}) {
    Server server(loopback_address(0), kStart, 60);
    Commander commander(loopback_address(0), offset);
    REQUIRE(commander.state[0] == 2);
    for (std::int32_t command = 1; command <= 71; ++command) {
      if (command == kProtectiveStop || command == kSetWatchdog) continue;
      std::vector<double> arguments = Commander::servo(kStart);
      if (command == kMoveJ || command == kMoveLJoints)
        arguments = {3.0, -1.0, 1.3, -1.9, 3.1, 0.0, 1.0, 1.0};
      if (command == kSpeedJ || command == kServoStop || command == kStopJ || command == kStopL ||
          command == kSpeedStop)
        arguments = {1.0, 0, 0, 0, 0, 0, 1.0};
      if (command == kServoL) continue;  // its target is a pose
      INFO("command " << command);
      const bool at_once = command == kForce || (command >= kSpeedJ && command <= kServoJ) ||
                           (command >= kServoL && command <= kJointHistory) || command == kTorques ||
                           command == kFlangePose || command >= 66;
      if (!at_once) {
        REQUIRE(commander.done(command, arguments));
        continue;
      }
      commander.send(command, arguments);
      REQUIRE(commander.wait_for(1, 1));
      if (command == kSpeedJ) REQUIRE(commander.done(kSpeedStop, {10.0}));
      if (command == kServoJ) REQUIRE(commander.done(kServoStop, {10.0}));
      commander.send(0);
    }
    commander.send(kStopScript);
    CHECK(commander.wait_for(0, 1));
  }
}

TEST_CASE("a move ends at its goal with the speed that was asked for, waited for or not") {
  Server server(loopback_address(0), kStart, 30);
  Commander commander(loopback_address(0));
  std::vector<double> goal(kStart.begin(), kStart.end());
  goal[1] += 0.2;
  goal.insert(goal.end(), {0.5, 2.0});
  REQUIRE(commander.done(kMoveJ, goal));
  CHECK(server.ticks().back().joints[1] == Approx(kStart[1] + 0.2).margin(1e-12).epsilon(0));
  goal[1] -= 0.2;
  REQUIRE(commander.done(kMoveJ, goal, 1));
  CHECK((commander.state[3] & 1 << 15) != 0);
  for (int i = 0; i < 600 && (commander.state[3] & 1 << 15) != 0; ++i)
    commander.state = commander.rtde.state<std::int32_t>();
  CHECK(server.ticks().back().joints[1] == Approx(kStart[1]).margin(1e-12).epsilon(0));
  double fastest = 0, ticks = 0;
  for (const Tick& tick : server.ticks()) {
    fastest = std::max(fastest, std::abs(tick.speed[1]));
    ticks += tick.speed.norm() > 1e-9;
  }
  CHECK(fastest == Approx(0.5).epsilon(1e-9));
  CHECK(ticks * diabolo::kTick / 2 == Approx(0.2 / 0.5 + 0.5 / 2.0).margin(0.006));
}

TEST_CASE("a servo follows a ramp late by its lookahead") {
  for (const auto& [lookahead, gain] : {std::pair{0.03, 2000.0}, {0.1, 300.0}, {0.05, 500.0}}) {
    ServoArm arm(kStart);
    JointVector target = kStart;
    for (int i = 0; i < 500; ++i) {
      target[0] += 0.5 * diabolo::kTick;
      arm.servo(target, lookahead, gain);
      arm.tick(1.0);
    }
    CHECK((target[0] - arm.joints()[0]) / 0.5 ==
          Approx(lookahead - 9.0 / 16.0 * diabolo::kTick).margin(1e-6));  // the target stands for a tick
  }
}

TEST_CASE(
    "a sudden target, a number that is none, and a joint that is too fast stop the arm for its safety") {
  JointVector sudden = kStart;
  sudden[2] += 0.11;
  JointVector none = kStart;
  none[5] = std::numeric_limits<double>::quiet_NaN();
  for (const JointVector& wrong : {sudden, none}) {
    Server server(loopback_address(0), kStart, 20);
    Commander commander(loopback_address(0));
    commander.send(kServoJ, Commander::servo(kStart));
    commander.wait_for(1, 1);
    commander.send(kServoJ, Commander::servo(wrong));
    CHECK(commander.wait_for(0, 1));
    CHECK(server.ticks().back().safety == Controller::kProtective);
    CHECK(server.reason().find(wrong.allFinite() ? "C204A1" : "not a number") != std::string::npos);
    CHECK(server.order("estop on") == "ok");
  }
  Controller controller(kStart);
  controller.upload(program());
  JointVector target = kStart;
  for (int i = 0; i < 300 && controller.safety() == Controller::kNormal; ++i) {
    target[0] += 0.009;
    controller.inputs().get<std::int32_t>("input_int_register_0") = kServoJ;
    const std::vector<double> arguments = Commander::servo(target);
    for (std::size_t k = 0; k < arguments.size(); ++k)
      controller.inputs().get<double>("input_double_register_" + std::to_string(k)) = arguments[k];
    controller.tick();
  }
  CHECK(controller.reason() == "a joint is too fast");
}

TEST_CASE("a protective stop is released after five seconds, not before, and starts no program") {
  Controller controller(kStart);
  controller.upload(program());
  for (int i = 0; i < 10; ++i) controller.tick();
  CHECK(controller.runtime() == Controller::kPlaying);
  controller.protective_stop("a test");
  for (int i = 0; i < 2490; ++i) controller.tick();
  CHECK_FALSE(controller.unlock());
  for (int i = 0; i < 20; ++i) controller.tick();
  CHECK(controller.unlock());
  CHECK(controller.safety() == Controller::kNormal);
  CHECK(controller.runtime() == Controller::kStopped);
}

TEST_CASE("without its commands the watchdog stops the program") {
  Server server(loopback_address(0), kStart, 20);
  Commander commander(loopback_address(0));
  REQUIRE(commander.done(kSetWatchdog, {25.0}));
  for (int i = 0; i < 50; ++i) {
    commander.send(0);
    commander.state = commander.rtde.state<std::int32_t>();
  }
  CHECK(commander.state[0] == 2);
  CHECK(commander.wait_for(0, 1));
  CHECK(server.reason() == "the watchdog");

  Controller controller(kStart);  // the same tick by tick: 40 ms after the last command
  controller.upload(program());
  controller.inputs().get<std::int32_t>("input_int_register_0") = kSetWatchdog;
  controller.inputs().get<double>("input_double_register_0") = 25;
  int ticks = 0;
  controller.command_written();
  for (; ticks < 100 && controller.runtime() == Controller::kPlaying; ++ticks) controller.tick();
  CHECK(ticks >= 20);
  CHECK(ticks <= 21);
}

TEST_CASE("programs start in remote control, with power and without a stop") {
  const auto starts = [](const char* first) {
    Server server(loopback_address(0), kStart, 20);
    server.order(first);
    TestSocket script(loopback_address(0), 30003);
    script.send(program());
    for (int i = 0; i < 100 && server.uploads() == 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    REQUIRE(server.uploads() == 1);
    return server.ticks().back().runtime == Controller::kPlaying ||
           (std::this_thread::sleep_for(std::chrono::milliseconds(50)),
            server.ticks().back().runtime == Controller::kPlaying);
  };
  CHECK(starts("remote on"));
  CHECK_FALSE(starts("remote off"));
  CHECK_FALSE(starts("pstop"));
  CHECK_FALSE(starts("estop on"));
}

TEST_CASE("a stand-in stays on the loopback addresses, and ends by itself") {
  CHECK_THROWS_WITH(Server("192.168.0.7", kStart, 1),
                    "address: '192.168.0.7'; expected a loopback address, 127.x.x.x");
  CHECK_THROWS_AS(Server("localhost", kStart, 1), std::invalid_argument);
  Server server(loopback_address(0), kStart, 0.2);
  CHECK_THROWS_AS(Server(loopback_address(0), kStart, 0.2), std::system_error);  // the port is taken
  const double begin = steady_now();
  server.join();
  CHECK(steady_now() - begin < 5);
}
