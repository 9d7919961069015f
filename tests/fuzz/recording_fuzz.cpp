// The reader of recordings: whatever a file holds, what is read is in bounds and finite.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "protocol/recording/packed_spokes.hpp"
#include "protocol/recording/reader.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::recording;

// A file in memory: the reader wants a path.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::uint8_t> bytes)
      : file_(memfd_create("recording", MFD_CLOEXEC)),
        path_("/proc/self/fd/" + std::to_string(file_)) {
    fuzz::require(file_ >= 0 && write(file_, bytes.data(), bytes.size()) ==
                                    static_cast<ssize_t>(bytes.size()),
                  "there is memory for the file");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(file_); }
  const std::string& path() const { return path_; }

 private:
  int file_;
  std::string path_;
};

// Items that the input can hold: each packed spoke takes an octet at least, before compression.
constexpr int kManyItems = 20'000;

void check_cursor(ItemCursor cursor, const Summary& summary) {
  int items = 0;
  std::uint64_t octets = 0;
  while (const auto item = cursor.next()) {
    for (const std::uint8_t octet : item->bytes) octets += octet;
    if (++items >= kManyItems) return;
  }
  fuzz::require(octets < ~std::uint64_t{0}, "every octet could be read");
  fuzz::require(cursor.chunks_damaged() <= summary.chunks, "a chunk is damaged once");
  fuzz::require((cursor.chunks_damaged() > 0) == cursor.damage().has_value(), "damage is told of");
}

void check_file(std::span<const std::uint8_t> input) {
  const MemoryFile file(input);
  const auto reader = RecordingReader::open(file.path());
  if (!reader) {
    fuzz::require(!reader.error().text.empty(), "a refusal says why");
    fuzz::require(reader.error().offset <= input.size(), "a refusal's place is in the file");
    return;
  }
  const Summary& summary = reader->summary();
  fuzz::require(summary.begin <= summary.end, "it ends after its begin");
  (void)reader->hello();
  check_cursor(reader->items(), summary);
  auto sought = reader->items({{Kind::spoke, 0, 0}});
  sought.seek(summary.begin + (summary.end - summary.begin) / 2);
  check_cursor(std::move(sought), summary);
  (void)reader->last_before({Kind::spoke, 0, 0}, summary.end);
}

void check_packed(std::span<const std::uint8_t> input) {
  const auto unpacker = SpokeUnpacker::open(input);
  if (!unpacker) return fuzz::require(!unpacker.error().empty(), "a refusal says why");
  std::size_t spokes = 0;
  while ((*unpacker)->next()) ++spokes;
  fuzz::require(spokes <= input.size(), "a packed spoke takes an octet at least");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  check_file(input);
  check_packed(input);
  return 0;
}
