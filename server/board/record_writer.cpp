#include "server/board/record_writer.hpp"

namespace skerry::server {
namespace {

// Edges of one tick stay together; this many are never of one.
constexpr std::size_t kSpareEdges = 64;

}  // namespace

void BoardBatch::clear() {
  if (records.capacity() > kKeptBytes && records.size() <= kKeptBytes) Bytes().swap(records);
  records.clear();
  signals.clear();
  record_ends.clear();
  signal_ends.clear();
  first_record = first_signal = 0;
  sweeps = 0;
  fault_changes.clear();
  is_complete = true;
}

void RecordWriter::begin(BoardBatch& batch, Tick tick, std::uint32_t clock_hz) {
  batch.clear();
  batch.first_record = next_record_;
  batch.first_signal = next_signal_;
  batch_ = &batch;
  edges_.sample_clock_hz = clock_hz;
  edges_.from_tick = tick;
  edges_.edges.clear();
}

void RecordWriter::end_of_record() {
  batch_->record_ends.push_back(static_cast<std::uint32_t>(batch_->records.size()));
  ++next_record_;
}

void RecordWriter::end_of_signal() {
  batch_->signal_ends.push_back(static_cast<std::uint32_t>(batch_->signals.size()));
  ++next_signal_;
}

void RecordWriter::sweep(const board::Sweep& sweep) {
  board::append_record(batch_->records, next_record_, sweep);
  end_of_record();
}

void RecordWriter::edge(Tick tick, board::Line line) {
  auto& edges = edges_.edges;
  if (edges.size() >= board::kMaxEdges - kSpareEdges && edges.back().tick < tick) {
    write_edges(tick);
  }
  edges.push_back({tick, line});
}

void RecordWriter::event(Tick tick, std::uint32_t event, std::uint32_t faults,
                         std::uint32_t value) {
  const board::Event record{edges_.radar, tick, event, faults, value};
  board::append_record(batch_->records, next_record_, record);
  end_of_record();
  board::append_record(batch_->signals, next_signal_, record);
  end_of_signal();
}

void RecordWriter::write_edges(Tick to) {
  if (to <= edges_.from_tick) return;
  edges_.to_tick = to;
  board::append_record(batch_->records, next_record_, edges_);
  end_of_record();
  board::append_record(batch_->signals, next_signal_, edges_);
  end_of_signal();
  edges_.from_tick = to;
  edges_.edges.clear();
}

void RecordWriter::finish(Tick tick) { write_edges(tick); }

}  // namespace skerry::server
