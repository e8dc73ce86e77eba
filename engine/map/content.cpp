// SPDX-License-Identifier: MIT
#include "map/content.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace hallway::map {
namespace {

/// A line of the table of the bits that Quake 2 and 3 write behind a face (SurfaceFlags). One such face makes the brush what the line says.
struct FlagRule {
  std::int64_t contents = 0;  ///< any of these bits of SurfaceFlags::contents
  std::int64_t flags = 0;     ///< or of SurfaceFlags::flags
  bool hint = false;
  bool detail = false;
  std::optional<LeftOut> left_out{};
};

constexpr MaterialRule left_out(std::string_view name, LeftOut reason, bool prefix = false) {
  return {.name = name, .prefix = prefix, .left_out = reason, .drawn = false};
}

constexpr std::array kMaterialRules{
    left_out("origin", LeftOut::kOrigin),
    MaterialRule{.name = "hint", .hint = true, .drawn = false},
    MaterialRule{.name = "hintskip", .hint = true, .drawn = false},
    left_out("clip", LeftOut::kClip),
    left_out("clip_mon", LeftOut::kClip),
    left_out("clip_plr", LeftOut::kClip),
    left_out("playerclip", LeftOut::kClip),
    left_out("monsterclip", LeftOut::kClip),
    left_out("weapclip", LeftOut::kClip),
    left_out("botclip", LeftOut::kClip),
    left_out("trigger", LeftOut::kTrigger),
    left_out("aaatrigger", LeftOut::kTrigger),
    left_out("areaportal", LeftOut::kPortal),
    left_out("antiportal", LeftOut::kPortal),
    MaterialRule{.name = "*", .prefix = true, .left_out = LeftOut::kLiquid},
    MaterialRule{.name = "!", .prefix = true, .left_out = LeftOut::kLiquid},
    MaterialRule{.name = "liquids/", .left_out = LeftOut::kLiquid},
    MaterialRule{.name = "skip", .drawn = false},
    MaterialRule{.name = "caulk", .drawn = false},
    MaterialRule{.name = "nodraw", .drawn = false},
    MaterialRule{.name = "null", .drawn = false},
};

constexpr std::array kFlagRules{
    FlagRule{.contents = 0x1000000, .left_out = LeftOut::kOrigin},
    FlagRule{.flags = 0x100, .hint = true},
    FlagRule{.contents = 0x30000, .left_out = LeftOut::kClip},
    FlagRule{.contents = 0x8000, .left_out = LeftOut::kPortal},
    FlagRule{.contents = 0x38, .left_out = LeftOut::kLiquid},
    FlagRule{.contents = 0x40, .left_out = LeftOut::kPassable},
    FlagRule{.contents = 0x8000000, .detail = true},
};

constexpr ClassRule solid(std::string_view name, BrushRole role, bool prefix = false) {
  return {.name = name, .prefix = prefix, .role = role};
}

constexpr ClassRule without_part(std::string_view name, LeftOut reason, bool prefix = false) {
  return {.name = name, .prefix = prefix, .left_out = reason};
}

constexpr std::array kClassRules{
    solid("worldspawn", BrushRole::kAdd),
    solid("func_group", BrushRole::kAdd),
    ClassRule{.name = "hw_add", .role = BrushRole::kAdd, .ordered = true},
    ClassRule{.name = "hw_subtract", .role = BrushRole::kSubtract, .ordered = true},
    ClassRule{.name = "hw_detail", .role = BrushRole::kDetail, .ordered = true},
    without_part("func_detail_illusionary", LeftOut::kPassable),
    solid("func_detail", BrushRole::kDetail, true),
    solid("func_wall", BrushRole::kDetail),
    solid("func_static", BrushRole::kDetail),
    without_part("func_illusionary", LeftOut::kPassable, true),
    without_part("func_areaportal", LeftOut::kPortal),
    without_part("func_viscluster", LeftOut::kPortal),
    without_part("func_", LeftOut::kMoving, true),
    without_part("rotate_", LeftOut::kMoving, true),
    without_part("trigger_", LeftOut::kTrigger, true),
    without_part("hw_gnss_zone", LeftOut::kTrigger),
};

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Whether `text` begins with `name`, which is in lower case, and is no longer unless `prefix`.
bool fits(std::string_view text, std::string_view name, bool prefix) {
  if (prefix ? text.size() < name.size() : text.size() != name.size()) return false;
  return std::equal(name.begin(), name.end(), text.begin(), [](char a, char b) { return a == lower(b); });
}

/// Whether one of the folders of a material's name is `folder`, which ends in a slash.
bool is_in_folder(std::string_view material, std::string_view folder) {
  for (std::size_t begin = 0; begin < material.size();) {
    if (fits(material.substr(begin), folder, true)) return true;
    const std::size_t slash = material.find('/', begin);
    if (slash == std::string_view::npos) return false;
    begin = slash + 1;
  }
  return false;
}

bool fits(std::string_view material, const MaterialRule& rule) {
  if (rule.name.ends_with('/')) return is_in_folder(material, rule.name);
  const std::size_t slash = material.rfind('/');
  return fits(slash == std::string_view::npos ? material : material.substr(slash + 1), rule.name,
              rule.prefix);
}

const MaterialRule* rule_of(std::string_view material) {
  const auto found = std::find_if(kMaterialRules.begin(), kMaterialRules.end(),
                                  [&](const MaterialRule& rule) { return fits(material, rule); });
  return found == kMaterialRules.end() ? nullptr : &*found;
}

/// The first line that fits any of the brush's materials, or null.
const MaterialRule* rule_of(const Brush& brush) {
  const MaterialRule* first = nullptr;
  const std::string* last_material = nullptr;  // most brushes have one material
  for (const Face& face : brush.faces) {
    if (last_material && *last_material == face.material) continue;
    last_material = &face.material;
    const MaterialRule* rule = rule_of(face.material);
    if (rule && (!first || rule < first)) first = rule;
  }
  return first;
}

/// The first line of the table of flags that any of the brush's faces has, or null.
const FlagRule* flag_rule_of(const Brush& brush) {
  const FlagRule* first = nullptr;
  for (const Face& face : brush.faces) {
    if (!face.surface_flags) continue;
    for (const FlagRule& rule : kFlagRules) {
      const bool has = (face.surface_flags->contents & rule.contents) != 0 ||
                       (face.surface_flags->flags & rule.flags) != 0;
      if (has && (!first || &rule < first)) first = &rule;
    }
  }
  return first;
}

BrushContent class_content(const Entity& entity) {
  const std::string* omit = entity.find("_omitbrushes");
  if (omit && !omit->empty() && *omit != "0") return {.left_out = LeftOut::kOmitted};
  const std::string_view name = entity.classname();
  for (const ClassRule& rule : kClassRules) {
    if (rule.name.starts_with("hw_") ? name != rule.name : !fits(name, rule.name, rule.prefix)) continue;
    return {rule.role, rule.ordered, rule.left_out.value_or(LeftOut::kOther)};
  }
  return {.left_out = LeftOut::kOther};
}

}  // namespace

std::string_view to_string(LeftOut reason) {
  switch (reason) {
    case LeftOut::kLiquid:
      return "liquid";
    case LeftOut::kClip:
      return "clip";
    case LeftOut::kTrigger:
      return "trigger";
    case LeftOut::kOrigin:
      return "origin";
    case LeftOut::kPortal:
      return "portal";
    case LeftOut::kPassable:
      return "passable";
    case LeftOut::kMoving:
      return "moving";
    case LeftOut::kOmitted:
      return "omitted";
    case LeftOut::kOther:
      break;
  }
  return "other class";
}

std::span<const MaterialRule> material_rules() {
  return kMaterialRules;
}

std::span<const ClassRule> class_rules() {
  return kClassRules;
}

BrushContent brush_content(const Entity& entity, const Brush& brush) {
  BrushContent content = class_content(entity);
  if (!content.role) return content;
  const MaterialRule* material = rule_of(brush);
  const FlagRule* flag = flag_rule_of(brush);
  if ((material && material->hint) || (flag && flag->hint)) {
    return {.role = BrushRole::kHint, .ordered = content.ordered};
  }
  if (content.role == BrushRole::kSubtract) return content;
  if (material && material->left_out) return {.left_out = *material->left_out};
  if (flag && flag->left_out) return {.left_out = *flag->left_out};
  if (flag && flag->detail) content.role = BrushRole::kDetail;
  return content;
}

bool is_sky(std::string_view material) {
  const std::size_t slash = material.rfind('/');
  return fits(slash == std::string_view::npos ? material : material.substr(slash + 1), "sky", true);
}

bool is_drawn(std::string_view material) {
  const MaterialRule* rule = rule_of(material);
  return !rule || rule->drawn;
}

}  // namespace hallway::map
