// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/bytes.hpp"
#include "base/text.hpp"
#include "import/lidar_cloud.hpp"
#include "import/pcd_header.hpp"
#include "import/words.hpp"

namespace hallway::import {
namespace {

/// The fields of a lidar's points.
struct LidarFields {
  Coordinates xyz;
  Coordinate intensity, ring, time;

  bool time_in_seconds() const { return time.type == Scalar::kFloat32 || time.type == Scalar::kFloat64; }
};

LidarFields find_lidar_fields(const WordLines& lines, const PcdHeader& header) {
  LidarFields fields{find_pcd_coordinates(lines, header), find_pcd_field(lines, header, "intensity"),
                     find_pcd_field(lines, header, "ring"), find_pcd_field(lines, header, "t")};
  if (fields.time.found) return fields;
  fields.time = find_pcd_field(lines, header, "time");
  if (fields.time.found && !fields.time_in_seconds()) {
    throw lines.error(
        "field time has whole numbers, whose unit is not known: t has nanoseconds, time of type F seconds");
  }
  return fields;
}

/// Takes points with all their fields.
class LidarTaker {
 public:
  explicit LidarTaker(const LidarFields& fields) : fields_(fields), collector_(frame_, 1) {}

  /// @param value  gives the number of a field of this point
  /// @param error  makes an error at this point
  template <typename Value, typename MakeError>
  void take(const Value& value, const MakeError& error) {
    const double x = value(fields_.xyz[0]), y = value(fields_.xyz[1]), z = value(fields_.xyz[2]);
    const std::size_t before = frame_.points.size();
    collector_.add(x, y, z);
    if (frame_.points.size() == before) return;
    if (std::max({std::abs(x), std::abs(y), std::abs(z)}) > kMaxImport_m) {
      throw error(fmt::format("a coordinate lies beyond {:g} m", kMaxImport_m));
    }
    if (fields_.intensity.found) {
      const double intensity = value(fields_.intensity);
      const bool known = std::abs(intensity) <= std::numeric_limits<float>::max();
      cloud_.intensity.push_back(known ? static_cast<float>(intensity)
                                       : std::numeric_limits<float>::quiet_NaN());
    }
    if (fields_.ring.found) {
      const double ring = value(fields_.ring);
      constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
      if (!(ring >= 0.0 && ring <= kMost) || ring != std::floor(ring)) {
        throw error(fmt::format("a ring is a whole number from 0 to 2^32 - 1, not {}", format_double(ring)));
      }
      cloud_.ring.push_back(static_cast<std::uint32_t>(ring));
    }
    if (fields_.time.found) {
      const double t = value(fields_.time);
      const double t_ns = fields_.time_in_seconds() ? t * 1e9 : t;
      if (!(std::abs(t_ns) <= static_cast<double>(kMaxPointOffset_ns))) {
        throw error(fmt::format("a point's time is at most an hour from its cloud's, not {} {}",
                                format_double(t), fields_.time_in_seconds() ? "s" : "ns"));
      }
      cloud_.t_offset_ns.push_back(std::llround(t_ns));
    }
  }

  LidarCloud finish() {
    cloud_.points = std::move(frame_.points);
    cloud_.not_finite = frame_.not_finite;
    return std::move(cloud_);
  }

 private:
  const LidarFields& fields_;
  Frame frame_;
  PointCollector collector_;
  LidarCloud cloud_;
};

void take_text(WordLines& lines, const PcdHeader& header, LidarTaker& taker) {
  const std::size_t words = header.point_words();
  const auto error = [&](const std::string& message) { return lines.error(message); };
  const auto value = [&](const Coordinate& place) {
    const std::string_view word = lines.words()[place.word];
    const auto number = parse_coordinate(word);
    if (!number) throw lines.error(fmt::format("a number is needed, \"{}\" found", printable(word, 40)));
    return *number;
  };
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (!lines.next()) {
      throw lines.error(fmt::format("the file ends after {} of {} points", i, header.points));
    }
    if (lines.words().size() != words) {
      throw lines.error(fmt::format("{} numbers where a point has {}", lines.words().size(), words));
    }
    taker.take(value, error);
  }
}

void take_binary(std::string_view bytes, const PcdHeader& header, const std::string& file,
                 LidarTaker& taker) {
  for (std::uint64_t i = 0; i < header.points; ++i) {
    taker.take(
        [&](const Coordinate& place) {
          return read_scalar(bytes.data() + place.begin + i * place.step, place.type, ByteOrder::kLittle);
        },
        [&](const std::string& message) {
          return Error(ErrorCode::kBadInput, message, {.file = file, .element = fmt::format("point {}", i)});
        });
  }
}

LidarCloud read_lidar_points(std::string_view content, const std::string& file) {
  WordLines lines(content, file);
  const PcdHeader header = read_pcd_header(lines);
  const LidarFields fields = find_lidar_fields(lines, header);
  LidarTaker taker(fields);
  if (header.data == PcdData::kAscii) {
    take_text(lines, header, taker);
  } else {
    std::string unpacked;
    take_binary(pcd_point_bytes(lines, header, unpacked), header, file, taker);
  }
  return taker.finish();
}

/// The lines FIELDS, SIZE, TYPE and COUNT, as they grow field by field.
struct FieldLines {
  std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";

  void add(std::string_view name, int size, char type) {
    names += fmt::format(" {}", name);
    sizes += fmt::format(" {}", size);
    types += fmt::format(" {}", type);
    counts += " 1";
  }
};

}  // namespace

LidarCloud parse_lidar_pcd(std::string_view content, const std::string& file) {
  try {
    return read_lidar_points(content, file);
  } catch (const Error& error) {
    if (!error.where().file.empty()) throw;
    throw Error(error.code(), error.message(), {.file = file});
  }
}

std::string print_lidar_pcd(const LidarCloud& cloud, const std::string& file) {
  check_cloud(cloud, file);
  const bool wide_ring = std::ranges::any_of(cloud.ring, [](std::uint32_t ring) { return ring > 0xFFFF; });
  const bool wide_time = std::ranges::any_of(
      cloud.t_offset_ns, [](std::int64_t t_ns) { return t_ns < 0 || t_ns > 0xFFFF'FFFF; });
  FieldLines fields;
  for (const char* axis : {"x", "y", "z"}) fields.add(axis, 4, 'F');
  if (!cloud.intensity.empty()) fields.add("intensity", 4, 'F');
  if (!cloud.ring.empty()) fields.add("ring", wide_ring ? 4 : 2, 'U');
  if (!cloud.t_offset_ns.empty()) fields.add("t", wide_time ? 8 : 4, wide_time ? 'I' : 'U');
  std::string bytes = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n{}\n{}\n{}\n{}\nWIDTH {}\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      fields.names, fields.sizes, fields.types, fields.counts, cloud.points.size(), cloud.points.size());
  ByteAppender out(bytes);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (const double x : cloud.points[i]) out.put(static_cast<float>(x));
    if (!cloud.intensity.empty()) out.put(cloud.intensity[i]);
    if (!cloud.ring.empty()) {
      wide_ring ? out.put(cloud.ring[i]) : out.put(static_cast<std::uint16_t>(cloud.ring[i]));
    }
    if (!cloud.t_offset_ns.empty()) {
      wide_time ? out.put(cloud.t_offset_ns[i]) : out.put(static_cast<std::uint32_t>(cloud.t_offset_ns[i]));
    }
  }
  return bytes;
}

}  // namespace hallway::import
