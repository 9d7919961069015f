#include "protocol/asterix/item_reader.hpp"

#include <fmt/format.h>

namespace skerry::asterix {
namespace {

constexpr std::size_t kMaxDatagramOctets = 65535;

}  // namespace

bool ItemReader::fail(WireErrorKind kind, const std::string& text) {
  error_ = {kind, block_offset_ + in_.offset(), fmt::format("{}: {}", category_, text)};
  return false;
}

bool ItemReader::whole(std::string_view item) {
  return !in_.truncated() ||
         fail(WireErrorKind::truncated, fmt::format("data block ends within item {}", item));
}

bool ItemReader::fail_beyond(std::string_view what, std::size_t index, std::size_t most) {
  return fail(WireErrorKind::unknown_kind,
              fmt::format("{} octet {} names items beyond FRN {}", what, index + 1, most));
}

bool ItemReader::skip(const Shape& shape, std::string_view name) {
  switch (shape.kind) {
    case Shape::Kind::fixed:
      in_.take(shape.octets);
      break;
    case Shape::Kind::extended:
      for (auto step = in_.take(shape.octets);
           !step.empty() && (step.back() & kFieldExtension) != 0;) {
        step = in_.take(shape.octets);
      }
      break;
    case Shape::Kind::repeated:
      in_.take(std::size_t{in_.octet()} * shape.octets);
      break;
    case Shape::Kind::compound: {
      ItemOctets item;
      return read_parts(item, shape.parts, name);
    }
    case Shape::Kind::lengthy: {
      const std::uint8_t length = in_.octet();
      if (!whole(name)) return false;
      if (length == 0) {
        return fail(WireErrorKind::malformed, fmt::format("item {} of length 0", name));
      }
      in_.take(length - 1u);
      break;
    }
    case Shape::Kind::unknown:
      return fail(WireErrorKind::unknown_kind,
                  fmt::format("{} is there, which has no meaning", name));
  }
  return whole(name);
}

bool ItemReader::read_parts(ItemOctets& item, std::span<const Shape> parts, std::string_view name) {
  ItemSet<std::size_t> there;
  if (!read(there, (parts.size() + 6) / 7, name)) return false;
  for (std::size_t i = 0; i < 7 * ItemSet<std::size_t>::kMostOctets; ++i) {
    if (!there.has(i + 1)) continue;
    ByteReader before = in_;
    if (!skip(i < parts.size() ? parts[i] : Shape{}, fmt::format("{} subfield {}", name, i + 1))) {
      return false;
    }
    item.parts[i] = before.take(in_.offset() - before.offset());
  }
  return true;
}

bool ItemReader::read(ItemOctets& item, const Shape& shape, std::string_view name) {
  ByteReader before = in_;
  const bool good =
      shape.kind == Shape::Kind::compound ? read_parts(item, shape.parts, name) : skip(shape, name);
  if (good) item.octets = before.take(in_.offset() - before.offset());
  return good;
}

std::optional<WireError> for_each_block(
    std::span<const std::uint8_t> datagram, std::uint8_t category, std::string_view name,
    const std::function<std::optional<WireError>(ByteReader& block, std::size_t offset)>& read) {
  if (datagram.size() > kMaxDatagramOctets) {
    return WireError{WireErrorKind::oversized, kMaxDatagramOctets,
                     fmt::format("{}: datagram of {} bytes, expected at most {}", name,
                                 datagram.size(), kMaxDatagramOctets)};
  }
  ByteReader in(datagram);
  while (in.left() > 0) {
    const std::size_t start = in.offset();
    const std::uint8_t found = in.octet();
    const auto length = in.big_endian<std::uint16_t>();
    if (in.truncated() || length > datagram.size() - start) {
      return WireError{WireErrorKind::truncated, start,
                       fmt::format("{}: data block of {} bytes, but {} are left", name, length,
                                   datagram.size() - start)};
    }
    if (length < kBlockHeader) {
      return WireError{WireErrorKind::malformed, start,
                       fmt::format("{}: data block of {} bytes, expected 3 or more", name, length)};
    }
    ByteReader block(in.take(length - kBlockHeader));
    if (found != category) continue;
    if (auto error = read(block, start + kBlockHeader)) return error;
  }
  return std::nullopt;
}

}  // namespace skerry::asterix
