#include "tests/system/sudden_death_kit.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/reader.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::system_test {
namespace {

using recording::Kind;
using std::chrono::steady_clock;

// One file's items go on where `found` ends.
void check_file(const std::string& path, const server::RecordedHost& host, Found& found) {
  auto reader = recording::RecordingReader::open(path);
  if (!reader.ok()) return;
  recording::ItemCursor cursor = reader->items();
  const auto said = [&](std::uint64_t steady_ns) {
    const auto count = static_cast<steady_clock::rep>(steady_ns);
    found.reached = std::max(found.reached, steady_clock::time_point(Duration(count)));
  };
  wire::Spoke spoke;
  wire::OwnShip ship;
  recording::Input input;
  recording::Event event;
  while (const auto item = cursor.next()) {
    const std::string bytes(item->bytes.begin(), item->bytes.end());
    EXPECT_EQ(item->topic.radar, 0u);
    if (item->topic.kind == Kind::event) {
      EXPECT_TRUE(event.ParseFromString(bytes));
      if (event.kind() == recording::Event::DISK_FULL || event.kind() == recording::Event::LOST) {
        found.told += event.count();
      }
    } else if (item->topic.kind == Kind::input) {
      EXPECT_TRUE(input.ParseFromString(bytes));
      if (input.has_reached()) said(input.reached().first());
    } else if (item->topic.kind == Kind::own_ship) {
      EXPECT_TRUE(ship.ParseFromString(bytes));
      said(ship.utc_ns());
    }
    if (item->topic.kind != Kind::spoke) continue;
    if (!spoke.ParseFromString(bytes) || bytes != host.spoke_bytes(0, spoke.sequence())) {
      ADD_FAILURE() << path << ": a wrong spoke at " << found.next;
      return;
    }
    // The child published some before it recorded.
    if (found.spokes == 0) found.next = spoke.sequence();
    EXPECT_GE(spoke.sequence(), found.next) << path;
    found.missing += spoke.sequence() - found.next;
    found.next = spoke.sequence() + 1;
    ++found.spokes;
  }
}

}  // namespace

int kills() {
  const char* text = std::getenv("SKERRY_KILLS");
  return text == nullptr ? 20 : std::max(1, std::atoi(text));
}

Tale::Tale(std::string path) : path_(std::move(path)) {
  const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ::ftruncate(file, sizeof(ChildsTale)) != 0) {
    throw std::runtime_error("no memory for the child's tale");
  }
  memory_ = ::mmap(nullptr, sizeof(ChildsTale), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  if (memory_ == MAP_FAILED) throw std::runtime_error("no memory for the child's tale");
}

Tale::~Tale() { ::munmap(memory_, sizeof(ChildsTale)); }

std::uint64_t Tale::published(steady_clock::time_point time) const {
  const std::uint64_t entries = told().entries;
  const std::uint64_t first = entries > ChildsTale::kEntries ? entries - ChildsTale::kEntries : 0;
  std::uint64_t spokes = 0;
  for (std::uint64_t i = first; i < entries; ++i) {
    const ChildsTale::Entry& entry = told().told[i % ChildsTale::kEntries];
    if (entry.steady_ns.load() <= time.time_since_epoch().count()) spokes = entry.spokes;
  }
  return spokes;
}

Found check_bytes(const std::string& path, UtcTime begin) {
  return check_bytes(std::vector<std::string>{path}, begin);
}

Found check_bytes(const std::vector<std::string>& paths, UtcTime begin) {
  Found found;
  server::RecordedHost host;
  host.begin_utc = begin;
  for (const std::string& path : paths) check_file(path, host, found);
  return found;
}

}  // namespace skerry::system_test
