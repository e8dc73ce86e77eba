// SPDX-License-Identifier: MIT
#include "map/entity_schema.hpp"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "map/check.hpp"
#include "map/content.hpp"
#include "support/data.hpp"

namespace hallway::map {
namespace {

std::string text_of(const std::string& name) {
  return read_file(hallway::test::source_folder() / name);
}

/// A class of an FGD file: whether it has brushes, and its keys with their types.
struct FgdClass {
  bool has_brushes = false;
  std::map<std::string, std::string> keys;
};

std::map<std::string, FgdClass> fgd_classes() {
  const std::string text = text_of("maps/trenchbroom/hallway.fgd");
  static const std::regex kClass(R"(@(PointClass|SolidClass)[^=\n]*= (\w+) :)");
  static const std::regex kKey(R"(\n\t(\w+)\((\w+)\) : ")");
  std::map<std::string, FgdClass> classes;
  for (std::sregex_iterator at(text.begin(), text.end(), kClass), end; at != end; ++at) {
    const auto begin = static_cast<std::size_t>(at->position() + at->length());
    const std::string body = text.substr(begin, text.find("\n]", begin) - begin);
    FgdClass& made = classes[(*at)[2]];
    made.has_brushes = (*at)[1] == "SolidClass";
    for (std::sregex_iterator key(body.begin(), body.end(), kKey); key != end; ++key)
      made.keys[(*key)[1]] = (*key)[2];
  }
  return classes;
}

std::string fgd_type(KeyKind kind) {
  switch (kind) {
    case KeyKind::kNumber:
      return "float";
    case KeyKind::kWhole:
    case KeyKind::kSeed:
      return "integer";
    case KeyKind::kFlag:
    case KeyKind::kChoice:
      return "choices";
    case KeyKind::kText:
    case KeyKind::kName:
    case KeyKind::kPoint:
    case KeyKind::kVector:
    case KeyKind::kNumbers:
    case KeyKind::kList:
    case KeyKind::kScale:
      break;
  }
  return "string";
}

TEST(EntitySchema, TheEditorsClassesAreThoseOfTheCode) {
  const auto classes = fgd_classes();
  EXPECT_EQ(classes.size(), entity_schema().size());
  for (const EntitySpec& spec : entity_schema()) {
    SCOPED_TRACE(spec.classname);
    const auto found = classes.find(std::string(spec.classname));
    ASSERT_NE(found, classes.end());
    EXPECT_EQ(found->second.has_brushes, spec.shape == EntityShape::kBrushes);
    std::map<std::string, std::string> expected;
    for (const KeySpec& key : spec.keys)
      expected.emplace(key.name, fgd_type(key.kind));  // the first of variants
    EXPECT_EQ(found->second.keys, expected);
  }
}

/// The rows of the entity table in the documentation: the keys of each class.
std::map<std::string, std::set<std::string>> documented_keys() {
  const std::string text = text_of("docs/formats.md");
  static const std::regex kRow(R"(\n\|([^|\n]*)\| `(\w+)` \|)");
  static const std::regex kName(R"(`(\w+)`)");
  std::map<std::string, std::set<std::string>> keys;
  const std::size_t begin = text.find("### Entities");
  const std::string table = text.substr(begin, text.find("**Paths.**") - begin);
  std::set<std::string> current;
  for (std::sregex_iterator row(table.begin(), table.end(), kRow), end; row != end; ++row) {
    const std::string names = (*row)[1];
    if (names.find_first_not_of(' ') != std::string::npos && !names.starts_with(" …")) {
      current.clear();
      for (std::sregex_iterator name(names.begin(), names.end(), kName); name != end; ++name)
        current.insert((*name)[1]);
    }
    for (const std::string& name : current) keys[name].insert((*row)[2]);
  }
  return keys;
}

TEST(EntitySchema, TheDocumentationHasEveryClassAndKey) {
  const auto documented = documented_keys();
  for (const EntitySpec& spec : entity_schema()) {
    SCOPED_TRACE(spec.classname);
    std::set<std::string> expected;
    for (const KeySpec& key : spec.keys) expected.insert(std::string(key.name));
    const auto found = documented.find(std::string(spec.classname));
    ASSERT_NE(found, documented.end());
    EXPECT_EQ(found->second, expected);
  }
  EXPECT_EQ(documented.size(), entity_schema().size());
}

TEST(EntitySchema, TheDocumentationHasTheTablesOfContent) {
  const std::string text = text_of("docs/formats.md");
  for (const MaterialRule& rule : material_rules()) {
    const std::string name = "`" + std::string(rule.name) + (rule.prefix ? "…`" : "`");
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
  for (const ClassRule& rule : class_rules()) {
    const std::string name = "`" + std::string(rule.name) + (rule.prefix ? "…`" : "`");
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

TEST(EntitySchema, TheDocumentationHasEveryFinding) {
  const std::string text = text_of("docs/formats.md");
  for (const std::string& id : finding_ids()) EXPECT_NE(text.find("`" + id + "`"), std::string::npos) << id;
}

TEST(EntitySchema, TheGameConfigurationFitsTheFormats) {
  const auto config = nlohmann::json::parse(text_of("maps/trenchbroom/GameConfig.cfg"));
  EXPECT_EQ(config.at("name"), "Hallway");
  EXPECT_EQ(config.at("softMapBounds"), "-100000 -100000 -100000 100000 100000 100000");
  std::set<std::string> formats;
  for (const auto& format : config.at("fileformats")) formats.insert(format.at("format").get<std::string>());
  EXPECT_EQ(formats, (std::set<std::string>{"Valve", "Standard"}));
  for (const auto& file : config.at("entities").at("definitions"))
    EXPECT_FALSE(text_of("maps/trenchbroom/" + file.get<std::string>()).empty());
}

TEST(EntitySchema, VariantsFollowTheSelector) {
  const EntitySpec* path = find_entity_spec("hw_path");
  ASSERT_TRUE(path);
  Entity entity;
  EXPECT_EQ(variant_of(*path, entity), "waypoints");
  entity.add("shape", "lemniscate");
  EXPECT_EQ(variant_of(*path, entity), "lemniscate");
  EXPECT_FALSE(find_entity_spec("hw_nothing"));
}

}  // namespace
}  // namespace hallway::map
