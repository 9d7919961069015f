#include "protocol/asterix/item_writer.hpp"

#include "protocol/wire/byte_order.hpp"

namespace skerry::asterix {

std::size_t begin_block(Bytes& out, std::uint8_t category) {
  const std::size_t start = out.size();
  append_big_endian(out, category, 1);
  append_big_endian(out, 0, 2);
  return start;
}

void end_block(Bytes& out, std::size_t begun) {
  put_big_endian(out, begun + 1, out.size() - begun, 2);
}

void append_extended(Bytes& out, std::initializer_list<unsigned> octets) {
  std::size_t length = octets.size();
  while (length > 1 && *(octets.begin() + length - 1) == 0) --length;
  for (std::size_t i = 0; i < length; ++i) {
    const unsigned more = i + 1 < length ? kFieldExtension : 0u;
    out.push_back(static_cast<std::uint8_t>((*(octets.begin() + i) & 0xFEu) | more));
  }
}

}  // namespace skerry::asterix
