// SPDX-License-Identifier: MIT
// A stand-in for a UR5e's controller on a loopback address, so that an unchanged client of the real one can
// be tried without one. It is a model of the protocol and, roughly, of a servo; it says nothing about a real
// arm.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <string>

#include "server.hpp"

int main(int argc, char** argv) {
  CLI::App app("A stand-in for a UR5e's controller on a loopback address, for tries and tests.");
  std::string address = "127.0.0.1";
  double seconds = 60;
  std::array<double, 6> joints{0, -1.57, -1.57, -1.57, 1.57, 0};
  app.add_option("--address", address,
                 "Loopback address to answer on: ports 29998 (faults), 29999, 30002, 30003, 30004")
      ->capture_default_str();
  app.add_option("--seconds", seconds, "Ends by itself after so long")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  app.add_option("--joints", joints, "Where the arm stands at first [rad]")->capture_default_str();
  app.footer(std::string("Faults, a line each on port 29998: ") + stand_in::kOrders);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "ur5e_stand_in: " + std::string(error.what()) + "; see --help\n";
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    stand_in::Server server(address, Eigen::Map<const stand_in::JointVector>(joints.data()), seconds);
    std::printf("A stand-in controller answers on %s for %g s.\n", address.c_str(), seconds);
    std::fflush(stdout);
    server.join();
    if (const std::string complaint = server.complaint(); !complaint.empty())
      std::printf("A connection was closed: %s.\n", complaint.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ur5e_stand_in: %s\n", error.what());
    return 2;
  }
}
