// SPDX-License-Identifier: MIT
// The driver `udp`, by the functions of the ABI, against `hallway serve` and against a base written in C.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/text.hpp"
#include "cli/small_world.hpp"
#include "host/samples/frame_bytes.hpp"
#include "link/udp_wire.hpp"
#include "log/mcap_reader.hpp"
#include "log/run_log.hpp"
#include "support/driver.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kSecond = 1'000'000'000;

std::string bytes_of(const hw_frame_t& frame) {
  std::string bytes;
  host::FrameWriter().write_over(bytes, frame);
  return bytes;
}

/// The frames of a log, as they stand there.
std::vector<std::string> frames_of(const fs::path& file) {
  const std::string content = read_file(file);
  const log::MemoryInput input(content);
  log::McapReader reader(input);
  std::vector<std::string> frames;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message != nullptr && reader.channels().at(message->channel_id).topic == log::topics::kFrame)
      frames.emplace_back(message->data);
  }
  EXPECT_FALSE(reader.damage());
  return frames;
}

/// `hallway serve`, and where it listens.
class Serve {
 public:
  Serve(const std::string& input, std::vector<std::string> more)
      : process_(arguments(input, std::move(more))) {
    for (int i = 0; i < 12000 && address_.empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const std::string printed = process_.err_so_far();
      const std::size_t at = printed.find(" on 127.0.0.1:");
      if (at == std::string::npos || printed.find('\n', at) == std::string::npos) continue;
      address_ = printed.substr(at + 4, printed.find('\n', at) - at - 4);
    }
    EXPECT_NE(address_, "") << "it did not begin to listen within two minutes";
  }
  ~Serve() {
    if (!waited_) {
      ::kill(process_.pid(), SIGKILL);
      process_.wait();
    }
  }
  std::string address() const { return address_; }
  Ended wait() {
    waited_ = true;
    return process_.wait();
  }

 private:
  static std::vector<std::string> arguments(const std::string& input, std::vector<std::string> more) {
    std::vector<std::string> all{hallway_program(), "serve", input, "--udp", "127.0.0.1:0", "--json"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  Process process_;
  std::string address_;
  bool waited_ = false;
};

/// A command that tells which frame it answers.
hw_drive_command_t command_for(std::uint64_t sequence) {
  return {sizeof(hw_drive_command_t), 0, 0.01 * static_cast<double>(sequence), -0.5, 0};
}

void answer(Driver& driver, const hw_frame_t& frame) {
  const hw_drive_command_t command = command_for(frame.sequence);
  const hw_pose_output_t pose{sizeof pose, HW_POSE_VALID, {{1, 2, 3}, {1, 0, 0, 0}}, nullptr, 0};
  hw_answer_t answer{};
  answer.size = sizeof answer;
  answer.status = HW_ANSWER_DONE;
  answer.sequence = frame.sequence;
  answer.t_ns = frame.t_ns;
  answer.command = &command;
  answer.pose = &pose;
  driver.write(answer);
}

/// Answers every frame until the end, `limit` at most. @return their bytes
std::vector<std::string> drive(Driver& driver, std::size_t limit = SIZE_MAX) {
  std::vector<std::string> frames;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(600);
  while (frames.size() < limit && std::chrono::steady_clock::now() < end) {
    const hw_frame_t* frame = nullptr;
    const std::uint32_t found = driver.read(kSecond / 10, &frame);
    if (found == HW_READ_END) return frames;
    if (found == HW_READ_NOTHING) continue;
    frames.push_back(bytes_of(*frame));
    answer(driver, *frame);
  }
  return frames;
}

std::string expected_commands(std::size_t frames) {
  std::string text = "iteration,linear_m_s,angular_rad_s\n";
  for (std::size_t k = 0; k < frames; ++k) {
    const hw_drive_command_t command = command_for(k);
    text += std::to_string(k) + "," + format_double(command.linear_m_s) + "," +
            format_double(command.angular_rad_s) + "\n";
  }
  return text;
}

/// A run of the small world, made once for all tests.
class UdpDriver : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = new SmallWorld;
    const Ended ended = world_->run({"--quiet"});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  static void TearDownTestSuite() {
    delete world_;
    world_ = nullptr;
  }
  static fs::path run_file(const std::string& name) { return fs::path(world_->out()) / name; }

  static SmallWorld* world_;
};

SmallWorld* UdpDriver::world_ = nullptr;

TEST_F(UdpDriver, InLockStepTheFramesAreThoseOfARunAndCommandsComeBack) {
  const std::vector<std::string> expected = frames_of(run_file("run.mcap"));
  ASSERT_EQ(expected.size(), 60u);
  for (const std::string loss : {"0", "0.01", "0.1"}) {
    const std::string out = world_->out("served" + loss);
    Serve serve(world_->scenario(), {"--lockstep", "--loss", loss, "--out", out});
    Driver driver(DRIVER);
    ASSERT_EQ(
        driver.open({{"address", serve.address()}, {"lockstep", "true"}, {"loss", loss}, {"seed", "7"}}),
        HW_OK)
        << driver.message();
    const hw_robot_info_t* robot = driver.describe();
    ASSERT_NE(robot, nullptr) << driver.message();
    EXPECT_EQ(robot->flags, HW_ROBOT_LOCK_STEP);
    EXPECT_STREQ(robot->name, "small");
    EXPECT_EQ(robot->period_ns, kSecond / 10);
    ASSERT_EQ(robot->n_sensors, 1u);
    EXPECT_STREQ(robot->sensors[0]->name, "eyes");
    EXPECT_EQ(robot->sensors[0]->max_range_m, 60);
    EXPECT_TRUE(drive(driver) == expected) << loss;
    EXPECT_EQ(driver.counter("frames_received"), 60);
    EXPECT_EQ(driver.counter("protocol_version"), 2);
    EXPECT_EQ(driver.counter("frames_lost"), 0);
    driver.close();
    const Ended ended = serve.wait();
    ASSERT_EQ(ended.status, 0) << ended.err;
    const Json document = Json::parse(ended.out);
    EXPECT_EQ(document.at("address"), serve.address());
    EXPECT_EQ(document.at("serving").at("end"), "all_sent");
    EXPECT_EQ(document.at("serving").at("answered"), 60);
    EXPECT_EQ(document.at("serving").at("commands"), 60);
    EXPECT_GT(document.at("serving").at("round_trip_ms").at("p50"), 0.0);
    // Without loss, too, a datagram is sent again where an answer takes long, as on a loaded machine.
    if (loss != "0") {
      EXPECT_GT(document.at("serving").at("datagrams_resent"), 0) << loss;
    }

    EXPECT_EQ(read_file(fs::path(out) / "commands.csv"), expected_commands(60));
    EXPECT_TRUE(frames_of(fs::path(out) / "run.mcap") == expected);
    for (const char* name :
         {"truth.tum", "truth_poses.csv", "truth_landmarks.csv", "scenario.toml", "map.map"})
      EXPECT_TRUE(read_file(fs::path(out) / name) == read_file(run_file(name))) << name;
    const Json manifest = Json::parse(read_file(fs::path(out) / "run.json"));
    EXPECT_EQ(manifest.at("command"), "serve");
    EXPECT_EQ(manifest.at("iterations"), 60);
    EXPECT_EQ(manifest.at("stopped_early"), false);
  }
  EXPECT_TRUE(read_file(fs::path(world_->out("served0")) / "run.mcap") ==
              read_file(fs::path(world_->out("served0.1")) / "run.mcap"))
      << "what was lost on the way leaves no trace";
}

TEST_F(UdpDriver, ALogIsARobotToo) {
  Serve serve(run_file("run.mcap"), {"--lockstep", "--steps", "25"});
  Driver driver(DRIVER);
  ASSERT_EQ(driver.open({{"address", serve.address()}, {"protocol", "1"}}), HW_OK) << driver.message();
  ASSERT_NE(driver.describe(), nullptr) << driver.message();
  EXPECT_EQ(driver.counter("protocol_version"), 1) << "all that this host offers";
  std::vector<std::string> expected = frames_of(run_file("run.mcap"));
  expected.resize(25);
  EXPECT_TRUE(drive(driver) == expected);
  EXPECT_EQ(serve.wait().status, 0);
}

TEST_F(UdpDriver, InRealTimeFramesComeInOrderAndLossIsCounted) {
  const std::string out = world_->out("real-time");
  Serve serve(world_->scenario(), {"--rate", "10", "--loss", "0.2", "--loss-seed", "3", "--out", out});
  Driver driver(DRIVER);
  ASSERT_EQ(driver.open({{"address", serve.address()}, {"lockstep", "false"}}), HW_OK) << driver.message();
  const hw_robot_info_t* robot = driver.describe();
  ASSERT_NE(robot, nullptr) << driver.message();
  EXPECT_EQ(robot->flags, 0u);
  const std::vector<std::string> all = frames_of(run_file("run.mcap"));
  const std::vector<std::string> given = drive(driver);
  auto at = all.begin();
  for (const std::string& frame : given) {
    at = std::find(at, all.end(), frame);
    ASSERT_NE(at, all.end()) << "a frame that was not sent, or out of order";
    ++at;
  }
  EXPECT_GT(given.size(), 0u);
  EXPECT_GT(driver.counter("frames_received"), 10);
  EXPECT_LT(given.size(), 60u);
  EXPECT_GT(driver.counter("frames_lost"), 0);
  EXPECT_EQ(driver.counter("frames_received") - driver.counter("frames_skipped"),
            static_cast<double>(given.size()));
  const Ended ended = serve.wait();
  EXPECT_EQ(ended.status, 0) << ended.err;
  const Json serving = Json::parse(ended.out).at("serving");
  EXPECT_EQ(serving.at("frames"), 60);
  EXPECT_EQ(serving.at("datagrams_resent"), 0);
  EXPECT_LE(serving.at("answered"), given.size());
  EXPECT_TRUE(frames_of(fs::path(out) / "run.mcap") == all) << "what was sent, whatever came";
  EXPECT_EQ(hallway({"replay", fs::path(out) / "run.mcap", "--plugin", "slam_point", "--quiet", "--out",
                     world_->out("replayed")})
                .status,
            0);
}

TEST_F(UdpDriver, AProgramThatLeavesEndsTheServingInGoodOrder) {
  const std::string out = world_->out("left");
  Serve serve(world_->scenario(), {"--lockstep", "--out", out});
  Driver driver(DRIVER);
  ASSERT_EQ(driver.open({{"address", serve.address()}}), HW_OK);
  ASSERT_NE(driver.describe(), nullptr);
  EXPECT_EQ(drive(driver, 7).size(), 7u);
  driver.close();
  const Ended ended = serve.wait();
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(Json::parse(ended.out).at("serving").at("end"), "left");
  EXPECT_EQ(read_file(fs::path(out) / "commands.csv"), expected_commands(7));
  EXPECT_EQ(Json::parse(read_file(fs::path(out) / "run.json")).at("stopped_early"), true);
}

TEST_F(UdpDriver, ARobotOfTheOtherKindIsRefused) {
  Serve serve(world_->scenario(), {"--lockstep"});
  Driver driver(DRIVER);
  ASSERT_EQ(driver.open({{"address", serve.address()}, {"lockstep", "false"}}), HW_OK);
  EXPECT_EQ(driver.describe(), nullptr);
  EXPECT_NE(driver.message().find("lockstep = false"), std::string::npos) << driver.message();
  driver.close();
  EXPECT_EQ(Json::parse(serve.wait().out).at("serving").at("frames"), 0);
}

TEST_F(UdpDriver, ARobotThatDiesIsToldAndNobodyWaitsForEver) {
  std::optional<Serve> serve(std::in_place, world_->scenario(), std::vector<std::string>{"--lockstep"});
  Driver driver(DRIVER);
  ASSERT_EQ(driver.open({{"address", serve->address()}, {"give_up_s", "3"}}), HW_OK);
  ASSERT_NE(driver.describe(), nullptr);
  EXPECT_EQ(drive(driver, 3).size(), 3u);
  serve.reset();
  try {
    drive(driver);
    FAIL() << "it was not told";
  } catch (const std::exception& failure) {
    EXPECT_NE(std::string(failure.what()).find("nothing was heard from the robot"), std::string::npos)
        << failure.what();
  }
}

TEST(UdpDriverSettings, WhatIsWrongIsSaid) {
  Driver driver(DRIVER);
  EXPECT_STREQ(driver.info().id, "udp");
  const std::pair<std::string, std::string> address{"address", "127.0.0.1:7"};
  const std::vector<std::pair<std::vector<std::pair<std::string, std::string>>, std::string>> cases{
      {{}, "\"address\" is missing"},
      {{{"address", "localhost:7000"}}, "names are not looked up"},
      {{{"address", "127.0.0.1:0"}}, "with a port"},
      {{address, {"adress", "x"}}, "there is no setting \"adress\""},
      {{address, {"bind", "[::1]:0"}}, "of the same kind"},
      {{address, {"bind", "127.0.0.1"}}, "is no address"},
      {{address, {"bind", "203.0.113.1:0"}}, "cannot listen"},
      {{address, {"lockstep", "yes"}}, "true or false"},
      {{address, {"loss", "1.5"}}, "from 0 to 1"},
      {{address, {"loss", "nan"}}, "from 0 to 1"},
      {{address, {"seed", "-1"}}, "whole number"},
      {{address, {"protocol", "3"}}, "1 or 2"},
      {{address, {"protocol", "two"}}, "1 or 2"},
      {{address, {"give_up_s", "-1"}}, "seconds"},
  };
  for (const auto& [settings, part] : cases) {
    EXPECT_NE(driver.open(settings), HW_OK) << part;
    EXPECT_NE(driver.message().find(part), std::string::npos) << driver.message();
  }
  ASSERT_EQ(driver.open({address, {"give_up_s", "0.2"}}), HW_OK) << driver.message();
  EXPECT_EQ(driver.describe(), nullptr);
  EXPECT_NE(driver.message().find("nothing was heard from the robot at 127.0.0.1:7 for 0.2 s"),
            std::string::npos)
      << driver.message();
}

TEST(UdpBase, SpeaksTheProtocolInPlainC) {
  std::string port;
  {
    const link::UdpWire free(link::parse_address("127.0.0.1:0"));
    port = std::to_string(free.address().port);
  }
  Process base({BASE, port});
  Driver driver(DRIVER);
  ASSERT_EQ(driver.open({{"address", "127.0.0.1:" + port}, {"give_up_s", "30"}}), HW_OK) << driver.message();
  const hw_robot_info_t* robot = driver.describe();
  ASSERT_NE(robot, nullptr) << driver.message();
  EXPECT_STREQ(robot->name, "base");
  ASSERT_EQ(robot->n_sensors, 1u);
  EXPECT_STREQ(robot->sensors[0]->name, "eyes");
  EXPECT_EQ(robot->sensors[0]->kind, unsigned{HW_SAMPLE_POINTS});
  EXPECT_EQ(robot->sensors[0]->T_body_sensor.position[2], 0.5);
  EXPECT_TRUE(std::isnan(robot->sensors[0]->max_range_m));
  const hw_frame_t* frame = nullptr;
  ASSERT_EQ(driver.read(30 * kSecond, &frame), unsigned{HW_READ_FRAME});
  ASSERT_EQ(frame->n_samples, 1u);
  EXPECT_EQ(driver.counter("protocol_version"), 1);
  const auto& points = *static_cast<const hw_points_t*>(frame->samples[0]->payload);
  ASSERT_EQ(points.count, 2u);
  EXPECT_EQ(hw_point_at(&points, 1)->y, -1.0);
  const hw_drive_command_t command{sizeof command, 0, 0.25, -0.5, 0};
  hw_answer_t answer{};
  answer.size = sizeof answer;
  answer.sequence = frame->sequence;
  answer.command = &command;
  driver.write(answer);
  EXPECT_EQ(drive(driver).size(), 0u) << "it says bye";
  const Ended ended = base.wait();
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.out, "0.25 m/s, -0.5 rad/s\n");
}

}  // namespace
}  // namespace hallway::test
