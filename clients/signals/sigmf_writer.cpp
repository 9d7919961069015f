#include "clients/signals/sigmf_writer.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "clients/signals/output_file.hpp"
#include "protocol/digest/digest.hpp"
#include "protocol/wire/byte_order.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kVersion = "1.2.0";
constexpr const char* kRecorder = "skerry";
constexpr std::uint64_t kMetaBytes = 4096;

std::string sha512_of(const std::string& text) {
  Sha512 hash;
  hash.add(text);
  return hexadecimal(hash.take());
}

// RFC 3339 with nine decimals.
std::string time_text(std::uint64_t utc_ns) {
  const auto seconds = static_cast<std::time_t>(utc_ns / 1'000'000'000);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:09}Z", fmt::gmtime(seconds), utc_ns % 1'000'000'000);
}

// A file name that is not UTF-8 must not stop it.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json extensions() {
  return Json::array({{{"name", "skerry"}, {"version", "1.0.0"}, {"optional", true}}});
}

// The description of a recording of one channel.
class Meta {
 public:
  Meta(const SignalRecording& recording, const Waveform& waveform, SignalChannel channel)
      : recording_(recording), grid_(waveform.grid()), channel_(channel) {}

  Json json(const SignalFile& data, const std::string& sha512) const {
    Json meta;
    meta["global"] = global(sha512);
    meta["captures"] = Json::array({capture()});
    meta["annotations"] = turns(data.samples);
    return meta;
  }

 private:
  std::string description() const {
    std::string text = fmt::format("{} of a radar's interface board, {:.6f} s, {} samples/s; ",
                                   channel_name(channel_), recording_.seconds(), grid_.rate_hz());
    const auto video = video_channel(channel_);
    if (!video) {
      text += fmt::format("0 is low, {} high, pulses of {:g} us", kLineHigh, kPulseSeconds * 1e6);
    } else if (const unsigned bits = video_bits(*video); bits > 15) {
      text += "a sample is the converter's code / 2";
    } else {
      text +=
          fmt::format("a sample is the converter's code of {} bits * {}", bits, 1u << (15 - bits));
    }
    if (!recording_.source.empty()) text += "; " + printable(recording_.source);
    return text;
  }

  unsigned video_bits(std::size_t video) const {
    if (recording_.sweeps.empty()) return 15;
    return code_bits(recording_.sweeps.front().meta.channels[video]);
  }

  Json global(const std::string& sha512) const {
    Json global;
    global["core:datatype"] = "ri16_le";
    global["core:sample_rate"] = grid_.rate_hz();
    global["core:version"] = kVersion;
    global["core:num_channels"] = 1;
    global["core:sha512"] = sha512;
    global["core:description"] = description();
    global["core:recorder"] = kRecorder;
    global["core:extensions"] = extensions();
    global["skerry:channel"] = channel_name(channel_);
    global["skerry:sample_clock_hz"] = recording_.sample_clock_hz;
    global["skerry:first_tick"] = recording_.from_tick;
    if (const auto video = video_channel(channel_)) {
      global["skerry:code_bits"] = video_bits(*video);
    }
    return global;
  }

  Json capture() const {
    Json capture;
    capture["core:sample_start"] = 0;
    // Known in samples only where a sample is a tick.
    if (grid_.rate_hz() == grid_.clock_hz()) {
      capture["core:global_index"] = recording_.from_tick;
    }
    if (recording_.utc_ns) capture["core:datetime"] = time_text(*recording_.utc_ns);
    return capture;
  }

  // From each ARP to the next or the end of the data.
  Json turns(std::uint64_t samples) const {
    Json annotations = Json::array();
    std::optional<std::uint64_t> begin;
    for (const board::Edge& edge : recording_.edges) {
      if (edge.line != board::Line::arp) continue;
      const std::uint64_t end = std::min(grid_.index(edge.tick - recording_.from_tick), samples);
      if (begin) add_turn(annotations, *begin, end);
      begin = end;
    }
    if (begin) add_turn(annotations, *begin, samples);
    return annotations;
  }

  void add_turn(Json& annotations, std::uint64_t begin, std::uint64_t end) const {
    if (begin >= end || annotations.size() >= kMaxAnnotations) return;
    Json turn;
    turn["core:sample_start"] = begin;
    turn["core:sample_count"] = end - begin;
    turn["core:freq_lower_edge"] = 0.0;
    turn["core:freq_upper_edge"] = grid_.rate_hz() / 2.0;
    turn["core:label"] = fmt::format("turn {}", annotations.size() + 1);
    turn["core:generator"] = kRecorder;
    annotations.push_back(std::move(turn));
  }

  const SignalRecording& recording_;
  const SampleGrid& grid_;
  SignalChannel channel_;
};

SignalFile write_data(const std::string& path, Waveform& waveform, Sha512& hash,
                      const GoOn& go_on) {
  OutputFile file(path);
  SignalFile result;
  std::vector<std::int16_t> samples;
  Bytes bytes;
  while (result.samples < waveform.samples()) {
    const std::uint64_t count =
        std::min<std::uint64_t>(Waveform::kBlock, waveform.samples() - result.samples);
    samples.resize(count);
    waveform.fill(result.samples, samples);
    bytes.resize(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      put_little_endian(bytes, 2 * i, static_cast<std::uint16_t>(samples[i]), 2);
    }
    file.write(bytes);
    hash.add(bytes);
    result.samples += count;
    if (!go_on(static_cast<double>(result.samples) / static_cast<double>(waveform.samples()))) {
      break;
    }
  }
  result.complete = result.samples == waveform.samples();
  file.close();
  result.bytes = file.bytes();
  return result;
}

void write_text(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.close();
}

}  // namespace

std::uint64_t sigmf_bytes(std::uint64_t samples, std::size_t channels) {
  return (samples * sizeof(std::int16_t) + kMetaBytes) * channels + kMetaBytes;
}

SigmfFiles write_sigmf(const std::string& name, const SignalRecording& recording,
                       const std::vector<SignalChannel>& channels, std::uint32_t rate_hz,
                       const GoOn& go_on) {
  SigmfFiles files;
  Json streams = Json::array();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    Waveform waveform(recording, {channels[c]}, rate_hz);
    const std::string base = fmt::format("{}-{}", name, channel_name(channels[c]));
    const std::string data_path = base + ".sigmf-data", meta_path = base + ".sigmf-meta";
    Sha512 hash;
    const SignalFile data = write_data(data_path, waveform, hash, [&](double done) {
      return go_on((static_cast<double>(c) + done) / static_cast<double>(channels.size()));
    });
    const std::string meta =
        text_of(Meta(recording, waveform, channels[c]).json(data, hexadecimal(hash.take())));
    try {
      write_text(meta_path, meta);
    } catch (...) {
      remove_unfinished(data_path);
      throw;
    }
    files.paths.insert(files.paths.end(), {data_path, meta_path});
    files.data.bytes += data.bytes + meta.size();
    files.data.samples = data.samples;
    streams.push_back(
        {{"name", std::filesystem::path(base).filename().string()}, {"hash", sha512_of(meta)}});
    files.data.complete = data.complete && c + 1 == channels.size();
    if (!data.complete) break;
  }
  Json collection;
  collection["core:version"] = kVersion;
  collection["core:description"] = "signals of a radar's interface board, one recording each";
  collection["core:streams"] = streams;
  const std::string text = text_of({{"collection", collection}});
  files.paths.push_back(name + ".sigmf-collection");
  write_text(files.paths.back(), text);
  files.data.bytes += text.size();
  return files;
}

}  // namespace skerry::client
