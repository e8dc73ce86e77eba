// SPDX-License-Identifier: MIT
#include "render/draw.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "render/png.hpp"
#include "unit/render/scenes.hpp"

namespace hallway::render {
namespace {

constexpr int kWidth = 420;
constexpr int kHeight = 320;
constexpr Rgb kRed{210, 60, 50};
constexpr Rgb kBlue{40, 80, 200};

int difference(Rgb a, Rgb b) {
  return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
}

View perspective() {
  View view;
  view.kind = ViewKind::kPerspective;
  return view;
}

View looking(const Vec3& eye, const Vec3& target) {
  View view = perspective();
  view.eye = eye;
  view.target = target;
  return view;
}

View top_over(double x, double y, double width_m) {
  View view;
  view.crop = Crop{{x, y}, width_m};
  return view;
}

/// The pixel on which a world point falls.
Rgb pixel_at(const Picture& picture, const View& view, const Vec3& world) {
  const auto at = picture_camera(picture, view, kWidth, kHeight).project(world);
  EXPECT_TRUE(at);
  const Image image = draw(picture, view, kWidth, kHeight);
  return image.at(static_cast<int>(at->pixel.x()), static_cast<int>(at->pixel.y()));
}

/// Whether the colour has the hue of a lit face of colour `base`: each channel scaled by one factor.
bool is_lit(Rgb seen, Rgb base) {
  const double factor = (seen.r + seen.g + seen.b) / static_cast<double>(base.r + base.g + base.b);
  const auto near = [factor](int a, int b) { return std::abs(a - factor * b) < 8.0; };
  return factor > 0.5 && factor < 1.06 && near(seen.r, base.r) && near(seen.g, base.g) &&
         near(seen.b, base.b);
}

Picture one_line(double width_px = 5.0) {
  Picture picture;
  picture.polylines.push_back({{{-5.0, 0.0, 0.0}, {5.0, 0.0, 0.0}}, palette::kTruth, width_px});
  return picture;
}

/// A red box stands between a viewer at -y and a blue one.
Picture two_boxes() {
  Picture picture;
  test::add_box(picture.surfaces, {-1.0, 4.0, -1.0}, {1.0, 6.0, 1.0}, kBlue);
  test::add_box(picture.surfaces, {-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0}, kRed);
  return picture;
}

/// A closed room 8 m by 6 m with walls 0.5 m thick that overlap in the corners.
Picture room() {
  Picture picture;
  std::vector<Surface>& s = picture.surfaces;
  test::add_box(s, {0.0, 0.0, -0.5}, {8.0, 6.0, 0.0}, kRed);
  test::add_box(s, {0.0, 0.0, 3.0}, {8.0, 6.0, 3.5}, kBlue);
  test::add_box(s, {0.0, 0.0, 0.0}, {0.5, 6.0, 3.0}, {220, 220, 220});
  test::add_box(s, {7.5, 0.0, 0.0}, {8.0, 6.0, 3.0}, {220, 220, 220});
  test::add_box(s, {0.0, 0.0, 0.0}, {8.0, 0.5, 3.0}, {220, 220, 220});
  test::add_box(s, {0.0, 5.5, 0.0}, {8.0, 6.0, 3.0}, {220, 220, 220});
  return picture;
}

TEST(Draw, LineHasItsColourWhereItRuns) {
  const View view = top_over(0.0, 0.0, 12.0);
  EXPECT_EQ(pixel_at(one_line(), view, {2.43, 0.0, 0.0}), palette::kTruth);
  EXPECT_EQ(pixel_at(one_line(), view, {2.43, 0.7, 0.0}), palette::kPaper);
}

TEST(Draw, LineIsAsWideAsItSays) {
  const Picture picture = one_line(10.0);
  const View view = top_over(0.0, 0.0, 12.0);
  const Vec2 at = picture_camera(picture, view, kWidth, kHeight).project({2.43, 0.0, 0.0})->pixel;
  const Image image = draw(picture, view, kWidth, kHeight);
  double width = 0.0;
  for (int y = static_cast<int>(at.y()) - 20; y < static_cast<int>(at.y()) + 20; ++y) {
    const Rgb seen = image.at(static_cast<int>(at.x()), y);
    width += std::max(
        0.0, (palette::kPaper.r - seen.r) / static_cast<double>(palette::kPaper.r - palette::kTruth.r));
  }
  EXPECT_NEAR(width, 10.0, 0.6);
}

TEST(Draw, DashedLineHasGaps) {
  Picture picture = one_line();
  picture.polylines[0].dashed = true;
  const View view = top_over(0.0, 0.0, 12.0);
  const Camera camera = picture_camera(picture, view, kWidth, kHeight);
  const Image image = draw(picture, view, kWidth, kHeight);
  const int y = static_cast<int>(camera.project(Vec3::Zero())->pixel.y());
  int line = 0;
  int gap = 0;
  for (int x = static_cast<int>(camera.project({-4.9, 0.0, 0.0})->pixel.x());
       x < static_cast<int>(camera.project({4.9, 0.0, 0.0})->pixel.x()); ++x) {
    line += image.at(x, y) == palette::kTruth ? 1 : 0;
    gap += difference(image.at(x, y), palette::kPaper) < 80 ? 1 : 0;
  }
  EXPECT_GT(line, 100);
  EXPECT_GT(gap, 50);
}

TEST(Draw, MarksStandAtTheirPlaces) {
  for (const MarkerShape shape :
       {MarkerShape::kDot, MarkerShape::kCross, MarkerShape::kDiamond, MarkerShape::kSquare,
        MarkerShape::kSquareWithCircle, MarkerShape::kSquareWithTriangle}) {
    Picture picture;
    picture.markers.push_back({{{1.0, 2.0, 0.0}, {-3.0, 1.0, 0.0}}, shape, palette::kEstimate, 10.0});
    for (const Vec3& place : picture.markers[0].positions) {
      EXPECT_LT(difference(pixel_at(picture, top_over(0.0, 0.0, 12.0), place), palette::kEstimate), 40);
    }
  }
}

TEST(Draw, RingIsEmptyInside) {
  Picture picture;
  picture.markers.push_back({{{1.13, 2.17, 0.0}}, MarkerShape::kRing, palette::kTruth, 16.0});
  EXPECT_EQ(difference(pixel_at(picture, top_over(0.0, 0.0, 12.0), {1.13, 2.17, 0.0}), palette::kPaper), 0);
}

TEST(Draw, SquaresHaveACircleOrATriangleInside) {
  const View view = top_over(0.0, 0.0, 12.0);
  const Vec3 place(1.13, 2.17, 0.0);
  for (const MarkerShape shape : {MarkerShape::kSquareWithCircle, MarkerShape::kSquareWithTriangle}) {
    Picture picture;
    picture.markers.push_back({{place}, shape, palette::kTruth, 80.0});
    const Camera camera = picture_camera(picture, view, kWidth, kHeight);
    const Image image = draw(picture, view, kWidth, kHeight);
    const Vec2 middle = camera.project(place)->pixel;
    const auto is_painted = [&](double right, double down) {
      return difference(image.at(static_cast<int>(middle.x() + right), static_cast<int>(middle.y() + down)),
                        palette::kTruth) < 40;
    };
    for (const double side : {-30.0, 30.0}) {
      EXPECT_TRUE(is_painted(side, 0) && is_painted(0, side) && is_painted(side, side)) << "the rim";
      EXPECT_FALSE(is_painted(0.7 * side, -0.7 * side)) << "a gap";
    }
    const bool is_circle = shape == MarkerShape::kSquareWithCircle;
    EXPECT_EQ(is_painted(-9, -9), is_circle) << "beside the top of the triangle";
    EXPECT_EQ(is_painted(13, 11), !is_circle) << "the right corner of the triangle";
  }
}

TEST(Draw, CrossingLinesOfABundleDoNotAddUp) {
  Picture picture;
  picture.segments.push_back(
      {{{{Vec3(-2.6, -2.7, 0), Vec3(3.4, 3.3, 0)}}, {{Vec3(-2.6, 3.3, 0), Vec3(3.4, -2.7, 0)}}},
       palette::kError,
       6.0,
       0.5});
  const View view = top_over(0.0, 0.0, 12.0);
  const Rgb crossing = pixel_at(picture, view, {0.4, 0.3, 0.0});
  EXPECT_EQ(crossing, pixel_at(picture, view, {1.5, 1.4, 0.0}));
  EXPECT_EQ(crossing, mix(palette::kPaper, palette::kError, 0.5));
}

TEST(Draw, NearerFaceHidesTheFartherOne) {
  EXPECT_TRUE(
      is_lit(pixel_at(two_boxes(), looking({0.0, -10.0, 0.0}, {0.0, 5.0, 0.0}), {0.0, 0.0, 0.0}), kRed));
  EXPECT_TRUE(
      is_lit(pixel_at(two_boxes(), looking({0.0, 20.0, 0.0}, {0.0, 5.0, 0.0}), {0.0, 6.0, 0.0}), kBlue));
}

TEST(Draw, FacesOfABoxAreLitDifferently) {
  const View view = looking({-8.0, -9.0, 7.0}, {0.0, 1.0, 0.0});
  const Rgb front = pixel_at(two_boxes(), view, {0.3, 0.0, 0.0});
  const Rgb top = pixel_at(two_boxes(), view, {0.3, 1.0, 1.0});
  const Rgb side = pixel_at(two_boxes(), view, {-1.0, 1.0, 0.0});
  EXPECT_GT(difference(front, top), 8);
  EXPECT_GT(difference(top, side), 20);
  EXPECT_GT(difference(front, side), 12);
}

TEST(Draw, HiddenLineIsFaint) {
  const View view = looking({0.0, -10.0, 0.0}, {0.0, 5.0, 0.0});
  const Rgb bare = pixel_at(two_boxes(), view, {0.0, 0.0, 0.1});
  Picture hidden = two_boxes();
  hidden.polylines.push_back({{{-3.0, 3.0, 0.13}, {3.0, 3.0, 0.13}}, palette::kTruth, 6.0});
  Picture open = two_boxes();
  open.polylines.push_back({{{-3.0, -0.5, 0.095}, {3.0, -0.5, 0.095}}, palette::kTruth, 6.0});
  const Rgb behind = pixel_at(hidden, view, {0.0, 3.0, 0.13});
  const Rgb before = pixel_at(open, view, {0.0, -0.5, 0.095});
  EXPECT_EQ(before, palette::kTruth);
  EXPECT_GT(difference(behind, bare), 20);
  EXPECT_LT(difference(behind, bare), difference(behind, palette::kTruth));
}

TEST(Draw, MarkOnAFaceIsNotHidden) {
  Picture picture = two_boxes();
  picture.markers.push_back({{{0.2, -0.001, 0.1}}, MarkerShape::kDot, palette::kTruth, 9.0});
  EXPECT_EQ(pixel_at(picture, looking({-6.0, -7.0, 4.0}, {0.0, 1.0, 0.0}), {0.2, -0.001, 0.1}),
            palette::kTruth);
}

TEST(Draw, TopViewShowsLinesBeforeFaces) {
  Picture picture = two_boxes();
  picture.polylines.push_back({{{-3.0, 1.0, -5.0}, {3.0, 1.0, -5.0}}, palette::kTruth, 6.0});
  EXPECT_EQ(pixel_at(picture, top_over(0.0, 3.0, 12.0), {0.0, 1.0, -5.0}), palette::kTruth);
}

TEST(Draw, ClosedRoomShowsItsRoof) {
  EXPECT_TRUE(is_lit(pixel_at(room(), top_over(4.0, 3.0, 10.0), {4.0, 3.0, 3.5}), kBlue));
}

TEST(Draw, CutShowsTheInsideOfARoom) {
  View view = top_over(4.0, 3.0, 10.0);
  view.cut_z_m = 1.5;
  EXPECT_TRUE(is_lit(pixel_at(room(), view, {4.0, 3.0, 0.0}), kRed));
}

TEST(Draw, CutSolidsAreDark) {
  for (View view : {top_over(4.0, 3.0, 10.0), looking({3.9, -4.0, 9.0}, {4.0, 3.0, 0.0})}) {
    view.cut_z_m = 1.5;
    const Image image = draw(room(), view, kWidth, kHeight);
    const Camera camera = picture_camera(room(), view, kWidth, kHeight);
    const Vec3 overlap(0.25, 0.25, 1.5);
    for (const Vec3& inside : {Vec3(0.25, 3.0, 1.5), Vec3(4.0, 5.75, 1.5), Vec3(7.75, 1.0, 1.5), overlap}) {
      const Vec2 at = camera.project(inside)->pixel;
      EXPECT_EQ(image.at(static_cast<int>(at.x()), static_cast<int>(at.y())), palette::kCut)
          << inside.transpose();
    }
  }
}

TEST(Draw, CutBelowEverythingShowsNoFace) {
  View view = top_over(4.0, 3.0, 10.0);
  view.cut_z_m = -2.0;
  EXPECT_LT(difference(pixel_at(room(), view, {4.1, 3.1, 0.0}), palette::kPaper), 40);
}

TEST(Draw, CutLeavesLinesAlone) {
  Picture picture = room();
  picture.polylines.push_back({{{1.0, 3.0, 2.5}, {7.0, 3.0, 2.5}}, palette::kTruth, 6.0});
  View view = top_over(4.0, 3.0, 10.0);
  view.cut_z_m = 1.5;
  EXPECT_EQ(pixel_at(picture, view, {4.0, 3.0, 2.5}), palette::kTruth);
}

TEST(Draw, CornersAreDarkerThanTheOpenFloor) {
  View view = top_over(4.0, 3.0, 10.0);
  view.cut_z_m = 1.5;
  const Rgb open = pixel_at(room(), view, {4.0, 3.0, 0.0});
  const Rgb corner = pixel_at(room(), view, {0.6, 0.6, 0.0});
  EXPECT_LT(corner.r + 15, open.r);
}

TEST(Draw, FieldOfViewTintsWhatItCovers) {
  Picture picture = one_line();
  picture.frustums = {FrustumMark{Pose{}, 1.0, 0.6, 4.0, palette::kSensor, ""}};
  const View view = top_over(0.0, 0.0, 12.0);
  EXPECT_EQ(pixel_at(picture, view, {3.0, 0.6, 0.0}), mix(palette::kPaper, palette::kSensor, 0.13));
  EXPECT_LT(difference(pixel_at(picture, view, {3.0, 2.4, 0.0}), palette::kPaper), 40);
  EXPECT_LT(difference(pixel_at(picture, view, {-3.0, 0.6, 0.0}), palette::kPaper), 40);
}

TEST(Draw, FieldOfViewAllAroundCoversBothSides) {
  Picture picture = one_line();
  picture.frustums = {FrustumMark{Pose{}, 6.4, 0.6, 4.0, palette::kSensor, ""}};
  const View view = top_over(0.0, 0.0, 12.0);
  const Rgb tinted = mix(palette::kPaper, palette::kSensor, 0.13);
  EXPECT_EQ(pixel_at(picture, view, {2.5, 0.9, 0.0}), tinted);
  EXPECT_EQ(pixel_at(picture, view, {-2.5, -0.9, 0.0}), tinted);
}

/// Number of dark pixels within `reach` pixels of a world point.
int ink_near(const Picture& picture, const View& view, const Vec3& world, int reach) {
  const Vec2 at = picture_camera(picture, view, kWidth, kHeight).project(world)->pixel;
  const Image image = draw(picture, view, kWidth, kHeight);
  int count = 0;
  for (int y = static_cast<int>(at.y()) - reach; y <= static_cast<int>(at.y()) + reach; ++y) {
    for (int x = static_cast<int>(at.x()) - reach; x <= static_cast<int>(at.x()) + reach; ++x) {
      count += difference(image.at(x, y), palette::kInk) < 60 ? 1 : 0;
    }
  }
  return count;
}

TEST(Draw, LabelIsWrittenAtItsPlace) {
  Picture picture = one_line();
  const View view = top_over(0.0, 0.0, 12.0);
  EXPECT_EQ(ink_near(picture, view, {1.0, 2.0, 0.0}, 40), 0);
  picture.labels.push_back({{1.0, 2.0, 0.0}, "start"});
  EXPECT_GT(ink_near(picture, view, {1.0, 2.0, 0.0}, 40), 30);
}

TEST(Draw, LabelsOfOnePlaceAvoidEachOther) {
  Picture picture = one_line();
  const View view = top_over(0.0, 0.0, 12.0);
  picture.labels.push_back({{1.0, 2.0, 0.0}, "HHHH"});
  const int one = ink_near(picture, view, {1.0, 2.0, 0.0}, 60);
  picture.labels.push_back({{1.0, 2.0, 0.0}, "HHHH"});
  EXPECT_NEAR(ink_near(picture, view, {1.0, 2.0, 0.0}, 60), 2 * one, 4);
}

TEST(Draw, TitleIsWritten) {
  const View view = top_over(0.0, 0.0, 12.0);
  const auto header_ink = [&](const Picture& picture) {
    const Image image = draw(picture, view, kWidth, kHeight);
    int count = 0;
    for (int y = 0; y < map_area(picture, kWidth, kHeight).top - 2; ++y) {
      for (int x = 0; x < kWidth / 2; ++x) count += difference(image.at(x, y), palette::kInk) < 60 ? 1 : 0;
    }
    return count;
  };
  Picture picture = one_line();
  EXPECT_EQ(header_ink(picture), 0);
  picture.title = "figure_eight";
  EXPECT_GT(header_ink(picture), 100);
}

TEST(Draw, PlacesThatAreNotFiniteAreSkipped) {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  Picture clean = two_boxes();
  clean.polylines.push_back({{{-2.0, -1.0, 0.0}, {2.0, -1.0, 0.0}}, palette::kTruth, 3.0});
  clean.markers.push_back({{{0.0, -2.0, 0.0}}, MarkerShape::kDot, palette::kEstimate, 6.0});
  clean.segments.push_back({{{{Vec3(0, -3, 0), Vec3(1, -3, 0)}}}, palette::kError});
  Picture dirty = clean;
  dirty.surfaces.push_back(dirty.surfaces[0]);
  dirty.surfaces.back().polygon.vertices[1].x() = nan;
  dirty.surfaces.push_back({});
  dirty.polylines[0].points.insert(dirty.polylines[0].points.begin(), {nan, 0.0, 0.0});
  dirty.polylines[0].points.push_back({inf, 0.0, 0.0});
  dirty.markers[0].positions.push_back({0.0, nan, 0.0});
  dirty.markers[0].positions.push_back({0.0, 1e300, 0.0});
  dirty.segments[0].pairs.push_back({Vec3(0, 0, 0), Vec3(nan, 0, 0)});
  dirty.labels.push_back({{nan, nan, nan}, "nowhere"});
  for (const View& view : {View{}, perspective()}) {
    EXPECT_EQ(draw(clean, view, kWidth, kHeight).bytes, draw(dirty, view, kWidth, kHeight).bytes);
  }
}

TEST(Draw, OneStrayLandmarkDoesNotShrinkTheRest) {
  Picture picture = test::figure_eight();
  picture.frustums.clear();
  const double scale = picture_camera(picture, {}, kWidth, kHeight).scale();
  picture.markers.back().positions.push_back({1e6, 1e6, 0.0});
  EXPECT_NEAR(picture_camera(picture, {}, kWidth, kHeight).scale(), scale, 0.01 * scale);
}

TEST(Draw, RefusesSizesBeforeAnythingElse) {
  EXPECT_THROW(draw(one_line(), {}, 0, 0), Error);
  EXPECT_THROW(draw(one_line(), {}, 100000, 100000), Error);
  EXPECT_THROW(draw(one_line(), {}, -5, 10), Error);
}

TEST(Draw, SmallestPicturesAndStripsWork) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {300, 1}, {241, 181}}) {
    for (const View& view : {View{}, perspective()}) {
      const Image image = draw(room(), view, width, height);
      EXPECT_EQ(image.bytes.size(), 3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    }
  }
}

TEST(Draw, LargePicturesAreDrawnInTiles) {
  Picture picture = room();
  View view = top_over(4.0, 3.0, 10.0);
  view.cut_z_m = 1.5;
  constexpr int kLargeWidth = 1100;
  constexpr int kLargeHeight = 800;
  const Image image = draw(picture, view, kLargeWidth, kLargeHeight);
  const Camera camera = picture_camera(picture, view, kLargeWidth, kLargeHeight);
  const auto seen = [&](const Vec3& world) {
    const Vec2 at = camera.project(world)->pixel;
    return image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  };
  for (double x = 1.2; x < 7.0; x += 0.37) {
    for (double y = 1.2; y < 5.0; y += 0.37) EXPECT_TRUE(is_lit(seen({x, y, 0.0}), kRed)) << x << " " << y;
  }
  for (double x = 0.1; x < 8.0; x += 0.37) EXPECT_EQ(seen({x, 0.25, 1.5}), palette::kCut) << x;
}

TEST(Draw, NothingToDrawIsStillAPicture) {
  for (const View& view : {View{}, perspective()}) {
    Picture picture;
    EXPECT_NO_THROW(draw(picture, view, kWidth, kHeight));
    picture.surfaces.push_back({});
    EXPECT_NO_THROW(draw(picture, view, kWidth, kHeight));
  }
}

TEST(Draw, EyeInAWallSeesOutOfIt) {
  const Rgb seen = pixel_at(room(), looking({0.25, 3.0, 1.0}, {7.5, 3.0, 1.0}), {7.5, 3.05, 1.0});
  EXPECT_TRUE(is_lit(seen, {220, 220, 220}));
}

TEST(Draw, EyeStraightAboveWorks) {
  View view = looking({4.0, 3.0, 12.0}, {4.0, 3.0, 0.0});
  view.cut_z_m = 1.5;
  EXPECT_TRUE(is_lit(pixel_at(room(), view, {4.0, 3.0, 0.0}), kRed));
}

TEST(Draw, LinesThroughTheEyeDoNotSpillOver) {
  Picture picture;
  picture.polylines.push_back({{{-50.0, 0.0, 1.0}, {50.0, 0.0, 1.0}}, palette::kTruth, 3.0});
  const View view = looking({0.0, 0.0, 1.0}, {10.0, 1.0, 1.0});
  const Image image = draw(picture, view, kWidth, kHeight);
  int painted = 0;
  for (int y = 45; y < kHeight - 60; ++y) {
    for (int x = 20; x < kWidth - 20; ++x) painted += image.at(x, y) == palette::kTruth ? 1 : 0;
  }
  EXPECT_GT(painted, 0);
  EXPECT_LT(painted, 100);
}

TEST(Draw, GalleryPicturesStaySmall) {
  constexpr std::size_t kMostBytes = 300 * 1000;
  View open = perspective();
  open.cut_z_m = 1.9;
  EXPECT_LT(encode_png(draw(test::office(), open, 1280, 800)).size(), kMostBytes);
  EXPECT_LT(encode_png(draw(test::figure_eight(), View{}, 1280, 800)).size(), kMostBytes);
  EXPECT_LT(encode_png(draw(test::figure_eight(), perspective(), 1280, 800)).size(), kMostBytes);
}

std::string office_hash(Renderer renderer = Renderer::kAuto) {
  View view = perspective();
  view.renderer = renderer;
  view.cut_z_m = 1.9;
  const Image image = draw(test::office(), view, kWidth, kHeight);
  return content_hash({reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size()});
}

TEST(Draw, SameInputGivesSameBytes) {
  EXPECT_EQ(office_hash(), office_hash());
}

/// Runs in a process of its own: sets a variable that Mesa reads once, draws, and reports on stderr.
[[noreturn]] void draw_with(const char* name, const char* value, Renderer renderer = Renderer::kAuto) {
  setenv(name, value, 1);
  std::string report;
  try {
    report = office_hash(renderer);
  } catch (const Error& error) {
    report = std::string(error_code_name(error.code())) + ": " + error.message();
  }
  std::fprintf(stderr, "%s\n", report.c_str());
  std::_Exit(0);
}

class DrawElsewhere : public testing::Test {
 protected:
  DrawElsewhere() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(DrawElsewhere, BytesDoNotDependOnTheNumberOfThreads) {
  for (const Renderer renderer : {Renderer::kOsmesa, Renderer::kEgl}) {
    std::string expected;
    try {
      expected = office_hash(renderer);
    } catch (const NoRenderer&) {
      continue;  // the tests of renderers say which are not there
    }
    EXPECT_EXIT(draw_with("LP_NUM_THREADS", "0", renderer), testing::ExitedWithCode(0), expected);
    EXPECT_EXIT(draw_with("LP_NUM_THREADS", "5", renderer), testing::ExitedWithCode(0), expected);
  }
}

TEST_F(DrawElsewhere, ABogusDisplayDoesNotMatter) {
  const std::string expected = office_hash();
  EXPECT_EXIT(draw_with("DISPLAY", "nowhere:99"), testing::ExitedWithCode(0), expected);
}

TEST_F(DrawElsewhere, WithoutAUsableContextTheErrorSaysSo) {
  EXPECT_EXIT(draw_with("MESA_GL_VERSION_OVERRIDE", "2.1"), testing::ExitedWithCode(0),
              "io: no picture can be drawn: ");
}

}  // namespace
}  // namespace hallway::render
