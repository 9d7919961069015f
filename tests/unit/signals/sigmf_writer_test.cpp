#include "clients/signals/sigmf_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/signals/outside_tool.hpp"
#include "tests/unit/signals/synthetic_recording.hpp"

namespace skerry::client {
namespace {

using namespace testing_signals;
using testing::HasSubstr;

ToolOutput check(const std::string& collection) {
  return run_tool("python3 " SKERRY_SOURCE_DIR "/tests/unit/signals/sigmf_check.py " + collection +
                  " 2>&1");
}

TEST(SigmfWriter, EveryFieldIsAsTheSpecificationHasIt) {
  if (!is_installed("python3")) FAIL() << "python3 is not installed; tests/run installs it";
  const SignalRecording recording = make_recording();
  Folder folder;
  const SigmfFiles files = write_sigmf(folder / "bench", recording, kAll, 2'000'000, kAlways);
  EXPECT_EQ(files.paths.size(), 13u);
  const ToolOutput checked = check(folder / "bench.sigmf-collection");
  EXPECT_EQ(checked.code, 0);
  EXPECT_EQ(checked.text(),
            "bench-video_a ri16_le 2000000 6000 2\n"
            "bench-video_b ri16_le 2000000 6000 2\n"
            "bench-trigger ri16_le 2000000 6000 2\n"
            "bench-acp ri16_le 2000000 6000 2\n"
            "bench-arp ri16_le 2000000 6000 2\n"
            "bench-heading ri16_le 2000000 6000 2\n");
  std::uint64_t bytes = 0;
  for (const std::string& path : files.paths) bytes += std::filesystem::file_size(path);
  EXPECT_EQ(files.data.bytes, bytes);
  EXPECT_LE(bytes, sigmf_bytes(6000, 6));
}

TEST(SigmfWriter, TheCheckOfTheTestFindsWhatIsWrong) {
  if (!is_installed("python3")) FAIL() << "python3 is not installed; tests/run installs it";
  const SignalRecording recording = make_recording();
  Folder folder;
  write_sigmf(folder / "f", recording, {SignalChannel::arp}, 2'000'000, kAlways);
  ASSERT_EQ(check(folder / "f.sigmf-collection").code, 0);
  std::ofstream(folder / "f-arp.sigmf-data", std::ios::app) << "more";
  const ToolOutput changed = check(folder / "f.sigmf-collection");
  EXPECT_EQ(changed.code, 1);
  EXPECT_THAT(changed.text(), HasSubstr("core:sha512 is not that of the data"));
}

TEST(SigmfWriter, SaysWhatItIsWhenItBeganAndWhereTheTurnsAre) {
  const SignalRecording recording = make_recording();
  Folder folder;
  write_sigmf(folder / "f", recording, {SignalChannel::video_a}, 20'000'000, kAlways);
  const std::string meta = text_of_file(folder / "f-video_a.sigmf-meta");
  EXPECT_THAT(meta, HasSubstr("\"core:datetime\": \"2026-09-21T14:13:20.123456789Z\""));
  EXPECT_THAT(meta, HasSubstr("\"core:global_index\": 1234567890123"));
  EXPECT_THAT(meta, HasSubstr("video_a of a radar's interface board, 0.003000 s, 20000000 "
                              "samples/s; a sample is the converter's code of 12 bits * 8; "
                              "skerryd 0.1.0, radar 0 \\\"X band\\\""));
  EXPECT_THAT(meta, HasSubstr("\"skerry:code_bits\": 12"));
  EXPECT_THAT(meta, HasSubstr("\"core:sample_start\": 1,\n      \"core:sample_count\": 59992"));
  EXPECT_THAT(meta, HasSubstr("\"core:label\": \"turn 1\""));
}

TEST(SigmfWriter, TheDataAreTheSamples) {
  const SignalRecording recording = make_recording();
  Folder folder;
  write_sigmf(folder / "f", recording, {SignalChannel::video_b, SignalChannel::acp}, 192'000,
              kAlways);
  for (const SignalChannel channel : {SignalChannel::video_b, SignalChannel::acp}) {
    const std::string data =
        text_of_file(folder / (std::string("f-") + channel_name(channel) + ".sigmf-data"));
    const auto expected = expected_samples(recording, channel, 192'000);
    ASSERT_EQ(data.size(), 2 * expected.size());
    std::size_t wrong = 0;
    for (std::size_t m = 0; m < expected.size(); ++m) {
      const auto low = static_cast<unsigned char>(data[2 * m]);
      const auto high = static_cast<unsigned char>(data[2 * m + 1]);
      wrong += static_cast<std::int16_t>(low | high << 8) != expected[m];
    }
    EXPECT_EQ(wrong, 0u) << channel_name(channel);
  }
}

TEST(SigmfWriter, EndsWholeButShorterWhenTold) {
  const SignalRecording recording = make_recording({.ticks = 300'000});
  Folder folder;
  const SigmfFiles files = write_sigmf(folder / "f", recording, kAll, 20'000'000,
                                       [](double done) { return done < 0.2; });
  EXPECT_FALSE(files.data.complete);
  EXPECT_EQ(files.paths.size(), 5u);  // one and a half recordings, the collection
  if (!is_installed("python3")) FAIL() << "python3 is not installed; tests/run installs it";
  const ToolOutput checked = check(folder / "f.sigmf-collection");
  EXPECT_EQ(checked.text(),
            "f-video_a ri16_le 20000000 300000 2\nf-video_b ri16_le 20000000 65536 1\n");
}

TEST(SigmfWriter, AFullDiskIsAnErrorThatNamesTheFile) {
  Folder folder;
  std::filesystem::create_symlink("/dev/full", folder / "f-acp.sigmf-data");
  try {
    write_sigmf(folder / "f", make_recording(), {SignalChannel::acp}, 20'000'000, kAlways);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(),
              "cannot write " + (folder / "f-acp.sigmf-data") + ": No space left on device");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "f.sigmf-collection"));
}

}  // namespace
}  // namespace skerry::client
