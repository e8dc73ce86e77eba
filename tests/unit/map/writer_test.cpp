// SPDX-License-Identifier: MIT
#include "map/writer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

#include "map/reader.hpp"
#include "map_text.hpp"
#include "random_document.hpp"
#include "same_document.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway::map {
namespace {

using hallway::test::error_of;

TEST(Writer, CanonicalText) {
  const std::string canonical =
      "// head\n{\n\"classname\" \"worldspawn\"\n\"say\" \"\\\"hi\\\"\"\n// a brush\n{\n"
      "( 1 2 3 ) ( 0.1 -0 100000 ) ( 7 8 9 ) wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n"
      "( 1 2 3 ) ( 4 5 6 ) ( 7 8 9 ) \"old wall\" [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1 4 5 6\n}\n}\n// end\n";
  EXPECT_EQ(print(parse(canonical, "a.map")), canonical);
}

TEST(Writer, KeysComeBeforeBrushes) {
  EXPECT_EQ(print(parse("{ { } \"a\" \"b\" }", "a.map")), "{\n\"a\" \"b\"\n{\n}\n}\n");
}

TEST(Writer, ParseOfPrintIsIdentityOnRandomDocuments) {
  const int count = hallway::test::sized(500, 50000);
  for (int seed = 0; seed < count; ++seed) {
    const Document document = test::RandomDocument(static_cast<std::uint64_t>(seed)).make();
    const std::string text = print(document);
    const Document again = parse(text, "again.map");
    ASSERT_EQ(test::difference(document, again), "") << "seed " << seed << "\n" << text;
    ASSERT_EQ(print(again), text) << "seed " << seed;
  }
}

TEST(Writer, ParseOfPrintIsIdentityOnRealMaps) {
  HALLWAY_DATA_OR_SKIP(folder, "maps");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".map") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  int read = 0;
  for (const auto& file : files) {
    Document document;
    const auto error = error_of([&] { document = load(file); });
    if (error) {
      EXPECT_EQ(error->code(), ErrorCode::kBadInput) << error->what();
      EXPECT_GT(error->where().line, 0) << error->what();
      continue;
    }
    ++read;
    const std::string text = print(document);
    const Document again = parse(text, "again.map");
    EXPECT_EQ(test::difference(document, again), "") << file;
    EXPECT_EQ(print(again), text) << file;
  }
  EXPECT_GE(read, 100) << "of " << files.size() << " files";
}

void expect_unprintable(const Document& document, const std::string& cause) {
  const auto error = error_of([&] { print(document); });
  ASSERT_TRUE(error) << cause;
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

Document with_key(const std::string& key, const std::string& value) {
  Document document;
  document.entities.emplace_back().add(key, value);
  return document;
}

TEST(Writer, RefusesALineBreakInAValue) {
  expect_unprintable(with_key("a", "b\nc"), "line break");
}
TEST(Writer, RefusesANulInAKey) {
  expect_unprintable(with_key(std::string("a\0b", 3), "c"), "NUL");
}
TEST(Writer, RefusesAKeyThatEndsInABackslash) {
  expect_unprintable(with_key("a\\", "c"), "backslash");
}
TEST(Writer, RefusesAKeyThatCannotBeReadBack) {
  expect_unprintable(with_key(std::string(2000, 'k'), "c"), "1024");
}

TEST(Writer, RefusesANumberThatIsNotFinite) {
  Brush brush;
  brush.faces.push_back(test::half_space(Vec3::UnitX(), 1.0));
  brush.faces[0].u_scale = std::numeric_limits<double>::quiet_NaN();
  expect_unprintable(test::document_of(brush), "not finite");
}

}  // namespace
}  // namespace hallway::map
