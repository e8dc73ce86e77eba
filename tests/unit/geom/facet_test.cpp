// SPDX-License-Identifier: MIT
#include "geom/facet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random_planes.hpp"
#include "rational.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

using test::kPlaneKinds;
using test::PlaneKind;
using test::RandomPoints;
using test::rational;
using test::Rational3;
using Side = PlaneSet::Side;

double area(const PlaneSet& planes, const Facet& facet) {
  return 0.5 * area_vector(facet).dot(planes[facet.plane].unit.normal);
}

/// The area's part along the axis in which it is largest, exactly: the shoelace formula over the exact corners.
mpq_class exact_area(const PlaneSet& planes, const Facet& facet) {
  Eigen::Index axis = 0;
  planes[facet.plane].unit.normal.cwiseAbs().maxCoeff(&axis);
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  std::vector<Rational3> corners;
  for (const FacetEdge& edge : facet.edges) corners.push_back(test::shared_point(planes, edge.start));
  mpq_class sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Rational3& a = corners[i];
    const Rational3& b = corners[(i + 1) % corners.size()];
    sum += a[u] * b[v] - a[v] * b[u];
  }
  return planes[facet.plane].unit.normal[axis] > 0.0 ? sum : -sum;
}

/// Every corner is on the facet's plane and on those of its two edges, and all others are strictly on one side of each edge.
testing::AssertionResult strictly_convex(const PlaneSet& planes, const Facet& facet) {
  const std::size_t n = facet.edges.size();
  if (n < 3) return testing::AssertionFailure() << n << " edges";
  for (std::size_t e = 0; e < n; ++e) {
    const std::uint32_t plane = facet.edges[e].plane;
    Side inner = Side::kOn;
    for (std::size_t k = 0; k < n; ++k) {
      const ExactPoint& corner = facet.edges[k].start;
      if (planes.side(facet.plane, corner) != Side::kOn)
        return testing::AssertionFailure() << "corner " << k << " is off the plane";
      const Side side = planes.side(plane, corner);
      if (k == e || k == (e + 1) % n) {
        if (side != Side::kOn)
          return testing::AssertionFailure() << "an end of edge " << e << " is off its plane";
        continue;
      }
      if (side == Side::kOn)
        return testing::AssertionFailure() << "corner " << k << " is in line with edge " << e;
      if (inner != Side::kOn && side != inner)
        return testing::AssertionFailure() << "not convex at edge " << e;
      inner = side;
    }
  }
  return testing::AssertionSuccess();
}

/// No corner is on the wrong side, and not all are on the plane.
bool lies_on(const PlaneSet& planes, const Facet& facet, std::uint32_t plane, Side keep) {
  bool any = false;
  for (const FacetEdge& edge : facet.edges) {
    const Side side = planes.side(plane, edge.start);
    if (side != keep && side != Side::kOn) return false;
    any = any || side == keep;
  }
  return any;
}

class EveryKindOfCut : public testing::TestWithParam<PlaneKind> {
 protected:
  double reach() const {
    const bool huge = GetParam() == PlaneKind::kHuge || GetParam() == PlaneKind::kHugeDecimals;
    return huge ? 67108864.0 : 256.0;
  }
};
INSTANTIATE_TEST_SUITE_P(Facets, EveryKindOfCut, testing::ValuesIn(kPlaneKinds));

TEST_P(EveryKindOfCut, CuttingPartitionsAFacetExactly) {
  int cuts = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::sized(12, 300)); ++seed) {
    RandomPoints triples(GetParam(), seed);
    PlaneSet planes;
    for (int i = 0; i < 10; ++i) planes.add(triples.three(), {}, 0.0);
    const std::uint32_t own = 0;
    const auto count = static_cast<std::uint32_t>(planes.size());
    const Facet whole = cover_plane(planes, own, reach());
    ASSERT_TRUE(strictly_convex(planes, whole));
    ASSERT_GT(sgn(exact_area(planes, whole)), 0) << "runs clockwise";
    std::vector<Facet> pieces{whole};
    for (std::uint32_t plane = 0; plane < count; ++plane) {
      std::vector<Facet> next;
      for (const Facet& piece : pieces) {
        Facet given = piece, front, back;
        const FacetSide said = classify(planes, piece, plane);
        ASSERT_EQ(split(planes, given, plane, front, back), said);
        ASSERT_EQ(said == FacetSide::kOn, plane == own);
        ASSERT_EQ(said == FacetSide::kFront || said == FacetSide::kSplit, !front.empty());
        ASSERT_EQ(said == FacetSide::kBack || said == FacetSide::kSplit, !back.empty());
        cuts += said == FacetSide::kSplit ? 1 : 0;
        for (const bool keep_front : {true, false}) {
          Facet clipped = piece;
          clip(planes, clipped, plane, keep_front);
          const Facet& part = keep_front ? front : back;
          ASSERT_EQ(clipped.edges.size(), part.edges.size());
          for (std::size_t i = 0; i < part.edges.size(); ++i)
            ASSERT_TRUE(planes.same(clipped.edges[i].start, part.edges[i].start));
          if (part.empty()) continue;
          ASSERT_TRUE(strictly_convex(planes, part)) << "seed " << seed << ", plane " << plane;
          ASSERT_TRUE(lies_on(planes, part, plane, keep_front ? Side::kFront : Side::kBack));
          ASSERT_EQ(part.plane, own);
          next.push_back(part);
        }
        if (said == FacetSide::kOn) next.push_back(piece);
      }
      pieces = std::move(next);
    }
    mpq_class sum = 0;
    for (const Facet& piece : pieces) {
      const mpq_class part = exact_area(planes, piece);
      ASSERT_GT(sgn(part), 0) << "turned over";
      sum += part;
    }
    ASSERT_TRUE(sum == exact_area(planes, whole)) << "seed " << seed;
  }
  EXPECT_GT(cuts, 100);
}

TEST(Facet, RoundedAreasAddUp) {
  RandomPoints triples(PlaneKind::kTurned, 9);
  PlaneSet planes;
  for (int i = 0; i < 30; ++i) planes.add(triples.three(), {}, 0.0);
  const auto count = static_cast<std::uint32_t>(planes.size());
  const Facet whole = cover_plane(planes, 0, 16.0);
  double sum = 0.0;
  std::vector<Facet> pieces{whole};
  for (std::uint32_t plane = 1; plane < count; ++plane) {
    std::vector<Facet> next;
    for (Facet& piece : pieces) {
      Facet front, back;
      split(planes, piece, plane, front, back);
      for (Facet* part : {&front, &back}) {
        if (!part->empty()) next.push_back(std::move(*part));
      }
    }
    pieces = std::move(next);
  }
  for (const Facet& piece : pieces) sum += area(planes, piece);
  EXPECT_GT(pieces.size(), 50u);
  EXPECT_NEAR(sum / area(planes, whole), 1.0, 1e-12);
}

Facet rectangle(PlaneSet& planes, double u0, double u1, double v0, double v1) {
  Facet facet = cover_plane(planes, planes.add_axial(2, 5.0).index, 1024.0);
  clip(planes, facet, planes.add_axial(0, u0).index, true);
  clip(planes, facet, planes.add_axial(0, u1).index, false);
  clip(planes, facet, planes.add_axial(1, v0).index, true);
  clip(planes, facet, planes.add_axial(1, v1).index, false);
  return facet;
}

TEST(Facet, WidthOfRectanglesAndTriangles) {
  PlaneSet planes;
  Facet facet = rectangle(planes, -3.0, 4.0, 10.0, 12.5);
  EXPECT_DOUBLE_EQ(width(planes, facet), 2.5);
  EXPECT_DOUBLE_EQ(area(planes, facet), 7.0 * 2.5);
  facet = rectangle(planes, 0.0, 3.0, 0.0,
                    4.0);  // cut to the triangle (0,0) (3,0) (0,4): its least height is 12 / 5
  clip(planes, facet, planes.add({Vec3(3, 0, 0), Vec3(0, 4, 0), Vec3(3, 0, 1)}, {}, 0.0).index, false);
  if (facet.edges.size() != 3) {
    facet = rectangle(planes, 0.0, 3.0, 0.0, 4.0);
    clip(planes, facet, planes.add({Vec3(3, 0, 0), Vec3(0, 4, 0), Vec3(3, 0, 1)}, {}, 0.0).index, true);
  }
  ASSERT_EQ(facet.edges.size(), 3u);
  EXPECT_NEAR(width(planes, facet), 2.4, 1e-12);
}

TEST(Facet, TouchingIsNotCutting) {
  PlaneSet planes;
  const Facet facet = rectangle(planes, 0.0, 1.0, 0.0, 1.0);
  const std::uint32_t edge = planes.add_axial(0, 1.0).index;
  EXPECT_EQ(classify(planes, facet, edge), FacetSide::kBack);
  Facet clipped = facet;
  clip(planes, clipped, edge, true);
  EXPECT_TRUE(clipped.empty()) << "a touching edge has no area";
  const std::uint32_t corner = planes.add({Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(2, 0, 1)}, {}, 0.0).index;
  EXPECT_NE(classify(planes, facet, corner), FacetSide::kSplit) << "x + y = 2 only touches the corner";
}

}  // namespace
}  // namespace hallway
