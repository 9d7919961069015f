#include "clients/common/message_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/wire/host_and_port.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

namespace asio = boost::asio;

constexpr std::uint32_t kProtocolVersion = 1;

constexpr auto kLongestTimeout = std::chrono::hours(24 * 365);

Failure<ClientError> connect_failure(const std::string& name,
                                     const boost::system::error_code& error) {
  if (error == asio::error::connection_refused) {
    return failure(ClientErrorKind::refused, fmt::format("{} refused the connection", name));
  }
  return failure(ClientErrorKind::unreachable,
                 fmt::format("cannot connect to {}: {}", name, printable(error.message())));
}

}  // namespace

Deadline deadline_after(Duration timeout) {
  return std::chrono::steady_clock::now() + std::clamp<Duration>(timeout, {}, kLongestTimeout);
}

bool is_past(Deadline deadline) { return std::chrono::steady_clock::now() >= deadline; }

MessageStream::MessageStream(const std::string& host, std::uint16_t port)
    : name_(host_and_port(printable(HostName(host).name), port)) {}

bool MessageStream::run_until(Deadline deadline, const bool& done) {
  while (!done) {
    io_.restart();
    // One turn may do nothing but take an old readiness off the reactor, hence the loop;
    // run_one_until() does not even look once the deadline has passed, poll_one() does.
    if (io_.run_one_until(deadline) == 0 && io_.poll_one() == 0) break;
  }
  return done;
}

Failure<ClientError> MessageStream::end(ClientErrorKind kind, std::string text) {
  failure_ = ClientError{kind, std::move(text)};
  socket_.close();
  io_.restart();
  io_.poll();
  return Failure{*failure_};
}

Failure<ClientError> MessageStream::end_of_stream(const error_code& error) {
  std::string text = fmt::format("{} closed the connection", name_);
  if (error != asio::error::eof) text += fmt::format(" ({})", printable(socket_.in_words(error)));
  if (!complaint_.empty()) text += fmt::format("; the server said: {}", complaint_);
  return end(ClientErrorKind::closed, std::move(text));
}

ClientResult<Done> MessageStream::connect(const std::string& host, std::uint16_t port,
                                          Deadline deadline) {
  const HostName name(host);
  bool done = false;
  error_code error;
  tcp::resolver resolver(io_);
  tcp::resolver::results_type places;
  resolver.async_resolve(name.name, std::to_string(port), tcp::resolver::numeric_service,
                         [&](const error_code& e, tcp::resolver::results_type found) {
                           error = e;
                           places = std::move(found);
                           done = true;
                         });
  const auto timed_out = [&] {
    return failure(ClientErrorKind::timed_out,
                   fmt::format("connecting to {} took too long", name_));
  };
  if (!run_until(deadline, done)) {
    resolver.cancel();
    run_until(Deadline::max(), done);
    return timed_out();
  }
  if (error) return connect_failure(name_, error);

  done = false;
  asio::async_connect(socket_.tcp_socket(), places, [&](const error_code& e, const tcp::endpoint&) {
    error = e;
    done = true;
  });
  if (!run_until(deadline, done)) {
    socket_.close();
    run_until(Deadline::max(), done);
    return timed_out();
  }
  if (error) return connect_failure(name_, error);
  error_code ignored;
  socket_.tcp_socket().set_option(tcp::no_delay(true), ignored);
  return name.secure ? secure(name, deadline) : Done{};
}

ClientResult<Done> MessageStream::secure(const HostName& host, Deadline deadline) {
  if (const std::string fault = socket_.begin_tls(host); !fault.empty()) {
    return failure(ClientErrorKind::unreachable, fault);
  }
  bool done = false;
  error_code error;
  socket_.async_handshake([&](const error_code& e) {
    error = e;
    done = true;
  });
  if (!run_until(deadline, done)) {
    socket_.close();
    run_until(Deadline::max(), done);
    return failure(ClientErrorKind::timed_out,
                   fmt::format("{} did not answer by TLS in time; has it a certificate (skerryd "
                               "--tls)?  On its own host it is plain",
                               name_));
  }
  if (!error) return Done{};
  return failure(
      ClientErrorKind::unreachable,
      fmt::format("no TLS with {}: {}", name_, printable(socket_.handshake_fault(error))));
}

ClientResult<wire::Hello> MessageStream::open(const std::string& host, std::uint16_t port,
                                              Duration timeout) {
  const Deadline deadline = deadline_after(timeout);
  if (auto connected = connect(host, port, deadline); !connected) {
    return Failure{connected.error()};
  }
  auto first = next(deadline);
  if (!first) return Failure{first.error()};
  if (!*first) {
    return failure(
        ClientErrorKind::timed_out,
        fmt::format("{} accepted the connection but sent no Hello within {:.1f} s; is "
                    "that the native port (usually {}), and does it want TLS (tls://HOST)?",
                    name_, in_seconds(timeout), kDefaultTcpPort));
  }
  if ((*first)->has_reply()) return rejected((*first)->reply());
  if (!(*first)->has_hello()) {
    return failure(ClientErrorKind::malformed,
                   fmt::format("{} did not begin with a Hello: not a Skerry server", name_));
  }
  const wire::Hello& hello = (*first)->hello();
  if (hello.protocol_version() != kProtocolVersion) {
    return failure(ClientErrorKind::malformed,
                   fmt::format("{} speaks version {} of the native protocol, expected {}", name_,
                               hello.protocol_version(), kProtocolVersion));
  }
  return hello;
}

bool MessageStream::is_local() const {
  error_code no_near, no_far;
  const auto near = socket_.tcp_socket().local_endpoint(no_near),
             far = socket_.tcp_socket().remote_endpoint(no_far);
  return !no_near && !no_far && near.address() == far.address();
}

Failure<ClientError> MessageStream::no_answer(const char* kind) const {
  return failure(ClientErrorKind::timed_out,
                 fmt::format("{} did not answer the {} request in time", name_, kind));
}

Failure<ClientError> MessageStream::rejected(const wire::Reply& reply) const {
  return Failure{ClientError{
      ClientErrorKind::rejected,
      fmt::format("{} rejected the request: {}", name_, printable(reply.text())), reply.code()}};
}

void MessageStream::start_read() {
  reading_ = true;
  read_done_ = false;
  socket_.async_read_some(asio::buffer(buffer_), [this](const error_code& error, std::size_t size) {
    read_error_ = error;
    read_size_ = size;
    read_done_ = true;
  });
}

ClientResult<std::optional<wire::ServerMessage>> MessageStream::parse(
    std::span<const std::uint8_t> body) {
  wire::ServerMessage message;
  if (!message.ParseFromArray(body.data(), static_cast<int>(body.size()))) {
    return end(
        ClientErrorKind::malformed,
        fmt::format("{} sent a frame of {} bytes that is no ServerMessage", name_, body.size()));
  }
  if (message.has_reply() && message.reply().code() != wire::Reply::OK) {
    complaint_ = printable(message.reply().text());
  }
  return std::optional(std::move(message));
}

ClientResult<std::optional<wire::ServerMessage>> MessageStream::next(Deadline deadline) {
  if (failure_) return Failure{*failure_};
  for (;;) {
    const auto body = frames_.next();
    if (!body) {
      return end(ClientErrorKind::malformed,
                 fmt::format("{} sent what is not the native protocol: {} at byte {} ({})", name_,
                             name_of(body.error().kind), body.error().offset,
                             printable(body.error().text)));
    }
    if (*body) return parse(**body);
    if (!reading_) start_read();
    if (!run_until(deadline, read_done_)) return std::optional<wire::ServerMessage>{};
    reading_ = false;
    if (read_error_) return end_of_stream(read_error_);
    frames_.feed(std::span(buffer_).first(read_size_));
  }
}

ClientResult<Done> MessageStream::send(const wire::ClientMessage& message, Deadline deadline) {
  if (failure_) return Failure{*failure_};
  Bytes bytes;
  append_frame(bytes, message);
  bool done = false;
  error_code error;
  socket_.async_write(asio::buffer(bytes), [&](const error_code& e, std::size_t) {
    error = e;
    done = true;
  });
  if (!run_until(deadline, done)) {
    return end(ClientErrorKind::timed_out, fmt::format("{} takes no more requests", name_));
  }
  while (error) {  // the server has gone; what it said last says why
    const auto last = next(deadline);
    if (!last) return Failure{last.error()};
    if (!*last || is_past(deadline)) return end_of_stream(error);
  }
  return Done{};
}

}  // namespace skerry::client
