// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>

#include "scenario.hpp"
#include "techniques.hpp"

namespace plant {
namespace {

constexpr Range kDuration{0.01, 600.0};
constexpr Range kFrequency{0.05, 20.0};
constexpr Range kLength{0.0, 2.0};
constexpr Range kCycles{0.5, 1000.0};
constexpr Range kCount{1.0, 1000.0};
constexpr Range kAngleDeg{-360.0, 360.0};

/// Directions, left and right, of the named oscillations.
const std::map<std::string, Pair<Vec3>> kOscillations{{"beat", {Vec3::UnitZ(), -Vec3::UnitZ()}},
                                                      {"bounce", {Vec3::UnitZ(), Vec3::UnitZ()}},
                                                      {"swing", {Vec3::UnitY(), Vec3::UnitY()}},
                                                      {"spread", {Vec3::UnitY(), -Vec3::UnitY()}},
                                                      {"fore_aft", {Vec3::UnitX(), -Vec3::UnitX()}}};

std::string known_types() {
  std::string types = "hold, move, place, path, repeat, stick_sweep";
  for (const auto& [name, directions] : kOscillations) types += ", " + name;
  for (const auto& [name, technique] : techniques()) types += ", " + name;
  return types;
}

void add_elements(std::vector<Fields> elements, MotionBuilder& motion);

/// Length of an oscillation, given as `cycles` or as a `duration` [s].
double cycles_of(Fields& fields, double frequency) {
  if (!fields.has("duration")) return fields.number("cycles", kCycles);
  if (fields.has("cycles")) fields.fail("cycles", "this and a duration", "one of them");
  return std::max(kCycles.low, fields.number("duration", kDuration) * frequency);
}

/// Brings the hands to a pose in front of the player's middle.
void place(Fields& fields, MotionBuilder& motion) {
  const double duration = fields.number("duration", kDuration);
  const double distance = fields.number("distance", {0.05, 3.0});
  const Pair<Vec3> home = motion.home();
  double height = 0.5 * (home[0].z() + home[1].z());
  double left_higher = 0.0;
  fields.read("height", height, {-5.0, 5.0});
  fields.read("left_higher", left_higher, {-2.0, 2.0});
  motion.move(duration, {Vec3(0.0, 0.5 * distance, height + 0.5 * left_higher) - home[0],
                         Vec3(0.0, -0.5 * distance, height - 0.5 * left_higher) - home[1]});
}

void add_element(Fields& fields, MotionBuilder& motion) {
  std::string type;
  fields.read("type", type);
  if (type == "hold") {
    motion.hold(fields.number("duration", kDuration));
  } else if (type == "move") {
    const double duration = fields.number("duration", kDuration);
    motion.move(duration, {fields.vector("left"), fields.vector("right")});
  } else if (type == "place") {
    place(fields, motion);
  } else if (const auto named = kOscillations.find(type); named != kOscillations.end()) {
    const double amplitude = fields.number("amplitude", kLength);
    const double frequency = fields.number("frequency", kFrequency);
    motion.oscillate({amplitude * named->second[0], amplitude * named->second[1]}, frequency,
                     cycles_of(fields, frequency));
  } else if (type == "stick_sweep") {
    const double yaw = kRadiansPerDegree * fields.number("yaw_deg", kAngleDeg);
    const double pitch = kRadiansPerDegree * fields.number("pitch_deg", kAngleDeg);
    const double frequency = fields.number("frequency", kFrequency);
    motion.turn({yaw, -yaw}, {pitch, pitch}, frequency, cycles_of(fields, frequency));
  } else if (const auto technique = techniques().find(type); technique != techniques().end()) {
    double size = 1.0;
    double pace = 1.0;
    int count = 1;
    fields.read("size", size, {0.1, 3.0});
    fields.read("pace", pace, {0.2, 5.0});
    fields.read("count", count, kCount);
    for (int i = 0; i < count; ++i) add_technique(technique->second, size, pace, motion);
  } else if (type == "path") {
    const std::vector<double> times = fields.numbers("times");
    const Pair<std::vector<Vec3>> offsets{fields.vectors("left"), fields.vectors("right")};
    for (std::size_t side = 0; side < 2; ++side) {
      if (offsets[side].size() != times.size()) {
        fields.fail(side == 0 ? "left" : "right", std::to_string(offsets[side].size()) + " offsets",
                    std::to_string(times.size()) + ", one for each time");
      }
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!(times[i] > (i == 0 ? 0.0 : times[i - 1]))) {
        fields.fail("times", std::to_string(times[i]) + " s at place " + std::to_string(i + 1),
                    "times above 0 s that rise");
      }
    }
    motion.path(times, offsets);
  } else if (type == "repeat") {
    int count = 1;
    fields.read("count", count, kCount);
    const std::vector<Fields> elements = fields.objects("elements");
    for (int i = 0; i < count; ++i) add_elements(elements, motion);
  } else {
    fields.fail("type", '"' + type + '"', "one of " + known_types());
  }
  fields.finish();
}

void add_elements(std::vector<Fields> elements, MotionBuilder& motion) {
  for (Fields& fields : elements) add_element(fields, motion);
}

}  // namespace

Motion motion_from_fields(Fields fields, std::uint64_t seed) {
  SticksPose pose;
  fields.read("left", pose.tips[0]);
  fields.read("right", pose.tips[1]);
  for (std::size_t side = 0; side < 2; ++side) {
    Fields direction = fields.object(side == 0 ? "left_stick" : "right_stick");
    direction.read_degrees("yaw_deg", pose.yaws[side], kAngleDeg);
    direction.read_degrees("pitch_deg", pose.pitches[side], kAngleDeg);
    direction.finish();
  }
  Wander wander;
  fields.read("wander", wander.tips, {0.0, 0.1});
  fields.read_degrees("wander_deg", wander.directions, {0.0, 30.0});
  fields.read("wander_slowest", wander.slowest, {0.0, 10.0});
  fields.read("wander_fastest", wander.fastest, {wander.slowest, 10.0});
  MotionBuilder motion(pose);
  const std::vector<Fields> elements = fields.objects("elements");
  if (elements.empty()) fields.fail("elements", "[]", "at least one element");
  add_elements(elements, motion);
  fields.finish();
  return motion.finish(wander, seed);
}

}  // namespace plant
