// Writes the seeds of the fuzz target of recordings.  Usage: recording_seeds <tests/fuzz/corpus>
#include <algorithm>

#include "protocol/recording/mcap_records.hpp"
#include "protocol/wire/byte_order.hpp"
#include "tests/fuzz/corpus_folder.hpp"
#include "tests/unit/recording/recording_kit.hpp"

namespace {

using namespace skerry;
using namespace skerry::recording;

std::vector<kit::Kept> few_items() {
  std::vector<kit::Kept> items{kit::hello_item()};
  for (std::uint32_t number = 0; number < 6; ++number) {
    items.push_back(kit::spoke_item(number, 0, 0, 128));
    if (number % 4 == 3) items.push_back(kit::event_item(number * 0.005 + 0.001, "mark"));
  }
  return items;
}

// The same file with another profile and without checksums: changes then get further.
Bytes without_checksums(Bytes file) {
  const std::string profile = "skerry";
  *std::search(file.begin(), file.end(), profile.begin(), profile.end()) = 'x';
  const auto clear = [&](std::size_t at) {
    std::fill_n(file.begin() + static_cast<std::ptrdiff_t>(at), 4, 0);
  };
  for (std::size_t offset = sizeof(mcap::kMagic); offset + mcap::kRecordHead < file.size();) {
    const auto op = static_cast<mcap::Op>(file[offset]);
    if (op == mcap::Op::chunk) clear(offset + mcap::kRecordHead + 24);
    if (op == mcap::Op::footer) clear(offset + mcap::kRecordHead + 16);
    offset +=
        mcap::kRecordHead + ByteReader(std::span<const std::uint8_t>(file).subspan(offset + 1))
                                .little_endian<std::uint64_t>();
  }
  return file;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path root = fuzz::corpora(argc, argv);
  const fuzz::CorpusFolder corpus(root / "recording");
  const char* names[] = {"none", "lz4", "zstd"};
  for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    for (const bool compact : {false, true}) {
      WriterOptions options;
      options.compression = compression;
      options.compact = compact;
      options.chunk_time = std::chrono::milliseconds(16);
      const std::string name =
          std::string(names[static_cast<int>(compression)]) + (compact ? "_compact" : "");
      corpus.write(name, kit::recording_of(few_items(), options));
      corpus.write(name + "_foreign", without_checksums(kit::recording_of(few_items(), options)));
      corpus.write(name + "_unfinished", kit::recording_of(few_items(), options, false));
    }
  }
  corpus.write("of_nothing", kit::recording_of({}));
  corpus.write("magic", {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'});
}
