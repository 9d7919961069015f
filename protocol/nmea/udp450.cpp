#include "protocol/nmea/udp450.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {
namespace {

constexpr unsigned kMostNumber = 999, kMostCode = 99;

std::optional<unsigned> whole(std::string_view text) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "2-3-17".
std::optional<TagGroup> group_of(std::string_view text) {
  const std::size_t first = text.find('-');
  const std::size_t second = first == std::string_view::npos ? first : text.find('-', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const auto part = whole(text.substr(0, first));
  const auto total = whole(text.substr(first + 1, second - first - 1));
  const auto code = whole(text.substr(second + 1));
  if (!part || !total || !code) return std::nullopt;
  return TagGroup{*part, *total, *code};
}

// "s:RA0001,n:12", without checksum.
void read_parameters(std::string_view block, TaggedLine& line) {
  while (!block.empty()) {
    const std::string_view parameter = block.substr(0, block.find(','));
    block.remove_prefix(std::min(parameter.size() + 1, block.size()));
    if (parameter.size() < 2 || parameter[1] != ':') continue;
    const std::string_view value = parameter.substr(2);
    switch (parameter[0]) {
      case 's':
        line.source = value;
        break;
      case 'd':
        line.destination = value;
        break;
      case 'n':
        line.number = whole(value);
        break;
      case 'g':
        line.group = group_of(value);
        break;
      default:
        break;
    }
  }
}

Failure<WireError> malformed(std::size_t offset, std::string text) {
  return Failure{WireError{WireErrorKind::malformed, offset, std::move(text)}};
}

}  // namespace

bool is_udp450(std::span<const std::uint8_t> datagram) {
  return datagram.size() >= kUdp450Header.size() &&
         std::equal(kUdp450Header.begin(), kUdp450Header.end(), datagram.begin());
}

bool is_udp450_source(std::string_view source) {
  const auto capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return source.size() == 6 && std::all_of(source.begin(), source.begin() + 2, capital) &&
         std::all_of(source.begin() + 2, source.end(), digit);
}

std::vector<Bytes> Udp450Encoder::encode(std::span<const std::string> lines) {
  std::vector<Bytes> datagrams;
  if (lines.size() > 1) code_ = code_ % kMostCode + 1;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    number_ = number_ % kMostNumber + 1;
    std::string tag;
    if (lines.size() > 1) tag = fmt::format("g:{}-{}-{},", i + 1, lines.size(), code_);
    tag += fmt::format("s:{},n:{}", source_, number_);
    const std::string line = fmt::format("\\{}*{}\\{}", tag, checksum_text(tag), lines[i]);
    if (datagrams.empty() || datagrams.back().size() + line.size() > kMostUdp450) {
      datagrams.emplace_back(kUdp450Header.begin(), kUdp450Header.end());
    }
    datagrams.back().insert(datagrams.back().end(), line.begin(), line.end());
  }
  return datagrams;
}

Result<std::vector<TaggedLine>, WireError> decode_udp450(std::span<const std::uint8_t> datagram) {
  if (!is_udp450(datagram))
    return malformed(0, "the datagram does not begin with \"UdPbC\" and a zero");
  std::vector<TaggedLine> lines;
  const std::string_view text(reinterpret_cast<const char*>(datagram.data()), datagram.size());
  std::size_t at = kUdp450Header.size();
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view rest = text.substr(at, end - at);
    while (!rest.empty() && (rest.back() == '\r' || rest.back() == ' ')) rest.remove_suffix(1);
    TaggedLine line;
    while (rest.starts_with('\\')) {
      const std::size_t close = rest.find('\\', 1);
      if (close == std::string_view::npos) return malformed(at, "a TAG block does not end");
      const std::string_view block = rest.substr(1, close - 1);
      const std::size_t star = block.rfind('*');
      if (star == std::string_view::npos ||
          block.substr(star + 1) != checksum_text(block.substr(0, star))) {
        return malformed(at, "a TAG block has no or a wrong checksum");
      }
      read_parameters(block.substr(0, star), line);
      rest.remove_prefix(close + 1);
    }
    if (!rest.empty()) {
      line.sentence = rest;
      lines.push_back(std::move(line));
    }
    at = end + 1;
  }
  return lines;
}

}  // namespace skerry::nmea
