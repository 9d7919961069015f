#include "server/net/native/board_requests.hpp"

#include <fmt/format.h>

#include <utility>

#include "server/core/board_port.hpp"

namespace skerry::server {
namespace {

wire::Reply refusal(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return reply;
}

BoardRequests::Answer no_board(std::uint32_t radar) {
  return {std::nullopt,
          refusal(wire::Reply::UNKNOWN,
                  fmt::format("no interface board of a radar {}; Hello lists the radars and which "
                              "have one",
                              radar))};
}

}  // namespace

BoardRequests::Answer BoardRequests::access(const wire::BoardAccess& access) {
  const BoardPortPtr board = context_.host.find_board(access.radar());
  if (!board) return no_board(access.radar());
  if (access.operations_size() > kMaxOperations) {
    return {std::nullopt, refusal(wire::Reply::OUT_OF_RANGE,
                                  fmt::format("operations: {} of them; allowed: at most {}",
                                              access.operations_size(), kMaxOperations))};
  }
  Answer answer;
  *answer.first.emplace().mutable_board() = board->access(access);
  return answer;
}

BoardRequests::Answer BoardRequests::stream(const wire::BoardStream& stream) {
  if (!context_.host.find_board(stream.radar())) return no_board(stream.radar());
  switch (stream.kind()) {
    case wire::BoardStream::NONE:
      end_stream();
      return {};
    case wire::BoardStream::RECORDS:
    case wire::BoardStream::SIGNALS:
      break;
    default:
      return {std::nullopt,
              refusal(wire::Reply::OUT_OF_RANGE,
                      fmt::format("kind: {} is none; allowed: NONE, RECORDS and SIGNALS",
                                  static_cast<int>(stream.kind())))};
  }
  end_stream();
  radar_ = stream.radar();
  feed_ = context_.find_board_feed(
      radar_, stream.kind() == wire::BoardStream::RECORDS ? kRecordsFormat : kSignalsFormat);
  cursor_ = feed_->add(reader_);
  return {};
}

BoardRequests::Answer BoardRequests::read_fifo(const wire::BoardFifo& fifo) {
  const BoardPortPtr board = context_.host.find_board(fifo.radar());
  if (!board) return no_board(fifo.radar());
  if (fifo.count() < 1 || fifo.count() > kMaxSweeps) {
    return {std::nullopt,
            refusal(wire::Reply::OUT_OF_RANGE,
                    fmt::format("count: {}; allowed: 1 to {}", fifo.count(), kMaxSweeps))};
  }
  Answer answer;
  *answer.first.emplace().mutable_board_records() = board->read_fifo(fifo.count());
  return answer;
}

BoardRequests::Answer BoardRequests::open_ring(const wire::BoardRing& ring) {
  const BoardPortPtr board = context_.host.find_board(ring.radar());
  if (!board) return no_board(ring.radar());
  auto given = board->open_ring();
  if (!given) return {std::nullopt, refusal(wire::Reply::REFUSED, given.error())};
  lease_ = std::move(given->lease);
  Answer answer;
  *answer.first.emplace().mutable_board() = std::move(given->reply);
  return answer;
}

void BoardRequests::end_stream() {
  if (feed_ == nullptr) return;
  feed_->remove(reader_);
  feed_ = nullptr;
  lost_before_ += cursor_.spokes_lost;
  cursor_ = {};
}

void BoardRequests::leave() {
  end_stream();
  lease_.reset();
}

std::size_t BoardRequests::send_buffer() const {
  return feed_ == nullptr ? 0 : context_.board_send_buffer_for(radar_);
}

}  // namespace skerry::server
