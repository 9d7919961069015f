#include "clients/signals/wav_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "tests/unit/signals/outside_tool.hpp"
#include "tests/unit/signals/synthetic_recording.hpp"

namespace skerry::client {
namespace {

using namespace testing_signals;
using testing::HasSubstr;

std::vector<std::int16_t> as_samples(const std::vector<std::uint8_t>& bytes, std::size_t from = 0) {
  std::vector<std::int16_t> samples;
  for (std::size_t i = from; i + 1 < bytes.size(); i += 2) {
    samples.push_back(static_cast<std::int16_t>(bytes[i] | bytes[i + 1] << 8));
  }
  return samples;
}

std::uint32_t le32(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

// Interleaved, out of the definitions.
std::vector<std::int16_t> expected_frames(const SignalRecording& recording, std::uint32_t rate) {
  std::vector<std::vector<std::int16_t>> columns;
  for (const SignalChannel channel : kAll) {
    columns.push_back(expected_samples(recording, channel, rate));
  }
  std::vector<std::int16_t> frames;
  for (std::size_t m = 0; m < columns[0].size(); ++m) {
    for (const auto& column : columns) frames.push_back(column[m]);
  }
  return frames;
}

class WavOfRate : public testing::TestWithParam<std::uint32_t> {};

TEST_P(WavOfRate, SoxReadsEverySample) {
  if (!is_installed("sox")) FAIL() << "sox is not installed; tests/run installs it";
  const SignalRecording recording = make_recording({.ticks = 200'000});
  Waveform waveform(recording, kAll, GetParam());
  Folder folder;
  const std::string path = folder / "signals.wav";
  const SignalFile file = write_wav(path, recording, waveform, kAlways);
  EXPECT_TRUE(file.complete);
  EXPECT_EQ(file.bytes, std::filesystem::file_size(path));
  EXPECT_LE(file.bytes, wav_bytes(waveform.samples(), kAll.size()));

  const ToolOutput raw = run_tool("sox -D " + path + " -t raw -e signed -b 16 -L -");
  ASSERT_EQ(raw.code, 0);
  const auto samples = as_samples(raw.out), expected = expected_frames(recording, GetParam());
  ASSERT_EQ(samples.size(), expected.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) wrong += samples[i] != expected[i];
  EXPECT_EQ(wrong, 0u);

  EXPECT_EQ(std::stod(run_tool("sox --i -r " + path).text()), GetParam());
  EXPECT_EQ(run_tool("sox --i -c " + path).text(), "6\n");
  EXPECT_EQ(run_tool("sox --i -b " + path).text(), "16\n");
}

TEST(WavWriter, TheCommentNamesTheChannelsAndTheirScale) {
  const SignalRecording recording = make_recording();
  Waveform waveform(recording, kAll, 2'000'000);
  Folder folder;
  write_wav(folder / "f.wav", recording, waveform, kAlways);
  const std::string head = text_of_file(folder / "f.wav").substr(0, 1024);
  EXPECT_THAT(head, HasSubstr("ICMT"));
  EXPECT_THAT(head, HasSubstr("channels: video_a video_b trigger acp arp heading; "
                              "video_a = code * 8; video_b = code * 128; lines 0 or 32767; "
                              "sample clock 20000000 Hz"));
  EXPECT_THAT(head, HasSubstr("skerryd 0.1.0, radar 0 \"X band\""));
}

INSTANTIATE_TEST_SUITE_P(Rates, WavOfRate, testing::Values(20'000'000u, 2'000'000u, 44'100u));

// Its sizes are read as EBU Tech 3306 has them: sox of Debian 12 does not know RF64.
TEST(WavWriter, BeyondTheSizeOfAWavItIsRf64WithSizesOf64Bits) {
  const SignalRecording recording = make_recording();
  Waveform waveform(recording, kAll, 2'000'000);
  Folder folder;
  const std::string path = folder / "large.wav";
  const SignalFile file = write_wav(path, recording, waveform, kAlways, 1000);
  const std::string text = text_of_file(path);
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  EXPECT_EQ(text.substr(0, 4), "RF64");
  EXPECT_EQ(le32(bytes, 4), 0xFFFFFFFFu);
  EXPECT_EQ(text.substr(8, 8), "WAVEds64");
  EXPECT_EQ(le32(bytes, 20), bytes.size() - 8);  // low half of the RIFF size
  EXPECT_EQ(le32(bytes, 24), 0u);
  const auto expected = expected_frames(recording, 2'000'000);
  EXPECT_EQ(le32(bytes, 28), expected.size() * 2);
  EXPECT_EQ(le32(bytes, 36), waveform.samples());
  const std::size_t data = text.find("data", 40);
  ASSERT_NE(data, std::string::npos);
  EXPECT_EQ(le32(bytes, data + 4), 0xFFFFFFFFu);
  auto samples = as_samples(bytes, data + 8);
  ASSERT_GE(samples.size(), expected.size());
  samples.resize(expected.size());
  EXPECT_TRUE(samples == expected);
  EXPECT_EQ(file.samples, waveform.samples());
}

TEST(WavWriter, EndsWholeButShorterWhenTold) {
  if (!is_installed("sox")) FAIL() << "sox is not installed; tests/run installs it";
  const SignalRecording recording = make_recording({.ticks = 300'000});
  Waveform waveform(recording, kAll, 20'000'000);
  Folder folder;
  const SignalFile file =
      write_wav(folder / "f.wav", recording, waveform, [](double done) { return done < 0.3; });
  EXPECT_FALSE(file.complete);
  EXPECT_EQ(file.samples, 2u << 16);
  EXPECT_EQ(run_tool("sox --i -s " + (folder / "f.wav")).text(),
            std::to_string(file.samples) + "\n");
}

// A disk with no room, for this process: files end at `bytes`.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = SIG_DFL;
};

TEST(WavWriter, AFullDiskIsAnErrorThatNamesTheFileAndLeavesNone) {
  const SignalRecording recording = make_recording();
  Waveform waveform(recording, kAll, 20'000'000);
  Folder folder;
  std::string error;
  {
    const SmallDisk disk(100'000);
    try {
      write_wav(folder / "f.wav", recording, waveform, kAlways);
    } catch (const std::runtime_error& failure) {
      error = failure.what();
    }
  }
  EXPECT_EQ(error, "cannot write " + (folder / "f.wav") + ": File too large");
  EXPECT_FALSE(std::filesystem::exists(folder / "f.wav"));
  EXPECT_THROW(write_wav("/dev/full", recording, waveform, kAlways), std::runtime_error);
  EXPECT_THROW(write_wav(folder / "none/f.wav", recording, waveform, kAlways), std::runtime_error);
}

}  // namespace
}  // namespace skerry::client
