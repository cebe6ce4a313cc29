// SPDX-License-Identifier: MIT
// 6. Run a diagnosed model: what `diabolo diagnose` emitted, beside the model that it started from.
//
//     diabolo diagnose swing.csv hop.csv --out diagnosis
//     06_run_a_diagnosed_model diagnosis/model.json linear_acceleration.csv
//
// Without arguments: a model with the friction that such a diagnosis finds on the recordings that ship.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "diabolo/evaluate/evaluation.hpp"
#include "diabolo/json/model_file.hpp"
#include "diabolo/json/recording_file.hpp"

int main(int argc, char** argv) try {
  const std::filesystem::path here = std::filesystem::path(__FILE__).parent_path();
  const diabolo::Model base = diabolo::consistent_model();
  diabolo::Model diagnosed = base;
  diagnosed.effects.get<diabolo::StringFriction>().coefficient = 0.3;
  if (argc > 1) diagnosed = diabolo::load_model(argv[1]);
  const diabolo::Recording recording = diabolo::load_recording(
      argc > 2 ? argv[2] : here.parent_path() / "data/recordings/linear_acceleration.csv");

  const auto before = score_horizons(recording, base), after = score_horizons(recording, diagnosed);
  std::printf("%s, mean error [m]\nafter    %12s %12s\n", recording.name.c_str(), base.name.c_str(),
              "diagnosed");
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i].model && after[i].model)
      std::printf("%.2f s   %12.4f %12.4f\n", before[i].horizon, before[i].model->mean, after[i].model->mean);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
