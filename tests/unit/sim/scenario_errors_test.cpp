// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "sim/scenario.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

/// One wrong scenario and what its message must say.
struct Wrong {
  const char* name;
  std::string text;
  int line;
  std::string key;    ///< as the message names it
  std::string cause;  ///< part of the message
};

class WrongScenario : public testing::TestWithParam<Wrong> {};

TEST_P(WrongScenario, IsRefusedWithFileLineKeyAndCause) {
  const test::TempFolder folder;
  const auto file = folder.write("s.toml", GetParam().text);
  const auto error = test::error_of([&] { load_scenario(file); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, file.string());
  EXPECT_EQ(error->where().line, GetParam().line) << error->what();
  EXPECT_EQ(error->where().element, "key `" + GetParam().key + "`") << error->what();
  EXPECT_NE(error->message().find(GetParam().cause), std::string::npos) << error->what();
}

std::string with(const std::string& more) {
  return test::scenario_text(more);
}
std::string sensor(const std::string& line) {
  return with("[sensor.a]\nkind = 'points'\n" + line + "\n");
}
std::string plugin(const std::string& line) {
  return with("[[plugin]]\nname = 'slam'\n" + line + "\n");
}
std::string picture(const std::string& line) {
  return with("[[picture]]\n" + line + "\n");
}
std::string named_picture(const std::string& line) {
  return with("[[picture]]\nfile = 'a.png'\n" + line + "\n");
}
std::string top(const std::string& line) {
  return line + "\n[robot]\npath = 'p'\nspeed_m_s = 1\n";
}
std::string robot(const std::string& lines) {
  return "map = 'm'\nsteps = 1\n[robot]\n" + lines + "\n";
}

std::string name_of(const testing::TestParamInfo<Wrong>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Top, WrongScenario,
    testing::Values(
        Wrong{"MapMissing", top("steps = 1"), 1, "map", "is missing"},
        Wrong{"MapEmpty", top("steps = 1\nmap = ''"), 2, "map", "must not be empty"},
        Wrong{"MapIsNumber", top("map = 3\nsteps = 1"), 1, "map", "must be a text, not a whole number"},
        Wrong{"MapWithZeroByte", top("map = \"a\\u0000b\"\nsteps = 1"), 1, "map", "zero byte"},
        Wrong{"StepsMissing", top("map = 'm'"), 1, "steps", "is missing"},
        Wrong{"StepsZero", top("map = 'm'\nsteps = 0"), 2, "steps", "0 is out of range"},
        Wrong{"StepsNegative", top("map = 'm'\nsteps = -5"), 2, "steps", "-5 is out of range"},
        Wrong{"StepsTooMany", top("map = 'm'\nsteps = 10000001"), 2, "steps", "at most 10000000"},
        Wrong{"StepsWithFraction", top("map = 'm'\nsteps = 1.0"), 2, "steps", "must be a whole number"},
        Wrong{"StepsAreText", top("map = 'm'\nsteps = '10'"), 2, "steps", "not a text"},
        Wrong{"SeedNegative", top("map = 'm'\nsteps = 1\nseed = -1"), 3, "seed", "out of range"},
        Wrong{"PeriodZero", top("map = 'm'\nsteps = 1\nperiod_s = 0"), 3, "period_s", "out of range"},
        Wrong{"PeriodNegative", top("map = 'm'\nsteps = 1\nperiod_s = -0.1"), 3, "period_s", "out of range"},
        Wrong{"PeriodNotANumber", top("map = 'm'\nsteps = 1\nperiod_s = nan"), 3, "period_s",
              "nan is out of range"},
        Wrong{"PeriodInfinite", top("map = 'm'\nsteps = 1\nperiod_s = inf"), 3, "period_s",
              "inf is out of range"},
        Wrong{"CallTimeoutZero", top("map = 'm'\nsteps = 1\ncall_timeout_s = 0"), 3, "call_timeout_s",
              "out of range"},
        Wrong{"MemoryLimitTooSmall", top("map = 'm'\nsteps = 1\nmemory_limit_mib = 1"), 3, "memory_limit_mib",
              "out of range"},
        Wrong{"OnFailureUnknown", top("map = 'm'\nsteps = 1\non_failure = 'hope'"), 3, "on_failure", "stop"},
        Wrong{"MisspeltKey", "map = 'm'\nsteps = 1\nsed = 2\n", 3, "sed", "did you mean \"seed\"?"},
        Wrong{"UnknownKey", "map = 'm'\nsteps = 1\n\ncolour = 2\n", 4, "colour", "unknown key"},
        Wrong{"UnknownTable", with("[sensors]\n"), 8, "sensors", "did you mean \"sensor\"?"},
        Wrong{"OtherSchema", "schema = 'hallway.scenario/2'\n" + with(""), 1, "schema", "hallway.scenario/1"},
        Wrong{"KeyWithEscapeSequence", "\"\\u001b[31m\" = 1\n", 1, "\\x1b[31m", "unknown key"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Robot, WrongScenario,
    testing::Values(
        Wrong{"TableMissing", "map = 'm'\nsteps = 1\n", 1, "robot.path", "is missing"},
        Wrong{"IsNoTable", "map = 'm'\nsteps = 1\nrobot = 3\n", 3, "robot", "must be a table"},
        Wrong{"PathMissing", robot("speed_m_s = 1"), 3, "robot.path", "is missing"},
        Wrong{"NoSpeed", robot("path = 'p'"), 3, "robot.speed_m_s", "give it or `loop_steps`"},
        Wrong{"BothSpeeds", robot("path = 'p'\nspeed_m_s = 1\nloop_steps = 5"), 6, "robot.loop_steps",
              "one of them"},
        Wrong{"SpeedNegative", robot("path = 'p'\nspeed_m_s = -1"), 5, "robot.speed_m_s", "out of range"},
        Wrong{"LoopStepsZero", robot("path = 'p'\nloop_steps = 0"), 5, "robot.loop_steps", "out of range"},
        Wrong{"SmoothIsNumber", robot("path = 'p'\nspeed_m_s = 1\nsmooth = 1"), 6, "robot.smooth",
              "must be true or false"},
        Wrong{"SmoothWithoutPath", robot("smooth = true"), 4, "robot.smooth", "needs `path`"},
        Wrong{"SmoothWithDrive",
              robot("path = 'p'\nspeed_m_s = 1\nsmooth = true\ndriven_by = 'path'\nradius_m = 0.1\nbottom_m "
                    "= 0\ntop_m = 1\ndrive = {kind = 'tracked'}"),
              6, "robot.smooth", "without a drive"},
        Wrong{"MisspeltKey", robot("path = 'p'\nspeed_ms = 1"), 5, "robot.speed_ms",
              "did you mean \"speed_m_s\"?"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Sensor, WrongScenario,
    testing::Values(
        Wrong{"IsNoTable", with("[sensor]\nkind = 'points'\n"), 9, "sensor.kind", "[sensor.NAME]"},
        Wrong{"StrangeName", with("[sensor.'a b']\nkind = 'points'\n"), 8, "sensor.a b", "name"},
        Wrong{"KindMissing", with("[sensor.a]\n"), 8, "sensor.a.kind", "is missing"},
        Wrong{"KindUnknown", with("[sensor.a]\nkind = 'radar'\n"), 9, "sensor.a.kind", "none of: points"},
        Wrong{"MisspeltKey", sensor("nois_m = 1"), 10, "sensor.a.nois_m", "did you mean \"noise_m\"?"},
        Wrong{"ViewZero", sensor("horizontal_fov_deg = 0"), 10, "sensor.a.horizontal_fov_deg", "above 0"},
        Wrong{"ViewBeyondCircle", sensor("vertical_fov_deg = 360.5"), 10, "sensor.a.vertical_fov_deg",
              "at most 360"},
        Wrong{"ViewNotANumber", sensor("vertical_fov_deg = nan"), 10, "sensor.a.vertical_fov_deg",
              "out of range"},
        Wrong{"RangesSwapped", sensor("max_range_m = 1\nmin_range_m = 2"), 11, "sensor.a.min_range_m",
              "is above"},
        Wrong{"RangeNegative", sensor("min_range_m = -1"), 10, "sensor.a.min_range_m", "out of range"},
        Wrong{"RangeInfinite", sensor("max_range_m = inf"), 10, "sensor.a.max_range_m", "out of range"},
        Wrong{"RateNegative", sensor("rate_hz = -1"), 10, "sensor.a.rate_hz", "out of range"},
        Wrong{"RateNotANumber", sensor("rate_hz = nan"), 10, "sensor.a.rate_hz", "out of range"},
        Wrong{"PhaseNegative", sensor("phase_s = -0.1"), 10, "sensor.a.phase_s", "out of range"},
        Wrong{"LatencyInfinite", sensor("latency_s = inf"), 10, "sensor.a.latency_s", "out of range"},
        Wrong{"NoiseNegative", sensor("noise_m = -0.1"), 10, "sensor.a.noise_m", "out of range"},
        Wrong{"NoiseOfOneAxisNegative", sensor("noise_m = [0, -1, 0]"), 10, "sensor.a.noise_m",
              "-1 is out of range"},
        Wrong{"NoiseGrowsTooFast", sensor("noise_per_m = 1.5"), 10, "sensor.a.noise_per_m", "out of range"},
        Wrong{"NoiseOfTwoAxes", sensor("noise_m = [0, 1]"), 10, "sensor.a.noise_m", "it has 2"},
        Wrong{"NoiseIsText", sensor("noise_m = 'a'"), 10, "sensor.a.noise_m", "must be a number"},
        Wrong{"PositionIsNumber", sensor("position_m = 1"), 10, "sensor.a.position_m",
              "list of three numbers"},
        Wrong{"PositionOfTexts", sensor("position_m = ['a', 1, 2]"), 10, "sensor.a.position_m", "not a text"},
        Wrong{"YawIsDate", sensor("yaw_deg = 2020-01-01"), 10, "sensor.a.yaw_deg", "not a date"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Plugin, WrongScenario,
    testing::Values(
        Wrong{"IsTable", with("[plugin]\nname = 'x'\n"), 8, "plugin", "[[plugin]]"},
        Wrong{"IsListOfNumbers", "plugin = [1]\n" + with(""), 1, "plugin", "[[plugin]]"},
        Wrong{"NameMissing", with("[[plugin]]\n"), 8, "plugin[1].name", "is missing"},
        Wrong{"MisspeltKey", plugin("parms = {}"), 10, "plugin[1].parms", "did you mean \"params\"?"},
        Wrong{"ParamsAreText", plugin("params = 'a=1'"), 10, "plugin[1].params", "must be a table"},
        Wrong{"ParameterIsList", plugin("params = {a = [1]}"), 10, "slam.a", "not a list"},
        Wrong{"ParameterIsTable", plugin("params = {a.b = 1}"), 10, "slam.a", "not a table"},
        Wrong{"TwiceInThePipeline", plugin("[[plugin]]\nname = 'x/slam.so'"), 11, "plugin[2].name",
              "stands twice"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Picture, WrongScenario,
    testing::Values(
        Wrong{"IterationBelowZero", picture("file = 'a.png'\niteration = -1"), 10, "picture[1].iteration",
              "0"},
        Wrong{"IterationBeyondSteps", picture("file = 'a.png'\niteration = 10000000"), 10,
              "picture[1].iteration", "0"},
        Wrong{"EveryZero", picture("file = 'a.png'\nevery = 0"), 10, "picture[1].every", "1"},
        Wrong{"EveryAndIteration", picture("file = 'a.png'\nevery = 1\niteration = 0"), 10,
              "picture[1].every", "give one of them"},
        Wrong{"EveryHasTheNameOfAnother",
              picture("file = 'a_000120.png'\n[[picture]]\nfile = 'a.png'\nevery = 1"), 11, "picture[2].file",
              "may give pictures of one name"},
        Wrong{"EveryOfPanels", picture("file = 'a.png'\nview = 'panels'\nevery = 1"), 11, "picture[1].every",
              "no single iteration"},
        Wrong{"TooManyOfEvery",
              "map = 'm'\nsteps = 20001\n[robot]\npath = 'p'\nspeed_m_s = 1\n[[picture]]\nfile = "
              "'a.png'\nevery = 2\n",
              8, "picture[1].every", "gives 10001 pictures; at most 10000"},
        Wrong{"FileMissing", picture("view = 'top'"), 8, "picture[1].file", "is missing"},
        Wrong{"FileInFolder", picture("file = 'a/b.png'"), 9, "picture[1].file", "plain file name"},
        Wrong{"FileOutside", picture("file = '../b.png'"), 9, "picture[1].file", "plain file name"},
        Wrong{"FileIsDots", picture("file = '..'"), 9, "picture[1].file", "plain file name"},
        Wrong{"FileHidden", picture("file = '.png'"), 9, "picture[1].file", "plain file name"},
        Wrong{"FileWithNewline", picture("file = \"a\\n.png\""), 9, "picture[1].file", "plain file name"},
        Wrong{"FileTooLong", picture("file = '" + std::string(300, 'a') + ".png'"), 9, "picture[1].file",
              "plain file name"},
        Wrong{"FileOfOtherKind", picture("file = 'a.jpg'"), 9, "picture[1].file", "must end in .png"},
        Wrong{"FileTwice", named_picture("[[picture]]\nfile = 'a.png'"), 11, "picture[2].file",
              "another picture"},
        Wrong{"ViewUnknown", named_picture("view = 'side'"), 10, "picture[1].view",
              "none of: top, perspective"},
        Wrong{"WidthZero", named_picture("width_px = 0"), 10, "picture[1].width_px", "out of range"},
        Wrong{"WidthTooLarge", named_picture("width_px = 100000"), 10, "picture[1].width_px", "out of range"},
        Wrong{"TooManyPixels", named_picture("width_px = 16384\nheight_px = 16384"), 10,
              "picture[1].width_px", "pixels"},
        Wrong{"EyeWithoutTarget", named_picture("view = 'perspective'\neye_m = [1, 2, 3]"), 11,
              "picture[1].eye_m", "together"},
        Wrong{"EyeOfTopView", named_picture("eye_m = [1, 2, 3]\ntarget_m = [0, 0, 0]"), 10,
              "picture[1].eye_m", "no eye"},
        Wrong{"EyeInTarget", named_picture("view = 'perspective'\neye_m = [1, 2, 3]\ntarget_m = [1, 2, 3]"),
              12, "picture[1].target_m", "same point"},
        Wrong{"ShowIsText", named_picture("show = 'map'"), 10, "picture[1].show", "list of texts"},
        Wrong{"ShowUnknown", named_picture("show = ['map', 'landmark']"), 10, "picture[1].show",
              "did you mean \"landmarks\"?"},
        Wrong{"ShowTwice", named_picture("show = ['map', 'map']"), 10, "picture[1].show", "stands twice"}),
    name_of);

/// What the parser itself refuses names no key.
void expect_refused(const std::string& text, int line) {
  const test::TempFolder folder;
  const auto error = test::error_of([&] { load_scenario(folder.write("s.toml", text)); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().line, line) << error->what();
}

TEST(LoadScenario, RefusesANumberBeyondTheLargestDouble) {
  expect_refused("map = 'm'\nsteps = 1\nperiod_s = 1e400\n", 3);
}
TEST(LoadScenario, RefusesAnIntegerBeyondTheLargest) {
  expect_refused("map = 'm'\nseed = 9223372036854775808\n", 2);
}
TEST(LoadScenario, RefusesADuplicateKey) {
  expect_refused("map = 'm'\nmap = 'n'\n", 2);
}
TEST(LoadScenario, RefusesADuplicateSensor) {
  expect_refused(with("[sensor.a]\nkind = 'points'\n[sensor.a]\n"), 10);
}
TEST(LoadScenario, RefusesAnEmptyFile) {
  expect_refused("", 1);
}

TEST(LoadScenario, RefusesAFileThatIsTooLarge) {
  const test::TempFolder folder;
  const auto file = folder.write("s.toml", std::string(kMaxScenarioBytes + 1, '\n'));
  const auto error = test::error_of([&] { load_scenario(file); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kIo);
}

TEST(LoadScenario, RefusesAFolder) {
  const test::TempFolder folder;
  EXPECT_TRUE(test::error_of([&] { load_scenario(folder.path()); }).has_value());
}

}  // namespace
}  // namespace hallway::sim
