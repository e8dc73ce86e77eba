// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "map/reader.hpp"
#include "map_text.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::map {
namespace {

using hallway::test::error_of;
using test::cube_faces;
using test::face_line;
using test::map_of;

/// Expects a bad_input error at `line` of bad.map whose message holds `cause`.
void expect_error(const std::string& text, int line, const std::string& cause) {
  const auto error = error_of([&] { parse(text, "bad.map"); });
  ASSERT_TRUE(error) << "no error: " << cause;
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "bad.map");
  EXPECT_EQ(error->where().line, line) << error->what();
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

void expect_bad_number(const std::string& number) {
  expect_error(map_of(face_line("( 0 0 0 ) ( 0 " + number + " 0 ) ( 1 0 0 )")), 4,
               "`" + number + "` is no finite decimal");
}

TEST(ReaderErrors, CutInsideABrush) {
  expect_error("{\n{\n" + face_line("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 )"), 4, "end of the file");
}

TEST(ReaderErrors, CutInsideAFace) {
  expect_error("{\n{\n( 0 0 0 ) ( 0 1", 3, "found the end of the file");
}

TEST(ReaderErrors, CutInsideAnEntity) {
  expect_error("{\n\"a\" \"b\"\n", 3, "the entity begins at line 1");
}

TEST(ReaderErrors, NamesEntityAndBrush) {
  const auto error = error_of([] { parse("{\n}\n{\n{\n}\n{\n( x", "bad.map"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().element, "entity 1, brush 1");
}

TEST(ReaderErrors, NotANumber) {
  expect_bad_number("nan");
}
TEST(ReaderErrors, InfiniteNumber) {
  expect_bad_number("inf");
}
TEST(ReaderErrors, NumberBeyondDouble) {
  expect_bad_number("1e999");
}
TEST(ReaderErrors, HexNumber) {
  expect_bad_number("0x10");
}
TEST(ReaderErrors, CommaNumber) {
  expect_bad_number("1,5");
}

TEST(ReaderErrors, TwoCoordinates) {
  expect_error(map_of("( 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m"), 4, "found `)`");
}

TEST(ReaderErrors, StandardTextureCutShort) {
  expect_error(map_of("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m 0 0 0 1\n"), 5, "the texture's scale, found `}`");
}
TEST(ReaderErrors, HexenIiHasOneNumberMore) {
  expect_error(map_of("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m 0 0 0 1 1 0\n"), 5, "as Hexen II has it, is not read");
}

TEST(ReaderErrors, FaceOutsideABrush) {
  expect_error("{\n\"a\" \"b\"\n( 0 0 0 )\n}\n", 3, "a face that is in no brush");
}

TEST(ReaderErrors, BrushPrimitiveWithoutAMatrix) {
  expect_error("{\n{\nbrushDef\n{\n( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m\n}\n}\n}\n", 5,
               "expected `(` to begin the texture's matrix, found `m`");
}
TEST(ReaderErrors, PatchWithoutABlock) {
  expect_error("{\n{\npatchDef2\n}\n}\n", 4, "expected `{` after `patchDef2`, found `}`");
}
TEST(ReaderErrors, PatchThatDoesNotEnd) {
  expect_error("{\n{\npatchDef2\n{\n{\n}\n", 7,
               "the closing brace of `patchDef2`, found the end of the file (it begins at line 3)");
}
TEST(ReaderErrors, AMillionOpenBracesInAPatch) {
  std::string text = "{\n{\npatchDef2\n";
  for (int i = 0; i < 1000000; ++i) text += "{\n";
  expect_error(text, 1000004, "the closing brace of `patchDef2`");
}
TEST(ReaderErrors, PatchAfterFaces) {
  expect_error(map_of(cube_faces() + "patchDef2\n{\n}\n"), 10, "`patchDef2` after faces");
}
TEST(ReaderErrors, FacesAfterAPatch) {
  expect_error(map_of("patchDef2\n{\n}\n" + cube_faces()), 7, "expected `}`, found `(`");
}
TEST(ReaderErrors, UnknownWordInABrush) {
  expect_error(map_of("mesh\n"), 4, "expected `(` of a face or `}`, found `mesh`");
}

TEST(ReaderErrors, BraceInsideABrush) {
  expect_error("{\n{\n{\n}\n}\n}\n", 3, "inside a brush");
}

TEST(ReaderErrors, AMillionOpenBraces) {
  expect_error(std::string(1000000, '{'), 1, "inside a brush");
}

TEST(ReaderErrors, ClosingBraceTooMany) {
  expect_error("{\n}\n}\n", 3, "expected `{` to begin an entity, found `}`");
}

TEST(ReaderErrors, UnterminatedValue) {
  expect_error("{\n\"a\" \"b\n\"c\" \"d\"\n}\n", 2, "no closing quotation mark");
}
TEST(ReaderErrors, UnterminatedValueAtTheEnd) {
  expect_error("{\n\"a\" \"b", 2, "the value of `a` has no closing");
}
TEST(ReaderErrors, UnterminatedKey) {
  expect_error("{\n\"a\n", 2, "the key has no closing");
}

TEST(ReaderErrors, KeyWithoutValue) {
  expect_error("{\n\"lonely\"\n}\n", 2, "key `lonely` has no value");
}

TEST(ReaderErrors, KeyOfTenMegabytes) {
  expect_error("{\n\"" + std::string(10 << 20, 'k') + "\" \"v\"\n}\n", 2, "longer than 1024 bytes");
}

TEST(ReaderErrors, ValueOfTenMegabytes) {
  expect_error("{\n\"k\" \"" + std::string(10 << 20, 'v') + "\"\n}\n", 2, "longer than 1048576 bytes");
}

TEST(ReaderErrors, CommentOfTenMegabytes) {
  expect_error("\n//" + std::string(10 << 20, 'c'), 2, "a comment of 10485760 bytes");
}

TEST(ReaderErrors, MaterialOfTenMegabytes) {
  expect_error(map_of(face_line("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 )", std::string(10 << 20, 'm'))), 4,
               "longer than 1024 bytes");
}

TEST(ReaderErrors, MissingMaterial) {
  expect_error(map_of(face_line("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 )", "")), 4, "name of a material");
}

TEST(ReaderErrors, NulByte) {
  expect_error(std::string("{\n}\n\0", 5), 3, "NUL");
}
TEST(ReaderErrors, Utf16LittleEndian) {
  expect_error(std::string("\xFF\xFE{\0", 4), 1, "UTF-16");
}
TEST(ReaderErrors, Utf16BigEndian) {
  expect_error(std::string("\xFE\xFF\0{", 4), 1, "UTF-16");
}

TEST(ReaderErrors, FlagsThatAreNoFlags) {
  expect_error(map_of("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m [ 1 0 0 0 ] [ 0 1 0 0 ] 0 1 1 0.5 0 0\n"), 4,
               "surface flags");
}

TEST(ReaderErrors, TextOfTheFileIsEchoedSafely) {
  const auto error = error_of([] { parse("\x1b[31mred", "bad.map"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(std::string(error->what()).find('\x1b'), std::string::npos);
}

TEST(ReaderErrors, MissingFileIsAnIoError) {
  const hallway::test::TempFolder folder;
  const auto error = error_of([&] { load(folder / "absent.map"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
}

TEST(ReaderErrors, AFolderIsNoMap) {
  const hallway::test::TempFolder folder;
  EXPECT_TRUE(error_of([&] { load(folder.path()); }));
}

}  // namespace
}  // namespace hallway::map
