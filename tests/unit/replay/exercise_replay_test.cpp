// An exercise's inputs make its video again, bit for bit.
#include "server/replay/exercise_replay.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/replay/comparison.hpp"
#include "tests/unit/replay/live_exercise.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

class Replay : public testing::Test {
 protected:
  static void SetUpTestSuite() { parts_ = new RecordedParts(run_exercise(50)); }
  static void TearDownTestSuite() { delete std::exchange(parts_, nullptr); }
  ~Replay() override { fs::remove_all(folder_); }

  ComparisonResult compared(const RecordedParts& parts, bool checkpoints, std::size_t workers = 0) {
    const auto reader =
        recording::RecordingReader::open(write_recording(folder_, parts, checkpoints));
    if (!reader) throw std::runtime_error(reader.error().to_string());
    const auto exercise = RecordedExercise::read(*reader);
    if (!exercise) throw std::runtime_error(exercise.error().to_string());
    const ExercisePlan plan = exercise_plan(exercise->scenario_yaml, "scenario.yaml");
    const auto chart = open_charts({}, {});
    Comparison comparison(*reader, *exercise);
    ExerciseReplay replay(*exercise, plan, *chart, workers);
    replay.run(
        [&](const Sector& sector) {
          for (const SpokePtr& spoke : sector.spokes) comparison.add(*spoke);
        },
        [](double) { return true; });
    return comparison.finish();
  }
  // All inputs of a kind, to be changed.
  template <typename Change>
  static RecordedParts with(Change change) {
    RecordedParts parts = *parts_;
    std::vector<std::string> kept;
    for (const std::string& bytes : parts.inputs) {
      recording::Input input;
      input.ParseFromString(bytes);
      if (change(input)) kept.push_back(input.SerializeAsString());
    }
    parts.inputs = std::move(kept);
    return parts;
  }

  static inline RecordedParts* parts_ = nullptr;
  const fs::path folder_ =
      fs::temp_directory_path() / ("skerry-replay-" + std::to_string(getpid()));
};

TEST_F(Replay, OfFiftyChangesIsIdenticalToTheLastByte) {
  ASSERT_GT(parts_->spokes.size(), 3000u);
  const ComparisonResult result = compared(*parts_, false);
  EXPECT_TRUE(result.is_identical()) << result.first_difference;
  EXPECT_EQ(result.compared, parts_->spokes.size());
  EXPECT_EQ(result.different, 0u);
  EXPECT_EQ(result.missing, 0u);
}

TEST_F(Replay, SawPicturesViewsAndEmissionsChange) {
  std::size_t coasts = 0, emissions = 0, views = 0, world = 0;
  for (const std::string& bytes : parts_->inputs) {
    recording::Input input;
    ASSERT_TRUE(input.ParseFromString(bytes));
    coasts += input.has_taken() && input.taken().has_coast();
    emissions += input.has_taken() && input.taken().has_emissions();
    views += input.has_taken() && input.taken().views_size() > 1;
    world += input.has_order() || input.has_fix() || input.has_environment();
  }
  EXPECT_GE(coasts, 10u);
  EXPECT_GE(emissions, 10u);
  EXPECT_GE(views, 5u);
  EXPECT_GE(world, 10u);
}

TEST_F(Replay, OfInputsAloneHasTheSameHashes) {
  const ComparisonResult result = compared(*parts_, true);
  EXPECT_TRUE(result.is_identical()) << result.first_difference;
  EXPECT_EQ(result.hashed, parts_->spokes.size());
  EXPECT_EQ(result.compared, 0u);
}

TEST_F(Replay, DoesNotDependOnTheNumberOfThreads) {
  EXPECT_EQ(compared(*parts_, true, 0).sha256, compared(*parts_, true, 3).sha256);
}

TEST_F(Replay, ShowsWhatWasChangedAfterwards) {
  bool changed = false;
  const RecordedParts louder = with([&](recording::Input& input) {
    if (input.has_taken() && input.taken().first() > 0 && input.taken().views_size() > 0 &&
        !std::exchange(changed, true)) {
      recording::Input::View& view = *input.mutable_taken()->mutable_views(0);
      view.set_gain(view.gain() > 50.0 ? view.gain() - 20.0 : view.gain() + 20.0);
    }
    return true;
  });
  ASSERT_TRUE(changed);
  EXPECT_GT(compared(louder, false).different, 0u);
  EXPECT_GT(compared(louder, true).checkpoints_wrong, 0u);

  bool ordered = false;
  const RecordedParts no_order = with([&](recording::Input& input) {
    return !(input.has_order() && !std::exchange(ordered, true));
  });
  ASSERT_TRUE(ordered);
  EXPECT_GT(compared(no_order, false).different, 0u);
}

TEST_F(Replay, ShowsAnotherSeed) {
  RecordedParts other = *parts_;
  other.documents = exercise_documents(exercise_yaml(12), {});
  EXPECT_FALSE(compared(other, false).is_identical());
}

TEST_F(Replay, OfAnExerciseThatWasTakenUpLateIsIdentical) {
  constexpr std::chrono::seconds kAgo{100};
  const RecordedParts late = run_exercise(12, 11, kAgo);
  const ComparisonResult result = compared(late, false);
  EXPECT_TRUE(result.is_identical()) << result.first_difference;
  EXPECT_EQ(result.compared, late.spokes.size());
  for (const SpokePtr& spoke : late.spokes) {
    // The first sector may have begun before, 63 ms at most.
    EXPECT_GE(spoke->header.scenario_time, ScenarioTime(kAgo) - std::chrono::milliseconds(63));
    // A turn a second of 256 spokes: as its antenna would have turned since time 0.
    if (spoke->header.radar == 0) {
      EXPECT_GE(spoke->header.sequence, 100u * 256u - 16u);
    }
  }
}

TEST_F(Replay, MissesSpokesThatWereNeverMade) {
  const RecordedParts shorter = with([](recording::Input& input) {
    if (input.has_reached()) input.mutable_reached()->set_first(input.reached().first() / 32 * 16);
    return true;
  });
  const ComparisonResult result = compared(shorter, false);
  EXPECT_EQ(result.different, 0u) << result.first_difference;
  EXPECT_GT(result.missing, 1000u);
  EXPECT_FALSE(result.is_identical());
}

// Another radar may have seen a radar's emission before a killed recorder knew of it.
TEST_F(Replay, EndsWhereARadarNeedsWhatAnotherDidBeyondItsInputs) {
  std::optional<recording::Input::Taken> emitting;
  for (const std::string& bytes : parts_->inputs) {
    recording::Input input;
    ASSERT_TRUE(input.ParseFromString(bytes));
    if (input.taken().emits() && input.taken().first() > 100 && !emitting) {
      emitting = input.taken();
    }
  }
  ASSERT_TRUE(emitting);
  const RecordedParts cut = with([&](recording::Input& input) {
    if (input.has_reached() && input.reached().radar() == emitting->radar()) {
      input.mutable_reached()->set_first(emitting->first() - 16);
    }
    return true;
  });
  const ComparisonResult result = compared(cut, false);
  EXPECT_EQ(result.different, 0u) << result.first_difference;
  EXPECT_GT(result.compared, 100u);
  EXPECT_GT(result.missing, 0u);
  EXPECT_FALSE(result.is_identical());
}

TEST_F(Replay, RefusesInputsThatContradictEachOther) {
  const auto refuses = [&](const RecordedParts& parts) {
    EXPECT_THROW(compared(parts, false), std::runtime_error);
  };
  refuses(with([](recording::Input& input) { return !input.has_began(); }));
  refuses(with([](recording::Input& input) {
    return !(input.has_taken() && input.taken().warm_up() && input.taken().radar() == 1);
  }));
  refuses(with([](recording::Input& input) {  // nobody ever makes these
    if (input.has_taken() && input.taken().has_emissions() && !input.taken().warm_up()) {
      input.mutable_taken()->set_emissions(input.taken().emissions() + 1000);
    }
    return true;
  }));
  refuses(with([](recording::Input& input) {  // of wishes that were never made
    if (input.has_taken() && input.taken().has_coast() && !input.taken().warm_up()) {
      input.mutable_taken()->mutable_coast()->set_wish(input.taken().first() + 1'000'001);
    }
    return true;
  }));
  refuses(with([](recording::Input& input) {
    if (input.has_taken() && input.taken().views_size() > 0) {
      input.mutable_taken()->mutable_views(0)->set_gain(1e9);
    }
    return true;
  }));
  refuses(with([](recording::Input& input) {
    if (input.has_order()) input.mutable_order()->set_own_ship(77);
    return true;
  }));
  refuses(with([](recording::Input& input) {
    if (input.has_environment()) {
      input.mutable_environment()->mutable_change()->set_sea_state(1e300);
    }
    return true;
  }));
  refuses(with([](recording::Input& input) {
    if (input.has_environment()) input.mutable_environment()->set_scenario_ns(INT64_MIN);
    return true;
  }));
  refuses(with([](recording::Input& input) {
    if (input.has_fix()) input.mutable_fix()->set_scenario_ns(INT64_MAX);
    return true;
  }));
  refuses(with([](recording::Input& input) {
    if (input.has_reached()) input.mutable_reached()->set_first(std::uint64_t{1} << 62);
    return true;
  }));
  refuses(with([](recording::Input& input) {
    if (input.has_taken() && input.taken().views_size() > 0) {
      for (int i = 0; i < 100; ++i) *input.mutable_taken()->add_views() = input.taken().views(0);
    }
    return true;
  }));
  RecordedParts nothing = *parts_;
  nothing.inputs.clear();
  refuses(nothing);
}

}  // namespace
}  // namespace skerry::server
