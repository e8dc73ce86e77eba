// SPDX-License-Identifier: MIT
#include "watch/view.hpp"

#include <gtest/gtest.h>

namespace hallway::watch {
namespace {

const Eigen::AlignedBox2d kBox(Vec2(-3.0, 2.0), Vec2(17.0, 9.0));

TEST(WatchView, FitShowsAllCorners) {
  for (const auto& [width, height] :
       {std::pair(51, 16), std::pair(160, 48), std::pair(5, 40), std::pair(1, 1)}) {
    View view;
    view.fit(kBox, width, height);
    for (const Dots dots : {Dots::kBraille, Dots::kBlocks, Dots::kAscii}) {
      const DotShape shape = shape_of(dots);
      for (const Vec2& corner : {kBox.min(), kBox.max()}) {
        const Vec2 at = view.dots_of(corner, dots);
        EXPECT_GT(at.x(), 0.0);
        EXPECT_GT(at.y(), 0.0);
        EXPECT_LT(at.x(), width * shape.columns);
        EXPECT_LT(at.y(), height * shape.rows);
      }
    }
  }
}

TEST(WatchView, NorthIsUpAndScalesAreEqual) {
  View view;
  view.fit(kBox, 40, 20);
  const Vec2 o = view.dots_of(Vec2(0, 0), Dots::kBraille);
  const Vec2 east = view.dots_of(Vec2(1, 0), Dots::kBraille) - o;
  const Vec2 north = view.dots_of(Vec2(0, 1), Dots::kBraille) - o;
  EXPECT_NEAR(east.x(), -north.y(), 1e-12);  // dots of braille are square
  EXPECT_GT(east.x(), 0.0);
  EXPECT_NEAR(east.y(), 0.0, 1e-12);
}

TEST(WatchView, ZoomKeepsTheCentre) {
  View view;
  view.fit(kBox, 40, 20);
  const Vec2 centre = view.dots_of(kBox.center(), Dots::kBraille);
  const Vec2 before = view.dots_of(Vec2(5, 5), Dots::kBraille) - centre;
  view.zoom(2.0);
  EXPECT_TRUE(view.dots_of(kBox.center(), Dots::kBraille).isApprox(centre));
  EXPECT_TRUE((view.dots_of(Vec2(5, 5), Dots::kBraille) - centre).isApprox(2.0 * before));
  for (int i = 0; i < 100; ++i) view.zoom(10.0);
  EXPECT_DOUBLE_EQ(view.cell_m(), 1e-3);
  for (int i = 0; i < 100; ++i) view.zoom(0.1);
  EXPECT_DOUBLE_EQ(view.cell_m(), 1e3);
}

TEST(WatchView, PanMovesByShares) {
  View view;
  view.fit(kBox, 40, 20);
  const Vec2 extent = view.extent_m();
  view.pan(Vec2(0.5, -0.25));
  EXPECT_TRUE(view.centre().isApprox(Vec2(kBox.center() + Vec2(0.5 * extent.x(), -0.25 * extent.y()))));
}

TEST(WatchView, ResizeKeepsCentreAndScale) {
  View view;
  view.fit(kBox, 40, 20);
  const double cell_m = view.cell_m();
  view.resize(100, 50);
  EXPECT_DOUBLE_EQ(view.cell_m(), cell_m);
  EXPECT_TRUE(view.dots_of(kBox.center(), Dots::kBraille).isApprox(Vec2(100.0, 100.0)));
}

TEST(WatchView, EmptyBoxShowsTheOrigin) {
  View view;
  view.fit({}, 40, 20);
  EXPECT_TRUE(view.dots_of(Vec2::Zero(), Dots::kAscii).isApprox(Vec2(20.0, 10.0)));
}

}  // namespace
}  // namespace hallway::watch
