// SPDX-License-Identifier: MIT
// Scans of lidars in pictures: a robot that moves and turns, and rays whose ends in the world are known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "base/file.hpp"
#include "geom/arrays.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/range_scan_kind.hpp"
#include "log/poses.hpp"
#include "log/run_log.hpp"
#include "log/tum.hpp"
#include "run/pictures/pictures.hpp"
#include "run/pictures/scan_layers.hpp"
#include "support/temp_folder.hpp"

namespace hallway::run {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;
constexpr std::uint32_t kFrames = 30;
constexpr std::size_t kRays = 40;
constexpr double kRange_m = 20.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// 1 m/s along x, turning by 2 rad/s: even motion, as the log's poses of each frame tell it.
Pose body_at(double t_s) {
  return {Quat(Eigen::AngleAxisd(2.0 * t_s, Vec3::UnitZ())), Vec3(t_s, 0.5, 0.25)};
}

const Pose kMount{Quat(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized())), Vec3(0.2, -0.1, 0.5)};

/// How the log was written.
struct Given {
  bool flat = false;          ///< the mount is level, and all rays are
  bool has_times = true;      ///< rays have times of their own
  std::uint32_t last = 29;    ///< frame that has the last scan
  std::int64_t clock_ns = 0;  ///< what the sensor's clock is ahead of the truth
  bool is_finished = true;    ///< the log has an index
};

Pose mount_of(const Given& given) {
  return given.flat ? Pose{Quat::Identity(), Vec3(0.2, -0.1, 0.5)} : kMount;
}

/// Where ray i ends: on a wavy ring around the path; of a flat scan as high as the sensor.
Vec3 target(const Given& given, std::size_t i) {
  const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kRays;
  const double z = given.flat ? 0.75 : 1.0 + std::sin(3.0 * angle);
  return {1.5 + 6.0 * std::cos(angle), 5.0 * std::sin(angle), z};
}

/// Ray 3 is free and ray 4 has no answer.
double range_of(std::size_t i, double distance_m) {
  return i == 3 ? kInfinity : i == 4 ? kNaN : distance_m;
}

std::int64_t offset_of(std::size_t i) {
  return static_cast<std::int64_t>(i) * kPeriod_ns / static_cast<std::int64_t>(kRays);
}

/// The scan that ends at frame `f`: each ray measured from where the sensor is at its time.
const hw_frame_t& frame(host::FrameBuilder& builder, const Given& given, std::uint32_t f) {
  builder.begin(f, f * kPeriod_ns);
  if (f == 0 || f > given.last) return builder.finish();
  host::RangeScanReading scan = host::add_range_scan(builder, 0);
  const std::int64_t begin_ns = (f - 1) * kPeriod_ns;
  for (std::size_t i = 0; i < kRays; ++i) {
    const Pose T_world_sensor =
        body_at(1e-9 * static_cast<double>(begin_ns + offset_of(i))) * mount_of(given);
    const Vec3 seen = T_world_sensor.inverse() * target(given, i);
    scan.rays.push_back({.azimuth_rad = std::atan2(seen.y(), seen.x()),
                         .elevation_rad = std::asin(seen.z() / seen.norm()),
                         .range_m = range_of(i, seen.norm())});
    if (given.has_times) scan.data.t_offset_ns.push_back(offset_of(i));
    scan.data.intensity.push_back(static_cast<float>(i));
  }
  builder.set_reading(f, begin_ns + given.clock_ns, begin_ns + kPeriod_ns + given.clock_ns);
  return builder.finish();
}

nlohmann::ordered_json pose_json(const Pose& pose) {
  return {{"position_m", to_array(pose.t)}, {"orientation_wxyz", to_array(pose.q)}};
}

nlohmann::ordered_json manifest(const Given& given) {
  return {{"schema", "hallway.run/1"},
          {"name", "scans"},
          {"command", "run"},
          {"iterations", kFrames},
          {"sensors",
           {{{"name", "lidar"},
             {"kind", "range_scan"},
             {"T_body_sensor", pose_json(mount_of(given))},
             {"horizontal_fov_rad", nullptr},
             {"vertical_fov_rad", nullptr},
             {"max_range_m", kRange_m}}}}};
}

class ScanPictures : public ::testing::Test {
 protected:
  Record read(const Given& given) {
    const std::filesystem::path folder = folder_.path() / std::to_string(folders_++);
    std::filesystem::create_directory(folder);
    std::vector<log::StampedPose> truth;
    std::vector<log::IterationPose> poses;
    log::FileOutput output(folder / "run.mcap");
    log::RunLogWriter writer(output, "test", "{}");
    host::FrameBuilder builder;
    host::FrameWriter frame_writer;
    for (std::uint32_t f = 0; f < kFrames; ++f) {
      const double t_s = 1e-9 * static_cast<double>(f * kPeriod_ns);
      const Pose pose = body_at(t_s);
      truth.push_back({.t_s = t_s, .position_m = to_array(pose.t), .orientation = to_array(pose.q)});
      poses.push_back({.iteration = f, .position_m = to_array(pose.t), .orientation = to_array(pose.q)});
      const log::FrameStamp stamp{f, f * kPeriod_ns};
      std::string bytes;
      frame_writer.write_over(bytes, frame(builder, given, f));
      writer.add_frame(stamp, bytes);
      if (given.clock_ns != 0 && f > 0 && f <= given.last)
        writer.add_sample_truth(stamp, {.sample = 0, .values = {{"t_s", {t_s - 0.1, t_s}}}});
      writer.add_true_pose(stamp, poses.back());
      writer.keep();
    }
    if (given.is_finished) writer.finish();
    write_file_atomically(folder / "run.json", manifest(given).dump());
    write_file_atomically(folder / "metrics.json", "{}");
    write_file_atomically(folder / "landmarks.csv", "id,x,y,z,observations,status\n");
    log::write_tum(folder / "truth.tum", truth);
    log::write_tum(folder / "trajectory.tum", {});
    log::write_poses(folder / "truth_poses.csv", poses);
    Record record = read_record(folder);
    read_history(record);
    return record;
  }

  static render::Picture compose(const Record& record, std::uint32_t iteration,
                                 std::vector<sim::PictureLayer> show) {
    sim::PictureSpec spec;
    spec.show = std::move(show);
    spec.iteration = iteration;
    return compose_picture(record, spec);
  }

  test::TempFolder folder_;
  int folders_ = 0;
};

using enum sim::PictureLayer;

/// Places of the dots of a label, in any order.
std::vector<Vec3> dots(const render::Picture& picture, const std::string& label) {
  std::vector<Vec3> places;
  for (const render::Markers& marks : picture.markers) {
    if (marks.label == label) places.insert(places.end(), marks.positions.begin(), marks.positions.end());
  }
  return places;
}

double distance_to(const std::vector<Vec3>& places, const Vec3& wanted) {
  double least = kInfinity;
  for (const Vec3& place : places) least = std::min(least, (place - wanted).norm());
  return least;
}

/// Ray i of the scan in frame `f`, as it is placed by the pose of the frame alone.
Vec3 skewed(const Given& given, std::uint32_t f, std::size_t i) {
  const Pose at_ray = body_at(1e-9 * static_cast<double>((f - 1) * kPeriod_ns + offset_of(i)));
  const Pose at_frame = body_at(0.1 * f);
  return at_frame * (at_ray.inverse() * target(given, i));
}

TEST_F(ScanPictures, DeskewedHitsAreWhereTheRaysEnded) {
  for (const std::int64_t clock_ns : {std::int64_t{0}, std::int64_t{7'000'000}}) {
    const Given given{.clock_ns = clock_ns};
    const std::vector<Vec3> hits = dots(compose(read(given), 12, {kDeskewed}), "scan deskewed");
    ASSERT_EQ(hits.size(), kRays - 2) << "one is free, one has no answer";
    for (std::size_t i = 0; i < kRays; ++i) {
      if (i == 3 || i == 4) continue;
      EXPECT_LT(distance_to(hits, target(given, i)), 1e-8) << "ray " << i;
    }
  }
}

TEST_F(ScanPictures, AsMeasuredTheyArePlacedByThePoseOfTheFrame) {
  const Given given;
  const std::vector<Vec3> hits = dots(compose(read(given), 12, {kSeen}), "scan as measured");
  ASSERT_EQ(hits.size(), kRays - 2);
  double skew_m = 0.0;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (i == 3 || i == 4) continue;
    EXPECT_LT(distance_to(hits, skewed(given, 12, i)), 1e-8) << "ray " << i;
    skew_m = std::max(skew_m, (skewed(given, 12, i) - target(given, i)).norm());
  }
  EXPECT_GT(skew_m, 0.5) << "else nothing is shown by this";
}

TEST_F(ScanPictures, WithoutTimesOfRaysTheLegendSaysThatNothingIsDeskewed) {
  const Record record = read({.has_times = false});
  const render::Picture picture = compose(record, 12, {kDeskewed});
  EXPECT_EQ(dots(picture, "scan as measured: no true motion to deskew by").size(), kRays - 2);
  EXPECT_TRUE(dots(picture, "scan deskewed").empty());
}

TEST_F(ScanPictures, TheLastScanIsShownForASecond) {
  const Given given{.last = 10};
  const Record record = read(given);
  for (const std::uint32_t iteration : {10u, 14u, 20u}) {
    const std::vector<Vec3> hits = dots(compose(record, iteration, {kSeen}), "scan as measured");
    ASSERT_EQ(hits.size(), kRays - 2) << iteration;
    EXPECT_LT(distance_to(hits, skewed(given, 10, 7)), 1e-8) << "by the pose of its own frame";
  }
  EXPECT_TRUE(compose(record, 21, {kSeen}).markers.empty());
  EXPECT_TRUE(compose(record, 0, {kSeen}).markers.empty()) << "none was measured yet";
}

TEST_F(ScanPictures, AnUnfinishedLogShowsTheSame) {
  const render::Picture whole = compose(read({}), 12, {kDeskewed});
  const render::Picture cut_off = compose(read({.is_finished = false}), 12, {kDeskewed});
  const std::vector<Vec3> hits = dots(whole, "scan deskewed");
  EXPECT_EQ(hits.size(), kRays - 2);
  EXPECT_EQ(dots(cut_off, "scan deskewed"), hits);
}

TEST_F(ScanPictures, ColoursAreHeightsOrOfFlatScansIntensities) {
  const render::Picture spatial = compose(read({}), 12, {kDeskewed});
  EXPECT_EQ(spatial.scale.label, "height 0.00 to 2.00 m");
  EXPECT_TRUE(spatial.segments.empty()) << "no beams";
  double lowest = kInfinity;
  for (const Vec3& hit : spatial.markers.front().positions) lowest = std::min(lowest, hit.z());
  EXPECT_LT(lowest, 0.02) << "the first colour is the lowest";
  EXPECT_EQ(spatial.markers.front().colour, spatial.scale.colours.front());
  EXPECT_EQ(spatial.markers.back().colour, spatial.scale.colours.back());

  const render::Picture flat = compose(read({.flat = true}), 12, {kDeskewed});
  EXPECT_EQ(flat.scale.label, "intensity 0 to 39");
  ASSERT_FALSE(flat.markers.empty());
  EXPECT_LT(distance_to(flat.markers.front().positions, target({.flat = true}, 0)), 1e-8);
  EXPECT_LT(distance_to(flat.markers.back().positions, target({.flat = true}, kRays - 1)), 1e-8);
}

TEST_F(ScanPictures, FlatScansHaveBeamsAndFreeOnesAreApart) {
  const Given given{.flat = true};
  const render::Picture picture = compose(read(given), 12, {kDeskewed});
  ASSERT_EQ(picture.segments.size(), 2u);
  const render::Segments& free = picture.segments.front();
  EXPECT_EQ(free.label, "beams without a return");
  EXPECT_LT(free.opacity, 1.0);
  ASSERT_EQ(free.pairs.size(), 1u);
  const Vec3 eye = body_at(1.1 + 1e-9 * static_cast<double>(offset_of(3))) * mount_of(given).t;
  const Vec3 way = target(given, 3) - eye;
  EXPECT_LT((free.pairs[0][0] - eye).norm(), 1e-8);
  const Vec3 along = free.pairs[0][1] - eye;
  EXPECT_LT(along.normalized().cross(way.normalized()).norm(), 1e-8);
  EXPECT_GT(along.norm(), way.norm()) << "it goes on, up to the range or the picture's border";
  EXPECT_LT(along.norm(), kRange_m + 1e-8);
  EXPECT_EQ(picture.segments.back().pairs.size(), kRays - 2);
}

TEST(ScanSectors, AreFoundInTheRays) {
  const auto scan = [](double from, double to, std::size_t n) {
    RecordedScan recorded;
    for (std::size_t i = 0; i < n; ++i) {
      const double azimuth = from + (to - from) * static_cast<double>(i) / static_cast<double>(n - 1);
      recorded.rays.push_back({.direction = Vec3(std::cos(azimuth), std::sin(azimuth), 0.0), .range_m = 1.0});
    }
    return recorded;
  };
  const double turn = 2.0 * std::numbers::pi;
  const auto ahead = sector_of(scan(-2.0, 2.0, 300));
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->from_rad, -2.0, 1e-9);
  EXPECT_NEAR(ahead->width_rad, 4.0, 1e-9);
  const auto behind = sector_of(scan(2.5, 4.5, 300));  // across the jump of the angle
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->from_rad, 2.5, 1e-9);
  EXPECT_NEAR(behind->width_rad, 2.0, 1e-9);
  EXPECT_NEAR(sector_of(scan(0.0, turn * 359 / 360, 360)).value().width_rad, turn, 1e-9);
  EXPECT_FALSE(sector_of({}));
}

}  // namespace
}  // namespace hallway::run
