// SPDX-License-Identifier: MIT
#include "planes/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "base/random.hpp"

namespace hallway::planes {
namespace {

constexpr Range<double> kPairGap{4.0, 28.0};  // sigma
constexpr std::size_t kPlanesOfAPair = 12;    // one parallel and one attached pair for so many planes
constexpr double kShareRange = 10.0;          // most by least points of a plane
constexpr double kHoleShare = 0.25;
constexpr Range<double> kHoleSize{0.2, 0.5};    // radius, as a share of the shorter half side
constexpr std::uint32_t kPointsOfAPlane = 100;  // on average, at least
constexpr std::uint32_t kFewestOfAPlane = 20;
constexpr int kPlacements = 200;

/// Numbers of one scene, one after the other; each purpose has its own.
class Dice {
 public:
  Dice(std::uint64_t seed, const char* purpose, std::uint32_t scene)
      : random_(seed, stream_id(purpose)), scene_(scene) {}
  double uniform(double low, double high) { return random_.uniform(scene_, next_++, low, high); }
  Vec3 normals() {
    // Not as arguments of one call: their order would be the compiler's.
    const double x = random_.normal(scene_, next_++), y = random_.normal(scene_, next_++);
    return {x, y, random_.normal(scene_, next_++)};
  }
  /// Even by its logarithm.
  double logarithmic(const Range<double>& range) {
    return range.low * std::pow(range.high / range.low, uniform(0, 1));
  }
  /// From 0 to below `count`.
  std::size_t below(std::size_t count) {
    return std::min(static_cast<std::size_t>(uniform(0, static_cast<double>(count))), count - 1);
  }
  Vec3 direction() {
    const Vec3 v = normals();
    return v.norm() > 1e-9 ? Vec3(v.normalized()) : Vec3(Vec3::UnitX());
  }

 private:
  Random random_;
  std::uint32_t scene_;
  std::uint64_t next_ = 0;
};

struct Hole {
  double u = 0, v = 0, radius = 0;
};

Vec3 v_of(const SceneRectangle& rectangle) {
  return rectangle.normal.cross(rectangle.u);
}

class SceneMaker {
 public:
  SceneMaker(std::uint64_t seed, std::uint32_t index, const SceneOptions& options)
      : shape_(seed, "planes.scene.shape", index),
        places_(seed, "planes.scene.points", index),
        options_(options) {}

  Scene make() {
    const double logarithm = shape_.logarithmic(
        {static_cast<double>(options_.points.low), static_cast<double>(options_.points.high)});
    const auto points = static_cast<std::uint32_t>(std::lround(logarithm));
    noise_ = shape_.logarithmic(options_.noise);
    const bool clean = shape_.uniform(0, 1) < 0.5;
    const double outliers = clean ? 0.0 : shape_.uniform(0, options_.outliers);
    const std::size_t planes =
        options_.planes.low + shape_.below(options_.planes.high - options_.planes.low + 1);
    add_rectangles(
        std::max<std::size_t>(options_.planes.low, std::min<std::size_t>(planes, points / kPointsOfAPlane)));
    const auto n_outliers = static_cast<std::uint32_t>(outliers * points);
    share_out(points - n_outliers);
    for (std::size_t i = 0; i < scene_.rectangles.size(); ++i) add_points(scene_.rectangles[i], holes_[i]);
    for (std::uint32_t i = 0; i < n_outliers; ++i) add_point(anywhere(places_), kNoLabel);
    shuffle();
    return std::move(scene_);
  }

 private:
  Vec3 anywhere(Dice& dice) {
    const double x = dice.uniform(0, options_.box), y = dice.uniform(0, options_.box);
    return {x, y, dice.uniform(0, options_.box)};
  }

  bool fits(const SceneRectangle& rectangle) const {
    for (const Vec3& corner : corners_of(rectangle)) {
      if (corner.minCoeff() < 0 || corner.maxCoeff() > options_.box) return false;
    }
    return true;
  }

  /// Of what `propose` gives the first that fits into the box; nothing fitting, a small one in the middle of it.
  template <typename Propose>
  void place(Propose&& propose) {
    SceneRectangle rectangle;
    int attempts = 0;
    do {
      rectangle = propose();
    } while (!fits(rectangle) && ++attempts < kPlacements);
    if (!fits(rectangle))
      rectangle = random_rectangle(options_.half_size.low, Vec3::Constant(options_.box / 2));
    rectangle.label = static_cast<std::int64_t>(scene_.rectangles.size());
    rectangle.noise = noise_;
    scene_.rectangles.push_back(rectangle);
    const double shorter = std::min(rectangle.half_u, rectangle.half_v);
    Hole hole{shape_.uniform(-0.5, 0.5) * rectangle.half_u, shape_.uniform(-0.5, 0.5) * rectangle.half_v,
              shape_.uniform(kHoleSize.low, kHoleSize.high) * shorter};
    if (shape_.uniform(0, 1) >= kHoleShare) hole.radius = 0;
    holes_.push_back(hole);
  }

  SceneRectangle random_rectangle(double largest, const Vec3& centre) {
    SceneRectangle rectangle;
    rectangle.centre = centre;
    rectangle.normal = shape_.direction();
    Vec3 u = shape_.direction();
    u -= u.dot(rectangle.normal) * rectangle.normal;
    rectangle.u = u.norm() > 1e-6 ? Vec3(u.normalized()) : Vec3(rectangle.normal.unitOrthogonal());
    rectangle.half_u = shape_.uniform(options_.half_size.low, largest);
    rectangle.half_v = shape_.uniform(options_.half_size.low, largest);
    return rectangle;
  }

  void place_free() {
    place([&] { return random_rectangle(options_.half_size.high, anywhere(shape_)); });
  }

  /// One before the last one, parallel to it.
  void place_parallel() {
    const SceneRectangle other = scene_.rectangles.back();
    place([&] {
      SceneRectangle rectangle = other;
      const double side = shape_.uniform(0, 1) < 0.5 ? -1.0 : 1.0;
      rectangle.centre += side * noise_ * shape_.uniform(kPairGap.low, kPairGap.high) * other.normal;
      return rectangle;
    });
  }

  /// One upright on the last one: at an edge of it or within it.
  void place_attached() {
    const SceneRectangle other = scene_.rectangles.back();
    place([&] {
      SceneRectangle rectangle = other;
      rectangle.u = v_of(other);
      rectangle.half_u = other.half_v;
      rectangle.half_v = shape_.uniform(options_.half_size.low, options_.half_size.high);
      rectangle.normal = other.u;
      const double side = shape_.uniform(0, 1) < 0.5 ? -1.0 : 1.0;
      const double where = shape_.uniform(0, 1) < 0.5 ? 1.0 : shape_.uniform(-0.6, 0.6);
      rectangle.centre += where * other.half_u * other.u + side * rectangle.half_v * other.normal;
      return rectangle;
    });
  }

  void add_rectangles(std::size_t count) {
    const std::size_t pairs = (count + kPlanesOfAPair / 2) / kPlanesOfAPair;
    for (std::size_t pair = 0; pair < std::max<std::size_t>(pairs, 1) && count > 1; ++pair) {
      place_free();
      place_parallel();
      if (scene_.rectangles.size() + 2 > count) break;
      place_free();
      place_attached();
    }
    while (scene_.rectangles.size() < count) place_free();
  }

  /// How many points each plane has: a few, and a share of the rest that does not depend on its size.
  void share_out(std::uint32_t points) {
    std::vector<double> weights;
    for (std::size_t i = 0; i < scene_.rectangles.size(); ++i) {
      weights.push_back(shape_.uniform(1.0, kShareRange));
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto count = static_cast<std::uint32_t>(weights.size());
    const std::uint32_t least = std::min(kFewestOfAPlane, points / count);
    const double rest = static_cast<double>(points - least * count);
    std::uint32_t given = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      scene_.rectangles[i].points = least + static_cast<std::uint32_t>(rest * weights[i] / sum);
      given += scene_.rectangles[i].points;
    }
    scene_.rectangles.front().points += points - given;
  }

  void add_points(const SceneRectangle& rectangle, const Hole& hole) {
    const Vec3 v = v_of(rectangle);
    for (std::uint32_t i = 0; i < rectangle.points;) {
      const double a = places_.uniform(-rectangle.half_u, rectangle.half_u);
      const double b = places_.uniform(-rectangle.half_v, rectangle.half_v);
      const Vec2 from_hole(a - hole.u, b - hole.v);
      if (from_hole.squaredNorm() < hole.radius * hole.radius) continue;
      add_point(rectangle.centre + a * rectangle.u + b * v + noise_ * places_.normals(), rectangle.label);
      ++i;
    }
  }

  void add_point(const Vec3& point, std::int64_t label) {
    scene_.points.push_back(point);
    scene_.labels.push_back(label);
  }

  void shuffle() {
    for (std::size_t i = scene_.points.size(); i > 1; --i) {
      const std::size_t k = places_.below(i);
      std::swap(scene_.points[i - 1], scene_.points[k]);
      std::swap(scene_.labels[i - 1], scene_.labels[k]);
    }
  }

  Dice shape_;
  Dice places_;
  const SceneOptions& options_;
  double noise_ = 0.0;
  Scene scene_;
  std::vector<Hole> holes_;  ///< of each rectangle; of radius 0: none
};

void check(const SceneOptions& options) {
  const auto demand = [](bool condition, const char* text) {
    if (!condition) throw Error(ErrorCode::kUsage, text);
  };
  demand(options.planes.low >= 1 && options.planes.low <= options.planes.high,
         "--planes: 1 or more, LOW..HIGH");
  demand(options.points.low >= options.planes.low && options.points.low <= options.points.high,
         "--points: one or more for each plane, LOW..HIGH");
  demand(options.noise.low > 0 && options.noise.low <= options.noise.high &&
             options.noise.high < options.box / 40,
         "--sigma: above 0, below a fortieth of the box, LOW..HIGH");
  demand(options.half_size.low > 0 && options.half_size.low <= options.half_size.high &&
             options.half_size.high <= options.box / 4,
         "--half-size: above 0, at most a quarter of the box, LOW..HIGH");
  demand(options.outliers >= 0 && options.outliers <= 0.9, "--outliers: 0 to 0.9");
}

}  // namespace

Corners corners_of(const SceneRectangle& rectangle) {
  const Vec3 u = rectangle.half_u * rectangle.u, v = rectangle.half_v * v_of(rectangle), c = rectangle.centre;
  return {c - u - v, c + u - v, c + u + v, c - u + v};
}

Scene make_scene(std::uint64_t seed, std::uint32_t index, const SceneOptions& options) {
  check(options);
  return SceneMaker(seed, index, options).make();
}

Truth truth_of(const Scene& scene) {
  Truth truth{.labels = scene.labels};
  for (const SceneRectangle& rectangle : scene.rectangles) {
    truth.planes.push_back({.label = rectangle.label,
                            .plane = {rectangle.normal, rectangle.normal.dot(rectangle.centre)},
                            .corners = corners_of(rectangle)});
    truth.noise = std::max(truth.noise, rectangle.noise);
  }
  return truth;
}

}  // namespace hallway::planes
