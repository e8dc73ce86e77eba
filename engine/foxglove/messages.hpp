// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "foxglove/clouds.hpp"
#include "geometry/geodesy.hpp"
#include "geometry/se3.hpp"

namespace hallway::foxglove {

// Messages in the well-known schemas of Foxglove (third_party/foxglove), as Protobuf bytes; of IMUs and compasses as JSON (reading_json.hpp). The same values give the same
// bytes. Times are nanoseconds, not below 0; lengths are metres; texts are UTF-8.

/// The schemas that are written.
enum class Schema : std::uint8_t {
  kPointCloud,
  kFrameTransform,
  kPoseInFrame,
  kSceneUpdate,
  kLog,
  kCompressedImage,
  kLaserScan,
  kPosesInFrame,
  kLocationFix,
  kImu,
  kCompass,
};

/// The schema's name: "foxglove.PointCloud", ….
std::string schema_name(Schema schema);

/// The encodings that MCAP records name: of the schema ("protobuf" or "jsonschema"), and of its messages ("protobuf" or "json").
std::string schema_encoding(Schema schema);
std::string message_encoding(Schema schema);

/// What an MCAP schema record holds. Of the encoding "protobuf" a serialized google.protobuf.FileDescriptorSet of the schema's file and all that it
/// imports, each after those that it imports itself; of "jsonschema" the JSON Schema.
std::string schema_data(Schema schema);

/// An opaque colour, each part from 0 to 1.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

/// A line as wide as `width_px` from wherever it is seen.
struct Line {
  enum class Kind : std::uint8_t {
    kStrip,  ///< from each point to the next
    kPairs,  ///< from the first to the second, from the third to the fourth, …
  };
  Kind kind = Kind::kStrip;
  std::vector<Vec3> points{};
  double width_px = 1.0;
  Colour colour{};
};

struct Ball {
  Vec3 centre = Vec3::Zero();
  double diameter_m = 0.0;
  Colour colour{};
};

/// A text that faces whoever looks at it.
struct Text {
  Vec3 place = Vec3::Zero();  ///< of its middle
  std::string text{};
  double size_px = 12.0;
  Colour colour{};
};

/// Something that is drawn until another entity of the same channel and id takes its place.
struct Entity {
  std::string frame{};  ///< that its coordinates are in, and with which it moves
  std::string id{};
  std::vector<Line> lines{};
  std::vector<Ball> balls{};
  std::vector<Text> texts{};
};

/// What a plugin has logged, or what is said of it.
struct LogLine {
  std::uint32_t level = 0;  ///< HW_LOG_…
  std::string name{};       ///< the plugin's id
  std::string text{};       ///< safe to print
};

/// foxglove.PointCloud.
std::string print_point_cloud(std::int64_t t_ns, const std::string& frame, const Cloud& cloud);
/// A fix of a receiver. The covariance is in its own level frame, row by row; NaN: not known.
struct LocationFix {
  GeoPoint place{};
  std::array<double, 9> covariance{};
};

/// foxglove.LocationFix.
std::string print_location_fix(std::int64_t t_ns, const std::string& frame, const LocationFix& fix);

/// foxglove.LaserScan.
std::string print_laser_scan(std::int64_t t_ns, const std::string& frame, const LevelScan& scan);
/// foxglove.FrameTransform: where `child` stands in `parent`.
std::string print_transform(std::int64_t t_ns, const std::string& parent, const std::string& child,
                            const Pose& T_parent_child);
/// foxglove.PoseInFrame.
std::string print_pose(std::int64_t t_ns, const std::string& frame, const Pose& T_frame_body);
/// foxglove.PosesInFrame.
std::string print_poses(std::int64_t t_ns, const std::string& frame, std::span<const Pose> poses);
/// foxglove.SceneUpdate of one entity.
std::string print_scene(std::int64_t t_ns, const Entity& entity);
/// foxglove.Log.
std::string print_log(std::int64_t t_ns, const LogLine& line);
/// Reads it back; its time is that of the message. Throws Error{kBadInput} for bytes that are none.
LogLine read_log(std::string_view bytes);
/// foxglove.CompressedImage.
/// @param png  the bytes of a PNG file
std::string print_picture(std::int64_t t_ns, std::string_view png);

}  // namespace hallway::foxglove
