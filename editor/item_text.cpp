// SPDX-License-Identifier: MIT
#include "editor/item_text.hpp"

#include <utility>

#include "base/error.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"

namespace hallway::editor {
namespace {

constexpr std::string_view kOpen = "{\n";
constexpr std::string_view kClose = "}\n";

map::Entity only_entity(const std::string& text) {
  map::Document document = map::parse(text, "journal");
  if (document.entities.size() != 1 || !document.closing_comments.empty()) {
    throw Error(ErrorCode::kBadInput, "a text in a change is not one entity");
  }
  return std::move(document.entities.front());
}

}  // namespace

std::string text_of(const map::Entity& entity) {
  map::Document document;
  document.entities.push_back(entity);
  return map::print(document);
}

std::string text_of(const map::Brush& brush) {
  map::Entity entity;
  entity.brushes.push_back(brush);
  const std::string text = text_of(entity);
  return text.substr(kOpen.size(), text.size() - kOpen.size() - kClose.size());
}

map::Brush brush_of(const std::string& text) {
  map::Entity entity = only_entity(std::string(kOpen) + text + std::string(kClose));
  if (entity.brushes.size() != 1 || !entity.keys.empty() || !entity.closing_comments.empty()) {
    throw Error(ErrorCode::kBadInput, "a text in a change is not one brush");
  }
  return std::move(entity.brushes.front());
}

map::Entity head_of(const std::string& text) {
  map::Entity entity = only_entity(text);
  if (!entity.brushes.empty())
    throw Error(ErrorCode::kBadInput, "a text in a change is not the head of an entity");
  return entity;
}

}  // namespace hallway::editor
