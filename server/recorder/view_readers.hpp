// ViewReaders: the views whose spokes a recording takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/core/radar_host.hpp"
#include "server/core/ring_reader.hpp"
#include "server/recorder/spoke_frame.hpp"

namespace skerry::server {

// View 0 of each radar, or all views that there are at the time: a reader goes with its view.
// Thread: the recorder's.
class ViewReaders {
 public:
  // Views of all radars in one file.  The file's descriptions of its views stay in memory until its
  // end.
  static constexpr std::size_t kMaxInFile = 10'000;

  struct Wanted {
    std::vector<std::uint32_t> radars;  // that the host has
    bool all_views = false;
    std::string format;  // of the rings; a view without it is passed over
  };
  // Told of a view; of one that is closed before its reader goes, with all that its ring holds.
  using Told = std::function<void(RingReader&)>;
  struct Changes {
    Told opened, closed;
    std::function<void(std::uint32_t radar, std::uint32_t view)> left_out;  // beyond kMaxInFile
  };

  // `host` must outlive it.  `wake` is called on the radars' threads.
  ViewReaders(RadarHost& host, Wanted wanted, std::function<void()> wake);

  // Readers for the views that were opened since the last call, none for those closed; costs
  // nothing where none was.
  void look(const Changes& changes);
  // Another file has the views that are there, and no others yet.
  void file_begins();

  auto begin() const { return readers_.begin(); }
  auto end() const { return readers_.end(); }

 private:
  void look_at(std::uint32_t radar, const Changes& changes);

  RadarHost& host_;
  const Wanted wanted_;
  const std::function<void()> wake_;
  std::vector<std::unique_ptr<RingReader>> readers_;
  std::uint64_t version_ = 0;  // of the host's views, as they were looked at
  std::size_t in_file_ = 0;
  bool is_full_ = false;  // one was left out
};

}  // namespace skerry::server
