// SPDX-License-Identifier: MIT
#include "foxglove/clouds.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace hallway::foxglove {
namespace {

/// What a reading may have of each element beside its place; null where it has not.
struct ElementData {
  const float* intensity = nullptr;
  const std::uint32_t* ring = nullptr;
  const std::int64_t* t_offset_ns = nullptr;
};

template <typename Unsigned>
void append(std::string& bytes, Unsigned bits) {
  for (unsigned i = 0; i < sizeof bits; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xff);
}

void append_float(std::string& bytes, double value) {
  append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

/// Packs points one after the other. Each element of the reading may be one or not.
class Packer {
 public:
  Packer(const ElementData& data, std::uint64_t elements) : data_(data) {
    for (const char* name : {"x", "y", "z"}) add_field(name, CloudField::Type::kFloat32, sizeof(float));
    if (data.intensity != nullptr) add_field("intensity", CloudField::Type::kFloat32, sizeof(float));
    if (data.ring != nullptr) {
      constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
      wide_ring_ = std::any_of(data.ring, data.ring + elements, [](std::uint32_t r) { return r > kMost; });
      if (wide_ring_) {
        add_field("ring", CloudField::Type::kUint32, sizeof(std::uint32_t));
      } else {
        add_field("ring", CloudField::Type::kUint16, sizeof(std::uint16_t));
      }
    }
    if (data.t_offset_ns != nullptr) {
      constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
      wide_time_ = std::any_of(data.t_offset_ns, data.t_offset_ns + elements,
                               [](std::int64_t t) { return t < 0 || t > kMost; });
      if (wide_time_) {
        add_field("t_offset", CloudField::Type::kFloat64, sizeof(double));
      } else {
        add_field("t_offset", CloudField::Type::kUint32, sizeof(std::uint32_t));
      }
    }
    cloud_.data.reserve(elements * cloud_.stride);
  }

  /// @param i  index of the element
  void add(std::uint64_t i, double x, double y, double z) {
    std::string& bytes = cloud_.data;
    for (const double value : {x, y, z}) append_float(bytes, value);
    if (data_.intensity != nullptr) append(bytes, std::bit_cast<std::uint32_t>(data_.intensity[i]));
    if (data_.ring != nullptr) {
      if (wide_ring_) {
        append(bytes, data_.ring[i]);
      } else {
        append(bytes, static_cast<std::uint16_t>(data_.ring[i]));
      }
    }
    if (data_.t_offset_ns == nullptr) return;
    if (wide_time_) {
      append(bytes, std::bit_cast<std::uint64_t>(static_cast<double>(data_.t_offset_ns[i])));
    } else {
      append(bytes, static_cast<std::uint32_t>(data_.t_offset_ns[i]));
    }
  }

  Cloud take() { return std::move(cloud_); }

 private:
  void add_field(const char* name, CloudField::Type type, std::size_t bytes) {
    cloud_.fields.push_back({name, cloud_.stride, type});
    cloud_.stride += static_cast<std::uint32_t>(bytes);
  }

  ElementData data_;
  Cloud cloud_;
  bool wide_ring_ = false;
  bool wide_time_ = false;
};

/// Azimuths of the rays, none more than half a turn from the one before.
std::vector<double> unwound_azimuths(const hw_range_scan_t& scan) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<double> azimuths;
  for (std::uint64_t i = 0; i < scan.count; ++i) {
    double azimuth = hw_ray_at(&scan, i)->azimuth_rad;
    if (!azimuths.empty()) azimuth += kTurn * std::round((azimuths.back() - azimuth) / kTurn);
    azimuths.push_back(azimuth);
  }
  return azimuths;
}

}  // namespace

Cloud cloud_of(const hw_points_t& points) {
  Packer packer({hw_point_intensities_of(&points), hw_point_rings_of(&points), hw_point_times_of(&points)},
                points.count);
  for (std::uint64_t i = 0; i < points.count; ++i) {
    const hw_point3_t& point = *hw_point_at(&points, i);
    packer.add(i, point.x, point.y, point.z);
  }
  return packer.take();
}

Cloud cloud_of(const hw_range_scan_t& scan) {
  Packer packer({scan.intensity, scan.ring, scan.t_offset_ns}, scan.count);
  for (std::uint64_t i = 0; i < scan.count; ++i) {
    const hw_ray_t* ray = hw_ray_at(&scan, i);
    if (hw_ray_has_return(ray) == 0) continue;
    const hw_point3_t point = hw_ray_point(ray);
    packer.add(i, point.x, point.y, point.z);
  }
  return packer.take();
}

Cloud cloud_of(std::span<const Vec3> places) {
  Packer packer({}, places.size());
  for (std::size_t i = 0; i < places.size(); ++i) packer.add(i, places[i].x(), places[i].y(), places[i].z());
  return packer.take();
}

std::optional<LevelScan> level_scan_of(const hw_range_scan_t& scan) {
  constexpr double kLevel_rad = 1e-9, kEven_rad = 1e-6;
  if (scan.count < 2 || scan.layers != 1) return std::nullopt;
  const std::vector<double> azimuths = unwound_azimuths(scan);
  const double step = (azimuths.back() - azimuths.front()) / static_cast<double>(scan.count - 1);
  LevelScan level{.start_rad = azimuths.front(), .end_rad = azimuths.back()};
  for (std::uint64_t i = 0; i < scan.count; ++i) {
    const hw_ray_t& ray = *hw_ray_at(&scan, i);
    const double even = azimuths.front() + step * static_cast<double>(i);
    if (!(std::abs(ray.elevation_rad) <= kLevel_rad) || !(std::abs(azimuths[i] - even) <= kEven_rad))
      return std::nullopt;
    level.ranges.push_back(ray.range_m);
    if (scan.intensity != nullptr) level.intensities.push_back(static_cast<double>(scan.intensity[i]));
  }
  return level;
}

}  // namespace hallway::foxglove
