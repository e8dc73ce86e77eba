// SPDX-License-Identifier: MIT
#include "foxglove/messages.hpp"

#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <hallway/ext/log.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "foxglove/CompressedImage.pb.h"
#include "foxglove/FrameTransform.pb.h"
#include "foxglove/LaserScan.pb.h"
#include "foxglove/LocationFix.pb.h"
#include "foxglove/Log.pb.h"
#include "foxglove/PointCloud.pb.h"
#include "foxglove/PoseInFrame.pb.h"
#include "foxglove/PosesInFrame.pb.h"
#include "foxglove/SceneUpdate.pb.h"
#include "foxglove/reading_json.hpp"

namespace hallway::foxglove {
namespace {

namespace pb = ::google::protobuf;

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// In the order of Schema, of those in Protobuf.
const pb::Descriptor& descriptor_of(Schema schema) {
  static constexpr std::array kDescriptors{
      ::foxglove::PointCloud::descriptor,  ::foxglove::FrameTransform::descriptor,
      ::foxglove::PoseInFrame::descriptor, ::foxglove::SceneUpdate::descriptor,
      ::foxglove::Log::descriptor,         ::foxglove::CompressedImage::descriptor,
      ::foxglove::LaserScan::descriptor,   ::foxglove::PosesInFrame::descriptor,
      ::foxglove::LocationFix::descriptor};
  return *kDescriptors.at(static_cast<std::size_t>(schema))();
}

bool is_json(Schema schema) {
  return schema == Schema::kImu || schema == Schema::kCompass;
}

/// Protobuf promises the same bytes for the same message only when asked to.
std::string bytes_of(const pb::MessageLite& message) {
  std::string bytes;
  pb::io::StringOutputStream stream(&bytes);
  pb::io::CodedOutputStream coded(&stream);
  coded.SetSerializationDeterministic(true);
  if (!message.SerializeToCodedStream(&coded)) {
    throw Error(ErrorCode::kInternal, "a message that Protobuf does not write");
  }
  coded.Trim();
  return bytes;
}

void add_file(const pb::FileDescriptor& file, std::set<std::string>& added, pb::FileDescriptorSet& files) {
  if (!added.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) add_file(*file.dependency(i), added, files);
  file.CopyTo(files.add_file());
}

void set(pb::Timestamp& time, std::int64_t t_ns) {
  time.set_seconds(t_ns / kNanosecondsPerSecond);
  time.set_nanos(static_cast<std::int32_t>(t_ns % kNanosecondsPerSecond));
}

/// A foxglove.Vector3 or foxglove.Point3.
template <typename Vector>
void set(Vector& vector, const Vec3& value) {
  vector.set_x(value.x());
  vector.set_y(value.y());
  vector.set_z(value.z());
}

void set(::foxglove::Quaternion& quaternion, const Quat& value) {
  quaternion.set_x(value.x());
  quaternion.set_y(value.y());
  quaternion.set_z(value.z());
  quaternion.set_w(value.w());
}

void set(::foxglove::Pose& pose, const Pose& value) {
  set(*pose.mutable_position(), value.t);
  set(*pose.mutable_orientation(), value.q);
}

void set(::foxglove::Color& colour, const Colour& value) {
  colour.set_r(value.red);
  colour.set_g(value.green);
  colour.set_b(value.blue);
  colour.set_a(1.0);
}

::foxglove::PackedElementField::NumericType type_of(CloudField::Type type) {
  switch (type) {
    case CloudField::Type::kUint16:
      return ::foxglove::PackedElementField::UINT16;
    case CloudField::Type::kUint32:
      return ::foxglove::PackedElementField::UINT32;
    case CloudField::Type::kFloat32:
      return ::foxglove::PackedElementField::FLOAT32;
    case CloudField::Type::kFloat64:
      return ::foxglove::PackedElementField::FLOAT64;
  }
  throw Error(ErrorCode::kInternal, "a number of no type");
}

void set(::foxglove::LinePrimitive& line, const Line& value) {
  const bool strip = value.kind == Line::Kind::kStrip;
  line.set_type(strip ? ::foxglove::LinePrimitive::LINE_STRIP : ::foxglove::LinePrimitive::LINE_LIST);
  set(*line.mutable_pose(), Pose());
  line.set_thickness(value.width_px);
  line.set_scale_invariant(true);
  line.mutable_points()->Reserve(static_cast<int>(value.points.size()));
  for (const Vec3& point : value.points) set(*line.add_points(), point);
  set(*line.mutable_color(), value.colour);
}

void set(::foxglove::SpherePrimitive& sphere, const Ball& value) {
  set(*sphere.mutable_pose(), Pose{Quat::Identity(), value.centre});
  set(*sphere.mutable_size(), Vec3(Vec3::Constant(value.diameter_m)));
  set(*sphere.mutable_color(), value.colour);
}

void set(::foxglove::TextPrimitive& text, const Text& value) {
  set(*text.mutable_pose(), Pose{Quat::Identity(), value.place});
  text.set_billboard(true);
  text.set_font_size(value.size_px);
  text.set_scale_invariant(true);
  set(*text.mutable_color(), value.colour);
  text.set_text(value.text);
}

::foxglove::Log::Level level_of(std::uint32_t level) {
  switch (level) {
    case HW_LOG_DEBUG:
      return ::foxglove::Log::DEBUG;
    case HW_LOG_INFO:
      return ::foxglove::Log::INFO;
    case HW_LOG_WARNING:
      return ::foxglove::Log::WARNING;
    case HW_LOG_ERROR:
      return ::foxglove::Log::ERROR;
    default:
      return ::foxglove::Log::UNKNOWN;
  }
}

}  // namespace

std::string schema_name(Schema schema) {
  if (schema == Schema::kImu) return kImuSchemaName;
  return schema == Schema::kCompass ? kCompassSchemaName : descriptor_of(schema).full_name();
}

std::string schema_encoding(Schema schema) {
  return is_json(schema) ? "jsonschema" : "protobuf";
}

std::string message_encoding(Schema schema) {
  return is_json(schema) ? "json" : "protobuf";
}

std::string schema_data(Schema schema) {
  if (schema == Schema::kImu) return imu_schema();
  if (schema == Schema::kCompass) return compass_schema();
  pb::FileDescriptorSet files;
  std::set<std::string> added;
  add_file(*descriptor_of(schema).file(), added, files);
  return bytes_of(files);
}

std::string print_point_cloud(std::int64_t t_ns, const std::string& frame, const Cloud& cloud) {
  ::foxglove::PointCloud message;
  set(*message.mutable_timestamp(), t_ns);
  message.set_frame_id(frame);
  set(*message.mutable_pose(), Pose());
  for (const CloudField& field : cloud.fields) {
    ::foxglove::PackedElementField& packed = *message.add_fields();
    packed.set_name(field.name);
    packed.set_offset(field.offset);
    packed.set_type(type_of(field.type));
  }
  message.set_point_stride(cloud.stride);
  message.set_data(cloud.data);
  return bytes_of(message);
}

std::string print_location_fix(std::int64_t t_ns, const std::string& frame, const LocationFix& fix) {
  ::foxglove::LocationFix message;
  message.set_frame_id(frame);
  set(*message.mutable_timestamp(), t_ns);
  message.set_latitude(fix.place.latitude_deg);
  message.set_longitude(fix.place.longitude_deg);
  message.set_altitude(fix.place.altitude_m);
  if (std::ranges::any_of(fix.covariance, [](double number) { return std::isnan(number); }))
    return bytes_of(message);
  message.mutable_position_covariance()->Assign(fix.covariance.begin(), fix.covariance.end());
  message.set_position_covariance_type(::foxglove::LocationFix::KNOWN);
  return bytes_of(message);
}

std::string print_laser_scan(std::int64_t t_ns, const std::string& frame, const LevelScan& scan) {
  ::foxglove::LaserScan message;
  set(*message.mutable_timestamp(), t_ns);
  message.set_frame_id(frame);
  set(*message.mutable_pose(), Pose());
  message.set_start_angle(scan.start_rad);
  message.set_end_angle(scan.end_rad);
  message.mutable_ranges()->Assign(scan.ranges.begin(), scan.ranges.end());
  message.mutable_intensities()->Assign(scan.intensities.begin(), scan.intensities.end());
  return bytes_of(message);
}

std::string print_transform(std::int64_t t_ns, const std::string& parent, const std::string& child,
                            const Pose& T_parent_child) {
  ::foxglove::FrameTransform transform;
  set(*transform.mutable_timestamp(), t_ns);
  transform.set_parent_frame_id(parent);
  transform.set_child_frame_id(child);
  set(*transform.mutable_translation(), T_parent_child.t);
  set(*transform.mutable_rotation(), T_parent_child.q);
  return bytes_of(transform);
}

std::string print_pose(std::int64_t t_ns, const std::string& frame, const Pose& T_frame_body) {
  ::foxglove::PoseInFrame pose;
  set(*pose.mutable_timestamp(), t_ns);
  pose.set_frame_id(frame);
  set(*pose.mutable_pose(), T_frame_body);
  return bytes_of(pose);
}

std::string print_poses(std::int64_t t_ns, const std::string& frame, std::span<const Pose> poses) {
  ::foxglove::PosesInFrame message;
  set(*message.mutable_timestamp(), t_ns);
  message.set_frame_id(frame);
  for (const Pose& pose : poses) set(*message.add_poses(), pose);
  return bytes_of(message);
}

std::string print_scene(std::int64_t t_ns, const Entity& entity) {
  ::foxglove::SceneUpdate scene;
  ::foxglove::SceneEntity& drawn = *scene.add_entities();
  set(*drawn.mutable_timestamp(), t_ns);
  drawn.set_frame_id(entity.frame);
  drawn.set_id(entity.id);
  drawn.set_frame_locked(true);
  for (const Line& line : entity.lines) set(*drawn.add_lines(), line);
  for (const Ball& ball : entity.balls) set(*drawn.add_spheres(), ball);
  for (const Text& text : entity.texts) set(*drawn.add_texts(), text);
  return bytes_of(scene);
}

std::string print_log(std::int64_t t_ns, const LogLine& line) {
  ::foxglove::Log log;
  set(*log.mutable_timestamp(), t_ns);
  log.set_level(level_of(line.level));
  log.set_message(line.text);
  log.set_name(line.name);
  return bytes_of(log);
}

LogLine read_log(std::string_view bytes) {
  ::foxglove::Log log;
  if (!std::in_range<int>(bytes.size()) || !log.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    throw Error(ErrorCode::kBadInput, "a line of a plugin's log that is no foxglove.Log");
  LogLine line{.level = HW_LOG_DEBUG, .name = log.name(), .text = log.message()};
  for (const std::uint32_t level : {HW_LOG_INFO, HW_LOG_WARNING, HW_LOG_ERROR}) {
    if (log.level() == level_of(level)) line.level = level;
  }
  return line;
}

std::string print_picture(std::int64_t t_ns, std::string_view png) {
  ::foxglove::CompressedImage image;
  set(*image.mutable_timestamp(), t_ns);
  image.set_frame_id("picture");  // of itself: it is no view of a camera in the world
  image.set_data(png.data(), png.size());
  image.set_format("png");
  return bytes_of(image);
}

}  // namespace hallway::foxglove
