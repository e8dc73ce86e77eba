// SPDX-License-Identifier: MIT
// Runs the point mapper over a log or a made-up scene, and prints how right and how fast it was.
#include <Eigen/SVD>
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "../tests/unit/slam_point/scenes.hpp"
#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/mapper.hpp"
#include "slam_point/core/thesis/mapper.hpp"

namespace {

using namespace hallway::slam_point;
using hallway::Mat3;
using hallway::Pose;
using hallway::Vec3;
using scenes::Log;
using scenes::Seen;

/// Rows of numbers below a heading row, with the heading's names.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  bool has(const std::string& name) const { return column(name) < names.size(); }
};

Table read_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  Table table;
  std::string line;
  std::getline(file, line);
  std::stringstream heading(line);
  for (std::string name; std::getline(heading, name, ',');) table.names.push_back(name);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    if (row.size() != table.names.size())
      throw std::runtime_error(path + ": a row of another length: " + line);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Vec3 vec(const std::vector<double>& row, std::size_t first) {
  return {row[first], row[first + 1], row[first + 2]};
}

Log read_log(const std::string& folder, std::size_t steps) {
  Log log;
  const Table seen = read_table(folder + "/obs.csv");
  const std::size_t x = seen.column("x");
  for (const std::vector<double>& row : seen.rows) {
    const auto frame = static_cast<std::size_t>(row[0]);
    if (frame >= steps) break;
    log.frames.resize(std::max(log.frames.size(), frame + 1));
    log.frames[frame].push_back(
        {vec(row, x), seen.has("landmark_id") ? static_cast<std::int64_t>(row[1]) : -1});
  }
  if (!std::ifstream(folder + "/gt_poses.csv")) return log;
  for (const std::vector<double>& row : read_table(folder + "/gt_poses.csv").rows) {
    if (log.poses.size() < log.frames.size()) {
      log.poses.push_back({Eigen::Quaterniond(row[4], row[5], row[6], row[7]), vec(row, 1)});
    }
  }
  for (const std::vector<double>& row : read_table(folder + "/gt_landmarks.csv").rows) {
    log.landmarks.resize(std::max(log.landmarks.size(), static_cast<std::size_t>(row[0]) + 1));
    log.landmarks[static_cast<std::size_t>(row[0])] = vec(row, 1);
  }
  return log;
}

/// Best T_a_b with a ~ T b (Kabsch), for scoring.
Pose rigid_fit(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  Vec3 mean_a = Vec3::Zero();
  Vec3 mean_b = Vec3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / static_cast<double>(a.size());
    mean_b += b[i] / static_cast<double>(a.size());
  }
  Mat3 cross = Mat3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) cross += (a[i] - mean_a) * (b[i] - mean_b).transpose();
  const Eigen::JacobiSVD<Mat3> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Mat3 r =
      svd.matrixU() * Vec3(1.0, 1.0, sign < 0.0 ? -1.0 : 1.0).asDiagonal() * svd.matrixV().transpose();
  return {Eigen::Quaterniond(r), mean_a - r * mean_b};
}

double aligned_rmse(const std::vector<Vec3>& truth, const std::vector<Vec3>& estimate) {
  if (truth.size() < 3) return 0.0;
  const Pose fit = rigid_fit(truth, estimate);
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (fit * estimate[i] - truth[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

/// Which true landmark each mapped one is by majority, and how many observations went to another's.
struct Votes {
  std::map<LandmarkId, std::map<std::int64_t, int>> of;

  std::int64_t owner(LandmarkId id) const {
    std::int64_t best = -1;
    int most = 0;
    for (const auto& [truth, count] : of.at(id)) {
      if (count > most) {
        best = truth;
        most = count;
      }
    }
    return best;
  }
  int errors() const {
    int wrong = 0;
    for (const auto& [id, counts] : of) {
      const std::int64_t right = owner(id);
      for (const auto& [truth, count] : counts) wrong += truth == right ? 0 : count;
    }
    return wrong;
  }
};

double map_error(const Map& map, const Votes& votes, const Log& log) {
  std::vector<Vec3> truth;
  std::vector<Vec3> estimate;
  for (const Landmark& landmark : map.landmarks) {
    if (landmark.status != LandmarkStatus::mapped) continue;
    truth.push_back(log.landmarks[static_cast<std::size_t>(votes.owner(landmark.id))]);
    estimate.push_back(landmark.position);
  }
  return aligned_rmse(truth, estimate);
}

Map refined(const Mapper& mapper) {
  return mapper.refined_map();
}

/// The thesis's algorithm never solves its map as a whole.
Map refined(const thesis::Mapper& mapper) {
  return mapper.map();
}

template <typename AnyMapper>
void print_truth(const Log& log, const AnyMapper& mapper, const Votes& votes,
                 const std::vector<Answer>& answers, std::size_t observations) {
  std::set<std::int64_t> seen;
  for (const std::vector<Seen>& frame : log.frames) {
    for (const Seen& s : frame) seen.insert(s.truth);
  }
  const Map map = mapper.map();
  std::set<std::int64_t> owned;
  std::size_t duplicated = 0;
  for (const Landmark& landmark : map.landmarks) {
    if (landmark.status == LandmarkStatus::mapped && !owned.insert(votes.owner(landmark.id)).second)
      ++duplicated;
  }
  std::vector<Vec3> truth;
  std::vector<Vec3> path;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i].has_pose) continue;
    truth.push_back(log.poses[i].t);
    path.push_back(answers[i].T_map_sensor.t);
  }
  const auto start = std::chrono::steady_clock::now();
  const Map at_the_end = refined(mapper);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  std::printf("landmarks_true %zu mapped_true %zu duplicated %zu association_errors %d of %zu\n", seen.size(),
              owned.size(), duplicated, votes.errors(), observations);
  std::printf("landmark_rmse_m aligned %.5f refined %.5f ate_m %.5f global_step_ms %.1f\n",
              map_error(map, votes, log), map_error(at_the_end, votes, log), aligned_rmse(truth, path),
              took.count());
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Compares the path with GPS fixes after a rigid 2-D fit that leaves out the fixes that agree worst.
void print_gps(const std::string& folder, const std::vector<Answer>& answers) {
  const Table times = read_table(folder + "/times.csv");
  const Table gps = read_table(folder + "/gps.csv");
  std::vector<Vec3> fixes;
  std::vector<Vec3> path;
  for (const std::vector<double>& fix : gps.rows) {
    for (std::size_t i = 0; i + 1 < times.rows.size(); ++i) {
      const double t0 = times.rows[i][2];
      const double t1 = times.rows[i + 1][2];
      if (fix[0] < t0 || fix[0] >= t1 || !answers[i].has_pose || !answers[i + 1].has_pose) continue;
      const double f = (fix[0] - t0) / (t1 - t0);
      fixes.push_back({fix[1], fix[2], 0.0});
      path.push_back((1.0 - f) * answers[i].T_map_sensor.t + f * answers[i + 1].T_map_sensor.t);
    }
  }
  std::vector<std::size_t> kept(fixes.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = i;
  std::vector<double> residuals(fixes.size());
  for (int pass = 0; pass < 10; ++pass) {
    std::vector<Vec3> a;
    std::vector<Vec3> b;
    for (const std::size_t i : kept) {
      a.push_back(fixes[i]);
      b.push_back(path[i]);
    }
    const Pose fit = rigid_fit(a, b);
    for (std::size_t i = 0; i < fixes.size(); ++i) residuals[i] = (fit * path[i] - fixes[i]).norm();
    const double limit = 3.0 * median(residuals);
    kept.clear();
    for (std::size_t i = 0; i < fixes.size(); ++i) {
      if (residuals[i] <= limit) kept.push_back(i);
    }
  }
  double sum = 0.0;
  for (const std::size_t i : kept) sum += residuals[i] * residuals[i];
  std::printf("gps_fixes %zu kept %zu rmse_kept_m %.3f median_all_m %.3f\n", fixes.size(), kept.size(),
              std::sqrt(sum / static_cast<double>(kept.size())), median(residuals));
}

/// Time that this thread has computed so far [us].
double thread_cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

void print_times(const char* name, std::vector<double> us) {
  const std::size_t tenth = us.size() / 10;
  const auto mean = [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) sum += us[i];
    return sum / static_cast<double>(std::max<std::size_t>(1, last - first));
  };
  const double whole = mean(0, us.size());
  const double second = mean(tenth, 2 * tenth);
  const double last = mean(us.size() - tenth, us.size());
  std::sort(us.begin(), us.end());
  std::printf("%s mean %.1f p50 %.1f p99 %.1f max %.1f; second tenth %.1f last tenth %.1f\n", name, whole,
              us[us.size() / 2], us[us.size() * 99 / 100], us.back(), second, last);
}

/// Maps the log again and lowers each iteration's times to what this run took.
template <typename AnyMapper>
void repeat(const Log& log, AnyMapper& mapper, std::vector<double>& wall_us, std::vector<double>& cpu_us) {
  mapper.reset();
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    points.clear();
    for (const Seen& seen : log.frames[i]) points.push_back(seen.point);
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = thread_cpu_us();
    mapper.process(points);
    cpu_us[i] = std::min(cpu_us[i], thread_cpu_us() - cpu_start);
    const std::chrono::duration<double, std::micro> wall = std::chrono::steady_clock::now() - start;
    wall_us[i] = std::min(wall_us[i], wall.count());
  }
}

/// Maps the log once more, the clock read between stages, and prints what share of the time each takes.
void print_stages(const Log& log, Mapper& mapper) {
  StageTimes times{};
  mapper.reset();
  mapper.time_stages(&times);
  std::vector<Vec3> points;
  for (const std::vector<Seen>& frame : log.frames) {
    points.clear();
    for (const Seen& seen : frame) points.push_back(seen.point);
    mapper.process(points);
  }
  const double total = std::accumulate(times.begin(), times.end(), 0.0);
  std::printf("stages");
  for (std::size_t s = 0; s < kStages; ++s)
    std::printf(" %s %.1f%%", kStageNames[s], 100.0 * times[s] / total);
  std::printf("\n");
}
/// The thesis's algorithm does not tell.
void print_stages(const Log&, const thesis::Mapper&) {}

template <typename AnyMapper>
void run(const Log& log, AnyMapper mapper, const std::string& folder, int runs) {
  Votes votes;
  std::vector<Answer> answers;
  std::vector<double> wall_us;
  std::vector<double> cpu_us;
  std::vector<Vec3> points;
  std::size_t observations = 0;
  for (const std::vector<Seen>& frame : log.frames) {
    points.clear();
    for (const Seen& seen : frame) points.push_back(seen.point);
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = thread_cpu_us();
    const Answer& answer = mapper.process(points);
    cpu_us.push_back(thread_cpu_us() - cpu_start);
    wall_us.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    answers.push_back(answer);
    observations += frame.size();
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (answer.associations[i] != kNoLandmark) ++votes.of[answer.associations[i]][frame[i].truth];
    }
  }
  const Counters& counters = answers.back().counters;
  std::size_t mapped = 0;
  for (const Landmark& landmark : mapper.map().landmarks)
    mapped += landmark.status == LandmarkStatus::mapped ? 1 : 0;
  std::printf("iterations %zu lost %" PRIu64 " visible %.1f landmarks %" PRIu64 " mapped %zu merged %" PRIu64
              "\n",
              log.frames.size(), counters.lost,
              static_cast<double>(observations) / static_cast<double>(log.frames.size()), counters.landmarks,
              mapped, counters.merged);
  std::printf("submaps %" PRIu64 " closes %" PRIu64 " reopened %" PRIu64 " global_steps %" PRIu64
              " searches %" PRIu64 "\n",
              counters.submaps, counters.closes, counters.reopened, counters.global_steps, counters.searches);
  if (!log.landmarks.empty()) print_truth(log, mapper, votes, answers, observations);
  if (std::ifstream(folder + "/gps.csv")) print_gps(folder, answers);
  for (int again = 1; again < runs; ++again) repeat(log, mapper, wall_us, cpu_us);
  print_times("iteration_wall_us", std::move(wall_us));
  print_times("iteration_cpu_us", std::move(cpu_us));
  print_stages(log, mapper);
}

constexpr const char* kUsage =
    "usage: bench_slam_point_log FOLDER|eight25|eight100|eight:PER_100M|ring|new_ground|office [steps=N] "
    "[seed=N] [runs=N] "
    "[mode=ours|thesis] "
    "[index=grid|quadtree|octree|kdtree] [PARAMETER=VALUE]...\n"
    "runs: of each iteration the least time of so many runs counts\n";

/// What the command line asks for besides the log.
struct Settings {
  Options options;
  thesis::Options thesis;
  bool is_thesis = false;
  std::size_t steps = 1000000;
  std::uint64_t seed = 1;
  int runs = 1;
};

/// The index of `value` among the names of a choice.
template <std::size_t N>
int choice(const char* const (&names)[N], const std::string& value) {
  for (std::size_t i = 0; i < N; ++i) {
    if (value == names[i]) return static_cast<int>(i);
  }
  throw std::runtime_error("unknown value " + value);
}

void set(Settings& settings, const std::string& name, const std::string& value) {
  if (name == "mode") {
    if (value != "ours" && value != "thesis") throw std::runtime_error("unknown mode " + value);
    settings.is_thesis = value == "thesis";
  } else if (name == "index") {
    settings.options.index = choice(kIndexNames, value);
  } else if (name == "thesis_basis") {
    settings.thesis.basis = choice(thesis::kBasisNames, value);
  } else if (name == "thesis_matching") {
    settings.thesis.matching = choice(thesis::kMatchingNames, value);
  } else if (name == "steps") {
    settings.steps = static_cast<std::size_t>(std::stod(value));
  } else if (name == "seed") {
    settings.seed = static_cast<std::uint64_t>(std::stod(value));
  } else if (name == "runs") {
    settings.runs = std::stoi(value);
  } else if (const auto* parameter = find_option(parameters(), name)) {
    parameter->set(settings.options, std::stod(value));
  } else if (const auto* own = find_option(thesis::parameters(), name)) {
    own->set(settings.thesis, std::stod(value));
  } else {
    throw std::runtime_error("unknown parameter " + name);
  }
}

void run(const Log& log, const Settings& settings, const std::string& folder) {
  if (settings.is_thesis) {
    run(log, thesis::Mapper(settings.options, settings.thesis), folder, settings.runs);
  } else {
    run(log, Mapper(settings.options), folder, settings.runs);
  }
}

int main_checked(int argc, char** argv) {
  if (argc < 2) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  Settings settings;
  for (int i = 2; i < argc; ++i) {
    const std::string text = argv[i];
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw std::runtime_error("not name=value: " + text);
    set(settings, text.substr(0, equals), text.substr(equals + 1));
  }
  const std::size_t steps = settings.steps;
  const std::uint64_t seed = settings.seed;
  const std::string what = argv[1];
  const auto within = [&](std::size_t all) { return static_cast<int>(std::min(steps, all)); };
  if (what == "eight25") {
    run(scenes::figure_eight(within(7600), 25, seed), settings, "");
  } else if (what == "eight100") {
    run(scenes::figure_eight(within(3800), 100, seed), settings, "");
  } else if (what.rfind("eight:", 0) == 0) {
    run(scenes::figure_eight(within(3800), std::stod(what.substr(6)), seed), settings, "");
  } else if (what == "ring") {
    run(scenes::ring(within(12000), 40, seed), settings, "");
  } else if (what == "new_ground") {
    run(scenes::new_ground(within(15200), 100, seed), settings, "");
  } else if (what == "office") {
    run(scenes::office(seed), settings, "");
  } else {
    run(read_log(what, steps), settings, what);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return main_checked(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_slam_point_log: %s\n", error.what());
    return 3;
  }
}
