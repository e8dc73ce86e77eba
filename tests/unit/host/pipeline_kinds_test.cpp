// SPDX-License-Identifier: MIT
#include "host/pipeline_kinds.hpp"

#include <gtest/gtest.h>
#include <hallway/output.h>

#include <algorithm>
#include <random>
#include <vector>

#include "fixtures.hpp"
#include "host/output/output_kind.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using test_fixtures::point_sensors;
using Kinds = std::vector<std::uint32_t>;

PluginInfo plugin(const std::string& id, const Kinds& inputs, const Kinds& outputs) {
  PluginInfo info;
  info.id = id;
  info.inputs = inputs;
  info.outputs = outputs;
  return info;
}

const PluginInfo kPlanesOfPoints = plugin("finds_planes", {HW_SAMPLE_POINTS}, {HW_OUTPUT_PLANES});
const PluginInfo kSegmentsOfPlanes = plugin("cuts_planes", {HW_SAMPLE_PLANES}, {HW_OUTPUT_SEGMENTS});
const PluginInfo kPlanesOfSegments = plugin("joins_segments", {HW_SAMPLE_SEGMENTS}, {HW_OUTPUT_PLANES});
const PluginInfo kMapsSegments = plugin("maps", {HW_SAMPLE_SEGMENTS, HW_SAMPLE_POINTS}, {HW_OUTPUT_POSE});

/// What is said of a pipeline behind a sensor of points; empty: nothing.
std::string said(const std::vector<PluginInfo>& plugins) {
  const auto error = test::error_of([&] { check_kinds(plugins, point_sensors()); });
  if (error) {
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  }
  return error ? error->message() : "";
}

TEST(PipelineKinds, EachHasItsProducersBeforeIt) {
  EXPECT_EQ(said({kPlanesOfPoints}), "");
  EXPECT_EQ(said({kPlanesOfPoints, kSegmentsOfPlanes, kMapsSegments}), "");
  EXPECT_EQ(said({kPlanesOfPoints, kSegmentsOfPlanes, kPlanesOfSegments}), "") << "planes were there before";
}

TEST(PipelineKinds, NobodyGivesIt) {
  EXPECT_EQ(said({kMapsSegments}),
            "plugin `maps` needs segments, which no sensor gives; the sensors give: points");
  EXPECT_EQ(said({kPlanesOfPoints, kMapsSegments}),
            "plugin `maps` needs segments, which no sensor gives; the sensors give: points; the plugins "
            "give: planes");
}

TEST(PipelineKinds, WhatIsOptionalNeedsNoProducer) {
  PluginInfo maps = kPlanesOfPoints;
  maps.optional_inputs = {HW_SAMPLE_SEGMENTS};
  EXPECT_EQ(said({maps}), "");
  maps.inputs.clear();
  EXPECT_EQ(said({maps}), "");
}

TEST(PipelineKinds, TheOrderIsWrong) {
  EXPECT_EQ(
      said({kSegmentsOfPlanes, kPlanesOfPoints}),
      "plugin `cuts_planes` needs planes, which `finds_planes` gives, but that stands behind it; this order "
      "would do: `finds_planes`, `cuts_planes`");
  EXPECT_NE(said({kMapsSegments, kSegmentsOfPlanes, kPlanesOfPoints})
                .find("would do: `finds_planes`, `cuts_planes`, `maps`"),
            std::string::npos);
}

TEST(PipelineKinds, ACircle) {
  EXPECT_EQ(
      said({kSegmentsOfPlanes, kPlanesOfSegments}),
      "the plugins need each other in a circle: `cuts_planes` needs planes, which `joins_segments` gives; "
      "`joins_segments` needs segments, which `cuts_planes` gives");
  EXPECT_EQ(said({kMapsSegments, kSegmentsOfPlanes, kPlanesOfSegments}).find("`maps`"), std::string::npos)
      << "it only waits for the circle";
  EXPECT_EQ(said({plugin("eats_its_tail", {HW_SAMPLE_PLANES}, {HW_OUTPUT_PLANES})}),
            "the plugins need each other in a circle: `eats_its_tail` needs planes, which only itself gives");
}

TEST(PipelineKinds, OutputsForTheHostFeedNobody) {
  for (const std::uint32_t kind : Kinds{HW_OUTPUT_POSE, HW_OUTPUT_LANDMARKS, HW_OUTPUT_TOPOLOGY, 4711})
    EXPECT_FALSE(sample_of_output(kind));
  EXPECT_EQ(sample_of_output(HW_OUTPUT_PLANES), HW_SAMPLE_PLANES);
}

/// Whether a pipeline is in order, said by its definition.
bool in_order(const std::vector<PluginInfo>& plugins) {
  Kinds there{HW_SAMPLE_POINTS};
  for (const PluginInfo& one : plugins) {
    for (const std::uint32_t kind : one.inputs) {
      if (std::find(there.begin(), there.end(), kind) == there.end()) return false;
    }
    for (const std::uint32_t kind : one.outputs) there.push_back(*sample_of_output(kind));
  }
  return true;
}

TEST(PipelineKinds, WhatIsSaidIsTrueOfAnyPipeline) {
  std::mt19937 random(3);
  for (unsigned round = 0; round < 2000; ++round) {
    std::vector<PluginInfo> plugins;
    for (unsigned i = 0; i < 1 + round % 4; ++i) {
      PluginInfo one = plugin(std::string(1, static_cast<char>('a' + i)), {}, {});
      for (const std::uint32_t kind : {HW_SAMPLE_POINTS, HW_SAMPLE_PLANES, HW_SAMPLE_SEGMENTS})
        if (random() % 3 == 0) one.inputs.push_back(kind);
      for (const std::uint32_t kind : {HW_OUTPUT_PLANES, HW_OUTPUT_SEGMENTS})
        if (random() % 3 == 0) one.outputs.push_back(kind);
      plugins.push_back(one);
    }
    const std::string text = said(plugins);
    EXPECT_EQ(text.empty(), in_order(plugins));
    bool any_order = false;
    std::vector<PluginInfo> permuted = plugins;
    const auto by_id = [](const PluginInfo& a, const PluginInfo& b) { return a.id < b.id; };
    do {
      any_order = any_order || in_order(permuted);
    } while (std::next_permutation(permuted.begin(), permuted.end(), by_id));
    if (!text.empty()) {
      EXPECT_EQ(text.find("would do") != std::string::npos, any_order) << text;
    }
  }
}

}  // namespace
}  // namespace hallway::host
