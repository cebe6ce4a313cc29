// SPDX-License-Identifier: MIT
#include "take.hpp"

#include <algorithm>
#include <stdexcept>

namespace plant {

Take take(const Scenario& scenario, bool with_truth) {
  // One pass for both: looking more often does not change the play.
  const std::vector<double> filmed = diabolo_times(scenario.camera, scenario.duration);
  std::vector<double> watched;
  if (with_truth) {
    CameraParameters watch;
    watch.rate = scenario.truth_rate;
    watched = diabolo_times(watch, scenario.duration);
  }
  std::vector<double> times(filmed.size() + watched.size());
  std::merge(filmed.begin(), filmed.end(), watched.begin(), watched.end(), times.begin());

  const std::unique_ptr<Plant> plant = make_plant(scenario.plant, scenario.motion);
  const std::vector<Moment> moments = simulate(*plant, scenario.start, times);
  Take take;
  take.missed = moments.size() < times.size();
  auto next_filmed = filmed.begin();
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (next_filmed != filmed.end() && *next_filmed == times[i]) {
      take.filmed.push_back(moments[i]);
      ++next_filmed;
    } else {
      take.truth.push_back(moments[i]);
    }
  }
  if (take.filmed.empty())
    throw std::invalid_argument("start: the diabolo misses the string before the first frame");
  return take;
}

}  // namespace plant
