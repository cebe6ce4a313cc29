// SPDX-License-Identifier: MIT
// 7. Diagnose a recording from C++: what does the default simulator leave out of it?
//
//     07_diagnose_a_recording swing.csv
//
// It includes the question and the answer alone, and links diabolo::diagnose, so it compiles in seconds.
// Without an argument it reads a recording that ships, whose string rubs on the axle.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/json/recording_file.hpp"

int main(int argc, char** argv) try {
  const std::filesystem::path here = std::filesystem::path(__FILE__).parent_path();
  const diabolo::Recording recording =
      diabolo::load_recording(argc > 1 ? argv[1] : here.parent_path() / "data/recordings/swing.csv");

  const diabolo::Diagnosis diagnosis = diabolo::diagnose({recording});
  std::printf("%s\n", diagnosis.sentence.c_str());
  for (const diabolo::Finding& finding : diagnosis.findings)
    if (finding.claimed)
      std::printf("  %s, %.1f standard deviations from nothing: %s\n", finding.candidate->name.data(),
                  finding.z, finding.reason.c_str());
  for (const diabolo::Proposal& next : diagnosis.proposals)
    std::printf("record next: %s\n", next.experiment->plain.data());
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
