// SPDX-License-Identifier: MIT
// Every test of the suite finds what it is there to find, and nothing else: a plugin with one defect fails the tests of that defect alone.
#include <gtest/gtest.h>
#include <hallway/ext/params.h>

#include <algorithm>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "base/helper.hpp"
#include "support/long_mode.hpp"
#include "unit/conformance/defective_plugin.hpp"

namespace hallway::conformance::test {
namespace {

enum class Others {
  kPass,
  kMayFailToo,  ///< a function is missing, or memory may or may not still be there: who meets it fails
};

struct Defect {
  const char* name;
  std::set<std::string> fails;
  Others others = Others::kPass;
  friend void PrintTo(const Defect& defect, std::ostream* out) { *out << defect.name; }
};

const std::vector<Defect> kDefects{
    {"aborts_for_tracks", {"frame-tracks"}},
    {"activates_once", {"deactivate-forgets"}},
    {"any_extension", {"extension-unknown"}},
    {"any_factory", {"factory-unknown"}},
    {"associations_in_report", {"report-valid", "report-refined"}},
    {"blocks_signal", {"keeps-signals"}},
    {"changes_folder", {"keeps-folder"}},
    {"closes_stdin", {"descriptors"}},
    {"count_grows", {"factory-count", "factory-end"}},
    {"counts_all_samples", {"activate-two-sensors", "frame-unknown-kind", "frame-two-readings"}},
    {"counts_neighbours", {"instances-independent", "same-at-once"}},
    {"crashes_after_refusal",
     {"refused-destroy", "activate-no-sensors", "errors-reasons", "errors-null", "grown-error"}},
    {"crashes_at_maximum", {"params-extremes"}},
    {"crashes_for_equal_points", {"frame-equal-points"}},
    {"crashes_for_far_points", {"frame-far-points"}},
    {"crashes_for_gaps", {"frame-gaps"}},
    {"crashes_for_line", {"frame-line"}},
    {"crashes_for_many_corners", {"activate-any-body"}},
    {"crashes_for_many_points", {"frame-many-points"}},
    {"crashes_for_nan", {"frame-not-finite"}},
    {"crashes_for_no_points", {"frame-no-points", "input-not-overrun"}},
    {"crashes_for_no_samples", {"frame-no-samples"}},
    {"crashes_for_one_point", {"frame-one-point"}},
    {"crashes_for_pixels", {"frame-pixels"}},
    {"crashes_for_plane", {"frame-plane"}},
    {"crashes_for_point_times", {"frame-point-times"}},
    {"crashes_for_tracks", {"frame-tracks"}},
    {"crashes_for_two_readings", {"frame-two-readings"}},
    {"crashes_for_unannounced", {"frame-unannounced"}},
    {"crashes_untouched", {"create-destroy"}},
    {"crashes_when_refused", {"host-refuses"}},
    {"crashes_with_two_sensors", {"activate-two-sensors"}},
    {"crashes_without_frames", {"activate-deactivate"}},
    {"crashes_without_sensors",
     {"refused-destroy", "refused-activate", "activate-no-sensors", "errors-reasons", "errors-null",
      "grown-error"}},
    {"creates_any", {"create-unknown"}},
    {"creates_silently", {"create-unknown", "errors-reasons", "grown-error"}},
    {"creates_wrong_status", {"create-unknown"}},
    {"describes_all", {"factory-end"}},
    {"description_changes", {"factory-constant"}},
    {"drawing_in_report", {"report-valid", "report-refined"}},
    {"edge_to_nowhere", {"outputs-valid"}},
    {"equal_landmarks", {"report-valid", "report-refined"}},
    {"equal_nodes", {"outputs-valid"}},
    {"errors_endless", {"errors-reasons"}},
    {"errors_latin1", {"errors-reasons"}},
    {"errors_line_end", {"errors-reasons"}},
    {"errors_null_written", {"errors-null"}},
    {"errors_other_status", {"errors-reasons"}},
    {"fails_for_bad_intensity", {"frame-point-times"}},
    {"fails_for_early_times", {"frame-any-time"}},
    {"fails_for_equal_times", {"frame-equal-times"}},
    {"fails_for_unknown_flags", {"unknown-sample-flags"}},
    {"fails_for_unknown_kind", {"frame-unknown-kind"}},
    {"fails_for_unknown_requests", {"unknown-request-flags"}},
    {"few_associations", {"outputs-valid"}},
    {"flags_in_output", {"outputs-reserved"}},
    {"flushes_to_zero", {"keeps-rounding"}},
    {"fractional_epoch", {"outputs-map-epoch"}},
    {"grown_activation", {"grown-activation", "older-activation"}},
    {"grown_body", {"grown-body"}},
    {"grown_drive", {"grown-drive"}},
    {"grown_error_overrun", {"grown-error"}},
    {"grown_error_refused", {"grown-error"}},
    {"grown_frame", {"grown-frame"}},
    {"grown_host", {"grown-host"}},
    {"grown_points", {"grown-points", "older-points"}},
    {"grown_request", {"grown-request"}},
    {"grown_sample", {"grown-sample"}},
    {"grown_sensor", {"grown-sensor", "older-activation"}},
    {"corner_off_mapped_plane", {"report-valid", "report-refined"}},
    {"clockwise_outline", {"report-valid", "report-refined"}},
    {"mapped_plane_is_landmark", {"report-valid", "report-refined"}},
    {"id_twice", {"plugin-ids"}},
    {"id_with_space", {"plugin-ids"}},
    {"infinite_speed", {"outputs-valid"}},
    {"item_beyond_points", {"outputs-valid"}},
    {"joins_to_younger", {"outputs-map-epoch"}},
    {"keeps_activation", {"activation-not-kept"}},
    {"keeps_body", {"activation-not-kept"}},
    {"keeps_drive", {"activation-not-kept"}},
    {"keeps_input", {"input-not-kept"}, Others::kMayFailToo},
    {"kind_twice", {"plugin-kinds"}},
    {"latin1_note", {"outputs-valid"}},
    {"leaks_on_activate", {"use-memory"}},
    {"leaks_on_create", {"create-memory", "use-memory"}},
    {"leaves_descriptor", {"descriptors"}},
    {"leaves_process", {"processes"}},
    {"leaves_thread", {"threads"}},
    {"loads_once", {"load-again"}},
    {"long_normal", {"outputs-valid"}},
    {"long_quaternion", {"outputs-valid"}},
    {"nan_counter", {"outputs-valid"}},
    {"nan_for_nan", {"frame-not-finite"}},
    {"nan_for_no_points", {"frame-no-points"}},
    {"nan_in_drawing", {"outputs-valid"}},
    {"nan_place", {"outputs-valid"}},
    {"nan_pose", {"outputs-valid"}},
    {"nan_sideways", {"outputs-valid"}},
    {"nan_step", {"outputs-valid"}},
    {"needs_body", {"activate-unknown-robot", "older-activation"}},
    {"needs_drive", {"activate-unknown-robot", "older-activation"}},
    {"needs_log", {"host-no-extensions"}},
    {"nan_plane", {"outputs-valid"}},
    {"ninth_colour", {"outputs-valid"}},
    {"normal_away", {"outputs-valid"}},
    {"null_param_2_function", {"create-functions"}, Others::kMayFailToo},
    {"null_param_function", {"create-functions"}, Others::kMayFailToo},
    {"null_reset", {"create-functions"}, Others::kMayFailToo},
    {"origin_untold", {"params-origin", "params-set-stands", "params-sensor"}},
    {"param_any_bool", {"params-below", "params-above"}},
    {"param_any_index", {"params-index"}},
    {"param_any_type", {"params-type"}},
    {"param_clamps", {"params-below", "params-not-finite"}},
    {"param_default_outside",
     {"params-described", "params-round-trip", "params-inactive", "params-instances", "params-origin",
      "params-set-stands"}},
    {"param_described_behind_end", {"params-end"}},
    {"param_name_of_spaces", {"params-described"}},
    {"param_name_twice", {"params-described"}},
    {"param_no_maximum", {"params-above"}},
    {"param_no_minimum", {"params-below"}},
    {"param_other_default", {"params-defaults"}},
    {"param_rounds", {"params-round-trip", "params-instances"}},
    {"param_set_once", {"params-inactive"}},
    {"param_set_while_active", {"params-active"}},
    {"param_shared", {"params-instances"}},
    {"param_takes_nan", {"params-not-finite"}},
    {"param_wrong_status", {"params-below", "params-above"}},
    {"place_of_another_time", {"outputs-topology"}},
    {"planes_in_report", {"report-valid", "report-refined"}},
    {"pose_before_time", {"outputs-valid"}},
    {"pose_of_tomorrow", {"outputs-valid"}},
    {"puts_in_reset", {"outputs-in-turn"}},
    {"reads_environment", {"same-environment"}},
    {"reads_folder", {"same-folder"}},
    {"reads_host_name", {"same-host-name"}},
    {"reads_later_points", {"older-points"}},
    {"reads_locale", {"same-locale"}},
    {"reads_new_members", {"activate-unknown-robot", "older-activation"}},
    {"reads_on", {"input-not-overrun", "older-points"}},
    {"reads_process_id", {"same-processes"}},
    {"reads_rate", {"older-activation"}},
    {"reads_reserved_host", {"reserved-members"}},
    {"reads_reserved_sensor", {"reserved-members"}},
    {"reads_thread", {"same-threads", "same-at-once"}},
    {"refined_to_nan", {"report-refined"}},
    {"refuses_any_rate", {"activate-any-rate"}},
    {"refuses_intrinsics", {"activate-unknown-intrinsics", "activate-unknown-kind"}},
    {"refuses_large_ids", {"activate-any-id"}},
    {"refuses_mounts", {"activate-any-mount"}},
    {"refuses_nan_facts", {"activate-unknown-facts"}},
    {"refuses_nan_speed", {"activate-unknown-robot"}},
    {"refuses_round_body", {"activate-unknown-robot", "activate-any-body"}},
    {"refuses_silently", {"activate-no-sensors", "errors-reasons", "grown-error"}},
    {"refuses_unknown_drive", {"activate-any-drive"}},
    {"refuses_unknown_kind", {"activate-unknown-kind"}},
    {"remembers_after_deactivate", {"deactivate-forgets"}},
    {"remembers_after_reset", {"reset-forgets"}},
    {"report_changes_answers", {"report-aside"}},
    {"report_counts_reports", {"report-twice"}},
    {"report_needs_frames", {"report-first"}},
    {"room_with_direction", {"outputs-valid"}},
    {"reserved_in_info", {"plugin-kinds"}},
    {"reserved_in_output", {"outputs-reserved"}},
    {"reset_needs_frames", {"reset-at-once"}},
    {"sensor_kept", {"params-sensor"}},
    {"sensor_not_clamped", {"params-sensor"}},
    {"sensor_over_set", {"params-set-stands"}},
    {"sets_locale", {"keeps-locale"}},
    {"sets_rounding", {"keeps-rounding"}},
    {"sets_signal_handler", {"keeps-signals"}},
    {"sets_umask", {"keeps-umask"}},
    {"sets_variable", {"keeps-environment"}},
    {"shares_state", {"same-at-once"}},
    {"silent_when_refused", {"host-refuses"}},
    {"stray_members", {"outputs-valid"}},
    {"stride_ignored", {"stride"}},
    {"stuck_after_refusal", {"refused-activate"}},
    {"text_latin1", {"plugin-texts"}},
    {"text_null", {"plugin-texts"}},
    {"text_param_as_number", {"params-text-type"}},
    {"text_param_cut", {"params-text-round-trip"}},
    {"text_param_default_null", {"params-text-described"}},
    {"text_param_set_while_active", {"params-text-active"}},
    {"text_that_is_null", {"outputs-valid"}},
    {"third_differs", {"instances-independent", "frame-unknown-kind", "same-again", "same-at-once"}},
    {"throws_for_tracks", {"frame-tracks"}},
    {"too_sure_edge", {"outputs-valid"}},
    {"two_poses", {"outputs-valid"}},
    {"undeclared_output", {"outputs-declared"}},
    {"unknown_pose_status", {"outputs-valid"}},
    {"unknown_loop", {"outputs-valid"}},
    {"unknown_place", {"outputs-valid"}},
    {"wild_member", {"outputs-valid"}},
    {"writes_stderr", {"silent"}},
    {"writes_stdout", {"silent"}},
    {"writes_to_input", {"input-not-written"}},
};

/// Every fifth test, others for each defect; all of them in long mode. Under a sanitizer memory cannot be counted, and one that gets no descriptor ends the
/// process when memory is looked at.
std::vector<std::string> sample_of_tests(const Defect& defect) {
  constexpr std::size_t kShare = 5;
  const auto number = static_cast<std::size_t>(
      std::find_if(kDefects.begin(), kDefects.end(), [&](const Defect& d) { return d.name == defect.name; }) -
      kDefects.begin());
  std::vector<std::string> names(defect.fails.begin(), defect.fails.end());
  for (std::size_t i = 0; i < all_tests().size(); ++i) {
    const std::string name = all_tests()[i].name;
    if (name == "use-memory" && reserves_addresses()) continue;
    const bool chosen = hallway::test::long_mode() || i % kShare == number % kShare;
    if (chosen && !defect.fails.contains(name)) names.push_back(name);
  }
  return names;
}

class Defects : public testing::TestWithParam<Defect> {};

TEST_P(Defects, FailTheirTestsAndNoOthers) {
  const Defect& defect = GetParam();
  if (reserves_addresses() && std::string(defect.name).starts_with("leaks_")) {
    GTEST_SKIP() << "under a sanitizer memory cannot be counted";
  }
  const DefectivePlugin plugin(defect.name);
  SuiteSetup setup = plugin.setup();
  setup.subject.plugin = std::string(defect.name) == "id_with_space" ? "has a space" : "defective";
  setup.only = sample_of_tests(defect);
  std::set<std::string> failed;
  std::string reasons;
  for (const Result& result : run_suite(setup)) {
    if (result.good()) continue;
    failed.insert(result.test->name);
    reasons += std::string(result.test->name) + ": " + result.reason + "\n";
    EXPECT_FALSE(result.reason.empty()) << result.test->name;
  }
  if (defect.others == Others::kPass) {
    EXPECT_EQ(failed, defect.fails) << reasons;
  } else {
    EXPECT_TRUE(std::includes(failed.begin(), failed.end(), defect.fails.begin(), defect.fails.end()))
        << reasons;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Defects, testing::ValuesIn(kDefects),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(Suite, EveryTestHasADefectThatItFinds) {
  // By other files: below, and samples_test.cpp.
  std::set<std::string> found{"entry-alone", "grown-intrinsics", "scan-no-returns",  "scan-no-order",
                              "scan-layers", "imu-missing-axes", "odometry-unknown", "carried-samples",
                              "gnss-no-fix", "gnss-later-fix",   "magnetic-unknown"};
  for (const Defect& defect : kDefects) found.insert(defect.fails.begin(), defect.fails.end());
  for (const conformance::Test& test : all_tests()) EXPECT_TRUE(found.contains(test.name)) << test.name;
}

TEST(Suite, FindsSymbolsThatAreShownBesideTheEntry) {
  const DefectivePlugin plugin("defective");
  SuiteSetup setup = plugin.setup();
  setup.subject.file = FIXTURES "/defects/shows_more.so";
  for (const Result& result : run_suite(setup)) {
    EXPECT_EQ(result.good(), std::string(result.test->name) != "entry-alone")
        << result.test->name << result.reason;
  }
}

class GoodPlugins : public testing::TestWithParam<const char*> {};

TEST_P(GoodPlugins, PassEveryTest) {
  const DefectivePlugin none("defective");
  SuiteSetup setup = none.setup();
  setup.subject.file = GetParam();
  setup.subject.plugin = inspect_plugin(setup);
  for (const Result& result : run_suite(setup)) {
    const bool skipped = result.verdict == Verdict::kSkipped;
    const bool uncounted = skipped && reserves_addresses();
    // These take points alone.
    const bool is_of_others = skipped && result.reason.starts_with("the plugin takes no ");
    // The example in C has no hw.params/2, and no mapper of ours a text.
    const bool has_no_such = skipped && GetParam() != std::string(FIXTURES "/defects/defective.so") &&
                             (result.reason.find("no " HW_EXT_PARAMS_2) != std::string::npos ||
                              result.reason.find("is a text") != std::string::npos);
    EXPECT_TRUE(result.verdict == Verdict::kPassed || uncounted || is_of_others || has_no_such)
        << result.test->name << ": " << verdict_name(result.verdict) << ": " << result.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, GoodPlugins,
                         testing::Values(FIXTURES "/defects/defective.so", EXAMPLE, PLUGINS "/slam_point.so"),
                         [](const auto& instance) {
                           return std::filesystem::path(instance.param).stem().string();
                         });

}  // namespace
}  // namespace hallway::conformance::test
