// SPDX-License-Identifier: MIT
// The engine plugin diabolo.string of MuJoCo: our string between two sites, on a free body that is the
// diabolo. docs/hosts.md has its attributes. All that changes stands in the plugin's state, so that copies,
// saved states, resets and MuJoCo's own rollouts work as for any other part of a model.
#include <mujoco/mjplugin.h>
#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/hosts/attach.hpp"
#include "diabolo/hosts/seen_tips.hpp"
#include "diabolo/hosts/string_attributes.hpp"

namespace {

using diabolo::Vector3;
using Seen = Eigen::Map<const Vector3<double>>;
using Turn = Eigen::Vector4d;  ///< a quaternion as MuJoCo has it

constexpr const char* kTips[2] = {"left", "right"};

/// Tensions, slip, spin, the string's state, and whether it is overstretched.
constexpr int kSeen = 6;

/// Where the two tips are and how they move, and what the next step begins with.
struct Memory {
  diabolo::StringMemory::Numbers string;
  double tip[2][3], rate[2][3];  ///< see diabolo::TipMemory
};

/// The plugin's state, numbers alone.
struct Stored {
  Memory now, next;  ///< of the step that is asked about, and of the one after it
  double begun;      ///< whether a step has been made since the reset
  double time;       ///< at which the step began that was asked about last [s], or kNoStep
  double force[3], torque[3], on_tip[2][3];
  double seen[kSeen];  ///< what the sensor says
};
constexpr double kNoStep = -1e300;  ///< none has begun
constexpr int kNumbers = sizeof(Stored) / sizeof(mjtNum);
static_assert(sizeof(mjtNum) == sizeof(double));

/// An attribute's text; empty where it is not given.
std::string attribute(const mjModel* m, int instance, const std::string& key) {
  const char* text = mj_getPluginConfig(m, instance, key.c_str());
  return text == nullptr ? "" : text;
}

void put(double* to, const Vector3<double>& from) { std::memcpy(to, from.data(), 3 * sizeof(double)); }

/// What an instance needs and never changes.
class StringOnBody {
 public:
  StringOnBody(const mjModel* m, int instance)
      : body_(body_of(m, instance)),
        sites_{site_of(m, instance, 0, body_), site_of(m, instance, 1, body_)},
        made_{.mass = m->body_mass[body_],
              .inertia = Seen(m->body_inertia + 3 * body_),
              .gravity = Seen(m->opt.gravity),
              .turn = Turn(m->body_iquat + 4 * body_),
              .integrator = m->opt.integrator,
              .disabled = m->opt.disableflags,
              .enabled = m->opt.enableflags},
        string_(string_of(m, instance)) {
    if (sites_[0] == sites_[1]) throw std::invalid_argument("right: the same site as left; expected two");
  }

  void pull(const mjModel* m, mjData* d, Stored& stored) const {
    if (!is_later_stage(m, d, stored)) ask(m, d, stored);
    push(m, d, Seen(stored.force), Seen(stored.torque));
    constexpr mjtNum kNone[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
      const int tip = m->site_bodyid[sites_[k]];
      if (m->body_treeid[tip] < 0) continue;  // nothing moves it
      mj_applyFT(m, d, stored.on_tip[k], kNone, d->site_xpos + 3 * sites_[k], tip, d->qfrc_passive);
    }
  }

  /// The two strands; where the diabolo flies, the string from tip to tip.
  void draw(const mjData* d, mjvScene* scene, bool flies) const {
    const mjtNum *left = d->site_xpos + 3 * sites_[0], *right = d->site_xpos + 3 * sites_[1],
                 *middle = flies ? right : d->xipos + 3 * body_;
    for (const auto& [from, to] : {std::pair(left, middle), std::pair(middle, right)}) {
      if (scene->ngeom >= scene->maxgeom || from == to) return;
      constexpr float kColour[4] = {0.95F, 0.95F, 0.95F, 1.0F};
      mjvGeom* geom = scene->geoms + scene->ngeom++;
      mjv_initGeom(geom, mjGEOM_CAPSULE, nullptr, nullptr, nullptr, kColour);
      mjv_connector(geom, mjGEOM_CAPSULE, 0.002, from, to);
    }
  }

 private:
  static int body_of(const mjModel* m, int instance) {
    int found = -1;
    for (int b = 0; b < m->nbody; ++b) {
      if (m->body_plugin[b] != instance) continue;
      if (found >= 0)
        throw std::invalid_argument("on the bodies " + name_of(m, found) + " and " + name_of(m, b) +
                                    "; expected one, which is the diabolo");
      found = b;
    }
    if (found < 0) throw std::invalid_argument("on no body; expected <plugin instance=...> in the diabolo's");
    if (m->body_jntnum[found] != 1 || m->jnt_type[m->body_jntadr[found]] != mjJNT_FREE)
      throw std::invalid_argument("body " + name_of(m, found) +
                                  " has no free joint; the diabolo must be a free body");
    for (int b = found + 1; b < m->nbody; ++b)
      if (m->body_parentid[b] == found)
        throw std::invalid_argument("body " + name_of(m, found) + " holds the body " + name_of(m, b) +
                                    "; expected the diabolo to be one body, of several geoms");
    if (m->body_gravcomp[found] != 0.0)
      throw std::invalid_argument("body " + name_of(m, found) + ": gravcomp " +
                                  std::to_string(m->body_gravcomp[found]) + "; expected none");
    return found;
  }

  static std::string name_of(const mjModel* m, int body) {
    const char* name = mj_id2name(m, mjOBJ_BODY, body);
    return name == nullptr ? "number " + std::to_string(body) : '"' + std::string(name) + '"';
  }

  static int site_of(const mjModel* m, int instance, int k, int body) {
    const std::string name = attribute(m, instance, kTips[k]);
    const int site = mj_name2id(m, mjOBJ_SITE, name.c_str());
    if (site < 0)
      throw std::invalid_argument(std::string(kTips[k]) + ": \"" + name + "\"; expected the name of a site");
    if (m->site_bodyid[site] == body)
      throw std::invalid_argument(std::string(kTips[k]) + ": \"" + name +
                                  "\" is on the diabolo; expected another body");
    return site;
  }

  /// What the host's world is like, and the body in it, that the string was made for.
  struct Made {
    double mass;
    Vector3<double> inertia, gravity;
    Turn turn;
    int integrator, disabled, enabled;
  };

  bool has_changed(const mjModel* m) const {
    return m->body_mass[body_] != made_.mass || Seen(m->body_inertia + 3 * body_) != made_.inertia ||
           m->body_gravcomp[body_] != 0.0 ||
           Eigen::Map<const Turn>(m->body_iquat + 4 * body_) != made_.turn ||
           Seen(m->opt.gravity) != made_.gravity || m->opt.integrator != made_.integrator ||
           ((m->opt.disableflags ^ made_.disabled) & mjDSBL_GRAVITY) != 0 ||
           ((m->opt.enableflags ^ made_.enabled) & mjENBL_SLEEP) != 0;
  }

  /// The string of the attributes, with the mass of the body and the gravity of the model.
  diabolo::AttachedString string_of(const mjModel* m, int instance) const {
    if (m->opt.enableflags & mjENBL_SLEEP)
      throw std::invalid_argument("sleep is enabled; expected it off: the string wakes nobody");
    const diabolo::Model model =
        diabolo::model_of_attributes([&](const std::string& key) { return attribute(m, instance, key); });
    const Vector3<double> axle = inertial_axle(m);
    const bool weightless = (m->opt.disableflags & mjDSBL_GRAVITY) != 0;
    return diabolo::attach_string(model, made_.mass, axle.dot(made_.inertia.asDiagonal() * axle),
                                  weightless ? Vector3<double>(Vector3<double>::Zero()) : made_.gravity,
                                  m->opt.integrator == mjINT_RK4 ? diabolo::HostMotion::kConstantForce
                                                                 : diabolo::HostMotion::kNewVelocity);
  }

  /// The body's x axis in the frame of its inertia.
  Vector3<double> inertial_axle(const mjModel* m) const {
    constexpr mjtNum kForward[3] = {1.0, 0.0, 0.0};
    mjtNum back[4], axle[3];
    mju_negQuat(back, m->body_iquat + 4 * body_);
    mju_rotVecQuat(axle, kForward, back);
    return Seen(axle);
  }

  /// Whether a Runge-Kutta step that has begun asks again.
  static bool is_later_stage(const mjModel* m, const mjData* d, const Stored& stored) {
    return m->opt.integrator == mjINT_RK4 && stored.time != kNoStep && d->time > stored.time &&
           d->time < stored.time + 1.0001 * m->opt.timestep;
  }

  /// At the body's centre, as mj_applyFT() does, but for a free joint alone and without a Jacobian. The joint
  /// takes the force in the world's frame and the torque in the body's.
  void push(const mjModel* m, mjData* d, const Vector3<double>& force, const Vector3<double>& torque) const {
    using Frame = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
    Eigen::Map<Eigen::Matrix<double, 6, 1>> passive(d->qfrc_passive + m->body_dofadr[body_]);
    const Vector3<double> arm = Seen(d->xipos + 3 * body_) - Seen(d->xpos + 3 * body_);
    passive.head<3>() += force;
    passive.tail<3>() += Frame(d->xmat + 9 * body_).transpose() * (torque + diabolo::cross(arm, force));
  }

  static diabolo::StringMemory kept_memory(const diabolo::StringMemory::Numbers& numbers) {
    std::string fault;
    try {
      return diabolo::StringMemory::of(numbers);
    } catch (const std::invalid_argument& error) {
      fault = error.what();
    }
    mju_error("diabolo.string, plugin_state: %s", fault.c_str());
    return {};
  }

  void ask(const mjModel* m, mjData* d, Stored& stored) const {
    const double dt = m->opt.timestep;
    if (!(dt > 0.0)) mju_error("diabolo.string, timestep: %g s; expected more than 0", dt);
    if (has_changed(m))
      mju_error(
          "diabolo.string: mass, inertia, gravity, gravcomp, integrator or sleep has changed; expected new "
          "data (MjData) after that");
    mjtNum moves[6];
    mj_objectVelocity(m, d, mjOBJ_BODY, body_, moves, 0);
    diabolo::HostBody body;
    body.position = Seen(d->xipos + 3 * body_);
    body.velocity = Seen(moves + 3);
    const mjtNum* frame = d->xmat + 9 * body_;
    body.axle = Vector3<double>(frame[0], frame[3], frame[6]);
    body.axle_rate = body.axle.dot(Seen(moves));

    const bool first = stored.begun == 0.0;
    Memory& next = stored.next;
    diabolo::TipStep tips[2];
    for (int k = 0; k < 2; ++k) {
      const int site = sites_[k];
      const Vector3<double> here = Seen(d->site_xpos + 3 * site);
      const mjtNum* stick = d->site_xmat + 9 * site;
      std::optional<diabolo::TipMemory> memory;
      if (!first) memory = diabolo::TipMemory{Seen(stored.now.tip[k]), Seen(stored.now.rate[k])};
      const bool placed = m->body_mocapid[m->body_rootid[m->site_bodyid[site]]] >= 0;
      if (!placed) mj_objectVelocity(m, d, mjOBJ_SITE, site, moves, 0);
      tips[k] = placed ? diabolo::placed_tip(here, dt, memory)
                       : diabolo::moving_tip(here, Seen(moves + 3), dt, memory);
      tips[k].direction = Vector3<double>(stick[2], stick[5], stick[8]);
      put(next.tip[k], memory->place);
      put(next.rate[k], memory->rate);
    }
    const auto [begin, end] = diabolo::tips_of_step(tips[0], tips[1], d->time, dt);

    if (!begin.left.allFinite() || !begin.right.allFinite() || !end.left.allFinite() ||
        !end.right.allFinite())
      mju_error("diabolo.string: a tip is not finite; expected numbers");
    diabolo::StringMemory memory =
        first ? string_.begin(body.position, begin) : kept_memory(stored.now.string);
    const diabolo::StringWrench wrench = string_.step(body, begin, end, dt, memory);
    next.string = memory.numbers();
    stored.time = d->time;
    put(stored.force, wrench.force);
    put(stored.torque, wrench.torque);
    put(stored.on_tip[0], wrench.on_left);
    put(stored.on_tip[1], wrench.on_right);
    const double seen[kSeen] = {wrench.left_tension,
                                wrench.right_tension,
                                wrench.slip,
                                -body.axle_rate,
                                static_cast<double>(memory.string_state),
                                wrench.overstretched ? 1.0 : 0.0};
    std::memcpy(stored.seen, seen, sizeof(seen));
  }

  int body_, sites_[2];
  Made made_;
  diabolo::AttachedString string_;
};

/// The state of an instance, where MuJoCo keeps it.
Stored& stored_in(const mjModel* m, const mjData* d, int instance) {
  return *reinterpret_cast<Stored*>(d->plugin_state + m->plugin_stateadr[instance]);
}

const StringOnBody& string_on(const mjData* d, int instance) {
  return *reinterpret_cast<const StringOnBody*>(d->plugin_data[instance]);
}

int init(const mjModel* m, mjData* d, int instance) {
  std::string fault;
  try {
    d->plugin_data[instance] = reinterpret_cast<uintptr_t>(new StringOnBody(m, instance));
    return 0;
  } catch (const std::exception& error) {
    fault = error.what();
  }
  const char* name = mj_id2name(m, mjOBJ_PLUGIN, instance);
  mju_error("diabolo.string \"%s\", %s", name == nullptr ? "" : name, fault.c_str());
  return -1;
}

void compute(const mjModel* m, mjData* d, int instance, int capability) {
  if (capability == mjPLUGIN_PASSIVE) {
    string_on(d, instance).pull(m, d, stored_in(m, d, instance));
  } else {
    const Stored& stored = stored_in(m, d, instance);
    for (int s = 0; s < m->nsensor; ++s)
      if (m->sensor_plugin[s] == instance)
        std::memcpy(d->sensordata + m->sensor_adr[s], stored.seen, sizeof(stored.seen));
  }
}

void advance(const mjModel* m, mjData* d, int instance) {
  Stored& stored = stored_in(m, d, instance);
  stored.now = stored.next;
  stored.begun = 1.0;
  stored.time = kNoStep;
}

/// The attributes' names, which MuJoCo keeps by their address.
const std::vector<const char*>& attributes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = diabolo::string_attributes();
    all.insert(all.begin(), {"left", "right"});
    return all;
  }();
  static const std::vector<const char*> texts = [] {
    std::vector<const char*> all;
    for (const std::string& name : names) all.push_back(name.c_str());
    return all;
  }();
  return texts;
}

}  // namespace

mjPLUGIN_LIB_INIT(diabolo_string) {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = "diabolo.string";
  plugin.nattribute = static_cast<int>(attributes().size());
  plugin.attributes = attributes().data();
  plugin.capabilityflags = mjPLUGIN_PASSIVE | mjPLUGIN_SENSOR;
  plugin.needstage = mjSTAGE_ACC;
  plugin.nstate = [](const mjModel*, int) { return kNumbers; };
  plugin.nsensordata = [](const mjModel*, int, int) { return kSeen; };
  plugin.init = init;
  plugin.destroy = [](mjData* d, int instance) { delete &string_on(d, instance); };
  plugin.reset = [](const mjModel*, mjtNum* state, void*, int) {
    Stored stored{};
    stored.time = kNoStep;
    std::memcpy(state, &stored, sizeof(stored));
  };
  plugin.compute = compute;
  plugin.advance = advance;
  plugin.visualize = [](const mjModel* m, mjData* d, const mjvOption*, mjvScene* scene, int instance) {
    const double state = stored_in(m, d, instance).seen[4];
    string_on(d, instance).draw(d, scene, state == static_cast<double>(diabolo::StringState::kFlying));
  };
  mjp_registerPlugin(&plugin);
}
