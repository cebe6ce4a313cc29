// SPDX-License-Identifier: MIT
// Plays a stick motion in Gazebo's physics with our string, without a Gazebo: README.md.
#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include "play.hpp"

int main(int argc, char** argv) {
  std::filesystem::path world, motion, out;
  bool once = false;
  CLI::App app("Play a stick motion, of `diabolo motion`, in Gazebo's engine dartsim with our string.");
  app.add_option("WORLD.sdf", world, "a world with a model that has the plugin diabolo::String")->required();
  app.add_option("MOTION.csv", motion, "the tips; MOTION.json beside it has the starts")->required();
  app.add_option("SIM.csv", out, "what to write, with SIM.json beside it")->required();
  app.add_flag("--once", once, "play from the first start alone; default: again from each");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "diabolo_gazebo: " + std::string(error.what()) + "; see --help\n";
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (out.extension() != ".csv" || out.lexically_normal() == motion.lexically_normal())
      throw std::invalid_argument(out.string() + ": expected a new name that ends in .csv");
    diabolo_gazebo::Motion played = diabolo_gazebo::load_motion(motion);
    if (once) played.starts.resize(1);
    const diabolo_gazebo::Scene scene = diabolo_gazebo::load_scene(world);
    const diabolo::Recording recording = diabolo_gazebo::play(scene, played, out.stem().string());
    diabolo::save_tidy(recording, out);
    std::cout << out.string() << ": " << recording.size() << " rows at " << diabolo::shown(recording.rate)
              << " Hz, played from " << played.starts.size() << " starts\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "diabolo_gazebo: " << error.what() << '\n';
    return 2;
  }
}
