// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "diabolo/robot/arm/stick_map.hpp"

namespace diabolo {

/// The paper's arms where the authors' program has them: 75 cm high, 105 cm apart, the right one 4 mm back.
inline StickArm authors_arm(Side side) {
  StickArm arm = paper_arm(side, {0.75, 1.05, 0.0});
  if (side == Side::kRight) arm.base.position.x() = -0.004;
  return arm;
}

/// The authors' key points (omron-sinicx/diabolo): q1 to q5 [rad] in the order of GridBox::place; q6 is zero.
inline constexpr std::array<std::array<double, 5>, 18> kAuthorsRightJoints{{
    {2.3820573, -1.732438, -1.704855, -1.26479, 1.883484},
    {1.839867, -1.57383, -1.808979, -1.32967, 3.2721328},
    {2.5468708, -1.60854, -1.44365, -1.74608, 4.660817},
    {3.334982, -1.34246, -2.0474628, -1.322327, 1.7459701},
    {2.415591, -1.00087, -2.139281, -1.57228, 3.210394},
    {3.4700577, -1.290418, -1.745159, -1.6769141, 4.6744418},
    {4.1556396, -1.70487, -1.70484, -1.209921, 1.6086514},
    {3.482829, -1.644261, -1.595829, -1.472347, 3.148369},
    {4.1556194, -1.71851, -1.3543426, -1.691183, 4.6882685},
    {2.7737909, -2.35111, -0.769943, -1.484917, 1.608631},
    {2.293496, -2.392607, -0.500967, -1.81867, 3.148434},
    {2.773857, -2.199702, -0.522359, -2.296041, 4.6883362},
    {3.334379, -2.160515, -1.0560959, -1.4957559, 1.594846},
    {2.773482, -2.0173692, -1.1112005, -1.5838095, 3.1415309},
    {3.3300614, -2.2015111, -0.6654887, -1.8454276, 4.6883778},
    {3.8255423, -2.33722, -0.80428, -1.4298051, 1.581155},
    {3.3504417, -2.6259605, -0.0355431, -2.050391, 3.1364368},
    {3.82565, -2.14473, -0.481206, -2.54128, 4.688416},
}};
inline constexpr std::array<std::array<double, 5>, 18> kAuthorsLeftJoints{{
    {2.010787, -1.464146, 1.739275, -1.93176, 4.8257855},
    {2.798185, -1.506126, 1.522862, -1.587348, 3.2171073},
    {2.113937, -1.43666, 1.354283, -1.423074, 1.6086422},
    {2.7263822, -1.871471, 2.080763, -1.78003, 4.7570285},
    {3.883236, -2.149996, 2.028239, -1.449263, 3.1828225},
    {2.803191, -1.861955, 1.7508655, -1.4597035, 1.608522},
    {3.7223992, -1.450573, 1.7116366, -1.863017, 4.6883675},
    {4.459788, -1.601987, 1.6968096, -1.665612, 3.14835},
    {3.6813031, -1.5192674, 1.4504566, -1.4367097, 1.6085096},
    {2.464541, -0.735655, 0.666898, -1.61538, 4.6883989},
    {2.931982, -0.584309, 0.184004, -1.1706853, 3.1478988},
    {2.4644107, -0.8456364, 0.350563, -0.790528, 1.6085096},
    {2.955401, -0.98844, 1.0652036, -1.6477537, 4.6882462},
    {3.512974, -1.1336696, 1.135261, -1.5724076, 3.1415501},
    {2.946453, -0.9558896, 0.6886225, -1.3036189, 1.5947496},
    {3.5162044, -0.88671, 0.9487116, -1.78053, 4.6882511},
    {3.99388, -0.7650137, 0.5413707, -1.3470459, 3.13471},
    {3.495548, -1.09309, 0.6393343, -0.684762, 1.5811468},
}};

/// The authors' seed grid, linear between 2 x 3 x 3 key points. It was made for an older tip and calibrated
/// arms: on the nominal arm of authors_arm() the tip misses its key points by 7 to 29 mm, and more in
/// between. A starting point and a yardstick, not truth.
inline IkSeedGrid authors_seed_grid(Side side) {
  GridBox box;
  box.lower = {0.425, side == Side::kRight ? -0.95 : 0.05, 0.8};
  box.upper = {0.775, side == Side::kRight ? -0.05 : 0.95, 1.8};
  box.knots = {2, 3, 3};
  std::vector<Joints<double>> joints;
  for (const std::array<double, 5>& q : side == Side::kRight ? kAuthorsRightJoints : kAuthorsLeftJoints) {
    Joints<double> row;
    row << q[0], q[1], q[2], q[3], q[4], 0.0;
    joints.push_back(row);
  }
  return IkSeedGrid(box, std::move(joints), GridInterpolation::kLinear);
}

}  // namespace diabolo
