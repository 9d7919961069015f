#include "clients/board/board_client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <utility>

#include "clients/board/board_reading.hpp"
#include "clients/board/shared_ring.hpp"
#include "clients/common/message_stream.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using NextRecord = ClientResult<std::optional<board::DecodedRecord>>;

// How often a reader of shared memory looks whether the server is still there.
constexpr std::chrono::milliseconds kLookAfterServer{50};
// Messages taken at each look: a server may send more than anybody reads.
constexpr int kMostPerLook = 64;
// Memory of a waiting message beyond its bytes.
constexpr std::size_t kWaitingOverhead = 64;

}  // namespace

class BoardClient::Connection {
 public:
  Connection(const std::string& host, std::uint16_t port, std::string token)
      : stream_(host, port), token_(std::move(token)) {}

  ClientResult<Done> open(const std::string& host, std::uint16_t port, std::uint32_t radar,
                          Duration timeout);
  ClientResult<std::vector<Value>> access(const std::vector<Operation>& operations,
                                          Duration timeout);
  ClientResult<Done> stream(BoardStreamKind kind, Deadline deadline);
  ClientResult<Done> map_ring(Deadline deadline);
  NextRecord next(Deadline deadline);
  ClientResult<std::vector<board::Sweep>> read_fifo(std::uint32_t count, Deadline deadline);

  const wire::Hello& hello() const { return hello_; }
  const wire::RadarInfo& radar() const { return radar_; }
  const std::string& name() const { return stream_.name(); }
  std::uint64_t records_lost() const { return records_lost_; }

 private:
  // The answer that came before the OK reply to its request.
  struct Answer {
    std::optional<wire::BoardReply> reply;
    std::optional<wire::BoardRecords> records;
  };
  ClientResult<Answer> ask(wire::ClientMessage& message, const char* kind, Deadline deadline);
  void keep(std::string records);
  void drop_first();
  void begin_stream();
  NextRecord next_waiting();
  NextRecord next_of_ring(Deadline deadline);
  NextRecord decode(std::span<const std::uint8_t> bytes);
  Failure<ClientError> malformed(const std::string& text) {
    return stream_.end(ClientErrorKind::malformed, fmt::format("{} {}", name(), text));
  }
  Failure<ClientError> bad_record(const WireError& error) {
    return malformed(fmt::format("sent a bad record: {} at byte {}, {}", name_of(error.kind),
                                 error.offset, printable(error.text)));
  }

  MessageStream stream_;
  std::string token_;
  wire::Hello hello_;
  wire::RadarInfo radar_;
  std::uint32_t request_ = 0;

  BoardStreamKind kind_ = BoardStreamKind::none;
  std::deque<std::string> waiting_;  // records, message by message
  std::size_t waiting_bytes_ = 0;
  std::size_t taken_ = 0;  // bytes of the first of them
  std::optional<std::uint64_t> expected_;
  std::uint64_t records_lost_ = 0;

  std::optional<SharedRing> ring_;
  Bytes ring_record_;
  Deadline looked_after_server_{};
};

ClientResult<Done> BoardClient::Connection::open(const std::string& host, std::uint16_t port,
                                                 std::uint32_t radar, Duration timeout) {
  auto hello = stream_.open(host, port, timeout);
  if (!hello) return Failure{hello.error()};
  hello_ = std::move(hello).value();
  std::string known;
  for (const auto& info : hello_.radars()) {
    if (info.radar() == radar && info.board()) {
      radar_ = info;
      return Done{};
    }
    if (info.board()) known += fmt::format("{}{}", known.empty() ? "" : ", ", info.radar());
  }
  if (known.empty()) {
    return failure(ClientErrorKind::rejected,
                   fmt::format("no radar of {} has an interface board", name()));
  }
  return failure(ClientErrorKind::rejected,
                 fmt::format("radar {} of {} has no interface board; those of radars {} there are",
                             radar, name(), known));
}

// While the answer to a request is awaited, records of the stream are kept; those right before the
// reply are the answer if the request was for records.
ClientResult<BoardClient::Connection::Answer> BoardClient::Connection::ask(
    wire::ClientMessage& message, const char* kind, Deadline deadline) {
  message.set_request(++request_);
  if (auto sent = stream_.send(message, deadline); !sent) return Failure{sent.error()};
  Answer answer;
  const auto keep_held = [&] {
    if (answer.records) keep(std::move(*answer.records->mutable_records()));
    answer.records.reset();
  };
  for (;;) {
    auto received = stream_.next(deadline);
    if (!received) return Failure{received.error()};
    if (!*received) {
      keep_held();
      return stream_.no_answer(kind);
    }
    wire::ServerMessage& came = **received;
    if (came.has_board_records()) {
      keep_held();
      answer.records = std::move(*came.mutable_board_records());
    } else if (came.has_board()) {
      answer.reply = std::move(*came.mutable_board());
    } else if (came.has_reply() && came.reply().request() == message.request()) {
      if (came.reply().code() != wire::Reply::OK) {
        keep_held();
        return stream_.rejected(came.reply());
      }
      if (!message.has_board_fifo()) keep_held();
      return answer;
    }
    if (is_past(deadline)) {
      keep_held();
      return stream_.no_answer(kind);
    }
  }
}

void BoardClient::Connection::keep(std::string records) {
  // Late ones of a stream that has ended, or none at all.
  if (kind_ == BoardStreamKind::none || records.empty()) return;
  waiting_bytes_ += records.size() + kWaitingOverhead;
  waiting_.push_back(std::move(records));
  while (waiting_bytes_ > kMaxWaitingBytes && waiting_.size() > 1) {
    drop_first();
  }
}

void BoardClient::Connection::drop_first() {
  waiting_bytes_ -= waiting_.front().size() + kWaitingOverhead;
  waiting_.pop_front();
  taken_ = 0;
}

void BoardClient::Connection::begin_stream() {
  waiting_.clear();
  waiting_bytes_ = taken_ = 0;
  expected_.reset();
  records_lost_ = 0;
}

ClientResult<std::vector<BoardClient::Value>> BoardClient::Connection::access(
    const std::vector<Operation>& operations, Duration timeout) {
  if (operations.empty()) return std::vector<Value>{};
  if (operations.size() > kMaxOperations) {
    return failure(ClientErrorKind::rejected,
                   fmt::format("{} accesses at once; at most {} are allowed", operations.size(),
                               kMaxOperations));
  }
  wire::ClientMessage message;
  auto* const request = message.mutable_board_access();
  request->set_radar(radar_.radar());
  request->set_token(token_);
  for (const Operation& operation : operations) {
    auto* const added = request->add_operations();
    added->set_address(operation.address);
    if (operation.write) added->set_write(*operation.write);
  }
  auto answer = ask(message, "register", deadline_after(timeout));
  if (!answer) return Failure{answer.error()};
  const auto& reply = answer->reply;
  if (!reply || static_cast<std::size_t>(reply->results_size()) != operations.size()) {
    return malformed(fmt::format("answered {} register accesses with {} results", operations.size(),
                                 reply ? reply->results_size() : 0));
  }
  std::vector<Value> values;
  for (const auto& result : reply->results()) {
    values.push_back({error_of(result.error()), result.value()});
  }
  return values;
}

ClientResult<Done> BoardClient::Connection::stream(BoardStreamKind kind, Deadline deadline) {
  wire::ClientMessage message;
  auto* const request = message.mutable_board_stream();
  request->set_radar(radar_.radar());
  request->set_token(token_);
  request->set_kind(kind == BoardStreamKind::records   ? wire::BoardStream::RECORDS
                    : kind == BoardStreamKind::signals ? wire::BoardStream::SIGNALS
                                                       : wire::BoardStream::NONE);
  if (auto answer = ask(message, "stream", deadline); !answer) return Failure{answer.error()};
  kind_ = kind;
  ring_.reset();
  begin_stream();
  return Done{};
}

ClientResult<Done> BoardClient::Connection::map_ring(Deadline deadline) {
  if (!stream_.is_local()) {
    return failure(
        ClientErrorKind::rejected,
        fmt::format("{} is another host: its memory cannot be shared; stream over TCP", name()));
  }
  wire::ClientMessage message;
  message.mutable_board_ring()->set_radar(radar_.radar());
  message.mutable_board_ring()->set_token(token_);
  auto answer = ask(message, "shared memory", deadline);
  if (!answer) return Failure{answer.error()};
  if (!answer->reply) return malformed("granted shared memory without naming it");
  auto ring = SharedRing::open(answer->reply->ring_name(), answer->reply->ring_bytes());
  if (!ring) {
    return failure(ring.error().kind, fmt::format("{}: {}", name(), printable(ring.error().text)));
  }
  if (kind_ != BoardStreamKind::none) {
    if (auto ended = stream(BoardStreamKind::none, deadline); !ended) return ended;
  }
  ring_ = std::move(ring).value();
  begin_stream();
  return Done{};
}

// Empty for a record of a kind that does not exist yet: readers skip it, as BOARD.md says.
NextRecord BoardClient::Connection::decode(std::span<const std::uint8_t> bytes) {
  const auto prefix = board::record_prefix(bytes);
  auto record = board::decode_record(bytes);
  if (!record && (!prefix || record.error().kind != WireErrorKind::unknown_kind)) {
    return bad_record(record.error());
  }
  if (expected_ && prefix->sequence > *expected_) records_lost_ += prefix->sequence - *expected_;
  expected_ = prefix->sequence + 1;
  if (!record) return std::optional<board::DecodedRecord>{};
  return std::optional(std::move(record).value());
}

NextRecord BoardClient::Connection::next_waiting() {
  while (!waiting_.empty()) {
    const std::string& front = waiting_.front();
    if (taken_ < front.size()) {
      const std::span all(reinterpret_cast<const std::uint8_t*>(front.data()), front.size());
      const auto bytes = all.subspan(taken_);
      auto record = decode(bytes);
      if (!record) return record;
      taken_ += board::record_prefix(bytes)->size;
      if (*record) return record;
      continue;
    }
    drop_first();
  }
  return std::optional<board::DecodedRecord>{};
}

NextRecord BoardClient::Connection::next_of_ring(Deadline deadline) {
  using State = board::SweepRingReader::State;
  for (;;) {
    const State state = ring_->reader().take(ring_record_);
    if (state == State::record) {
      auto record = decode(ring_record_);
      if (!record || *record || is_past(deadline)) return record;
      continue;
    }
    if (state == State::closed) {
      return stream_.end(ClientErrorKind::closed,
                         fmt::format("{} closed its ring in shared memory", name()));
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_after_server_ >= kLookAfterServer) {
      looked_after_server_ = now;
      for (int i = 0; i < kMostPerLook; ++i) {
        const auto message = stream_.next(now);
        if (!message) return Failure{message.error()};
        if (!*message) break;
      }
    }
    if (now >= deadline) return std::optional<board::DecodedRecord>{};
    ring_->reader().wait(std::min<Duration>(deadline - now, kLookAfterServer));
  }
}

NextRecord BoardClient::Connection::next(Deadline deadline) {
  if (ring_) {
    auto record = next_of_ring(deadline);
    if (!record) ring_.reset();  // the connection has the error for later calls
    return record;
  }
  for (bool looked = false;; looked = true) {
    auto record = next_waiting();
    if (!record || *record || (looked && is_past(deadline))) return record;
    auto message = stream_.next(deadline);
    if (!message) return Failure{message.error()};
    if (!*message) return record;
    if ((*message)->has_board_records()) {
      keep(std::move(*(*message)->mutable_board_records()->mutable_records()));
    }
  }
}

ClientResult<std::vector<board::Sweep>> BoardClient::Connection::read_fifo(std::uint32_t count,
                                                                           Deadline deadline) {
  if (count == 0) return std::vector<board::Sweep>{};
  if (count > kMaxFifoSweeps) {
    return failure(ClientErrorKind::rejected,
                   fmt::format("{} sweeps of the FIFO at once; at most {} are allowed", count,
                               kMaxFifoSweeps));
  }
  wire::ClientMessage message;
  auto* const request = message.mutable_board_fifo();
  request->set_radar(radar_.radar());
  request->set_count(count);
  request->set_token(token_);
  auto answer = ask(message, "FIFO", deadline);
  if (!answer) return Failure{answer.error()};
  if (!answer->records) return malformed("granted sweeps of the FIFO without sending them");
  const std::string& text = answer->records->records();
  std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  std::vector<board::Sweep> sweeps;
  while (!bytes.empty()) {
    auto record = board::decode_record(bytes);
    if (!record) return bad_record(record.error());
    auto* const sweep = std::get_if<board::Sweep>(&record->record);
    if (!sweep || sweeps.size() == count) {
      return malformed(fmt::format("sent what is not at most {} sweeps of the FIFO", count));
    }
    sweeps.push_back(std::move(*sweep));
    bytes = bytes.subspan(record->size);
  }
  return sweeps;
}

ClientResult<BoardClient> BoardClient::connect(const std::string& host, std::uint16_t port,
                                               std::uint32_t radar, Duration timeout,
                                               const std::string& token) {
  auto connection = std::make_unique<Connection>(host, port, token);
  if (auto opened = connection->open(host, port, radar, timeout); !opened) {
    return Failure{opened.error()};
  }
  return BoardClient(std::move(connection));
}

BoardClient::BoardClient(std::unique_ptr<Connection> connection)
    : connection_(std::move(connection)) {}
BoardClient::BoardClient(BoardClient&&) noexcept = default;
BoardClient& BoardClient::operator=(BoardClient&&) noexcept = default;
BoardClient::~BoardClient() = default;

const wire::Hello& BoardClient::hello() const { return connection_->hello(); }
const wire::RadarInfo& BoardClient::radar() const { return connection_->radar(); }
const std::string& BoardClient::name() const { return connection_->name(); }
std::uint64_t BoardClient::records_lost() const { return connection_->records_lost(); }

ClientResult<std::vector<BoardClient::Value>> BoardClient::access(
    const std::vector<Operation>& operations, Duration timeout) {
  return connection_->access(operations, timeout);
}
ClientResult<Done> BoardClient::stream(BoardStreamKind kind, Duration timeout) {
  return connection_->stream(kind, deadline_after(timeout));
}
ClientResult<Done> BoardClient::map_ring(Duration timeout) {
  return connection_->map_ring(deadline_after(timeout));
}
NextRecord BoardClient::next(Duration timeout) {
  return connection_->next(deadline_after(timeout));
}
ClientResult<std::vector<board::Sweep>> BoardClient::read_fifo(std::uint32_t count,
                                                               Duration timeout) {
  return connection_->read_fifo(count, deadline_after(timeout));
}

}  // namespace skerry::client
