// Finds the chunks of a file that has no summary.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "protocol/recording/chunk_data.hpp"
#include "protocol/recording/compression.hpp"
#include "protocol/recording/file_index.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::recording {
namespace {

using mcap::Op;

// Progress by octets of the file, and by octets read: a hostile file makes us read places many
// times.
constexpr std::uint64_t kProgressStep = 4 << 20, kProgressWork = 64 << 20;
constexpr std::size_t kMaxChunkHead = mcap::kChunkHead + mcap::kMaxCompressionName;

class Search {
 public:
  Search(const InputFile& file, const std::function<bool(double)>& progress)
      : file_(file), window_(file), progress_(progress) {}

  Result<FileIndex, RecordingError> run() {
    std::uint64_t offset = sizeof(mcap::kMagic);
    while (offset < file_.size()) {
      if (!tell(offset)) return Failure{file_.error(offset, "given up")};
      const auto place = record_at(window_, offset, file_.size());
      if (place && framed(*place)) {
        take(*place);
        offset = place->end();
        // Behind the footer comes the magic; and another recording, if somebody has put one there.
        if (place->op == Op::footer) offset += sizeof(mcap::kMagic);
        continue;
      }
      end_chunk(false);
      const std::uint64_t next = next_chunk(offset + 1);
      if (next == 0) return Failure{file_.error(offset, "given up")};
      note(offset,
           next < file_.size()
               ? fmt::format("no record can be read here; the next chunk is at byte {}", next)
               : "no record can be read here, and no chunk follows");
      index_.bytes_unreadable += next - offset;
      offset = next;
    }
    end_chunk(false);
    return std::move(index_);
  }

 private:
  bool tell(std::uint64_t offset) {
    const std::uint64_t work = work_ + window_.bytes_read();
    if (!progress_ || (offset < told_ + kProgressStep && work < told_work_ + kProgressWork)) {
      return true;
    }
    told_ = offset;
    told_work_ = work;
    return progress_(static_cast<double>(offset) / static_cast<double>(file_.size()));
  }

  void note(std::uint64_t offset, std::string text) {
    if (!index_.damage) index_.damage = file_.error(offset, std::move(text));
  }

  // True if what the record says of its inside fits its length: then the next one follows it.
  bool framed(const RecordPlace& place) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(place.length, kMaxRecord));
    switch (place.op) {
      case Op::header:
        return place.length <= kMaxRecord && mcap::read_header(content(place)).has_value();
      case Op::footer:
        return place.length == mcap::kFooterBytes - mcap::kRecordHead;
      case Op::schema:
        return place.length <= kMaxRecord && mcap::read_schema(content(place)).has_value();
      case Op::channel:
        return place.length <= kMaxRecord && mcap::read_channel(content(place)).has_value();
      case Op::chunk: {
        const auto head =
            mcap::read_chunk_head(window_.at(place.content, std::min(size, kMaxChunkHead)));
        return head && head->first.compressed == place.length - head->second &&
               compression_of_mcap_name(head->first.compression) &&
               head->first.start <= head->first.end;
      }
      case Op::message_index: {
        ByteReader in(window_.at(place.content, 6));
        (void)in.take(2);
        return in.little_endian<std::uint32_t>() + std::uint64_t{6} == place.length &&
               !in.truncated();
      }
      case Op::attachment:
        return place.length <= kMaxAttachment + kMaxRecord;
      case Op::message:
      case Op::chunk_index:
      case Op::attachment_index:
      case Op::statistics:
      case Op::summary_offset:
      case Op::data_end:
        return place.length <= kMaxAttachment + kMaxRecord;
    }
    // Metadata of others, and what they made of their own.
    const auto op = static_cast<int>(place.op);
    return op == 0x0C || op == 0x0D || op >= 0x80;
  }

  std::span<const std::uint8_t> content(const RecordPlace& place) {
    work_ += place.length;
    if (!file_.read_all(place.content, static_cast<std::size_t>(place.length), content_)) return {};
    return content_;
  }

  // The offset of something that looks like a chunk; the file's end if there is none; 0 if given
  // up.
  std::uint64_t next_chunk(std::uint64_t offset) {
    while (offset < file_.size()) {
      if (!tell(offset)) return 0;
      const auto window = window_.from(offset, mcap::kRecordHead + kMaxChunkHead);
      if (window.empty()) break;
      const auto* found = static_cast<const std::uint8_t*>(
          std::memchr(window.data(), static_cast<int>(Op::chunk), window.size()));
      if (found == nullptr) {
        offset += window.size();
        continue;
      }
      offset += static_cast<std::uint64_t>(found - window.data());
      const auto place = record_at(window_, offset, file_.size());
      if (place && framed(*place)) return offset;
      ++offset;
    }
    return file_.size();
  }

  void take(const RecordPlace& place) {
    if (place.op == Op::chunk) {
      end_chunk(true);
      begin_chunk(place);
    } else if (place.op == Op::message_index) {
      if (chunk_) take_message_index(place);
    } else if (place.op == Op::schema) {
      if (const auto schema = mcap::read_schema(content(place))) {
        index_.schemas.emplace(schema->id, schema->name.substr(0, kMaxName));
      }
    } else if (place.op == Op::channel) {
      if (const auto channel = mcap::read_channel(content(place))) index_.add(*channel);
    } else if (place.op == Op::attachment) {
      if (index_.attachments.size() < kMaxAttachments) index_.attachments.push_back(place);
    } else if (place.op == Op::header) {
      if (const auto header = mcap::read_header(content(place))) index_.profile = header->profile;
    }
  }

  void begin_chunk(const RecordPlace& place) {
    const auto head = mcap::read_chunk_head(window_.at(place.content, kMaxChunkHead));
    if (!head) return;
    chunk_ = ChunkPlace{
        place.offset,
        place.end() - place.offset,
        time_of(head->first.start),
        time_of(head->first.end),
        static_cast<std::uint32_t>(std::min<std::uint64_t>(head->first.uncompressed, 0xFFFFFFFF)),
        0,
        0};
    channels_.clear();
    start_ = end_ = 0;
  }

  void take_message_index(const RecordPlace& place) {
    std::uint64_t offset = place.content;
    ByteReader head(window_.at(offset, 6));
    const auto channel = head.little_endian<std::uint16_t>();
    std::uint64_t entries = (place.length - 6) / 16;
    if (entries == 0) return;
    offset += 6;
    if (channels_.empty()) start_ = std::numeric_limits<std::int64_t>::max();
    channels_[channel] += entries;
    while (entries > 0) {
      const auto some = std::min<std::uint64_t>(entries, FileWindow::kMaxWindow / 16);
      ByteReader in(window_.at(offset, static_cast<std::size_t>(16 * some)));
      if (in.left() == 0) return;
      for (std::uint64_t i = 0; i < some; ++i) {
        const std::int64_t time = time_of(in.little_endian<std::uint64_t>());
        (void)in.take(8);
        start_ = std::min(start_, time);
        end_ = std::max(end_, time);
      }
      entries -= some;
      offset += 16 * some;
    }
  }

  bool all_known() const {
    return std::all_of(channels_.begin(), channels_.end(), [&](const auto& channel) {
      return index_.channels.contains(channel.first) || others_.contains(channel.first);
    });
  }

  // Takes the chunk into the index.  What its index says must fit it and be known, and be all: what
  // comes next is whole.  Else the chunk is read.
  void end_chunk(bool indexed) {
    if (!chunk_) return;
    ChunkPlace chunk = *chunk_;
    chunk_.reset();
    if (index_.chunks.size() >= kMaxChunks ||
        index_.chunk_channels.size() + channels_.size() > kMaxChunkChannels) {
      return note(chunk.offset, "there are more chunks than can be kept in mind");
    }
    if (!indexed || channels_.empty() || start_ != chunk.start || end_ != chunk.end ||
        !all_known()) {
      work_ += chunk.length + chunk.uncompressed;
      const auto data = ChunkData::read(file_, chunk, index_);
      if (!data) {
        ++index_.chunks_unreadable;
        index_.bytes_unreadable += chunk.length;
        return note(data.error().offset, data.error().text);
      }
      for (const mcap::Channel& channel : (*data)->channels()) {
        index_.add(channel);
        if (!index_.channels.contains(channel.id)) others_.insert(channel.id);
      }
      channels_ = (*data)->messages();
      chunk.start = (*data)->start();
      chunk.end = (*data)->end();
    }
    chunk.first_channel = index_.chunk_channels.size();
    chunk.channels = static_cast<std::uint32_t>(channels_.size());
    for (const auto& [channel, messages] : channels_) {
      index_.chunk_channels.push_back(channel);
      index_.messages[channel] += messages;
      // Whatever is told of it nowhere belongs to others: no more chunks are read to learn of it.
      if (!index_.channels.contains(channel)) others_.insert(channel);
    }
    index_.chunks.push_back(chunk);
  }

  const InputFile& file_;
  FileWindow window_;
  const std::function<bool(double)>& progress_;
  std::uint64_t told_ = 0, told_work_ = 0;
  std::uint64_t work_ = 0;  // octets read and unpacked, besides the window's
  Bytes content_;
  FileIndex index_;
  std::set<std::uint16_t> others_;  // channels that are not ours
  // The chunk whose MessageIndex records are being read, and what they say.
  std::optional<ChunkPlace> chunk_;
  std::map<std::uint16_t, std::uint64_t> channels_;  // messages
  std::int64_t start_ = 0, end_ = 0;
};

}  // namespace

Result<FileIndex, RecordingError> search(const InputFile& file,
                                         const std::function<bool(double)>& progress) {
  return Search(file, progress).run();
}

}  // namespace skerry::recording
