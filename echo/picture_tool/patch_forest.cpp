#include "echo/picture_tool/patch_forest.hpp"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>

#include "echo/kernel/hash.hpp"
#include "echo/picture_tool/patch_line.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kFolds = 4;
constexpr std::size_t kFifths = 5;
constexpr int kTrees = 200;

using Sample = LabelledPatch;

std::uint32_t fold_of(const PicturePatch& patch) { return patch.quadrant % kFolds; }

// Patches among which as many of either set are drawn.
std::size_t stratum_of(const PicturePatch& patch) {
  const auto fifth = static_cast<std::size_t>(patch.occupancy * static_cast<float>(kFifths));
  return fold_of(patch) * kFifths + std::min(kFifths - 1, fifth);
}

using Strata = std::array<std::vector<const PicturePatch*>, kFolds * kFifths>;

// Each stratum in an order that depends on the seed and on nothing else.
Strata dealt(std::span<const PicturePatch> patches, std::uint64_t seed) {
  std::vector<std::pair<std::uint64_t, std::size_t>> keyed;
  for (std::size_t i = 0; i < patches.size(); ++i) keyed.emplace_back(mixed(seed, i), i);
  std::sort(keyed.begin(), keyed.end());
  Strata strata;
  for (const auto& [key, i] : keyed) strata[stratum_of(patches[i])].push_back(&patches[i]);
  return strata;
}

std::vector<Sample> matched(std::span<const PicturePatch> first,
                            std::span<const PicturePatch> second, const TellingRules& rules) {
  const Strata of_first = dealt(first, mixed(rules.seed, 1));
  const Strata of_second = dealt(second, mixed(rules.seed, 2));
  std::size_t all = 0;
  for (std::size_t s = 0; s < of_first.size(); ++s)
    all += std::min(of_first[s].size(), of_second[s].size());
  const double share =
      all > rules.most ? static_cast<double>(rules.most) / static_cast<double>(all) : 1.0;
  std::vector<Sample> samples;
  for (std::size_t s = 0; s < of_first.size(); ++s) {
    const auto count = static_cast<std::size_t>(
        share * static_cast<double>(std::min(of_first[s].size(), of_second[s].size())));
    for (std::size_t i = 0; i < count; ++i) {
      samples.push_back({of_first[s][i], 0});
      samples.push_back({of_second[s][i], 1});
    }
  }
  return samples;
}

// One new label for all turns of a patch.
void shuffle_labels(std::vector<Sample>& samples, std::uint64_t seed) {
  for (Sample& sample : samples) {
    const PicturePatch& p = *sample.patch;
    std::uint64_t key = mixed(seed, static_cast<std::uint64_t>(sample.label));
    key = mixed(mixed(mixed(key, p.place), p.spoke), p.cell);
    sample.label = static_cast<int>(key >> 33 & 1u);
  }
}

cv::Mat feature_rows(const std::vector<Sample>& samples, std::size_t features) {
  cv::Mat rows(static_cast<int>(samples.size()), static_cast<int>(features), CV_32F);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t f = 0; f < features; ++f)
      rows.at<float>(static_cast<int>(i), static_cast<int>(f)) = samples[i].patch->features[f];
  }
  return rows;
}

// The share of votes for label 1.
std::vector<double> votes_for(const std::vector<Sample>& learnt, const std::vector<Sample>& asked,
                              std::size_t features) {
  cv::Mat labels(static_cast<int>(learnt.size()), 1, CV_32S);
  for (std::size_t i = 0; i < learnt.size(); ++i)
    labels.at<int>(static_cast<int>(i)) = learnt[i].label;
  cv::setRNGSeed(20261124);
  const auto forest = cv::ml::RTrees::create();
  forest->setMaxDepth(14);
  forest->setMinSampleCount(6);
  forest->setActiveVarCount(0);  // the root of their number
  forest->setTermCriteria({cv::TermCriteria::MAX_ITER, kTrees, 0.0});
  forest->train(feature_rows(learnt, features), cv::ml::ROW_SAMPLE, labels);
  cv::Mat votes;
  forest->getVotes(feature_rows(asked, features), votes, 0);
  const int column = votes.at<int>(0, 0) == 1 ? 0 : 1;
  std::vector<double> out;
  for (int i = 1; i < votes.rows; ++i) {
    const double all = votes.at<int>(i, 0) + votes.at<int>(i, 1);
    out.push_back(votes.at<int>(i, column) / std::max(1.0, all));
  }
  return out;
}

// Mann and Whitney's count: pairs of the two labels, and how many label 1 wins, ties half.
struct Pairs {
  double won = 0.0, all = 0.0;
  double auc() const { return all > 0.0 ? won / all : 0.5; }
};

Pairs pairs_of(std::vector<std::pair<double, int>> scored) {
  std::sort(scored.begin(), scored.end());
  double ranks = 0.0, ones = 0.0;
  for (std::size_t i = 0; i < scored.size();) {
    std::size_t j = i;
    while (j < scored.size() && scored[j].first == scored[i].first) ++j;
    const double rank = 0.5 * static_cast<double>(i + 1 + j);
    for (; i < j; ++i) {
      if (scored[i].second == 1) ranks += rank, ones += 1.0;
    }
  }
  const double zeros = static_cast<double>(scored.size()) - ones;
  return {ranks - ones * (ones + 1.0) / 2.0, ones * zeros};
}

// Where each value stands among all, 0 to 1, like ones together.
std::vector<double> standings(const std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> out;
  for (const double v : values) {
    const auto low = std::lower_bound(sorted.begin(), sorted.end(), v) - sorted.begin();
    const auto high = std::upper_bound(sorted.begin(), sorted.end(), v) - sorted.begin();
    out.push_back(static_cast<double>(low + high) / (2.0 * static_cast<double>(values.size())));
  }
  return out;
}

// By the forest and the line, of equal say.
std::vector<double> scores_for(const std::vector<Sample>& learnt, const std::vector<Sample>& asked,
                               std::size_t features) {
  std::vector<double> scores = standings(votes_for(learnt, asked, features));
  const std::vector<double> line = standings(line_values(learnt, asked, features));
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i] += line[i];
  return scores;
}

// Of the values of that label.
double median_of(const std::vector<std::pair<double, int>>& scored, int label) {
  std::vector<double> values;
  for (const auto& [value, of] : scored) {
    if (of == label) values.push_back(value);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<TellingFeature> one_by_one(const std::vector<Sample>& samples, std::size_t features) {
  std::vector<TellingFeature> told;
  for (std::size_t f = 0; f < features; ++f) {
    std::vector<std::pair<double, int>> scored;
    for (const Sample& s : samples)
      scored.emplace_back(static_cast<double>(s.patch->features[f]), s.label);
    const double auc = pairs_of(scored).auc();
    told.push_back({patch_feature_name(f), std::max(auc, 1.0 - auc), median_of(scored, 0),
                    median_of(scored, 1)});
  }
  std::stable_sort(told.begin(), told.end(), [](auto& a, auto& b) { return a.auc > b.auc; });
  return told;
}

bool has_both(const std::vector<Sample>& samples) {
  const auto ones = std::count_if(samples.begin(), samples.end(), [](auto& s) { return s.label; });
  return ones > 0 && ones < static_cast<std::ptrdiff_t>(samples.size());
}

}  // namespace

TellingApart tell_apart(std::span<const PicturePatch> first, std::span<const PicturePatch> second,
                        PatchView view, const TellingRules& rules) {
  std::vector<Sample> samples = matched(first, second, rules);
  const TooFewPatches few{first.size(), second.size(), samples.size() / 2};
  if (few.matched < kLeastPatches) throw few;
  const std::size_t features = view == PatchView::mask ? kMaskFeatures : kPatchFeatures;
  TellingApart result;
  result.patches = few.matched;
  result.features = one_by_one(samples, features);
  if (rules.shuffled) shuffle_labels(samples, mixed(rules.seed, 3));
  Pairs pairs;
  result.least = 1.0, result.most = 0.0;
  for (std::uint32_t fold = 0; fold < kFolds; ++fold) {
    std::vector<Sample> learnt, asked;
    for (const Sample& s : samples) (fold_of(*s.patch) == fold ? asked : learnt).push_back(s);
    if (!has_both(learnt) || !has_both(asked)) continue;
    const std::vector<double> scores = scores_for(learnt, asked, features);
    std::vector<std::pair<double, int>> scored;
    for (std::size_t i = 0; i < asked.size(); ++i) scored.emplace_back(scores[i], asked[i].label);
    const Pairs here = pairs_of(std::move(scored));
    pairs.won += here.won, pairs.all += here.all;
    result.least = std::min(result.least, here.auc());
    result.most = std::max(result.most, here.auc());
    ++result.folds;
  }
  if (result.folds < 2) throw few;
  result.auc = pairs.auc();
  return result;
}

}  // namespace skerry::echo
