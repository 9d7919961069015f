// Recordings made for tests: items that can be told apart, in memory and as files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "protocol/recording/item.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/writer.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::recording::kit {

// An item that owns its bytes.
struct Kept {
  Topic topic;
  UtcTime time{};
  std::string bytes;
  Item item() const {
    return {topic, time, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}};
  }
  friend bool operator==(const Kept&, const Kept&) = default;
};

UtcTime at(double seconds);  // after an instant of 2026

// A spoke as a simulated radar's: a coast that moves little from spoke to spoke, and noise.
Spoke spoke(std::uint32_t number, std::uint32_t radar = 0, std::uint32_t view = 0,
            std::uint32_t cells = 256, std::uint32_t bits = 8);
Kept spoke_item(std::uint32_t number, std::uint32_t radar = 0, std::uint32_t view = 0,
                std::uint32_t cells = 256);
Kept hello_item();
Kept event_item(double seconds, const std::string& mark);

// Two radars' spokes (5 ms apart), settings, own ship, world, traffic, log and marks, in order.
std::vector<Kept> exercise(std::uint32_t spokes);

Bytes recording_of(const std::vector<Kept>& items, const WriterOptions& options = {},
                   bool finish = true);

// A folder of its own that goes with it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path(const std::string& name) const { return (path_ / name).string(); }
  // Writes `bytes` to `name`; its path.
  std::string put(const std::string& name, const Bytes& bytes) const;

 private:
  std::filesystem::path path_;
};

std::vector<Kept> read_all(ItemCursor cursor);
std::vector<Kept> read_all(const std::string& path);

}  // namespace skerry::recording::kit
