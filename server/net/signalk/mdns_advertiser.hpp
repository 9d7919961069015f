// MdnsAdvertiser: tells the network by mDNS what is served here, through the system's Avahi.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace skerry::server {

struct MdnsService {
  std::string type;  // "_signalk-http._tcp"
  std::uint16_t port = 0;
  std::vector<std::string> texts = {};  // "key=value"
};

// Everything happens on its own thread, "mdns": a host without Avahi, or one whose Avahi comes and
// goes, costs a look every kRetry and nothing else.  A name that somebody else has gets a number.
class MdnsAdvertiser {
 public:
  // `address` is what the server is bound to: an address of one interface confines it to that.
  MdnsAdvertiser(std::string name, const std::string& address, std::vector<MdnsService> services);
  ~MdnsAdvertiser();  // takes everything back
  MdnsAdvertiser(const MdnsAdvertiser&) = delete;
  MdnsAdvertiser& operator=(const MdnsAdvertiser&) = delete;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skerry::server
