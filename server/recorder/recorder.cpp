#include "server/recorder/recorder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/unknown_field_set.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <utility>

#include "server/recorder/file_names.hpp"

namespace skerry::server {
namespace {

// Between looks at the rings while nobody wakes it; with a chunk's time well below a second.
constexpr std::chrono::milliseconds kLook{50};
constexpr std::chrono::milliseconds kLookAtRest{1000};

RecorderConfig with_absolute_folder(RecorderConfig config) {
  std::error_code error;
  const auto absolute = std::filesystem::absolute(config.folder, error).lexically_normal();
  if (!error) config.folder = absolute.string();
  return config;
}

wire::Reply refusal(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return reply;
}

}  // namespace

Recorder::Recorder(RadarHost& host, RecorderConfig config)
    : host_(host), config_(with_absolute_folder(std::move(config))), disk_(config_) {
  state_.set_folder(config_.folder);
}

Recorder::~Recorder() { stop(); }

void Recorder::start() {
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "recorder");
    try {
      run();
    } catch (const std::exception& error) {
      spdlog::critical("the recorder's thread ends: {}", error.what());
      std::terminate();
    }
  });
  if (config_.record_at_start) {
    wire::Record request;
    request.set_all_views(config_.record_all_views);
    record(request, "configuration");
  }
}

void Recorder::stop() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(stopping_, true)) return;
  }
  wake();
  if (thread_.joinable()) thread_.join();
  disk_.stop();
  look_at_disk();
}

wire::Reply Recorder::begin(const wire::Record& record, const std::string& origin) {
  if (wanted_) {
    return refusal(wire::Reply::REFUSED,
                   "a recording is being made; stop it before another is started");
  }
  if (state_.phase() == wire::RecorderState::RECORDING ||
      state_.phase() == wire::RecorderState::DISK_FULL) {
    return refusal(wire::Reply::REFUSED,
                   "the recording before is still being written; try again in a moment");
  }
  if (const auto fault = fault_in_file_name(record.name())) {
    return refusal(wire::Reply::OUT_OF_RANGE, *fault);
  }
  Order order{.kind = Order::Kind::start, .text = {}, .origin = origin};
  order.plan.name = record.name();
  order.plan.origin = origin;
  order.plan.inputs_only = record.inputs_only();
  order.plan.all_views = record.all_views();
  if (record.inputs_only() && record.all_views()) {
    return refusal(wire::Reply::REFUSED,
                   "inputs alone make the video of every view again; ask for one of inputs_only "
                   "and all_views");
  }
  if (record.inputs_only() && host_.exercise() == nullptr) {
    return refusal(wire::Reply::REFUSED,
                   "inputs alone are recorded of an exercise; there is none here to give any");
  }
  order.plan.radars.assign(record.radars().begin(), record.radars().end());
  if (order.plan.radars.empty()) {
    for (std::uint32_t radar = 0; radar < host_.radar_count(); ++radar) {
      if (host_.find_channel(radar, 0)) order.plan.radars.push_back(radar);
    }
  }
  std::sort(order.plan.radars.begin(), order.plan.radars.end());
  order.plan.radars.erase(std::unique(order.plan.radars.begin(), order.plan.radars.end()),
                          order.plan.radars.end());
  for (const std::uint32_t radar : order.plan.radars) {
    if (host_.find_channel(radar, 0) == nullptr) {
      return refusal(wire::Reply::UNKNOWN,
                     fmt::format("no radar {} to record; Hello lists the radars", radar));
    }
  }
  wanted_ = true;
  marks_ = 0;
  state_.Clear();
  state_.set_folder(config_.folder);
  state_.set_phase(wire::RecorderState::RECORDING);
  state_.set_inputs_only(record.inputs_only());
  state_.set_all_views(record.all_views());
  ++version_;
  orders_.push_back(std::move(order));
  return {};
}

wire::Reply Recorder::record(const wire::Record& record, const std::string& origin) {
  const auto& unknown = record.GetReflection()->GetUnknownFields(record);
  if (!unknown.empty()) {
    return refusal(wire::Reply::UNKNOWN,
                   fmt::format("record: this server knows no field {}", unknown.field(0).number()));
  }
  const std::lock_guard lock(mutex_);
  if (stopping_) return refusal(wire::Reply::REFUSED, "the server is stopping");
  if (orders_.size() >= kMaxWaiting) {
    return refusal(wire::Reply::REFUSED, "too many orders at once; try again in a moment");
  }
  wire::Reply reply;
  switch (record.action()) {
    case wire::Record::START:
      reply = begin(record, origin);
      break;
    case wire::Record::STOP:
      if (!wanted_) return refusal(wire::Reply::REFUSED, "nothing is being recorded");
      wanted_ = false;
      orders_.push_back({.kind = Order::Kind::stop, .text = {}, .origin = origin});
      break;
    case wire::Record::MARK:
      if (!wanted_) return refusal(wire::Reply::REFUSED, "nothing is being recorded to be marked");
      if (const auto fault = fault_in_mark_name(record.name())) {
        return refusal(wire::Reply::OUT_OF_RANGE, *fault);
      }
      if (marks_ >= kMaxMarks) {
        return refusal(wire::Reply::REFUSED,
                       fmt::format("the recording has {} marks, which is the most", kMaxMarks));
      }
      ++marks_;
      orders_.push_back({.kind = Order::Kind::mark, .text = record.name(), .origin = origin});
      break;
    default:
      return refusal(wire::Reply::OUT_OF_RANGE, "action: expected START, STOP or MARK");
  }
  if (reply.code() == wire::Reply::OK) wake();
  return reply;
}

wire::RecorderState Recorder::state() const {
  const std::uint64_t free_bytes = disk_.state().free_bytes;
  const std::lock_guard lock(mutex_);
  wire::RecorderState state = state_;
  state.set_free_bytes(free_bytes);
  return state;
}

std::uint64_t Recorder::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

void Recorder::note(Order order) {
  if (!records_.load(std::memory_order_relaxed)) return;
  const std::lock_guard lock(mutex_);
  if (orders_.size() >= kMaxWaiting) {
    ++left_out_;
  } else {
    orders_.push_back(std::move(order));
  }
}

void Recorder::log(int level, std::string text) {
  note({.kind = Order::Kind::log, .text = std::move(text), .origin = {}, .level = level});
}

void Recorder::control_changed(std::string text) {
  note({.kind = Order::Kind::control, .text = std::move(text), .origin = {}});
}

void Recorder::audit(AuditEntryPtr entry) {
  const std::lock_guard lock(mutex_);
  if (!wanted_) return;
  if (orders_.size() >= kMaxWaiting) {
    ++left_out_;
  } else {
    orders_.push_back(
        {.kind = Order::Kind::audit, .text = {}, .origin = {}, .entry = std::move(entry)});
  }
}

void Recorder::wake() {
  {
    const std::lock_guard lock(wake_mutex_);
    woken_ = true;
  }
  wakes_.notify_one();
}

void Recorder::run() {
  bool more_waits = false;
  for (;;) {
    std::deque<Order> orders;
    std::uint64_t left_out = 0;
    bool stopping = false;
    {
      std::unique_lock lock(wake_mutex_);
      if (!more_waits) {
        const bool rests = !session_ && !disk_.state().is_busy;
        wakes_.wait_for(lock, rests ? kLookAtRest : kLook, [this] { return woken_; });
      }
      woken_ = false;
    }
    {
      const std::lock_guard lock(mutex_);
      orders.swap(orders_);
      left_out = std::exchange(left_out_, 0);
      stopping = stopping_;
    }
    const auto now = std::chrono::steady_clock::now();
    more_waits = session_ && session_->step(now);
    for (Order& order : orders) carry_out(std::move(order), now);
    if (session_ && left_out > 0) {
      session_->log(
          spdlog::level::warn,
          fmt::format("{} lines of the log or entries of the audit are left out", left_out), now);
    }
    if (session_ && stopping) {
      carry_out({.kind = Order::Kind::stop, .text = {}, .origin = "the server's end"}, now);
    }
    if (session_) {
      look_at_session(now);
    } else {
      look_at_disk();
    }
    if (stopping) return;
  }
}

void Recorder::carry_out(Order order, std::chrono::steady_clock::time_point now) {
  switch (order.kind) {
    case Order::Kind::start: {
      spdlog::info("recorder: started by {}, into {}", order.origin, config_.folder);
      session_ = std::make_unique<RecordingSession>(
          host_, config_, disk_, std::move(order.plan), [this] { wake(); }, now);
      records_.store(true, std::memory_order_relaxed);
      break;
    }
    case Order::Kind::stop: {
      if (!session_) break;
      records_.store(false, std::memory_order_relaxed);
      session_->stop(order.origin, now);
      show(session_->state(now));
      if (auto line = full_disk_.end(session_->state(now).spokes_lost())) spdlog::warn(*line);
      full_disk_ = {};
      session_.reset();
      finishing_ = true;
      spdlog::info("recorder: stopped by {}", order.origin);
      break;
    }
    case Order::Kind::mark:
      if (session_) session_->mark(order.text, now);
      break;
    case Order::Kind::log:
      if (session_) session_->log(order.level, order.text, now);
      break;
    case Order::Kind::control:
      if (session_) session_->control_changed(order.text, now);
      break;
    case Order::Kind::audit:
      if (session_) session_->audit(*order.entry, now);
      break;
  }
}

void Recorder::look_at_session(std::chrono::steady_clock::time_point now) {
  const wire::RecorderState state = session_->state(now);
  show(state);
  if (auto line = full_disk_.look(disk_.state(), state.spokes_lost(), now)) spdlog::warn(*line);
  if (state.phase() != wire::RecorderState::FAILED) return;
  full_disk_ = {};
  records_.store(false, std::memory_order_relaxed);
  session_.reset();
  disk_.end();
  const std::lock_guard lock(mutex_);
  const bool starts = std::any_of(orders_.begin(), orders_.end(), [](const Order& order) {
    return order.kind == Order::Kind::start;
  });
  if (!starts) wanted_ = false;
}

// The recording has ended; its data is on its way to the disk, or there.
void Recorder::look_at_disk() {
  if (!finishing_) return;
  const DiskState disk = disk_.state();
  wire::RecorderState state = this->state();
  state.set_file(disk.file);
  state.set_file_bytes(disk.file_bytes);
  state.set_total_bytes(disk.total_bytes);
  state.set_problem(disk.problem);
  if (!disk.is_busy) {
    finishing_ = false;
    state.set_bytes_per_second(0);
    state.set_phase(disk.failed ? wire::RecorderState::FAILED : wire::RecorderState::OFF);
  }
  show(state);
}

void Recorder::show(const wire::RecorderState& state) {
  const std::lock_guard lock(mutex_);
  const bool changed = state.phase() != state_.phase() || state.file() != state_.file() ||
                       state.marks() != state_.marks() || state.problem() != state_.problem();
  state_ = state;
  state_.set_folder(config_.folder);
  if (changed) ++version_;
}

}  // namespace skerry::server
