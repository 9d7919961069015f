#include "protocol/wire/datagram.hpp"

#include <fmt/format.h>

#include <utility>

#include "protocol/wire/byte_order.hpp"

namespace skerry {
namespace {

Failure<WireError> fail(WireErrorKind kind, std::size_t offset, std::string text) {
  return Failure{WireError{kind, offset, "datagram: " + std::move(text)}};
}

// Offsets of the header's fields, for errors.
enum : std::size_t { kAtVersion = 4, kAtHeaderSize = 5, kAtFragmentIndex = 10, kAtBodyLength = 24 };

// Whether a body cut into fragments of fragment_size has this one, of `size` bytes.
bool fits(const DatagramHeader& header, std::size_t size) {
  const std::size_t step = header.fragment_size;
  if (step == 0 || header.offset != header.fragment_index * step) return false;
  if (header.fragment_count != (header.body_length + step - 1) / step) return false;
  return header.fragment_index < header.fragment_count &&
         size == std::min<std::size_t>(step, header.body_length - header.offset);
}

}  // namespace

void append_datagram_header(Bytes& out, const DatagramHeader& header, DatagramKind kind) {
  append_big_endian(out, static_cast<std::uint32_t>(kind), 4);
  append_big_endian(out, kDatagramVersion, 1);
  append_big_endian(out, kDatagramHeaderSize, 1);
  append_big_endian(out, header.spoke.radar, 2);
  append_big_endian(out, header.spoke.view, 2);
  append_big_endian(out, header.fragment_index, 2);
  append_big_endian(out, header.fragment_count, 2);
  append_big_endian(out, header.fragment_size, 2);
  append_big_endian(out, header.spoke.sequence, 8);
  append_big_endian(out, header.body_length, 4);
  append_big_endian(out, header.offset, 4);
}

Result<DatagramHeader, WireError> decode_datagram_header(std::span<const std::uint8_t> datagram,
                                                         DatagramKind kind) {
  if (datagram.size() < kDatagramHeaderSize) {
    return fail(WireErrorKind::truncated, datagram.size(),
                fmt::format("{} bytes, shorter than its header of {}", datagram.size(),
                            kDatagramHeaderSize));
  }
  ByteReader reader(datagram);
  const auto expected = static_cast<std::uint32_t>(kind);
  if (const auto magic = reader.big_endian<std::uint32_t>(); magic != expected) {
    return fail(WireErrorKind::malformed, 0,
                fmt::format("begins with {:08x}, expected {:08x} (\"{}\")", magic, expected,
                            kind == DatagramKind::spokes ? "SKRY" : "SKRB"));
  }
  if (const std::uint8_t version = reader.octet(); version != kDatagramVersion) {
    return fail(WireErrorKind::unknown_kind, kAtVersion,
                fmt::format("version {}, expected {}", version, kDatagramVersion));
  }
  DatagramHeader header;
  header.header_size = reader.octet();
  header.spoke.radar = reader.big_endian<std::uint16_t>();
  header.spoke.view = reader.big_endian<std::uint16_t>();
  header.fragment_index = reader.big_endian<std::uint16_t>();
  header.fragment_count = reader.big_endian<std::uint16_t>();
  header.fragment_size = reader.big_endian<std::uint16_t>();
  header.spoke.sequence = reader.big_endian<std::uint64_t>();
  header.body_length = reader.big_endian<std::uint32_t>();
  header.offset = reader.big_endian<std::uint32_t>();

  if (header.header_size < kDatagramHeaderSize || header.header_size >= datagram.size()) {
    return fail(WireErrorKind::malformed, kAtHeaderSize,
                fmt::format("header of {} bytes in a datagram of {}, expected {} or more and some "
                            "body behind it",
                            header.header_size, datagram.size(), kDatagramHeaderSize));
  }
  if (header.body_length == 0 || header.body_length > kMaxDatagramBody) {
    return fail(
        WireErrorKind::oversized, kAtBodyLength,
        fmt::format("body of {} bytes, expected 1 .. {}", header.body_length, kMaxDatagramBody));
  }
  const std::size_t size = datagram.size() - header.header_size;
  if (!fits(header, size)) {
    return fail(WireErrorKind::malformed, kAtFragmentIndex,
                fmt::format("{} bytes at {} cannot be fragment {} of {} of a body of {} bytes cut "
                            "into fragments of {}",
                            size, header.offset, header.fragment_index, header.fragment_count,
                            header.body_length, header.fragment_size));
  }
  return header;
}

bool DatagramReassembler::was_completed(const DatagramSpoke& spoke) const {
  const std::size_t known = std::min<std::uint64_t>(completed_, kRemembered);
  return std::find(remembered_.begin(), remembered_.begin() + static_cast<std::ptrdiff_t>(known),
                   spoke) != remembered_.begin() + static_cast<std::ptrdiff_t>(known);
}

void DatagramReassembler::remember(const DatagramSpoke& spoke) {
  remembered_[completed_ % kRemembered] = spoke;
  ++completed_;
}

DatagramReassembler::Unfinished* DatagramReassembler::find_unfinished(const DatagramSpoke& spoke) {
  const auto found = std::find_if(unfinished_.begin(), unfinished_.end(),
                                  [&](const Unfinished& each) { return each.spoke == spoke; });
  return found == unfinished_.end() ? nullptr : &*found;
}

DatagramReassembler::Unfinished& DatagramReassembler::begin(const DatagramHeader& header) {
  if (unfinished_.size() == kInFlight) {
    unfinished_.erase(unfinished_.begin());
    ++abandoned_;
  }
  return unfinished_.emplace_back(Unfinished{.spoke = header.spoke,
                                             .fragment_size = header.fragment_size,
                                             .missing = header.fragment_count,
                                             .have = std::vector<bool>(header.fragment_count),
                                             .body = Bytes(header.body_length)});
}

Result<std::optional<Bytes>, WireError> DatagramReassembler::feed(
    std::span<const std::uint8_t> datagram) {
  const auto decoded = decode_datagram_header(datagram, kind_);
  if (!decoded) {
    ++refused_;
    return Failure{decoded.error()};
  }
  const DatagramHeader& header = *decoded;
  if (was_completed(header.spoke)) {
    ++duplicates_;
    return std::optional<Bytes>{};
  }
  Unfinished* body = find_unfinished(header.spoke);
  if (body != nullptr &&
      (body->body.size() != header.body_length || body->fragment_size != header.fragment_size)) {
    ++refused_;
    return fail(WireErrorKind::malformed, kAtFragmentIndex,
                fmt::format("body of {} bytes in fragments of {}, but an earlier datagram of the "
                            "same spoke said {} in fragments of {}",
                            header.body_length, header.fragment_size, body->body.size(),
                            body->fragment_size));
  }
  const auto fragment = datagram.subspan(header.header_size);
  if (header.fragment_count == 1) {
    remember(header.spoke);
    return std::optional<Bytes>(std::in_place, fragment.begin(), fragment.end());
  }
  if (body == nullptr) body = &begin(header);
  if (body->have[header.fragment_index]) {
    ++duplicates_;
    return std::optional<Bytes>{};
  }
  std::copy(fragment.begin(), fragment.end(), body->body.begin() + header.offset);
  body->have[header.fragment_index] = true;
  if (--body->missing > 0) return std::optional<Bytes>{};

  std::optional<Bytes> whole(std::move(body->body));
  remember(header.spoke);
  unfinished_.erase(unfinished_.begin() + (body - unfinished_.data()));
  return whole;
}

}  // namespace skerry
