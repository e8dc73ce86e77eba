// SPDX-License-Identifier: MIT
//
// bench_lidar SCENARIO.toml [SCENARIO.toml ...]: what a scan of a lidar of 16 x 1800 beams costs against Embree's bare rtcIntersect1 of the same rays on
// the same triangles, on one thread, at 20 places of the scenario's way; and what eight sonars cost. Every figure is a median over rounds in which all contestants take turns.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sense/occluders.hpp"
#include "sense/sonar_sensor.hpp"
#include "sim/simulator.hpp"
#include "trace/embree_library.hpp"

namespace hallway {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRounds = 9;
constexpr std::uint32_t kPlaces = 20;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRange_m = 100.0;

/// Embree with its own triangles, in single precision.
class Reference {
 public:
  explicit Reference(const trace::TriangleMesh& mesh)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::vector<float> vertices;
    for (const Vec3& v : mesh.vertices) {
      for (const double coordinate : v) vertices.push_back(static_cast<float>(coordinate));
    }
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        3 * sizeof(float), mesh.vertices.size()),
                vertices.data(), vertices.size() * sizeof(float));
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        3 * sizeof(std::uint32_t), mesh.triangles.size()),
                mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(std::uint32_t));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;
  ~Reference() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void cast(const Vec3& origin, const std::vector<Eigen::Vector3f>& directions,
            std::vector<float>& ranges) const {
    const Eigen::Vector3f from = origin.cast<float>();
    for (std::size_t i = 0; i < directions.size(); ++i) {
      RTCRayHit ray{};
      ray.ray.org_x = from.x(), ray.ray.org_y = from.y(), ray.ray.org_z = from.z();
      ray.ray.dir_x = directions[i].x(), ray.ray.dir_y = directions[i].y(), ray.ray.dir_z = directions[i].z();
      ray.ray.tfar = static_cast<float>(kRange_m);
      ray.ray.mask = ~0u;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      trace::EmbreeQuery query;
      trace::embree_first_hit(scene_, query, ray);
      ranges[i] = ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1.0f : ray.ray.tfar;
    }
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

sense::LidarSpec lidar16() {
  sense::LidarSpec spec;
  spec.name = "lidar";
  spec.max_range_m = kRange_m;
  spec.pattern = sense::spinning_pattern(
      {.columns = 1800, .elevations_rad = sense::equal_elevations(-15 * kDegree, 15 * kDegree, 16)});
  return spec;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void run(const std::string& file) {
  const sim::Scenario scenario = sim::load_scenario(file);
  const sim::Simulator simulator(scenario, 1, trace::Backend::kEmbree);
  const trace::TriangleMesh mesh =
      sense::make_occluders(simulator.compiled().partition.surface, sim::triangles_of(simulator.models()));
  const sense::Surfaces surfaces(mesh);
  const Reference reference(mesh);
  const std::unique_ptr<const sim::Motion> path_motion = simulator.path_motion();
  const sim::Motion& motion = *path_motion;
  constexpr std::int64_t kScan_ns = 100'000'000;

  sense::LidarSpec still = lidar16(), skewed = lidar16(), full = lidar16(), wide = lidar16();
  still.skew = false;
  full.response = {.noise_m = 0.02,
                   .noise_per_m = 0.001,
                   .noise_incidence = 0.001,
                   .dropout = 0.01,
                   .dropout_at_max = 0.2,
                   .dropout_incidence = 0.3,
                   .intensity_noise = 0.05};
  wide.response = full.response;
  wide.beam.divergence_rad = 0.003;
  wide.returns = 2;
  const std::pair<const char*, sense::LidarSpec> contestants[] = {
      {"no noise, no skew", still},
      {"no noise", skewed},
      {"noise, drop-outs, skew", full},
      {"the same, five rays a beam, two returns", wide}};

  std::vector<Eigen::Vector3f> directions;
  for (const sense::PatternRay& ray : still.pattern.rays)
    directions.emplace_back(Vec3(std::cos(ray.elevation_rad) * std::cos(ray.azimuth_rad),
                                 std::cos(ray.elevation_rad) * std::sin(ray.azimuth_rad),
                                 std::sin(ray.elevation_rad))
                                .cast<float>());
  std::vector<float> ranges(directions.size());
  const auto n = static_cast<double>(directions.size());
  const auto seconds = [&](const std::function<void(std::int64_t)>& scan) {
    const auto begin = Clock::now();
    for (std::uint32_t place = 0; place < kPlaces; ++place)
      scan(scenario.period_ns * scenario.steps / kPlaces * place);
    return std::chrono::duration<double>(Clock::now() - begin).count() / kPlaces;
  };
  std::vector<sense::LidarSensor> sensors;
  for (const auto& [name, spec] : contestants)
    sensors.emplace_back(spec, simulator.scene(), surfaces, kScan_ns, 1);
  std::vector<double> reference_s;
  std::vector<std::vector<double>> sensor_s(sensors.size()), ratios(sensors.size());
  sense::LidarReading reading;
  sense::LidarTruth truth;
  for (int round = 0; round < kRounds; ++round) {
    reference_s.push_back(seconds([&](std::int64_t t_ns) {
      const Pose T_world_body = motion.pose_at(t_ns);
      std::vector<Eigen::Vector3f> turned(directions.size());
      const Eigen::Matrix3f R = T_world_body.q.toRotationMatrix().cast<float>();
      for (std::size_t i = 0; i < directions.size(); ++i) turned[i] = R * directions[i];
      reference.cast(T_world_body.t, turned, ranges);
    }));
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      sensor_s[i].push_back(seconds([&](std::int64_t t_ns) {
        sensors[i].read(static_cast<std::uint32_t>(t_ns / kScan_ns), t_ns, motion, 1, reading, truth);
      }));
      ratios[i].push_back(reference_s.back() / sensor_s[i].back());
    }
  }
  sense::SonarSpec ring;
  ring.name = "sonar";
  for (int i = 0; i < 8; ++i) ring.pings.rays.push_back({.azimuth_rad = i * 45 * kDegree});
  const sense::SonarSensor sonar(ring, simulator.scene(), surfaces, 1);
  sense::SonarReading sweep;
  sense::SonarTruth sweep_truth;
  std::vector<double> sonar_s;
  for (int round = 0; round < kRounds; ++round) {
    sonar_s.push_back(seconds([&](std::int64_t t_ns) {
      sonar.read(static_cast<std::uint32_t>(t_ns / kScan_ns), t_ns, motion, 1, sweep, sweep_truth);
    }));
  }
  std::printf("%s: %zu triangles, %zu beams a scan\n", file.c_str(), mesh.triangles.size(),
              directions.size());
  std::printf("  rtcIntersect1, single precision: %.1f ns a ray\n", median(reference_s) / n * 1e9);
  for (std::size_t i = 0; i < sensors.size(); ++i)
    std::printf("  %-42s %6.1f ns a beam, %6.1f scans/s, %.2f of rtcIntersect1's rate\n",
                contestants[i].first, median(sensor_s[i]) / n * 1e9, 1.0 / median(sensor_s[i]),
                median(ratios[i]));
  constexpr double kSonar_hz = 20.0;
  std::printf("  eight sonars at %g Hz, cones of 30 degrees, %zu rays each: %.1f %% of a core\n", kSonar_hz,
              sonar.beam().size(), 100.0 * kSonar_hz * median(sonar_s));
}

}  // namespace
}  // namespace hallway

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) hallway::run(argv[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
