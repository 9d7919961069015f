// A folder that goes with its test, and bytes in and out of it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skerry::echo {

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes);
void write_text(const std::filesystem::path& file, std::string_view text);

// The NOAA cells; a test that needs one skips where it is absent.
std::filesystem::path enc_cell(std::string_view name);

// The text of the std::runtime_error that a call must throw; empty if it does not throw.
template <typename Call>
std::string complaint_of(Call&& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

}  // namespace skerry::echo
