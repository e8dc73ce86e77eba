// SPDX-License-Identifier: MIT
// Rays, odometry and IMUs in a log, read by what the log itself says of its messages.
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "foxglove/view.hpp"
#include "host/samples/gnss_kind.hpp"
#include "host/samples/imu_kind.hpp"
#include "host/samples/magnetic_kind.hpp"
#include "host/samples/odometry_kind.hpp"
#include "host/samples/range_scan_kind.hpp"
#include "log/mcap_reader.hpp"

namespace hallway::foxglove {
namespace {

namespace pb = ::google::protobuf;

constexpr std::int64_t kPeriod_ns = 100'000'000;

/// A message as its schema record says, which is all that this knows.
class Reader {
 public:
  explicit Reader(const std::string& descriptors) {
    pb::FileDescriptorSet files;
    EXPECT_TRUE(files.ParseFromString(descriptors));
    for (const pb::FileDescriptorProto& file : files.file()) EXPECT_NE(pool_.BuildFile(file), nullptr);
  }
  std::unique_ptr<pb::Message> read(const std::string& type, std::string_view bytes) {
    std::unique_ptr<pb::Message> message(factory_.GetPrototype(pool_.FindMessageTypeByName(type))->New());
    EXPECT_TRUE(message->ParseFromArray(bytes.data(), static_cast<int>(bytes.size())));
    EXPECT_EQ(message->GetReflection()->GetUnknownFields(*message).field_count(), 0);
    return message;
  }

 private:
  pb::DescriptorPool pool_;
  pb::DynamicMessageFactory factory_{&pool_};
};

const pb::FieldDescriptor* field(const pb::Message& message, const std::string& name) {
  return message.GetDescriptor()->FindFieldByName(name);
}
const pb::Message& child(const pb::Message& message, const std::string& name) {
  return message.GetReflection()->GetMessage(message, field(message, name));
}
double real(const pb::Message& message, const std::string& name) {
  return message.GetReflection()->GetDouble(message, field(message, name));
}
std::string text(const pb::Message& message, const std::string& name) {
  return message.GetReflection()->GetString(message, field(message, name));
}
std::vector<double> reals(const pb::Message& message, const std::string& name) {
  std::vector<double> values;
  const pb::Reflection& reflection = *message.GetReflection();
  for (int i = 0; i < reflection.FieldSize(message, field(message, name)); ++i)
    values.push_back(reflection.GetRepeatedDouble(message, field(message, name), i));
  return values;
}
Vec3 vector(const pb::Message& message) {
  return {real(message, "x"), real(message, "y"), real(message, "z")};
}
Pose pose(const pb::Message& t, const pb::Message& q) {
  return {Quat(real(q, "w"), real(q, "x"), real(q, "y"), real(q, "z")), vector(t)};
}

/// A message of a log with its schema.
struct Logged {
  std::uint64_t log_time_ns = 0;
  log::McapSchema schema;
  std::string encoding;
  std::string data;
};

using Topics = std::map<std::string, std::vector<Logged>>;

/// Frames of a robot, and their log.
class Senses {
 public:
  Senses() : writer_(out_, {.profile = "", .library = ""}), view_(writer_, {}) {
    host::SensorInfo mounted;
    mounted.id = 1;
    mounted.T_body_sensor = {{0.5, 0.25, 0.125}, {1, 0, 0, 0}};
    host::SensorInfo receiver;
    receiver.id = 7;
    receiver.kind = HW_SAMPLE_GNSS;
    receiver.intrinsics =
        host::GnssIntrinsics{.latitude_deg = 48.0, .longitude_deg = 11.0, .altitude_m = 500.0};
    const std::array sensors{mounted, receiver};
    view_.set_sensors(sensors);
  }
  host::FrameBuilder& begin(std::uint32_t iteration) {
    stamp_ = {iteration, kPeriod_ns * iteration};
    builder_.begin(iteration, stamp_.t_ns);
    return builder_;
  }
  void end() { view_.add_frame(stamp_, builder_.finish()); }
  void add_truth(const Pose& pose) {
    view_.add_true_pose(stamp_, {.iteration = stamp_.iteration,
                                 .position_m = {pose.t.x(), pose.t.y(), pose.t.z()},
                                 .orientation = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}});
  }
  View& view() { return view_; }
  const log::FrameStamp& stamp() const { return stamp_; }

  Topics topics() {
    view_.finish();
    writer_.finish();
    const log::MemoryInput input(out_.text());
    log::McapReader reader(input);
    std::map<std::uint16_t, log::McapSchema> schemas;
    Topics topics;
    while (const log::McapItem* item = reader.next()) {
      if (const auto* schema = std::get_if<log::McapSchema>(item)) schemas[schema->id] = *schema;
      const auto* message = std::get_if<log::McapMessage>(item);
      if (message == nullptr) continue;
      const log::McapChannel& channel = reader.channels().at(message->channel_id);
      topics[channel.topic].push_back({message->log_time_ns, schemas.at(channel.schema_id), channel.encoding,
                                       std::string(message->data)});
    }
    return topics;
  }

 private:
  log::StringOutput out_;
  log::McapWriter writer_;
  View view_;
  host::FrameBuilder builder_;
  log::FrameStamp stamp_;
};

TEST(FoxgloveSenses, ALevelScanIsALaserScan) {
  Senses senses;
  host::RangeScanReading scan = host::add_range_scan(senses.begin(1), 1);
  std::vector<double> ranges;
  for (int i = 0; i < 180; ++i) {
    ranges.push_back(i % 17 == 3 ? std::numeric_limits<double>::infinity() : 1.0 + 1.0 / (3.0 + i));
    scan.rays.push_back({-1.5 + 3.0 * i / 179, 0.0, ranges.back()});
    scan.data.intensity.push_back(0.25F * static_cast<float>(i % 4));
  }
  senses.end();
  const Topics topics = senses.topics();
  const Logged& logged = topics.at("/foxglove/scan/sensor_1").at(0);
  EXPECT_EQ(logged.schema.name, "foxglove.LaserScan");
  EXPECT_EQ(logged.schema.encoding, "protobuf");
  EXPECT_EQ(logged.encoding, "protobuf");
  Reader reader(logged.schema.data);
  const auto message = reader.read(logged.schema.name, logged.data);
  EXPECT_EQ(text(*message, "frame_id"), "sensor_1");
  EXPECT_EQ(reals(*message, "ranges"), ranges) << "to the last bit";
  const std::vector<double> intensities = reals(*message, "intensities");
  ASSERT_EQ(intensities.size(), ranges.size());
  EXPECT_EQ(intensities[7], 0.75);
  EXPECT_EQ(real(*message, "start_angle"), -1.5);
  EXPECT_NEAR(real(*message, "end_angle"), 1.5, 1e-12);
  ASSERT_EQ(topics.at("/foxglove/tf/sensor_1").size(), 1u) << "it has a place on the body";
}

TEST(FoxgloveSenses, OtherRaysAreACloud) {
  Senses senses;
  host::RangeScanReading scan = host::add_range_scan(senses.begin(1), 1, {.width = 20, .height = 2});
  for (int i = 0; i < 40; ++i) {
    scan.rays.push_back({0.1 * (i % 20), i < 20 ? -0.1 : 0.1, 2.0 + 0.01 * i});
    scan.data.ring.push_back(i < 20 ? 0 : 1);
  }
  const std::vector<hw_ray_t> rays = scan.rays;
  senses.end();
  const Topics topics = senses.topics();
  EXPECT_FALSE(topics.contains("/foxglove/scan/sensor_1"));
  const Logged& logged = topics.at("/foxglove/rays/sensor_1").at(0);
  Reader reader(logged.schema.data);
  const auto message = reader.read("foxglove.PointCloud", logged.data);
  const pb::Reflection& reflection = *message->GetReflection();
  std::map<std::string, std::uint32_t> offsets;
  for (int i = 0; i < reflection.FieldSize(*message, field(*message, "fields")); ++i) {
    const pb::Message& one = reflection.GetRepeatedMessage(*message, field(*message, "fields"), i);
    offsets[text(one, "name")] = one.GetReflection()->GetUInt32(one, field(one, "offset"));
    const int type = one.GetReflection()->GetEnumValue(one, field(one, "type"));
    EXPECT_EQ(type, text(one, "name") == "ring" ? 3 : 7) << "UINT16 or FLOAT32";
  }
  const std::uint32_t stride = reflection.GetUInt32(*message, field(*message, "point_stride"));
  EXPECT_EQ(stride, 14u);
  const std::string data = text(*message, "data");
  ASSERT_EQ(data.size(), 40u * stride);
  for (std::size_t i = 0; i < 40; ++i) {
    const auto at = [&](const char* name) {
      float value = 0;
      std::memcpy(&value, data.data() + i * stride + offsets.at(name), sizeof value);
      return static_cast<double>(value);
    };
    EXPECT_NEAR(Vec3(at("x"), at("y"), at("z")).norm(), rays[i].range_m, 1e-6);
    EXPECT_NEAR(std::atan2(at("y"), at("x")), rays[i].azimuth_rad, 1e-6);
    EXPECT_NEAR(std::asin(at("z") / rays[i].range_m), rays[i].elevation_rad, 1e-6);
    std::uint16_t ring = 9;
    std::memcpy(&ring, data.data() + i * stride + offsets.at("ring"), sizeof ring);
    EXPECT_EQ(ring, i < 20 ? 0 : 1);
  }
}

TEST(FoxgloveSenses, ScansAreShownFiveTimesASecond) {
  Senses senses;
  for (std::uint32_t i = 1; i <= 20; ++i) {
    host::FrameBuilder& builder = senses.begin(i);
    for (const double range_m : {1.0, 2.0 * i}) {  // the last one counts
      for (const std::uint32_t sensor : {1u, 2u}) {
        host::RangeScanReading scan = host::add_range_scan(builder, sensor);
        scan.rays = {{0.0, 0.0, range_m}, {0.1, 0.0, range_m}};
      }
    }
    senses.end();
  }
  const Topics topics = senses.topics();
  for (const char* topic : {"/foxglove/scan/sensor_1", "/foxglove/scan/sensor_2"}) {
    const std::vector<Logged>& scans = topics.at(topic);
    ASSERT_EQ(scans.size(), 10u);
    Reader reader(scans[3].schema.data);
    EXPECT_EQ(scans[3].log_time_ns, 700'000'000u);
    EXPECT_EQ(reals(*reader.read("foxglove.LaserScan", scans[3].data), "ranges"), (std::vector{14.0, 14.0}));
  }
}

TEST(FoxgloveSenses, ReadingsOfAnImuArePlainNumbersAtTheirOwnTimes) {
  Senses senses;
  host::FrameBuilder& builder = senses.begin(3);
  for (int i = 1; i <= 4; ++i) {
    hw_imu_t& imu = host::add_imu(builder, 2);
    for (int axis = 0; axis < 3; ++axis) imu.force_m_s2[axis] = 0.1 * axis + i;
    imu.angular_rad_s[2] = 1.0 / 3.0;  // of the other axes nothing is known
    builder.set_reading(static_cast<std::uint64_t>(i), 200'000'000 + 25'000'000 * (i - 1),
                        200'000'000 + 25'000'000 * i);
  }
  hw_imu_t& wrong = host::add_imu(builder, 5);
  wrong.force_m_s2[0] = 1.0;
  builder.set_reading(0, 50'000'000'000, 50'010'000'000);  // by a clock that is wrong
  senses.end();
  const Topics topics = senses.topics();
  const std::vector<Logged>& readings = topics.at("/foxglove/imu/sensor_2");
  ASSERT_EQ(readings.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Logged& logged = readings[i];
    EXPECT_EQ(logged.log_time_ns, 225'000'000u + 25'000'000u * i);
    EXPECT_EQ(logged.encoding, "json");
    EXPECT_EQ(logged.schema.encoding, "jsonschema");
    EXPECT_EQ(logged.schema.name, "hallway.Imu");
    const auto reading = nlohmann::ordered_json::parse(logged.data);
    const auto schema = nlohmann::ordered_json::parse(logged.schema.data);
    EXPECT_EQ(reading.at("force_m_s2").at("y").get<double>(), 0.1 + static_cast<double>(i + 1));
    EXPECT_EQ(reading.at("angular_rad_s").at("z").get<double>(), 1.0 / 3.0);
    EXPECT_FALSE(reading.at("angular_rad_s").contains("x")) << "not known";
    EXPECT_EQ(reading.at("timestamp").at("nsec"), logged.log_time_ns);
    for (const auto& required : schema.at("required")) EXPECT_TRUE(reading.contains(required));
    for (const auto& [name, member] : reading.items()) {
      const auto& says = schema.at("properties").at(name);
      EXPECT_EQ(says.at("type"), "object");
      for (const auto& [axis, value] : member.items()) {
        EXPECT_TRUE(value.is_number());
        EXPECT_EQ(says.at("properties").at(axis).at("type"), name == "timestamp" ? "integer" : "number");
      }
    }
  }
  EXPECT_EQ(topics.at("/foxglove/imu/sensor_5").at(0).log_time_ns, 300'000'000u) << "that of the frame";
}

TEST(FoxgloveSenses, AFixIsAPlaceOnEarthWhereTheOriginIsKnown) {
  Senses senses;
  host::FrameBuilder& builder = senses.begin(3);
  const auto add = [&](std::uint32_t sensor, std::uint64_t k, bool has_fix) {
    hw_gnss_t& gnss = host::add_gnss(builder, sensor);
    builder.set_reading(k, 200'000'000 + static_cast<std::int64_t>(k),
                        200'000'000 + static_cast<std::int64_t>(k));
    if (!has_fix) return;
    gnss.fix = HW_GNSS_POSITION;
    gnss.position_m[0] = 100.0;  // east
    gnss.position_m[1] = gnss.position_m[2] = 0.0;
    for (int i = 0; i < 6; ++i) gnss.covariance[i] = 1.0 + i;
  };
  add(7, 1, true);
  add(7, 2, false);
  add(8, 1, true);  // nobody knows where on Earth
  senses.end();
  const Topics topics = senses.topics();
  EXPECT_FALSE(topics.contains("/foxglove/location/sensor_8"));
  const std::vector<Logged>& fixes = topics.at("/foxglove/location/sensor_7");
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].log_time_ns, 200'000'001u);
  Reader reader(fixes[0].schema.data);
  const auto fix = reader.read("foxglove.LocationFix", fixes[0].data);
  const GeoPoint expected = place_at({48.0, 11.0, 500.0}, {100, 0, 0});
  EXPECT_EQ(real(*fix, "latitude"), expected.latitude_deg);
  EXPECT_EQ(real(*fix, "longitude"), expected.longitude_deg);
  EXPECT_EQ(real(*fix, "altitude"), expected.altitude_m);
  EXPECT_EQ(reals(*fix, "position_covariance"), (std::vector<double>{1, 2, 3, 2, 4, 5, 3, 5, 6}));
}

TEST(FoxgloveSenses, HeadingsArePlainNumbers) {
  Senses senses;
  host::FrameBuilder& builder = senses.begin(3);
  host::add_magnetic(builder, 4).heading_rad = 0.25;
  host::add_magnetic(builder, 4);  // not known
  senses.end();
  const Topics topics = senses.topics();
  const std::vector<Logged>& headings = topics.at("/foxglove/compass/sensor_4");
  ASSERT_EQ(headings.size(), 2u);
  EXPECT_EQ(headings[0].schema.name, "hallway.Compass");
  const auto first = nlohmann::ordered_json::parse(headings[0].data);
  EXPECT_EQ(first.at("heading_rad").get<double>(), 0.25);
  EXPECT_FALSE(first.contains("variance_rad2"));
  EXPECT_FALSE(nlohmann::ordered_json::parse(headings[1].data).contains("heading_rad"));
  const auto schema = nlohmann::ordered_json::parse(headings[0].schema.data);
  for (const auto& [name, value] : first.items()) EXPECT_TRUE(schema.at("properties").contains(name)) << name;
}

TEST(FoxgloveSenses, OdometryBeginsWhereTheRobotTrulyIs) {
  Senses senses;
  const Pose first{Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())), Vec3(1, 2, 0)};
  const Pose truth{Quat(Eigen::AngleAxisd(-1.0, Vec3::UnitZ())), Vec3(10, 20, 0.5)};
  for (std::uint32_t i = 1; i < 4; ++i) {
    host::FrameBuilder& builder = senses.begin(i);
    for (const double x : {5.0, 1.0}) {  // the last one counts
      hw_odometry_t& odometry = host::add_odometry(builder, 1);
      odometry.T_odom_sensor = {{x * i, 2, 0}, {first.q.w(), 0, 0, first.q.z()}};
    }
    senses.end();
    if (i >= 2) senses.add_truth(truth);
  }
  const Topics topics = senses.topics();
  const std::vector<Logged>& poses = topics.at("/foxglove/odometry/sensor_1");
  ASSERT_EQ(poses.size(), 3u) << "one a frame";
  Reader reader(poses[1].schema.data);
  const auto second = reader.read("foxglove.PoseInFrame", poses[1].data);
  EXPECT_EQ(text(*second, "frame_id"), "odom_1");
  const Pose T_odom_sensor =
      pose(child(child(*second, "pose"), "position"), child(child(*second, "pose"), "orientation"));
  EXPECT_EQ(T_odom_sensor.t, Vec3(2, 2, 0));
  const std::vector<Logged>& places = topics.at("/foxglove/tf/odom_1");
  ASSERT_EQ(places.size(), 2u) << "assumed, and as the truth has it";
  Reader transforms(places[1].schema.data);
  const auto place = transforms.read("foxglove.FrameTransform", places[1].data);
  EXPECT_EQ(text(*place, "parent_frame_id"), "world");
  const Pose T_world_odom = pose(child(*place, "translation"), child(*place, "rotation"));
  const Pose sensor = T_world_odom * T_odom_sensor;
  EXPECT_LT((sensor.t - truth * Vec3(0.5, 0.25, 0.125)).norm(), 1e-12);
  EXPECT_LT(sensor.q.angularDistance(truth.q), 1e-7);
}

TEST(FoxgloveSenses, PathsAndLandmarksAreListsToo) {
  Senses senses;
  senses.view().set_true_landmarks(std::vector<log::Landmark>{{.id = 1, .position_m = {1, 2, 3}}});
  for (std::uint32_t i = 0; i < 100; ++i) {
    senses.begin(i);
    senses.end();
    senses.add_truth({Quat(Eigen::AngleAxisd(0.01 * i, Vec3::UnitZ())), Vec3(1.0 * i, 0, 0)});
    senses.view().add_pose(senses.stamp(), {true, {0, 1.0 * i, 0}, {1, 0, 0, 0}});
  }
  senses.view().add_map(senses.stamp(), {.landmarks = {{.id = 5, .position_m = {7, 8, 9}}}});
  const Topics topics = senses.topics();
  for (const char* topic : {"/foxglove/truth/path_poses", "/foxglove/path_poses"}) {
    const std::vector<Logged>& shown = topics.at(topic);
    std::size_t poses = 0;
    for (const Logged& logged : shown) {
      Reader reader(logged.schema.data);
      const auto message = reader.read("foxglove.PosesInFrame", logged.data);
      const auto now =
          static_cast<std::size_t>(message->GetReflection()->FieldSize(*message, field(*message, "poses")));
      EXPECT_GT(now, poses);
      poses = now;
      EXPECT_EQ(text(*message, "frame_id"), topic[10] == 't' ? "world" : "map");
    }
    EXPECT_EQ(poses, 100u) << "the last has all";
    EXPECT_LT(shown.size(), 6u);
  }
  const Logged& mapped = topics.at("/foxglove/landmark_cloud").at(0);
  Reader reader(mapped.schema.data);
  const auto cloud = reader.read("foxglove.PointCloud", mapped.data);
  float place[3];
  ASSERT_EQ(text(*cloud, "data").size(), sizeof place);
  std::memcpy(place, text(*cloud, "data").data(), sizeof place);
  EXPECT_EQ(Vec3(place[0], place[1], place[2]), Vec3(7, 8, 9));
  EXPECT_EQ(text(*cloud, "frame_id"), "map");
  EXPECT_EQ(topics.at("/foxglove/truth/landmark_cloud").size(), 1u);
}

}  // namespace
}  // namespace hallway::foxglove
