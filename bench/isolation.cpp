// SPDX-License-Identifier: MIT
// bench_isolation NOTHING.so SLAM_POINT.so [OBSERVATIONS.csv]: what it costs to run a plugin in a process of its own.
//
// Latency: a plugin that does nothing, one frame at a time, in this process and in its own. Throughput: slam_point over a log, as many frames under way
// as it takes. References are measured in the same run, alternately.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/isolate/isolated_plugin.hpp"
#include "host/plugin.hpp"
#include "host/samples/frame_builder.hpp"
#include "host/samples/point_kind.hpp"
#include "log/observations.hpp"

namespace {

using namespace hallway;
using Clock = std::chrono::steady_clock;
using Frames = std::vector<std::vector<hw_point3_t>>;

constexpr std::size_t kCalls = 2000;
constexpr int kRounds = 5;

std::unique_ptr<host::Stage> make(const std::string& plugin, bool isolated) {
  std::unique_ptr<host::Stage> stage;
  if (isolated) {
    stage = std::make_unique<host::IsolatedPlugin>(plugin, std::span<const std::filesystem::path>{},
                                                   host::Isolation{});
  } else {
    stage = std::make_unique<host::Plugin>(host::find_plugin(plugin, {}));
  }
  const host::SensorInfo sensor = host::point_sensor("eyes");
  stage->activate({sensor});
  return stage;
}

double microseconds(Clock::duration time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

/// Medians and 99th percentiles of the time of a call, and what isolation adds to it.
void print_latency(const std::string& plugin, std::size_t points) {
  const std::vector<hw_point3_t> frame(points, {1, 2, 3});
  std::vector<double> times[2];
  const std::unique_ptr<host::Stage> stages[2] = {make(plugin, false), make(plugin, true)};
  host::FrameBuilder builder;
  for (std::size_t i = 0; i < kCalls; ++i) {
    for (int isolated = 0; isolated < 2; ++isolated) {
      builder.begin(i, 0);
      add_points(builder, 0) = frame;
      const hw_frame_t& built = builder.finish();
      const Clock::time_point begin = Clock::now();
      stages[isolated]->process(built);
      times[isolated].push_back(microseconds(Clock::now() - begin));
    }
  }
  for (std::vector<double>& list : times) std::sort(list.begin(), list.end());
  std::printf("%6zu points: in process %8.2f us, isolated %8.2f us; added: median %8.2f us, p99 %8.2f us\n",
              points, times[0][kCalls / 2], times[1][kCalls / 2], times[1][kCalls / 2] - times[0][kCalls / 2],
              times[1][kCalls * 99 / 100] - times[0][kCalls * 99 / 100]);
}

/// Processor time so far, seconds.
double processor_time(int whose) {
  rusage usage{};
  ::getrusage(static_cast<__rusage_who_t>(whose), &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Processor time of a frame, which a busy machine does not lengthen as it does the time that passes.
void print_processor_time(const char* where, std::size_t frames, const std::function<void()>& work) {
  const double host = processor_time(RUSAGE_SELF);
  const double plugin = processor_time(RUSAGE_CHILDREN);
  work();
  const double scale = 1e6 / static_cast<double>(frames);
  std::printf("processor time of a frame, %s: %.1f us in the host, %.1f us in the plugin's process\n", where,
              scale * (processor_time(RUSAGE_SELF) - host),
              scale * (processor_time(RUSAGE_CHILDREN) - plugin));
}

/// Frames a second over a whole log.
double frames_per_second(const std::string& plugin, const Frames& frames, bool isolated) {
  const std::unique_ptr<host::Stage> stage = make(plugin, isolated);
  host::FrameBuilder builder;
  const Clock::time_point begin = Clock::now();
  std::size_t submitted = 0;
  for (std::size_t done = 0; done < frames.size(); ++done) {
    for (; submitted < frames.size() && submitted - done < stage->capacity(); ++submitted) {
      builder.begin(submitted, static_cast<std::int64_t>(submitted));
      add_points(builder, 0) = frames[submitted];
      stage->submit(builder.finish());
    }
    stage->collect();
  }
  return 1e6 * static_cast<double>(frames.size()) / microseconds(Clock::now() - begin);
}

void print_throughput(const std::string& plugin, const Frames& frames) {
  double best[2] = {0, 0};
  for (int round = 0; round < kRounds; ++round) {
    for (int isolated = 0; isolated < 2; ++isolated) {
      best[isolated] = std::max(best[isolated], frames_per_second(plugin, frames, isolated != 0));
    }
  }
  std::printf("%zu frames of a log: in process %.0f /s, isolated %.0f /s: %.0f %%\n", frames.size(), best[0],
              best[1], 100 * best[1] / best[0]);
  print_processor_time("in process", frames.size(), [&] { frames_per_second(plugin, frames, false); });
  print_processor_time("isolated", frames.size(), [&] { frames_per_second(plugin, frames, true); });
}

Frames read_frames(const std::string& file) {
  const log::ReadLog read = log::read_observations(file);
  Frames frames(read.log.iterations());
  for (std::uint32_t i = 0; i < read.log.iterations(); ++i) {
    for (const log::Observation& seen : read.log.frame(i)) {
      frames[i].push_back({seen.point[0], seen.point[1], seen.point[2]});
    }
  }
  return frames;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "usage: bench_isolation NOTHING.so SLAM_POINT.so [OBSERVATIONS.csv]\n");
    return 2;
  }
  try {
    print_latency(argv[1], 500);
    print_latency(argv[1], 20'000);
    if (argc > 3) print_throughput(argv[2], read_frames(argv[3]));
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "bench_isolation: %s\n", failure.what());
    return 1;
  }
}
