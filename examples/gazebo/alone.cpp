// SPDX-License-Identifier: MIT
// Plays a world in Gazebo's physics with our string, without a Gazebo: its tips are links that move by
// themselves, such as those of two robots. README.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/recording/check.hpp"
#include "diabolo/text/shown.hpp"

#include "engine.hpp"

namespace {

using diabolo_gazebo::Engine;
using diabolo_gazebo::Scene;
using nlohmann::ordered_json;

ordered_json array_of(const diabolo_gazebo::Vector3<double>& place) {
  return {place.x(), place.y(), place.z()};
}

ordered_json places_of(const Engine& engine) {
  return {{"left", array_of(engine.tip(0).place)},
          {"right", array_of(engine.tip(1).place)},
          {"diabolo", array_of(engine.body().position)}};
}

/// Of each model the masses of its links [kg], and how many links and joints the engine has of it.
ordered_json models_of(const Scene& scene, const Engine& engine) {
  ordered_json models;
  for (std::uint64_t i = 0; i < scene.world->ModelCount(); ++i) {
    const sdf::Model& model = *scene.world->ModelByIndex(i);
    ordered_json& told = models[model.Name()];
    for (std::uint64_t k = 0; k < model.LinkCount(); ++k) {
      const sdf::Link& link = *model.LinkByIndex(k);
      told["masses"][link.Name()] = link.Inertial().MassMatrix().Mass();
    }
    const auto [links, joints] = engine.counts(model.Name());
    told["links"] = links;
    told["joints"] = joints;
  }
  return models;
}

/// Throws std::runtime_error where tips or diabolo are so far off that the engine's collisions end the
/// program.
void expect_near(const Engine& engine, double time) {
  const std::pair<const char*, double> distances[] = {{"the left tip", engine.tip(0).place.norm()},
                                                      {"the right tip", engine.tip(1).place.norm()},
                                                      {"the diabolo", engine.body().position.norm()}};
  for (const auto& [what, distance] : distances)
    if (!(distance < diabolo::kLargestCoordinate))
      throw std::runtime_error(std::string(what) + " is " + diabolo::shown(distance) + " m off, " +
                               diabolo::shown(time) + " s into the motion; expected it within 100 m");
}

/// From tip to tip past the diabolo [m].
double path_of(const Engine& engine) {
  const auto middle = engine.body().position;
  return (engine.tip(0).place - middle).norm() + (engine.tip(1).place - middle).norm();
}

ordered_json played(const Scene& scene, double seconds) {
  Engine engine(scene, Engine::TipsMove::kByThemselves);
  diabolo_gazebo::StringOnLink string(diabolo::model_of_attributes(scene.element), scene.body, scene.gravity);
  ordered_json told{{"models", models_of(scene, engine)}, {"begin", places_of(engine)}};
  const double dt = engine.dt();
  double longest = path_of(engine), hardest = 0.0;
  for (int i = 0; i * dt < seconds; ++i) {
    expect_near(engine, i * dt);
    const diabolo::StringWrench wrench =
        string.step(engine.body(), {engine.tip(0), engine.tip(1)}, i * dt, dt);
    engine.pull_tips(wrench);
    engine.step(wrench);
    longest = std::max(longest, path_of(engine));
    hardest = std::max({hardest, wrench.left_tension, wrench.right_tension});
  }
  told["end"] = places_of(engine);
  told["longest_path"] = longest;     // [m]
  told["largest_tension"] = hardest;  // [N]
  return told;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path world;
  double seconds = 0.0;
  CLI::App app(
      "Play a world whose tips move by themselves in Gazebo's engine dartsim. Prints where all was.");
  app.add_option("WORLD.sdf", world, "a world with a model that has the plugin diabolo::String")->required();
  app.add_option("SECONDS", seconds, "how long")->required()->check(CLI::Range(0.0, 600.0));
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "diabolo_gazebo_alone: " + std::string(error.what()) + "; see --help\n";
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (std::isnan(seconds)) throw std::invalid_argument("SECONDS: nan; expected a number from 0 to 600");
    std::cout << played(diabolo_gazebo::load_scene(world), seconds).dump(2) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "diabolo_gazebo_alone: " << error.what() << '\n';
    return 2;
  }
}
