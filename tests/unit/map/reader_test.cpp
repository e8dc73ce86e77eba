// SPDX-License-Identifier: MIT
#include "map/reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "map_text.hpp"

namespace hallway::map {
namespace {

using test::cube_faces;
using test::map_of;

TEST(Reader, EmptyTextIsAnEmptyDocument) {
  EXPECT_TRUE(parse("", "a.map").entities.empty());
}

TEST(Reader, ReadsKeysInOrderWithTheirLines) {
  const Document document = parse("{\n\"b\" \"1\"\n\"a\" \"2\"\n}\n", "a.map");
  ASSERT_EQ(document.entities.size(), 1u);
  const Entity& entity = document.entities[0];
  EXPECT_EQ(entity.line, 1);
  ASSERT_EQ(entity.keys.size(), 2u);
  EXPECT_EQ(entity.keys[0].key, "b");
  EXPECT_EQ(entity.keys[0].line, 2);
  EXPECT_EQ(entity.keys[1].value, "2");
  EXPECT_EQ(entity.keys[1].line, 3);
}

TEST(Reader, ReadsEveryPartOfAFace) {
  const Document document =
      parse(map_of("( 1 2.5 -3 ) ( 4 5e2 6 ) ( 7 8 .125 ) wall/red [ 1 0 0.5 16 ] [ 0 -1 0 -8 ] 30 0.5 -2\n"),
            "a.map");
  const Face& face = document.entities[0].brushes[0].faces[0];
  EXPECT_EQ(face.line, 4);
  EXPECT_EQ(face.points[0], Vec3(1, 2.5, -3));
  EXPECT_EQ(face.points[1], Vec3(4, 500, 6));
  EXPECT_EQ(face.points[2], Vec3(7, 8, 0.125));
  EXPECT_EQ(face.material, "wall/red");
  EXPECT_EQ(face.u_axis, Vec3(1, 0, 0.5));
  EXPECT_EQ(face.u_offset, 16);
  EXPECT_EQ(face.v_axis, Vec3(0, -1, 0));
  EXPECT_EQ(face.v_offset, -8);
  EXPECT_EQ(face.rotation_deg, 30);
  EXPECT_EQ(face.u_scale, 0.5);
  EXPECT_EQ(face.v_scale, -2);
  EXPECT_FALSE(face.surface_flags);
}

TEST(Reader, KeepsSurfaceFlags) {
  const Document document = parse(
      map_of("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) m [ 1 0 0 0 ] [ 0 1 0 0 ] 0 1 1 134217728 -1 0.5\n"), "a.map");
  const auto& flags = document.entities[0].brushes[0].faces[0].surface_flags;
  ASSERT_TRUE(flags);
  EXPECT_EQ(flags->contents, 134217728);
  EXPECT_EQ(flags->flags, -1);
  EXPECT_EQ(flags->value, 0.5);
}

TEST(Reader, FacesMayStandWithoutLineBreaks) {
  const std::string face = "(0 0 0)(0 1 0)(1 0 0) m [1 0 0 0][0 1 0 0]0 1 1 ";
  EXPECT_EQ(parse(map_of(face + face), "a.map").entities[0].brushes[0].faces.size(), 2u);
}

TEST(Reader, MaterialsMayHoldSymbols) {
  for (const std::string name : {"{fence", "*water", "+0button", "sky#1", "a\\b", ";odd"}) {
    const Document document = parse(map_of(test::face_line("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 )", name)), "a.map");
    EXPECT_EQ(document.entities[0].brushes[0].faces[0].material, name);
  }
}

TEST(Reader, MaterialsWithBlanksAreQuoted) {
  const Document document =
      parse(map_of(test::face_line("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 )", "\"old wall\"")), "a.map");
  EXPECT_EQ(document.entities[0].brushes[0].faces[0].material, "old wall");
}

TEST(Reader, EscapedQuotationMarksBelongToTheText) {
  EXPECT_EQ(parse(R"({"a" "say \"hi\"!"})", "a.map").entities[0].keys[0].value, R"(say "hi"!)");
}

TEST(Reader, OtherEscapesAreKeptAsTheyStand) {
  EXPECT_EQ(parse(R"({"message" "one\ntwo\\three"})", "a.map").entities[0].keys[0].value,
            R"(one\ntwo\\three)");
}

TEST(Reader, AWindowsPathMayEndInABackslash) {
  for (const std::string line_end : {"\n", "\r\n"}) {
    const Document document = parse("{\n\"wad\" \"C:\\quake\\\"" + line_end + "\"b\" \"2\"\n}\n", "a.map");
    ASSERT_EQ(document.entities[0].keys.size(), 2u);
    EXPECT_EQ(document.entities[0].keys[0].value, "C:\\quake\\");
  }
}

TEST(Reader, CommentsStayWithWhatFollowsThem) {
  const Document document = parse(
      "// head\n//   indented\n{\n// of key\n\"classname\" \"worldspawn\"\n// of brush\n{\n; of face\n" +
          cube_faces() + "// end of brush\n}\n// end of entity\n}\n//\n// end of file",
      "a.map");
  const Entity& entity = document.entities[0];
  EXPECT_EQ(entity.comments, (std::vector<std::string>{"head", "  indented"}));
  EXPECT_EQ(entity.keys[0].comments, std::vector<std::string>{"of key"});
  EXPECT_EQ(entity.brushes[0].comments, std::vector<std::string>{"of brush"});
  EXPECT_EQ(entity.brushes[0].faces[0].comments, std::vector<std::string>{"of face"});
  EXPECT_EQ(entity.brushes[0].closing_comments, std::vector<std::string>{"end of brush"});
  EXPECT_EQ(entity.closing_comments, std::vector<std::string>{"end of entity"});
  EXPECT_EQ(document.closing_comments, (std::vector<std::string>{"", "end of file"}));
}

TEST(Reader, RunningNumbersOfEditorsAreDropped) {
  const Document document = parse("// entity 0\n{\n// brush 12\n{\n}\n// brush of mine\n}\n", "a.map");
  EXPECT_TRUE(document.entities[0].comments.empty());
  EXPECT_TRUE(document.entities[0].brushes[0].comments.empty());
  EXPECT_EQ(document.entities[0].closing_comments, std::vector<std::string>{"brush of mine"});
}

TEST(Reader, SlashesInAValueAreNoComment) {
  EXPECT_EQ(parse("{\"//off\" \"//value\"}", "a.map").entities[0].keys[0].value, "//value");
}

TEST(Reader, AcceptsCarriageReturnsAndAByteOrderMark) {
  const Document document = parse("\xEF\xBB\xBF// head\r\n{\r\n\"a\" \"b\"\r\n}\r\n", "a.map");
  EXPECT_EQ(document.entities[0].comments, std::vector<std::string>{"head"});
  EXPECT_EQ(document.entities[0].keys[0].value, "b");
  EXPECT_EQ(document.entities[0].keys[0].line, 3);
}

TEST(Reader, NumbersKeepEveryBit) {
  const Document document =
      parse(map_of(test::face_line("( 0.1 -0 123456789.12345678 ) ( 1e-300 2 3 ) ( 9007199254740993 5 6 )")),
            "a.map");
  const Face& face = document.entities[0].brushes[0].faces[0];
  EXPECT_EQ(face.points[0].x(), 0.1);
  EXPECT_TRUE(std::signbit(face.points[0].y()));
  EXPECT_EQ(face.points[0].z(), 123456789.12345678);
  EXPECT_EQ(face.points[1].x(), 1e-300);
  EXPECT_EQ(face.points[2].x(), 9007199254740992.0);
}

TEST(Document, TheLastOfTwoEqualKeysCounts) {
  const Document document = parse("{\"a\" \"1\" \"a\" \"2\"}", "a.map");
  EXPECT_EQ(*document.entities[0].find("a"), "2");
  EXPECT_EQ(document.entities[0].find("b"), nullptr);
}

TEST(Document, ScaleDefaultsToQuakeUnits) {
  EXPECT_EQ(parse("", "a.map").metres_per_unit(), 1.0 / 32.0);
  EXPECT_EQ(parse("{\"classname\" \"worldspawn\"}", "a.map").metres_per_unit(), 1.0 / 32.0);
  EXPECT_EQ(parse("{\"classname\" \"worldspawn\" \"_scale\" \"0.01\"}", "a.map").metres_per_unit(), 0.01);
}

}  // namespace
}  // namespace hallway::map
