// SPDX-License-Identifier: MIT
#include "watch/past.hpp"

#include <gtest/gtest.h>
#include <hallway/ext/log.h>

#include <memory>
#include <numbers>

#include "geom/arrays.hpp"
#include "watch/line_mode.hpp"

namespace hallway::watch {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Pose turned(double yaw, const Vec3& place) {
  return {from_yaw_pitch_roll(yaw, 0.0, 0.0), place};
}

Moment moment_of(std::uint32_t iteration, const Pose& T_world_body) {
  Moment moment{.iteration = iteration, .t_ns = iteration * kSecond / 2, .T_world_body = T_world_body};
  return moment;
}

void believe(Moment& moment, const Pose& T_map_body, std::optional<std::uint64_t> epoch = {}) {
  moment.pose = log::PoseAnswer{.valid = true,
                                .position_m = to_array(T_map_body.t),
                                .orientation = to_array(T_map_body.q),
                                .map_epoch = epoch};
}

TEST(Past, PlacesAMapByItsFirstPose) {
  // The map's frame is turned and moved; the plugin makes no error.
  const Pose T_world_map = turned(0.7, Vec3(3.0, -2.0, 0.5));
  Past past;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const Pose truth = turned(0.2 * i, Vec3(1.0 * i, 0.3 * i, 0.0));
    Moment moment = moment_of(i, truth);
    believe(moment, T_world_map.inverse() * truth);
    past.add(moment);
    EXPECT_TRUE(past.place(i)->estimate->t.isApprox(truth.t, 1e-9) || truth.t.isZero());
    EXPECT_NEAR(angle_between(past.place(i)->estimate->q, truth.q), 0.0, 1e-6);
  }
}

TEST(Past, PlacesEachPartOfAMapAnew) {
  Past past;
  Moment first = moment_of(0, turned(0.0, Vec3(0, 0, 0)));
  believe(first, turned(0.0, Vec3(9, 9, 0)), 1);
  past.add(first);
  Moment second = moment_of(1, turned(0.0, Vec3(1, 0, 0)));
  believe(second, turned(0.0, Vec3(0, 0, 0)), 2);
  past.add(second);
  EXPECT_TRUE(past.place(1)->estimate->t.isApprox(Vec3(1, 0, 0)));
}

TEST(Past, LostPluginHasNoEstimate) {
  Past past;
  Moment moment = moment_of(0, Pose());
  moment.pose = log::PoseAnswer{.valid = false};
  past.add(moment);
  EXPECT_FALSE(past.place(0)->estimate);
}

TEST(Past, WithoutTruthTheMapIsTheWorld) {
  Past past;
  Moment moment{.iteration = 4};
  believe(moment, turned(0.0, Vec3(2, 3, 0)));
  past.add(moment);
  EXPECT_TRUE(pose_shown(moment, past.place(4))->t.isApprox(Vec3(2, 3, 0)));
}

TEST(Past, KnowsEachMomentsPast) {
  Past past;
  for (std::uint32_t i = 0; i < 10; ++i) {
    Moment moment = moment_of(2 * i, turned(0.0, Vec3(i, 0, 0)));
    moment.contacts.push_back({.t_ns = moment.t_ns, .kind = "wall"});
    past.add(moment);
    past.add(moment);  // shown again
  }
  EXPECT_EQ(past.places(18).size(), 10u);
  EXPECT_EQ(past.places(7).size(), 4u);
  EXPECT_EQ(past.contacts(3 * kSecond).size(), 4u);
  EXPECT_EQ(past.lines(3 * kSecond).size(), 4u);
  EXPECT_EQ(past.place(3), nullptr);
}

TEST(Past, ManyLinesLeaveTheLastOnes) {
  Past past;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    Moment moment{.iteration = i, .t_ns = i};
    moment.lines.push_back({HW_LOG_INFO, "p", std::to_string(i)});
    past.add(moment);
  }
  const auto lines = past.lines(10'000);
  EXPECT_EQ(lines.size(), Past::kMaxLines);
  EXPECT_EQ(lines.back().text, "p: 4999");
}

TEST(Past, EchoesOfSingleRaysStayForAWhile) {
  Past past;
  for (std::uint32_t i = 0; i < 10; ++i) {  // each half second
    Moment moment = moment_of(i, turned(std::numbers::pi / 2, Vec3(1.0 * i, 0.0, 0.0)));
    moment.rays = {{Vec3::Zero(), Vec3(2.0, 0.0, 0.0), true}, {Vec3::Zero(), Vec3(9.0, 0.0, 0.0), false}};
    if (i == 4) moment.rays.resize(Past::kMostRays + 1, moment.rays.front());
    past.add(moment);
  }
  const auto echoes = past.echoes(kSecond, 3 * kSecond);
  ASSERT_EQ(echoes.size(), 4u) << "frames 2, 3, 5, 6; the scan of frame 4 has many rays";
  EXPECT_TRUE(echoes.front().place.isApprox(Vec2(2.0, 2.0)));
  EXPECT_EQ(echoes.back().t_ns, 3 * kSecond);
}

TEST(Past, TextFromOutsideIsSafe) {
  Moment moment;
  moment.lines.push_back({HW_LOG_INFO, "p", "\x1b[2Jgone"});
  EXPECT_EQ(lines_of(moment).at(0).text.find('\x1b'), std::string::npos);
}

TEST(LineMode, StateOncePerSecondAndEventsAtOnce) {
  LineMode mode(1.0);
  std::string text;
  for (std::uint32_t i = 0; i < 20; ++i) {  // each half second
    Moment moment = moment_of(i, turned(std::numbers::pi / 2, Vec3(1.0 * i, 2.0, 0.0)));
    if (i == 3) moment.contacts.push_back({.t_ns = 1'400'000'000, .kind = "wall", .position_m = {1, 2, 0}});
    if (i == 5) moment.lines.push_back({HW_LOG_INFO, "mapper", "loop closed"});
    text += mode.add(moment);
  }
  std::size_t states = 0;
  for (std::size_t at = text.find("frame"); at != std::string::npos; at = text.find("frame", at + 1))
    ++states;
  EXPECT_EQ(states, 10u);
  EXPECT_NE(text.find("1.40 s  contact: wall at (1.00, 2.00)"), std::string::npos) << text;
  EXPECT_NE(text.find("2.50 s  mapper: loop closed\n"), std::string::npos) << text;
  EXPECT_NE(text.find("1.00 s  frame 2  at (2.00, 2.00) 90 deg\n"), std::string::npos) << text;
}

TEST(LineMode, SaysErrorAndCommand) {
  LineMode mode(1.0);
  Moment moment = moment_of(0, Pose());
  believe(moment, Pose());
  moment.obeyed =
      log::ObeyedCommand{.linear_m_s = 0.3, .angular_rad_s = -0.1, .cause = log::CommandCause::kPlugin};
  EXPECT_EQ(mode.add(moment),
            "0.00 s  frame 0  at (0.00, 0.00) 0 deg  off by 0.000 m  0.30 m/s -0.10 rad/s (plugin)\n");
}

TEST(LineMode, SaysChartAndWhatThePluginWrites) {
  LineMode mode(1.0);
  Moment moment{.iteration = 0};
  moment.topology = std::make_shared<const log::Topology>(log::Topology{.nodes = {{.id = 4}}});
  moment.drawing = {{.kind = log::DrawingKind::kText, .points_m = {{0, 0}}, .text = "follow"}};
  EXPECT_EQ(mode.add(moment), "0.00 s  frame 0  1 node, loop open  follow\n");
}

}  // namespace
}  // namespace hallway::watch
