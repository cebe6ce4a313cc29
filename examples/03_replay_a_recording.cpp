// SPDX-License-Identifier: MIT
// 3. Replay a recording: predict a recorded diabolo from the recorded stick tips.
//
// The recording comes from the project's plant, a simulator with friction, an elastic string and a camera's
// noise, none of which the predictor knows. The prediction starts again every 0.1 s from what was measured.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "diabolo/evaluate/evaluation.hpp"
#include "diabolo/json/recording_file.hpp"

int main(int argc, char** argv) try {
  const std::filesystem::path here = std::filesystem::path(__FILE__).parent_path();
  const std::filesystem::path path = argc > 1 ? argv[1] : here.parent_path() / "data/recordings/swing.csv";
  const diabolo::Recording recording = diabolo::load_recording(path);
  std::printf("%s: %td samples at %.0f Hz\n", recording.name.c_str(), recording.size(), recording.rate);

  std::printf("after   mean error   95 %% interval of the mean [m]   lowest point of the string [m]\n");
  for (const diabolo::HorizonScore& score : score_horizons(recording, diabolo::consistent_model())) {
    if (!score.model || !score.baseline) continue;
    std::printf("%.2f s %12.3f", score.horizon, score.model->mean);
    if (score.model->mean_ci95)
      std::printf("   [%.4f, %.4f]", score.model->mean_ci95->low, score.model->mean_ci95->high);
    else
      std::printf("   too few starts  ");
    std::printf("%31.3f\n", score.baseline->mean);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
