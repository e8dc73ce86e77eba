// SPDX-License-Identifier: MIT
// Samples of which none may be missed, of frames that are dropped. Of the kinds of these tests only the made-up one is such.
#include "host/samples/carried_samples.hpp"

#include <gtest/gtest.h>
#include <hallway/planes.h>

#include <cstring>
#include <deque>
#include <initializer_list>
#include <utility>
#include <vector>

#include "host/samples/frame_builder.hpp"
#include "host/samples/point_kind.hpp"
#include "support/made_up_kind.hpp"

namespace hallway::host {
namespace {

using Bytes = std::vector<std::byte>;
/// Sensor and number.
using Name = std::pair<std::uint32_t, std::uint64_t>;

/// A frame of made-up samples of those names, in their order, each taken at ten times its number and with its number as its temperature; and of a
/// sample of points, by sensor 5, in front of those of higher sensors.
Bytes frame_of(std::uint64_t number, const std::vector<Name>& names) {
  std::deque<test::MadeUp> payloads;
  FrameBuilder builder;
  builder.begin(number, static_cast<std::int64_t>(1000 * number));
  const test::MadeUpRay rays[] = {{0, 1}, {0.5, 2}};
  bool has_points = false;
  const auto see = [&] {
    add_points(builder, 5) = {{double(number), 0, 0}};
    has_points = true;
  };
  for (const auto& [sensor, sequence] : names) {
    if (sensor > 5 && !has_points) see();
    payloads.push_back({.n_rays = 2, .rays = rays, .temperature = double(sequence)});
    const auto t_ns = static_cast<std::int64_t>(10 * sequence);
    builder.add(
        {sizeof(hw_sample_t), test::kMadeUpSample, 0, sensor, sequence, t_ns, t_ns, &payloads.back()});
  }
  if (!has_points) see();
  Bytes bytes;
  FrameWriter().write_over(bytes, builder.finish());
  return bytes;
}

/// The samples of a frame. Each must be whole, and the points those of the frame's own number.
std::vector<Name> names_in(const Bytes& bytes) {
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  EXPECT_EQ(frame.t_ns, static_cast<std::int64_t>(1000 * frame.sequence));
  std::vector<Name> names;
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    const hw_sample_t& sample = *frame.samples[i];
    names.emplace_back(sample.sensor_id, sample.sequence);
    if (sample.kind == test::kMadeUpSample) {
      const auto& made_up = *static_cast<const test::MadeUp*>(sample.payload);
      EXPECT_EQ(made_up.temperature, double(sample.sequence));
      EXPECT_EQ(made_up.n_rays, 2u);
      EXPECT_EQ(static_cast<const test::MadeUpRay*>(made_up.rays)[1].range, 2);
    } else {
      EXPECT_EQ(hw_point_at(static_cast<const hw_points_t*>(sample.payload), 0)->x, double(frame.sequence));
    }
  }
  return names;
}

TEST(CarriedSamples, GoInFrontOfThoseOfTheirSensor) {
  const Bytes dropped = frame_of(0, {{1, 0}, {1, 1}, {7, 0}});
  Bytes next = frame_of(1, {{1, 2}, {7, 1}});
  CarriedSamples carried;
  EXPECT_EQ(carried.carry(dropped, next), 3u);
  const std::vector<Name> expected{{1, 0}, {1, 1}, {1, 2}, {5, 1}, {7, 0}, {7, 1}};
  EXPECT_EQ(names_in(next), expected) << "and no points of the frame that was dropped";
  // That one is dropped too.
  Bytes third = frame_of(2, {{8, 0}});
  EXPECT_EQ(carried.carry(next, third), 5u);
  EXPECT_EQ(names_in(third), (std::vector<Name>{{1, 0}, {1, 1}, {1, 2}, {5, 2}, {7, 0}, {7, 1}, {8, 0}}));
}

TEST(CarriedSamples, AFrameIsAsItWasWhereThereIsNothingToCarry) {
  const Bytes own = frame_of(1, {{1, 2}});
  for (const Bytes& dropped : {frame_of(0, {}), Bytes(), Bytes(100, std::byte{1})}) {
    Bytes next = own;
    EXPECT_EQ(CarriedSamples().carry(dropped, next), 0u);
    EXPECT_EQ(next, own);
  }
  Bytes none(64, std::byte{1});
  EXPECT_EQ(CarriedSamples().carry(own, none), 0u);
  EXPECT_EQ(none, Bytes(64, std::byte{1})) << "no frame takes none";
}

TEST(CarriedSamples, WhatWasFoundInASampleRefersToItStill) {
  const std::vector<hw_point3_t> points{{1, 0, 0}, {1, 1, 0}, {1, 0, 1}};
  hw_points_t cloud{
      sizeof cloud, sizeof(hw_point3_t), 3, points.data(), nullptr, 0, 0, nullptr, nullptr, nullptr, nullptr};
  hw_planes_t planes{};
  planes.size = sizeof planes;
  planes.stride = sizeof(hw_plane_t);
  planes.hull_stride = sizeof(hw_point3_t);
  planes.sample = 0;
  const hw_sample_t of_points{sizeof of_points, HW_SAMPLE_POINTS, 0, 5, 0, 0, 0, &cloud};
  const hw_sample_t of_planes{sizeof of_planes, HW_SAMPLE_PLANES, 0, 5, 0, 0, 0, &planes};
  const hw_sample_t* samples[] = {&of_points, &of_planes};
  Bytes next;
  FrameWriter().write_over(next, {sizeof(hw_frame_t), 2, 1, 1000, samples});
  EXPECT_EQ(CarriedSamples().carry(frame_of(0, {{1, 0}, {2, 0}}), next), 2u);
  FrameReader reader;
  const hw_frame_t& frame = reader.read(next);
  ASSERT_EQ(frame.n_samples, 4u);
  EXPECT_EQ(frame.samples[2]->kind, unsigned{HW_SAMPLE_POINTS});
  EXPECT_EQ(static_cast<const hw_planes_t*>(frame.samples[3]->payload)->sample, 2u);
}

TEST(CarriedSamples, OfTooManyTheOldestAreLeftOut) {
  std::vector<Name> many;
  for (std::uint64_t i = 0; i < CarriedSamples::kMaxSamples; ++i) many.emplace_back(1, i);
  // Two samples are the next frame's own: its points and number 10 000.
  Bytes next = frame_of(1, {{1, CarriedSamples::kMaxSamples}});
  EXPECT_EQ(CarriedSamples().carry(frame_of(0, many), next), CarriedSamples::kMaxSamples - 2);
  const auto names = names_in(next);
  ASSERT_EQ(names.size(), CarriedSamples::kMaxSamples);
  EXPECT_EQ(names.front(), (Name{1, 2}));
  EXPECT_EQ(names.back(), (Name{5, 1}));
}

}  // namespace
}  // namespace hallway::host
