// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "study/curves.hpp"
#include "study/study.hpp"

namespace hallway::study {

// The studies, each in a file of its own.
extern const Study kBinning;
extern const Study kConstants;
extern const Study kDynamic;
extern const Study kFigureEight;
extern const Study kDensity;
extern const Study kMapSize;
extern const Study kStraight;
extern const Study kStationary;
extern const Study kVictoriaPark;
extern const Study kFortyLoops;

/// Iterations of one round of the figure eight.
inline constexpr std::uint32_t kLoopSteps = 3800;

/// Changes of a map with a landmark cloud: its density, and its places by the run's seed.
std::vector<MapEdit> cloud_of(double per_100m, std::uint64_t seed);

/// A drive with each seed and plugin of the request. `drive` has all but seed and cloud.
/// @param steps  at full size and quick; Request::steps stands above both
struct DriveSize {
  std::uint32_t full = 0;
  std::uint32_t quick = 0;
};
std::uint32_t steps_of(const Request& request, const DriveSize& size);
void add_drives(const Request& request, const std::vector<RunLabel>& labels, Drive drive, double per_100m,
                std::uint32_t sample_every, std::vector<RunSpec>& specs);

/// A number of metrics that all studies state.
void add_accuracy(const std::vector<RunGroup>& groups, const std::string& figures, Findings& findings);
/// Mean, 99th percentile and worst CPU time of an iteration.
void add_times(const std::vector<RunGroup>& groups, const std::string& figures, Findings& findings);

/// Adds the exponent of `points(trace)`, y over x: of several runs the mean of their exponents and its interval.
void add_exponent(const RunGroup& group, const std::string& figures, const std::string& what,
                  const std::function<std::vector<Vec2>(const Trace&)>& points, Findings& findings);

/// The chart of landmark errors as the thesis has it: the sum of all distances.
Chart landmark_error_chart(const std::vector<RunGroup>& groups, const std::string& title,
                           const std::string& figures);
/// The same as a root mean square after the best fit.
Chart landmark_rmse_chart(const std::vector<RunGroup>& groups, const std::string& title,
                          const std::string& figures);
/// Distances between estimated and true positions. @param part  iterations that are averaged
Chart position_error_chart(const std::vector<RunGroup>& groups, const std::string& title,
                           const std::string& figures, std::size_t part);

}  // namespace hallway::study
