// SPDX-License-Identifier: MIT
#include "link/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "support/errors.hpp"
#include "support/known_robot.hpp"
#include "unit/link/datagrams.hpp"

namespace hallway::link {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::optional<Answer> through(const Answer& answer, std::uint8_t version = kFirstVersion) {
  Bytes payload;
  write_answer(answer, payload, version);
  const Bytes bytes =
      datagram_of({.type = Type::kAnswer, .sequence = answer.sequence, .version = version}, payload);
  return read_answer(std::get<Datagram>(read_datagram(bytes)));
}

TEST(Answer, IsReadBack) {
  Answer answer{.number = 5, .status = HW_ANSWER_LATE, .sequence = 77, .t_ns = -3};
  auto back = through(answer);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->number, 5u);
  EXPECT_EQ(back->status, unsigned{HW_ANSWER_LATE});
  EXPECT_EQ(back->sequence, 77u);
  EXPECT_EQ(back->t_ns, -3);
  EXPECT_FALSE(back->command);
  EXPECT_FALSE(back->pose);
  answer.command = {0.25, -1e-300};
  answer.pose = host::PoseOutput{true, {{1, 2, 3}, {0.6, 0, 0, 0.8}}};
  back = through(answer);
  ASSERT_TRUE(back && back->command && back->pose);
  EXPECT_EQ(*back->command, *answer.command);
  EXPECT_TRUE(back->pose->valid);
  EXPECT_EQ(std::memcmp(&back->pose->T_map_body, &answer.pose->T_map_body, sizeof(hw_pose_t)), 0);
  answer.pose = host::PoseOutput{};
  back = through(answer);
  ASSERT_TRUE(back && back->pose);
  EXPECT_FALSE(back->pose->valid);
}

TEST(Answer, OfALaterHostIsReadAsFarAsItIsKnown) {
  Bytes payload;
  write_answer({.number = 5, .sequence = 77, .command = host::DriveCommand{0.25, 0.5, -0.125}}, payload,
               kNewestVersion);
  payload.resize(payload.size() + 16, std::byte{0x5a});
  const auto read = [&](std::uint8_t version) {
    const Bytes bytes = datagram_of({.type = Type::kAnswer, .sequence = 77, .version = version}, payload);
    return read_answer(std::get<Datagram>(read_datagram(bytes)));
  };
  EXPECT_FALSE(read(kFirstVersion)) << "it is always of one length";
  const auto answer = read(kNewestVersion);
  ASSERT_TRUE(answer && answer->command);
  EXPECT_EQ(answer->number, 5u);
  EXPECT_EQ(*answer->command, (host::DriveCommand{0.25, 0.5, -0.125}));
}

TEST(Answer, TellsTheTimeOfAPoseWhereTheVersionHasIt) {
  Answer answer{.number = 5, .t_ns = 100};
  answer.pose = host::PoseOutput{.valid = true, .T_map_body = {{1, 2, 3}, {1, 0, 0, 0}}};
  const auto time_through = [&](std::int64_t t_ns, std::uint8_t version) -> std::optional<std::int64_t> {
    answer.pose->t_ns = t_ns;
    const auto back = through(answer, version);
    if (!back) return std::nullopt;
    return back->pose->t_ns;
  };
  EXPECT_EQ(time_through(70, kNewestVersion), 70);
  EXPECT_EQ(time_through(100, kNewestVersion), 100);
  EXPECT_EQ(time_through(70, kFirstVersion), 0);
  EXPECT_EQ(time_through(101, kNewestVersion), std::nullopt) << "after the frame's";
  EXPECT_EQ(time_through(-1, kNewestVersion), std::nullopt);
  Bytes payload;
  answer.pose->t_ns = 0;
  write_answer(answer, payload, kNewestVersion);
  EXPECT_EQ(payload.size(), 104u) << "of the frame's own time the bytes are those of before";
  store(payload.data() + 4, load<std::uint32_t>(payload.data() + 4) | 8u);  // it says that there is one
  const Bytes bytes = datagram_of({.type = Type::kAnswer, .version = kNewestVersion}, payload);
  EXPECT_FALSE(read_answer(std::get<Datagram>(read_datagram(bytes))));
}

TEST(Answer, SidewaysSpeedIsItsLastNumber) {
  Bytes payload, before;
  write_answer({.number = 5, .command = host::DriveCommand{0.25, 0.5, -0.125}}, payload, kNewestVersion);
  write_answer({.number = 5, .command = host::DriveCommand{0.25, 0.5}}, before, kNewestVersion);
  ASSERT_EQ(payload.size(), 104u);
  EXPECT_EQ(load<double>(payload.data() + 96), -0.125);
  EXPECT_EQ(load<std::uint64_t>(before.data() + 96), 0u) << "as hosts before it wrote";
  EXPECT_TRUE(std::equal(payload.begin(), payload.begin() + 96, before.begin()));
}

TEST(Answer, WithoutSenseIsRefused) {
  EXPECT_FALSE(through({.status = HW_ANSWER_END + 1}));
  EXPECT_FALSE(through({.command = host::DriveCommand{kNan, 0}}));
  EXPECT_FALSE(through({.command = host::DriveCommand{0, 0, kNan}}));
  EXPECT_FALSE(through({.command = host::DriveCommand{0, std::numeric_limits<double>::infinity()}}));
  EXPECT_FALSE(through({.pose = host::PoseOutput{true, {{0, kNan, 0}, {1, 0, 0, 0}}}}));
  EXPECT_FALSE(through({.pose = host::PoseOutput{true, {{0, 0, 0}, {1, 1, 0, 0}}}}));
  for (std::size_t size = 0; size < 120; ++size) {
    const Bytes bytes = datagram_of({.type = Type::kAnswer}, Bytes(size));
    EXPECT_FALSE(read_answer(std::get<Datagram>(read_datagram(bytes)))) << size << " zeros are no rotation";
  }
}

TEST(Missing, IsReadBack) {
  for (const std::size_t fragments : {1u, 7u, 8u, 9u, 351u, 8192u}) {
    for (const std::size_t every : {1u, 3u, 100u, 100'000u}) {
      std::vector<bool> missing(fragments);
      for (std::size_t i = every - 1; i < fragments; i += every) missing[i] = true;
      Bytes payload;
      write_missing(missing, payload);
      EXPECT_LE(payload.size(), kFragmentBytes);
      EXPECT_EQ(read_missing(payload, fragments), missing) << fragments << " " << every;
      EXPECT_FALSE(read_missing(payload, fragments + 1));
      payload.push_back(std::byte{0});
      EXPECT_FALSE(read_missing(payload, fragments) && payload.size() != 2 + (fragments + 7) / 8);
    }
  }
  EXPECT_FALSE(read_missing({}, 1));
  EXPECT_FALSE(read_missing(Bytes(1), 1));
}

void expect_same(const Description& back, const Description& robot) {
  EXPECT_EQ(back.lock_step, robot.lock_step);
  EXPECT_EQ(back.period_ns, robot.period_ns);
  EXPECT_EQ(back.name, robot.name);
  ASSERT_EQ(back.sensors.size(), robot.sensors.size());
  for (std::size_t i = 0; i < robot.sensors.size(); ++i) {
    const host::SensorInfo& a = robot.sensors[i];
    const host::SensorInfo& b = back.sensors[i];
    EXPECT_EQ(b.id, a.id);
    EXPECT_EQ(b.kind, a.kind);
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(std::memcmp(&b.T_body_sensor, &a.T_body_sensor, sizeof a.T_body_sensor), 0);
    EXPECT_EQ(std::memcmp(&b.horizontal_fov, &a.horizontal_fov, 7 * sizeof(double)), 0) << "unknown is NaN";
  }
}

TEST(Description, IsReadBackToTheLastBitInEveryVersion) {
  Description robot = description(true);
  host::SensorInfo& sensor = robot.sensors.emplace_back(robot.sensors.front());
  sensor.id = 9;
  sensor.kind = 77;
  sensor.name = "schräg";
  sensor.T_body_sensor = {{0.1, 0.2, -0.3}, {0.6, 0, 0, 0.8}};
  sensor.noise_m[1] = 0.02;
  sensor.max_range_m = std::numeric_limits<double>::infinity();
  for (const std::uint8_t version : {kFirstVersion, kNewestVersion})
    expect_same(read_description(write_description(robot, version), version), robot);
  EXPECT_FALSE(read_description(write_description(description(false), 1), 1).lock_step);
}

Description known_description() {
  Description robot = description(true);
  const host::Activation known = hallway::test::known_robot();
  robot.sensors = known.sensors;
  robot.drive = known.drive;
  robot.body = known.body;
  return robot;
}

host::Activation robot_in(const Description& description) {
  return {description.sensors, description.drive, description.body};
}

TEST(Description, DriveBodyAndIntrinsicsAreReadBackWhereTheVersionHasThem) {
  const Description robot = known_description();
  const Description back = read_description(write_description(robot, kNewestVersion), kNewestVersion);
  expect_same(back, robot);
  hallway::test::expect_same_robot(robot_in(back), robot_in(robot));
  const Description first = read_description(write_description(robot, kFirstVersion), kFirstVersion);
  expect_same(first, robot);
  EXPECT_FALSE(first.drive || first.body);
  for (const host::SensorInfo& sensor : first.sensors) EXPECT_TRUE(std::isnan(sensor.rate_hz));
  Description only_body = robot;
  only_body.drive.reset();
  only_body.body = host::BodyInfo{};
  const Description other = read_description(write_description(only_body, kNewestVersion), kNewestVersion);
  hallway::test::expect_same_robot(robot_in(other), robot_in(only_body));
}

/// Version 2 as those read it who knew nothing of drive and body: each struct is as long as it says.
TEST(Description, IsReadAsFarAsItWasKnownBefore) {
  const Bytes message = write_description(known_description(), kNewestVersion);
  AlignedByteReader reader(message);
  const auto skip = [&](std::uint32_t known_bytes) {
    AlignedByteReader ahead = reader;
    const auto size = ahead.get<std::uint32_t>();
    EXPECT_GT(size, known_bytes);
    EXPECT_EQ(size % 8, 0u);
    reader.take_raw(size);
    return reader.get_text();
  };
  EXPECT_EQ(skip(24), "office");
  EXPECT_EQ(skip(128), "wheels");
  EXPECT_EQ(skip(128), "bumper");
  const Bytes before = write_description(description(true), kNewestVersion);
  EXPECT_EQ(load<std::uint32_t>(before.data()), 24u) << "of an unknown robot nothing is added";
}

/// The bytes of the first sensor of a description of an unknown robot behind those that its first readers knew.
std::vector<std::uint64_t> sensor_parts(const host::SensorInfo& sensor) {
  Description robot = description(true);
  robot.sensors = {sensor};
  const Bytes message = write_description(robot, kNewestVersion);
  const std::size_t at = 24 + 16;  // behind the robot and its name
  std::vector<std::uint64_t> words((load<std::uint32_t>(message.data() + at) - 128) / 8);
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = load<std::uint64_t>(message.data() + at + 128 + 8 * i);
  return words;
}

TEST(Description, OfASensorOfWhichNoMoreIsKnownHasTheBytesOfBefore) {
  host::SensorInfo sensor{.id = 4, .kind = HW_SAMPLE_ENCODER, .name = "wheels"};
  EXPECT_TRUE(sensor_parts(sensor).empty());
  sensor.intrinsics = host::EncoderIntrinsics{{{}}};
  const std::vector<std::uint64_t> before = sensor_parts(sensor);
  ASSERT_EQ(before.size(), 2u + 7u);
  EXPECT_EQ(before[0], HW_SAMPLE_ENCODER) << "and no bytes to the rate";
  EXPECT_EQ(before[1], 1u) << "wheel";
}

TEST(Description, RatesStandBehindTheIntrinsicsWhichSayWhere) {
  host::SensorInfo sensor{.id = 4, .kind = HW_SAMPLE_ENCODER, .name = "wheels"};
  sensor.rate_hz = 0.5;
  std::vector<std::uint64_t> words = sensor_parts(sensor);
  ASSERT_EQ(words.size(), 1u + 5u);
  EXPECT_EQ(words[0], std::uint64_t{8} << 32) << "no intrinsics, 8 bytes to the rate";
  EXPECT_EQ(std::bit_cast<double>(words[1]), 0.5);
  sensor.intrinsics = host::EncoderIntrinsics{{{}}};
  words = sensor_parts(sensor);
  ASSERT_EQ(words.size(), 2u + 7u + 5u);
  EXPECT_EQ(words[0], HW_SAMPLE_ENCODER | std::uint64_t{72} << 32);
  EXPECT_EQ(std::bit_cast<double>(words[9]), 0.5);
}

TEST(Description, ARateOutsideOfItsSensorIsRefused) {
  Description robot = description(true);
  robot.sensors[0].rate_hz = 0.5;
  const Bytes message = write_description(robot, kNewestVersion);
  const std::size_t head = 24 + 16 + 128;
  for (const std::uint32_t to_rate : {1u, 4u, 12u, 16u, 0xffff'fff8u}) {
    Bytes lies = message;
    store(lies.data() + head + 4, to_rate);
    EXPECT_TRUE(hallway::test::error_of([&] { read_description(lies, kNewestVersion); })) << to_rate;
  }
  Bytes later = message;
  store(later.data() + head, 4711u);  // intrinsics of a kind of tomorrow
  EXPECT_EQ(read_description(later, kNewestVersion).sensors[0].rate_hz, 0.5);
  Description slow = robot;
  slow.sensors[0].rate_hz = -1;
  EXPECT_TRUE(hallway::test::error_of([&] { write_description(slow, kNewestVersion); }));
}

TEST(Description, ALaterOnesPartsArePassedOver) {
  Bytes message = write_description(known_description(), kNewestVersion);
  const auto size = load<std::uint32_t>(message.data());
  message.insert(message.begin() + size, 16, std::byte{0x5a});
  store(message.data(), size + 16);
  ASSERT_EQ(load<std::uint32_t>(message.data() + 24), 3u) << "there are a drive and a body";
  store(message.data() + 24, 0xffff'ffffu);  // and what a later robot may have
  hallway::test::expect_same_robot(robot_in(read_description(message, kNewestVersion)),
                                   robot_in(known_description()));
  store(message.data() + 28, 4711u);  // the kind of its drive
  EXPECT_EQ(read_description(message, kNewestVersion).drive->kind, std::uint32_t{HW_DRIVE_UNKNOWN});
}

TEST(Description, PartsWithoutSenseAreRefused) {
  Description robot = known_description();
  robot.drive->max_speed_m_s = -1;
  EXPECT_TRUE(hallway::test::error_of([&] { write_description(robot, kNewestVersion); }));
  robot = known_description();
  std::reverse(robot.body->corners.begin(), robot.body->corners.end());
  EXPECT_TRUE(hallway::test::error_of([&] { write_description(robot, kNewestVersion); }));
  robot = known_description();
  std::get<host::BumpIntrinsics>(robot.sensors[1].intrinsics).zones[0].name = "a\nb";
  EXPECT_TRUE(hallway::test::error_of([&] { write_description(robot, kNewestVersion); }));
}

TEST(Description, EveryTruncationIsRefusedAndNoChangedByteCrashes) {
  for (const std::uint8_t version : {kFirstVersion, kNewestVersion}) {
    const Bytes whole = write_description(known_description(), version);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const std::span<const std::byte> cut(whole.data(), size);
      EXPECT_TRUE(hallway::test::error_of([&] { read_description(cut, version); })) << size;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
      for (const std::byte value : {std::byte{0}, std::byte{0x7f}, std::byte{0x80}, std::byte{0xff}}) {
        Bytes changed = whole;
        changed[i] = value;
        hallway::test::error_of([&] { read_description(changed, version); });
      }
    }
  }
}

TEST(Description, OfVersion2HasTheBytesOfTheSpecification) {
  Description robot = description(true);
  robot.sensors[0].id = 9;
  robot.sensors[0].kind = 77;
  robot.sensors[0].T_body_sensor.position[0] = 0.25;
  robot.sensors[0].noise_m[2] = 0.5;
  const Bytes bytes = write_description(robot, kNewestVersion);
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const auto real = [&](std::size_t at) {
    double value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  EXPECT_EQ(word(0), 24u);
  EXPECT_EQ(word(4), 1u) << "lock-step";
  EXPECT_EQ(word(8), 1u) << "sensors";
  EXPECT_EQ(word(24), 6u) << "the name's length";
  EXPECT_EQ(word(40), 128u);
  EXPECT_EQ(word(44), 9u);
  EXPECT_EQ(word(48), 77u);
  EXPECT_EQ(real(56), 0.25);
  EXPECT_EQ(real(40 + 128 - 8), 0.5);
  EXPECT_EQ(word(40 + 128), 4u) << "the sensor's name";
}

/// A description of version 2 whose struct at `offset` says that it has `more` bytes more, which stand behind it.
Bytes grown(const Bytes& message, std::size_t offset, std::uint32_t more,
            std::byte filled = std::byte{0x5a}) {
  std::uint32_t size = 0;
  std::memcpy(&size, message.data() + offset, sizeof size);
  Bytes bytes = message;
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(offset + size), more, filled);
  size += more;
  std::memcpy(bytes.data() + offset, &size, sizeof size);
  return bytes;
}

TEST(Description, OfALaterRobotIsReadAsFarAsItIsKnown) {
  const Description robot = description(true);
  const Bytes message = write_description(robot, kNewestVersion);
  // The robot's struct, its name ("office": length and eight bytes), the sensor's struct.
  const std::size_t sensor = 24 + 16;
  const std::byte none{0};  // a robot's flags are there first: nothing is known of drive and body
  expect_same(read_description(grown(message, 0, 16, none), kNewestVersion), robot);
  expect_same(read_description(grown(message, sensor, 64), kNewestVersion), robot);
  expect_same(read_description(grown(grown(message, sensor, 8), 0, 8, none), kNewestVersion), robot);
  for (const std::uint32_t size : {0u, 8u, 23u, 28u, 0xffff'fff8u}) {
    Bytes lies = message;
    std::memcpy(lies.data(), &size, sizeof size);
    EXPECT_TRUE(hallway::test::error_of([&] { read_description(lies, kNewestVersion); })) << size;
  }
  EXPECT_TRUE(hallway::test::error_of([&] { read_description(message, kFirstVersion); }));
}

TEST(Description, RefusesWhatNoRobotIs) {
  const auto refused = [](const std::function<void(Description&)>& change) {
    Description robot = description(false);
    change(robot);
    const auto error = hallway::test::error_of([&] { write_description(robot, kFirstVersion); });
    return error && error->code() == ErrorCode::kBadInput;
  };
  EXPECT_FALSE(refused([](Description&) {}));
  EXPECT_TRUE(refused([](Description& robot) { robot.period_ns = -1; }));
  EXPECT_TRUE(refused([](Description& robot) { robot.name = std::string(256, 'x'); }));
  EXPECT_TRUE(refused([](Description& robot) { robot.name = "\x1b[31m"; }));
  EXPECT_TRUE(refused([](Description& robot) { robot.name = "\xff"; }));
  EXPECT_TRUE(refused([](Description& robot) { robot.sensors.push_back(robot.sensors.front()); }));
  EXPECT_TRUE(refused([](Description& robot) { robot.sensors[0].T_body_sensor.orientation[0] = 2; }));
  EXPECT_TRUE(refused([](Description& robot) { robot.sensors[0].T_body_sensor.position[0] = kNan; }));
  const auto fill = [](Description& robot, std::size_t n, const std::string& name) {
    robot.sensors.assign(n, robot.sensors.front());
    for (std::size_t i = 0; i < n; ++i) {
      robot.sensors[i].id = static_cast<std::uint32_t>(i);
      robot.sensors[i].name = name;
    }
  };
  EXPECT_FALSE(refused([&](Description& robot) { fill(robot, kMaxSensors, std::string(255, 'x')); }));
  EXPECT_TRUE(refused([&](Description& robot) { fill(robot, kMaxSensors + 1, "x"); }));
}

}  // namespace
}  // namespace hallway::link
