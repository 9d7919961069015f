// CoastService: keeps the coast around every radar ready, off the radar threads.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/scene/coast_picture.hpp"
#include "server/core/latest.hpp"

namespace skerry::server {

// What a radar wants to see: the coast around a place, as fine as it can tell apart.
struct CoastWish {
  GeoPoint own_ship;
  echo::RadarResolution resolution;
};

// Loads chart windows and refines the coast on a thread of its own ("coast"), one wish per radar
// outstanding: a newer wish replaces one not yet begun.  The radar goes on with the picture it has.
class CoastService {
 public:
  // `radars` slots.  `seed` is the scenario's.
  CoastService(echo::GshhgReader reader, std::size_t radars, std::uint64_t seed);
  ~CoastService();
  CoastService(const CoastService&) = delete;
  CoastService& operator=(const CoastService&) = delete;

  // Makes the first picture of a radar on the caller's thread, before start().
  // Error: std::runtime_error if the chart cannot be read.
  void prepare_now(std::size_t radar, const CoastWish& wish);
  void start();

  // Thread: the radar's.  Never waits for the work.
  void ask(std::size_t radar, const CoastWish& wish);
  echo::CoastPicturePtr latest(std::size_t radar) const { return slots_[radar]->picture.get(); }

 private:
  struct Slot {
    std::optional<CoastWish> wish;                  // guarded by mutex_
    std::unique_ptr<echo::CoastPreparer> preparer;  // the service's thread
    Latest<echo::CoastPicture> picture;
  };
  void serve(Slot& slot, const CoastWish& wish);
  void work(const std::stop_token& stop);

  echo::GshhgReader reader_;
  std::uint64_t seed_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::mutex mutex_;
  std::condition_variable_any wished_;
  std::jthread thread_;
};

}  // namespace skerry::server
