// DayLog: what the instruments of an own ship say, and beside it the truth.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/navigation/navigation_talker.hpp"
#include "server/world/world.hpp"

namespace skerry::system_test {

// Two files, compressed while they are written:
//   NAME.nmea.gz   every line with a TAG block, "\c:milliseconds since 1970*hh\$GPRMC,...*hh"
//   NAME.truth.gz  a line of JSON about what does not change; the columns' names; a row a tick, in
//                  SI units and degrees, as the world has it and before anything is told of it
// Thread: one at a time.
class DayLog {
 public:
  // Error: std::runtime_error, if the files cannot be made.
  DayLog(const std::string& folder, const std::string& name, const server::World& world);

  // What is due at the world's present tick, which is at `utc`.
  void write(const server::World& world, UtcTime utc);
  // All is on the disk.  Error: std::runtime_error, if it is not.
  void close();

  std::size_t lines() const { return lines_; }
  std::size_t bytes() const { return bytes_; }  // of both files, before they were compressed

 private:
  struct Close {
    void operator()(std::FILE* pipe) const { ::pclose(pipe); }
  };
  using Pipe = std::unique_ptr<std::FILE, Close>;
  static Pipe open(const std::string& path);
  void put(const Pipe& pipe, const std::string& text);

  Pipe nmea_, truth_;
  server::NavigationTalker talker_;
  std::size_t lines_ = 0, bytes_ = 0;
};

}  // namespace skerry::system_test
