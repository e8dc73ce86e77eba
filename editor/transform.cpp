// SPDX-License-Identifier: MIT
#include "editor/transform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/made_line.hpp"
#include "editor/shapes.hpp"
#include "map/entity_schema.hpp"
#include "map/world.hpp"

namespace hallway::editor {
namespace {

using Kind = Transform::Kind;
constexpr double kDegree = std::numbers::pi / 180.0;

/// A sum of terms of that size. Where it is a decimal of seven places but for rounding, it is that decimal.
double cleaned(double sum, double size) {
  constexpr double kFine = 1e7, kLargest = 1e8;
  if (std::abs(sum) > kLargest) return sum;
  const double decimal = std::round(sum * kFine) / kFine;
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * size;
  return (std::abs(decimal - sum) <= rounding ? decimal : sum) + 0.0;  // no negative zero
}

/// linear * x + shift.
Vec3 affine(const Eigen::Matrix3d& linear, const Vec3& x, const Vec3& shift) {
  Vec3 result;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double sum = linear(i, 0) * x[0] + linear(i, 1) * x[1] + linear(i, 2) * x[2] + shift[i];
    const double size = linear.row(i).cwiseAbs().dot(x.cwiseAbs()) + std::abs(shift[i]);
    result[i] = cleaned(sum, size);
  }
  return result;
}

/// Where a point of the map goes.
Vec3 moved(const Vec3& point, const Transform& transform) {
  const Vec3 there = transform(point);
  if (!(there.cwiseAbs().maxCoeff() <= map::kMaxCoordinate))
    refuse("that would put something beyond the largest coordinate of a map");
  return there;
}

bool is_scaling(const Transform& transform) {
  return transform.kind == Kind::kScale || transform.kind == Kind::kUnits;
}

bool is_even(const Vec3& factors) {
  return factors.x() == factors.y() && factors.y() == factors.z();
}

/// One texture axis with its scale and offset, such that every point of the face keeps its place in the texture.
void carry_axis(Vec3& axis, double& scale, double& offset, const Transform& transform) {
  if (is_scaling(transform)) {
    if (is_even(transform.factors)) {
      scale = cleaned(scale * transform.factors.x(), std::abs(scale * transform.factors.x()));
    } else {
      const Vec3 stretched = axis.cwiseQuotient(transform.factors);
      const double ratio = axis.norm() > 0.0 ? stretched.norm() / axis.norm() : 1.0;
      axis = (stretched / ratio).array() + 0.0;
      scale = cleaned(scale / ratio, std::abs(scale / ratio));
    }
  } else if (transform.kind != Kind::kMove) {
    axis = affine(transform.linear, axis, Vec3::Zero());
  }
  const double divisor = scale == 0.0 ? 1.0 : scale;
  const Vec3 terms = transform.shift.cwiseProduct(axis) / divisor;
  offset = cleaned(offset - terms.sum(), std::abs(offset) + terms.cwiseAbs().sum());
}

double turned_deg(double angle_deg, double by_deg) {
  constexpr double kFine = 1e9;
  double angle = std::fmod(std::round((angle_deg + by_deg) * kFine) / kFine, 360.0);
  if (angle < 0.0) angle = std::round((angle + 360.0) * kFine) / kFine;
  return angle >= 360.0 ? 0.0 : angle + 0.0;
}

/// The rotation of "pitch yaw roll" in degrees, and back.
Eigen::Matrix3d rotation_of(const Vec3& angles) {
  return from_yaw_pitch_roll(angles.y() * kDegree, angles.x() * kDegree, angles.z() * kDegree)
      .toRotationMatrix();
}

Vec3 angles_of(const Eigen::Matrix3d& rotation) {
  constexpr double kStraightUp = 1.0 - 1e-12;
  const double sine = std::clamp(-rotation(2, 0), -1.0, 1.0);
  Vec3 angles(std::asin(sine), 0.0, 0.0);
  if (std::abs(sine) > kStraightUp) {
    angles.y() = std::atan2(-rotation(0, 1), rotation(1, 1));
  } else {
    angles.y() = std::atan2(rotation(1, 0), rotation(0, 0));
    angles.z() = std::atan2(rotation(2, 1), rotation(2, 2));
  }
  for (double& angle : angles) angle = std::round(angle / kDegree * 1e9) / 1e9 + 0.0;
  return angles;
}

/// Changes the keys of one entity.
class Keys {
 public:
  Keys(map::Entity head, const Transform& transform, std::set<std::string>& notes)
      : head_(std::move(head)),
        transform_(transform),
        notes_(notes),
        spec_(map::find_entity_spec(head_.classname())) {}

  map::Entity finish() {
    place();
    if (transform_.kind == Kind::kTurn || transform_.kind == Kind::kMirror) turn();
    if (transform_.kind == Kind::kScale) scale();
    unlink();
    return std::move(head_);
  }

 private:
  void set(const char* key, const std::string& value) {
    const auto last = std::find_if(head_.keys.rbegin(), head_.keys.rend(),
                                   [&](const map::KeyValue& pair) { return pair.key == key; });
    if (last != head_.keys.rend()) {
      last->value = value;
    } else {
      head_.add(key, value);
    }
  }

  /// Whether the class, as Hallway reads it, has the key in this variant.
  bool has_key(std::string_view key) const {
    if (spec_ == nullptr) return false;
    const std::string_view variant = map::variant_of(*spec_, head_);
    return std::ranges::any_of(
        spec_->keys, [&](const map::KeySpec& one) { return one.name == key && map::belongs(one, variant); });
  }

  void place() {
    const std::string* text = head_.find("origin");
    if (text == nullptr) return;
    const auto origin = three_numbers(*text);
    if (!origin) {
      refuse("the origin \"{}\" of a {} is not three numbers", printable(*text),
             printable(head_.classname()));
    }
    set("origin", vector_text(moved(*origin, transform_)));
  }

  void turn() {
    if (const std::string* text = head_.find("angles")) {
      if (const auto angles = three_numbers(*text)) return turn_angles(*angles);
      notes_.insert(
          fmt::format("angles \"{}\" that are not three numbers stay as they are", printable(*text)));
      return;
    }
    const std::string* text = head_.find("angle");
    if (text == nullptr && !has_key("angle")) return;
    const auto angle = text == nullptr ? std::optional<double>(0.0) : parse_double(*text);
    if (!angle || (spec_ == nullptr && (*angle == -1.0 || *angle == -2.0))) return;  // up and down, in games
    turn_angle(*angle);
  }

  void turn_angles(Vec3 angles) {
    if (is_level_turn()) {
      angles.y() = turned_deg(angles.y(), transform_.turn_deg);
    } else {
      angles = angles_of(transform_.linear * rotation_of(angles) * flip());
      if (transform_.kind == Kind::kMirror) flip_scale();
    }
    set("angles", vector_text(angles));
  }

  void turn_angle(double angle) {
    const Vec3 up = transform_.linear * Vec3::UnitZ();
    if (is_level_turn()) {
      angle = turned_deg(angle, transform_.turn_deg);
    } else if (transform_.kind == Kind::kMirror) {
      if (transform_.axis != 2) angle = turned_deg(transform_.axis == 0 ? 180.0 - angle : -angle, 0.0);
      flip_scale();
      if (head_.classname() == "hw_path")
        notes_.insert("a lemniscate goes round its first loop to the left, mirrored or not");
    } else if (has_key("angles")) {
      head_.erase("angle");
      return set("angles", vector_text(angles_of(transform_.linear * rotation_of({0.0, angle, 0.0}))));
    } else {
      const Vec3 heading =
          transform_.linear * Vec3(std::cos(angle * kDegree), std::sin(angle * kDegree), 0.0);
      if (up.z() < 1.0 - 1e-12)
        notes_.insert(fmt::format("a {} has a heading only and is not tilted", printable(head_.classname())));
      if (heading.head<2>().norm() > 1e-9)
        angle = turned_deg(std::atan2(heading.y(), heading.x()) / kDegree, 0.0);
    }
    if (head_.find("angle") != nullptr || angle != 0.0) set("angle", format_double(angle));
  }

  bool is_level_turn() const { return transform_.kind == Kind::kTurn && transform_.axis == 2; }
  /// Which of its own axes a mirrored thing is reversed along, so that it stays upright.
  int flipped_axis() const { return transform_.axis == 2 ? 2 : 1; }
  Eigen::Matrix3d flip() const {
    Vec3 signs = Vec3::Ones();
    if (transform_.kind == Kind::kMirror) signs[flipped_axis()] = -1.0;
    return signs.asDiagonal();
  }
  void flip_scale() {
    Vec3 signs = Vec3::Ones();
    signs[flipped_axis()] = -1.0;
    if (has_key("scale")) multiply_scale(signs);
  }

  void multiply_scale(const Vec3& factors) {
    const std::string* text = head_.find("scale");
    Vec3 scale = Vec3::Ones();
    if (text != nullptr) {
      const auto one = parse_double(trim(*text));
      const auto three = three_numbers(*text);
      if (!one && !three) return static_cast<void>(notes_.insert("a scale that is no number stays as it is"));
      scale = one ? Vec3(Vec3::Constant(*one)) : *three;
    }
    for (Eigen::Index i = 0; i < 3; ++i)
      scale[i] = cleaned(scale[i] * factors[i], std::abs(scale[i] * factors[i]));
    if (!is_even(scale)) return set("scale", vector_text(scale));
    if (scale.x() == 1.0) return head_.erase("scale");
    set("scale", format_double(scale.x()));
  }

  void scale() {
    if (has_key("scale")) scale_model();
    if (spec_ == nullptr || !spec_->classname.starts_with("hw_")) return;
    for (const char* key : {"corner_radius_m", "length_m", "rise_m", "sideways_m", "height_m"}) {
      if (!has_key(key)) continue;
      const std::string* text = head_.find(key);
      const auto length = parse_double(text != nullptr ? std::string_view(*text) : spec_->key(key)->fallback);
      if (!length || *length == 0.0) continue;
      if (is_even(transform_.factors)) {
        const double product = *length * transform_.factors.x();
        set(key, format_double(cleaned(product, std::abs(product))));
      } else {
        notes_.insert(fmt::format("{} stays as it is: the factors differ", key));
      }
    }
  }

  void scale_model() {
    if (is_even(transform_.factors)) return multiply_scale(transform_.factors);
    const std::string* angles = head_.find("angles");
    const std::string* angle = head_.find("angle");
    std::optional<Vec3> turned = Vec3(Vec3::Zero());
    if (angles != nullptr) {
      turned = three_numbers(*angles);
    } else if (angle != nullptr) {
      turned->y() = parse_double(*angle).value_or(0.0);
    }
    if (!turned) return;
    const Eigen::Matrix3d own = rotation_of(*turned).cwiseAbs();
    Vec3 factors;
    for (Eigen::Index i = 0; i < 3; ++i) {
      Eigen::Index along = 0;
      if (own.col(i).maxCoeff(&along) < 1.0 - 1e-9)
        return static_cast<void>(
            notes_.insert("a model that stands askew keeps its size: the factors differ"));
      factors[i] = transform_.factors[along];
    }
    multiply_scale(factors);
  }

  /// TrenchBroom keeps linked groups alike by a matrix of where each stands.
  void unlink() {
    if (head_.find("_tb_linked_group_id") == nullptr) return;
    head_.erase("_tb_linked_group_id");
    head_.erase("_tb_transformation");
    notes_.insert("a linked group is linked no longer");
  }

  map::Entity head_;
  const Transform& transform_;
  std::set<std::string>& notes_;
  const map::EntitySpec* spec_;
};

double heading_deg(double angle_rad, const Transform& transform) {
  const double angle = angle_rad / kDegree;
  if (transform.kind == Kind::kTurn && transform.axis == 2) return turned_deg(angle, transform.turn_deg);
  if (transform.kind == Kind::kMirror && transform.axis == 0) return turned_deg(180.0 - angle, 0.0);
  if (transform.kind == Kind::kMirror && transform.axis == 1) return turned_deg(-angle, 0.0);
  return angle;
}

/// The line with its places, ways and heading where the transform takes them; nothing promises that it makes the same yet.
std::string moved_line(const std::string& line, const Transform& transform, const Units& units) {
  Call call = parse_line(line, units);
  if (call.command == nullptr) return line;
  const double unit = units.metres_per_unit;
  map_places(*call.command, call.arguments,
             [&](const Vec3& place) -> Vec3 { return transform(place / unit) * unit; });
  for (const ArgSpec& spec : call.command->arguments) {
    const std::string_view name = spec.name;
    if (!call.arguments.has(name)) continue;
    if (spec.kind == ArgKind::kVector) {
      call.arguments.set(name, affine(transform.linear, call.arguments.place(name), Vec3::Zero()));
    } else if (name == "open" && transform.kind == Kind::kMirror && transform.axis != 2) {
      call.arguments.set(name, -call.arguments.number(name));  // a door's leaf opens to the other side
    } else if (spec.kind == ArgKind::kAngle && name == "heading") {
      call.arguments.set(name, heading_deg(call.arguments.number(name), transform) * kDegree);
    }
  }
  return line_of(*call.command, call.arguments);
}

/// What the line of an entity becomes; empty where no line makes it any more.
std::string line_after(const Edit& edit, std::size_t maker, const Transform& transform) {
  const std::string* line = edit.state.entities[maker]->head->find(kMadeKey);
  if (line == nullptr || transform.kind == Kind::kScale) return {};
  try {
    std::string next = *line;
    if (transform.kind != Kind::kUnits) next = moved_line(next, transform, units_of(edit.state));
    return makes(edit, next, maker) ? next : std::string();
  } catch (const Error&) {
    return {};  // a line of another version
  }
}

void carry_lines(Edit& edit, const std::vector<Thing>& things, const Transform& transform) {
  std::set<std::size_t> seen, whole, makers;
  for (const Thing& thing : things) {
    if (!thing.brush) whole.insert(thing.entity);
    if (!seen.insert(thing.entity).second) continue;
    if (const auto maker = maker_of(edit.state, thing)) makers.insert(*maker);
  }
  // From the outside in: what a line of an opening makes hangs on that of its wall.
  std::vector<std::pair<std::size_t, std::size_t>> by_depth;
  for (const std::size_t maker : makers)
    by_depth.emplace_back(groups_of(edit.state, {maker, {}}).size(), maker);
  std::ranges::sort(by_depth, [&](const auto& a, const auto& b) {
    const auto is_inside = [&](std::size_t e) { return !group_number(*edit.state.entities[e]); };
    return std::tuple(a.first, is_inside(a.second), a.second) <
           std::tuple(b.first, is_inside(b.second), b.second);
  });
  for (const auto& [depth, maker] : by_depth)
    set_key(edit.state, maker, kMadeKey,
            whole.contains(maker) ? line_after(edit, maker, transform) : std::string());
}

[[noreturn]] void refuse_unread(const EntityItem& entity, const map::Brush& brush) {
  const auto item =
      std::ranges::find_if(entity.brushes, [&](const BrushItem& one) { return one.brush.get() == &brush; });
  refuse("#{} is a shape that is kept as text, such as a patch, and cannot be changed so; leave it out",
         item == entity.brushes.end() ? entity.id : item->id);
}

bool is_identity(const Transform& transform) {
  return transform.linear == Eigen::Matrix3d::Identity() && transform.shift == Vec3::Zero();
}

}  // namespace

Vec3 Transform::operator()(const Vec3& point) const {
  return affine(linear, point, shift);
}

Transform move_by(const Vec3& way) {
  Transform transform;
  transform.shift = way;
  return transform;
}

Transform turn_about(const Vec3& centre, int axis, double angle_deg) {
  constexpr std::array<std::array<double, 2>, 4> kQuarters{
      {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}};
  Transform transform;
  transform.kind = Kind::kTurn;
  transform.axis = axis;
  transform.turn_deg = turned_deg(angle_deg, 0.0);
  const double quarters = transform.turn_deg / 90.0;
  double cosine = std::cos(transform.turn_deg * kDegree), sine = std::sin(transform.turn_deg * kDegree);
  if (quarters == std::floor(quarters)) {
    cosine = kQuarters[static_cast<std::size_t>(quarters)][0];
    sine = kQuarters[static_cast<std::size_t>(quarters)][1];
  }
  const Eigen::Index i = (axis + 1) % 3, j = (axis + 2) % 3;
  transform.linear(i, i) = transform.linear(j, j) = cosine;
  transform.linear(j, i) = sine;
  transform.linear(i, j) = -sine;
  transform.shift = affine(-transform.linear, centre, centre);
  return transform;
}

Transform scale_about(const Vec3& centre, const Vec3& factors) {
  Transform transform;
  transform.kind = Kind::kScale;
  transform.factors = factors;
  transform.linear = factors.asDiagonal();
  transform.shift = affine(-transform.linear, centre, centre);
  return transform;
}

Transform mirror_at(int axis, double place) {
  Transform transform;
  transform.kind = Kind::kMirror;
  transform.axis = axis;
  transform.linear(axis, axis) = -1.0;
  transform.shift[axis] = 2.0 * place;
  return transform;
}

Transform change_units(double from, double to) {
  Transform transform = scale_about(Vec3::Zero(), Vec3::Constant(from / to));
  transform.kind = Kind::kUnits;
  return transform;
}

map::Brush transformed(const map::Brush& brush, const Transform& transform) {
  if (!brush.unread.empty()) {
    refuse("a shape that is kept as text, such as a patch, cannot be changed so");
  }
  map::Brush result = brush;
  for (map::Face& face : result.faces) {
    for (Vec3& point : face.points) {
      point = moved(point, transform);
    }
    if (transform.kind == Kind::kMirror) std::swap(face.points[1], face.points[2]);
    carry_axis(face.u_axis, face.u_scale, face.u_offset, transform);
    carry_axis(face.v_axis, face.v_scale, face.v_offset, transform);
  }
  if (transform.kind == Kind::kScale && body_of(brush) && !body_of(result))
    refuse("a brush would be too thin to be a body");
  return result;
}

map::Entity transformed(const map::Entity& head, const Transform& transform, std::set<std::string>& notes) {
  return Keys(head, transform, notes).finish();
}

void change_brushes(State& state, const std::vector<Thing>& things,
                    const std::function<std::optional<map::Brush>(const EntityItem& entity,
                                                                  const map::Brush& brush)>& change) {
  std::map<std::size_t, std::vector<std::size_t>> wanted;
  for (const Thing& thing : things) {
    std::vector<std::size_t>& brushes = wanted[thing.entity];
    if (thing.brush) {
      brushes.push_back(*thing.brush);
      continue;
    }
    brushes.clear();
    for (std::size_t b = 0; b < state.entities[thing.entity]->brushes.size(); ++b) brushes.push_back(b);
  }
  for (const auto& [entity, brushes] : wanted) {
    auto copy = std::make_shared<EntityItem>(*state.entities[entity]);
    bool changed = false;
    for (const std::size_t b : brushes) {
      auto brush = change(*state.entities[entity], *copy->brushes[b].brush);
      if (!brush) continue;
      copy->brushes[b].brush = std::make_shared<const map::Brush>(std::move(*brush));
      changed = true;
    }
    if (changed) state.entities[entity] = std::move(copy);
  }
}

void transform_things(Edit& edit, const std::vector<Thing>& meant, const Transform& transform) {
  if (is_identity(transform)) return;
  const auto things = with_members(edit.state, meant);
  std::set<std::string> notes;
  change_brushes(edit.state, things,
                 [&](const EntityItem& entity, const map::Brush& brush) -> std::optional<map::Brush> {
                   if (!brush.unread.empty()) refuse_unread(entity, brush);
                   for (const map::Face& face : brush.faces) {
                     if (face.texture_matrix)
                       notes.insert("textures placed by a brush primitive's matrix stay where they were");
                   }
                   return transformed(brush, transform);
                 });
  for (const Thing& thing : things) {
    if (thing.brush) continue;
    const map::Entity& head = *edit.state.entities[thing.entity]->head;
    map::Entity next = transformed(head, transform, notes);
    if (next.keys != head.keys) set_head(edit.state, thing.entity, std::move(next));
  }
  carry_lines(edit, things, transform);
  for (const std::string& note : notes) edit.report.note(note);
}

Vec3 way_units(const Edit& edit, const Vec3& way_m) {
  return without_grid(edit.state).units(way_m);
}

}  // namespace hallway::editor
