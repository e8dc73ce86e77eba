// SPDX-License-Identifier: MIT
#include "eval/association_score.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/errors.hpp"

namespace hallway::eval {
namespace {

using log::kNoLandmark;
using Ids = std::vector<log::LandmarkId>;
using Owners = std::map<log::LandmarkId, log::LandmarkId>;

// Map landmarks are numbered from 100, true ones from 1.

TEST(AssociationScore, EverythingRightHasNoErrors) {
  AssociationScore score;
  score.add(Ids{100, 101}, Ids{1, 2});
  score.add(Ids{101, 100}, Ids{2, 1});
  EXPECT_EQ(score.ownership().errors, 0u);
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 1}, {101, 2}}));
  EXPECT_EQ(score.observations(), 4u);
  EXPECT_EQ(score.true_landmarks(), 2u);
  EXPECT_EQ(score.none(), 0u);
}

TEST(AssociationScore, ASwapIsTwoErrors) {
  AssociationScore score;
  score.add(Ids{100, 101}, Ids{1, 2});
  score.add(Ids{100, 101}, Ids{1, 2});
  score.add(Ids{101, 100}, Ids{1, 2});
  EXPECT_EQ(score.ownership().errors, 2u);
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 1}, {101, 2}}));
}

TEST(AssociationScore, ASplitLandmarkHasNoErrors) {
  AssociationScore score;
  score.add(Ids{100}, Ids{1});
  score.add(Ids{101}, Ids{1});
  EXPECT_EQ(score.ownership().errors, 0u);
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 1}, {101, 1}}));
}

TEST(AssociationScore, AMergeCountsTheMinority) {
  AssociationScore score;
  score.add(Ids{100, 100}, Ids{1, 2});
  score.add(Ids{100, 100}, Ids{1, 2});
  score.add(Ids{100}, Ids{2});
  EXPECT_EQ(score.ownership().errors, 2u);
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 2}}));
}

TEST(AssociationScore, TheMajorityNeedNotBeMoreThanHalf) {
  AssociationScore score;
  score.add(Ids{100, 100, 100, 100}, Ids{1, 2, 2, 3});
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 2}}));
  EXPECT_EQ(score.ownership().errors, 2u);
}

TEST(AssociationScore, OfEqualOnesTheLowestIdOwns) {
  AssociationScore score;
  score.add(Ids{100, 100}, Ids{9, 4});
  score.add(Ids{101, 101}, Ids{4, 9});
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 4}, {101, 4}}));
  EXPECT_EQ(score.ownership().errors, 2u);
}

TEST(AssociationScore, ObservationsGivenToNoneAreNoErrors) {
  AssociationScore score;
  score.add(Ids{100, kNoLandmark}, Ids{1, 2});
  EXPECT_EQ(score.none(), 1u);
  EXPECT_EQ(score.observations(), 2u);
  EXPECT_EQ(score.true_landmarks(), 2u);
  EXPECT_EQ(score.ownership().errors, 0u);
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 1}}));
}

TEST(AssociationScore, AnObservationOfNothingGivenToAnOwnedLandmarkIsAnError) {
  AssociationScore score;
  score.add(Ids{100, 100, 100}, Ids{1, kNoLandmark, kNoLandmark});
  EXPECT_EQ(score.true_landmarks(), 1u);
  EXPECT_EQ(score.ownership().owner, (Owners{{100, 1}}));
  EXPECT_EQ(score.ownership().errors, 2u);
}

TEST(AssociationScore, ALandmarkMadeOfNothingHasNoOwner) {
  AssociationScore score;
  score.add(Ids{100, 100}, Ids{kNoLandmark, kNoLandmark});
  EXPECT_TRUE(score.ownership().owner.empty());
  EXPECT_EQ(score.ownership().errors, 0u);
}

TEST(AssociationScore, CountsWithoutIdentities) {
  AssociationScore score;
  score.add(Ids{100, kNoLandmark, kNoLandmark});
  EXPECT_EQ(score.observations(), 3u);
  EXPECT_EQ(score.none(), 2u);
  EXPECT_EQ(score.true_landmarks(), 0u);
}

TEST(AssociationScore, RefusesFramesOfDifferentLengths) {
  AssociationScore score;
  const auto error = test::error_of([&] { score.add(Ids{100}, Ids{1, 2}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kInternal);
}

}  // namespace
}  // namespace hallway::eval
