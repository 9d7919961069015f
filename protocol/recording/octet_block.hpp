// OctetBlock: octets that are written before they are read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace skerry::recording {

// Not zeroed: what nobody writes takes no memory of the machine.
class OctetBlock {
 public:
  OctetBlock() = default;
  // Behind the octets there is room, for who writes further than needed: `room` together.
  explicit OctetBlock(std::size_t size, std::size_t room = 0)
      : octets_(std::make_unique_for_overwrite<std::uint8_t[]>(std::max(size, room))),
        size_(size),
        room_(std::max(size, room)) {}

  std::span<std::uint8_t> room() { return {octets_.get(), room_}; }
  std::size_t memory() const { return room_; }
  std::span<const std::uint8_t> octets() const { return {octets_.get(), size_}; }

 private:
  std::unique_ptr<std::uint8_t[]> octets_;
  std::size_t size_ = 0, room_ = 0;
};

}  // namespace skerry::recording
