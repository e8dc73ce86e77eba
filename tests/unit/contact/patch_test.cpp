// SPDX-License-Identifier: MIT
#include "contact/patch.hpp"

#include <gtest/gtest.h>

#include "geom/box.hpp"

namespace hallway::contact {
namespace {

/// At x = 1, looked at from the origin; from y = -9 to 9, and as high as `top` at y = 0 and less beside.
Triangle wall(double top) {
  return {Vec3(1, -9, 0), Vec3(1, 9, 0), Vec3(1, 0, top)};
}

Box box_of(const std::vector<Vec3>& points) {
  Box box;
  for (const Vec3& point : points) box.extend(point);
  return box;
}

const BodyShape kBox = BodyShape::box({-0.3, -0.1, 0.05}, {0.3, 0.1, 0.4});
const Vec3 kNormal = -Vec3::UnitX();

TEST(ContactPatch, AFlatSideAtAWallIsAnArea) {
  const Pose pose{Quat::Identity(), Vec3(0.7, 0.5, 0)};
  const Box area = box_of(contact_patch(kBox, pose, wall(100), Vec3(1, 0.5, 0.4), kNormal));
  EXPECT_LT((area.min() - Vec3(1, 0.4, 0.05)).norm(), 1e-12);
  EXPECT_LT((area.max() - Vec3(1, 0.6, 0.4)).norm(), 1e-12);
}

TEST(ContactPatch, ALowWallIsTouchedUpToItsTop) {
  const Pose pose{Quat::Identity(), Vec3(0.7, 0, 0)};
  const Box area = box_of(contact_patch(kBox, pose, wall(0.2), Vec3(1, 0, 0.1), kNormal));
  EXPECT_NEAR(area.min().z(), 0.05, 1e-12);
  EXPECT_NEAR(area.max().z(), 0.2, 1e-12);
}

TEST(ContactPatch, ACornerIsALineAndACylinderToo) {
  const Pose turned{from_yaw_pitch_roll(0.3, 0, 0),
                    Vec3(1.0 - kBox.extent(Vec3(std::cos(0.3), -std::sin(0.3), 0)), 0, 0)};
  const Vec3 corner = turned * Vec3(0.3, -0.1, 0.2);
  EXPECT_NEAR(corner.x(), 1.0, 1e-12);
  for (const auto& [shape, pose, at] :
       {std::tuple(kBox, turned, corner),
        std::tuple(BodyShape::cylinder(0.2, 0.05, 0.4), Pose{Quat::Identity(), Vec3(0.8, 2, 0)},
                   Vec3(1, 2, 0.4))}) {
    const Box line = box_of(contact_patch(shape, pose, wall(100), at, kNormal));
    EXPECT_LT((line.min() - Vec3(1, at.y(), 0.05)).norm(), 1e-9);
    EXPECT_LT((line.max() - Vec3(1, at.y(), 0.4)).norm(), 1e-9);
  }
}

TEST(ContactPatch, ATriangleWithoutAreaGivesThePoint) {
  const Triangle thin{Vec3(1, 0, 0), Vec3(1, 0, 1), Vec3(1, 0, 2)};
  const Vec3 point(1, 0, 0.3);
  EXPECT_EQ(contact_patch(kBox, {Quat::Identity(), Vec3(0.7, 0, 0)}, thin, point, kNormal),
            std::vector<Vec3>{point});
}

}  // namespace
}  // namespace hallway::contact
