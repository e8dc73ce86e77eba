// SPDX-License-Identifier: MIT
#include "loaders/bag_points.hpp"

#include <cmath>
#include <limits>

#include "import/point_collector.hpp"
#include "import/scalar.hpp"
#include "loaders/refuse.hpp"

namespace hallway::loaders::bag {
namespace {

using import::ByteOrder;
using import::Scalar;

struct Coordinate {
  Scalar type = Scalar::kFloat32;
  std::uint32_t offset = 0;
};

Coordinate find(const Cloud& cloud, const char* name) {
  constexpr std::uint8_t kFloat32 = 7, kFloat64 = 8;
  for (const CloudField& field : cloud.fields) {
    if (field.name != name) continue;
    if (field.datatype != kFloat32 && field.datatype != kFloat64) {
      refuse(std::string("the points' ") + name + " is no float");
    }
    const Scalar type = field.datatype == kFloat32 ? Scalar::kFloat32 : Scalar::kFloat64;
    if (std::uint64_t{field.offset} + size_of(type) > cloud.point_step) {
      refuse(std::string("the points' ") + name + " lies outside of a point");
    }
    return {type, field.offset};
  }
  refuse(std::string("the points have no ") + name);
}

/// Bytes from row to row; a cloud of one row need not say them.
std::uint64_t checked_row_step(const Cloud& cloud) {
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  const std::uint64_t step = cloud.height > 1 ? cloud.row_step : row;
  const bool fits = step >= row && cloud.height > 0 && row <= cloud.data.size() &&
                    (cloud.height == 1 || (cloud.data.size() - row) / step >= cloud.height - 1);
  if (!fits) refuse("its data is too short for its points");
  return step;
}

}  // namespace

void take_cloud(const Cloud& cloud, std::uint32_t stride, import::Frame& frame) {
  frame.t_ns = cloud.t_ns;
  import::PointCollector points(frame, stride);
  if (cloud.width == 0 || cloud.height == 0) return;
  const std::array<Coordinate, 3> xyz{find(cloud, "x"), find(cloud, "y"), find(cloud, "z")};
  const std::uint64_t row_step = checked_row_step(cloud);
  const ByteOrder order = cloud.big_endian ? ByteOrder::kBig : ByteOrder::kLittle;
  const auto* bytes = reinterpret_cast<const char*>(cloud.data.data());
  for (std::uint64_t row = 0; row < cloud.height; ++row) {
    for (std::uint64_t column = 0; column < cloud.width; ++column) {
      const char* point = bytes + row * row_step + column * cloud.point_step;
      const auto value = [&](const Coordinate& c) { return read_scalar(point + c.offset, c.type, order); };
      points.add(value(xyz[0]), value(xyz[1]), value(xyz[2]));
    }
  }
}

void take_scan(const Scan& scan, std::uint32_t stride, import::Frame& frame) {
  frame.t_ns = scan.t_ns;
  import::PointCollector points(frame, 1);
  // A driver that does not say the limits leaves them at 0.
  const double farthest = scan.range_max > scan.range_min ? static_cast<double>(scan.range_max)
                                                          : std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < scan.ranges.size(); i += stride) {
    const auto range = static_cast<double>(scan.ranges[i]);
    if (!(range > 0.0 && range >= static_cast<double>(scan.range_min) && range <= farthest)) continue;
    const double angle = static_cast<double>(scan.angle_min) +
                         static_cast<double>(i) * static_cast<double>(scan.angle_increment);
    points.add(range * std::cos(angle), range * std::sin(angle), 0.0);
  }
}

}  // namespace hallway::loaders::bag
