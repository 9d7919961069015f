#include "protocol/pcap/capture_reader.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "protocol/pcap/ipv4_fragments.hpp"
#include "protocol/wire/byte_order.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::pcap {
namespace {

struct Got {
  std::vector<CapturedDatagram> datagrams;
  CaptureCounts counts;
};

Got read(const Bytes& file) {
  Got got;
  const auto counts = read_capture(file, [&](const Datagram& each) {
    got.datagrams.push_back(
        {each.time, each.from, each.to, {each.payload.begin(), each.payload.end()}});
  });
  EXPECT_TRUE(counts.ok()) << (counts.ok() ? "" : counts.error().text);
  if (counts.ok()) got.counts = *counts;
  return got;
}

// Integers of either byte order.
class Writer {
 public:
  explicit Writer(bool big) : big_(big) {}
  void add(std::uint64_t value, int octets) {
    if (big_) return append_big_endian(bytes, value, octets);
    for (int i = 0; i < octets; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  }
  Bytes bytes;

 private:
  bool big_;
};

Bytes pcap_of(const std::vector<Bytes>& frames, std::uint32_t link, bool big = false,
              bool nanoseconds = false) {
  Writer out(big);
  out.add(nanoseconds ? 0xA1B23C4D : 0xA1B2C3D4, 4);
  out.add(2, 2);
  out.add(4, 2);
  out.add(0, 8);
  out.add(65535, 4);
  out.add(link, 4);
  for (const Bytes& frame : frames) {
    out.add(1700000000, 4);
    out.add(123456, 4);
    out.add(frame.size(), 4);
    out.add(frame.size(), 4);
    out.bytes.insert(out.bytes.end(), frame.begin(), frame.end());
  }
  return out.bytes;
}

Bytes udp_of(const Bytes& payload) {
  Bytes udp;
  append_big_endian(udp, 1048, 2);
  append_big_endian(udp, 6679, 2);
  append_big_endian(udp, payload.size() + 8, 2);
  append_big_endian(udp, 0, 2);
  udp.insert(udp.end(), payload.begin(), payload.end());
  return udp;
}

// 192.0.2.1 -> 236.6.7.9; `offset` in octets.
Bytes ipv4_of(std::span<const std::uint8_t> payload, std::size_t offset = 0, bool more = false,
              std::uint16_t identification = 7) {
  Bytes packet = {0x45, 0};
  append_big_endian(packet, payload.size() + 20, 2);
  append_big_endian(packet, identification, 2);
  append_big_endian(packet, offset / 8 | (more ? 0x2000u : 0u), 2);
  append_big_endian(packet, 0x40110000, 4);
  append_big_endian(packet, ipv4(192, 0, 2, 1), 4);
  append_big_endian(packet, ipv4(236, 6, 7, 9), 4);
  packet.insert(packet.end(), payload.begin(), payload.end());
  return packet;
}

Bytes behind(Bytes header, const Bytes& packet) {
  header.insert(header.end(), packet.begin(), packet.end());
  return header;
}

Bytes numbers(std::size_t count) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
  return bytes;
}

constexpr std::uint32_t kEthernet = 1, kNull = 0, kRaw = 101, kCooked = 113, kCooked2 = 276;

TEST(CaptureReader, FindsTheDatagramBehindEveryLinkByteOrderAndClock) {
  const Bytes payload = numbers(18);
  const Bytes packet = ipv4_of(udp_of(payload));
  Bytes ethernet(12), vlan(12), cooked(14), cooked2;
  append_big_endian(ethernet, 0x0800, 2);
  append_big_endian(vlan, 0x88A8'0001'8100'0002, 8);
  append_big_endian(vlan, 0x0800, 2);
  append_big_endian(cooked, 0x0800, 2);
  append_big_endian(cooked2, 0x0800, 2);
  cooked2.resize(20);
  const std::vector<std::pair<std::uint32_t, Bytes>> frames = {
      {kEthernet, behind(ethernet, packet)}, {kEthernet, behind(vlan, packet)},
      {kCooked, behind(cooked, packet)},     {kCooked2, behind(cooked2, packet)},
      {kNull, behind({2, 0, 0, 0}, packet)}, {kRaw, packet}};
  for (const auto& [link, frame] : frames) {
    for (const bool big : {false, true}) {
      for (const bool nanoseconds : {false, true}) {
        const Got got = read(pcap_of({frame}, link, big, nanoseconds));
        ASSERT_EQ(got.datagrams.size(), 1u) << "link " << link;
        const CapturedDatagram& datagram = got.datagrams[0];
        EXPECT_EQ(text_of(datagram.from), "192.0.2.1:1048");
        EXPECT_EQ(text_of(datagram.to), "236.6.7.9:6679");
        EXPECT_EQ(datagram.payload, payload);
        EXPECT_EQ(datagram.time.time_since_epoch().count(),
                  1700000000'000000000 + (nanoseconds ? 123456 : 123456000));
      }
    }
  }
}

TEST(CaptureReader, ReadsPcapngAsEditcapWritesIt) {
  if (std::system("editcap --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no editcap";
  const Bytes pcap = pcap_of({ipv4_of(udp_of(numbers(40)))}, kRaw, true, true);
  const std::string folder = testing::TempDir(), from = folder + "skerry_capture_reader.pcap",
                    to = folder + "skerry_capture_reader.pcapng";
  std::ofstream(from, std::ios::binary)
      .write(reinterpret_cast<const char*>(pcap.data()), static_cast<std::streamsize>(pcap.size()));
  ASSERT_EQ(std::system(("editcap -F pcapng " + from + " " + to).c_str()), 0);
  std::stringstream text;
  text << std::ifstream(to, std::ios::binary).rdbuf();
  const std::string bytes = text.str();
  const Got got = read(Bytes(bytes.begin(), bytes.end()));
  ASSERT_EQ(got.datagrams.size(), 1u);
  EXPECT_EQ(got.datagrams[0].payload, numbers(40));
  EXPECT_EQ(got.datagrams[0].time.time_since_epoch().count(), 1700000000'000123456);
}

TEST(CaptureReader, PutsFragmentsTogetherInAnyOrder) {
  const Bytes payload = numbers(17160);
  const Bytes udp = udp_of(payload);
  std::vector<Bytes> frames;
  for (std::size_t at = 0; at < udp.size(); at += 1480) {
    const std::size_t size = std::min<std::size_t>(1480, udp.size() - at);
    frames.push_back(ipv4_of(std::span(udp).subspan(at, size), at, at + size < udp.size()));
  }
  std::vector<Bytes> backwards;
  for (std::size_t i = frames.size(); i-- > 0;) {
    backwards.push_back(frames[i]);
    if (i == 5) backwards.push_back(frames[i]);  // one comes twice
  }
  for (const auto& order : {frames, backwards}) {
    const Got got = read(pcap_of(order, kRaw));
    ASSERT_EQ(got.datagrams.size(), 1u);
    EXPECT_EQ(got.datagrams[0].payload, payload);
    EXPECT_EQ(got.counts.incomplete, 0u);
  }
  frames.erase(frames.begin() + 5);
  const Got got = read(pcap_of(frames, kRaw));
  EXPECT_EQ(got.datagrams.size(), 0u);
  EXPECT_EQ(got.counts.incomplete, 1u);
}

TEST(CaptureReader, CountsWhatIsNoWholeUdpDatagram) {
  Bytes tcp = ipv4_of(numbers(40));
  tcp[9] = 6;
  Bytes ipv6 = ipv4_of(udp_of(numbers(4)));
  ipv6[0] = 0x65;
  Bytes cut = ipv4_of(udp_of(numbers(40)));
  cut.resize(cut.size() - 1);
  Bytes lying = udp_of(numbers(4));
  lying[5] = 200;
  const Got got = read(pcap_of({tcp, ipv6, cut, ipv4_of(lying), {}, numbers(3)}, kRaw));
  EXPECT_EQ(got.datagrams.size(), 0u);
  EXPECT_EQ(got.counts.frames, 6u);
  EXPECT_EQ(got.counts.others, 4u);
  EXPECT_EQ(got.counts.incomplete, 2u);
}

TEST(CaptureReader, SaysWhereAFileIsCutAfterGivingWhatIsBeforeIt) {
  const Bytes file = pcap_of({ipv4_of(udp_of(numbers(9))), ipv4_of(udp_of(numbers(9)))}, kRaw);
  const std::size_t second = 24 + (file.size() - 24) / 2;
  for (std::size_t size = 0; size <= file.size(); ++size) {
    std::size_t given = 0;
    const auto counts =
        read_capture(std::span(file).first(size), [&](const Datagram&) { ++given; });
    const bool whole = size == 24 || size == second || size == file.size();
    EXPECT_EQ(counts.ok(), whole) << size;
    EXPECT_EQ(given, size == file.size() ? 2u : size >= second ? 1u : 0u) << size;
    if (counts.ok()) continue;
    EXPECT_EQ(counts.error().kind, WireErrorKind::truncated) << size;
    EXPECT_EQ(counts.error().offset, size > second ? second : size > 24 ? 24u : 0u) << size;
    EXPECT_FALSE(counts.error().text.empty());
  }
}

TEST(CaptureReader, RefusesWhatIsNoCapture) {
  const auto counts = read_capture(numbers(400), [](const Datagram&) {});
  ASSERT_FALSE(counts.ok());
  EXPECT_EQ(counts.error().kind, WireErrorKind::malformed);
}

TEST(Ipv4Fragments, GivesUpTheOldestAndWhatContradictsItself) {
  Ipv4Fragments fragments(2);
  const Bytes eight = numbers(8), sixteen = numbers(16);
  EXPECT_FALSE(fragments.add({1, 2, 1, 17}, 0, true, eight));
  EXPECT_FALSE(fragments.add({1, 2, 2, 17}, 0, true, eight));
  EXPECT_FALSE(fragments.add({1, 2, 3, 17}, 0, true, eight));
  EXPECT_EQ(fragments.pending(), 2u);
  EXPECT_EQ(fragments.given_up(), 1u);
  EXPECT_FALSE(fragments.add({1, 2, 2, 17}, 0, true, sixteen));  // another first fragment
  EXPECT_EQ(fragments.given_up(), 2u);
  EXPECT_FALSE(fragments.add({1, 2, 4, 17}, 8, true, sixteen));
  EXPECT_FALSE(fragments.add({1, 2, 4, 17}, 0, true, sixteen));  // reaches into it
  EXPECT_EQ(fragments.given_up(), 3u);
  EXPECT_TRUE(fragments.add({1, 2, 3, 17}, 8, false, eight));
  EXPECT_FALSE(fragments.add({1, 2, 5, 17}, 65528, false, sixteen));  // beyond 65,535
  EXPECT_EQ(fragments.pending(), 0u);
  EXPECT_EQ(fragments.given_up(), 4u);
}

struct Recording {
  const char* file;
  std::size_t datagrams, incomplete;
};

// Counts of an independent reader of the same files.
TEST(CaptureReader, ReadsEveryRecordingOfARealRadar) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  for (const Recording& each :
       {Recording{"3g-trueheading.pcap.gz", 651, 0}, Recording{"4g-ranges-nm.pcap.gz", 4087, 0},
        Recording{"br24-ranges-nm.pcap.gz", 3890, 1},
        Recording{"halo-velocitytrack-notarget.pcap.gz", 401, 1},
        Recording{"halo20-ranges.pcap.gz", 1804, 0},
        Recording{"halo3-5-connect-transmit.pcap.gz", 427, 63}}) {
    const Got got = read(unpack_radar_capture(each.file));
    EXPECT_EQ(got.datagrams.size(), each.datagrams) << each.file;
    EXPECT_EQ(got.counts.incomplete, each.incomplete) << each.file;
  }
}

}  // namespace
}  // namespace skerry::pcap
