// SPDX-License-Identifier: MIT
#include "sense/point_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"

namespace hallway::sense {
namespace {

constexpr double kFullTurn = 2.0 * 3.14159265358979323846;
constexpr double kAngleRounding = 1e-9;  ///< radians; 360 degrees may come out a hair above 2 pi
constexpr double kUnitRounding = 1e-6;   ///< of a quaternion's length
constexpr double kDegrees = 360.0 / kFullTurn;

/// Throws at the first wrong member of a spec.
class SpecCheck {
 public:
  explicit SpecCheck(const PointSensorSpec& spec) : spec_(spec) {}

  void run() const {
    if (spec_.name.empty()) fail("name", "is empty");
    check_angle("horizontal_fov", spec_.horizontal_fov);
    check_angle("vertical_fov", spec_.vertical_fov);
    check_not_negative("min_range_m", spec_.min_range_m);
    check_not_negative("max_range_m", spec_.max_range_m);
    if (spec_.min_range_m > spec_.max_range_m) {
      fail("min_range_m", "is " + format_double(spec_.min_range_m) + ", above max_range_m, " +
                              format_double(spec_.max_range_m));
    }
    for (const double sigma : spec_.noise_m) check_not_negative("noise_m", sigma);
    for (const double slope : spec_.noise_per_m) check_not_negative("noise_per_m", slope);
    const Pose& mount = spec_.T_body_sensor;
    if (!mount.t.allFinite() || !(std::abs(mount.q.norm() - 1.0) < kUnitRounding)) {
      fail("T_body_sensor", "is not a finite position and a unit quaternion");
    }
  }

 private:
  void check_angle(const char* member, double angle) const {
    if (angle > 0.0 && angle <= kFullTurn + kAngleRounding) return;
    fail(member, "is " + format_double(angle * kDegrees) + " degrees; it must be above 0 and at most 360");
  }
  void check_not_negative(const char* member, double value) const {
    if (value >= 0.0 && std::isfinite(value)) return;
    fail(member, "is " + format_double(value) + "; it must be a finite number that is not negative");
  }
  [[noreturn]] void fail(const std::string& member, const std::string& problem) const {
    throw Error(ErrorCode::kBadInput, member + " " + problem,
                {.element = "sensor `" + printable(spec_.name) + "`"});
  }

  const PointSensorSpec& spec_;
};

const PointSensorSpec& checked(const PointSensorSpec& spec) {
  SpecCheck(spec).run();
  return spec;
}

}  // namespace

PointSensor::PointSensor(PointSensorSpec spec, const LandmarkIndex& landmarks, const trace::Scene& scene,
                         std::uint64_t seed)
    : spec_(std::move(spec)),
      visibility_(FieldOfView(checked(spec_).horizontal_fov, spec_.vertical_fov, spec_.min_range_m,
                              spec_.max_range_m),
                  landmarks, scene),
      noise_(seed, stream_id("sensor.noise." + spec_.name)),
      order_(seed, stream_id("sensor.order." + spec_.name)) {}

void PointSensor::observe(const Pose& T_world_body, std::uint32_t step, std::span<const LandmarkPlace> moved,
                          unsigned threads, std::vector<PointObservation>& out) const {
  constexpr std::size_t kGrain = 256;
  const Pose T_world_sensor = T_world_body * spec_.T_body_sensor;
  const Vec3& viewpoint = T_world_sensor.t;
  if (!viewpoint.allFinite() || viewpoint.cwiseAbs().maxCoeff() > trace::Scene::kMaxRayCoordinate ||
      !T_world_sensor.q.coeffs().allFinite()) {
    throw Error(ErrorCode::kBadInput, "the pose is not finite or too far from the origin",
                {.element = "sensor `" + printable(spec_.name) + "`, step " + std::to_string(step)});
  }
  std::vector<VisiblePoint> visible;
  visibility_.find(T_world_sensor, moved, threads, visible);
  std::vector<Seen> all(visible.size());
  parallel_for(visible.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) all[i] = make_seen(visible[i], step);
  });
  std::sort(all.begin(), all.end(), [](const Seen& a, const Seen& b) {
    return std::tie(a.place, a.observation.landmark) < std::tie(b.place, b.observation.landmark);
  });
  out.clear();
  out.reserve(all.size());
  for (const Seen& seen : all) out.push_back(seen.observation);
}

PointSensor::Seen PointSensor::make_seen(const VisiblePoint& visible, std::uint32_t step) const {
  const std::uint64_t first = 3 * std::uint64_t{visible.landmark};
  const Vec3 deviates(noise_.normal(step, first), noise_.normal(step, first + 1),
                      noise_.normal(step, first + 2));
  const auto bits = order_.bits(step, visible.landmark);
  const Vec3 growing = visible.point.norm() * spec_.noise_per_m;
  const Vec3 sigma = (spec_.noise_m.array().square() + growing.array().square()).sqrt();
  return {std::uint64_t{bits[0]} << 32 | bits[1],
          {visible.landmark, visible.point + sigma.cwiseProduct(deviates)}};
}

}  // namespace hallway::sense
