// SPDX-License-Identifier: MIT
// The named failures of thesis 3.5.4 on the scenes of maps/regress/em: each appears with the value that is to blame, and not without; never in `em`.
#include "plane_faults.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "em/core/auto_planes.hpp"
#include "em/core/em1.hpp"
#include "em/core/em2.hpp"
#include "support/data.hpp"

namespace hallway::em {
namespace {

using planted::Fault;

template <typename Options>
Options with(const planted::Params& params, std::span<const OptionRow<Options>> rows) {
  Options options;
  for (const auto& param : params) {
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return param.first == r.name; });
    if (row == rows.end()) throw std::invalid_argument("no option is called " + param.first);
    row->set(options, param.second);
  }
  return options;
}

using Algorithm = std::function<Extraction(const std::vector<Vec3>&, const planted::Params&)>;

const std::map<std::string, Algorithm>& algorithms() {
  static const std::map<std::string, Algorithm> kAlgorithms{
      {"em", [](const auto& cloud,
                const auto& params) { return PlaneExtractor(with(params, auto_options())).extract(cloud); }},
      {"em1",
       [](const auto& cloud, const auto& params) { return extract_em1(cloud, with(params, em1_options())); }},
      {"em2",
       [](const auto& cloud, const auto& params) { return extract_em2(cloud, with(params, em2_options())); }},
  };
  return kAlgorithms;
}

std::vector<Fault> faults_of(const planted::Scene& scene, const std::string& algorithm,
                             const planted::Params& params) {
  const planted::LabelledCloud cloud = planted::sample(scene);
  const Extraction answer = algorithms().at(algorithm)(cloud.points, params);
  return planted::FaultFinder(scene, cloud, answer).faults();
}

bool shows(const std::vector<Fault>& faults, const planted::ExpectedFault& expected) {
  return std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
    return fault.kind == expected.shows && fault.plane == expected.plane && fault.from == expected.from;
  });
}

planted::Params joined(planted::Params a, const planted::Params& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class PlaneFaults : public testing::TestWithParam<const char*> {
 protected:
  planted::Scene scene() const {
    return planted::read_scene(hallway::test::source_folder() / "maps/regress/em" /
                               (std::string(GetParam()) + ".toml"));
  }
};

TEST_P(PlaneFaults, DefaultsShowNone) {
  for (const auto& [name, algorithm] : algorithms()) {
    const auto faults = faults_of(scene(), name, {});
    EXPECT_TRUE(faults.empty()) << name << ": " << planted::text_of(faults);
  }
}

TEST_P(PlaneFaults, AppearWithTheValueThatIsToBlameAndNotWithoutIt) {
  ASSERT_FALSE(scene().faults.empty());
  for (const planted::ExpectedFault& expected : scene().faults) {
    const auto bad = faults_of(scene(), expected.algorithm, joined(expected.params, expected.bad));
    EXPECT_TRUE(shows(bad, expected)) << expected.algorithm << " shows " << planted::text_of(bad);
    const auto good = faults_of(scene(), expected.algorithm, expected.params);
    EXPECT_TRUE(good.empty()) << expected.algorithm << ": " << planted::text_of(good);
  }
}

INSTANTIATE_TEST_SUITE_P(Thesis, PlaneFaults,
                         testing::Values("stolen_by_floor", "stolen_by_wall", "misaligned", "extra",
                                         "unattached"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace hallway::em
