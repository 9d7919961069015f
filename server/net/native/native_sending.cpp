// What a native session sends: replies, news, and spokes by whole sectors.
#include <utility>

#include "server/net/common/encoders.hpp"
#include "server/net/native/native_session.hpp"

namespace skerry::server {

void NativeSession::send(const wire::ServerMessage& message) {
  replies_.push_back(make_frame(message));
  reply_bytes_ += replies_.back()->size();
}

void NativeSession::tell(News kind, const SharedBytes& frame) {
  news_[kind] = frame;
  pump();
}

void NativeSession::on_settings(const SharedBytes& frame) { tell(kSettings, frame); }
void NativeSession::on_own_ship(const SharedBytes& frame) {
  look_at_rights();
  tell(kOwnShip, frame);
}
void NativeSession::on_world(const SharedBytes& frame) { tell(kWorld, frame); }
void NativeSession::on_exercise(const SharedBytes& frame) { tell(kExercise, frame); }
void NativeSession::on_targets(const SharedBytes& frame) { tell(kTargets, frame); }
void NativeSession::on_recorder(const SharedBytes& frame) { tell(kRecorder, frame); }
void NativeSession::on_playback(const SharedBytes& frame) { tell(kPlayback, frame); }
void NativeSession::on_fleet(const SharedBytes& frame) { tell(kFleet, frame); }

void NativeSession::pump() {
  while (!writing_ && !closed_) {
    gather_batch();
    if (batch_.empty()) {
      if (failed_ && !finished_) {
        finished_ = true;
        transport_->finish();
      }
      return;
    }
    write_began_ = std::chrono::steady_clock::now();
    const std::size_t written = transport_->write_now(batch_);
    client_->bytes_sent.fetch_add(written, std::memory_order_relaxed);
    if (written == batch_bytes_) {
      end_batch(true);
      continue;
    }
    drop_written(written);
    writing_ = true;
    transport_->write(batch_, [self = shared_from_this()](error_code error, std::size_t size) {
      self->writing_ = false;
      self->on_written(error, size);
    });
  }
}

void NativeSession::gather_batch() {
  while (!replies_.empty()) {
    add_to_batch(std::move(replies_.front()));
    replies_.pop_front();
  }
  reply_bytes_ = 0;
  for (SharedBytes& frame : news_) {
    if (frame != nullptr) add_to_batch(std::exchange(frame, nullptr));
  }
  add_sectors_to_batch();
}

void NativeSession::drop_written(std::size_t bytes) {
  auto first = batch_.begin();
  for (; bytes > 0 && bytes >= first->size(); ++first) bytes -= first->size();
  if (first != batch_.end()) *first += bytes;
  batch_.erase(batch_.begin(), first);
}

void NativeSession::end_batch(bool whole) {
  if (whole) client_->spokes_sent.fetch_add(batch_spokes_, std::memory_order_relaxed);
  batch_.clear();
  batch_owners_.clear();
  batch_bytes_ = 0;
  batch_spokes_ = 0;
}

void NativeSession::add_to_batch(SharedBytes frame) {
  batch_.emplace_back(frame->data(), frame->size());
  batch_bytes_ += frame->size();
  batch_owners_.push_back(std::move(frame));
}

void NativeSession::add_sectors_to_batch() {
  while (feed_ != nullptr && takes_spokes_ && batch_bytes_ < kBatchBytes) {
    EncodedSectorPtr sector = feed_->ring().take(cursor_);
    if (sector == nullptr) break;
    add_to_batch(std::move(sector));
  }
  while (batch_bytes_ < kBatchBytes) {
    EncodedSectorPtr block = boards_.take();
    if (block == nullptr) break;
    add_to_batch(std::move(block));
  }
  client_->spokes_lost.store(lost_before_ + cursor_.spokes_lost + boards_.lost(),
                             std::memory_order_relaxed);
}

void NativeSession::add_to_batch(EncodedSectorPtr sector) {
  batch_.emplace_back(sector->bytes.data(), sector->bytes.size());
  batch_bytes_ += sector->bytes.size();
  batch_spokes_ += sector->spoke_count();
  batch_owners_.push_back(std::move(sector));
}

void NativeSession::on_written(error_code error, std::size_t size) {
  client_->bytes_sent.fetch_add(size, std::memory_order_relaxed);
  end_batch(!error);
  if (closed_) return;
  if (error) return close();
  if (waiting_for_replies_) return process();
  pump();
}

}  // namespace skerry::server
