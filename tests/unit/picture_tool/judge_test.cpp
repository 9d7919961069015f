// The classifier and its controls, on pictures of which is known whether they differ.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "echo/picture_tool/patch_line.hpp"
#include "echo/picture_tool/picture_comparison.hpp"
#include "tests/unit/picture_tool/picture_kit.hpp"

namespace skerry::echo {
namespace {

using test::BlobLook;
using test::blobs;
using test::places_of_blobs;
using testing::Contains;
using testing::HasSubstr;

constexpr double kBeam_deg = 5.0;

std::vector<PicturePatch> patches(std::uint64_t from, std::uint64_t count,
                                  const BlobLook& look = {}) {
  return patches_of_places(places_of_blobs(from, count, look), static_cast<std::uint32_t>(from),
                           kBeam_deg);
}

TEST(PictureJudge, CannotTellPlacesOfOneKindApart) {
  const Call call = call_apart("", patches(1, 6), patches(7, 6), {});
  ASSERT_TRUE(call.mask && call.all) << call.why_not;
  EXPECT_GE(call.mask->patches, 150u);
  EXPECT_NEAR(call.mask->auc, 0.5, 0.08);
  EXPECT_NEAR(call.all->auc, 0.5, 0.08);
  RecordProperty("mask", std::to_string(call.mask->auc));
}

TEST(PictureJudge, TellsAPlantedDifferenceOfTheMask) {
  const Call call = call_apart("", patches(1, 6), patches(7, 6, {.holes = 0.01}), {});
  ASSERT_TRUE(call.mask && call.all) << call.why_not;
  EXPECT_GT(call.mask->auc, 0.9);
  EXPECT_GT(call.all->auc, 0.9);
  ASSERT_EQ(call.mask->features.size(), kMaskFeatures);
  EXPECT_THAT(call.mask->features[0].name, HasSubstr("holes of one"));
  EXPECT_GT(call.mask->features[0].auc, call.mask->features.back().auc);
  EXPECT_LT(call.mask->features[0].first, call.mask->features[0].second);
}

TEST(PictureJudge, TellsAPlantedDifferenceOfTheLevelsOnlyByTheLevels) {
  const Call call = call_apart("", patches(1, 6), patches(7, 6, {.top = 12}), {});
  ASSERT_TRUE(call.mask && call.all) << call.why_not;
  EXPECT_NEAR(call.mask->auc, 0.5, 0.08);
  EXPECT_GT(call.all->auc, 0.9);
}

// Blobs a twelfth longer: each feature moves by little, so that the line has to help the forest.
TEST(PictureJudge, TellsSlightlyLongerBlobsMoreOftenThanNot) {
  const Call call = call_apart("", patches(1, 8), patches(9, 8, {.along = 9.75}), {});
  ASSERT_TRUE(call.all) << call.why_not;
  EXPECT_GT(call.all->auc, 0.6);
}

// Were a patch's twin of the other label among the learnt, all calls would be wrong.
TEST(PictureJudge, IsNotFooledByOnePlaceOnBothSides) {
  const auto real = places_of_blobs(1, 1, {}, 2);
  const Call call = call_real_ours(real, real, kBeam_deg, 1);
  ASSERT_TRUE(call.mask && call.all) << call.why_not;
  EXPECT_DOUBLE_EQ(call.mask->auc, 0.5);
  EXPECT_DOUBLE_EQ(call.all->auc, 0.5);
}

TEST(PictureJudge, ControlsComeToOneHalfWhereTheSetsDiffer) {
  const auto real = places_of_blobs(1, 1, {}, 2);
  const auto ours = places_of_blobs(2, 5, {.holes = 0.02});
  const Calls calls = call_all(real, ours, kBeam_deg, 1, [](const std::string&) {});
  ASSERT_TRUE(calls.real_ours.mask) << calls.real_ours.why_not;
  EXPECT_GT(calls.real_ours.mask->auc, 0.9);
  EXPECT_FALSE(calls.leaks);
  ASSERT_TRUE(calls.null.mask && calls.null.all);
  EXPECT_GE(calls.null.mask->auc, kNullLeast);
  EXPECT_LE(calls.null.mask->auc, kNullMost);
  EXPECT_GE(calls.null.all->auc, kNullLeast);
  EXPECT_LE(calls.null.all->auc, kNullMost);
  ASSERT_TRUE(calls.ours_ours.mask && calls.one_others.mask);
  EXPECT_NEAR(calls.ours_ours.mask->auc, 0.5, 0.12);
  EXPECT_NEAR(calls.one_others.mask->auc, 0.5, 0.12);
}

TEST(PictureJudge, SaysTheSameAgain) {
  const auto first = patches(1, 2), second = patches(3, 2, {.along = 10.0});
  const TellingApart a = tell_apart(first, second, PatchView::all);
  const TellingApart b = tell_apart(first, second, PatchView::all);
  EXPECT_EQ(a.auc, b.auc);
  ASSERT_EQ(a.features.size(), kPatchFeatures);
  for (std::size_t k = 0; k < a.features.size(); ++k) {
    EXPECT_EQ(a.features[k].name, b.features[k].name);
    EXPECT_EQ(a.features[k].auc, b.features[k].auc);
  }
  EXPECT_EQ(a.least, b.least);
}

TEST(PictureJudge, RefusesTooFewPatches) {
  const auto many = patches(1, 2);
  std::vector<PicturePatch> few(many.begin(), many.begin() + 30);
  EXPECT_THROW(tell_apart(many, few, PatchView::mask), TooFewPatches);
  const Call call = call_apart("pair", many, few, {});
  EXPECT_FALSE(call.mask || call.all);
  EXPECT_THAT(call.why_not, HasSubstr("too few patches"));

  // Enough of them, but all of one quadrant: there is nothing to learn from for the other side.
  std::vector<PicturePatch> one;
  for (int i = 0; i < 20; ++i) {
    for (const PicturePatch& p : many) {
      if (p.quadrant == 0) one.push_back(p);
    }
  }
  ASSERT_GT(one.size(), 3 * kLeastPatches);
  EXPECT_THROW(tell_apart(one, one, PatchView::mask), TooFewPatches);
}

TEST(PictureJudge, HasNoCallsForPicturesSmallerThanAPatch) {
  TurnsOfPicture small = blobs(1);
  small.spokes = 32, small.cells = 384;
  small.turns.front().resize(std::size_t{32} * 384);
  EXPECT_TRUE(patches_of_places({&small, 1}, 0, kBeam_deg).empty());
}

// Two features of which only the difference tells.
TEST(PatchLine, AddsUpWhatEachFeatureAloneDoesNotTell) {
  std::vector<PicturePatch> all(400);
  std::vector<LabelledPatch> labelled;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto common = static_cast<float>(i % 20);
    const int label = static_cast<int>(i / 20 % 2);
    all[i].features[0] = common + 0.1f * static_cast<float>(label);
    all[i].features[1] = common;
    labelled.push_back({&all[i], label});
  }
  const auto values = line_values(labelled, labelled, kMaskFeatures);
  double of[2] = {};
  for (std::size_t i = 0; i < all.size(); ++i) of[labelled[i].label] += values[i] / 200.0;
  EXPECT_GT(of[1], of[0]);
}

}  // namespace
}  // namespace skerry::echo
