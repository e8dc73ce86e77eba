// SPDX-License-Identifier: MIT
#include "render/texture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "render/draw.hpp"

namespace hallway::render {
namespace {

constexpr int kWidth = 420;
constexpr int kHeight = 320;
constexpr Rgb kRed{200, 40, 40};
constexpr Rgb kGreen{40, 180, 60};
constexpr Rgb kBlue{40, 60, 200};
constexpr Rgb kYellow{220, 200, 30};

/// A texture of opaque texels, rows from the top.
Texture texture_of(std::uint32_t width, std::uint32_t height, const std::vector<Rgb>& texels) {
  Texture out{width, height, {}};
  for (const Rgb& texel : texels) out.rgba.insert(out.rgba.end(), {texel.r, texel.g, texel.b, 255});
  return out;
}

std::shared_ptr<const Texture> four_colours() {
  return std::make_shared<const Texture>(texture_of(2, 2, {kRed, kGreen, kBlue, kYellow}));
}

/// An upright square of 2 m around the origin, seen from -y: its picture upright, `repeats` times each way from `first`.
Surface wall(std::shared_ptr<const Texture> texture, float repeats = 1.0f, float first = 0.0f,
             double y = 0.0) {
  const float last = first + repeats;
  return {.polygon = {{{-1, y, -1}, {1, y, -1}, {1, y, 1}, {-1, y, 1}}, {{0, -1, 0}, -y}},
          .colour = {255, 255, 255},
          .kind = SurfaceKind::kSheet,
          .texture = std::move(texture),
          .uv = {{first, last}, {last, last}, {last, first}, {first, first}}};
}

View looking(const Vec3& eye, const Vec3& target) {
  View view;
  view.kind = ViewKind::kPerspective;
  view.eye = eye;
  view.target = target;
  return view;
}

const Vec3 kEye(0, -4, 0);

/// A picture and what it looks like.
struct Drawn {
  Drawn(std::vector<Surface> surfaces, const View& view_in) : view(view_in) {
    picture.surfaces = std::move(surfaces);
    image = draw(picture, view, kWidth, kHeight);
  }
  Vec2 pixel(const Vec3& world) const {
    return picture_camera(picture, view, kWidth, kHeight).project(world)->pixel;
  }
  Rgb at(const Vec3& world) const {
    const Vec2 at = pixel(world);
    return image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  }
  Picture picture;
  View view;
  Image image;
};

/// Whether the colour is that of a lit face of colour `base`: each channel scaled by one factor.
::testing::AssertionResult is_lit(Rgb seen, Rgb base) {
  const double factor = (seen.r + seen.g + seen.b) / static_cast<double>(base.r + base.g + base.b);
  const auto near = [factor](int a, int b) { return std::abs(a - factor * b) < 8.0; };
  if (factor > 0.5 && factor < 1.06 && near(seen.r, base.r) && near(seen.g, base.g) && near(seen.b, base.b))
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << int{seen.r} << " " << int{seen.g} << " " << int{seen.b};
}

// ---- on faces -------------------------------------------------------------------------------------------------------

TEST(Texture, HasItsFirstRowOnTopAndItsFirstColumnAtTheLeft) {
  const Drawn drawn({wall(four_colours())}, looking(kEye, Vec3::Zero()));
  EXPECT_TRUE(is_lit(drawn.at({-0.5, 0, 0.5}), kRed));
  EXPECT_TRUE(is_lit(drawn.at({0.5, 0, 0.5}), kGreen));
  EXPECT_TRUE(is_lit(drawn.at({-0.5, 0, -0.5}), kBlue));
  EXPECT_TRUE(is_lit(drawn.at({0.5, 0, -0.5}), kYellow));
}

TEST(Texture, IsMultipliedByTheColourOfTheFace) {
  Surface surface = wall(four_colours());
  surface.colour = {255, 51, 0};
  const Drawn drawn({surface}, looking(kEye, Vec3::Zero()));
  EXPECT_TRUE(is_lit(drawn.at({-0.5, 0, 0.5}), {200, 8, 0}));
  EXPECT_TRUE(is_lit(drawn.at({0.5, 0, -0.5}), {220, 40, 0}));
}

TEST(Texture, LooksFromBehindAsInAMirror) {
  const Drawn drawn({wall(four_colours())}, looking(-kEye, Vec3::Zero()));
  EXPECT_TRUE(is_lit(drawn.at({-0.5, 0, 0.5}), kRed));
  EXPECT_TRUE(is_lit(drawn.at({0.5, 0, -0.5}), kYellow));
}

TEST(Texture, Repeats) {
  const Drawn drawn({wall(four_colours(), 2.0f)}, looking(kEye, Vec3::Zero()));
  for (const double x : {-1.0, 0.0}) {
    for (const double z : {-1.0, 0.0}) {
      EXPECT_TRUE(is_lit(drawn.at({x + 0.25, 0, z + 0.75}), kRed));
      EXPECT_TRUE(is_lit(drawn.at({x + 0.75, 0, z + 0.75}), kGreen));
      EXPECT_TRUE(is_lit(drawn.at({x + 0.25, 0, z + 0.25}), kBlue));
      EXPECT_TRUE(is_lit(drawn.at({x + 0.75, 0, z + 0.25}), kYellow));
    }
  }
  // Whole repeats make no difference, however many.
  for (const float first : {-3.0f, 1e6f}) {
    const Drawn moved({wall(four_colours(), 2.0f, first)}, looking(kEye, Vec3::Zero()));
    EXPECT_EQ(moved.image.bytes, drawn.image.bytes) << first;
  }
}

TEST(Texture, EachFaceHasItsOwn) {
  const auto one = std::make_shared<const Texture>(texture_of(1, 1, {kRed}));
  const auto other = std::make_shared<const Texture>(texture_of(1, 1, {kGreen}));
  std::vector<Surface> surfaces;
  for (int i = 0; i < 6; ++i) {
    surfaces.push_back(wall(i % 3 == 0 ? nullptr : i % 3 == 1 ? one : other));
    for (Vec3& corner : surfaces.back().polygon.vertices) corner = 0.3 * corner + Vec3(i - 2.5, 0, 0);
    surfaces.back().colour = i % 3 == 0 ? kBlue : Rgb{255, 255, 255};
  }
  const Drawn drawn(surfaces, looking({0, -6, 0}, Vec3::Zero()));
  for (int i = 0; i < 6; ++i) {
    EXPECT_TRUE(is_lit(drawn.at({i - 2.5, 0, 0}), i % 3 == 0 ? kBlue : i % 3 == 1 ? kRed : kGreen)) << i;
  }
}

/// Stripes of 1 m across a floor that reaches from 0 to 8 m ahead.
Surface striped_floor() {
  std::vector<Rgb> rows;
  for (int i = 0; i < 8; ++i) rows.push_back(i % 2 == 0 ? Rgb{240, 240, 240} : Rgb{20, 20, 20});
  return {.polygon = {{{-2, 0, 0}, {2, 0, 0}, {2, 8, 0}, {-2, 8, 0}}, {{0, 0, 1}, 0}},
          .colour = {255, 255, 255},
          .kind = SurfaceKind::kSheet,
          .texture = std::make_shared<const Texture>(texture_of(1, 8, rows)),
          .uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

/// The row, to a fraction, in which a column passes the brightness `middle`; the nearest such to `guess`.
double edge_in_column(const Image& image, double middle, int x, double guess) {
  constexpr int kReach = 6;
  double best = std::numeric_limits<double>::infinity();
  for (int y = static_cast<int>(guess) - kReach; y < static_cast<int>(guess) + kReach; ++y) {
    const double a = image.at(x, y).g - middle;
    const double b = image.at(x, y + 1).g - middle;
    if ((a < 0.0) == (b < 0.0)) continue;
    const double edge = y + 0.5 + a / (a - b);
    if (std::abs(edge - guess) < std::abs(best - guess)) best = edge;
  }
  return best;
}

TEST(Texture, LiesWhereGeometrySaysInPerspective) {
  const Drawn drawn({striped_floor()}, looking({0, -2, 2}, {0, 3, 0}));
  const double middle_g = 0.5 * (drawn.at({0, 0.5, 0}).g + drawn.at({0, 1.5, 0}).g);
  for (const double x : {-1.6, -0.7, 0.1, 1.2}) {
    for (const double y : {1.0, 2.0, 3.0, 4.0, 5.0}) {
      const Vec2 at = drawn.pixel({x, y, 0});
      // A line across the view stays level in the picture, so any column near will do.
      EXPECT_NEAR(edge_in_column(drawn.image, middle_g, static_cast<int>(at.x()), at.y()), at.y(), 0.8)
          << x << " " << y;
    }
  }
  // What interpolation without perspective would give is far away: the middle of the floor in the picture is not that of the floor.
  const double middle = 0.5 * (drawn.pixel({0, 0, 0}).y() + drawn.pixel({0, 8, 0}).y());
  EXPECT_GT(std::abs(drawn.pixel({0, 4, 0}).y() - middle), 20.0);
}

TEST(Texture, FromAfarIsItsMean) {
  constexpr std::uint32_t kSide = 900;
  std::vector<Rgb> texels;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const bool bright = (i % kSide / 2 + i / kSide / 2) % 2 == 0;  // squares of 2 x 2 texels
    texels.push_back(bright ? Rgb{250, 250, 250} : Rgb{10, 10, 10});
  }
  const auto board = std::make_shared<const Texture>(texture_of(kSide, kSide, texels));
  const Drawn drawn({wall(board)}, looking({0, -7, 0}, Vec3::Zero()));
  const Vec2 low = drawn.pixel({-0.9, 0, 0.9});
  const Vec2 high = drawn.pixel({0.9, 0, -0.9});
  ASSERT_LT(high.x() - low.x(), 200.0);  // a square is less than a pixel
  for (int y = static_cast<int>(low.y()); y < static_cast<int>(high.y()); ++y) {
    for (int x = static_cast<int>(low.x()); x < static_cast<int>(high.x()); ++x)
      ASSERT_NEAR(drawn.image.at(x, y).g, drawn.image.at(kWidth / 2, kHeight / 2).g, 6) << x << " " << y;
  }
  EXPECT_TRUE(is_lit(drawn.at(Vec3::Zero()), {130, 130, 130}));
}

TEST(Texture, HasHolesWhereAlphaIsBelowOneHalf) {
  Texture texture = texture_of(2, 1, {kRed, kGreen});
  texture.rgba[3] = 100;
  texture.rgba[7] = 140;
  const auto holed = std::make_shared<const Texture>(texture);
  Surface behind = wall(nullptr, 1.0f, 0.0f, 1.0);
  behind.colour = kBlue;
  for (const bool hole_first : {false, true}) {
    std::vector<Surface> surfaces{wall(holed), behind};
    if (hole_first) std::swap(surfaces[0], surfaces[1]);
    const Drawn drawn(surfaces, looking(kEye, Vec3::Zero()));
    EXPECT_TRUE(is_lit(drawn.at({-0.5, 0, 0}), kBlue));
    EXPECT_TRUE(is_lit(drawn.at({0.5, 0, 0}), kGreen));
  }
  // A mark behind the hole is as clear as without the wall; behind the rest it is faint.
  Picture picture;
  picture.surfaces = {wall(holed)};
  picture.markers.push_back({.positions = {{-0.6, 1, 0}, {0.6, 1, 0}}, .colour = kBlue, .size_px = 9.0});
  const View view = looking(kEye, Vec3::Zero());
  const Camera camera = picture_camera(picture, view, kWidth, kHeight);
  const Image image = draw(picture, view, kWidth, kHeight);
  const auto at = [&](const Vec3& place) {
    const Vec2 pixel = camera.project(place)->pixel;
    return image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  };
  EXPECT_EQ(at({-0.6, 1, 0}), kBlue);
  EXPECT_NE(at({0.6, 1, 0}), kBlue);
}

TEST(Texture, OfNoUseIsLeftOut) {
  Texture torn = *four_colours();
  torn.rgba.pop_back();
  Surface plain = wall(nullptr);
  plain.colour = kYellow;
  const View view = looking(kEye, Vec3::Zero());
  const Drawn wanted({plain}, view);
  std::vector<Surface> bad(4, plain);
  for (Surface& surface : bad) surface.texture = four_colours();
  bad[0].uv.pop_back();
  bad[1].uv[2][1] = std::nanf("");
  bad[2].texture = std::make_shared<const Texture>(torn);
  bad[3].texture = std::make_shared<const Texture>();
  for (const Surface& surface : bad) EXPECT_EQ(Drawn({surface}, view).image.bytes, wanted.image.bytes);
}

TEST(Texture, OverTheLimitOfOpenGlIsReduced) {
  // Longer than any OpenGL takes: red, then green.
  constexpr std::uint32_t kLength = 70'000;
  std::vector<Rgb> texels(kLength, kRed);
  std::fill(texels.begin() + kLength / 2, texels.end(), kGreen);
  const auto strip = std::make_shared<const Texture>(texture_of(kLength, 1, texels));
  const Drawn drawn({wall(strip)}, looking(kEye, Vec3::Zero()));
  EXPECT_TRUE(is_lit(drawn.at({-0.5, 0, 0}), kRed));
  EXPECT_TRUE(is_lit(drawn.at({0.5, 0, 0}), kGreen));
}

TEST(Texture, SameInputGivesSameBytes) {
  const View view = looking({1, -3, 1}, Vec3::Zero());
  const Drawn one({striped_floor(), wall(four_colours()), wall(four_colours(), 3.0f, 0.5f, 1.0)}, view);
  const Drawn two({striped_floor(), wall(four_colours()), wall(four_colours(), 3.0f, 0.5f, 1.0)}, view);
  EXPECT_EQ(one.image.bytes, two.image.bytes);
}

// ---- reduced --------------------------------------------------------------------------------------------------------

TEST(Reduced, TexelsAreMeans) {
  const Texture wide{4, 2, {0, 0,  0, 255, 4,  0, 0, 255, 100, 0, 0, 255, 200, 0, 0, 55,
                            8, 40, 0, 255, 12, 0, 0, 255, 100, 0, 0, 255, 200, 0, 9, 255}};
  const Texture small = reduced(wide, 2);
  EXPECT_EQ(small.width, 2u);
  EXPECT_EQ(small.height, 2u);
  EXPECT_EQ(small.rgba, (std::vector<std::uint8_t>{2, 0, 0, 255, 150, 0, 0, 155,  //
                                                   10, 20, 0, 255, 150, 0, 5, 255}));
  EXPECT_EQ(reduced(wide, 1).rgba, (std::vector<std::uint8_t>{78, 5, 1, 230}));
  EXPECT_EQ(reduced(wide, 4).rgba, wide.rgba);
}

TEST(Reduced, EveryTexelCountsOnce) {
  // 5 texels in 2: the first two, and the last three.
  const Texture odd = texture_of(1, 5, {{10, 0, 0}, {20, 0, 0}, {30, 0, 0}, {60, 0, 0}, {90, 0, 0}});
  const Texture small = reduced(odd, 2);
  EXPECT_EQ(small.width, 1u);
  EXPECT_EQ(small.rgba, (std::vector<std::uint8_t>{15, 0, 0, 255, 60, 0, 0, 255}));
}

}  // namespace
}  // namespace hallway::render
