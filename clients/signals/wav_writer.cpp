#include "clients/signals/wav_writer.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "clients/signals/output_file.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

constexpr std::uint64_t kHeadBytes = 1024;

std::string comment_of(const SignalRecording& recording, const Waveform& waveform) {
  std::string text = "channels:";
  for (const SignalChannel channel : waveform.channels()) {
    text += fmt::format(" {}", channel_name(channel));
  }
  for (const SignalChannel channel : waveform.channels()) {
    const auto video = video_channel(channel);
    if (!video || recording.sweeps.empty()) continue;
    const unsigned bits = code_bits(recording.sweeps.front().meta.channels[*video]);
    text += bits > 15 ? fmt::format("; {} = code / 2", channel_name(channel))
                      : fmt::format("; {} = code * {}", channel_name(channel), 1u << (15 - bits));
  }
  return text +
         fmt::format("; lines 0 or {}; sample clock {} Hz", kLineHigh, recording.sample_clock_hz);
}

// Whatever happens, the file is closed.
struct Closer {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

}  // namespace

std::uint64_t wav_bytes(std::uint64_t samples, std::size_t channels) {
  return kHeadBytes + samples * channels * sizeof(std::int16_t);
}

SignalFile write_wav(const std::string& path, const SignalRecording& recording, Waveform& waveform,
                     const GoOn& go_on, std::uint64_t large_from) {
  const std::size_t channels = waveform.channels().size();
  const std::uint64_t data = waveform.samples() * channels * sizeof(std::int16_t);
  SF_INFO info{};
  info.samplerate = static_cast<int>(waveform.grid().rate_hz());
  info.channels = static_cast<int>(channels);
  info.format = SF_FORMAT_PCM_16 | (data > large_from ? SF_FORMAT_RF64 : SF_FORMAT_WAV);
  errno = 0;
  std::unique_ptr<SNDFILE, Closer> file(sf_open(path.c_str(), SFM_WRITE, &info));
  // libsndfile's own words hide the system's.
  const auto fail = [&](SNDFILE* of) {
    const std::string why = errno != 0 ? std::strerror(errno) : sf_strerror(of);
    file.reset();
    remove_unfinished(path);
    fail_writing(path, why);
  };
  if (!file) fail(nullptr);
  const std::string source = printable(recording.source);
  sf_set_string(file.get(), SF_STR_TITLE, source.c_str());
  sf_set_string(file.get(), SF_STR_COMMENT, comment_of(recording, waveform).c_str());

  SignalFile result;
  std::vector<std::int16_t> block;
  while (result.samples < waveform.samples()) {
    const std::uint64_t count =
        std::min<std::uint64_t>(Waveform::kBlock, waveform.samples() - result.samples);
    block.resize(count * channels);
    waveform.fill(result.samples, block);
    errno = 0;
    const auto frames = static_cast<sf_count_t>(count);
    if (sf_writef_short(file.get(), block.data(), frames) != frames) fail(file.get());
    result.samples += count;
    const double done =
        static_cast<double>(result.samples) / static_cast<double>(waveform.samples());
    if (!go_on(done)) break;
  }
  result.complete = result.samples == waveform.samples();
  errno = 0;
  if (const int error = sf_close(file.release()); error != 0) {
    const std::string why = errno != 0 ? std::strerror(errno) : sf_error_number(error);
    remove_unfinished(path);
    fail_writing(path, why);
  }
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  result.bytes = unknown ? wav_bytes(result.samples, channels) : size;
  return result;
}

}  // namespace skerry::client
