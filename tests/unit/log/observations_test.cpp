// SPDX-License-Identifier: MIT
#include "log/observations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/file.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/random_doubles.hpp"
#include "support/temp_folder.hpp"

namespace hallway::log {
namespace {

using test::error_of;
using test::same_bits;

const std::string kSample =
    "iteration,landmark_id,x,y,z\n"
    "0,7,1,2,3\n"
    "0,3,4,5,6\n"
    "2,-1,0.5,-0.25,1e-3\n"
    "5,12,67.477231,-17.52195,1.255333\n";

bool same(const Observation& a, const Observation& b) {
  return a.landmark == b.landmark && std::equal(a.point.begin(), a.point.end(), b.point.begin(), same_bits);
}

bool same(std::span<const Observation> a, std::span<const Observation> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Observation& x, const Observation& y) { return same(x, y); });
}

void expect_same_log(const ObservationLog& a, const ObservationLog& b) {
  EXPECT_EQ(a.has_identities(), b.has_identities());
  EXPECT_EQ(a.iterations(), b.iterations());
  EXPECT_TRUE(same(a.observations(), b.observations()));
  EXPECT_TRUE(std::ranges::equal(a.filled_iterations(), b.filled_iterations()));
  for (const std::uint32_t iteration : a.filled_iterations()) {
    EXPECT_TRUE(same(a.frame(iteration), b.frame(iteration))) << iteration;
  }
}

ObservationLog whole(const std::string& text) {
  ReadLog read = parse_observations(text, "obs.csv");
  EXPECT_FALSE(read.damage) << read.damage->cause;
  return read.log;
}

TEST(ObservationLog, IsEmptyAtFirst) {
  const ObservationLog log;
  EXPECT_EQ(log.iterations(), 0u);
  EXPECT_TRUE(log.frame(0).empty());
}

TEST(ObservationLog, GivesFramesByIteration) {
  ObservationLog log(true);
  log.add_frame(1, std::array{Observation{4, {1, 2, 3}}, Observation{5, {4, 5, 6}}});
  log.add_frame(2, {});
  log.add_frame(4, std::array{Observation{6, {7, 8, 9}}});
  EXPECT_EQ(log.iterations(), 5u);
  EXPECT_TRUE(log.frame(0).empty());
  ASSERT_EQ(log.frame(1).size(), 2u);
  EXPECT_EQ(log.frame(1)[1].landmark, 5u);
  EXPECT_TRUE(log.frame(2).empty());
  EXPECT_TRUE(log.frame(3).empty());
  ASSERT_EQ(log.frame(4).size(), 1u);
  EXPECT_TRUE(log.frame(5).empty());
  EXPECT_TRUE(log.frame(4'000'000'000u).empty());
}

TEST(ObservationLog, TracksAreAColumnOfTheirOwn) {
  const ReadLog read = parse_observations("iteration,track,x,y,z\n0,12,1,2,3\n0,-1,4,5,6\n2,,,,\n", "a.csv");
  ASSERT_FALSE(read.damage);
  EXPECT_TRUE(read.log.has_tracks());
  EXPECT_FALSE(read.log.has_identities());
  EXPECT_EQ(read.log.frame(0)[0].track, 12u);
  EXPECT_EQ(read.log.frame(0)[1].track, kNoTrack);
  EXPECT_EQ(print_observations(read.log), "iteration,x,y,z,track\n0,1,2,3,12\n0,4,5,6,-1\n2,,,,\n");
  EXPECT_FALSE(parse_observations("iteration,x,y,z\n0,1,2,3\n", "a.csv").log.has_tracks());
}

TEST(ObservationLog, RefusesFramesOutOfOrder) {
  ObservationLog log;
  log.add_frame(3, {});
  EXPECT_TRUE(error_of([&] { log.add_frame(3, {}); }));
  EXPECT_TRUE(error_of([&] { log.add_frame(2, {}); }));
  EXPECT_TRUE(error_of([&] { log.add_frame(kMaxIteration + 1, {}); }));
  EXPECT_EQ(log.iterations(), 4u);
}

TEST(ParseObservations, ReadsFramesInOrderWithGaps) {
  const ObservationLog log = whole(kSample);
  EXPECT_TRUE(log.has_identities());
  EXPECT_EQ(log.iterations(), 6u);
  EXPECT_EQ(log.observations().size(), 4u);
  ASSERT_EQ(log.frame(0).size(), 2u);
  EXPECT_TRUE(same(log.frame(0)[0], {7, {1, 2, 3}}));
  EXPECT_TRUE(same(log.frame(0)[1], {3, {4, 5, 6}}));
  EXPECT_TRUE(log.frame(1).empty());
  EXPECT_TRUE(same(log.frame(2)[0], {kNoLandmark, {0.5, -0.25, 1e-3}}));
  EXPECT_TRUE(same(log.frame(5)[0], {12, {67.477231, -17.52195, 1.255333}}));
}

TEST(ParseObservations, NeedsNoIdentities) {
  const ObservationLog log = whole("z,y,x,iteration\n3,2,1,0\n");
  EXPECT_FALSE(log.has_identities());
  EXPECT_TRUE(same(log.frame(0)[0], {kNoLandmark, {1, 2, 3}}));
}

TEST(ParseObservations, AnEmptyIdentityIsNone) {
  EXPECT_EQ(whole("iteration,landmark_id,x,y,z\n0,,1,2,3\n").frame(0)[0].landmark, kNoLandmark);
}

TEST(ParseObservations, AHeaderAloneIsAnEmptyLog) {
  EXPECT_EQ(whole("iteration,x,y,z\n").iterations(), 0u);
}

TEST(ParseObservations, ARowWithoutAPointIsAnEmptyFrame) {
  const ObservationLog log = whole("iteration,x,y,z\n0,1,2,3\n4,,,\n");
  EXPECT_EQ(log.iterations(), 5u);
  EXPECT_TRUE(log.frame(4).empty());
}

TEST(ParseObservations, HighIterationsCostNoMemory) {
  const ObservationLog log = whole("iteration,x,y,z\n99999999,1,2,3\n");
  EXPECT_EQ(log.iterations(), 100'000'000u);
  EXPECT_EQ(log.filled_iterations().size(), 1u);
}

struct DamageCase {
  std::string name;
  std::string row;
  std::string cause;
};

class Damaged : public testing::TestWithParam<DamageCase> {};

TEST_P(Damaged, InTheMiddleKeepsWhatStandsBefore) {
  const ReadLog read = parse_observations(kSample + GetParam().row + "\n9,1,1,1,1\n", "obs.csv");
  ASSERT_TRUE(read.damage);
  EXPECT_EQ(read.damage->line, 6);
  EXPECT_EQ(read.damage->cause, GetParam().cause);
  expect_same_log(read.log, whole(kSample));
}

TEST_P(Damaged, InTheFirstRowIsAnError) {
  const auto error = error_of(
      [] { parse_observations("iteration,landmark_id,x,y,z\n" + GetParam().row + "\n", "obs.csv"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "obs.csv");
  EXPECT_EQ(error->where().line, 2);
}

INSTANTIATE_TEST_SUITE_P(
    ParseObservations, Damaged,
    testing::Values(
        DamageCase{"nan", "6,1,nan,1,1", "column x: a finite number is needed, \"nan\" found"},
        DamageCase{"infinite", "6,1,1,-inf,1", "column y: a finite number is needed, \"-inf\" found"},
        DamageCase{"too_large", "6,1,1,1,1e999", "column z: a finite number is needed, \"1e999\" found"},
        DamageCase{"word", "6,1,1,1,up", "column z: a finite number is needed, \"up\" found"},
        DamageCase{"missing_number", "6,1,1,,1", "column y: a finite number is needed, nothing found"},
        DamageCase{"missing_field", "6,1,1,1", "4 fields where the header has 5"},
        DamageCase{"more_fields", "6,1,1,1,1,1", "6 fields where the header has 5"},
        DamageCase{"negative_iteration", "-6,1,1,1,1",
                   "column iteration: a whole number from 0 to 99999999 is needed, \"-6\" found"},
        DamageCase{"time_as_iteration", "1700000000,1,1,1,1",
                   "column iteration: a whole number from 0 to 99999999 is needed, \"1700000000\" found"},
        DamageCase{
            "fractional_identity", "6,1.5,1,1,1",
            "column landmark_id: a whole number from 0 to 18446744073709551614 is needed, \"1.5\" found"},
        DamageCase{
            "negative_identity", "6,-2,1,1,1",
            "column landmark_id: a whole number from 0 to 18446744073709551614 is needed, \"-2\" found"}),
    [](const auto& tested) { return tested.param.name; });

TEST(ParseObservations, GoingBackwardsIsDamage) {
  const ReadLog read = parse_observations(kSample + "4,1,1,1,1\n", "obs.csv");
  ASSERT_TRUE(read.damage);
  EXPECT_EQ(read.damage->line, 6);
  EXPECT_EQ(read.damage->cause, "column iteration: an iteration not below 5 is needed, \"4\" found");
  expect_same_log(read.log, whole(kSample));
}

TEST(ParseObservations, AnEmptyFrameAmongPointsIsDamage) {
  const ReadLog read = parse_observations(kSample + "5,,,,\n", "obs.csv");
  ASSERT_TRUE(read.damage);
  EXPECT_EQ(read.damage->line, 6);
  EXPECT_EQ(read.damage->cause, "a row without a point has other rows of the same iteration beside it");
  expect_same_log(read.log, whole(kSample));
}

TEST(ParseObservations, APointInAnEmptyFrameIsDamage) {
  const ReadLog read = parse_observations("iteration,x,y,z\n3,,,\n3,1,2,3\n", "obs.csv");
  ASSERT_TRUE(read.damage);
  EXPECT_EQ(read.damage->line, 3);
  EXPECT_EQ(read.log.iterations(), 4u);
  EXPECT_TRUE(read.log.observations().empty());
}

TEST(ParseObservations, ABadHeaderIsAnError) {
  for (const std::string header :
       {"", "0,1,2,3\n", "iteration,x,y\n", "iteration,x,y,z,x\n", "iteration,x,y,z,landmark_ids\n",
        "iteration;x;y;z\n", "iteration,x,y,z"}) {
    const auto error = error_of([&] { parse_observations(header, "obs.csv"); });
    ASSERT_TRUE(error) << header;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_EQ(error->where().file, "obs.csv");
  }
}

TEST(ParseObservations, CutAtAnyByteKeepsWholeRowsAlone) {
  const ObservationLog all = whole(kSample);
  const std::size_t first_row_end = kSample.find('\n', kSample.find('\n') + 1) + 1;
  for (std::size_t length = first_row_end; length < kSample.size(); ++length) {
    const std::string cut = kSample.substr(0, length);
    const ReadLog read = parse_observations(cut, "obs.csv");
    const auto rows = static_cast<std::size_t>(std::count(cut.begin(), cut.end(), '\n')) - 1;
    EXPECT_TRUE(same(read.log.observations(), all.observations().subspan(0, rows))) << length;
    EXPECT_EQ(read.damage.has_value(), cut.back() != '\n') << length;
    if (read.damage) {
      EXPECT_EQ(read.damage->line, static_cast<int>(rows) + 2) << length;
    }
  }
}

TEST(ParseObservations, CutWithinTheFirstRowIsAnError) {
  const std::size_t header_end = kSample.find('\n') + 1;
  for (std::size_t length = 0; length < kSample.find('\n', header_end); ++length) {
    if (length == header_end) continue;  // a header alone is a whole file
    EXPECT_TRUE(error_of([&] { parse_observations(kSample.substr(0, length), "obs.csv"); })) << length;
  }
}

TEST(ParseObservations, AFlippedBitHarmsNothingBeforeIt) {
  const ObservationLog all = whole(kSample);
  const std::size_t header_end = kSample.find('\n') + 1;
  for (std::size_t at = header_end; at < kSample.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = kSample;
      flipped[at] = static_cast<char>(static_cast<unsigned char>(flipped[at]) ^ (1u << bit));
      const auto rows =
          static_cast<std::size_t>(std::count(kSample.begin() + static_cast<std::ptrdiff_t>(header_end),
                                              kSample.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
      ReadLog read;
      const auto error = error_of([&] { read = parse_observations(flipped, "obs.csv"); });
      if (error) {
        EXPECT_EQ(rows, 0u) << at << ' ' << bit;
        EXPECT_GT(error->where().line, 1);
        continue;
      }
      ASSERT_GE(read.log.observations().size(), rows) << at << ' ' << bit;
      EXPECT_TRUE(same(read.log.observations().subspan(0, rows), all.observations().subspan(0, rows)));
    }
  }
}

TEST(DescribeDamage, SaysWhereWhyAndHowMuchIsKept) {
  const ReadLog read = parse_observations(kSample + "6,1,", "obs.csv");
  ASSERT_TRUE(read.damage);
  EXPECT_EQ(describe(*read.damage, read.log, "obs.csv"),
            "obs.csv:6: the last line has no line end: the file seems to be cut off here; kept what stands "
            "before: 4 "
            "observations, iterations below 6");
}

TEST(PrintObservations, IsTheCanonicalForm) {
  EXPECT_EQ(
      print_observations(whole("x,iteration,z,y,landmark_id\r\n1.50,0,3e0,-2.0,007\r\n\r\n 4,2,6,5,\r\n")),
      "iteration,landmark_id,x,y,z\n0,7,1.5,-2,3\n2,-1,4,5,6\n");
}

TEST(PrintObservations, LeavesOutIdentitiesThatAreNotKnown) {
  EXPECT_EQ(print_observations(whole("iteration,x,y,z\n1,1,2,3\n")), "iteration,x,y,z\n1,1,2,3\n");
}

TEST(PrintObservations, KeepsAnEmptyLastFrame) {
  for (const bool identities : {false, true}) {
    ObservationLog log(identities);
    log.add_frame(0, std::array{Observation{0, {1, 2, 3}}});
    log.add_frame(1, {});
    log.add_frame(2, {});
    ObservationLog expected = log;
    if (!identities) {
      expected = ObservationLog(false);
      expected.add_frame(0, std::array{Observation{kNoLandmark, {1, 2, 3}}});
      expected.add_frame(2, {});
    }
    expect_same_log(whole(print_observations(log)), expected);
  }
}

TEST(PrintObservations, ReadsBackToTheSameBits) {
  const std::vector<double> values = test::random_doubles(6000, 1);
  ObservationLog log(true);
  std::vector<Observation> frame;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    frame.push_back(
        {i % 7 == 0 ? kNoLandmark : kNoLandmark - 1 - i, {values[i], values[i + 1], values[i + 2]}});
    if (i % 5 == 0) {
      log.add_frame(static_cast<std::uint32_t>(i), frame);
      frame.clear();
    }
  }
  const std::string text = print_observations(log);
  const ObservationLog back = whole(text);
  expect_same_log(back, log);
  EXPECT_EQ(print_observations(back), text);
}

TEST(WriteObservations, WritesWhatReadObservationsReads) {
  const test::TempFolder folder;
  write_observations(folder / "a.csv", whole(kSample));
  const ReadLog read = read_observations(folder / "a.csv");
  EXPECT_FALSE(read.damage);
  expect_same_log(read.log, whole(kSample));
}

TEST(ObservationFile, IsTheFileOfWriteObservations) {
  const test::TempFolder folder;
  const std::vector<double> values = test::random_doubles(30'000, 2);
  for (const bool flags : {false, true}) {
    for (const bool ends_empty : {false, true}) {
      ObservationLog log(flags, flags);
      const auto name = std::string(flags ? "flags" : "plain") + (ends_empty ? "_empty" : "");
      ObservationFile file(folder / name, flags, flags);
      std::vector<Observation> frame;
      const auto add = [&](std::uint32_t iteration) {
        log.add_frame(iteration, frame);
        file.add_frame(iteration, frame);
        frame.clear();
      };
      for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
        frame.push_back({i % 7 == 0 ? kNoLandmark : i, {values[i], values[i + 1], values[i + 2]}, i % 4});
        if (i % 5 == 0) add(static_cast<std::uint32_t>(i));
        if (i % 50 == 0) add(static_cast<std::uint32_t>(i + 1));
      }
      frame.resize(ends_empty ? 0 : 1);
      add(99'000);
      file.close();
      EXPECT_EQ(read_file(folder / name), print_observations(log)) << name;
    }
  }
  ObservationFile(folder / "none", true, false).close();
  EXPECT_EQ(read_file(folder / "none"), print_observations(ObservationLog(true)));
}

TEST(ReadObservations, NamesAMissingFile) {
  const test::TempFolder folder;
  const auto error = error_of([&] { read_observations(folder / "none.csv"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_NE(std::string(error->what()).find("none.csv"), std::string::npos);
}

TEST(ReadObservations, ReadsARecordedLog) {
  HALLWAY_DATA_OR_SKIP(file, "landmark_logs/figure8_d25/obs.csv");
  const ReadLog read = read_observations(file);
  EXPECT_FALSE(read.damage);
  EXPECT_TRUE(read.log.has_identities());
  EXPECT_EQ(read.log.iterations(), 7600u);
  EXPECT_EQ(read.log.observations().size(), 202446u);  // meta.txt of the log
}

TEST(ReadObservations, ReadsARecordedLogWithoutIdentities) {
  HALLWAY_DATA_OR_SKIP(file, "landmark_logs_real/victoria_1181_1641/obs.csv");
  const ReadLog read = read_observations(file);
  EXPECT_FALSE(read.damage);
  EXPECT_FALSE(read.log.has_identities());
  EXPECT_GT(read.log.iterations(), 400u);
}

}  // namespace
}  // namespace hallway::log
