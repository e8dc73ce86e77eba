// SPDX-License-Identifier: MIT
#include "em/core/em2.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "search_properties.hpp"

namespace hallway::em {
namespace {

const planted::Search kSearch = [](const std::vector<Vec3>& cloud) { return extract_em2(cloud); };

TEST(Em2, FindsTheWallsOfACorner) {
  planted::expect_finds_the_corner(kSearch);
}

TEST(Em2, DoesNotDependOnTheOrderOfThePoints) {
  planted::expect_no_order_in_the_result(kSearch);
}

TEST(Em2, DoesNotDependOnTheUnitOfLength) {
  planted::expect_units_do_not_matter(kSearch);
}

TEST(Em2, PointsGivenTwiceChangeCountsOnly) {
  planted::expect_points_given_twice_to_change_counts_only(kSearch);
}

TEST(Em2, IgnoresPointsThatAreNotFinite) {
  planted::expect_points_that_are_not_finite_to_be_ignored(kSearch);
}

TEST(Em2, FindsNothingWhereThereIsNoPlane) {
  planted::expect_no_plane_where_there_is_none(kSearch);
}

TEST(Em2, FindsWhatLiesFarFromTheOrigin) {
  planted::expect_far_clouds_to_be_found(kSearch);
}

TEST(Em2, OptionsAreCheckedAtBothEnds) {
  EXPECT_NO_THROW(Em2Options().validate());
  std::set<std::string> names;
  for (const auto& row : em2_options()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_NE(row.real != nullptr, row.whole != nullptr) << row.name;
    for (const double value : {row.min - 1.0, row.max * 1.01 + 1.0, std::nan("")}) {
      if (row.whole != nullptr && (std::isnan(value) || value > 2147483647.0)) continue;
      Em2Options options;
      row.set(options, value);
      try {
        extract_em2({}, options);
        FAIL() << row.name << " = " << value << " was accepted";
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(row.name), std::string::npos) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace hallway::em
