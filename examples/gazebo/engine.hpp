// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/FreeGroup.hh>
#include <ignition/physics/GetEntities.hh>
#include <ignition/physics/Joint.hh>
#include <ignition/physics/Link.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/config.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/state.hpp"
#include "scene.hpp"

namespace diabolo_gazebo {

namespace physics = ignition::physics;

/// Gazebo's physics without Gazebo: a world in its engine dartsim, in which the diabolo and the tips are.
class Engine {
 public:
  enum class TipsMove { kAsPut, kByThemselves };  ///< by put_tips(), or as links of a robot do

  /// Throws std::runtime_error where the engine cannot be loaded or a link that is put is no free one.
  explicit Engine(const Scene& scene, TipsMove tips = TipsMove::kAsPut)
      : world_(constructed(*scene.world)), step_(scene.step) {
    const auto model = world_->GetModel(scene.model);
    link_ = model->GetLink(scene.element("link"));
    spinning_ = scene.axle.empty() ? link_ : model->GetLink(scene.element("spinning_link"));
    if (!scene.axle.empty()) axle_ = model->GetJoint(scene.axle);
    group_ = free_group(link_, scene.element("link"));
    attitude_ = link_->FrameDataRelativeToWorld().pose.linear();
    for (std::size_t k = 0; k < 2; ++k) {
      const auto [its_model, its_link] = scoped(scene.element(k == 0 ? "left" : "right"));
      tips_[k] = world_->GetModel(its_model)->GetLink(its_link);
      if (tips == TipsMove::kAsPut) tip_groups_[k] = free_group(tips_[k], its_link);
      sticks_[k] = tips_[k]->FrameDataRelativeToWorld().pose.linear();
    }
  }

  /// Length of a step [s].
  double dt() const { return 1e-9 * static_cast<double>(step_); }

  /// Directions of the sticks, left first: they keep them.
  Vector3<double> stick(std::size_t k) const { return sticks_[k].col(0); }

  diabolo::HostBody body() const {
    const auto frame = link_->FrameDataRelativeToWorld();
    const Vector3<double> axle = frame.pose.linear().col(0);
    return {frame.pose.translation(), frame.linearVelocity, axle,
            axle.dot(spinning_->FrameDataRelativeToWorld().angularVelocity)};
  }

  /// Puts the diabolo somewhere, in the attitude that the world's file gives it.
  void put(const diabolo::State<double>& state) {
    group_->SetWorldPose(placed(attitude_, state.position));
    const Vector3<double> turns =
        axle_ ? Vector3<double>(Vector3<double>::Zero()) : Vector3<double>(-state.spin * attitude_.col(0));
    group_->SetWorldAngularVelocity(turns);
    group_->SetWorldLinearVelocity(state.velocity);
    if (!axle_) return;
    axle_->SetPosition(0, 0.0);
    axle_->SetVelocity(0, -state.spin);
  }

  void put_tips(const Tips<double>& tips) {
    const std::array<const Vector3<double>*, 2> places{&tips.left, &tips.right},
        velocities{&tips.left_velocity, &tips.right_velocity};
    for (std::size_t k = 0; k < 2; ++k) {
      tip_groups_[k]->SetWorldPose(placed(sticks_[k], *places[k]));
      tip_groups_[k]->SetWorldAngularVelocity(Vector3<double>::Zero());
      tip_groups_[k]->SetWorldLinearVelocity(*velocities[k]);
    }
  }

  /// A tip that moves by itself.
  StringOnLink::SeenTip tip(std::size_t k) const {
    const auto frame = tips_[k]->FrameDataRelativeToWorld();
    return {frame.pose.translation(), frame.linearVelocity, frame.pose.linear().col(0), false};
  }

  /// What such tips feel of the string over the next step.
  void pull_tips(const diabolo::StringWrench& wrench) {
    tips_[0]->AddExternalForce(wrench.on_left);
    tips_[1]->AddExternalForce(wrench.on_right);
  }

  /// Links and joints of a model, as the engine has them.
  std::pair<std::size_t, std::size_t> counts(const std::string& model) const {
    const auto found = world_->GetModel(model);
    return {found->GetLinkCount(), found->GetJointCount()};
  }

  /// A step under the string's wrench.
  void step(const diabolo::StringWrench& wrench) {
    link_->AddExternalForce(wrench.force);
    spinning_->AddExternalTorque(wrench.torque);
    physics::ForwardStep::Input input;
    input.Get<std::chrono::steady_clock::duration>() = std::chrono::nanoseconds(step_);
    physics::ForwardStep::Output output;
    physics::ForwardStep::State state;
    world_->Step(output, state, input);
  }

 private:
  using Features = physics::FeatureList<physics::sdf::ConstructSdfWorld, physics::GetModelFromWorld,
                                        physics::GetLinkFromModel, physics::GetJointFromModel,
                                        physics::SetBasicJointState, physics::LinkFrameSemantics,
                                        physics::AddLinkExternalForceTorque, physics::SetFreeGroupWorldPose,
                                        physics::SetFreeGroupWorldVelocity, physics::ForwardStep>;
  using World = physics::World3dPtr<Features>;
  using Link = physics::Link3dPtr<Features>;
  using Joint = physics::Joint3dPtr<Features>;
  using FreeGroup = physics::FreeGroup3dPtr<Features>;

  static World constructed(const sdf::World& world) {
    const std::string library =
        std::string(IGNITION_PHYSICS_ENGINE_INSTALL_DIR) + "/libignition-physics5-dartsim-plugin.so.5";
    ignition::plugin::Loader loader;
    loader.LoadLib(library);
    const auto engine =
        physics::RequestEngine3d<Features>::From(loader.Instantiate("ignition::physics::dartsim::Plugin"));
    if (!engine)
      throw std::runtime_error(library + ": the engine cannot be loaded, or lacks what is needed of it");
    return engine->ConstructWorld(world);
  }

  static FreeGroup free_group(const Link& link, const std::string& name) {
    const FreeGroup group = link->FindFreeGroup();
    if (!group || group->RootLink()->EntityID() != link->EntityID())
      throw std::runtime_error("link \"" + name +
                               "\" is not the root of a free model; expected nothing that holds it");
    return group;
  }

  static Eigen::Isometry3d placed(const Eigen::Matrix3d& attitude, const Vector3<double>& place) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = attitude;
    pose.translation() = place;
    return pose;
  }

  World world_;
  std::int64_t step_;
  Link link_, spinning_;
  Joint axle_;
  FreeGroup group_;
  std::array<Link, 2> tips_;
  std::array<FreeGroup, 2> tip_groups_;
  Eigen::Matrix3d attitude_;
  std::array<Eigen::Matrix3d, 2> sticks_;
};

}  // namespace diabolo_gazebo
