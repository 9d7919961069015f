// Properties of any stream of frames of messages, whoever sends them.
#pragma once

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/stubs/logging.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/wire/frame.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace skerry::fuzz {

// The bodies a reader gave, and the error that ended the stream, if one did.
struct Frames {
  std::vector<Bytes> bodies;
  std::optional<WireError> error;
};

// Feeds `stream` in the pieces that `piece_size()` says.
template <typename PieceSize>
Frames read_frames(std::span<const std::uint8_t> stream, std::size_t max_frame,
                   PieceSize&& piece_size) {
  FrameReader reader(max_frame);
  Frames frames;
  while (!stream.empty()) {
    const std::size_t piece = std::min<std::size_t>(piece_size(), stream.size());
    reader.feed(stream.first(piece));
    stream = stream.subspan(piece);
    for (;;) {
      const auto next = reader.next();
      if (!next.ok()) {
        frames.error = next.error();
        return frames;
      }
      if (!next->has_value()) break;
      require((*next)->size() <= max_frame, "no body is longer than allowed");
      frames.bodies.emplace_back((*next)->begin(), (*next)->end());
    }
    require(reader.pending() <= max_frame + 5, "at most one unfinished frame is held");
  }
  return frames;
}

// Serialised with maps in order, so that equal messages give equal bytes.
inline std::string canonical(const google::protobuf::MessageLite& message) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream out(&stream);
    out.SetSerializationDeterministic(true);
    message.SerializeToCodedStream(&out);
  }
  return bytes;
}

// Reads `stream` in two ways, which must agree; parses each body as a Message, which must come back
// from a frame of its own; and calls `check` with each message.
template <typename Message, typename Check>
void check_stream(std::span<const std::uint8_t> stream, std::size_t max_frame, Check&& check) {
  google::protobuf::SetLogHandler(nullptr);  // it logs each string that is not UTF-8
  Choices choices(stream);
  const Frames at_once = read_frames(stream, max_frame, [&] { return stream.size(); });
  const Frames cut = read_frames(stream, max_frame, [&] { return 1 + choices.below(300); });
  require(at_once.bodies == cut.bodies, "cuts do not change the frames");
  require(at_once.error.has_value() == cut.error.has_value(), "cuts do not change the outcome");
  if (at_once.error) {
    require(at_once.error->kind == cut.error->kind && at_once.error->offset == cut.error->offset,
            "cuts do not change the error");
  }
  for (const Bytes& body : at_once.bodies) {
    Message message;
    if (!message.ParseFromArray(body.data(), static_cast<int>(body.size()))) continue;
    Bytes frame;
    append_frame(frame, message);
    const auto again = frame_body(frame);
    Message back;
    require(back.ParseFromArray(again.data(), static_cast<int>(again.size())),
            "a message that was read can be written and read");
    require(canonical(back) == canonical(message), "it comes back the same");
    check(message);
  }
}

}  // namespace skerry::fuzz
