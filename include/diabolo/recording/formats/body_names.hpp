// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/recording/formats/tracked_take.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// One of the three bodies of play, and the names by which a calibration knows it.
struct WantedBody {
  const std::vector<std::string>& names;  ///< tried in order
  std::string_view role;                  ///< "the left stick", for messages
  std::string_view word;                  ///< what its name tells, in small letters: "left"
};

/// The first body of a take that has one of the names; null for none.
inline const TrackedBody* body_of_name(const TrackedTake& take, const std::vector<std::string>& names) {
  for (const std::string& wanted : names)
    for (const TrackedBody& body : take.bodies)
      if (body.name == wanted) return &body;
  return nullptr;
}

namespace recording_formats_detail {

inline bool tells(std::string name, std::string_view word) {
  std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return name.find(word) != name.npos;
}

inline std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + shown(name);
  return text.empty() ? "none" : text;
}

}  // namespace recording_formats_detail

/// The bodies of a take that are wanted: by name, else the only one that has no wanted name but a telling
/// one, such as "stick_right_2010_10" for the right stick; a note says so. Throws RecordingError that names
/// the choices where there are several, and all bodies where there is none.
inline std::array<const TrackedBody*, 3> find_bodies(const std::array<WantedBody, 3>& wanted,
                                                     const TrackedTake& take,
                                                     std::vector<std::string>& notes) {
  std::array<const TrackedBody*, 3> found;
  for (std::size_t k = 0; k < 3; ++k) found[k] = body_of_name(take, wanted[k].names);
  const std::array<const TrackedBody*, 3> named = found;
  for (std::size_t k = 0; k < 3; ++k) {
    if (named[k] != nullptr) continue;
    std::vector<std::string> choices, all;
    for (const TrackedBody& body : take.bodies) {
      all.push_back(body.name);
      if (std::ranges::find(named, &body) != named.end()) continue;
      std::size_t words = 0;
      for (const WantedBody& any : wanted) words += recording_formats_detail::tells(body.name, any.word);
      if (words != 1 || !recording_formats_detail::tells(body.name, wanted[k].word)) continue;
      choices.push_back(body.name);
      found[k] = &body;
    }
    const std::string role(wanted[k].role);
    if (choices.empty())
      throw RecordingError(take.file_name + ": no rigid body for " + role + ": tried " +
                           recording_formats_detail::listed(wanted[k].names) + "; the file has " +
                           recording_formats_detail::listed(all));
    if (choices.size() > 1)
      throw RecordingError(take.file_name + ": several rigid bodies may be " + role + ": " +
                           recording_formats_detail::listed(choices) +
                           "; expected one, or its name in a calibration");
    notes.push_back(shown(choices.front()) + " is taken for " + role +
                    ", by its name; the calibration is of " +
                    recording_formats_detail::listed(wanted[k].names));
  }
  return found;
}

}  // namespace diabolo
