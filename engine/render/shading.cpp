// SPDX-License-Identifier: MIT
#include "render/shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.hpp"

namespace hallway::render {
namespace {

constexpr double kReach_m = 0.6;        ///< how far a corner's shade reaches
constexpr double kLeastReach_px = 3.0;  ///< below this the shade is not seen
constexpr double kMostReach_px = 90.0;
constexpr int kProbes = 20;
constexpr int kTurns = 16;  ///< different rotations of the probes, in a pattern of 4 x 4 pixels
constexpr double kDarkest = 0.40;

/// Levels of shade, so many that no step is seen and so few that the picture compresses well.
constexpr double kSteps = 40.0;

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Probes in the unit half ball around +z: a spiral whose radius grows so that near ones are denser.
std::array<Vec3, kProbes> make_probes() {
  std::array<Vec3, kProbes> probes;
  for (std::size_t i = 0; i < kProbes; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / kProbes;
    const double turn = 2.0 * std::numbers::pi * 0.61803398874989485 * static_cast<double>(i);
    const double height = 0.12 + 0.8 * std::fmod(0.75487766624669276 * static_cast<double>(i + 1), 1.0);
    const double flat = std::sqrt(1.0 - height * height);
    const double radius = 0.12 + 0.88 * share;
    probes[i] = radius * Vec3(flat * std::cos(turn), flat * std::sin(turn), height);
  }
  return probes;
}

/// The shade of every pixel, before smoothing.
class CornerShade {
 public:
  CornerShade(const SurfaceLayer& layer, const Camera& camera)
      : layer_(layer), camera_(camera), probes_(make_probes()) {}

  /// Share of the probes of pixel (x, y) of the area that faces hide, 0 to 1.
  float at(int x, int y) const {
    const std::size_t i = sample_of(x, y);
    const double distance = static_cast<double>(layer_.distance_m[i]);
    if (layer_.distance_m[i] == kNothing || layer_.cut[i] != 0 || layer_.normal[i].isZero()) return 0.0f;
    const Vec2 pixel(layer_.area.left + x + 0.5 / layer_.factor, layer_.area.top + y + 0.5 / layer_.factor);
    const double reach_px = kReach_m * camera_.pixels_per_metre(distance);
    if (reach_px < kLeastReach_px) return 0.0f;
    const double reach = kReach_m * std::min(1.0, kMostReach_px / reach_px);
    const Vec3 normal = layer_.normal[i].cast<double>();
    const Vec3 foot = camera_.unproject({pixel, distance}) + 0.02 * reach * normal;
    const double angle = 2.0 * std::numbers::pi * ((x & 3) * 4 + (y & 3)) / kTurns;
    const Eigen::Matrix3d frame = tangent_frame(normal, angle);
    double hidden = 0.0;
    for (const Vec3& probe : probes_) hidden += hidden_share(foot + reach * (frame * probe), reach);
    return static_cast<float>(hidden / kProbes);
  }

 private:
  std::size_t sample_of(int x, int y) const { return layer_.index(x * layer_.factor, y * layer_.factor); }

  static Eigen::Matrix3d tangent_frame(const Vec3& normal, double angle) {
    const Vec3 other = std::abs(normal.z()) < 0.9 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
    const Vec3 side = normal.cross(other).normalized();
    const Vec3 front = normal.cross(side);
    Eigen::Matrix3d frame;
    frame.col(0) = std::cos(angle) * side + std::sin(angle) * front;
    frame.col(1) = std::cos(angle) * front - std::sin(angle) * side;
    frame.col(2) = normal;
    return frame;
  }

  /// 1 if a face stands just before the point, fading to 0 for faces so far before it that they are another thing.
  double hidden_share(const Vec3& point, double reach) const {
    const std::optional<ScreenPoint> screen = camera_.project(point);
    if (!screen) return 0.0;
    const int x = static_cast<int>(std::floor(screen->pixel.x())) - layer_.area.left;
    const int y = static_cast<int>(std::floor(screen->pixel.y())) - layer_.area.top;
    if (x < 0 || y < 0 || x >= layer_.area.width() || y >= layer_.area.height()) return 0.0;
    const double before = screen->distance_m - static_cast<double>(layer_.distance_m[sample_of(x, y)]);
    if (!(before > 0.01 * reach)) return 0.0;
    return std::clamp((4.0 * reach - before) / (2.0 * reach), 0.0, 1.0);
  }

  const SurfaceLayer& layer_;
  const Camera& camera_;
  std::array<Vec3, kProbes> probes_;
};

/// Mean over 4 x 4 pixels of the same face, which evens out the rotation pattern of the probes.
float smoothed(const std::vector<float>& shade, const SurfaceLayer& layer, int x, int y) {
  const std::size_t centre = layer.index(x * layer.factor, y * layer.factor);
  const float distance = layer.distance_m[centre];
  float sum = 0.0f;
  int count = 0;
  for (int v = std::max(0, y - 2); v < std::min(layer.area.height(), y + 2); ++v) {
    for (int u = std::max(0, x - 2); u < std::min(layer.area.width(), x + 2); ++u) {
      const std::size_t i = layer.index(u * layer.factor, v * layer.factor);
      const bool same_face = layer.cut[i] == layer.cut[centre] &&
                             layer.normal[i].dot(layer.normal[centre]) > 0.9f &&
                             std::abs(layer.distance_m[i] - distance) < 0.1f + 0.02f * distance;
      if (!same_face) continue;
      sum += shade[pixel_index(u, v, layer.area.width())];
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : 0.0f;
}

/// How strongly an edge runs between a sample and its neighbour: 0 none, 1 bend, 2 rim of a nearer thing or a cut.
int edge_between(const SurfaceLayer& layer, std::size_t here, std::size_t there, std::size_t opposite) {
  const float distance = layer.distance_m[here];
  const float other = layer.distance_m[there];
  if (layer.cut[here] != layer.cut[there]) return layer.cut[here] != 0 ? 2 : 0;
  if (other == kNothing) return 2;
  if (layer.cut[here] != 0) return 0;
  // On one plane the distance's reciprocal changes evenly (in a top view the distance does, and nearly its reciprocal);
  // a leap against what the opposite neighbour foretells is a rim.
  const float foretold =
      layer.distance_m[opposite] == kNothing ? distance : 2.0f * distance - layer.distance_m[opposite];
  const float leap = other - std::max(foretold, distance);
  if (leap > 0.03f + 0.02f * std::abs(distance)) return 2;
  return layer.normal[here].dot(layer.normal[there]) < 0.85f ? 1 : 0;
}

double edge_weight(const SurfaceLayer& layer, int x, int y) {
  const std::size_t here = layer.index(x, y);
  if (layer.distance_m[here] == kNothing) return 0.0;
  constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  int strongest = 0;
  for (const auto& step : kNeighbours) {
    const int u = x + step[0];
    const int v = y + step[1];
    if (u < 0 || v < 0 || u >= layer.width || v >= layer.height) continue;
    const int p = std::clamp(x - step[0], 0, layer.width - 1);
    const int q = std::clamp(y - step[1], 0, layer.height - 1);
    strongest = std::max(strongest, edge_between(layer, here, layer.index(u, v), layer.index(p, q)));
  }
  return strongest == 2 ? 0.6 : strongest == 1 ? 0.28 : 0.0;
}

/// Calls `visit(x, y)` for each place of a grid; rows are shared out to threads.
template <typename Visit>
void parallel_pixels(int width, int height, unsigned threads, Visit visit) {
  constexpr std::size_t kRowsAtOnce = 16;
  parallel_for(static_cast<std::size_t>(height), kRowsAtOnce, threads,
               [&](std::size_t begin, std::size_t end) {
                 for_each_pixel({0, static_cast<int>(begin), width, static_cast<int>(end)}, visit);
               });
}

/// Calls `visit(index)` for each sample of a pixel of the layer's area.
template <typename Visit>
void for_each_sample(const SurfaceLayer& layer, int x, int y, Visit visit) {
  for_each_pixel({0, 0, layer.factor, layer.factor},
                 [&](int dx, int dy) { visit(layer.index(x * layer.factor + dx, y * layer.factor + dy)); });
}

}  // namespace

void darken_corners(SurfaceLayer& layer, const Camera& camera, unsigned threads) {
  const int width = layer.area.width(), height = layer.area.height();
  const CornerShade corners(layer, camera);
  std::vector<float> shade(pixel_index(0, height, width), 0.0f);
  parallel_pixels(width, height, threads,
                  [&](int x, int y) { shade[pixel_index(x, y, width)] = corners.at(x, y); });
  parallel_pixels(width, height, threads, [&](int x, int y) {
    const double share = std::min(1.0, 1.5 * static_cast<double>(smoothed(shade, layer, x, y)));
    const double dark = kDarkest * std::round(share * kSteps) / kSteps;
    if (dark <= 0.0) return;
    for_each_sample(layer, x, y, [&](std::size_t i) {
      layer.colour[i] = mix(layer.colour[i], {52, 48, 62}, dark);
    });
  });
}

void outline_faces(SurfaceLayer& layer, unsigned threads) {
  parallel_pixels(layer.width, layer.height, threads, [&](int x, int y) {
    const double weight = edge_weight(layer, x, y);
    if (weight <= 0.0) return;
    Rgb& colour = layer.colour[layer.index(x, y)];
    colour = mix(colour, palette::kInk, weight);
  });
}

void copy_to_image(const SurfaceLayer& layer, Image& image) {
  const int samples = layer.factor * layer.factor;
  for_each_pixel({0, 0, layer.area.width(), layer.area.height()}, [&](int x, int y) {
    int r = 0, g = 0, b = 0;
    bool anything = false;
    for_each_sample(layer, x, y, [&](std::size_t i) {
      const Rgb& c = layer.colour[i];
      anything = anything || layer.distance_m[i] != kNothing || c != palette::kPaper;
      r += c.r;
      g += c.g;
      b += c.b;
    });
    if (!anything) return;
    const auto mean = [samples](int sum) { return static_cast<std::uint8_t>((sum + samples / 2) / samples); };
    image.set(layer.area.left + x, layer.area.top + y, {mean(r), mean(g), mean(b)});
  });
}

Occluders make_occluders(const SurfaceLayer& layer) {
  Occluders out{layer.area, {}};
  const int width = layer.area.width(), height = layer.area.height();
  out.distance_m.reserve(pixel_index(0, height, width));
  for_each_pixel({0, 0, width, height}, [&](int x, int y) {
    float farthest = 0.0f;
    for_each_sample(layer, x, y, [&](std::size_t i) { farthest = std::max(farthest, layer.distance_m[i]); });
    out.distance_m.push_back(farthest);
  });
  return out;
}

}  // namespace hallway::render
