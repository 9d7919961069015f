#include "server/relay/waiting_room.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "clients/common/asio.hpp"
#include "protocol/wire/frame.hpp"
#include "server/relay/radars_told.hpp"
#include "server/relayed/sendable_text.hpp"

namespace skerry::server {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::seconds kGuestPatience{2};
constexpr std::chrono::milliseconds kAcceptPause{100};  // where the system has no more sockets

std::shared_ptr<const Bytes> greeting_of(const wire::Hello& hello) {
  wire::ServerMessage message;
  *message.mutable_hello() = hello;
  auto bytes = std::make_shared<Bytes>();
  append_frame(*bytes, message);
  return bytes;
}

}  // namespace

class WaitingRoom::Impl {
 public:
  // Error: boost::system::system_error, the port cannot be had.
  Impl(const std::string& address, std::uint16_t port, const wire::Hello& hello)
      : acceptor_(io_, {asio::ip::make_address(address), port}),
        pause_(io_),
        greeting_(greeting_of(hello)) {
    accept();
    thread_ = std::thread([this] {
      pthread_setname_np(pthread_self(), "waiting");
      try {
        io_.run();
      } catch (const std::exception& error) {
        spdlog::critical("the thread that greets while a relay waits ends: {}", error.what());
        std::terminate();
      }
    });
  }
  ~Impl() {
    io_.stop();
    thread_.join();
  }

  void set_hello(const wire::Hello& hello) {
    asio::post(io_, [this, greeting = greeting_of(hello)] { greeting_ = greeting; });
  }

 private:
  struct Guest {
    explicit Guest(tcp::socket its, std::shared_ptr<const Bytes> what)
        : socket(std::move(its)), patience(socket.get_executor()), greeting(std::move(what)) {}
    tcp::socket socket;
    asio::steady_timer patience;
    std::shared_ptr<const Bytes> greeting;
    char said = 0;
  };

  void accept() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      if (error) {
        pause_.expires_after(kAcceptPause);
        return pause_.async_wait([this](const error_code&) { accept(); });
      }
      if (guests_ < kMost) greet(std::move(socket));
      accept();
    });
  }

  void greet(tcp::socket socket) {
    ++guests_;
    // Counted as long as an operation of its holds it.
    const std::shared_ptr<Guest> guest(new Guest(std::move(socket), greeting_),
                                       [this](Guest* each) {
                                         delete each;
                                         --guests_;
                                       });
    guest->patience.expires_after(kGuestPatience);
    guest->patience.async_wait([guest](const error_code&) {
      error_code ignored;
      guest->socket.close(ignored);
    });
    asio::async_write(guest->socket, asio::buffer(*guest->greeting),
                      [guest](const error_code& error, std::size_t) {
                        error_code ignored;
                        if (!error) guest->socket.shutdown(tcp::socket::shutdown_send, ignored);
                        await_end(guest);
                      });
  }

  // Closed with unread bytes, it would be reset, and the greeting lost.
  static void await_end(const std::shared_ptr<Guest>& guest) {
    guest->socket.async_read_some(asio::buffer(&guest->said, 1),
                                  [guest](const error_code& error, std::size_t) {
                                    if (!error) return await_end(guest);
                                    guest->patience.cancel();
                                  });
  }

  std::size_t guests_ = 0;  // first: their ends count, with those that the io_context ends
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  std::shared_ptr<const Bytes> greeting_;
  std::thread thread_;
};

WaitingRoom::WaitingRoom(const std::string& address, std::uint16_t port, wire::Hello hello)
    : hello_(std::move(hello)) {
  if (port == 0) return;
  try {
    impl_ = std::make_unique<Impl>(address, port, hello_);
  } catch (const boost::system::system_error& error) {
    // The server itself will tell why, once it is to serve.
    spdlog::debug("relay: nobody is greeted while it waits: {}", error.what());
  }
}

WaitingRoom::~WaitingRoom() = default;

bool WaitingRoom::is_open() const { return impl_ != nullptr; }

void WaitingRoom::set_before(const wire::Hello* before) {
  if (impl_ == nullptr) return;
  wire::Hello hello = hello_;
  if (before != nullptr) {
    wire::Hop& nearest = *hello.add_relays();
    nearest.set_identity(sendable(before->identity(), 64));
    nearest.set_server(sendable(before->server(), 64));
    for (int i = 0; i < before->relays_size() && i + 1 < kMostHops; ++i) {
      wire::Hop& further = *hello.add_relays();
      further.set_identity(sendable(before->relays(i).identity(), 64));
      further.set_server(sendable(before->relays(i).server(), 64));
    }
  }
  impl_->set_hello(hello);
}

}  // namespace skerry::server
