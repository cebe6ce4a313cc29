// SPDX-License-Identifier: MIT
// What one step costs: each model with each kind of number, on a beat, a hop and a flight.

#include <concepts>
#include <stdexcept>

#include <diabolo/effects/all.hpp>
#include <diabolo/rollout.hpp>

#include "support/job.hpp"
#include "support/play.hpp"

namespace diabolo {
namespace {

/// Shares of the steps, over all lanes.
struct Shares {
  double on_string = 0, flying = 0, snaps = 0, steps = 0;

  template <class Scalar>
  void add(const State<Scalar>& state, const StepStatus<Scalar>& status) {
    steps += ScalarTraits<Scalar>::kLanes;
    on_string += count(is(state.string_state, StringState::kOnString));
    flying += count(is(state.string_state, StringState::kFlying));
    snaps += count(status.snapped_taut);
  }

  std::map<std::string, double> figures() const {
    return {{"on_string", on_string / steps}, {"flying", flying / steps}, {"snaps", snaps}};
  }

 private:
  static double count(bool condition) { return condition; }
  template <class T, int Lanes>
  static double count(const PackMask<T, Lanes>& mask) {
    double sum = 0;
    for (int lane = 0; lane < Lanes; ++lane) sum += mask[lane];
    return sum;
  }
};

/// A play on one predictor; `kSampled`: tips read from memory, else from their spline, by rollout().
template <class Predictor, class Scalar, bool kSampled>
class PlayJob : public Job {
 public:
  PlayJob(const Play& play, const Predictor& predictor)
      : play_(play), predictor_(predictor), motion_(play.motion<Scalar>()), start_(play.starts<Scalar>()) {
    if constexpr (kSampled)
      for (std::size_t i = 0; i <= play.steps(); ++i)
        tips_.push_back(motion_.at(static_cast<double>(i) * Play::kStep));
  }

  double steps() const override {
    return static_cast<double>(play_.steps() * std::size_t{ScalarTraits<Scalar>::kLanes});
  }

  void run() override {
    if constexpr (kSampled) {
      state_ = start_;
      for (std::size_t i = 0; i + 1 < tips_.size(); ++i)
        predictor_.step(state_, tips_[i], tips_[i + 1], Scalar(Play::kStep));
    } else {
      state_ = rollout(predictor_, start_, motion_, grid());
    }
  }

  std::map<std::string, double> check() override {
    Shares shares;
    rollout(predictor_, start_, motion_, grid(),
            [&](std::size_t, double, const State<Scalar>& state, const StepStatus<Scalar>& status) {
              shares.add(state, status);
            });
    // The published rules let a diabolo that hangs on the string come loose again and again.
    const bool always_held = predictor_.parameters().pull.flight_rule != FlightRule::kPublished;
    if (play_.name.starts_with("beat") && always_held && shares.on_string < 0.9 * shares.steps)
      throw std::runtime_error("the diabolo is on the string for less than 90 % of the steps");
    if (play_.name == "flight" && shares.flying < 0.9 * shares.steps)
      throw std::runtime_error("the diabolo flies for less than 90 % of the steps");
    if (play_.name == "hop" && shares.on_string > 0.9 * shares.steps)
      throw std::runtime_error("the string is slack for less than 10 % of the steps");
    return shares.figures();
  }

 private:
  Steps grid() const { return {0.0, Play::kStep, play_.steps()}; }

  Play play_;
  Predictor predictor_;
  TipMotion<Scalar> motion_;
  State<Scalar> start_, state_;
  std::vector<Tips<Scalar>> tips_;
};

template <bool kSampled, class Scalar, template <class> class... Effects>
void add(std::vector<NamedJob>& jobs, const std::string& model, const std::string& scalar, const Play& play,
         const Predictor<Scalar, Effects...>& predictor) {
  const std::string name = (kSampled ? "step/" : "rollout/") + model + "/" + scalar + "/" + play.name;
  jobs.push_back({name, [play, predictor] {
                    return std::make_unique<PlayJob<Predictor<Scalar, Effects...>, Scalar, kSampled>>(
                        play, predictor);
                  }});
}

/// `consistent()` with a residual whose every term is at work.
Predictor<double, ResidualForce> learnt() {
  ResidualLaw law;
  for (ResidualPart* part : {&law.on_string, &law.off_string}) {
    part->weights.fill(0.01);
    part->low.fill(-20.0);
    part->high.fill(20.0);
  }
  EffectSet<double, ResidualForce> effects;
  effects.get<ResidualForce>() = ResidualForce<double>(law);
  Parameters<double> parameters = Parameters<double>::consistent();
  parameters.string_length = Play::kStringLength;
  return Predictor<double, ResidualForce>(parameters, effects);
}

template <class Scalar>
void add_models(std::vector<NamedJob>& jobs, const std::string& scalar) {
  const auto with_length = [](Parameters<Scalar> parameters) {
    parameters.string_length = Scalar(Play::kStringLength);
    return parameters;
  };
  const Predictor<Scalar> consistent(with_length(Parameters<Scalar>::consistent()));
  const Predictor<Scalar> published(with_length(Parameters<Scalar>::published()));
  const Predictor<Scalar> paper(with_length(Parameters<Scalar>::paper()));
  EffectSet<Scalar, StringElasticity> effects;
  effects.template get<StringElasticity>() =
      StringElasticity<Scalar>::of_stiffness(Scalar(1000.0), Scalar(1.0));
  const Predictor<Scalar, StringElasticity> elastic(consistent.parameters(), effects);
  EffectSet<Scalar, FiniteAxle, Groove, GyroscopicTilt> body;
  body.template get<FiniteAxle>().radius = Scalar(0.0072);
  body.template get<FiniteAxle>().follows_axis = Scalar(1.0);
  body.template get<Groove>().profile_radius = Scalar(0.006);
  body.template get<Groove>().half_width = Scalar(0.005);
  body.template get<GyroscopicTilt>().gain = Scalar(3.5);
  body.template get<GyroscopicTilt>().inertia_ratio = Scalar(1.2);
  const Predictor<Scalar, FiniteAxle, Groove, GyroscopicTilt> rigid(consistent.parameters(), body);
  for (const Play& play : {beat(), hop(), flight()}) {
    add<true>(jobs, "consistent", scalar, play, consistent);
    add<true>(jobs, "elastic", scalar, play, elastic);
    add<true>(jobs, "rigid", scalar, play, rigid);
    add<true>(jobs, "published", scalar, play, published);
    add<true>(jobs, "paper", scalar, play, paper);
  }
  add<false>(jobs, "consistent", scalar, beat(), consistent);
  add<false>(jobs, "elastic", scalar, beat(), elastic);
  add<false>(jobs, "published", scalar, beat(), published);
  add<false>(jobs, "paper", scalar, beat(), paper);
  if constexpr (std::same_as<Scalar, double>)
    for (const Play& play : {beat(), hop(), flight()}) add<true>(jobs, "residual", scalar, play, learnt());
  if (scalar == "double")
    for (const double seconds : {2.0, 4.0}) add<false>(jobs, "consistent", scalar, beat(seconds), consistent);
}

}  // namespace
}  // namespace diabolo

int main(int argc, char** argv) {
  using namespace diabolo;
  std::vector<NamedJob> jobs;
  add_models<double>(jobs, "double");
  add_models<float>(jobs, "float");
  add_models<Dual<double, 4>>(jobs, "Dual<double,4>");
  add_models<Dual<double, 16>>(jobs, "Dual<double,16>");
  add_models<Pack<double, 4>>(jobs, "Pack<double,4>");
  return run_jobs(jobs, argc, argv);
}
