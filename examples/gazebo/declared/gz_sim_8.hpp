// SPDX-License-Identifier: MIT
#pragma once

// Declares what gz_sim_plugin.cpp uses of gz-sim 8, so that it is compiled where there is none: declarations
// alone, which nothing here runs. Where Gazebo is installed its own headers are taken.

#include <chrono>
#include <cstdint>
#include <ignition/math/Inertial.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>
#include <iostream>
#include <memory>
#include <optional>
#include <sdf/Element.hh>
#include <string>
#include <type_traits>
#include <unordered_set>

#define gzerr std::cerr
#define GZ_ADD_PLUGIN(PluginClass, Interface, ...) \
  Interface* made() { return new PluginClass; }
#define GZ_ADD_PLUGIN_ALIAS(PluginClass, ...) static_assert(std::is_class_v<PluginClass>);

namespace gz {
namespace math = ignition::math;

namespace msgs {
struct Vector3d {
  double x() const, y() const, z() const;
};
struct Pose {
  const Vector3d& position() const;
};
struct Pose_V {
  int pose_size() const;
  const Pose& pose(int) const;
};
struct Double_V {
  void add_data(double);
};
}  // namespace msgs

namespace transport {
struct Node {
  struct Publisher {
    template <class Message>
    bool Publish(const Message&);
  };
  template <class Message>
  Publisher Advertise(const std::string& topic);
  template <class Class, class Message>
  bool Subscribe(const std::string& topic, void (Class::*)(const Message&), Class*);
};
}  // namespace transport

namespace sim {
using Entity = std::uint64_t;
inline constexpr Entity kNullEntity = 0;
struct EventManager;

struct UpdateInfo {
  std::chrono::steady_clock::duration simTime, realTime, dt;
  std::uint64_t iterations;
  bool paused;
};

struct EntityComponentManager {
  template <class Component>
  const Component* Component(Entity) const;
};

namespace components {
struct Inertial {
  const math::Inertiald& Data() const;
};
}  // namespace components

Entity worldEntity(const EntityComponentManager&);
Entity topLevelModel(const Entity&, const EntityComponentManager&);
std::unordered_set<Entity> entitiesFromScopedName(const std::string&, const EntityComponentManager&,
                                                  Entity relative_to = kNullEntity,
                                                  const std::string& delimiter = "::");

struct World {
  explicit World(Entity = kNullEntity);
  std::optional<math::Vector3d> Gravity(const EntityComponentManager&) const;
};

struct Model {
  explicit Model(Entity = kNullEntity);
  std::string Name(const EntityComponentManager&) const;
  std::uint64_t LinkCount(const EntityComponentManager&) const;
  sim::Entity LinkByName(const EntityComponentManager&, const std::string&) const;
  void SetWorldPoseCmd(EntityComponentManager&, const math::Pose3d&);
};

struct Link {
  explicit Link(sim::Entity = kNullEntity);
  sim::Entity Entity() const;
  bool Valid(const EntityComponentManager&) const;
  void EnableVelocityChecks(EntityComponentManager&, bool = true) const;
  std::optional<math::Pose3d> WorldPose(const EntityComponentManager&) const;
  std::optional<math::Vector3d> WorldLinearVelocity(const EntityComponentManager&) const;
  std::optional<math::Vector3d> WorldAngularVelocity(const EntityComponentManager&) const;
  void SetLinearVelocity(EntityComponentManager&, const math::Vector3d&) const;
  void AddWorldWrench(EntityComponentManager&, const math::Vector3d& force,
                      const math::Vector3d& torque) const;
};

struct System {
  virtual ~System() = default;
};
struct ISystemConfigure {
  virtual ~ISystemConfigure() = default;
  virtual void Configure(const Entity&, const std::shared_ptr<const sdf::Element>&, EntityComponentManager&,
                         EventManager&) = 0;
};
struct ISystemPreUpdate {
  virtual ~ISystemPreUpdate() = default;
  virtual void PreUpdate(const UpdateInfo&, EntityComponentManager&) = 0;
};
struct ISystemReset {
  virtual ~ISystemReset() = default;
  virtual void Reset(const UpdateInfo&, EntityComponentManager&) = 0;
};
}  // namespace sim
}  // namespace gz
