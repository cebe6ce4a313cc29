// SPDX-License-Identifier: MIT
// random_steps [STEPS [SEED [FIRST_EPISODE]]]: random motions of sticks and diabolo, within the string's
// reach and beyond it, through every preset and scalar, in space or in a plane, without effects and with any
// of them. Exits with 1 when a state is not finite, leaves the spheroid or its plane
// or, on resting tips, gains energy.

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "diabolo/full_predictor.hpp"
#include "lane.hpp"
#include "random.hpp"

namespace {

using namespace diabolo;

constexpr int kStepsPerEpisode = 200;
constexpr std::array<const char*, 3> kPresets{"consistent", "paper", "published"};
constexpr std::array<const char*, 7> kTipMotions{"resting",  "smooth",        "jumping",     "coinciding",
                                                 "crossing", "overstretched", "all but taut"};
enum TipMotionKind { kResting, kSmooth, kJumping, kCoinciding, kCrossing, kOverstretched, kAllButTaut };

/// What one lane goes through: how its tips move, and the numbers behind it.
struct Scene {
  int motion = kResting;
  Vector3<double> left, right;
  Vector3<double> left_swing = Vector3<double>::Zero(), right_swing = Vector3<double>::Zero();
  double angular_rate = 0.0;
};

/// The largest of some figure, and where it was seen.
struct Worst {
  double value = 0.0;
  std::uint64_t episode = 0;
  int step = 0, motion = 0;

  void look_at(double x, std::uint64_t in_episode, int at_step, int of_motion) {
    if (!(x <= value)) *this = {x, in_episode, at_step, of_motion};
  }
  void print(const char* what, double limit) const {
    std::printf("  %-40s %9.2e", what, value);
    if (limit > 0.0) std::printf("%s", value > limit ? "  TOO LARGE," : "  (good),");
    std::printf("  episode %" PRIu64 ", step %d, %s tips\n", episode, step,
                kTipMotions[static_cast<std::size_t>(motion)]);
  }
};

/// All that is looked at. Path beyond the string's length [m] and energy gained on resting tips [J/kg] are
/// divided by what is allowed of them, so that 1 is the limit. `thin_gain` is the same for spheroids that are
/// thinner than the solver resolves, `any_gain` the energy itself. `astray` is the distance from the plane of
/// a planar motion, over what its rounding allows.
struct Tally {
  Worst excess, astray, gain, thin_gain, any_gain, speed;
  std::uint64_t steps = 0, not_finite = 0, taut = 0, slack = 0, flying = 0, snapped = 0, caught = 0;
};

/// Path that may be beyond the string [m]: 1e-9 m for a string of the usual size in double precision; in
/// single precision the tolerance of the constraint, and the rounding of coordinates `scale` metres from the
/// origin.
template <class Scalar>
double allowed_excess(double length, double scale) {
  const double epsilon = static_cast<double>(std::numeric_limits<ValueOf<Scalar>>::epsilon());
  const double solved = sizeof(ValueOf<Scalar>) == 8 ? 1e-9 : 2.0 * constraint_tolerance<Scalar>();
  return solved * std::max(1.0, length) + 8.0 * epsilon * scale;
}

/// The string's length minus the distance of the tips, over the length, from which energy is judged: the
/// constraint is solved to 1e-10 (2e-6) of the length, and tension over mass grows beyond all bounds.
template <class Scalar>
constexpr double kThinnest = (sizeof(ValueOf<Scalar>) == 8 ? 100.0 : 1000.0) * constraint_tolerance<Scalar>();

/// Energy per mass that a step may gain [J/kg]: 1e-9 J for the usual mass in double precision, 1e-4 J in
/// single.
template <class Scalar>
double allowed_gain(double energies) {
  const double epsilon = static_cast<double>(std::numeric_limits<ValueOf<Scalar>>::epsilon());
  const double solved = sizeof(ValueOf<Scalar>) == 8 ? 1e-9 / 0.2845 : 150.0 * constraint_tolerance<Scalar>();
  return solved + 16.0 * epsilon * energies;
}

/// Distance [m] and velocity [m/s] that may lead out of a plane, by the rounding of coordinates and
/// velocities of this size in each of an episode's steps.
template <class Scalar>
double allowed_astray(double scale) {
  return 4.0 * kStepsPerEpisode * static_cast<double>(std::numeric_limits<ValueOf<Scalar>>::epsilon()) *
         (1.0 + scale);
}

/// Tips and their motion lie in the plane of a planar motion.
Scene random_scene(Random& random, double length, bool rest, const PlaneProjector<double>& plane) {
  Scene scene;
  scene.motion = rest ? int{kResting} : random.index(static_cast<int>(kTipMotions.size()));
  const Vector3<double> center = plane(random.vector(1.0)),
                        half = plane(random.direction()).normalized() * 0.5;
  double span = length * random.unit();
  if (scene.motion == kCoinciding) span = 0.0;
  if (scene.motion == kOverstretched) span = length * random.uniform(1.0, 1.2);
  if (scene.motion == kAllButTaut || (rest && random.chance(0.3)))
    span = length * (1.0 - random.log_uniform(1e-12, 1e-2));
  scene.left = center + half * span;
  scene.right = center - half * span;
  if (scene.motion == kResting || scene.motion == kJumping) return scene;
  scene.left_swing = plane(random.vector(0.3));
  scene.right_swing = scene.motion == kCoinciding ? scene.left_swing : plane(random.vector(0.3));
  scene.angular_rate = random.uniform(1.0, 30.0);
  if (scene.motion == kCrossing) {  // through each other, and back
    scene.left_swing = scene.right - scene.left;
    scene.right_swing = -scene.left_swing;
  }
  return scene;
}

/// Tips of one lane at a time [s], which is that of a step.
Tips<double> tips_at(Scene& scene, Random& random, double length, double time, int step,
                     const PlaneProjector<double>& plane) {
  if (scene.motion == kJumping && step % 8 == 7) {
    const double half_length = 0.5 * length * random.unit();
    const Vector3<double> half = plane(random.direction()) * half_length, center = plane(random.vector(1.0));
    scene.left = center + half;
    scene.right = center - half;
  }
  const double sine = std::sin(scene.angular_rate * time);
  const double rate = scene.angular_rate * std::cos(scene.angular_rate * time);
  return {Vector3<double>(scene.left + scene.left_swing * sine),
          Vector3<double>(scene.right + scene.right_swing * sine), Vector3<double>(scene.left_swing * rate),
          Vector3<double>(scene.right_swing * rate)};
}

/// Half of the numbers as in the preset, half not; one episode in four takes them from their whole range.
template <class Scalar>
Parameters<Scalar> random_parameters(Random& random, int preset) {
  Parameters<Scalar> parameters = preset == 0   ? Parameters<Scalar>::consistent()
                                  : preset == 1 ? Parameters<Scalar>::paper()
                                                : Parameters<Scalar>::published();
  const bool whole_range = random.chance(0.25);
  Parameters<Scalar>::for_each(parameters, [&](const ParameterInfo& info, Scalar& field) {
    for (int i = 0; i < ScalarTraits<Scalar>::kLanes; ++i) {
      const double near = lane<Scalar>(field, i) * random.uniform(0.5, 2.0);
      const double drawn = whole_range ? random.uniform(info.minimum, info.maximum) : near;
      // Short of the ends by more than single precision rounds.
      const double inside = 1e-6 * (info.maximum - info.minimum);
      if (random.chance(0.5))
        set_lane(field, i, std::clamp(drawn, info.minimum + inside, info.maximum - inside));
    }
  });
  // Their product must not exceed 1.
  parameters.pull.reference_step = minimum(parameters.pull.reference_step,
                                           Scalar(Scalar(0.9) / (parameters.spin_coupling + Scalar(1e-3))));
  parameters.pull.per_step = random.chance(0.5);
  parameters.planar = random.chance(0.2);
  parameters.plane_normal = random.direction();
  parameters.follow_turns = preset == 0 && random.chance(0.3);
  return parameters;
}

/// Some effects at work: the string's and the sticks' anywhere in their ranges, the others, whose laws are
/// explicit, where steps of 10 ms resolve them.
template <class Scalar>
AllEffects<Scalar> random_effects(Random& random) {
  AllEffects<Scalar> effects;
  const auto draw = [&]<class Effect>(Effect& effect) {
    if (!random.chance(0.3)) return;
    const bool of_string = Effect::kName.starts_with("string_") || Effect::kName.starts_with("stick_");
    Effect::for_each(effect, [&](const ParameterInfo& info, Scalar& field) {
      const bool both_signs = info.minimum < 0.0, whole_range = of_string && info.name != "spin_gain";
      for (int i = 0; i < ScalarTraits<Scalar>::kLanes; ++i) {
        const double size = info.maximum * random.log_uniform(1e-6, whole_range ? 0.999 : 1e-2);
        set_lane(field, i, both_signs && random.chance(0.5) ? -size : size);
      }
    });
  };
  std::apply([&](auto&... effect) { (draw(effect), ...); }, effects.members);
  return effects;
}

/// Whether the path between the given tips is as long as the string: nothing gives, nothing lies elsewhere.
template <class Scalar>
bool keeps_length(const AllEffects<Scalar>& effects) {
  return effects.template get<StringElasticity>().neutral() && effects.template get<StickFlex>().neutral() &&
         effects.template get<FiniteAxle>().neutral() && effects.template get<Groove>().neutral();
}

/// The energy per mass [J/kg] of one lane.
template <class Scalar>
double energy_of(const State<Scalar>& state, double gravity, int i) {
  return 0.5 * lane<Scalar>(state.velocity, i).squaredNorm() + gravity * lane<Scalar>(state.position, i).z();
}

template <class Scalar>
bool all_finite(const State<Scalar>& state) {
  Mask<Scalar> finite = is_finite(state.spin) && is_finite(state.turns);
  for (int k = 0; k < 3; ++k)
    finite = finite && is_finite(state.position[k]) && is_finite(state.velocity[k]) &&
             is_finite(state.string_acceleration[k]);
  return all(finite);
}

template <class Scalar, class Model>
struct Episode {
  static constexpr int kLanes = ScalarTraits<Scalar>::kLanes;
  std::uint64_t number;
  int preset;
  Random random;
  bool rest = random.chance(0.3);
  static constexpr bool kEffects = std::is_same_v<Model, FullPredictor<Scalar>>;
  Parameters<Scalar> parameters = random_parameters<Scalar>(random, preset);
  AllEffects<Scalar> effects = kEffects ? random_effects<Scalar>(random) : AllEffects<Scalar>();
  PlaneProjector<double> plane{parameters.planar, parameters.plane_normal};
  double dt = random.log_uniform(1e-4, 1e-2);
  std::array<Scene, kLanes> scenes{};
  State<Scalar> state{};

  Tips<Scalar> tips(int step) {
    Tips<Scalar> all;
    for (int i = 0; i < kLanes; ++i) {
      const Tips<double> one = tips_at(scenes[static_cast<std::size_t>(i)], random,
                                       lane<Scalar>(parameters.string_length, i), step * dt, step, plane);
      set_lane(all.left, i, one.left);
      set_lane(all.right, i, one.right);
      set_lane(all.left_velocity, i, one.left_velocity);
      set_lane(all.right_velocity, i, one.right_velocity);
    }
    return all;
  }

  void start() {
    for (int i = 0; i < kLanes; ++i) {
      const double length = lane<Scalar>(parameters.string_length, i);
      const Scene scene = random_scene(random, length, rest, plane);
      scenes[static_cast<std::size_t>(i)] = scene;
      set_lane(state.position, i, plane(random.reachable({scene.left, scene.right, length})));
      set_lane(state.velocity, i, plane(random.arrow(1e-3, 30.0)));
      set_lane(state.spin, i, random.uniform(-400.0, 400.0));
    }
    state.string_state = static_cast<StringState>(random.index(3));
  }

  void look_at(const State<Scalar>& before, const Tips<Scalar>& tips, const StepStatus<Scalar>& status,
               int step, Tally& tally) const {
    for (int i = 0; i < kLanes; ++i) {
      const int motion = scenes[static_cast<std::size_t>(i)].motion;
      const Vector3<double> position = lane<Scalar>(state.position, i),
                            velocity = lane<Scalar>(state.velocity, i);
      const Vector3<double> left = lane<Scalar>(tips.left, i), right = lane<Scalar>(tips.right, i);
      const double length = lane<Scalar>(parameters.string_length, i),
                   gravity = lane<Scalar>(parameters.gravity, i);
      const bool taut = lane(is(state.string_state, StringState::kOnString), i);
      const bool flying = lane(is(state.string_state, StringState::kFlying), i);
      ++tally.steps;
      tally.taut += taut;
      tally.flying += flying;
      tally.slack += !taut && !flying;
      tally.snapped += lane(status.snapped_taut, i);
      tally.caught += lane(status.caught, i);
      tally.speed.look_at(velocity.norm(), number, step, motion);
      const double scale = position.norm() + left.norm() + right.norm();
      if (plane.active) {
        const double off =
            std::max(std::abs(plane.normal.dot(position)), std::abs(plane.normal.dot(velocity)));
        tally.astray.look_at(off / allowed_astray<Scalar>(scale + velocity.norm()), number, step, motion);
      }
      if ((left - right).norm() >= length || !keeps_length(effects)) continue;
      // Under the paper's rules a diabolo may be outside in the step that catches it, and the closest point
      // knows no plane.
      if (preset == 0 ? !flying : taut && !plane.active) {
        const double beyond = (position - left).norm() + (position - right).norm() - length;
        tally.excess.look_at(beyond / allowed_excess<Scalar>(length, scale), number, step, motion);
      }
      if (rest && !kEffects) {  // wind, spin and a tilted gravity give energy
        const double gain = energy_of(state, gravity, i) - energy_of(before, gravity, i);
        const double energies =
            velocity.squaredNorm() + lane<Scalar>(before.velocity, i).squaredNorm() + gravity * scale;
        Worst& worst =
            (left - right).norm() < length * (1.0 - kThinnest<Scalar>) ? tally.gain : tally.thin_gain;
        worst.look_at(gain / allowed_gain<Scalar>(energies), number, step, motion);
        tally.any_gain.look_at(gain, number, step, motion);
      }
    }
  }

  void run(Tally& tally) {
    const Model predictor = [&] {
      if constexpr (kEffects)
        return Model(parameters, effects);
      else
        return Model(parameters);
    }();
    start();
    Tips<Scalar> now = tips(0);
    for (int step = 1; step <= kStepsPerEpisode; ++step) {
      const Tips<Scalar> next = tips(step);
      const State<Scalar> before = state;
      const StepStatus<Scalar> status = predictor.step(state, now, next, Scalar(dt));
      if (!all_finite(state)) {
        if (tally.not_finite++ == 0)
          std::printf("NOT FINITE in episode %" PRIu64 ", step %d, %s tips\n", number, step,
                      kTipMotions[static_cast<std::size_t>(scenes[0].motion)]);
        return;
      }
      look_at(before, next, status, step, tally);
      now = next;
    }
  }
};

template <class Scalar, class Model>
bool run(const char* scalar, int preset, std::uint64_t steps, std::uint64_t seed, std::uint64_t first) {
  using Case = Episode<Scalar, Model>;
  Tally tally;
  for (std::uint64_t number = first; tally.steps + 8 * tally.not_finite < steps; ++number)
    Case{number, preset, Random(seed * 0x9E3779B97F4A7C15U + number)}.run(tally);
  const auto share = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(tally.steps);
  };
  std::printf("%s, %s%s: %" PRIu64 " steps, %.0f %% taut, %.0f %% slack, %.0f %% flying, %" PRIu64
              " snaps, %" PRIu64 " catches, %" PRIu64 " not finite\n",
              kPresets[static_cast<std::size_t>(preset)], scalar, Case::kEffects ? ", effects" : "",
              tally.steps, 100.0 * share(tally.taut), 100.0 * share(tally.slack), 100.0 * share(tally.flying),
              tally.snapped, tally.caught, tally.not_finite);
  // The paper's rules put a diabolo back without asking for energy: their gain is told, not judged.
  const bool keeps_energy = preset == 0 && !Case::kEffects;
  tally.excess.print("path beyond the string / allowed", 1.0);
  tally.astray.print("off the plane / allowed", 1.0);
  if (keeps_energy) tally.gain.print("energy gained on resting tips / allowed", 1.0);
  if (keeps_energy) tally.thin_gain.print("the same, thinner than is resolved", 0.0);
  if (!Case::kEffects) tally.any_gain.print("energy gained on resting tips [J/kg]", 0.0);
  tally.speed.print("speed [m/s]", 0.0);
  return tally.not_finite == 0 && tally.excess.value <= 1.0 && tally.astray.value <= 1.0 &&
         (!keeps_energy || tally.gain.value <= 1.0);
}

}  // namespace

int main(int count, char** arguments) {
  const auto argument = [&](int i, std::uint64_t otherwise) {
    return count > i ? std::strtoull(arguments[i], nullptr, 10) : otherwise;
  };
  const std::uint64_t steps = argument(1, 10'000'000), seed = argument(2, 1), first = argument(3, 0);
  std::printf("random_steps %" PRIu64 " %" PRIu64 "\n", steps, seed);
  bool good = true;
  const auto both = [&]<class Scalar>(const Scalar&, const char* scalar, int preset) {
    const std::uint64_t each = steps / 24;
    good = run<Scalar, Predictor<Scalar>>(scalar, preset, each, seed, first) && good;
    good = run<Scalar, FullPredictor<Scalar>>(scalar, preset, each, seed, first) && good;
  };
  for (int preset = 0; preset < 3; ++preset) {
    both(double(), "double", preset);
    both(float(), "float", preset);
    both(Pack<double, 4>(), "4 doubles", preset);
    both(Pack<float, 8>(), "8 floats", preset);
  }
  return good ? 0 : 1;
}
