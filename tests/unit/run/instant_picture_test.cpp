// SPDX-License-Identifier: MIT
// Pictures of one iteration of a run, from a folder as a driven robot leaves it.
#include <gtest/gtest.h>

#include <cmath>

#include "base/file.hpp"
#include "log/drive_tables.hpp"
#include "log/observations.hpp"
#include "log/poses.hpp"
#include "log/tum.hpp"
#include "run/pictures/pictures.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kPeriod_ns = 100'000'000;
constexpr std::uint32_t kKidnapped = 30;  ///< the first frame after it

/// Along x at 1 m/s for 3 s, then at y = 5 m for 1 s more.
Vec3 place(std::uint32_t i) {
  return {0.1 * i, i < kKidnapped ? 0.0 : 5.0, 0.0};
}

nlohmann::ordered_json manifest(const nlohmann::ordered_json& body) {
  return {{"schema", "hallway.run/1"},
          {"name", "driven"},
          {"command", "run"},
          {"iterations", 40},
          {"sensors",
           {{{"name", "eyes"},
             {"kind", "points"},
             {"T_body_sensor", {{"position_m", {0.2, 0, 0.5}}, {"orientation_wxyz", {1, 0, 0, 0}}}},
             {"horizontal_fov_rad", 1.5},
             {"vertical_fov_rad", 1.0},
             {"max_range_m", 3.0}}}},
          {"robot", {{"closed_loop", true}, {"body", body}}}};
}

/// A folder of 40 frames with contacts at 1 s and at 2.5 s and a kidnapping at 2.95 s. In frame i its sensor sees a point 1 m ahead and i mm up.
void write_folder(const fs::path& folder, const nlohmann::ordered_json& body) {
  std::vector<log::StampedPose> truth;
  std::vector<log::IterationPose> poses;
  std::vector<log::ObeyedCommand> obeyed;
  log::ObservationLog seen;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Vec3 p = place(i);
    truth.push_back({.t_s = 0.1 * i, .position_m = {p.x(), p.y(), p.z()}});
    poses.push_back({.iteration = i, .position_m = {p.x(), p.y(), p.z()}});
    obeyed.push_back({.iteration = i, .linear_m_s = i < 10 ? 0.0 : 1.0, .angular_rad_s = 0.5});
    seen.add_frame(i, std::vector<log::Observation>{{.point = {1.0, 0.0, 0.001 * i}}});
  }
  write_file_atomically(folder / "run.json", manifest(body).dump());
  write_file_atomically(folder / "metrics.json", "{}");
  write_file_atomically(folder / "landmarks.csv", "id,x,y,z,observations,status\n");
  log::write_tum(folder / "truth.tum", truth);
  log::write_tum(folder / "trajectory.tum", truth);
  log::write_poses(folder / "truth_poses.csv", poses);
  log::write_observations(folder / "observations.csv", seen);
  write_file_atomically(folder / "drive.csv", log::print_table(log::kObeyedColumns, obeyed));
  const std::vector<log::ContactRow> contacts{
      {.t_ns = 10 * kPeriod_ns, .kind = "wall", .position_m = {1.3, 0, 0}, .normal = {-1, 0, 0}},
      {.t_ns = 25 * kPeriod_ns, .kind = "step", .position_m = {2.8, 0, 0}, .normal = {-1, 0, 0}}};
  write_file_atomically(folder / "contacts.csv", log::print_table(log::kContactColumns, contacts));
  const std::vector<log::EventRow> events{{5 * kPeriod_ns, "sensor_off", "eyes"},
                                          {29 * kPeriod_ns + kPeriod_ns / 2, "kidnap", ""}};
  write_file_atomically(folder / "events.csv", log::print_table(log::kEventColumns, events));
}

const nlohmann::ordered_json kRound{{"radius_m", 0.3}, {"bottom_m", 0.05}, {"top_m", 0.4}};
const nlohmann::ordered_json kCornered{
    {"corners_m", {{-0.2, -0.2}, {0.4, -0.2}, {0.4, 0.2}, {-0.2, 0.2}}}, {"bottom_m", 0.05}, {"top_m", 0.4}};

class InstantPicture : public ::testing::Test {
 protected:
  Record read(const nlohmann::ordered_json& body) {
    write_folder(folder_.path(), body);
    Record record = read_record(folder_.path());
    read_history(record);
    return record;
  }
  render::Picture at(std::uint32_t iteration, const nlohmann::ordered_json& body = kRound) {
    return compose(read(body), iteration, sim::PictureView::kTop);
  }
  static render::Picture compose(const Record& record, std::optional<std::uint32_t> iteration,
                                 sim::PictureView view) {
    sim::PictureSpec spec;
    spec.show = sim::default_picture_layers();
    spec.view = view;
    spec.iteration = iteration;
    return compose_picture(record, spec);
  }

  test::TempFolder folder_;
};

template <typename List>
std::optional<typename List::value_type> labelled(const List& list, const std::string& label) {
  const auto found = std::ranges::find_if(list, [&](const auto& one) { return one.label == label; });
  if (found == list.end()) return std::nullopt;
  return *found;
}

std::vector<std::string> texts_of(const render::Picture& picture) {
  std::vector<std::string> texts;
  for (const render::Label& label : picture.labels) texts.push_back(label.text);
  return texts;
}

/// The bounds of the robot's body in a picture.
Box body_in(const render::Picture& picture) {
  Box box;
  if (const auto areas = labelled(picture.patches, "robot")) {
    for (const auto& polygon : areas->polygons) {
      for (const Vec3& corner : polygon) box.extend(corner);
    }
  }
  return box;
}

TEST_F(InstantPicture, ShowsTheBodyAtTheTruePose) {
  const Box round = body_in(at(20));
  EXPECT_LT((round.min() - Vec3(1.7, -0.3, 0.05)).norm(), 1e-9);
  EXPECT_LT((round.max() - Vec3(2.3, 0.3, 0.4)).norm(), 1e-9);
  const Box cornered = body_in(at(20, kCornered));
  EXPECT_LT((cornered.min() - Vec3(1.8, -0.2, 0.05)).norm(), 1e-9);
  EXPECT_LT((cornered.max() - Vec3(2.4, 0.2, 0.4)).norm(), 1e-9);
}

TEST_F(InstantPicture, WithoutABodyThereIsAMark) {
  const render::Picture picture = at(20, nullptr);
  EXPECT_TRUE(body_in(picture).isEmpty());
  const auto mark = labelled(picture.markers, "robot");
  ASSERT_TRUE(mark);
  EXPECT_LT((mark->positions.at(0) - place(20)).norm(), 1e-9);
}

TEST_F(InstantPicture, TheTrailEndsAtTheRobotAndBreaksWhereItWasCarried) {
  const auto trail = labelled(at(20).polylines, "true path");
  ASSERT_TRUE(trail);
  EXPECT_EQ(trail->points.size(), 21u);
  EXPECT_LT((trail->points.back() - place(20)).norm(), 1e-9);
  const render::Picture later = at(35);
  for (const char* label : {"true path", "estimated path"}) {
    const auto line = labelled(later.polylines, label);
    ASSERT_TRUE(line) << label;
    ASSERT_EQ(line->points.size(), 37u) << label << ": 36 poses and a break";
    EXPECT_FALSE(line->points[kKidnapped].allFinite()) << label;
    for (std::size_t i = 1; i < line->points.size(); ++i) {
      const Vec3 step = line->points[i] - line->points[i - 1];
      if (step.allFinite()) {
        EXPECT_LT(step.norm(), 0.11) << label << " " << i;
      }
    }
  }
}

TEST_F(InstantPicture, ShowsWhatItsSensorSees) {
  const auto seen = labelled(at(35).markers, "points in view");
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->positions.size(), 1u);
  EXPECT_LT((seen->positions[0] - (place(35) + Vec3(1.2, 0, 0.535))).norm(), 1e-9);
}

TEST_F(InstantPicture, ContactsOfTheLastSecondStandOut) {
  EXPECT_FALSE(labelled(at(9).markers, "contacts"));
  EXPECT_FALSE(labelled(at(9).markers, "contacts of the last second")) << "none yet";
  const render::Picture soon = at(19);
  EXPECT_FALSE(labelled(soon.markers, "contacts"));
  ASSERT_TRUE(labelled(soon.markers, "contacts of the last second"));
  const render::Picture later = at(30);
  ASSERT_TRUE(labelled(later.markers, "contacts"));
  EXPECT_LT((labelled(later.markers, "contacts")->positions.at(0) - Vec3(1.3, 0, 0)).norm(), 1e-9);
  ASSERT_TRUE(labelled(later.markers, "contacts of the last second"));
}

TEST_F(InstantPicture, EventsUntilThenAreNamed) {
  EXPECT_EQ(texts_of(at(4)), (std::vector<std::string>{"start"}));
  EXPECT_EQ(texts_of(at(29)), (std::vector<std::string>{"start", "sensor_off eyes"}));
  const render::Picture picture = at(30);
  EXPECT_EQ(texts_of(picture),
            (std::vector<std::string>{"start", "sensor_off eyes", "kidnap", "after kidnap"}));
  EXPECT_LT((picture.labels[2].position - place(29)).norm(), 1e-9);
  EXPECT_LT((picture.labels[3].position - place(30)).norm(), 1e-9);
}

TEST_F(InstantPicture, TheCommandIsAnArrowAheadAndAnArc) {
  const auto turning = labelled(at(5).segments, "command, for 1 s");
  ASSERT_TRUE(turning) << "it turns on the spot";
  const auto driving = labelled(at(15).segments, "command, for 1 s");
  ASSERT_TRUE(driving);
  EXPECT_LT((driving->pairs[0][0] - place(15)).norm(), 1e-9);
  EXPECT_LT((driving->pairs[0][1] - (place(15) + Vec3(1, 0, 0))).norm(), 1e-9);
  EXPECT_EQ(driving->pairs.size(), turning->pairs.size() + 3);
  EXPECT_NE(at(15).subtitle.find("iteration 15, 1.50 s, command 1 m/s, 0.5 rad/s"), std::string::npos);
}

TEST_F(InstantPicture, TheRobotDoesNotSeeItselfInItsCamera) {
  const Record record = read(kRound);
  const render::Picture picture = compose(record, 20, sim::PictureView::kCamera);
  EXPECT_TRUE(body_in(picture).isEmpty());
  EXPECT_TRUE(picture.frustums.empty());
  EXPECT_TRUE(labelled(picture.markers, "points in view"));
}

TEST_F(InstantPicture, OfTheWholeRunHasAllContactsAndEvents) {
  const render::Picture picture = compose(read(kRound), std::nullopt, sim::PictureView::kTop);
  ASSERT_TRUE(labelled(picture.markers, "contacts"));
  EXPECT_EQ(labelled(picture.markers, "contacts")->positions.size(), 2u);
  EXPECT_FALSE(labelled(picture.markers, "contacts of the last second"));
  EXPECT_EQ(labelled(picture.markers, "events")->positions.size(), 3u);
  EXPECT_TRUE(body_in(picture).isEmpty());
  EXPECT_EQ(labelled(picture.polylines, "true path")->points.size(), 41u) << "with a break";
}

TEST_F(InstantPicture, IterationsThatThereAreNotAreRefused) {
  const Record record = read(kRound);
  const auto beyond = test::error_of([&] { instant_of(record, 40); });
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->code(), ErrorCode::kUsage);
  EXPECT_NE(beyond->message().find("beyond the last one, 39"), std::string::npos) << beyond->message();
}

TEST_F(InstantPicture, FoldersWithoutTruthOrWithBadTablesAreRefused) {
  write_folder(folder_.path(), kRound);
  write_file_atomically(folder_ / "contacts.csv", "t_ns,kind,x_m,y_m,z_m,nx,ny,nz,speed_m_s\n1,wall\n");
  EXPECT_TRUE(test::error_of([&] { read_record(folder_.path()); }));
  write_folder(folder_.path(), {{"corners_m", 3}, {"bottom_m", 0}, {"top_m", 1}});
  Record record = read_record(folder_.path());
  read_history(record);
  const auto no_body = test::error_of([&] { compose(record, 3, sim::PictureView::kTop); });
  ASSERT_TRUE(no_body);
  EXPECT_EQ(no_body->where().element, "robot.body");
  fs::remove(folder_ / "truth_poses.csv");
  const auto no_truth = test::error_of([&] { read_history(record); });
  ASSERT_TRUE(no_truth);
  EXPECT_EQ(no_truth->code(), ErrorCode::kBadInput);
}

}  // namespace
}  // namespace hallway::run
