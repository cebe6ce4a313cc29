// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <sdf/Element.hh>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/hosts/string_attributes.hpp"

namespace diabolo_gazebo {

/// What a <plugin name="diabolo::String"> of an SDF model says.
struct StringElement {
  std::map<std::string, std::string> words;  ///< by the name of the child; none is empty

  /// The text of a child; empty where there is none.
  std::string operator()(const std::string& name) const {
    const auto word = words.find(name);
    return word == words.end() ? "" : word->second;
  }

  /// Throws std::invalid_argument where there is none.
  const std::string& needed(const std::string& name) const {
    const auto word = words.find(name);
    if (word == words.end())
      throw std::invalid_argument("<" + name + "> is missing; expected the name of a link");
    return word->second;
  }
};

/// Where a model file is that an SDF file names: relative to the latter's folder.
inline std::string beside(const std::string& sdf_file, const std::string& model) {
  const bool is_path = !diabolo::is_preset(model) && model[0] != '{';
  return is_path ? (std::filesystem::path(sdf_file).parent_path() / model).string() : model;
}

/// Reads the children of the element. Throws std::invalid_argument where one is unknown, empty or there
/// twice.
inline StringElement read_string_element(const sdf::ElementConstPtr& plugin) {
  std::vector<std::string> known = diabolo::string_attributes();
  known.insert(known.end(), {"link", "spinning_link", "left", "right", "tips_topic", "state_topic"});
  StringElement element;
  for (sdf::ElementConstPtr child = plugin->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string name = child->GetName();
    if (std::ranges::find(known, name) == known.end())
      throw std::invalid_argument("<" + name +
                                  "> is unknown; expected link, spinning_link, left, right, tips_topic, "
                                  "state_topic, model or a number of a model, such as string_length");
    const std::string text = child->Get<std::string>();
    if (text.empty()) throw std::invalid_argument("<" + name + "> is empty; expected a text");
    if (!element.words.emplace(name, text).second)
      throw std::invalid_argument("<" + name + "> is there twice");
  }
  if (const auto model = element.words.find("model"); model != element.words.end())
    model->second = beside(plugin->FilePath(), model->second);
  return element;
}

}  // namespace diabolo_gazebo
