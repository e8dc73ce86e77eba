// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_RANGE_SCAN, and what makes samples of it.
#include "host/samples/range_scan_kind.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "base/random.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/ray_data.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

constexpr double kAngleTolerance = 1e-9;
constexpr std::int64_t kExampleNs = 40'000'000;

void check_shape(const hw_range_scan_t& scan) {
  demand(scan.layers >= 1, "a scan without layers");
  demand(scan.count % scan.layers == 0, "a number of rays that is no multiple of its layers");
  demand((scan.width == 0) == (scan.height == 0), "a scan with rows and no columns, or columns and no rows");
  const std::uint64_t cells = std::uint64_t{scan.width} * scan.height;
  demand(cells == 0 || scan.count / scan.layers == cells, "an organised scan with another number of rays");
}

void check_ray(const hw_ray_t& ray) {
  demand(std::abs(ray.azimuth_rad) <= 2.0 * std::numbers::pi + kAngleTolerance,
         "a ray's azimuth that is not within a turn");
  demand(std::abs(ray.elevation_rad) <= 0.5 * std::numbers::pi + kAngleTolerance,
         "a ray's elevation that is not within a quarter turn");
  demand(!(ray.range_m < 0.0), "a ray's range below 0");
}

void check_range_scan_payload(void* payload, const CheckedSample& sample) {
  auto& scan = *static_cast<hw_range_scan_t*>(payload);
  scan.reserved = 0;
  check_shape(scan);
  for (std::uint64_t i = 0; i < scan.count; ++i) check_ray(*hw_ray_at(&scan, i));
  check_times(scan.t_offset_ns, scan.count, sample);
  check_intensities(scan.intensity, scan.count);
}

/// Range of a ray of an example: most in a room, some of nothing in range or without an answer.
double example_range(const Random& random, std::uint32_t step, std::uint64_t i) {
  const double kind = random.uniform(step, 2 * i, 0.0, 1.0);
  if (kind < 0.1) return std::numeric_limits<double>::infinity();
  if (kind < 0.2) return std::numeric_limits<double>::quiet_NaN();
  return random.uniform(step, 2 * i + 1, 0.5, 12.0);
}

/// Rays all around in two rings where their number is even; what is beside the ranges in every other step.
void example_rays(Payload& payload, const ExampleOf& of) {
  auto& scan = *static_cast<hw_range_scan_t*>(static_cast<void*>(payload.get()));
  std::byte* element = payload.make_array(0, of.elements);
  const std::uint64_t rings = of.elements % 2 == 0 && of.elements > 0 ? 2 : 1;
  const std::uint64_t columns = of.elements / rings;
  scan.layers = 1;
  if (rings == 2) {
    scan.width = static_cast<std::uint32_t>(columns);
    scan.height = static_cast<std::uint32_t>(rings);
  }
  const Random random(of.seed, stream_id("range_scan"));
  for (std::uint64_t i = 0; i < of.elements; ++i, element += sizeof(hw_ray_t)) {
    const double turn = static_cast<double>(i % columns) / static_cast<double>(columns);
    store(element, hw_ray_t{2.0 * std::numbers::pi * turn, i < columns ? 0.1 : -0.1,
                            example_range(random, static_cast<std::uint32_t>(of.step), i)});
  }
  if (of.step % 2 == 1) make_ray_data(payload, 1, of.elements, kExampleNs, rings);
}

constexpr PayloadMember kRay[] = {
    {.name = "azimuth_rad", .type = NumberType::kF64, .offset = offsetof(hw_ray_t, azimuth_rad)},
    {.name = "elevation_rad", .type = NumberType::kF64, .offset = offsetof(hw_ray_t, elevation_rad)},
    {.name = "range_m", .type = NumberType::kF64, .offset = offsetof(hw_ray_t, range_m)}};
constexpr PayloadMember kScanShape[] = {
    {.name = "width", .type = NumberType::kU32, .offset = offsetof(hw_range_scan_t, width)},
    {.name = "height", .type = NumberType::kU32, .offset = offsetof(hw_range_scan_t, height)},
    {.name = "layers", .type = NumberType::kU32, .offset = offsetof(hw_range_scan_t, layers)},
    {.name = kReserved, .type = NumberType::kU32, .offset = offsetof(hw_range_scan_t, reserved)}};

// A range may be infinite or NaN: only the direction must be finite.
constexpr PayloadArray kScanArrays[] = {{.name = "rays",
                                         .one = "ray",
                                         .data = offsetof(hw_range_scan_t, rays),
                                         .count = offsetof(hw_range_scan_t, count),
                                         .stride = offsetof(hw_range_scan_t, stride),
                                         .element_bytes = sizeof(hw_ray_t),
                                         .n_finite = 2,
                                         .checked = true,
                                         .members = kRay},
                                        {.name = "t_offset_ns",
                                         .one = "time",
                                         .data = offsetof(hw_range_scan_t, t_offset_ns),
                                         .count = offsetof(hw_range_scan_t, count),
                                         .element_bytes = sizeof(std::int64_t),
                                         .optional = true,
                                         .checked = true,
                                         .members = kTimeOffset},
                                        {.name = "intensity",
                                         .one = "intensity",
                                         .data = offsetof(hw_range_scan_t, intensity),
                                         .count = offsetof(hw_range_scan_t, count),
                                         .element_bytes = sizeof(float),
                                         .optional = true,
                                         .checked = true,
                                         .members = kIntensity},
                                        {.name = "ring",
                                         .one = "ring",
                                         .data = offsetof(hw_range_scan_t, ring),
                                         .count = offsetof(hw_range_scan_t, count),
                                         .element_bytes = sizeof(std::uint32_t),
                                         .optional = true,
                                         .members = kRing}};

}  // namespace

constexpr SampleKind kRangeScanSamples{
    .kind = HW_SAMPLE_RANGE_SCAN,
    .name = "range_scan",
    .payload = "hw_range_scan_t",
    .size = sizeof(hw_range_scan_t),
    .min_size = offsetof(hw_range_scan_t, ring) + sizeof(hw_range_scan_t::ring),
    .arrays = kScanArrays,
    .check = &check_range_scan_payload,
    .members = kScanShape,
    .example = &example_rays,
    .example_ns = kExampleNs,
    .abi_minor = 5};

RangeScanReading add_range_scan(FrameBuilder& builder, std::uint32_t sensor_id, const ScanShape& shape) {
  Reading& reading = builder.add(kRangeScanSamples, sensor_id);
  auto& scan = reading.payload<hw_range_scan_t>();
  scan.width = shape.width;
  scan.height = shape.height;
  scan.layers = shape.layers;
  return {reading.list<hw_ray_t>(offsetof(hw_range_scan_t, rays)),
          {reading.list<std::int64_t>(offsetof(hw_range_scan_t, t_offset_ns)),
           reading.list<float>(offsetof(hw_range_scan_t, intensity)),
           reading.list<std::uint32_t>(offsetof(hw_range_scan_t, ring))}};
}

}  // namespace hallway::host
