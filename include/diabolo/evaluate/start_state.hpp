// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/spin.hpp"
#include "diabolo/recording/velocity.hpp"
#include "diabolo/state.hpp"
#include "diabolo/string/string_path.hpp"
#include "diabolo/string/tip_geometry.hpp"

namespace diabolo {

/// How the state at the start of a prediction is found.
enum class Start {
  kFair,       ///< from frames at or before the start only; the same for every model, but see StartsOnSpring
  kPublished,  ///< the authors' program: velocity from the start and the frame after it, string loose
};

/// Time that the fair start's velocity is taken from [s].
inline constexpr double kStartWindow = 0.1;

/// The fair start's velocity: slope at the start of a parabola through the frames of the last kStartWindow.
/// At 120 Hz these are 13 frames; the bandwidth is 13 Hz and the noise gain 33 /s. In the published takes
/// what limits it is the wobble of the recorded centre at the spin's 10 to 25 Hz, and narrower bands lose
/// catches.
inline VelocityFilter start_velocity_filter(double rate) {
  const int frames = static_cast<int>(std::clamp(std::round(kStartWindow * rate), 3.0, 999.0)) + 1;
  return local_polynomial(frames, 2, FilterWindow::kCausal);
}

/// Beyond this path length over the string's [m] a diabolo above the tips must be off the string, which
/// cannot be that long; covers its stretch and the errors of the tips.
inline constexpr double kOffStringExcess = 0.03;

/// Guesses the string's state at each row from this row and those before it, with the recording's own string
/// length. FLYING begins above the plane of the tips (see height_above_tips) where the string is slack by
/// more than c_F between the tips, or would be longer than it is by kOffStringExcess; it ends below that
/// plane. Else ON_STRING where the string is slack by no more than c_L (both on the distance to the spheroid,
/// to first order), and LOOSE. A row without the diabolo or a tip keeps the state of the row before it.
inline std::vector<StringState> guess_string_states(const Recording& recording) {
  const Parameters<double> defaults;
  std::vector<StringState> states(static_cast<std::size_t>(recording.size()), StringState::kLoose);
  StringState state = StringState::kLoose;
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    if (recording.left.valid[i] && recording.right.valid[i] && recording.diabolo.valid[i]) {
      Tips<double> tips;
      tips.left = recording.left.position.col(i);
      tips.right = recording.right.position.col(i);
      const Vector3<double> diabolo = recording.diabolo.position.col(i);
      const StringPath<double> path(diabolo, tips);
      const double slack = recording.string_length - path.length(), gradient = norm(path.gradient());
      const bool above = height_above_tips(diabolo, tips.left, tips.right) > 0.0;
      const bool off = slack < -kOffStringExcess || (slack > defaults.flying_distance * gradient &&
                                                     between_tips(diabolo, tips.left, tips.right));
      if (above && (off || state == StringState::kFlying))
        state = StringState::kFlying;
      else
        state = slack <= defaults.loose_distance * gradient ? StringState::kOnString : StringState::kLoose;
    }
    states[static_cast<std::size_t>(i)] = state;
  }
  return states;
}

/// Direction of the axle in each row, or in the last row before it where it was seen; forward (x >= 0), as
/// signed_spin() has it.
inline Eigen::Matrix3Xd axes(const Recording& recording) {
  Eigen::Matrix3Xd result(3, recording.size());
  Vector3<double> axis = Vector3<double>::UnitX();
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    const OrientationTrack& track = recording.diabolo_orientation;
    if (!track.empty() && track.valid[i]) {
      axis = Eigen::Quaterniond(Eigen::Vector4d(track.quaternion.col(i))) * Vector3<double>::UnitX();
      if (axis.x() < 0.0) axis = -axis;
    }
    result.col(i) = axis;
  }
  return result;
}

/// Start states over a recording. A spin that is not known yet is zero; where none is ever seen, it is
/// `unseen_spin`.
class StartStates {
 public:
  /// Throws RecordingError where the recording is not what its type promises.
  StartStates(const Recording& recording, bool signed_rule, double unseen_spin = 0.0)
      : position_(recording.diabolo.position),
        fair_velocity_(velocity(recording, recording.diabolo, start_velocity_filter(recording.rate))),
        published_velocity_(velocity(recording, recording.diabolo, forward_difference())),
        spin_before_(Eigen::VectorXd::Zero(recording.size())),
        spin_after_(Eigen::VectorXd::Zero(recording.size())),
        axis_(axes(recording)),
        states_(guess_string_states(recording)) {
    const Spin spin = signed_rule ? signed_spin(recording) : unsigned_spin(recording);
    for (Eigen::Index i = 0; i < recording.size(); ++i) {
      if (spin.valid[i]) spin_after_[i] = spin.value[i];
      if (i > 0) spin_before_[i] = spin.valid[i - 1] ? spin.value[i - 1] : spin_before_[i - 1];
    }
    if (!spin.valid.any()) {
      spin_before_.setConstant(unseen_spin);
      spin_after_.setConstant(unseen_spin);
    }
    spin_around_ =
        moving_mean(spin, std::max<Eigen::Index>(1, std::lround(0.5 * kStartWindow * recording.rate)));
  }

  /// The mean of the spins within half a kStartWindow of a row [rad/s]; NaN where fewer than half are seen.
  double spin_around(Eigen::Index row) const { return spin_around_[row]; }

  /// By how much the fair start's spin at a row is off that; NaN where it is not known.
  double spin_noise(Eigen::Index row) const { return std::abs(spin_before_[row] - spin_around_[row]); }

  /// Whether the start of this kind is known at a row.
  bool known(Start kind, Eigen::Index row) const {
    return kind == Start::kFair ? fair_velocity_.valid[row] : published_velocity_.valid[row];
  }

  /// The start at a row where it is known. Fair: the diabolo where it is, its velocity by
  /// start_velocity_filter(), the last spin and axle known by then, the string's state as guessed. Published:
  /// velocity and spin from this row and the next, the string loose.
  State<double> at(Start kind, Eigen::Index row) const {
    const bool fair = kind == Start::kFair;
    State<double> state;
    state.position = position_.col(row);
    state.velocity = (fair ? fair_velocity_ : published_velocity_).velocity.col(row);
    state.spin = (fair ? spin_before_ : spin_after_)[row];
    state.axis = axis_.col(row);
    state.string_state = fair ? states_[static_cast<std::size_t>(row)] : StringState::kLoose;
    return state;
  }

 private:
  Eigen::Matrix3Xd position_;
  Velocity fair_velocity_, published_velocity_;
  Eigen::VectorXd spin_before_, spin_after_;  ///< from the frames up to a row; from a row and the next
  Eigen::VectorXd spin_around_;
  Eigen::Matrix3Xd axis_;
  std::vector<StringState> states_;
};

}  // namespace diabolo
