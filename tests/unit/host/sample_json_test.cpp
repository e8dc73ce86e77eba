// SPDX-License-Identifier: MIT
#include "host/samples/sample_json.hpp"

#include <gtest/gtest.h>
#include <hallway/planes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "host/samples/frame_builder.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/plane_kind.hpp"
#include "host/samples/point_kind.hpp"
#include "host/samples/sample_kind.hpp"
#include "support/made_up_kind.hpp"

namespace hallway::host {
namespace {

std::string json_of(const hw_sample_t& sample) {
  std::string text;
  append_sample_json(text, sample);
  return text;
}

std::string sample_head(const char* kind, const char* flags = "") {
  return R"({"sensor":9,"kind":")" + std::string(kind) +
         R"(","sequence":4,"t_begin_ns":-10,"t_end_ns":20,"flags":[)" + flags + "]";
}

/// A reading of two points whose every part can be changed.
struct Points {
  std::vector<hw_point3_t> points{{1, -0.0, 0.1}, {1e300, 5e-324, -3}};
  hw_points_t payload{sizeof(hw_points_t),
                      sizeof(hw_point3_t),
                      2,
                      points.data(),
                      nullptr,
                      0,
                      0,
                      nullptr,
                      nullptr,
                      nullptr,
                      nullptr};
  hw_sample_t sample{sizeof(hw_sample_t), HW_SAMPLE_POINTS, 0, 9, 4, -10, 20, &payload};
};

TEST(SampleJson, OfPointsHasThemAsListsOfThree) {
  EXPECT_EQ(json_of(Points().sample),
            sample_head("points") + R"(,"payload":{"points":[[1,-0,0.1],[1e+300,5e-324,-3]]}})");
  Points none;
  none.payload.count = 0;
  EXPECT_EQ(json_of(none.sample), sample_head("points") + R"(,"payload":{"points":[]}})");
}

TEST(SampleJson, OfPointsHasTracksAndPixelsWhereTheyAre) {
  Points one;
  const std::uint64_t track[] = {HW_NO_TRACK, 18446744073709551614u};
  one.payload.track = track;
  one.sample.flags = HW_SAMPLE_TRACKED;
  const std::string points = R"("points":[[1,-0,0.1],[1e+300,5e-324,-3]])";
  const std::string tracks = R"("track":[null,18446744073709551614])";
  EXPECT_EQ(json_of(one.sample),
            sample_head("points", R"("tracked")") + R"(,"payload":{)" + points + "," + tracks + "}}");
  const std::uint32_t pixel[] = {4294967295u, 0};
  one.payload.width = 640;
  one.payload.height = 480;
  one.payload.pixel = pixel;
  one.sample.flags = 0x80000003u;
  EXPECT_EQ(json_of(one.sample), sample_head("points", R"("tracked","bit 1","bit 31")") +
                                     R"(,"payload":{"width":640,"height":480,)" + points + "," + tracks +
                                     R"(,"pixel":[4294967295,0]}})");
  // Where there are no pixels, the image's size says nothing; and what a plugin of ABI 1.1 gives ends before it.
  one.payload.pixel = nullptr;
  EXPECT_EQ(json_of(one.sample).find("width"), std::string::npos);
  one.payload.pixel = pixel;
  one.payload.size = offsetof(hw_points_t, width);
  EXPECT_EQ(json_of(one.sample).find("width"), std::string::npos);
  EXPECT_EQ(json_of(one.sample).find("pixel"), std::string::npos);
}

TEST(SampleJson, DoesNotDependOnTheStride) {
  Points one;
  const std::vector<double> wide{1, -0.0, 0.1, 99, 1e300, 5e-324, -3, 99};
  one.payload.points = wide.data();
  one.payload.stride = 32;
  EXPECT_EQ(json_of(one.sample), json_of(Points().sample));
}

TEST(SampleJson, HasNullForNaNAndATextForWhatIsInfinite) {
  Points one;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  one.points[0] = {std::nan(""), kInfinite, -kInfinite};
  EXPECT_NE(json_of(one.sample).find(R"([null,"inf","-inf"])"), std::string::npos) << json_of(one.sample);
}

TEST(SampleJson, ReadsBackAsTheSameNumbers) {
  Points one;
  one.points[0] = {1.0 / 3.0, std::nextafter(0.1, 1.0), 123456789.123456789};
  const std::string text = json_of(one.sample);
  std::size_t at = text.find("[[") + 2;
  for (const double value : {one.points[0].x, one.points[0].y, one.points[0].z}) {
    std::size_t length = 0;
    EXPECT_EQ(std::stod(text.substr(at), &length), value);
    at += length + 1;
  }
}

/// Two planes of which one has a hull and members.
struct Planes {
  std::vector<hw_plane_t> planes = std::vector<hw_plane_t>(2);
  std::vector<hw_point3_t> hull{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  std::vector<std::uint32_t> members{0, 5};
  hw_planes_t payload{
      sizeof(hw_planes_t), sizeof(hw_plane_t), 2, planes.data(), 1, sizeof(hw_point3_t), 3, hull.data(), 2,
      members.data()};
  hw_sample_t sample{sizeof(hw_sample_t), HW_SAMPLE_PLANES, 0, 9, 4, -10, 20, &payload};

  Planes() {
    planes[0] = {.id = 7,
                 .normal = {0, 0.5, 1},
                 .offset_m = -2,
                 .centroid = {10, 11, 12},
                 .corners = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}},
                 .n_points = 13,
                 .rms_m = 0.25,
                 .exclusive_share = 0.75,
                 .first_hull = 14,
                 .n_hull = 3,
                 .first_member = 15,
                 .n_members = 2};
  }
};

constexpr const char* kZeroPlane =
    R"({"id":0,"normal":[0,0,0],"offset_m":0,"centroid":[0,0,0],"corners":[[0,0,0],[0,0,0],[0,0,0],[0,0,0]],)"
    R"("n_points":0,"rms_m":0,"exclusive_share":0,"first_hull":0,"n_hull":0,"first_member":0,"n_members":0})";

TEST(SampleJson, OfPlanesHasHullsAndMembers) {
  EXPECT_EQ(json_of(Planes().sample),
            sample_head("planes") +
                R"(,"payload":{"sample":1,"planes":[{"id":7,"normal":[0,0.5,1],"offset_m":-2,)"
                R"("centroid":[10,11,12],"corners":[[1,2,3],[4,5,6],[7,8,9],[10,11,12]],"n_points":13,)"
                R"("rms_m":0.25,"exclusive_share":0.75,"first_hull":14,"n_hull":3,"first_member":15,)"
                R"("n_members":2},)" +
                kZeroPlane + R"(],"hull_points":[[1,2,3],[4,5,6],[7,8,9]],"members":[0,5]}})");
}

TEST(SampleJson, OfPlanesOfNoSampleSaysSo) {
  Planes planes;
  planes.payload.sample = HW_NO_SAMPLE;
  planes.payload.count = planes.payload.n_hull_points = planes.payload.n_members = 0;
  EXPECT_EQ(
      json_of(planes.sample),
      sample_head("planes") + R"(,"payload":{"sample":null,"planes":[],"hull_points":[],"members":[]}})");
}

TEST(SampleJson, OfAKindThatIsAddedByItsRowAlone) {
  const test::MadeUpRay rays[] = {{0, 1.5}, {-1, 0.1}};
  const std::uint32_t marks[] = {1};
  test::MadeUp made_up{.n_rays = 2, .rays = rays, .n_marks = 1, .marks = marks, .temperature = 21.5};
  const hw_sample_t sample{sizeof(hw_sample_t), test::kMadeUpSample, 0, 9, 4, -10, 20, &made_up};
  const std::string before =
      sample_head("made_up") +
      R"(,"payload":{"temperature":21.5,"rays":[{"azimuth":0,"range":1.5},{"azimuth":-1,"range":0.1}])";
  EXPECT_EQ(json_of(sample), before + R"(,"marks":[1]}})");
  made_up.marks = nullptr;
  EXPECT_EQ(json_of(sample), before + "}}");
}

TEST(SampleJson, OfAnUnknownKindHasNoPayload) {
  Points one;
  one.sample.kind = 37;
  one.sample.payload = nullptr;
  EXPECT_EQ(json_of(one.sample), sample_head("kind 37") + "}");
  one.sample.kind = HW_SAMPLE_IMAGE;
  EXPECT_EQ(json_of(one.sample), sample_head("image") + "}") << "a number that is reserved";
}

TEST(FrameJson, HasItsSamplesInTheirOrder) {
  FrameBuilder builder;
  builder.begin(7, 700);
  EXPECT_EQ(frame_json(builder.finish()), R"({"sequence":7,"t_ns":700,"samples":[]})");
  builder.begin(8, 800);
  add_points(builder, 3) = {{1, 2, 3}};
  add_planes(builder, 5);
  const std::string built = frame_json(builder.finish());
  EXPECT_EQ(built, R"({"sequence":8,"t_ns":800,"samples":[)"
                   R"({"sensor":3,"kind":"points","sequence":8,"t_begin_ns":800,"t_end_ns":800,"flags":[],)"
                   R"("payload":{"points":[[1,2,3]]}},)"
                   R"({"sensor":5,"kind":"planes","sequence":8,"t_begin_ns":800,"t_end_ns":800,"flags":[],)"
                   R"("payload":{"sample":null,"planes":[],"hull_points":[],"members":[]}}]})");
  std::vector<std::byte> bytes;
  FrameWriter().write_over(bytes, builder.finish());
  FrameReader reader;
  EXPECT_EQ(frame_json(reader.read(bytes)), built) << "read from its bytes it says the same";
}

TEST(FrameJson, OfSamplesThatAReaderPassesOverHasTheirHeads) {
  FrameBuilder builder;
  builder.begin(8, 800);
  add_points(builder, 3) = {{1, 2, 3}};
  add_points(builder, 4);
  std::vector<std::byte> bytes;
  FrameWriter().write_over(bytes, builder.finish());
  // As if points were a kind of tomorrow: the first sample follows head, frame and table.
  store(bytes.data() + 24 + sizeof(hw_frame_t) + 2 * 8 + offsetof(hw_sample_t, kind), std::uint32_t{37});
  FrameReader reader;
  EXPECT_EQ(reader.read(bytes).n_samples, 1u);
  ASSERT_EQ(reader.passed_over().size(), 1u);
  EXPECT_EQ(reader.passed_over()[0].payload, nullptr);
  EXPECT_EQ(json_of(reader.passed_over()[0]),
            R"({"sensor":3,"kind":"kind 37","sequence":8,"t_begin_ns":800,"t_end_ns":800,"flags":[]})");
  FrameWriter().write_over(bytes, builder.finish());
  reader.read(bytes);
  EXPECT_TRUE(reader.passed_over().empty()) << "of the frame before";
}

/// Counts for each byte of a struct how many members say that it is theirs.
class Cover {
 public:
  explicit Cover(std::size_t size) : counts_(size) {}
  void add(std::size_t offset, std::size_t bytes) {
    ASSERT_LE(offset + bytes, counts_.size());
    for (std::size_t i = offset; i < offset + bytes; ++i) ++counts_[i];
  }
  void add(std::span<const PayloadMember> members) {
    for (const PayloadMember& member : members) {
      add(member.offset, number_bytes(member.type) * member.n * (member.lists == 0 ? 1 : member.lists));
    }
  }
  void expect_whole(const std::string& what) const {
    for (std::size_t i = 0; i < counts_.size(); ++i)
      EXPECT_EQ(counts_[i], 1) << "byte " << i << " of " << what;
  }

 private:
  std::vector<int> counts_;
};

TEST(SampleJson, ShowsEveryByteOfEveryKind) {
  ASSERT_GE(sample_kinds().size(), 3u) << "the made-up one, too";
  for (const SampleKind* kind : sample_kinds()) {
    Cover payload(kind->size);
    payload.add(0, sizeof(std::uint32_t));
    payload.add(kind->members);
    std::vector<std::size_t> counts;  // several arrays may have one count
    for (const PayloadArray& array : kind->arrays) {
      payload.add(array.data, sizeof(void*));
      if (array.stride != kNoMember) payload.add(array.stride, sizeof(std::uint32_t));
      if (std::find(counts.begin(), counts.end(), array.count) == counts.end())
        payload.add(array.count, sizeof(std::uint64_t));
      counts.push_back(array.count);
      Cover element(array.element_bytes);
      element.add(array.members);
      element.expect_whole(std::string("an element of ") + array.name);
    }
    payload.expect_whole(kind->payload);
  }
}

TEST(SampleJson, HasNoNameTwice) {
  for (const SampleKind* kind : sample_kinds()) {
    std::vector<std::string> names;
    for (const PayloadMember& member : kind->members) names.emplace_back(member.name);
    for (const PayloadArray& array : kind->arrays) {
      names.emplace_back(array.name);
      std::vector<std::string> of_element;
      for (const PayloadMember& member : array.members) of_element.emplace_back(member.name);
      std::sort(of_element.begin(), of_element.end());
      EXPECT_EQ(std::adjacent_find(of_element.begin(), of_element.end()), of_element.end()) << array.name;
      EXPECT_TRUE(of_element.size() == 1 || of_element.front() != "") << array.name;
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << kind->name;
    EXPECT_NE(names.front(), "") << kind->name;
  }
}

}  // namespace
}  // namespace hallway::host
