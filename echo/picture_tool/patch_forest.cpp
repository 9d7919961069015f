#include "echo/picture_tool/patch_forest.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>
#include <tuple>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kFolds = 4;
constexpr int kTrees = 200;

struct Sample {
  const PicturePatch* patch;
  int label;
};

std::uint32_t fold_of(const PicturePatch& patch) { return (patch.place + patch.quadrant) % kFolds; }

// In an order that depends on the seed and on nothing else.
std::vector<const PicturePatch*> dealt(std::span<const PicturePatch> patches, std::uint64_t seed) {
  std::vector<std::pair<std::uint64_t, const PicturePatch*>> keyed;
  for (std::size_t i = 0; i < patches.size(); ++i) keyed.emplace_back(mixed(seed, i), &patches[i]);
  std::sort(keyed.begin(), keyed.end());
  std::vector<const PicturePatch*> out;
  for (const auto& [key, patch] : keyed) out.push_back(patch);
  return out;
}

std::size_t stratum_of(const PicturePatch& patch) {
  return std::min<std::size_t>(4, static_cast<std::size_t>(patch.occupancy * 5.0f));
}

std::vector<Sample> matched(std::span<const PicturePatch> first,
                            std::span<const PicturePatch> second, std::uint64_t seed,
                            std::size_t most) {
  std::array<std::vector<const PicturePatch*>, 5> of_first, of_second;
  for (const PicturePatch* p : dealt(first, mixed(seed, 1))) of_first[stratum_of(*p)].push_back(p);
  for (const PicturePatch* p : dealt(second, mixed(seed, 2)))
    of_second[stratum_of(*p)].push_back(p);
  std::size_t all = 0;
  for (std::size_t s = 0; s < 5; ++s) all += std::min(of_first[s].size(), of_second[s].size());
  const double share = all > most ? static_cast<double>(most) / static_cast<double>(all) : 1.0;
  std::vector<Sample> samples;
  for (std::size_t s = 0; s < 5; ++s) {
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
  using Where = std::tuple<int, std::uint32_t, std::uint32_t, std::uint32_t>;
  for (Sample& sample : samples) {
    const PicturePatch& p = *sample.patch;
    const Where where{sample.label, p.place, p.spoke, p.cell};
    std::uint64_t key = mixed(seed, static_cast<std::uint64_t>(std::get<0>(where)));
    key = mixed(mixed(mixed(key, p.place), p.spoke), p.cell);
    sample.label = static_cast<int>(key >> 33 & 1u);
  }
}

cv::Mat rows_of(const std::vector<Sample>& samples, std::size_t features) {
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
  forest->train(rows_of(learnt, features), cv::ml::ROW_SAMPLE, labels);
  cv::Mat votes;
  forest->getVotes(rows_of(asked, features), votes, 0);
  const int column = votes.at<int>(0, 0) == 1 ? 0 : 1;
  std::vector<double> out;
  for (int i = 1; i < votes.rows; ++i) {
    const double all = votes.at<int>(i, 0) + votes.at<int>(i, 1);
    out.push_back(votes.at<int>(i, column) / std::max(1.0, all));
  }
  return out;
}

// Mann and Whitney's count: pairs in which label 1 has more votes, ties half.
double auc_of(std::vector<std::pair<double, int>> scored) {
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
  return ones > 0.0 && zeros > 0.0 ? (ranks - ones * (ones + 1.0) / 2.0) / (ones * zeros) : 0.5;
}

std::vector<std::string> strongest_of(const std::vector<Sample>& samples, std::size_t features) {
  std::vector<std::pair<double, std::size_t>> by_auc;
  for (std::size_t f = 0; f < features; ++f) {
    std::vector<std::pair<double, int>> scored;
    for (const Sample& s : samples)
      scored.emplace_back(static_cast<double>(s.patch->features[f]), s.label);
    const double auc = auc_of(std::move(scored));
    by_auc.emplace_back(-std::max(auc, 1.0 - auc), f);
  }
  std::sort(by_auc.begin(), by_auc.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 5; ++i) names.emplace_back(patch_feature_name(by_auc[i].second));
  return names;
}

}  // namespace

TellingApart tell_apart(std::span<const PicturePatch> first, std::span<const PicturePatch> second,
                        PatchView view, std::uint64_t seed, bool shuffled, std::size_t most) {
  std::vector<Sample> samples = matched(first, second, seed, most);
  if (samples.size() / 2 < kLeastPatches)
    throw TooFewPatches{first.size(), second.size(), samples.size() / 2};
  const std::size_t features = view == PatchView::mask ? kMaskFeatures : kPatchFeatures;
  TellingApart result;
  result.patches = samples.size() / 2;
  result.strongest = strongest_of(samples, features);
  if (shuffled) shuffle_labels(samples, mixed(seed, 3));
  std::vector<std::pair<double, int>> scored;
  for (std::uint32_t fold = 0; fold < kFolds; ++fold) {
    std::vector<Sample> learnt, asked;
    for (const Sample& s : samples) (fold_of(*s.patch) == fold ? asked : learnt).push_back(s);
    const auto ones = std::count_if(learnt.begin(), learnt.end(), [](auto& s) { return s.label; });
    if (asked.empty() || ones == 0 || ones == static_cast<std::ptrdiff_t>(learnt.size())) continue;
    const std::vector<double> votes = votes_for(learnt, asked, features);
    for (std::size_t i = 0; i < asked.size(); ++i) scored.emplace_back(votes[i], asked[i].label);
  }
  result.auc = auc_of(std::move(scored));
  return result;
}

}  // namespace skerry::echo
