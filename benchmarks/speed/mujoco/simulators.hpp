// SPDX-License-Identifier: MIT
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <diabolo/predictor.hpp>

#include "motions.hpp"

namespace diabolo {

/// Tips at the beginning and after each of `steps` equal steps, so that no simulator's time holds the making
/// of the motion.
inline std::vector<TipSample> sampled(const Motion& motion, int steps) {
  std::vector<TipSample> tips;
  for (int i = 0; i <= steps; ++i) tips.push_back(motion.at(kDuration * i / steps));
  return tips;
}

/// The library: a predictor with the inextensible string.
class OurSimulator {
 public:
  OurSimulator(const Motion& motion, int steps, const Parameters<double>& parameters)
      : predictor_(parameters), start_(motion.initial_state()), dt_(kDuration / steps) {
    for (const TipSample& sample : sampled(motion, steps)) tips_.push_back(sample);
  }

  int steps() const { return static_cast<int>(tips_.size()) - 1; }
  Vector3<double> position() const { return state_.position; }
  void reset() { state_ = start_; }

  /// Takes the steps from `first` up to `last`.
  void run(int first, int last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      predictor_.step(state_, tips_[i], tips_[i + 1], dt_);
  }

 private:
  Predictor<double> predictor_;
  State<double> start_, state_;
  std::vector<Tips<double>> tips_;
  double dt_;
};

/// MuJoCo with a model of which compare.py writes the text: a body `diabolo` on a tendon between the bodies
/// `left` and `right`, which are mocap bodies, or heavy ones on three slides that are put where the tips are
/// before each step, with the tips' velocity, and a force for their acceleration.
class MujocoSimulator {
 public:
  /// Throws std::invalid_argument with MuJoCo's own words when it cannot read the model.
  MujocoSimulator(const Motion& motion, int steps, const std::string& model_file)
      : tips_(sampled(motion, steps)), start_(motion.initial_state()) {
    char error[1000] = "";
    model_.reset(mj_loadXML(model_file.c_str(), nullptr, error, sizeof error));
    if (!model_) throw std::invalid_argument(model_file + ": " + error);
    model_->opt.timestep = kDuration / steps;
    data_.reset(mj_makeData(model_.get()));
    diabolo_ = joint_address("diabolo");
    left_ = joint_address("left");
    right_ = joint_address("right");
  }

  int steps() const { return static_cast<int>(tips_.size()) - 1; }
  Vector3<double> position() const {
    return Eigen::Map<const Vector3<double>>(data_->qpos + diabolo_.position);
  }

  void reset() {
    mj_resetData(model_.get(), data_.get());
    place(data_->qpos + diabolo_.position, start_.position);
    place(data_->qvel + diabolo_.velocity, start_.velocity);
  }

  void run(int first, int last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      place_tips(tips_[i]);
      mj_step(model_.get(), data_.get());
    }
    if (data_->warning[mjWARN_BADQACC].number > 0) throw std::runtime_error("MuJoCo: the motion diverges");
  }

 private:
  struct Address {
    int position = -1, velocity = -1;  ///< first element in qpos and in qvel; -1: a mocap body
  };

  Address joint_address(const std::string& body_name) const {
    const int body = mj_name2id(model_.get(), mjOBJ_BODY, body_name.c_str());
    if (body < 0) throw std::invalid_argument("the model has no body '" + body_name + "'");
    if (model_->body_mocapid[body] >= 0) return {};
    const int joint = model_->body_jntadr[body];
    return {model_->jnt_qposadr[joint], model_->jnt_dofadr[joint]};
  }

  void place_tips(const TipSample& tips) {
    if (left_.position < 0) {
      place(data_->mocap_pos, tips.left);
      place(data_->mocap_pos + 3, tips.right);
      return;
    }
    drive(left_, tips.left, tips.left_velocity, tips.left_acceleration);
    drive(right_, tips.right, tips.right_velocity, tips.right_acceleration);
  }

  void drive(const Address& at, const Vector3<double>& position, const Vector3<double>& velocity,
             const Vector3<double>& acceleration) {
    place(data_->qpos + at.position, position);
    place(data_->qvel + at.velocity, velocity);
    const double mass = model_->body_mass[model_->dof_bodyid[at.velocity]];
    place(data_->qfrc_applied + at.velocity, (acceleration + Vector3<double>(0, 0, gravity())) * mass);
  }

  double gravity() const { return -model_->opt.gravity[2]; }

  static void place(mjtNum* to, const Vector3<double>& value) { mju_copy3(to, value.data()); }

  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
  std::vector<TipSample> tips_;
  State<double> start_;
  Address diabolo_, left_, right_;
};

}  // namespace diabolo
