// SPDX-License-Identifier: MIT
#include "map/convex_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace hallway::map {
namespace {

constexpr double kReach = 1e4;
constexpr double kTolerance = 1e-9;

std::vector<Plane> unit_cube() {
  std::vector<Plane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) planes.push_back({sign * Vec3::Unit(axis), 1.0});
  }
  return planes;
}

ConvexBody body_of(const std::vector<Plane>& planes) {
  const auto result = intersect_half_spaces(planes, kReach, kTolerance);
  if (const auto* body = std::get_if<ConvexBody>(&result)) return *body;
  ADD_FAILURE() << "no body";
  return {};
}

void expect_fault(const std::vector<Plane>& planes, ConvexFault fault) {
  const auto result = intersect_half_spaces(planes, kReach, kTolerance);
  ASSERT_TRUE(std::holds_alternative<ConvexFault>(result));
  EXPECT_EQ(std::get<ConvexFault>(result), fault);
}

/// Vertices, edges and sides of a body of genus 0.
void expect_euler(const ConvexBody& body) {
  std::size_t corners = 0;
  for (const ConvexBody::Side& side : body.sides) corners += side.loop.size();
  EXPECT_EQ(body.vertices.size() + body.sides.size(), corners / 2 + 2);
}

TEST(ConvexBody, CubeHasEightExactVertices) {
  const ConvexBody body = body_of(unit_cube());
  EXPECT_EQ(body.sides.size(), 6u);
  ASSERT_EQ(body.vertices.size(), 8u);
  for (const Vec3& vertex : body.vertices) EXPECT_EQ(vertex.cwiseAbs(), Vec3::Ones());
  expect_euler(body);
}

TEST(ConvexBody, ACornerCutOffAddsATriangle) {
  std::vector<Plane> planes = unit_cube();
  planes.push_back({Vec3::Ones().normalized(), 2.0 / std::sqrt(3.0)});
  const ConvexBody body = body_of(planes);
  ASSERT_EQ(body.sides.size(), 7u);
  EXPECT_EQ(body.sides[6].plane, 6u);
  EXPECT_EQ(body.sides[6].loop.size(), 3u);
  EXPECT_EQ(body.vertices.size(), 10u);
  expect_euler(body);
}

TEST(ConvexBody, APlaneThroughFourVerticesNeedsNoNewOnes) {
  std::vector<Plane> planes = unit_cube();
  planes.push_back({Vec3(1, 1, 0).normalized(), 0.0});
  const ConvexBody body = body_of(planes);
  EXPECT_EQ(body.sides.size(), 5u);
  EXPECT_EQ(body.vertices.size(), 6u);
  expect_euler(body);
}

TEST(ConvexBody, ManyPlanesMeetInTheTopOfAPyramid) {
  constexpr int kSides = 64;
  std::vector<Plane> planes{{-Vec3::UnitZ(), 0.0}};
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    const Vec3 normal = Vec3(std::cos(angle), std::sin(angle), 1.0).normalized();
    planes.push_back({normal, normal.z()});
  }
  const ConvexBody body = body_of(planes);
  EXPECT_EQ(body.sides.size(), planes.size());
  EXPECT_EQ(body.vertices.size(), kSides + 1u);
  expect_euler(body);
}

TEST(ConvexBody, PlanesThatTouchAVertexOrAnEdgeOrNothingHaveNoSide) {
  std::vector<Plane> planes = unit_cube();
  planes.push_back({Vec3::Ones().normalized(), std::sqrt(3.0)});
  planes.push_back({Vec3(1, 1, 0).normalized(), std::sqrt(2.0)});
  planes.push_back({Vec3::UnitX(), 7.0});
  const ConvexBody body = body_of(planes);
  EXPECT_EQ(body.sides.size(), 6u);
  expect_euler(body);
}

TEST(ConvexBody, NothingBehindAllPlanes) {
  std::vector<Plane> planes = unit_cube();
  planes.push_back({Vec3::UnitX(), -2.0});
  expect_fault(planes, ConvexFault::kEmpty);
}

TEST(ConvexBody, NoThickness) {
  std::vector<Plane> planes = unit_cube();
  planes.push_back({Vec3::UnitX(), -1.0});
  expect_fault(planes, ConvexFault::kEmpty);
}

TEST(ConvexBody, OpenOnOneSide) {
  std::vector<Plane> planes = unit_cube();
  planes.pop_back();
  expect_fault(planes, ConvexFault::kUnbounded);
}

}  // namespace
}  // namespace hallway::map
