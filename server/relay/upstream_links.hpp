// UpstreamLinks: the connections of an UpstreamTalk, on a thread of its own.
#pragma once

#include <memory>
#include <string>

#include "server/relay/host_lookup.hpp"
#include "server/relay/upstream_host.hpp"
#include "server/relay/upstream_place.hpp"

namespace skerry::server {

// Construct before the host's NetServer starts; start(); stop() before that stops.
// The host must outlive it.
class UpstreamLinks {
 public:
  // `token`: of the other server; empty: none.  `thin`: as UpstreamTalk has it.  `resolve`: as
  // HostLookup has it.
  UpstreamLinks(UpstreamHost& host, UpstreamPlace place, std::string token,
                std::optional<std::uint32_t> thin = 0,
                HostLookup::Resolve resolve = HostLookup::resolve_by_system);
  ~UpstreamLinks();
  UpstreamLinks(const UpstreamLinks&) = delete;
  UpstreamLinks& operator=(const UpstreamLinks&) = delete;

  void start();
  // At once, whatever is under way.
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skerry::server
