// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_POINTS, and what makes samples of it.
#include "host/samples/point_kind.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "base/random.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/ray_data.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

/// More pixels than an image may have.
constexpr std::uint32_t kMaxPixels = 1u << 28;

void check_point_payload(void* payload, const CheckedSample& sample) {
  auto& points = *static_cast<hw_points_t*>(payload);
  check_times(points.t_offset_ns, points.count, sample);
  check_intensities(points.intensity, points.count);
  if (points.pixel == nullptr) {
    points.width = points.height = 0;
    return;
  }
  if (points.width == 0 || points.height == 0 || points.width > kMaxPixels / points.height)
    throw Malformed{fmt::format("an image of {} by {} pixels", points.width, points.height)};
  const std::uint32_t n = points.width * points.height;
  for (const std::uint32_t pixel : std::span(points.pixel, points.count)) {
    if (pixel >= n) throw Malformed{fmt::format("the pixel {} of {}", pixel, n)};
  }
}

constexpr PayloadMember kPoint[] = {{.name = "", .type = NumberType::kF64, .offset = 0, .n = 3}};
constexpr PayloadMember kTrack[] = {{.name = "", .type = NumberType::kU64, .offset = 0, .may_be_none = true}};
constexpr PayloadMember kPixel[] = {{.name = "", .type = NumberType::kU32, .offset = 0}};
constexpr PayloadMember kImage[] = {
    {.name = "width", .type = NumberType::kU32, .offset = offsetof(hw_points_t, width)},
    {.name = "height", .type = NumberType::kU32, .offset = offsetof(hw_points_t, height)}};

/// Points in a box, without tracks and pixels.
void example_points(Payload& payload, const ExampleOf& of) {
  std::byte* points = payload.make_array(0, of.elements);
  const Random random(of.seed, stream_id("points"));
  for (std::uint64_t i = 0; i < 3 * of.elements; ++i)
    store(points + i * sizeof(double), random.uniform(static_cast<std::uint32_t>(of.step), i, -10.0, 10.0));
}

constexpr PayloadArray kPointArrays[] = {{.name = "points",
                                          .one = "point",
                                          .data = offsetof(hw_points_t, points),
                                          .count = offsetof(hw_points_t, count),
                                          .stride = offsetof(hw_points_t, stride),
                                          .element_bytes = sizeof(hw_point3_t),
                                          .n_finite = 3,
                                          .members = kPoint},
                                         {.name = "track",
                                          .one = "track",
                                          .data = offsetof(hw_points_t, track),
                                          .count = offsetof(hw_points_t, count),
                                          .element_bytes = sizeof(std::uint64_t),
                                          .optional = true,
                                          .members = kTrack},
                                         // Without pixels the bytes are those of ABI 1.1.
                                         {.name = "pixel",
                                          .one = "pixel",
                                          .data = offsetof(hw_points_t, pixel),
                                          .count = offsetof(hw_points_t, count),
                                          .element_bytes = sizeof(std::uint32_t),
                                          .optional = true,
                                          .size_without = offsetof(hw_points_t, width),
                                          .checked = true,
                                          .members = kPixel},
                                         // Without these three they are those of ABI 1.4.
                                         {.name = "t_offset_ns",
                                          .one = "time",
                                          .data = offsetof(hw_points_t, t_offset_ns),
                                          .count = offsetof(hw_points_t, count),
                                          .element_bytes = sizeof(std::int64_t),
                                          .optional = true,
                                          .size_without = offsetof(hw_points_t, t_offset_ns),
                                          .checked = true,
                                          .members = kTimeOffset,
                                          .abi_minor = 5},
                                         {.name = "intensity",
                                          .one = "intensity",
                                          .data = offsetof(hw_points_t, intensity),
                                          .count = offsetof(hw_points_t, count),
                                          .element_bytes = sizeof(float),
                                          .optional = true,
                                          .size_without = offsetof(hw_points_t, intensity),
                                          .checked = true,
                                          .members = kIntensity,
                                          .abi_minor = 5},
                                         {.name = "ring",
                                          .one = "ring",
                                          .data = offsetof(hw_points_t, ring),
                                          .count = offsetof(hw_points_t, count),
                                          .element_bytes = sizeof(std::uint32_t),
                                          .optional = true,
                                          .size_without = offsetof(hw_points_t, ring),
                                          .members = kRing,
                                          .abi_minor = 5}};

}  // namespace

constexpr SampleKind kPointSamples{.kind = HW_SAMPLE_POINTS,
                                   .name = "points",
                                   .payload = "hw_points_t",
                                   .size = sizeof(hw_points_t),
                                   .min_size = offsetof(hw_points_t, track) + sizeof(hw_points_t::track),
                                   .arrays = kPointArrays,
                                   .track = offsetof(hw_points_t, track),
                                   .check = &check_point_payload,
                                   .members = kImage,
                                   .example = &example_points};

SensorInfo point_sensor(std::string name, std::uint32_t id) {
  return {.id = id, .kind = HW_SAMPLE_POINTS, .name = std::move(name)};
}

std::vector<hw_point3_t>& add_points(FrameBuilder& builder, std::uint32_t sensor_id) {
  return builder.add(kPointSamples, sensor_id).list<hw_point3_t>(offsetof(hw_points_t, points));
}

std::vector<std::uint32_t>& add_pixels(FrameBuilder& builder, std::uint32_t width, std::uint32_t height) {
  auto& points = builder.last().payload<hw_points_t>();
  points.width = width;
  points.height = height;
  return builder.last().list<std::uint32_t>(offsetof(hw_points_t, pixel));
}

RayLists add_point_data(FrameBuilder& builder) {
  Reading& reading = builder.last();
  return {reading.list<std::int64_t>(offsetof(hw_points_t, t_offset_ns)),
          reading.list<float>(offsetof(hw_points_t, intensity)),
          reading.list<std::uint32_t>(offsetof(hw_points_t, ring))};
}

}  // namespace hallway::host
