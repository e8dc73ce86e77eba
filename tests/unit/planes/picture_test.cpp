// SPDX-License-Identifier: MIT
#include "planes/picture.hpp"

#include <gtest/gtest.h>

#include "unit/planes/cases.hpp"

namespace hallway::planes::test {
namespace {

bool has(const render::Image& image, render::Rgb colour, int begin_x, int end_x) {
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = begin_x; x < end_x; ++x) {
      if (image.at(x, y) == colour) return true;
    }
  }
  return false;
}

TEST(PlanePictures, PlanesHaveColoursOfTheirOwn) {
  const Case two = levels(2, 40);
  const std::vector<PlaneObservation> found = perfect(two.truth);
  const render::Image image = draw_planes({two.points, found, "levels"}, {}, {400, 300});
  EXPECT_EQ(image.width_px, 400);
  EXPECT_TRUE(has(image, render::submap_colour(1), 0, 400));
  EXPECT_TRUE(has(image, kNoPlaneColour, 0, 400));
  EXPECT_EQ(draw_planes({two.points, found, "levels"}, {}, {400, 300}).bytes, image.bytes);
}

TEST(PlanePictures, PairsHaveOneColourOnBothSidesAndFaultsAnother) {
  const Case two = levels(2);
  const render::View view{.kind = render::ViewKind::kPerspective};
  std::vector<PlaneObservation> found = perfect(two.truth);
  const auto draw = [&] {
    return draw_comparison({two.points, found, "levels"}, two.truth, two.score(found), view, {400, 300});
  };
  const render::Image good = draw();
  EXPECT_EQ(good.width_px, 800);
  EXPECT_EQ(good.height_px, 300);
  for (std::size_t plane = 0; plane < 2; ++plane) {
    EXPECT_TRUE(has(good, render::submap_colour(plane), 0, 400)) << plane;
    EXPECT_TRUE(has(good, render::submap_colour(plane), 400, 800)) << plane;
  }
  EXPECT_FALSE(has(good, render::palette::kError, 0, 800));
  found.erase(found.begin());
  const render::Image missing = draw();
  EXPECT_TRUE(has(missing, render::palette::kError, 0, 400));
  EXPECT_FALSE(has(missing, render::palette::kError, 400, 800));
}

TEST(PlanePictures, CloudsWithoutPointsAreDrawn) {
  EXPECT_EQ(draw_planes({{}, {}, "nothing"}, {}, {200, 150}).height_px, 150);
}

}  // namespace
}  // namespace hallway::planes::test
