#include "tests/unit/measure/picture_recording.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <tuple>

namespace skerry::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kFrameHeader = 8, kSpokeHeader = 24, kPackedCells = kNavicoCells / 2;
constexpr std::size_t kSpokeSize = kSpokeHeader + kPackedCells;

Bytes unzipped(const std::string& file) {
  const std::string command = "gzip -dc '" + file + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error(file + ": cannot run gzip");
  Bytes bytes;
  std::array<std::uint8_t, 65536> chunk;
  while (const std::size_t n = fread(chunk.data(), 1, chunk.size(), pipe.get())) {
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(n));
  }
  return bytes;
}

std::uint32_t little(std::span<const std::uint8_t> b, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | b[at + i];
  return value;
}
std::uint32_t big16(std::span<const std::uint8_t> b, std::size_t at) {
  return static_cast<std::uint32_t>(b[at] << 8 | b[at + 1]);
}

// Puts the fragments of IP datagrams together.
class Reassembler {
 public:
  // `ip`: one IPv4 packet.  A whole UDP payload, once its last fragment is there.
  std::optional<Bytes> add(std::span<const std::uint8_t> ip) {
    if (ip.size() < 28 || ip[0] >> 4 != 4 || ip[9] != 17) return std::nullopt;
    const std::size_t header = (ip[0] & 15u) * 4u,
                      total = std::min<std::size_t>(big16(ip, 2), ip.size());
    if (header < 20 || total <= header) return std::nullopt;
    const std::uint32_t flags = big16(ip, 6);
    const std::size_t offset = (flags & 0x1FFFu) * 8u;
    const bool more = (flags & 0x2000u) != 0;
    const auto body = ip.subspan(header, total - header);
    const auto key = std::tuple(little(ip, 12, 4), little(ip, 16, 4), big16(ip, 4));
    Parts& parts = waiting_[key];
    if (parts.bytes.size() < offset + body.size()) parts.bytes.resize(offset + body.size());
    std::copy(body.begin(), body.end(), parts.bytes.begin() + static_cast<std::ptrdiff_t>(offset));
    parts.have += body.size();
    if (!more) parts.total = offset + body.size();
    if (parts.total == 0 || parts.have < parts.total) return std::nullopt;
    Bytes udp(parts.bytes.begin() + 8,
              parts.bytes.begin() + static_cast<std::ptrdiff_t>(parts.total));
    waiting_.erase(key);
    return udp;
  }

 private:
  struct Parts {
    Bytes bytes;
    std::size_t have = 0, total = 0;
  };
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Parts> waiting_;
};

NavicoSpoke decoded(std::span<const std::uint8_t> b, NavicoKind kind) {
  NavicoSpoke spoke;
  spoke.azimuth = little(b, 8, 2) & 4095u;
  const std::uint32_t large = little(b, 6, 2), small = little(b, 12, 2);
  spoke.range_m = kind == NavicoKind::br24 ? little(b, 12, 3) * 10.0 / std::sqrt(2.0)
                  : large == 0x80          ? small / 4.0
                                           : large * static_cast<double>(small) / 512.0;
  for (std::size_t i = 0; i < kPackedCells; ++i) {
    spoke.cells[2 * i] = b[kSpokeHeader + i] & 15u;
    spoke.cells[2 * i + 1] = b[kSpokeHeader + i] >> 4;
  }
  return spoke;
}

}  // namespace

std::vector<NavicoSpoke> read_navico(const std::string& file, NavicoKind kind) {
  const Bytes bytes = unzipped(file);
  const std::span<const std::uint8_t> all(bytes);
  if (all.size() < 24 || little(all, 0, 4) != 0xA1B2C3D4u || little(all, 20, 4) != 1)
    throw std::runtime_error(file + ": not a little-endian Ethernet capture");
  Reassembler reassembler;
  std::vector<NavicoSpoke> spokes;
  for (std::size_t at = 24; at + 16 <= all.size();) {
    const std::size_t size = little(all, at + 8, 4);
    if (size > all.size() - at - 16) throw std::runtime_error(file + ": cut off");
    const auto frame = all.subspan(at + 16, size);
    at += 16 + size;
    if (frame.size() < 34 || big16(frame, 12) != 0x0800) continue;
    const auto udp = reassembler.add(frame.subspan(14));
    if (!udp || udp->size() <= kSpokeSize || (udp->size() - kFrameHeader) % kSpokeSize != 0)
      continue;
    for (std::size_t s = kFrameHeader; s < udp->size(); s += kSpokeSize) {
      spokes.push_back(decoded(std::span(*udp).subspan(s, kSpokeSize), kind));
    }
  }
  return spokes;
}

std::vector<NavicoTurn> turns_at(const std::vector<NavicoSpoke>& spokes, double range_m) {
  std::vector<NavicoTurn> turns;
  NavicoTurn turn;
  std::vector<bool> present;
  const auto begin = [&] {
    turn = {range_m, 0, std::vector<std::uint8_t>(kNavicoSpokes * kNavicoCells)};
    present.assign(kNavicoSpokes, false);
  };
  const auto end = [&] {
    for (bool p : present) turn.skipped += p ? 0 : 1;
    if (turn.skipped > kNavicoSpokes / 20) return;
    // Twice around, so that a gap at the bow is filled from the spokes before it.
    for (std::uint32_t i = 1; i < 2 * kNavicoSpokes; ++i) {
      const std::uint32_t to = i % kNavicoSpokes, from = (i - 1) % kNavicoSpokes;
      if (present[to] || !present[from]) continue;
      std::copy_n(turn.video.begin() + from * kNavicoCells, kNavicoCells,
                  turn.video.begin() + to * kNavicoCells);
      present[to] = true;
    }
    turns.push_back(std::move(turn));
  };
  begin();
  std::uint32_t last = 0;
  for (const NavicoSpoke& spoke : spokes) {
    const std::uint32_t index = spoke.azimuth / 2;
    if (index < last && last - index > kNavicoSpokes / 2) {
      end();
      begin();
    }
    last = index;
    if (std::fabs(spoke.range_m - range_m) > 1.0) continue;
    std::copy(spoke.cells.begin(), spoke.cells.end(), turn.video.begin() + index * kNavicoCells);
    present[index] = true;
  }
  end();
  return turns;
}

std::string recordings_folder() {
  const auto folder = std::filesystem::path(SKERRY_SOURCE_DIR) / "../shared/data/radar";
  return std::filesystem::is_directory(folder) ? folder.string() : std::string();
}

}  // namespace skerry::test
