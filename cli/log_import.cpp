// SPDX-License-Identifier: MIT
#include "log_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/refuse.hpp"
#include "host/samples/point_kind.hpp"
#include "import/bag.hpp"
#include "import/cloud_folder.hpp"
#include "import/landmark_tables.hpp"
#include "import/tum_folder.hpp"
#include "import/victoria_park.hpp"
#include "log_rig.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;
using import::Kind;

std::optional<std::int64_t> nanoseconds(std::optional<double> seconds) {
  if (!seconds) return std::nullopt;
  return std::llround(*seconds * 1e9);
}

/// A recording as a source of frames that counts what is missing in those it gives.
class ImportedSource : public run::Source {
 public:
  /// @param steps  how many frames to give; 0 for all
  ImportedSource(std::unique_ptr<import::Recording> recording, std::uint32_t steps)
      : recording_(std::move(recording)), iterations_(recording_->frames()) {
    facts_.sensors.push_back(host::point_sensor(recording_->sensor()));
    facts_.has_identities = recording_->has_identities();
    facts_.has_tracks = recording_->has_tracks();
    facts_.true_landmarks = recording_->true_landmarks();
    if (steps > 0) iterations_ = std::min(iterations_, steps);
  }

  std::uint32_t iterations() const override { return iterations_; }
  /// About the frames that were read, each of them once.
  std::vector<std::string> missing() const {
    std::vector<std::string> lines;
    if (not_finite_ > 0) {
      lines.push_back(fmt::format("{} points that are not finite were left out, in {} of {} frames",
                                  not_finite_, frames_not_finite_, iterations()));
    }
    if (recording_->has_truth() && frames_without_truth_ > 0) {
      lines.push_back(fmt::format("{} of {} frames have no true pose near enough in time (--truth-within)",
                                  frames_without_truth_, iterations()));
    }
    return lines;
  }

 private:
  void fill(std::uint32_t iteration, run::SourceFrame& frame) override {
    recording_->read(iteration, frame_);
    host::FrameBuilder& builder = frame.begin(iteration, frame_.t_ns);
    std::vector<hw_point3_t>& points = host::add_points(builder, facts_.sensors.front().id);
    for (const auto& [x, y, z] : frame_.points) points.push_back({x, y, z});
    if (has_tracks()) {
      builder.add_tracks() = frame_.tracks;
      builder.add_tracks().resize(points.size(), log::kNoTrack);
    }
    if (has_identities()) {
      frame.identities = frame_.identities;
      frame.identities.resize(points.size(), log::kNoLandmark);
    }
    frame.T_world_body = frame_.T_world_body;
    frame.orientation_known = frame_.orientation_known;
    if (iteration < counted_) return;  // read again
    counted_ = iteration + 1;
    not_finite_ += frame_.not_finite;
    if (frame_.not_finite > 0) ++frames_not_finite_;
    if (!frame_.T_world_body) ++frames_without_truth_;
  }

  std::unique_ptr<import::Recording> recording_;
  std::uint32_t iterations_;
  import::Frame frame_;
  std::uint32_t counted_ = 0;  ///< frames before this one
  std::uint64_t not_finite_ = 0;
  std::uint64_t frames_not_finite_ = 0;
  std::uint64_t frames_without_truth_ = 0;
};

std::optional<import::Camera> camera_of(const ImportChoice& choice) {
  if (choice.camera.empty()) return std::nullopt;
  const bool finite = std::ranges::all_of(choice.camera, [](double v) { return std::isfinite(v); });
  if (choice.camera.size() != 4 || !finite || choice.camera[0] <= 0.0 || choice.camera[1] <= 0.0) {
    refuse("--camera takes fx,fy,cx,cy in pixels, the first two above 0");
  }
  return import::Camera{choice.camera[0], choice.camera[1], choice.camera[2], choice.camera[3]};
}

import::LandmarkTableOptions table_options(const LogChoice& log){
    import::LandmarkTableOptions options{.true_poses = log.true_poses, .true_landmarks = log.true_landmarks};
options.period_ns = nanoseconds(log.period_s).value_or(options.period_ns);
return options;
}  // namespace

std::unique_ptr<import::Recording> open(Kind kind, const LogChoice& log, const ImportChoice& choice) {
  const std::uint32_t stride = choice.stride.value_or(1);
  const auto within_ns = nanoseconds(choice.truth_within_s);
  switch (kind) {
    case Kind::kClouds:
      return import::open_clouds(
          log.log, {.times = choice.times, .period_ns = nanoseconds(log.period_s), .stride = stride});
    case Kind::kTum: {
      import::TumOptions options{.list = choice.times, .camera = camera_of(choice), .stride = stride};
      options.truth_within_ns = within_ns.value_or(options.truth_within_ns);
      return import::open_tum(log.log, options);
    }
    case Kind::kVictoriaPark: {
      import::VictoriaParkOptions options;
      options.truth_within_ns = within_ns.value_or(options.truth_within_ns);
      return import::open_victoria_park(log.log, options);
    }
    case Kind::kStereoTracks:
      return import::open_stereo_tracks(log.log, table_options(log));
    case Kind::kRangeBearing:
      return import::open_range_bearing(log.log, table_options(log));
    case Kind::kBag:
    case Kind::kKitti:
    case Kind::kEuroc:
    case Kind::kPcdImu:
      break;
  }
  import::BagOptions options{.topic = choice.topic, .truth_topic = choice.truth_topic, .stride = stride};
  options.truth_within_ns = within_ns.value_or(options.truth_within_ns);
  return import::open_bag(log.log, options);
}

}  // namespace hallway::cli

void add_import_options(Command& command, ImportChoice& choice) {
  command
      .option("--stride", &choice.stride,
              "Of clouds and bags take each n-th point, of depth images each n-th pixel of each n-th row [1]")
      .value("N")
      .range(1u, 1'000'000u);
  command
      .option("--times", &choice.times,
              "List of SECONDS FILE, the frames of a folder [clouds: timestamps.txt, if it is there; tum: "
              "depth.txt, else associations.txt]")
      .value("FILE");
  command
      .option("--camera", &choice.camera,
              "Of depth images: fx,fy,cx,cy in pixels [525,525,319.5,239.5, for 640 x 480]")
      .value("FX,FY,CX,CY")
      .numbers(4);
  command
      .option("--truth-within", &choice.truth_within_s,
              "Largest time in seconds from a frame to its true pose [tum 0.02, bag, euroc "
              "and pcd-imu 0.1, victoria-park 0.2]")
      .value("S")
      .range(0.0, 1e6);
  command.option("--topic", &choice.topic, "Of a bag: PointCloud2 or LaserScan [the one there is]")
      .value("TOPIC");
  command.option("--truth-topic", &choice.truth_topic, "Of a bag: Odometry or PoseStamped, as true poses")
      .value("TOPIC");
}

void check_import_options(std::optional<Kind> kind, const LogChoice& log, const ImportChoice& choice) {
  struct Rule {
    const char* option;
    bool given;
    std::set<Kind> kinds;
  };
  const Rule rules[] = {
      {"--stride", choice.stride.has_value(), {Kind::kClouds, Kind::kTum, Kind::kBag}},
      {"--times", !choice.times.empty(), {Kind::kClouds, Kind::kTum}},
      {"--camera", !choice.camera.empty(), {Kind::kTum}},
      {"--truth-within",
       choice.truth_within_s.has_value(),
       {Kind::kTum, Kind::kVictoriaPark, Kind::kBag, Kind::kEuroc, Kind::kPcdImu}},
      {"--topic", !choice.topic.empty(), {Kind::kBag}},
      {"--truth-topic", !choice.truth_topic.empty(), {Kind::kBag}},
      {"--period",
       kind && log.period_s,
       {Kind::kClouds, Kind::kStereoTracks, Kind::kRangeBearing, Kind::kEuroc}},
      {"--truth-poses", kind && !log.true_poses.empty(), {Kind::kStereoTracks, Kind::kRangeBearing}},
      {"--truth-landmarks", kind && !log.true_landmarks.empty(), {Kind::kRangeBearing}},
  };
  for (const Rule& rule : rules) {
    if (!rule.given || (kind && rule.kinds.contains(*kind))) continue;
    refuse("{} does not belong to a log of kind {}", rule.option,
           kind ? import::kind_name(*kind) : "csv or mcap");
  }
}

std::string recording_name(const fs::path& path) {
  std::error_code code;
  const fs::path whole = fs::absolute(path, code).lexically_normal();
  return whole.has_filename() ? whole.stem().string() : whole.parent_path().filename().string();
}

OpenedLog open_recording(Kind kind, const LogChoice& log, const ImportChoice& choice) {
  if (import::is_rig(kind)) return open_rig(kind, log, choice);
  std::unique_ptr<import::Recording> recording = open(kind, log, choice);
  OpenedLog opened;
  opened.name = recording_name(log.log);
  opened.period_ns = recording->period_ns();
  auto source = std::make_unique<ImportedSource>(std::move(recording), log.steps);
  opened.missing = [counts = source.get()] { return counts->missing(); };
  opened.source = std::move(source);
  return opened;
}

}  // namespace hallway::cli
