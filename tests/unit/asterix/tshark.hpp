// Wireshark's opinion of datagrams: tshark on a capture written in libpcap's file format by hand.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/wire/wire_error.hpp"

namespace skerry {

namespace fs = std::filesystem;

// A classic pcap file of raw IPv4 packets (LINKTYPE_RAW, 101), each UDP to port 8600.
class Capture {
 public:
  explicit Capture(const fs::path& path) : out_(path, std::ios::binary) {
    for (const std::uint32_t word : {0xA1B2C3D4u, 0x00040002u, 0u, 0u, 65535u, 101u}) put32(word);
  }
  void add(const Bytes& payload) {
    const auto udp = static_cast<std::uint16_t>(payload.size() + 8);
    const auto ip = static_cast<std::uint16_t>(udp + 20);
    for (const std::uint32_t word : {0u, 0u, std::uint32_t{ip}, std::uint32_t{ip}}) put32(word);
    put({0x45, 0, hi(ip), lo(ip), 0, 0, 0, 0, 64, 17, 0, 0, 127, 0, 0, 1, 127, 0, 0, 1});
    put({hi(8600), lo(8600), hi(8600), lo(8600), hi(udp), lo(udp), 0, 0});
    put(payload);
  }

 private:
  static std::uint8_t hi(unsigned value) { return static_cast<std::uint8_t>(value >> 8); }
  static std::uint8_t lo(unsigned value) { return static_cast<std::uint8_t>(value); }
  void put(const Bytes& bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  void put32(std::uint32_t word) { out_.write(reinterpret_cast<const char*>(&word), sizeof word); }
  std::ofstream out_;
};

inline std::string output_of(const std::string& command) {
  std::string text;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 4096> part;
  while (pipe && std::fgets(part.data(), part.size(), pipe.get()) != nullptr) text += part.data();
  return text;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Skipped where tshark is not installed.
class Cat240Tshark : public testing::Test {
 protected:
  void SetUp() override {
    if (output_of("tshark --version 2>/dev/null").empty()) {
      GTEST_SKIP() << "tshark is not installed (Debian package tshark)";
    }
    std::string name = (fs::temp_directory_path() / "skerry_cat240_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  std::string tshark(const std::string& arguments) {
    return output_of("tshark -r '" + capture() + "' " + arguments + " 2>/dev/null");
  }
  std::string capture() const { return (folder_ / "cat240.pcap").string(); }

  fs::path folder_;
};

}  // namespace skerry
