#include "server/setups/setup_shelf.hpp"

#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "protocol/digest/digest.hpp"
#include "server/config/config_error.hpp"
#include "server/config/whole_file.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using google::protobuf::Struct;
using google::protobuf::util::JsonStringToMessage;

constexpr std::string_view kKind = "skerry set-up";  // clients/web/src/panel/setup_store.js
constexpr mode_t kMode = 0644;

std::string text_of(const Struct& object, const char* key) {
  const auto found = object.fields().find(key);
  return found == object.fields().end() ? std::string() : found->second.string_value();
}

// Empty if it is one.
std::string why_no_name(std::string_view name) {
  const std::size_t most = SetupShelf::kMostNameBytes;
  if (!name.empty() && name.size() <= most && printable(name, most) == name) return {};
  return fmt::format("a set-up's name is 1 to {} bytes of printable text", most);
}

struct Read {
  std::string name = {};
  std::string wrong = {};  // empty: it is a set-up
};

Read read_setup(const std::string& document) {
  Struct object;
  const auto read = JsonStringToMessage(document, &object);
  if (!read.ok()) return {.wrong = "no set-up: not a JSON object: " + read.ToString()};
  if (text_of(object, "kind") != kKind) {
    return {.wrong = fmt::format("no set-up: its \"kind\" is to be \"{}\"", kKind)};
  }
  const auto parts = object.fields().find("parts");
  if (parts == object.fields().end() || !parts->second.has_struct_value()) {
    return {.wrong = "no set-up: its \"parts\" are to be an object"};
  }
  Read setup{.name = text_of(object, "name")};
  setup.wrong = why_no_name(setup.name);
  return setup;
}

// Readable where the name is, and another for every name.
fs::path file_name_of(const std::string& name) {
  constexpr std::size_t kReadable = 40, kDigits = 16;
  std::string readable;
  for (const char c : name) {
    if (readable.size() == kReadable) break;
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    readable += plain ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '-';
  }
  Sha256 digest;
  digest.add(name);
  return fmt::format("{}-{}.json", readable, hexadecimal(digest.take()).substr(0, kDigits));
}

}  // namespace

SetupShelf::SetupShelf(Config config) : config_(std::move(config)) {
  read_folder();
  disk_ = std::thread([this] { run_disk(); });
}

SetupShelf::~SetupShelf() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  change_.notify_one();
  disk_.join();
}

void SetupShelf::run_disk() {
  std::unique_lock lock(mutex_);
  while (true) {
    change_.wait(lock, [this] { return ends_ || !writes_.empty(); });
    if (writes_.empty()) return;
    Task write = std::move(writes_.front());
    writes_.pop_front();
    lock.unlock();
    write();
    lock.lock();
  }
}

void SetupShelf::read_folder() {
  const fs::path& folder = config_.folder;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder) || ::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) {
    throw std::runtime_error(fmt::format(
        "--setups: {} cannot be made, read or written to; expected a folder of this user's",
        folder.string()));
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".json" || !entry.is_regular_file()) continue;
    const auto leave = [&](const std::string& why) {
      spdlog::warn("set-ups: {} is left alone: {}", file.string(), why);
    };
    if (kept_.size() == kMost) {
      leave(fmt::format("more than {} set-ups", kMost));
      continue;
    }
    if (entry.file_size() > kMostBytes) {
      leave(fmt::format("longer than {} bytes", kMostBytes));
      continue;
    }
    std::ifstream stream(file, std::ios::binary);
    std::string document{std::istreambuf_iterator<char>(stream), {}};
    const Read read = read_setup(document);
    if (!read.wrong.empty()) {
      leave(read.wrong);
    } else if (!kept_.emplace(read.name, Kept{std::move(document), file}).second) {
      leave("its name is another's too: " + read.name);
    }
  }
}

std::string SetupShelf::list() const {
  google::protobuf::ListValue list;
  for (const auto& [name, kept] : kept_) {
    auto& fields = *list.add_values()->mutable_struct_value()->mutable_fields();
    fields["name"].set_string_value(name);
    fields["bytes"].set_number_value(static_cast<double>(kept.document.size()));
  }
  std::string text;
  const auto written = google::protobuf::util::MessageToJsonString(list, &text);
  if (!written.ok()) throw std::runtime_error("set-ups: " + written.ToString());
  return text;
}

const std::string* SetupShelf::find(std::string_view name) const {
  const auto found = kept_.find(name);
  return found == kept_.end() ? nullptr : &found->second.document;
}

void SetupShelf::keep(std::string name, std::string document, Done done) {
  if (document.size() > kMostBytes) {
    return done({413, fmt::format("a set-up has at most {} bytes", kMostBytes)});
  }
  if (std::string wrong = why_no_name(name); !wrong.empty()) return done({400, std::move(wrong)});
  const auto known = kept_.find(name);
  if (known == kept_.end() && kept_.size() + waiting_ >= kMost) {
    return done(
        {507, fmt::format("there are {} set-ups, and no more are kept; delete some", kMost)});
  }
  const fs::path file =
      known == kept_.end() ? config_.folder / file_name_of(name) : known->second.file;
  change(
      [file, name, document]() -> Outcome {
        const Read read = read_setup(document);
        if (!read.wrong.empty()) return {400, read.wrong};
        if (read.name != name) return {400, "the \"name\" in the set-up is not that of its path"};
        write_whole(file, document, kMode);
        return {};
      },
      [this, name, document, file] {
        kept_.insert_or_assign(name, Kept{document, file});
      },
      std::move(done));
}

void SetupShelf::remove(const std::string& name, Done done) {
  const auto known = kept_.find(name);
  if (known == kept_.end()) return done({404, "there is no set-up of this name"});
  change(
      [file = known->second.file]() -> Outcome {
        fs::remove(file);
        return {};
      },
      [this, name] { kept_.erase(name); }, std::move(done));
}

void SetupShelf::change(std::function<Outcome()> write, Task then, Done done) {
  if (waiting_ == kMostWaiting) {
    return done({503, "too many set-ups are being written; try again in a second"});
  }
  ++waiting_;
  // What `then` and `done` hold belongs to the shelf's thread: they are moved through the disk's
  // thread and back, so that no copy is left there to be destroyed.
  Task task = [this, write = std::move(write), then = std::move(then),
               done = std::move(done)]() mutable {
    Outcome outcome;
    try {
      outcome = write();
    } catch (const std::exception& error) {
      outcome = {507, error.what()};
    }
    config_.post(
        [this, outcome = std::move(outcome), then = std::move(then), done = std::move(done)] {
          --waiting_;
          if (outcome.status == 204) then();
          done(outcome);
        });
  };
  {
    const std::lock_guard lock(mutex_);
    writes_.push_back(std::move(task));
  }
  change_.notify_one();
}

}  // namespace skerry::server
