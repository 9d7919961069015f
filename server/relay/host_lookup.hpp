// HostLookup: the addresses of a host's name, without ever waiting for a name server that is dead.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clients/common/asio.hpp"

namespace skerry::server {

// What a name server says of a name: at least one address, or the error.
struct HostAddresses {
  boost::system::error_code error;
  std::vector<boost::asio::ip::tcp::endpoint> places;
};

// The system's own look-up (getaddrinfo) cannot be ended and takes up to tens of seconds where no
// name server answers.  So it runs on a thread that nobody waits for, which owns all that it needs;
// the end of a HostLookup forgets it.  One look-up runs at a time: who asks meanwhile has its
// answer.  An address needs no thread.
// Thread: that of the io_context, for all calls and answers.
class HostLookup {
 public:
  using Resolve = std::function<HostAddresses(const std::string& name, std::uint16_t port)>;
  using Done = std::function<void(const HostAddresses& found)>;

  // Of one server.  `resolve`: any thread, also after the end of this; may take any time.
  HostLookup(boost::asio::io_context& io, std::string name, std::uint16_t port,
             Resolve resolve = resolve_by_system);
  // Who still waits is not answered.
  ~HostLookup();
  HostLookup(const HostLookup&) = delete;
  HostLookup& operator=(const HostLookup&) = delete;

  // `done` is called later, from the io_context.
  void find(Done done);

  static HostAddresses resolve_by_system(const std::string& name, std::uint16_t port);

 private:
  struct Shared;
  boost::asio::io_context& io_;
  const std::string name_;
  const std::uint16_t port_;
  const Resolve resolve_;
  std::shared_ptr<Shared> shared_;
};

// The same for who can wait: until the answer is there, `time` is over or `pause`, which waits so
// long or less, says that it is to be given up.  Error: timed_out, operation_aborted.
HostAddresses find_host(const std::string& name, std::uint16_t port, std::chrono::milliseconds time,
                        const std::function<bool(std::chrono::milliseconds)>& pause,
                        HostLookup::Resolve resolve = HostLookup::resolve_by_system);

}  // namespace skerry::server
