// SPDX-License-Identifier: MIT
#include "render/renderer.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <thread>

#include "render/draw.hpp"
#include "unit/render/scenes.hpp"

namespace hallway::render {
namespace {

constexpr int kWidth = 480, kHeight = 320;
constexpr std::array kBoth{Renderer::kOsmesa, Renderer::kEgl};

/// The office in perspective, cut open, with a textured sheet in it: what the two could do differently.
Picture scene() {
  Picture picture = test::office();
  Surface sheet;
  sheet.polygon.vertices = {{2, 2, 0.5}, {6, 2, 0.5}, {6, 6, 1.5}, {2, 6, 1.5}};
  sheet.polygon.plane = {Vec3(0, -1, 4).normalized(), 0.0};
  sheet.colour = {255, 255, 255};
  sheet.kind = SurfaceKind::kSheet;
  sheet.texture = std::make_shared<Texture>(
      Texture{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 0, 255, 255, 0, 255}});
  sheet.uv = {{0, 0}, {3, 0}, {3, 3}, {0, 3}};
  picture.surfaces.push_back(sheet);
  return picture;
}

Image draw_scene(Renderer renderer, ViewKind kind) {
  const View view{.kind = kind, .cut_z_m = 1.9, .renderer = renderer};
  return draw(scene(), view, kWidth, kHeight);
}

/// Why a renderer cannot be tried here; empty if it can.
std::string missing(Renderer renderer) {
  try {
    demand(renderer);
    return {};
  } catch (const NoRenderer& error) {
    return error.cause();
  }
}

double share_that_differs(const Image& a, const Image& b) {
  int differing = 0;
  for (int y = 0; y < a.height_px; ++y) {
    for (int x = 0; x < a.width_px; ++x) {
      const Rgb p = a.at(x, y), q = b.at(x, y);
      differing += std::abs(p.r - q.r) > 8 || std::abs(p.g - q.g) > 8 || std::abs(p.b - q.b) > 8 ? 1 : 0;
    }
  }
  return static_cast<double>(differing) / (static_cast<double>(a.width_px) * a.height_px);
}

TEST(Renderer, NamesAreReadAsTheyAreWritten) {
  EXPECT_EQ(parse_renderer("auto"), Renderer::kAuto);
  EXPECT_EQ(parse_renderer("osmesa"), Renderer::kOsmesa);
  EXPECT_EQ(parse_renderer("egl"), Renderer::kEgl);
  for (const char* name : {"", "EGL", "egl ", "glx"}) EXPECT_FALSE(parse_renderer(name)) << name;
}

TEST(Renderer, AllDrawTheSame) {
  for (const Renderer renderer : kBoth) {
    if (const std::string why = missing(renderer); !why.empty()) GTEST_SKIP() << why;
  }
  for (const ViewKind kind : {ViewKind::kTop, ViewKind::kPerspective}) {
    const Image osmesa = draw_scene(Renderer::kOsmesa, kind), egl = draw_scene(Renderer::kEgl, kind);
    EXPECT_LE(share_that_differs(osmesa, egl), 0.01);
    EXPECT_EQ(draw_scene(Renderer::kOsmesa, kind).bytes, osmesa.bytes)
        << "the other one in between changes nothing";
  }
}

TEST(Renderer, AutoIsTheFirstThatIsThere) {
  for (const Renderer renderer : kBoth) {
    if (!missing(renderer).empty()) continue;
    EXPECT_EQ(draw_scene(Renderer::kAuto, ViewKind::kTop).bytes, draw_scene(renderer, ViewKind::kTop).bytes);
    return;
  }
  EXPECT_THROW(draw_scene(Renderer::kAuto, ViewKind::kTop), NoRenderer);
}

TEST(Renderer, ThreadsDrawAtTheSameTime) {
  for (const Renderer renderer : kBoth) {
    if (!missing(renderer).empty()) continue;
    const Image alone = draw_scene(renderer, ViewKind::kPerspective);
    std::array<Image, 3> images;
    std::vector<std::thread> threads;
    for (Image& image : images)
      threads.emplace_back([&image, renderer] { image = draw_scene(renderer, ViewKind::kPerspective); });
    for (std::thread& thread : threads) thread.join();
    for (const Image& image : images) EXPECT_EQ(image.bytes, alone.bytes);
  }
}

TEST(Renderer, PictureWithoutFacesNeedsNone) {
  Picture picture;
  picture.polylines.push_back({.points = {{0, 0, 0}, {1, 1, 0}}});
  EXPECT_EQ(draw(picture, {.renderer = Renderer::kOsmesa}, kWidth, kHeight).bytes,
            draw(picture, {.renderer = Renderer::kEgl}, kWidth, kHeight).bytes);
}

}  // namespace
}  // namespace hallway::render
