// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "recording.hpp"
#include "scenario.hpp"

namespace {

constexpr int kBadInput = 2;
constexpr int kFailure = 1;

struct Options {
  std::string scenario;
  std::string out;
  std::string truth;
  std::optional<std::uint64_t> seed;
};

void make_recording(const Options& options) {
  using namespace plant;
  std::filesystem::path description = options.out;
  if (description.extension() != ".csv")
    throw ScenarioError("--out: found " + options.out + ", expected NAME.csv");
  description.replace_extension(".json");
  if (description == options.scenario) {
    throw ScenarioError("--out: its description would overwrite the scenario " + options.scenario);
  }

  const Scenario scenario = load_scenario(options.scenario, options.seed);
  const Plant plant(scenario.plant, scenario.motion);

  const auto play = [&](const CameraParameters& camera) {
    try {
      return simulate(plant, scenario.start, diabolo_times(camera, scenario.duration));
    } catch (const std::invalid_argument& error) {
      throw ScenarioError(options.scenario + ": " + error.what());
    }
  };
  const std::vector<Moment> moments = play(scenario.camera);
  const std::vector<Frame> frames = film(scenario.camera, scenario.motion, moments, scenario.seed);
  write_file(options.out,
             [&](std::ostream& out) { write_frames(out, frames, scenario.camera.stick_orientation); });
  write_file(description, [&](std::ostream& out) {
    write_description(out, scenario.plant.diabolo,
                      scenario.plant.string.length + scenario.string_length_error, scenario.camera.rate);
  });
  if (!options.truth.empty()) {
    CameraParameters ideal;
    ideal.rate = scenario.truth_rate;
    const std::vector<Moment> truth = play(ideal);
    write_file(options.truth, [&](std::ostream& out) { write_truth(out, plant, truth); });
  }
  std::cout << options.out << ": " << frames.size() << " frames";
  if (frames.back().time + 1.5 / scenario.camera.rate < scenario.duration) {
    std::cout << "; the diabolo missed the string and the recording ends at " << frames.back().time << " s";
  }
  std::cout << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Simulates diabolo play and films it: writes a tidy recording NAME.csv and NAME.json.");
  app.add_option("scenario", options.scenario, "Scenario file (JSON)")->required();
  app.add_option("--out", options.out, "Recording to write, NAME.csv")->required();
  app.add_option("--truth", options.truth, "True motion to write, CSV");
  app.add_option("--seed", options.seed, "Seed of all random numbers, in place of the scenario's");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  try {
    make_recording(options);
  } catch (const std::invalid_argument& error) {
    std::cerr << "diabolo-plant: " << error.what() << '\n';
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "diabolo-plant: " << error.what() << '\n';
    return kFailure;
  }
  return 0;
}
