// SPDX-License-Identifier: MIT
#include <cstdio>

#include <Eigen/Core>

#include <diabolo/version.hpp>

/// Says whether the library that was found has the version given on the command line.
int main(int argc, char** argv) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (argc != 2 || up.norm() != 1.0) return 2;
  std::printf("diabolo %s\n", diabolo::kVersion.data());
  return diabolo::kVersion == argv[1] ? 0 : 1;
}
