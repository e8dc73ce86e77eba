// SPDX-License-Identifier: MIT
//
// What single precision calls sure is what the double-precision predicate says.
#include "trace/triangle_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/long_mode.hpp"
#include "trace/sight_line.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::trace {
namespace {

struct Kind {
  const char* name;
  Certify certify;
};

class Certified : public testing::TestWithParam<Kind> {
 protected:
  /// Blocks in which triangles of all shapes and sizes stand, from 1e-7 to 1 of the scene, needles among them.
  static TriangleMesh triangles(test::Draw& draw, double size, const Vec3& centre) {
    TriangleMesh mesh =
        test::mesh_of({test::box(centre - Vec3::Constant(size), centre + Vec3::Constant(size))});
    for (int i = 0; i < 300; ++i) {
      const Vec3 at = centre + draw.point(0.9 * size);
      const Vec3 edge = draw.direction() * size * std::pow(10.0, draw.uniform(-7.0, -0.3));
      const Vec3 width = draw.direction() * edge.norm() * std::pow(10.0, draw.uniform(-5.5, 0.0));
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), {at, at + edge, at + width});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
  }

  void check(const Vec3& from, const Vec3& to, const TriangleSet& set, const TriangleBlocks& blocks) {
    const auto line = sight_line_between(from, to);
    if (!line || (to - from).norm() < blocks.least_length_m()) return;
    const FloatSegment segment = blocks.segment(from - blocks.centre(), to - from, true);
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
      const Verdict verdict = GetParam().certify(blocks[b], segment);
      ASSERT_EQ(verdict.open & ~blocks[b].used, 0u);
      ASSERT_EQ(verdict.hit & ~verdict.open, 0u);
      for (std::size_t i = 0; i < kBlockSize; ++i) {
        if ((blocks[b].used >> i & 1u) == 0) continue;
        const bool expected = set.hit(blocks[b].triangle[i], *line).has_value();
        const bool hit = (verdict.hit >> i & 1u) != 0;
        const bool open = (verdict.open >> i & 1u) != 0;
        ASSERT_TRUE(open || !expected) << "a hit is called a miss, triangle " << blocks[b].triangle[i];
        ASSERT_TRUE(!hit || expected) << "a miss is called a hit, triangle " << blocks[b].triangle[i];
        ++tested_;
        hits_ += hit ? 1 : 0;
        undecided_ += open && !hit ? 1 : 0;
      }
    }
  }

  void run(double size, const Vec3& centre) {
    test::Draw draw(31);
    const TriangleMesh mesh = triangles(draw, size, centre);
    const TriangleSet set(mesh);
    const TriangleBlocks blocks(set);
    const auto inside = [&] { return Vec3(centre + draw.point(size)); };
    for (int i = 0; i < test::sized(1500, 40000); ++i) {
      const auto& corners = mesh.triangles[draw.index(mesh.triangles.size())];
      const Vec3& a = mesh.vertices[corners[0]];
      const Vec3 along = mesh.vertices[corners[1]] - a;
      const Vec3 across = mesh.vertices[corners[2]] - a;
      const double tiny = size * std::pow(10.0, draw.uniform(-12.0, -3.0));
      const Vec3 target = a + draw.uniform(-0.1, 1.1) * along + draw.uniform(-0.1, 1.1) * across;
      const Vec3 from = inside();
      check(from, inside(), set, blocks);
      check(from, target, set, blocks);                            // ends at a triangle
      check(from, target + tiny * draw.direction(), set, blocks);  // or just before or behind it
      check(target + along + tiny * draw.direction(), target - across, set, blocks);  // nearly in its plane
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(hits_, 100);
    EXPECT_LT(static_cast<double>(undecided_), 0.2 * static_cast<double>(tested_));
  }

  long tested_ = 0;
  long hits_ = 0;
  long undecided_ = 0;
};

TEST_P(Certified, AgreesWithThePredicateInARoom) {
  run(10.0, Vec3::Zero());
}
TEST_P(Certified, AgreesWithThePredicateFarFromTheOrigin) {
  run(10.0, Vec3(9e6, -8e6, 1e3));
}
TEST_P(Certified, AgreesWithThePredicateInALandscape) {
  run(4e6, Vec3::Zero());
}

INSTANTIATE_TEST_SUITE_P(Kinds, Certified,
                         testing::Values(Kind{"Portable", &certify_portable},
                                         Kind{"Fastest", fastest_certify()}),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(TriangleBlocks, LeaveOutTrianglesWithoutArea) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 1, 3}};
  const TriangleBlocks blocks{TriangleSet(mesh)};
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].used, 1u);
  EXPECT_EQ(blocks[0].triangle[0], 1u);
}

TEST(TriangleBlocks, LeaveEverythingOpenWhereToldThatNothingIsSure) {
  const TriangleMesh mesh = test::mesh_of({test::box({-1, -1, -1}, {1, 1, 1})});
  const TriangleBlocks blocks{TriangleSet(mesh)};
  const FloatSegment segment = blocks.segment({0, 0, 0}, {0.5, 0, 0}, false);
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    EXPECT_EQ(fastest_certify()(blocks[b], segment).open, blocks[b].used);
    EXPECT_EQ(certify_portable(blocks[b], segment).open, blocks[b].used);
    EXPECT_EQ(certify_portable(blocks[b], segment).hit, 0u);
  }
}

}  // namespace
}  // namespace hallway::trace
