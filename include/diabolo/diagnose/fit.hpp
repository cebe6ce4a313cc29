// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/diagnose/window_rollout.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/math/parallel.hpp"
#include "diabolo/math/solve_symmetric.hpp"

namespace diabolo {

/// Windows whose residuals are so many times those of the middle one count less and less: a mistimed catch
/// says nothing of the forces. A first fit is more patient, lest it settle for what explains the most windows
/// well and the others not at all.
inline constexpr double kFarWindow = 1.5, kFarWindowAtFirst = 10.0;

/// The least noise of a camera [m], [rad/s]. Where none is seen, what the middle window leaves counts as no
/// less than a part of it: else a window could leave anything at next to no cost.
inline constexpr double kLeastPositionNoise = 2e-5, kLeastSpinNoise = 0.02, kLeastUsual = 0.5;

/// Most windows that are fitted: two minutes of play. The cost of a fit grows with them, its intervals shrink
/// with their root.
inline constexpr std::size_t kMostWindows = 240;

/// What a window says of the unknowns once its start has been fitted, in the scales of kUnknownInfos.
struct WindowScore {
  UnknownVector score = UnknownVector::Zero();                            ///< half the slope of -chi^2
  UnknownMatrix information = UnknownMatrix::Zero(kUnknowns, kUnknowns);  ///< half its curvature
  double chi_square = 0.0;                                                ///< with the best start
  double weight = 1.0;      ///< less than 1 where the window lies far off all others
  double start_gain = 0.0;  ///< what the best start took off chi_square
  double cost = 0.0;        ///< its part of the fit's
  int numbers = 0;
  /// To the best start.
  Eigen::Matrix<double, kStartUnknowns, 1> start_step = Eigen::Matrix<double, kStartUnknowns, 1>::Zero();
  Eigen::MatrixXd start_by_unknowns = Eigen::MatrixXd::Zero(kStartUnknowns, kUnknowns);  ///< its change
};

/// Takes the window's start out of its system, whitened by the noise.
inline WindowScore without_start(const WindowSystem& system, const CameraNoise& noise) {
  constexpr int s = kStartUnknowns, n = kUnknowns;
  const WindowMatrix m =
      system.positions / (noise.position * noise.position) + system.spins / (noise.spin * noise.spin);
  Eigen::MatrixXd start = m.topLeftCorner(s, s);
  for (int i = 0; i < s; ++i) start(i, i) += 1.0 / (kStartPriors[i] * kStartPriors[i]);
  const Eigen::MatrixXd cross = m.block(0, s, s, n), slope = m.block(0, s + n, s, 1);
  WindowScore result;
  result.start_by_unknowns = solve_symmetric(start, cross);
  result.start_step = solve_symmetric(start, slope);
  result.information = m.block(s, s, n, n) - cross.transpose() * result.start_by_unknowns;
  result.score = m.block(s, s + n, n, 1) - cross.transpose() * result.start_step;
  result.start_gain = slope.col(0).dot(result.start_step);
  result.chi_square = std::max(0.0, m(s + n, s + n) - result.start_gain);
  result.numbers = system.numbers;
  return result;
}

/// A model fitted to recordings, and what each window says around it.
struct Fit {
  UnknownVector at = UnknownVector::Zero();      ///< the unknowns, SI units
  UnknownVector centre = UnknownVector::Zero();  ///< what is expected of them
  Delay delay = Delay::kClock;
  double far_window = kFarWindow;
  bool noise_is_known = false;              ///< else it is estimated again as a fit goes on
  double usual = 1.0;                       ///< what the middle window leaves [noise]; settled with the noise
  bool bounces = false;                     ///< windows may begin in the middle of a bounce on soft springs
  std::size_t most_windows = kMostWindows;  ///< that are fitted; see thin()
  std::vector<FitTake> fit_takes;           ///< with the fitted starts
  std::vector<CameraNoise> noise;           ///< of each take
  std::vector<WindowSystem> systems;        ///< of all windows, take after take
  std::vector<WindowScore> scores;
  double cost = 0.0;  ///< weighted chi^2 and priors
  double dispersion =
      1.0;  ///< how much wider the residuals are than the noise says; priors count as much more
  int iterations = 0;
};

/// Puts what is not free where it is expected.
inline void put_at_rest(Fit& fit, const ActiveSet& free) {
  for (int u = 0; u < kUnknowns; ++u)
    if (!free[u]) fit.at[u] = fit.centre[u];
}

/// 1 / prior variance in scaled numbers.
inline UnknownVector prior_precision() {
  UnknownVector result = UnknownVector::Zero();
  for (int u = 0; u < kUnknowns; ++u) {
    const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(u)];
    if (info.prior > 0.0) result[u] = std::pow(info.scale / info.prior, 2);
  }
  return result;
}

inline UnknownVector scales() {
  UnknownVector result;
  for (int u = 0; u < kUnknowns; ++u) result[u] = kUnknownInfos[static_cast<std::size_t>(u)].scale;
  return result;
}

/// Scores of all windows from their systems and the noise, and the cost.
inline void reweight(Fit& fit, int threads) {
  std::vector<const CameraNoise*> noise;
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s)
    noise.insert(noise.end(), fit.fit_takes[s].windows.size(), &fit.noise[s]);
  fit.scores.assign(noise.size(), {});
  for_each_index(noise.size(), threads, {}, [&](std::size_t i) {
    if (!fit.systems[i].failed) fit.scores[i] = without_start(fit.systems[i], *noise[i]);
  });
  std::vector<double> sizes;
  for (const WindowScore& score : fit.scores)
    sizes.push_back(score.numbers > 0 ? std::sqrt(score.chi_square / score.numbers) : kNaN);
  if (!fit.noise_is_known) fit.usual = median_of(sizes, fit.usual);
  const bool noiseless = std::ranges::all_of(
      fit.noise, [](const CameraNoise& one) { return one.position <= kLeastPositionNoise; });
  const double usual = std::max(fit.usual, noiseless ? kLeastUsual : 0.0);
  fit.cost = 0.0;
  double chi_square = 0.0, numbers = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const WindowSystem& system = fit.systems[i];
    WindowScore& score = fit.scores[i];
    const double far = std::max(fit.far_window * usual, 1e-12), off = sizes[i] / far, square = off * off;
    score.weight = system.failed ? 0.0 : off > 1.0 ? 1.0 / (square * square) : 1.0;
    // What a window cannot tell since its prediction failed, or missed a catch, costs as much as if it were
    // infinitely far off: a better fit never pays more for seeing more.
    score.cost = 2.0 * far * far * (system.failed ? system.numbers + system.lost : system.lost);
    if (!system.failed)
      score.cost += off > 1.0 ? score.chi_square / square * (2.0 - 1.0 / square) : score.chi_square;
    fit.cost += score.cost;
    chi_square += score.weight * score.chi_square;
    numbers += score.weight * std::max(0, score.numbers - kStartUnknowns);
  }
  fit.dispersion = std::max(1.0, chi_square / std::max(1.0, numbers));
  const UnknownVector prior = prior_precision(), scaled = (fit.at - fit.centre).cwiseQuotient(scales());
  fit.cost += fit.dispersion * scaled.dot(prior.cwiseProduct(scaled));
}

/// Predicts all windows at `fit.at`, with derivatives by the unknowns of `carried`, and calls
/// `use(i, fit_take, system)` for each, i counting windows take after take: in no certain order, by several
/// threads.
template <class D, class Use>
void predict_windows(const Fit& fit, const Model& base, const ActiveSet& carried, int threads,
                     const Watch& watch, const Use& use) {
  const diagnose_detail::DualUnknowns<D> x(fit.at, carried);
  std::vector<std::pair<std::size_t, std::size_t>> jobs;
  std::vector<diagnose_detail::FitModel<D>> models;
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s) {
    models.push_back(diagnose_detail::fit_model(base, fit.fit_takes[s].take->recording, x));
    for (std::size_t w = 0; w < fit.fit_takes[s].windows.size(); ++w) jobs.emplace_back(s, w);
  }
  for_each_index(jobs.size(), threads, watch, [&](std::size_t i) {
    const auto [fit_take, w] = jobs[i];
    use(i, fit_take,
        window_system(*fit.fit_takes[fit_take].take, fit.fit_takes[fit_take].windows[w], models[fit_take], x,
                      fit.delay, fit.bounces));
  });
}

/// How many windows there are.
inline std::size_t window_count(const std::vector<FitTake>& fit_takes) {
  std::size_t count = 0;
  for (const FitTake& fit_take : fit_takes) count += fit_take.windows.size();
  return count;
}

/// Predicts all windows at `fit.at`: systems and scores, with derivatives by the unknowns of `carried`.
template <class D>
void linearize_by(Fit& fit, const Model& base, const ActiveSet& carried, int threads, const Watch& watch) {
  fit.systems.resize(window_count(fit.fit_takes));
  predict_windows<D>(
      fit, base, carried, threads, watch,
      [&](std::size_t i, std::size_t, WindowSystem system) { fit.systems[i] = std::move(system); });
  reweight(fit, threads);
}

/// The same with as few derivatives as kLengths allow. (A template, as is all that calls it, lest every
/// program that includes it compile the simulation on long duals.)
template <class D = diagnose_detail::FitDual>
void linearize(Fit& fit, const Model& base, const ActiveSet& carried, int threads, const Watch& watch) {
  using diagnose_detail::kLengths, diagnose_detail::Shortened;
  const auto columns = kStartUnknowns + carried.count();
  if (columns <= kLengths[0])
    linearize_by<Shortened<D, kLengths[0]>>(fit, base, carried, threads, watch);
  else if (columns <= kLengths[1])
    linearize_by<Shortened<D, kLengths[1]>>(fit, base, carried, threads, watch);
  else if (columns <= kLengths[2])
    linearize_by<Shortened<D, kLengths[2]>>(fit, base, carried, threads, watch);
  else
    linearize_by<D>(fit, base, carried, threads, watch);
}

/// The same with derivatives by all unknowns.
template <class D = diagnose_detail::FitDual>
void linearize(Fit& fit, const Model& base, int threads, const Watch& watch = {}) {
  linearize<D>(fit, base, ActiveSet::Constant(true), threads, watch);
}

/// Noise of each recording from what the windows leave, once their starts are fitted.
inline void update_noise(Fit& fit) {
  std::size_t i = 0;
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s) {
    std::vector<double> position, spin;
    for (std::size_t w = 0; w < fit.fit_takes[s].windows.size(); ++w, ++i) {
      const WindowSystem& system = fit.systems[i];
      if (system.failed) continue;
      if (system.position_numbers > 9)
        position.push_back(system.position_square / (system.position_numbers - 6));
      if (system.spin_numbers > 5) spin.push_back(system.spin_square / (system.spin_numbers - 1));
    }
    const auto middle = [](const std::vector<double>& squares, double otherwise, double least) {
      return squares.empty() ? otherwise : std::max(std::sqrt(median_of(squares)), least);
    };
    fit.noise[s].position = middle(position, fit.noise[s].position, kLeastPositionNoise);
    fit.noise[s].spin = middle(spin, fit.noise[s].spin, kLeastSpinNoise);
  }
}

/// Numbers of the scaled normal equations of the active unknowns.
struct Normal {
  std::vector<int> free;  ///< which unknowns
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
};

inline Normal normal_equations(const Fit& fit, const ActiveSet& active) {
  Normal normal;
  for (int u = 0; u < kUnknowns; ++u)
    if (active[u]) normal.free.push_back(u);
  UnknownMatrix information = UnknownMatrix::Zero(kUnknowns, kUnknowns);
  UnknownVector score = UnknownVector::Zero();
  for (const WindowScore& window : fit.scores) {
    information += window.weight * window.information;
    score += window.weight * window.score;
  }
  const UnknownVector prior = fit.dispersion * prior_precision();
  information.diagonal() += prior;
  score -= prior.cwiseProduct((fit.at - fit.centre).cwiseQuotient(scales()));
  normal.information = information(normal.free, normal.free);
  normal.score = score(normal.free);
  normal.information.diagonal().array() += 1e-9 * (1.0 + normal.information.diagonal().array());
  return normal;
}

/// Best scaled step from `at` within bounds, of which `least` are the lower ones, damped by Levenberg and
/// Marquardt's rule: what would leave its bounds is held there, the worst first, and the others are solved
/// again.
inline Eigen::VectorXd bounded_step(const Normal& normal, const UnknownVector& at, const UnknownVector& least,
                                    double damping) {
  const Eigen::Index n = static_cast<Eigen::Index>(normal.free.size());
  Eigen::MatrixXd information = normal.information;
  information.diagonal() *= 1.0 + damping;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> moving(static_cast<std::size_t>(n)), held;
  for (Eigen::Index i = 0; i < n; ++i) moving[static_cast<std::size_t>(i)] = i;
  while (!moving.empty()) {
    const Eigen::VectorXd rest = normal.score(moving) - information(moving, held) * step(held);
    step(moving) = solve_symmetric(information(moving, moving), rest).col(0);
    Eigen::Index worst = -1;
    double most = 0.0, bound = 0.0;
    for (const Eigen::Index i : moving) {
      const int u = normal.free[static_cast<std::size_t>(i)];
      const UnknownInfo& info = kUnknownInfos[static_cast<std::size_t>(u)];
      const double here = at[u], wanted = here + step[i] * info.scale,
                   nearest = std::clamp(wanted, least[u], info.maximum);
      const double beyond = std::abs(wanted - nearest) / info.scale * std::sqrt(information(i, i));
      if (beyond > most) worst = i, most = beyond, bound = (nearest - here) / info.scale;
    }
    if (worst < 0) break;
    step[worst] = bound;
    held.push_back(worst);
    std::erase(moving, worst);
  }
  return step;
}

}  // namespace diabolo
