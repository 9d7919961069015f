// The terminal's side of `skerry-coast` and `skerry-picture`: output and progress.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skerry::echo {

// The reader of our output went away (| head): time to end, and nothing to complain about.
struct ReaderGone {};

// After this, a closed pipe is an error of write_out() instead of a signal.
void watch_pipe();

// Writes to stdout at once.  Error: ReaderGone, or std::runtime_error for a full disk and the like.
void write_out(std::string_view text);

// Writes a file whole or not at all, as PartFile does.  Error: std::runtime_error naming the file
// and the reason.
void write_file(const std::filesystem::path& file, std::string_view text);

// Says on stderr how far something is, in place; nothing where stderr is not a terminal.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& text);
  void clear();  // before something else is printed

 private:
  bool terminal_;
  bool shown_ = false;
};

}  // namespace skerry::echo
