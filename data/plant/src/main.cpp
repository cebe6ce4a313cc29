// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "key.hpp"
#include "live.hpp"
#include "recording.hpp"
#include "scenario.hpp"
#include "take.hpp"

namespace {

constexpr int kBadInput = 2;
constexpr int kFailure = 1;

struct Options {
  std::string scenario;
  std::string out;
  std::string truth;
  std::string key;
  std::optional<std::uint64_t> seed;
  bool live = false;
};

/// Whether two names lead to the same file.
bool same_file(const std::filesystem::path& one, const std::filesystem::path& other) {
  return std::filesystem::weakly_canonical(one) == std::filesystem::weakly_canonical(other);
}

/// Refuses outputs that would overwrite one another or the scenario.
void check_names(const Options& options, const std::filesystem::path& description) {
  const auto check = [](const char* option, const std::string& name, const std::filesystem::path& other) {
    if (!same_file(name, other)) return;
    throw plant::ScenarioError(std::string(option) + ": " + name + " would overwrite " + other.string());
  };
  check("--out", description.string(), options.scenario);
  check("--out", options.out, options.scenario);
  std::vector<std::filesystem::path> taken{options.scenario, options.out, description};
  for (const auto& [option, name] : {std::pair{"--truth", options.truth}, std::pair{"--key", options.key}}) {
    if (name.empty()) continue;
    for (const std::filesystem::path& other : taken) check(option, name, other);
    taken.push_back(name);
  }
}

plant::Take played(const Options& options, const plant::Scenario& scenario) {
  try {
    return plant::take(scenario, !options.truth.empty());
  } catch (const std::invalid_argument& error) {
    throw plant::ScenarioError(options.scenario + ": " + error.what());
  } catch (const std::domain_error& error) {
    throw plant::ScenarioError(options.scenario + ": " + error.what());
  }
}

void make_recording(const Options& options) {
  using namespace plant;
  std::filesystem::path description = options.out;
  if (description.extension() != ".csv") {
    throw ScenarioError("--out: found " + options.out + ", expected NAME.csv");
  }
  description.replace_extension(".json");
  check_names(options, description);

  const Scenario scenario = load_scenario(options.scenario, options.seed);
  const Take take = played(options, scenario);
  const std::vector<Frame> frames = film(scenario.camera, scenario.motion, take.filmed, scenario.seed);
  write_file(options.out,
             [&](std::ostream& out) { write_frames(out, frames, scenario.camera.stick_orientation); });
  write_file(description, [&](std::ostream& out) { write_description(out, scenario); });
  if (!options.key.empty()) write_file(options.key, [&](std::ostream& out) { write_key(out, scenario); });
  if (!options.truth.empty()) {
    const std::unique_ptr<Plant> plant = make_plant(scenario.plant, scenario.motion);
    write_file(options.truth, [&](std::ostream& out) { write_truth(out, *plant, take.truth); });
  }
  std::cout << options.out << ": " << frames.size() << " frames";
  if (take.missed) {
    std::cout << "; the diabolo missed the string and the recording ends at " << frames.back().time << " s";
  }
  std::cout << '\n';
}

void play_hands_of_others(const Options& options) {
  if (!options.out.empty() || !options.truth.empty() || !options.key.empty()) {
    throw plant::ScenarioError("--live: writes no file; expected it without --out, --truth and --key");
  }
  plant::play_live(plant::load_scenario(options.scenario, options.seed), std::cin, std::cout);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Simulates diabolo play and films it: writes a tidy recording NAME.csv and NAME.json.");
  app.add_option("scenario", options.scenario, "Scenario file (JSON)")->required();
  app.add_option("--out", options.out, "Recording to write, NAME.csv");
  app.add_flag(
      "--live", options.live,
      "Play on with hands that are moved from outside: a line of standard input for each period, its "
      "duration and six accelerations; a line of standard output for each moment");
  app.add_option("--truth", options.truth, "True motion to write, CSV");
  app.add_option("--key", options.key, "True parameters to write, JSON, in the names of the diagnosis");
  app.add_option("--seed", options.seed, "Seed of all random numbers, in place of the scenario's");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "diabolo-plant: " + std::string(error.what()) + "; see --help\n";
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  try {
    if (options.live) {
      play_hands_of_others(options);
    } else {
      make_recording(options);
    }
  } catch (const std::invalid_argument& error) {
    std::cerr << "diabolo-plant: " << error.what() << '\n';
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "diabolo-plant: " << error.what() << '\n';
    return kFailure;
  }
  return 0;
}
