// SPDX-License-Identifier: MIT
// What the page calls: our string and the published rules as a ghost, under the same two tips. `make page`
// compiles it to WebAssembly, in one page that needs no network.
#include <emscripten.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "diabolo/full_predictor.hpp"
#include "diabolo/json/agent_file.hpp"
#include "diabolo/learn/follow_pointers.hpp"
#include "diabolo/learn/live_agent.hpp"
#include "diabolo/model.hpp"
#include "diabolo/strand_tensions.hpp"
#include "diabolo/string/hanging.hpp"

namespace {

using namespace diabolo;

constexpr double kDt = 1e-3, kSpin = 60.0;

struct World {
  Model model = consistent_model();
  std::optional<FullPredictor<double>> ours, published;
  State<double> state, ghost;
  Hands hands;
  std::optional<LiveAgent> agent;
  Hands next;            ///< of the agent, at the end of its period
  double begun = 0.0;    ///< that period [s]
  double time = 0.0;     ///< [s]
  double turned = 0.0;   ///< by the spin [rad]
  double tension = 0.0;  ///< of a strand, without friction [N]
  double owed = 0.0;     ///< time that was asked for and not played, less than a step [s]

  void reset() {
    hands = {};
    hands.position = {Vector3<double>(0.0, 0.4, 1.25), Vector3<double>(0.0, -0.4, 1.25)};
    next = hands;
    state = hanging_state(hands.position[0], hands.position[1], model.parameters.string_length, kSpin);
    ghost = hanging_state(hands.position[0], hands.position[1], published->parameters().string_length, kSpin);
    begun = time;
    turned = 0.0;
  }

  void build() {
    ours.emplace(model.parameters, model.effects);
    Parameters<double> rules = published_model().parameters;
    rules.string_length = model.parameters.string_length;
    published.emplace(rules, AllEffects<double>());
    reset();
  }

  /// Moves the hands by a step of what the agent does.
  void obey() {
    if (time >= begun + agent->agent().period - 0.5 * kDt) {
      begun = time;
      hands = next;
      next = agent->act(state);
    }
    const double left = begun + agent->agent().period - time;
    for (std::size_t side = 0; side < 2; ++side) {
      const Vector3<double> change = (next.velocity[side] - hands.velocity[side]) * std::min(1.0, kDt / left);
      hands.position[side] += (hands.velocity[side] + 0.5 * change) * kDt;
      hands.velocity[side] += change;
    }
  }

  void step(const std::array<Vector3<double>, 2>& wanted) {
    const Tips<double> begin = tips_of(hands, time);
    if (agent)
      obey();
    else
      follow_pointers(hands, wanted, model.parameters.string_length, kDt);
    time += kDt;
    const Tips<double> end = tips_of(hands, time);
    const State<double> before = state;
    ours->step(state, begin, end, kDt);
    published->step(ghost, begin, end, kDt);
    turned += state.spin * kDt;
    const auto [left, right] = strand_tensions(*ours, before, state, begin, end, kDt);
    tension = 0.5 * (left + right);
  }
};

World& world() {
  static World the;
  if (!the.ours) the.build();
  return the;
}

std::array<double, 16> seen;

}  // namespace

extern "C" {

/// Friction [1], linear drag [1/s] and the string's length [m]; begins again.
EMSCRIPTEN_KEEPALIVE void diabolo_set(double friction, double drag, double length) {
  World& the = world();
  the.model.effects.get<StringFriction>().coefficient = friction;
  the.model.effects.get<Air>().linear_drag = drag;
  the.model.parameters.string_length = length;
  the.agent.reset();
  the.build();
}

EMSCRIPTEN_KEEPALIVE void diabolo_reset() {
  world().agent.reset();
  world().reset();
}

/// Gives the sticks to a shipped agent: 0 SpinUp, 1 ThrowAndCatch.
EMSCRIPTEN_KEEPALIVE void diabolo_agent(int which) {
  World& the = world();
  the.agent.reset();
  the.reset();
  LiveOptions options;
  options.string_length = the.model.parameters.string_length;
  options.goal = {0.5, 0.0};
  the.agent.emplace(load_agent(which == 0 ? "SpinUp.json" : "ThrowAndCatch.json"), the.hands, options);
  the.next = the.agent->act(the.state);
}

/// Plays so many seconds while the pointers are at left y, z and right y, z [m], y to the left. Returns what
/// is seen: of the diabolo y, z, state, spin [rad/s], how far it has turned [rad], tension [N]; of the ghost
/// y, z, state, spin; of the tips left y, z, right y, z; of both diabolos x.
EMSCRIPTEN_KEEPALIVE const double* diabolo_play(double seconds, double left_y, double left_z, double right_y,
                                                double right_z) {
  World& the = world();
  const std::array<Vector3<double>, 2> wanted{Vector3<double>(0.0, left_y, left_z),
                                              Vector3<double>(0.0, right_y, right_z)};
  the.owed += std::clamp(seconds, 0.0, 0.1);
  for (; the.owed >= kDt; the.owed -= kDt) the.step(wanted);
  const auto& [left, right] = the.hands.position;
  seen = {the.state.position.y(),
          the.state.position.z(),
          static_cast<double>(the.state.string_state),
          the.state.spin,
          the.turned,
          the.tension,
          the.ghost.position.y(),
          the.ghost.position.z(),
          static_cast<double>(the.ghost.string_state),
          the.ghost.spin,
          left.y(),
          left.z(),
          right.y(),
          right.z(),
          the.state.position.x(),
          the.ghost.position.x()};
  return seen.data();
}
}
