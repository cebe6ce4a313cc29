// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <sdf/sdf.hh>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/text/file.hpp"
#include "string_on_link.hpp"

namespace diabolo_gazebo {

inline constexpr const char* kPlugin = "diabolo::String";

/// An SDF world, and what its diabolo::String says.
struct Scene {
  sdf::Root root;
  const sdf::World* world;  ///< of `root`
  std::string model;        ///< the name of the model that has the plugin
  std::string axle;         ///< its joint on which the spinning link turns; empty where the link spins itself
  StringElement element;
  Body body;
  Vector3<double> gravity;  ///< [m/s^2]
  std::int64_t step;        ///< of the engine [ns]
};

/// MODEL::LINK as its two names. Throws std::invalid_argument.
inline std::pair<std::string, std::string> scoped(const std::string& name) {
  const std::size_t colons = name.find("::");
  if (colons == std::string::npos) throw std::invalid_argument("\"" + name + "\"; expected MODEL::LINK");
  return {name.substr(0, colons), name.substr(colons + 2)};
}

/// The link of a world, which a child of the plugin's names. Throws std::invalid_argument.
inline const sdf::Link& link_of(const sdf::World& world, const std::string& child, const std::string& model,
                                const std::string& link) {
  const sdf::Model* const in = world.ModelByName(model);
  const sdf::Link* const found = in == nullptr ? nullptr : in->LinkByName(link);
  const std::string shown_model = "model \"" + model + "\"";
  const std::string fault = in == nullptr      ? "the world has no " + shown_model
                            : found == nullptr ? "the " + shown_model + " has no link \"" + link + "\""
                            : in->Static()     ? "the " + shown_model + " is static; expected one that moves"
                                               : "";
  if (!fault.empty()) throw std::invalid_argument("<" + child + ">: " + fault);
  return *found;
}

/// The joint about x on which the spinning link turns on the other. Throws std::invalid_argument.
inline std::string axle_of(const sdf::Model& model, const std::string& link, const std::string& spinning) {
  for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
    const sdf::Joint& joint = *model.JointByIndex(i);
    if (joint.ParentLinkName() == link && joint.ChildLinkName() == spinning &&
        joint.Type() == sdf::JointType::REVOLUTE && joint.Axis(0)->Xyz() == ignition::math::Vector3d::UnitX)
      return joint.Name();
  }
  throw std::invalid_argument("<spinning_link>: the model has no revolute joint from \"" + link + "\" to \"" +
                              spinning + "\" about 1 0 0");
}

/// Fills in what the element and the model say. Throws std::invalid_argument.
inline void read_plugin(const sdf::Model& model, const sdf::ElementPtr& plugin, Scene& scene) {
  scene.model = model.Name();
  scene.element = read_string_element(plugin);
  const std::string link = scene.element.needed("link"),
                    spinning = scene.element("spinning_link").empty() ? link : scene.element("spinning_link");
  const sdf::Link& pulled = link_of(*scene.world, "link", scene.model, link);
  const sdf::Link& turning = link_of(*scene.world, "spinning_link", scene.model, spinning);
  check_links(model.LinkCount(), spinning == link);
  scene.body = body_of(pulled.Inertial(), turning.Inertial());
  if (spinning != link) scene.axle = axle_of(model, link, spinning);
  for (const char* const tip : {"left", "right"}) {
    const auto [its_model, its_link] = scoped(scene.element.needed(tip));
    link_of(*scene.world, tip, its_model, its_link);
    if (its_model == scene.model)
      throw std::invalid_argument("<" + std::string(tip) +
                                  ">: a link of the diabolo; expected another model");
  }
  if (scene.element("left") == scene.element("right"))
    throw std::invalid_argument("<right>: the same link as <left>; expected two");
}

/// Reads a world with one diabolo::String. Throws diabolo::RecordingError with the file and the fault.
inline Scene load_scene(const std::filesystem::path& path) {
  const std::string file = path.string();
  // Of other XML sdformat's reader of URDF would say on its own what is wrong with it as a robot.
  if (diabolo::read_file(path).find("<sdf") == std::string::npos)
    throw diabolo::RecordingError(file + ": no <sdf>; expected an SDF world");
  sdf::Console::Instance()->SetQuiet(true);
  Scene scene{};
  const sdf::Errors errors = scene.root.Load(file);
  if (!errors.empty() && errors.front().Code() == sdf::ErrorCode::FILE_READ)
    throw diabolo::RecordingError(file + ": sdformat cannot read it; expected SDF, in XML that is whole");
  if (!errors.empty()) throw diabolo::RecordingError(file + ": " + errors.front().Message());
  scene.world = scene.root.WorldByIndex(0);
  if (scene.world == nullptr) throw diabolo::RecordingError(file + ": no <world>; expected one");
  scene.gravity = vector_of(scene.world->Gravity());
  const double step = scene.world->PhysicsDefault()->MaxStepSize();
  scene.step = 10'000 * std::llround(1e5 * step);
  if (!(step <= 0.02) || scene.step <= 0 || std::abs(1e-9 * static_cast<double>(scene.step) - step) > 1e-12)
    throw diabolo::RecordingError(file + ": <max_step_size> " + diabolo::shown(step) +
                                  " s; expected a multiple of 1e-05, up to 0.02");
  for (std::uint64_t i = 0; i < scene.world->ModelCount(); ++i) {
    const sdf::Model& model = *scene.world->ModelByIndex(i);
    for (sdf::ElementPtr plugin = model.Element()->FindElement("plugin"); plugin;
         plugin = plugin->GetNextElement("plugin")) {
      if (plugin->Get<std::string>("name") != kPlugin) continue;
      const std::string where = file + ": plugin " + kPlugin + " of model \"" + model.Name() + "\": ";
      if (!scene.model.empty())
        throw diabolo::RecordingError(where + "a second one; expected one in the world");
      try {
        read_plugin(model, plugin, scene);
      } catch (const std::invalid_argument& error) {
        throw diabolo::RecordingError(where + error.what());
      }
    }
  }
  if (scene.model.empty())
    throw diabolo::RecordingError(file + ": no model has <plugin name=\"" + std::string(kPlugin) +
                                  "\">; expected one");
  return scene;
}

}  // namespace diabolo_gazebo
