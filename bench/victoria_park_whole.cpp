// SPDX-License-Identifier: MIT
// Runs the point mapper over all of Victoria Park and compares each part of the map with the GPS fixes.
#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "slam_point/core/mapper.hpp"

namespace {

using namespace hallway::slam_point;
using hallway::Mat3;
using hallway::Pose;
using hallway::Vec3;

constexpr double kLargestGap_s = 1.05;   // between two fixes that are interpolated
constexpr double kFastest_m_s = 12.0;    // a faster step between two fixes is a jump
constexpr double kWrongJoin_m = 10.0;    // farther from its fix, a scan is wrong
constexpr std::size_t kLeastFixes = 20;  // of a part that is compared

using Rows = std::vector<std::vector<double>>;

Rows read_rows(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  Rows rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The trees of each scan in the laser's frame.
std::vector<std::vector<Vec3>> read_scans(const std::string& folder, std::size_t scans) {
  std::vector<std::vector<Vec3>> frames(scans);
  for (const std::vector<double>& row : read_rows(folder + "/observations.csv")) {
    frames.at(static_cast<std::size_t>(row.at(0)))
        .push_back({row.at(2) * std::cos(row.at(3)), row.at(2) * std::sin(row.at(3)), 0.0});
  }
  return frames;
}

/// Where the GPS was at each scan; nothing between fixes that are far apart or jump.
std::vector<std::optional<Vec3>> fixes_at(const Rows& scans, const Rows& gps) {
  std::vector<std::optional<Vec3>> fixes(scans.size());
  std::size_t after = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const double t = scans[i].at(1);
    while (after < gps.size() && gps[after].at(0) < t) ++after;
    if (after == 0 || after == gps.size()) continue;
    const std::vector<double>& a = gps[after - 1];
    const std::vector<double>& b = gps[after];
    const double gap = b.at(0) - a.at(0);
    if (gap > kLargestGap_s || std::hypot(b.at(1) - a.at(1), b.at(2) - a.at(2)) > kFastest_m_s * gap)
      continue;
    const double f = (t - a.at(0)) / gap;
    fixes[i] = Vec3(a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]), 0.0);
  }
  return fixes;
}

/// One scan's place in its part, and its fix.
struct Sample {
  std::size_t scan = 0;
  Vec3 place = Vec3::Zero();
  Vec3 fix = Vec3::Zero();
};

Pose planar_fit(const std::vector<Sample>& samples, const std::vector<std::size_t>& kept) {
  Vec3 mean_fix = Vec3::Zero();
  Vec3 mean_place = Vec3::Zero();
  for (const std::size_t i : kept) {
    mean_fix += samples[i].fix / static_cast<double>(kept.size());
    mean_place += samples[i].place / static_cast<double>(kept.size());
  }
  double sine = 0.0;
  double cosine = 0.0;
  for (const std::size_t i : kept) {
    const Vec3 a = samples[i].fix - mean_fix;
    const Vec3 b = samples[i].place - mean_place;
    sine += b.x() * a.y() - b.y() * a.x();
    cosine += a.dot(b);
  }
  Pose T;
  T.q = Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(sine, cosine), Vec3::UnitZ()));
  T.t = mean_fix - T.q * mean_place;
  return T;
}

/// Distances from the fixes after a rigid fit to those that agree best: fixes drift and jump.
std::vector<double> residuals(const std::vector<Sample>& samples) {
  std::vector<std::size_t> kept(samples.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = i;
  std::vector<double> distances(samples.size());
  for (int pass = 0; pass < 15; ++pass) {
    const Pose T = planar_fit(samples, kept);
    for (std::size_t i = 0; i < samples.size(); ++i)
      distances[i] = (T * samples[i].place - samples[i].fix).norm();
    std::vector<double> sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    const double limit = std::max(3.0 * sorted[sorted.size() / 2], 2.0);
    kept.clear();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (distances[i] <= limit) kept.push_back(i);
    }
  }
  return distances;
}

void print_part(std::uint64_t part, const std::vector<Sample>& samples) {
  const std::vector<double> distances = residuals(samples);
  double sum = 0.0;
  for (const double d : distances) sum += d * d;
  const auto wrong =
      std::count_if(distances.begin(), distances.end(), [](double d) { return d > kWrongJoin_m; });
  std::printf("part %" PRIu64
              ": scans %zu to %zu, %zu with a fix, RMSE %.2f m, largest %.1f m, %td beyond %.0f m\n",
              part, samples.front().scan, samples.back().scan, samples.size(),
              std::sqrt(sum / static_cast<double>(samples.size())),
              *std::max_element(distances.begin(), distances.end()), wrong, kWrongJoin_m);
}

double thread_cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

void run(const std::string& folder, const Options& options) {
  const Rows scans = read_rows(folder + "/scans.csv");
  const std::vector<std::vector<Vec3>> frames = read_scans(folder, scans.size());
  const std::vector<std::optional<Vec3>> fixes = fixes_at(scans, read_rows(folder + "/gps.csv"));
  Mapper mapper(options);
  std::map<std::uint64_t, std::vector<Sample>> parts;
  std::vector<double> us;
  std::size_t placed = 0;
  std::size_t in_first = 0;
  Counters counters;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double start = thread_cpu_us();
    const Answer& answer = mapper.process(frames[i]);
    us.push_back(thread_cpu_us() - start);
    counters = answer.counters;
    if (!answer.in_part) continue;
    ++placed;
    if (answer.part == 0) ++in_first;
    if (fixes[i]) parts[answer.part].push_back({i, answer.T_map_sensor.t, *fixes[i]});
  }
  const double all = static_cast<double>(frames.size());
  double sum = 0.0;
  for (const double t : us) sum += t;
  std::sort(us.begin(), us.end());
  std::printf("scans %zu, placed %.1f %%, in the first part %.1f %%\n", frames.size(),
              100.0 * static_cast<double>(placed) / all, 100.0 * static_cast<double>(in_first) / all);
  std::printf("parts %" PRIu64 " at the end, joins %" PRIu64 ", relocalised %" PRIu64 ", landmarks %" PRIu64
              ", submaps %" PRIu64 "\n",
              counters.parts, counters.joined, counters.relocalised, counters.landmarks, counters.submaps);
  std::printf("iteration_cpu_us mean %.0f median %.0f p99 %.0f worst %.0f\n", sum / all, us[us.size() / 2],
              us[us.size() * 99 / 100], us.back());
  for (const auto& [part, samples] : parts) {
    if (samples.size() >= kLeastFixes) print_part(part, samples);
  }
}

Options options_from(int argc, char** argv) {
  Options options;
  options.noise_m = 0.25;
  options.overlap = 0.3;
  options.separation_m = 2.5;
  options.report_parts = 1;  // each part is compared by itself
  for (int i = 2; i < argc; ++i) {
    const std::string text = argv[i];
    const std::size_t equals = text.find('=');
    const auto* parameter = find_option(parameters(), text.substr(0, equals));
    if (equals == std::string::npos || parameter == nullptr)
      throw std::runtime_error("not PARAMETER=VALUE: " + text);
    parameter->set(options, std::stod(text.substr(equals + 1)));
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: bench_victoria_park_whole FOLDER [PARAMETER=VALUE]...\n", stderr);
    return 2;
  }
  try {
    run(argv[1], options_from(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_victoria_park_whole: %s\n", error.what());
    return 3;
  }
}
