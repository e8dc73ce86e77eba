// SPDX-License-Identifier: MIT
// The driver `udp`: a robot at the other end of the datagram protocol of docs/formats.md. What travels is engine/link's; this
// file turns it into the contract of <hallway/driver.h>.
#include <hallway/driver.hpp>

#include <array>
#include <memory>
#include <optional>
#include <random>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/c_activation.hpp"
#include "link/host_end.hpp"
#include "link/lossy_wire.hpp"
#include "link/udp_wire.hpp"

namespace {

namespace link_ = hallway::link;
namespace sdk = hallway::sdk;
using hallway::Error;
using hallway::ErrorCode;

constexpr double kGiveUpSeconds = 10;
constexpr double kMaxGiveUpSeconds = 1e6;

/// The settings, read and checked.
struct Settings {
  link_::Address robot;
  link_::Address bind;
  std::optional<bool> lock_step;
  std::uint8_t protocol = link_::kNewestVersion;
  double loss = 0;
  std::uint64_t seed = 1;
  std::chrono::milliseconds give_up{0};
};

[[noreturn]] void bad(const char* key, const std::string& value, const char* expected) {
  throw sdk::Failure(HW_ERROR_RANGE,
                     std::string(key) + " = \"" + hallway::printable(value) + "\": it is " + expected);
}

double number(const sdk::DriverSettings& settings, const char* key, double otherwise, double most,
              const char* expected) {
  const std::string text = settings.text(key);
  if (text.empty()) return otherwise;
  const auto value = hallway::parse_double(text);
  if (!value || *value < 0 || *value > most) bad(key, text, expected);
  return *value;
}

std::optional<bool> truth(const sdk::DriverSettings& settings, const char* key) {
  const std::string text = settings.text(key);
  if (text.empty()) return std::nullopt;
  if (text != "true" && text != "false") bad(key, text, "true or false");
  return text == "true";
}

std::uint8_t protocol_of(const sdk::DriverSettings& settings) {
  const std::string text = settings.text("protocol");
  if (text.empty()) return link_::kNewestVersion;
  const auto value = hallway::parse_uint(text);
  if (!value || *value < link_::kFirstVersion || *value > link_::kNewestVersion)
    bad("protocol", text, "1 or 2");
  return static_cast<std::uint8_t>(*value);
}

std::uint64_t seed_of(const sdk::DriverSettings& settings) {
  const std::string text = settings.text("seed", "1");
  const auto value = hallway::parse_uint(text);
  if (!value) bad("seed", text, "a whole number from 0");
  return *value;
}

Settings read_settings(const sdk::DriverSettings& settings) {
  settings.expect_only({"address", "bind", "lockstep", "protocol", "loss", "seed", "give_up_s"});
  const std::string address = settings.text("address");
  if (address.empty()) throw sdk::Failure(HW_ERROR_ARGUMENT, "the setting \"address\" is missing");
  Settings read;
  read.robot = link_::parse_address(address);
  if (read.robot.port == 0) bad("address", address, "IP:PORT of the robot, with a port");
  const std::string bind = settings.text("bind");
  read.bind = bind.empty() ? link_::local_address_towards(read.robot) : link_::parse_address(bind);
  if (read.bind.v6 != read.robot.v6) bad("bind", bind, "of the same kind as \"address\", IPv4 or IPv6");
  read.lock_step = truth(settings, "lockstep");
  read.protocol = protocol_of(settings);
  read.loss = number(settings, "loss", 0, 1, "a share from 0 to 1");
  read.seed = seed_of(settings);
  read.give_up = std::chrono::milliseconds(
      static_cast<std::int64_t>(1000 * number(settings, "give_up_s", kGiveUpSeconds, kMaxGiveUpSeconds,
                                              "a number of seconds from 0 (never) to 1e6")));
  return read;
}

/// Calls `work` and gives what it throws the status of its kind.
template <typename Work>
decltype(auto) translated(Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    hw_status_t status = HW_ERROR_INTERNAL;
    if (error.code() == ErrorCode::kUsage) status = HW_ERROR_ARGUMENT;
    if (error.code() == ErrorCode::kBadInput) status = HW_ERROR_DATA;
    if (error.code() == ErrorCode::kIo) status = HW_ERROR_IO;
    throw sdk::Failure(status, error.what());
  }
}

/// A robot's description in the form of the ABI. Its name stands in the description.
class RobotInfo {
 public:
  explicit RobotInfo(const link_::Description& description)
      : facts_({description.sensors, description.drive, description.body}) {
    info_.size = sizeof info_;
    info_.flags = description.lock_step ? HW_ROBOT_LOCK_STEP : 0;
    info_.name = description.name.c_str();
    info_.period_ns = description.period_ns;
    facts_.fill(info_);
  }
  RobotInfo(const RobotInfo&) = delete;
  RobotInfo& operator=(const RobotInfo&) = delete;

  const hw_robot_info_t& info() const { return info_; }

 private:
  hallway::host::CActivation facts_;
  hw_robot_info_t info_{};
};

/// Numbers worth watching, in the form of the ABI.
class Counters {
 public:
  const hw_counters_t& fill(const link_::HostCounters& counters, std::uint64_t bad_frames,
                            std::uint8_t version) {
    const link_::FrameCounters& frames = counters.frames;
    const auto as_double = [](std::uint64_t count) { return static_cast<double>(count); };
    list_ = {{{"protocol_version", as_double(version)},
              {"frames_received", as_double(frames.frames)},
              {"frames_lost", as_double(frames.lost)},
              {"frames_incomplete", as_double(frames.incomplete)},
              {"frames_skipped", as_double(frames.skipped)},
              {"frames_bad", as_double(bad_frames)},
              {"datagrams_received", as_double(counters.datagrams)},
              {"datagrams_late", as_double(frames.late)},
              {"datagrams_duplicate", as_double(frames.duplicates)},
              {"datagrams_misfit", as_double(frames.misfits)},
              {"datagrams_malformed", as_double(counters.malformed)},
              {"datagrams_of_other_version", as_double(counters.other_version)},
              {"datagrams_foreign", as_double(counters.foreign)}}};
    counters_.size = sizeof counters_;
    counters_.stride = sizeof(hw_counter_t);
    counters_.count = list_.size();
    counters_.counters = list_.data();
    return counters_;
  }

 private:
  std::array<hw_counter_t, 13> list_{};
  hw_counters_t counters_{};
};

link_::Answer answer_of(const hw_answer_t& from) {
  link_::Answer answer{.status = from.status, .sequence = from.sequence, .t_ns = from.t_ns};
  if (from.command != nullptr)
    answer.command = {from.command->linear_m_s, from.command->angular_rad_s, hw_lateral_m_s(from.command)};
  if (from.pose != nullptr) {
    answer.pose.emplace();
    answer.pose->valid = from.pose->status == HW_POSE_VALID;
    if (answer.pose->valid) {
      answer.pose->T_map_body = from.pose->T_map_body;
      answer.pose->t_ns = hw_pose_time_ns(from.pose);
    }
  }
  return answer;
}

class Udp final : public sdk::Driver {
 public:
  static const hw_driver_info_t* info() {
    static constexpr hw_driver_info_t kInfo = sdk::driver_info(
        "udp", "Datagrams", "0.1.0", "Hallway",
        "A robot, a microcontroller or a simulator, over a datagram protocol.",
        "address    IP:PORT of the robot\n"
        "bind       IP:PORT to listen to [the address that leads to the robot, any free port]\n"
        "lockstep   true or false: refuse a robot that does otherwise [as the robot says]\n"
        "protocol   the newest version of the protocol to offer, 1 or 2 [2]\n"
        "loss       share of datagrams to drop, 0 to 1 [0]\n"
        "seed       of which datagrams are dropped [1]\n"
        "give_up_s  seconds of silence after which the robot counts as gone; 0: never [10]\n");
    return &kInfo;
  }

  explicit Udp(const hw_host_t* host) : Driver(host) {}
  ~Udp() override { close(); }

  void open(const sdk::DriverSettings& settings) override {
    translated([&] {
      const Settings read = read_settings(settings);
      lock_step_ = read.lock_step;
      socket_.emplace(read.bind);
      link_::Wire* wire = &*socket_;
      if (read.loss > 0) wire = &lossy_.emplace(*socket_, read.loss, read.seed);
      std::random_device random;
      const std::uint64_t nonce = std::uint64_t{random()} << 32 | random();
      end_.emplace(*wire, read.robot, nonce, read.give_up, read.protocol);
    });
  }

  const hw_robot_info_t& describe() override {
    if (!robot_) {
      const link_::Description& description =
          translated([&]() -> const link_::Description& { return end_->describe(); });
      if (lock_step_ && *lock_step_ != description.lock_step) {
        throw sdk::Failure(HW_ERROR_UNSUPPORTED, description.lock_step
                                                     ? "the robot works in lock-step, and lockstep = false"
                                                     : "the robot works in real time, and lockstep = true");
      }
      robot_ = std::make_unique<RobotInfo>(description);
    }
    return robot_->info();
  }

  Reading read(std::int64_t wait_ns) override {
    return translated([&]() -> Reading {
      const auto reading = end_->read(std::chrono::nanoseconds(wait_ns));
      if (reading.found == link_::HostEnd::Found::kFrame) return {HW_READ_FRAME, reading.frame};
      return {reading.found == link_::HostEnd::Found::kEnd ? HW_READ_END : HW_READ_NOTHING, nullptr};
    });
  }

  void write(const hw_answer_t& answer) override {
    translated([&] { end_->answer(answer_of(answer)); });
  }

  const hw_counters_t* counters() override {
    return &counters_.fill(end_->counters(), end_->bad_frames(), end_->version());
  }

  void close() override {
    if (end_) end_->leave();
    end_.reset();
    lossy_.reset();
    socket_.reset();
    robot_.reset();
  }

 private:
  std::optional<bool> lock_step_;
  std::optional<link_::UdpWire> socket_;
  std::optional<link_::LossyWire> lossy_;
  std::optional<link_::HostEnd> end_;
  std::unique_ptr<RobotInfo> robot_;
  Counters counters_;
};

}  // namespace

HALLWAY_DRIVER(Udp);
