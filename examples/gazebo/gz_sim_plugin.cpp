// SPDX-License-Identifier: MIT
// The system plugin diabolo::String of gz-sim 8: our string between two links, on a free model that is the
// diabolo. README.md has its elements. Compiled here; not run here, where there is no Gazebo server.
#if __has_include(<gz/sim/System.hh>)
#include <gz/msgs/double_v.pb.h>
#include <gz/msgs/pose_v.pb.h>
#include <gz/common/Console.hh>
#include <gz/plugin/Register.hh>
#include <gz/sim/EntityComponentManager.hh>
#include <gz/sim/Link.hh>
#include <gz/sim/Model.hh>
#include <gz/sim/System.hh>
#include <gz/sim/Util.hh>
#include <gz/sim/World.hh>
#include <gz/sim/components/Inertial.hh>
#include <gz/transport/Node.hh>
#else
#include "declared/gz_sim_8.hpp"
#endif

#include <array>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "string_on_link.hpp"

namespace diabolo_gazebo {

using gz::math::Vector3d;
using gz::sim::EntityComponentManager;
using gz::sim::Link;

Vector3d gazebo_of(const Vector3<double>& v) { return {v.x(), v.y(), v.z()}; }

class DiaboloString : public gz::sim::System,
                      public gz::sim::ISystemConfigure,
                      public gz::sim::ISystemPreUpdate,
                      public gz::sim::ISystemReset {
 public:
  void Configure(const gz::sim::Entity& entity, const std::shared_ptr<const sdf::Element>& element,
                 EntityComponentManager& ecm, gz::sim::EventManager&) override {
    model_ = gz::sim::Model(entity);
    guarded(ecm, [&] {
      element_ = read_string_element(element);
      const std::string state = element_("state_topic"), tips = element_("tips_topic");
      state_ = node_.Advertise<gz::msgs::Double_V>(state.empty() ? "/diabolo/state" : state);
      if (!tips.empty() && !node_.Subscribe(tips, &DiaboloString::take_tips, this))
        throw std::invalid_argument("<tips_topic>: \"" + tips + "\"; expected the name of a topic");
    });
  }

  void PreUpdate(const gz::sim::UpdateInfo& info, EntityComponentManager& ecm) override {
    if (failed_ || info.paused || info.dt <= std::chrono::steady_clock::duration::zero()) return;
    guarded(ecm, [&] {
      if (!string_) attach(ecm);
      pull(info, ecm);
    });
  }

  void Reset(const gz::sim::UpdateInfo&, EntityComponentManager&) override {
    if (string_) {
      string_->reset();
      failed_ = false;  // what went wrong in motion; a wrong element stays one
    }
    held_ = {};
    const std::lock_guard lock(mutex_);
    wanted_.reset();
  }

 private:
  using Places = std::array<Vector3<double>, 2>;

  /// Says once what is wrong; the string does nothing from then on, or to the next reset.
  template <class Action>
  void guarded(const EntityComponentManager& ecm, const Action& action) {
    try {
      action();
    } catch (const std::exception& error) {
      failed_ = true;
      gzerr << "diabolo::String of model \"" << model_.Name(ecm) << "\": " << error.what() << std::endl;
    }
  }

  /// Two poses, of the tips: where they are to be after the next step.
  void take_tips(const gz::msgs::Pose_V& message) {
    Places places;
    for (int k = 0; k < 2 && message.pose_size() == 2; ++k) {
      const auto& place = message.pose(k).position();
      places[static_cast<std::size_t>(k)] = {place.x(), place.y(), place.z()};
    }
    if (message.pose_size() != 2 || !places[0].allFinite() || !places[1].allFinite()) {
      gzerr << "diabolo::String: a message of " << message.pose_size()
            << " poses; expected two finite ones, of the tips" << std::endl;
      return;
    }
    const std::lock_guard lock(mutex_);
    wanted_ = places;
  }

  /// When all models are there: the links, and the string.
  void attach(EntityComponentManager& ecm) {
    const auto own = [&](const std::string& child) {
      const Link link(model_.LinkByName(ecm, element_.needed(child)));
      return checked(link, child, ecm);
    };
    link_ = own("link");
    spinning_ = element_("spinning_link").empty() ? link_ : own("spinning_link");
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string child = k == 0 ? "left" : "right";
      const auto found = gz::sim::entitiesFromScopedName(element_.needed(child), ecm);
      tips_[k] = checked(Link(found.size() == 1 ? *found.begin() : gz::sim::kNullEntity), child, ecm);
      if (tips_[k].Entity() == link_.Entity() || tips_[k].Entity() == spinning_.Entity())
        throw std::invalid_argument("<" + child + ">: a link of the diabolo; expected another model");
    }
    if (tips_[0].Entity() == tips_[1].Entity())
      throw std::invalid_argument("<right>: the same link as <left>; expected two");
    check_links(model_.LinkCount(ecm), link_.Entity() == spinning_.Entity());
    const auto inertial = [&ecm](const Link& link) {
      const auto* component = ecm.Component<gz::sim::components::Inertial>(link.Entity());
      if (component == nullptr) throw std::invalid_argument("a link has no inertia; expected one");
      return component->Data();
    };
    const auto pulled = inertial(link_), turning = inertial(spinning_);
    const Body body = body_of(pulled, link_.Entity() == spinning_.Entity() ? pulled : turning);
    const auto gravity = gz::sim::World(gz::sim::worldEntity(ecm)).Gravity(ecm);
    string_.emplace(diabolo::model_of_attributes(element_), body,
                    vector_of(gravity.value_or(Vector3d::Zero)));
  }

  Link checked(const Link& link, const std::string& child, EntityComponentManager& ecm) const {
    if (!link.Valid(ecm))
      throw std::invalid_argument("<" + child + ">: \"" + element_(child) +
                                  "\"; expected the name of a link");
    link.EnableVelocityChecks(ecm);
    return link;
  }

  void pull(const gz::sim::UpdateInfo& info, EntityComponentManager& ecm) {
    const auto pose = link_.WorldPose(ecm);
    const auto velocity = link_.WorldLinearVelocity(ecm), turns = spinning_.WorldAngularVelocity(ecm);
    if (!pose || !velocity || !turns) return;  // not before the first step of the engine
    const Vector3<double> axle = vector_of(pose->Rot().XAxis());
    const diabolo::HostBody body{vector_of(pose->Pos()), vector_of(*velocity), axle,
                                 axle.dot(vector_of(*turns))};
    const double dt = std::chrono::duration<double>(info.dt).count(),
                 end = std::chrono::duration<double>(info.simTime).count();
    const bool placed = !element_("tips_topic").empty();
    const diabolo::StringWrench wrench =
        string_->step(body, {seen(0, placed, ecm), seen(1, placed, ecm)}, end - dt, dt);
    link_.AddWorldWrench(ecm, gazebo_of(wrench.force), Vector3d::Zero);
    spinning_.AddWorldWrench(ecm, Vector3d::Zero, gazebo_of(wrench.torque));
    if (!placed) {
      tips_[0].AddWorldWrench(ecm, gazebo_of(wrench.on_left), Vector3d::Zero);
      tips_[1].AddWorldWrench(ecm, gazebo_of(wrench.on_right), Vector3d::Zero);
    }
    publish(wrench, -body.axle_rate);
  }

  /// A tip as it is; one of a topic is put where the last message wants it, or stays.
  StringOnLink::SeenTip seen(std::size_t k, bool placed, EntityComponentManager& ecm) {
    const Link& tip = tips_[k];
    const auto pose = tip.WorldPose(ecm);
    if (!pose) throw std::runtime_error("a tip has no pose; expected one");
    StringOnLink::SeenTip shown{vector_of(pose->Pos()),
                                vector_of(tip.WorldLinearVelocity(ecm).value_or(Vector3d::Zero)),
                                vector_of(pose->Rot().XAxis()), placed};
    if (!placed) return shown;
    const std::lock_guard lock(mutex_);
    if (!held_[k]) held_[k] = shown.place;
    if (wanted_) held_[k] = (*wanted_)[k];
    shown.place = *held_[k];
    gz::sim::Model(gz::sim::topLevelModel(tip.Entity(), ecm))
        .SetWorldPoseCmd(ecm, {gazebo_of(shown.place), pose->Rot()});
    tip.SetLinearVelocity(ecm, Vector3d::Zero);  // else gravity would make it ever faster
    return shown;
  }

  void publish(const diabolo::StringWrench& wrench, double spin) {
    gz::msgs::Double_V message;
    for (const double number : {wrench.left_tension, wrench.right_tension, wrench.slip, spin,
                                static_cast<double>(string_->state())})
      message.add_data(number);
    state_.Publish(message);
  }

  StringElement element_;
  gz::sim::Model model_;
  Link link_, spinning_;
  std::array<Link, 2> tips_;
  std::optional<StringOnLink> string_;
  bool failed_ = false;

  std::mutex mutex_;              ///< of `wanted_`, which messages change
  std::optional<Places> wanted_;  ///< where the tips are to be
  std::array<std::optional<Vector3<double>>, 2> held_;

  gz::transport::Node::Publisher state_;
  gz::transport::Node node_;  ///< last: its threads end before what they use
};

}  // namespace diabolo_gazebo

GZ_ADD_PLUGIN(diabolo_gazebo::DiaboloString, gz::sim::System, diabolo_gazebo::DiaboloString::ISystemConfigure,
              diabolo_gazebo::DiaboloString::ISystemPreUpdate, diabolo_gazebo::DiaboloString::ISystemReset)
GZ_ADD_PLUGIN_ALIAS(diabolo_gazebo::DiaboloString, "diabolo::String")
