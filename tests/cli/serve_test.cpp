// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/small_world.hpp"
#include "link/datagram.hpp"
#include "link/udp_wire.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// Starts `hallway serve` and waits until it listens. @return its address, empty if it ended before
std::string address_of(const Process& process) {
  for (int i = 0; i < 12000; ++i) {
    std::this_thread::sleep_for(milliseconds(10));
    const std::string printed = process.err_so_far();
    const std::size_t at = printed.find(" on 127.0.0.1:");
    if (at != std::string::npos && printed.find('\n', at) != std::string::npos)
      return printed.substr(at + 4, printed.find('\n', at) - at - 4);
  }
  return {};
}

/// Says hello as a host that is ready for frames, and waits for the first frame.
void say_hello(link::UdpWire& wire, const std::string& address) {
  link::Bytes hello;
  link::write_datagram({.type = link::Type::kHello, .flags = link::kReady, .sequence = 5}, {}, hello);
  wire.send(hello, link::parse_address(address));
  std::array<std::byte, 2048> room{};
  link::Address from;
  for (int i = 0; i < 200; ++i) {
    const auto bytes = wire.receive(room, from, milliseconds(100));
    if (!bytes) continue;
    const auto read = link::read_datagram(std::span(room).first(*bytes));
    if (std::get<link::Datagram>(read).header.type == link::Type::kFrame) return;
  }
  FAIL() << "no frame came";
}

TEST(Serve, WrongUseIsTold) {
  const SmallWorld world;
  const auto told = [&](const std::vector<std::string>& more, int status, const std::string& part) {
    std::vector<std::string> arguments{"serve", world.scenario()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = hallway(arguments);
    EXPECT_EQ(ended.status, status) << ended.err;
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
  };
  told({}, 2, "--udp");
  told({"--udp", "7000"}, 2, "IP:PORT");
  told({"--udp", "localhost:7000"}, 2, "names are not looked up");
  told({"--udp", "127.0.0.1:0", "--lockstep", "--rate", "2"}, 2, "excludes");
  told({"--udp", "127.0.0.1:0", "--loss", "2"}, 2, "--loss");
  told({"--udp", "127.0.0.1:0", "--set", "sedd=3"}, 2, "sedd");
  told({"--udp", "203.0.113.1:0"}, 3, "203.0.113.1:0: cannot listen");
  const link::UdpWire taken(link::parse_address("127.0.0.1:0"));
  told({"--udp", link::print_address(taken.address())}, 3, link::print_address(taken.address()));
  const std::string there = world.folder().write("there", "mine");
  told({"--udp", "127.0.0.1:0", "--out", there}, 3, "there");
  EXPECT_EQ(read_file(there), "mine");
  const std::string csv = world.folder().write("log.csv", "iteration,x,y,z\n0,1,2,3\n");
  EXPECT_EQ(hallway({"serve", csv, "--udp", "127.0.0.1:0", "--seed", "3"}).status, 2);
  EXPECT_EQ(hallway({"serve", world.folder() / "no.mcap", "--udp", "127.0.0.1:0"}).status, 3);
}

TEST(Serve, CtrlCEndsItWhileItWaits) {
  const SmallWorld world;
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process({hallway_program(), "serve", world.scenario(), "--udp", "127.0.0.1:0", "--out",
                     world.out(), "--force"});
    EXPECT_NE(address_of(process), "");
    ::kill(process.pid(), signal);
    EXPECT_EQ(process.wait().status, 128 + signal);
    EXPECT_EQ(nlohmann::ordered_json::parse(read_file(fs::path(world.out()) / "run.json")).at("iterations"),
              0);
  }
}

TEST(Serve, CtrlCEndsItWhileItWaitsForAnAnswer) {
  const SmallWorld world;
  Process process({hallway_program(), "serve", world.scenario(), "--udp", "127.0.0.1:0", "--lockstep",
                   "--out", world.out()});
  link::UdpWire wire(link::parse_address("127.0.0.1:0"));
  say_hello(wire, address_of(process));
  ::kill(process.pid(), SIGINT);
  EXPECT_EQ(process.wait().status, 130);
  const auto manifest = nlohmann::ordered_json::parse(read_file(fs::path(world.out()) / "run.json"));
  EXPECT_EQ(manifest.at("iterations"), 1);
  EXPECT_EQ(manifest.at("stopped_early"), true);
  EXPECT_FALSE(fs::exists(fs::path(world.out()) / "commands.csv")) << "there was none";
}

TEST(Serve, AHostThatFallsSilentIsGivenUp) {
  const SmallWorld world;
  for (const std::string mode : {"--lockstep", "--strict"}) {
    Process process(
        {hallway_program(), "serve", world.scenario(), "--udp", "127.0.0.1:0", "--give-up", "0.3", mode});
    link::UdpWire wire(link::parse_address("127.0.0.1:0"));
    say_hello(wire, address_of(process));
    const Ended ended = process.wait();
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_NE(ended.out.find("nothing was heard from the robot program for 0.3 s"), std::string::npos)
        << ended.out;
  }
}

}  // namespace
}  // namespace hallway::test
