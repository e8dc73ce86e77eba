// SPDX-License-Identifier: MIT
#include "run/sources/simulated_source.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "host/samples/frame_bytes.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/drive_world.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::run {
namespace {

const char* const kSensorInMap =
    "{\n\"classname\" \"hw_sensor\"\n\"name\" \"nose\"\n\"noise_m\" \"0.25\"\n}\n";

/// Writes scenario and map and calls `use` with the source that they give.
template <typename Use>
void with_source(const std::string& sensors, const std::string& entities, const Use& use,
                 const std::string& brushes = "") {
  const test::TempFolder folder;
  folder.write("small.map", test::map_text(brushes, entities));
  const sim::Scenario scenario = sim::load_scenario(folder.write("s.toml", test::scenario_text(sensors)));
  const sim::Simulator simulator(scenario, 1, trace::Backend::kBruteForce);
  use(SimulatedSource(simulator));
}

TEST(SimulatedSource, HasTheSensorOfTheScenarioOrElseOfItsMap) {
  with_source("", kSensorInMap, [](const SimulatedSource& source) {
    EXPECT_EQ(source.sensors().front().name, "nose");
    EXPECT_EQ(source.sensors().front().noise_m[1], 0.25);
  });
  with_source("[sensor.eyes]\nkind = 'points'\n", kSensorInMap,
              [](const SimulatedSource& source) { EXPECT_EQ(source.sensors().front().name, "eyes"); });
}

TEST(SimulatedSource, SaysWhereSensorsComeFromWhereThereIsNone) {
  const auto error = test::error_of([&] { with_source("", "", [](const SimulatedSource&) {}); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_TRUE(error->where().file.ends_with("s.toml"));
  for (const char* part : {"[sensor.NAME]", "hw_sensor", "there is none"})
    EXPECT_NE(error->message().find(part), std::string::npos) << error->what();
}

const char* const kEyes = "[sensor.eyes]\nkind = 'points'\nmax_range_m = 8\nnoise_m = 0.02\n";
const char* const kBack =
    "[sensor.back]\nkind = 'points'\nyaw_deg = 180\nnoise_m = 0.05\nrate_hz = 25\nlatency_s = 0.03\n";
const char* const kWalls =
    "[sensor.walls]\nkind = 'planes'\nmax_range_m = 8\nnoise_m = 0.01\nrate_hz = 4\nphase_s = 0.05\n";

/// Every sample of one sensor in all frames, with its identities, as text.
std::string samples_of(SimulatedSource& source, const std::string& name) {
  std::string all;
  SourceFrame frame;
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    source.read(i, frame);
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      const hw_sample_t& sample = frame.sample(k);
      if (source.sensors()[sample.sensor_id].name != name) continue;
      hw_sample_t alone = sample;
      alone.sensor_id = 0;
      const hw_sample_t* samples[] = {&alone};
      const hw_frame_t one{sizeof(hw_frame_t), 1, i, frame.t_ns(), samples};
      std::string bytes;
      host::FrameWriter().write_over(bytes, one);
      all += bytes;
      for (const log::LandmarkId id : frame.identities_of(k)) all += std::to_string(id) + " ";
    }
  }
  return all;
}

TEST(SimulatedSource, AddingASensorChangesNoByteOfAnotherOnes) {
  const std::string brushes = test::pillars();
  const auto read = [&](const std::string& sensors, const std::string& name) {
    std::string samples;
    with_source(
        sensors, "", [&](SimulatedSource source) { samples = samples_of(source, name); }, brushes);
    return samples;
  };
  const std::string eyes = read(kEyes, "eyes");
  ASSERT_GT(eyes.size(), 1000u);
  EXPECT_EQ(read(std::string(kEyes) + kBack, "eyes"), eyes);
  EXPECT_EQ(read(std::string(kBack) + kWalls + kEyes, "eyes"), eyes);
  EXPECT_EQ(read(std::string(kWalls) + kEyes, "walls"), read(kWalls, "walls"));
  EXPECT_NE(read(kBack, "back"), eyes);
}

TEST(SimulatedSource, GivesSamplesBySensorAndThenBySequence) {
  with_source(
      std::string(kEyes) + kBack + kWalls, "",
      [](SimulatedSource source) {
        ASSERT_EQ(source.sensors().size(), 3u);
        EXPECT_TRUE(source.true_landmarks().has_value());
        EXPECT_TRUE(source.true_planes().has_value());
        SourceFrame frame;
        std::uint64_t next[3] = {0, 0, 0};
        for (std::uint32_t i = 0; i < source.iterations(); ++i) {
          source.read(i, frame);
          std::uint32_t sensor = 0;
          for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
            const hw_sample_t& sample = frame.sample(k);
            EXPECT_GE(sample.sensor_id, sensor);
            sensor = sample.sensor_id;
            EXPECT_EQ(sample.sequence, next[sensor]++) << "every reading once";
            EXPECT_LE(sample.t_end_ns, frame.t_ns());
          }
          EXPECT_EQ(frame.identities.size(), frame.n_elements());
        }
        EXPECT_EQ(next[0], 40u) << "one for every frame";
        EXPECT_EQ(next[1], 97u) << "25 in a second, by 3.87 s";
        EXPECT_EQ(next[2], 16u) << "4 in a second from 0.05 s on, by 3.9 s";
      },
      test::pillars());
}

/// The values of that name; empty where there are none.
std::vector<double> values_of(const log::SampleTruth& truth, const std::string& name) {
  const auto found = truth.values.find(name);
  return found == truth.values.end() ? std::vector<double>() : found->second;
}

TEST(SimulatedSource, TellsTheTruthOfEachSample) {
  const test::TempFolder folder;
  folder.write("small.map", test::map_text(sim::test::room(), sim::test::start_at("0 0 50")));
  const std::string eyes = "[sensor.eyes]\nkind = 'points'\nrate_hz = 8\nlatency_s = 0.03\n";
  const sim::Scenario scenario =
      sim::load_scenario(folder.write("s.toml", sim::test::driven_text("", "kind = 'differential'\n", eyes)));
  const sim::Simulator simulator(scenario, 1, trace::Backend::kBruteForce);
  SimulatedSource source(simulator);
  SourceFrame frame;
  std::size_t at_other_times = 0, presses = 0;
  Pose before;
  for (std::uint32_t i = 0; i < 150; ++i) {
    source.read(i, frame);
    for (const log::SampleTruth& truth : frame.sample_truths) {
      const hw_sample_t& sample = frame.sample(truth.sample);
      EXPECT_EQ(truth.position_m.has_value(), sample.t_end_ns != frame.t_ns());
      if (truth.position_m) {
        ++at_other_times;
        EXPECT_GE((*truth.position_m)[0], before.t.x() - 0.05) << "it drives ahead";
        EXPECT_LE((*truth.position_m)[0], frame.T_world_body->t.x());
      }
      if (sample.kind == HW_SAMPLE_ENCODER) {
        const auto& encoder = *static_cast<const hw_encoder_t*>(sample.payload);
        const auto ways = values_of(truth, "travel_m"), ticks_m = values_of(truth, "m_per_tick");
        ASSERT_EQ(ways.size(), 2u);
        for (std::size_t wheel = 0; wheel < 2; ++wheel)
          EXPECT_EQ(static_cast<double>(hw_wheel_ticks_at(&encoder, wheel)),
                    std::floor(ways[wheel] / ticks_m[wheel]));
      }
      if (sample.kind == HW_SAMPLE_BUMP) {
        const auto pressed = values_of(truth, "pressed"), counts = values_of(truth, "points");
        ASSERT_EQ(pressed.size(), 4u);
        ASSERT_EQ(counts.size(), 4u);
        double points = 0;
        for (std::size_t zone = 0; zone < 4; ++zone) {
          EXPECT_EQ(pressed[zone] != 0, counts[zone] != 0);
          points += counts[zone];
        }
        presses += points > 0 ? 1u : 0u;
        const auto places = values_of(truth, "points_m");
        EXPECT_EQ(static_cast<double>(places.size()), 3.0 * points);
        if (points > 0) {
          EXPECT_NEAR(places[0], 5.0, 0.001) << "the wall";
        }
      }
    }
    before = *frame.T_world_body;
    source.obey({.command = drive::Command{.forward_m_s = 0.5}});
  }
  EXPECT_GT(at_other_times, 50u);
  EXPECT_GT(presses, 10u);
}

}  // namespace
}  // namespace hallway::run
