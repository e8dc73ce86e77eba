// SPDX-License-Identifier: MIT
#include "import/victoria_park.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "log/csv_reader.hpp"
#include "log/observations.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::import {
namespace {

class VictoriaPark : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scans.csv", "scan,t_s,n_trees\n4,10.5,2\n5,10.714,0\n7,11,1\n");
    folder_.write("observations.csv",
                  "scan,t_s,range_m,bearing_rad,diameter_m\n4,10.5,2,0,0.3\n4,10.5,3,1.5707963267948966,0."
                  "3\n7,11,5,-0.5,1\n");
    folder_.write("gps.csv", "t_s,east_lo_m,north_la_m\n10.4,1,2\n10.6,3,2.5\n20,0,0\n");
  }
  std::string error_text() const {
    const auto error = test::error_of([&] { open_victoria_park(folder_.path(), {}); });
    return error ? error->what() : "none";
  }
  test::TempFolder folder_;
};

TEST_F(VictoriaPark, AFrameForEachScanWithItsTimeAndTrees) {
  const auto recording = open_victoria_park(folder_.path(), {});
  ASSERT_EQ(recording->frames(), 3u);
  EXPECT_EQ(recording->period_ns(), 250'000'000);
  Frame frame;
  recording->read(0, frame);
  EXPECT_EQ(frame.t_ns, 10'500'000'000);
  ASSERT_EQ(frame.points.size(), 2u);
  EXPECT_EQ(frame.points[0], (std::array<double, 3>{2, 0, 0}));
  EXPECT_NEAR(frame.points[1][0], 0.0, 1e-15);
  EXPECT_EQ(frame.points[1][1], 3.0) << "to the left";
  ASSERT_TRUE(frame.T_world_body);
  EXPECT_FALSE(frame.orientation_known);
  EXPECT_NEAR(frame.T_world_body->t.x(), 2.0, 1e-12);
  EXPECT_NEAR(frame.T_world_body->t.y(), 2.25, 1e-12);
  recording->read(1, frame);
  EXPECT_EQ(frame.t_ns, 10'714'000'000);
  EXPECT_TRUE(frame.points.empty());
  EXPECT_EQ(frame.T_world_body->t.x(), 3.0) << "the one fix that is near";
  recording->read(2, frame);
  EXPECT_EQ(frame.points.size(), 1u);
  EXPECT_FALSE(frame.T_world_body);
}

TEST_F(VictoriaPark, TablesThatDoNotAgreeAreAnErrorWithTheLine) {
  const std::string head = "scan,t_s,range_m,bearing_rad\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {head + "4,10.5,2,0\n", "ends after 1 of 3 trees"},
      {head + "4,10.5,2,0\n7,11,2,0\n", "observations.csv:3: column scan: tree 2 of 2 of scan 4 is needed"},
      {head + "4,1,2,0\n4,1,2,0\n7,1,2,0\n7,1,2,0\n", "observations.csv:5: column scan"},
      {head + "4,1,2,0\n4,1,x,0\n", "observations.csv:3: column range_m"},
      {"scan,range,bearing_rad\n", "has no column \"range_m\""},
      {"", "the file is empty"},
  };
  for (const auto& [text, words] : cases) {
    folder_.write("observations.csv", text);
    EXPECT_NE(error_text().find(words), std::string::npos) << error_text();
  }
  folder_.write("gps.csv", "t_s,east_lo_m,north_la_m\n2,0,0\n1,0,0\n");
  folder_.write("observations.csv", head + "4,1,2,0\n4,1,2,0\n7,1,2,0\n");
  EXPECT_NE(error_text().find("gps.csv:3: column t_s"), std::string::npos) << error_text();
  folder_.write("scans.csv", "scan,t_s,n_trees\n4,10,99999999999\n");
  EXPECT_NE(error_text().find("scans.csv:2: column n_trees"), std::string::npos) << error_text();
  folder_.write("scans.csv", "scan,t_s,n_trees\n4,10,1\n4,11,1\n");
  EXPECT_NE(error_text().find("scans.csv:3: column scan"), std::string::npos) << error_text();
  folder_.write("scans.csv", "scan,t_s,n_trees\n");
  EXPECT_NE(error_text().find("has no scans"), std::string::npos) << error_text();
}

TEST(VictoriaParkData, AgreesWithTheIntervalsMadeFromIt) {
  HALLWAY_DATA_OR_SKIP(folder, "victoria_park");
  HALLWAY_DATA_OR_SKIP(intervals, "landmark_logs_real");
  const auto recording = open_victoria_park(folder, {});
  ASSERT_EQ(recording->frames(), 7249u);
  Frame frame;
  for (const auto& [name, first] : {std::pair{"victoria_1181_1641", 1181u}, {"victoria_4220_4633", 4220u}}) {
    const log::ReadLog read = log::read_observations(intervals / name / "obs.csv");
    ASSERT_FALSE(read.damage);
    ASSERT_GT(read.log.iterations(), 400u);
    for (std::uint32_t i = 0; i < read.log.iterations(); ++i) {
      recording->read(first + i, frame);
      const auto expected = read.log.frame(i);
      ASSERT_EQ(frame.points.size(), expected.size()) << i;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          // It has four places behind the point.
          EXPECT_NEAR(frame.points[k][axis], expected[k].point[axis], 5.1e-5);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hallway::import
