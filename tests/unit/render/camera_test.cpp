// SPDX-License-Identifier: MIT
#include "render/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "base/random.hpp"

namespace hallway::render {
namespace {

constexpr PixelRect kArea{16, 48, 1264, 756};

std::vector<Vec3> random_points(std::size_t count, double reach) {
  const Random random(11, stream_id("test.points"));
  std::vector<Vec3> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    out.emplace_back(random.uniform(i, 0, -reach, reach), random.uniform(i, 1, -reach, reach),
                     random.uniform(i, 2, -0.2 * reach, 0.2 * reach));
  }
  return out;
}

View perspective() {
  View view;
  view.kind = ViewKind::kPerspective;
  return view;
}

void expect_refused(const View& view) {
  try {
    make_camera(view, kArea, {});
    ADD_FAILURE() << "the view was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    EXPECT_FALSE(error.message().empty());
  }
}

class EitherKind : public testing::TestWithParam<ViewKind> {
 protected:
  View view() const {
    View out;
    out.kind = GetParam();
    return out;
  }
};

TEST_P(EitherKind, UnprojectInvertsProject) {
  const std::vector<Vec3> points = random_points(500, 40.0);
  const Camera camera = make_camera(view(), kArea, points);
  for (const Vec3& point : points) {
    const auto screen = camera.project(point);
    ASSERT_TRUE(screen);
    EXPECT_LT((camera.unproject(*screen) - point).norm(), 1e-9);
  }
}

TEST_P(EitherKind, AutomaticFramingFitsTheContentTightly) {
  const std::vector<Vec3> points = random_points(500, 40.0);
  const Camera camera = make_camera(view(), kArea, points);
  Eigen::AlignedBox2d reach;
  for (const Vec3& point : points) reach.extend(camera.project(point)->pixel);
  EXPECT_GT(reach.min().x(), kArea.left);
  EXPECT_GT(reach.min().y(), kArea.top);
  EXPECT_LT(reach.max().x(), kArea.right);
  EXPECT_LT(reach.max().y(), kArea.bottom);
  EXPECT_GT(std::max(reach.sizes().x() / kArea.width(), reach.sizes().y() / kArea.height()), 0.88);
}

TEST_P(EitherKind, NothingAndASinglePointStillMakeACamera) {
  EXPECT_TRUE(make_camera(view(), kArea, {}).project(Vec3::Zero()));
  const std::vector<Vec3> one{{5.0, 6.0, 7.0}};
  const Camera camera = make_camera(view(), kArea, one);
  EXPECT_LT((camera.project(one[0])->pixel - Vec2(640.0, 402.0)).norm(), 1e-6);
}

TEST_P(EitherKind, PointsThatAreNotFiniteHaveNoPlace) {
  const Camera camera = make_camera(view(), kArea, {});
  EXPECT_FALSE(camera.project({std::nan(""), 0.0, 0.0}));
  EXPECT_FALSE(camera.project({0.0, std::numeric_limits<double>::infinity(), 0.0}));
  EXPECT_FALSE(camera.project({0.0, 0.0, 1e300}));
}

INSTANTIATE_TEST_SUITE_P(Camera, EitherKind, testing::Values(ViewKind::kTop, ViewKind::kPerspective));

TEST(Camera, TopViewIsAMap) {
  View view;
  view.crop = Crop{{10.0, 20.0}, 12.48};
  const Camera camera = make_camera(view, kArea, {});
  EXPECT_DOUBLE_EQ(camera.pixels_per_metre(1.0), 100.0);
  EXPECT_LT((camera.project({10.0, 20.0, 3.0})->pixel - Vec2(640.0, 402.0)).norm(), 1e-9);
  EXPECT_LT((camera.project({11.0, 20.0, 3.0})->pixel - Vec2(740.0, 402.0)).norm(), 1e-9);
  EXPECT_LT((camera.project({10.0, 21.0, 3.0})->pixel - Vec2(640.0, 302.0)).norm(), 1e-9);
}

TEST(Camera, PerspectiveLooksAtItsTarget) {
  View view = perspective();
  view.eye = Vec3(1.0, 2.0, 3.0);
  view.target = Vec3(-4.0, 7.0, 1.0);
  const Camera camera = make_camera(view, kArea, {});
  EXPECT_LT((camera.project(*view.target)->pixel - Vec2(640.0, 402.0)).norm(), 1e-9);
  EXPECT_LT(camera.project(*view.target + Vec3(0.0, 0.0, 0.1))->pixel.y(), 402.0) << "up is up";
  EXPECT_FALSE(camera.project(*view.eye - (*view.target - *view.eye))) << "behind the eye";
}

TEST(Camera, AngleOfViewSpansTheHeight) {
  View view = perspective();
  view.eye = Vec3::Zero();
  view.target = Vec3::UnitX();
  view.vertical_fov = 1.0;
  const Camera camera = make_camera(view, kArea, {});
  EXPECT_NEAR(camera.project({1.0, 0.0, std::tan(0.5)})->pixel.y(), kArea.top, 1e-9);
  EXPECT_NEAR(camera.project({1.0, 0.0, -std::tan(0.5)})->pixel.y(), kArea.bottom, 1e-9);
}

TEST(Camera, StraightDownKeepsXToTheRight) {
  View view = perspective();
  view.eye = Vec3(0.0, 0.0, 10.0);
  view.target = Vec3::Zero();
  const Camera camera = make_camera(view, kArea, {});
  EXPECT_GT(camera.project({1.0, 0.0, 0.0})->pixel.x(), 641.0);
  EXPECT_LT(camera.project({0.0, 1.0, 0.0})->pixel.y(), 401.0);
}

TEST(Camera, RefusesAnEyeWithoutTarget) {
  View view = perspective();
  view.eye = Vec3::Zero();
  expect_refused(view);
}

TEST(Camera, RefusesAnEyeAtItsTarget) {
  View view = perspective();
  view.eye = view.target = Vec3(1.0, 1.0, 1.0);
  expect_refused(view);
}

TEST(Camera, RefusesNumbersThatAreNotFinite) {
  View view = perspective();
  view.eye = Vec3(std::nan(""), 0.0, 0.0);
  view.target = Vec3::UnitX();
  expect_refused(view);
  view = View{};
  view.cut_z_m = std::nan("");
  expect_refused(view);
  view = View{};
  view.crop = Crop{{0.0, std::nan("")}, 1.0};
  expect_refused(view);
}

TEST(Camera, RefusesAnAngleOfViewThatShowsNothing) {
  for (const double angle : {0.0, -1.0, 3.1415926535897931, 1e9, std::nan("")}) {
    View view = perspective();
    view.vertical_fov = angle;
    expect_refused(view);
  }
}

TEST(Camera, RefusesACropWithoutWidth) {
  for (const double width : {0.0, -1.0, 1e12, std::nan("")}) {
    View view;
    view.crop = Crop{{0.0, 0.0}, width};
    expect_refused(view);
  }
}

}  // namespace
}  // namespace hallway::render
