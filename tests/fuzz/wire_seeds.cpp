// Writes the seeds of the wire, ASTERIX and board fuzz targets, so that they can be made anew when
// a format grows.  Usage: wire_seeds <tests/fuzz/corpus>
#include <filesystem>
#include <string>
#include <vector>

#include "protocol/asterix/cat240.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/thin/thin_encoder.hpp"
#include "protocol/wire/byte_order.hpp"
#include "protocol/wire/datagram.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "tests/fuzz/corpus_folder.hpp"
#include "tests/unit/asterix/track_reports.hpp"
#include "tests/unit/board/test_records.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace {

using namespace skerry;
namespace fs = std::filesystem;
using Corpus = fuzz::CorpusFolder;

Bytes framed(const google::protobuf::MessageLite& message) {
  Bytes out;
  append_frame(out, message);
  return out;
}

Bytes framed(const Spoke& spoke) {
  Bytes out;
  append_spoke_frame(out, spoke);
  return out;
}

Spoke small_spoke(std::uint32_t bits, std::uint32_t cells = 256) {
  return test_spoke({360, cells, bits}, 5, 359, bits);
}

void write_client_frames(const Corpus& corpus) {
  wire::ClientMessage subscribe, set, status;
  subscribe.set_request(1);
  subscribe.mutable_subscribe()->set_radar(1);
  set.set_request(2);
  set.mutable_set()->set_course_deg(123.5);
  set.mutable_set()->set_speed_kn(12);
  set.mutable_set()->set_range_nm(6);
  set.mutable_set()->set_gain(55);
  set.mutable_set()->set_sea(20);
  set.mutable_set()->set_rain(0);
  set.mutable_set()->set_doppler(wire::DOPPLER_BOTH);
  set.mutable_set()->mutable_blanked_sectors()->add_sectors()->set_to_deg(20);
  set.mutable_set()->set_instructor(true);
  set.mutable_set()->add_lock("gain");
  status.set_request(3);
  status.mutable_get_status();
  corpus.write("subscribe", framed(subscribe));
  wire::ClientMessage chart;
  chart.set_request(4);
  chart.mutable_get_chart_objects()->set_latitude_deg(60.4);
  chart.mutable_get_chart_objects()->set_longitude_deg(5.3);
  chart.mutable_get_chart_objects()->set_radius_nm(9.0);
  chart.mutable_get_chart_objects()->set_tolerance_m(5.0);
  corpus.write("get_chart_objects", framed(chart));
  corpus.write("set", framed(set));
  corpus.write("get_status", framed(status));
  Bytes all = framed(subscribe);
  append_frame(all, set);
  append_frame(all, status);
  corpus.write("three_in_a_row", all);
  all.resize(all.size() - 2);
  corpus.write("cut_short", all);
  corpus.write("empty_message", {0x00});
  corpus.write("oversized", {0x81, 0x20});
  corpus.write("length_beyond_32_bits", {0x81, 0x80, 0x80, 0x80, 0x10});
}

void write_server_frames(const Corpus& corpus) {
  wire::ServerMessage hello, status, reply;
  hello.mutable_hello()->set_protocol_version(1);
  hello.mutable_hello()->set_server("skerryd 0.1.0");
  hello.mutable_hello()->add_radars()->set_name("X-band");
  for (const double nm : RangeScale::kNauticalMiles) {
    hello.mutable_hello()->add_range_scales_nm(nm);
  }
  status.mutable_status()->add_radars()->mutable_settings()->set_range_nm(6);
  (*status.mutable_status()->mutable_errors())["truncated"] = 3;
  (*status.mutable_status()->mutable_errors())["oversized"] = 1;
  reply.mutable_reply()->set_code(wire::Reply::OUT_OF_RANGE);
  reply.mutable_reply()->set_text("gain is 101, expected 0 .. 100");
  corpus.write("hello", framed(hello));
  corpus.write("status", framed(status));
  corpus.write("reply", framed(reply));
  corpus.write("spoke_4_bit", framed(small_spoke(4)));
  corpus.write("spoke_8_bit", framed(small_spoke(8)));
  corpus.write("spoke_odd_cells", framed(small_spoke(4, 257)));
  corpus.write("spoke_with_doppler", framed(far_doppler_spoke({360, 257, 8}, 5, 1.75)));
  Bytes two = framed(hello);
  append_spoke_frame(two, small_spoke(4));
  corpus.write("hello_then_spoke", two);
  wire::ServerMessage wrong;
  to_message(small_spoke(4), *wrong.mutable_spoke());
  wrong.mutable_spoke()->set_cell_count(4096);
  corpus.write("spoke_with_too_few_bytes", framed(wrong));
  ThinEncoder encoder(4);
  wire::ServerMessage thin;
  for (std::uint32_t i = 0; !thin.has_thin_spokes(); ++i) {
    Spoke spoke = small_spoke(8);
    spoke.header.index = i;
    encoder.add(spoke, [&](const wire::ThinSpokes& block) { *thin.mutable_thin_spokes() = block; });
  }
  corpus.write("thin_spokes", framed(thin));
}

void append_counted(Bytes& line, std::span<const std::uint8_t> datagram) {
  append_big_endian(line, datagram.size(), 2);
  line.insert(line.end(), datagram.begin(), datagram.end());
}

void write_datagrams(const Corpus& corpus) {
  const Bytes frame = framed(small_spoke(8));
  const auto body = frame_body(frame);
  Bytes scratch, whole, pieces, twice, first_only;
  for_each_datagram({1, 2, 3}, body, kMaxDatagram, scratch,
                    [&](auto each) { append_counted(whole, each); });
  for_each_datagram({1, 2, 4}, body, kMinDatagram, scratch, [&](auto each) {
    append_counted(pieces, each);
    append_counted(twice, each);
    append_counted(twice, each);
    if (first_only.empty()) append_counted(first_only, each);
  });
  corpus.write("one_datagram", whole);
  corpus.write("fragments", pieces);
  corpus.write("every_fragment_twice", twice);
  corpus.write("first_fragment_only", first_only);
  Bytes later_version = whole;
  later_version[2 + 4] = 2;
  corpus.write("another_version", later_version);
  Bytes longer_header = whole;
  longer_header[2 + 5] = 36;
  longer_header.insert(longer_header.begin() + 2 + 32, {1, 2, 3, 4});
  longer_header[1] = static_cast<std::uint8_t>(longer_header[1] + 4);
  corpus.write("longer_header", longer_header);
  Bytes contradiction = first_only;
  for_each_datagram({1, 2, 4}, body, kMinDatagram + 1, scratch,
                    [&](auto each) { append_counted(contradiction, each); });
  corpus.write("other_fragment_size", contradiction);
}

void write_cat240(const Corpus& corpus) {
  corpus.write("summary", encode_cat240_summary("skerryd", {25, 7}, UtcTime{}));
  corpus.write("video_4_bit", encode_cat240_video(small_spoke(4), {25, 7}, 1));
  corpus.write("video_8_bit", encode_cat240_video(small_spoke(8), {25, 7}, 2));
  corpus.write("video_medium_blocks", encode_cat240_video(small_spoke(8, 1021), {25, 7}, 3));
  Bytes nano = encode_cat240_video(test_spoke({360, 256, 4}, 11, 0), {25, 7}, 4);
  corpus.write("video_nanoseconds", nano);
  append_cat240_summary(nano, "two blocks", {25, 7}, UtcTime{});
  corpus.write("two_blocks", nano);
  corpus.write("explicit_length_items",
               {0xF0, 0x00, 0x29, 0xE7, 0xC6, 0x01, 0x02, 0x02, 0x00, 0x00, 0x00, 0x09, 0x00, 0x00,
                0x00, 0x10, 0x00, 0x00, 0x00, 0x05, 0x00, 0x00, 0x00, 0x64, 0x00, 0x04, 0x00, 0x02,
                0x00, 0x00, 0x02, 0x01, 0x08, 0x09, 0x00, 0x00, 0x04, 0xAA, 0xBB, 0xCC, 0x01});
  corpus.write("other_category", {0x30, 0x00, 0x05, 0x01, 0x02});
  corpus.write("one_bit_cells",
               {0xF0, 0x00, 0x24, 0xE7, 0xC0, 0x01, 0x02, 0x02, 0x00, 0x00, 0x00, 0x09,
                0x00, 0x00, 0x00, 0x10, 0x00, 0x00, 0x00, 0x05, 0x00, 0x00, 0x00, 0x64,
                0x00, 0x01, 0x00, 0x02, 0x00, 0x00, 0x09, 0x01, 0xB4, 0x80, 0x00, 0x00});
  corpus.write("compressed",
               {0xF0, 0x00, 0x24, 0xE7, 0xC0, 0x01, 0x02, 0x02, 0x00, 0x00, 0x00, 0x09,
                0x00, 0x00, 0x00, 0x10, 0x00, 0x00, 0x00, 0x05, 0x00, 0x00, 0x00, 0x64,
                0x80, 0x04, 0x00, 0x03, 0x00, 0x04, 0x00, 0x01, 0x78, 0x9C, 0x01, 0x00});
}

void write_board_records(const Corpus& corpus) {
  const auto encoded = [](std::uint64_t sequence, const auto&... records) {
    Bytes bytes;
    (board::append_record(bytes, sequence++, records), ...);
    return bytes;
  };
  const board::Sweep sweep = board::test_sweep(1, 64, 0, 12);
  const board::Sweep two_channels = board::test_sweep(2, 40, 20, 8);
  const board::Edges edges = board::test_edges(3, 9);
  const board::Event event = board::test_event(4);
  corpus.write("sweep", encoded(1, sweep));
  corpus.write("two_channels", encoded(2, two_channels));
  corpus.write("channel_b_alone", encoded(3, board::test_sweep(5, 0, 30, 14)));
  corpus.write("no_channel", encoded(4, board::test_sweep(6, 0, 0)));
  board::Sweep sum = board::test_sweep(7, 16, 0, 14);
  sum.meta.channels[0].mode = board::DecimationMode::sum;
  sum.samples[0][3] = 0xFFFF;
  corpus.write("sum_of_16_bits", encoded(5, sum));
  corpus.write("edges", encoded(6, edges));
  corpus.write("no_edges", encoded(7, board::test_edges(8, 0)));
  corpus.write("event", encoded(8, event));
  const Bytes all = encoded(9, sweep, edges, event, two_channels, sweep);
  corpus.write("one_after_another", all);
  corpus.write("cut_short", Bytes(all.begin(), all.end() - 70));
  Bytes to_come = encoded(10, event, sweep);
  to_come[4] = 9;
  corpus.write("kind_to_come", to_come);
  Bytes later = encoded(11, sweep);
  later[5] = 2;
  corpus.write("another_format", later);
  board::Sweep first = sweep, second = sweep;
  first.meta.acp_count = first.meta.acp_per_turn - 1;
  first.meta.ticks_since_acp = first.meta.acp_period;
  second.meta.acp_count = second.meta.ticks_since_acp = second.meta.arp_ticks = 0;
  second.meta.trigger_tick = first.meta.trigger_tick + 6000;
  corpus.write("over_the_arp", encoded(12, first, second));
}

void write_track_reports(const Corpus& corpus) {
  for (const bool most : {false, true}) {
    const std::string end = most ? "most" : "least";
    const std::vector plots{full_cat048(most), Cat048Report{}};
    const std::vector tracks{full_cat062(most), Cat062Report{}};
    const std::vector shore{full_cat010(most), Cat010Report{.kind = Cat010Kind::turn}};
    corpus.write("cat048_" + end, encode_cat048(plots).front());
    corpus.write("cat062_" + end, encode_cat062(tracks).front());
    corpus.write("cat010_" + end, encode_cat010(shore).front());
  }
  corpus.write("cat048_of_others", cat048_of_others());
  corpus.write("cat062_of_others", cat062_of_others());
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path root = fuzz::corpora(argc, argv);
  write_client_frames(Corpus(root / "client_frame"));
  write_server_frames(Corpus(root / "server_frame"));
  write_datagrams(Corpus(root / "datagram"));
  write_cat240(Corpus(root / "cat240"));
  write_track_reports(Corpus(root / "track_reports"));
  write_board_records(Corpus(root / "board_record"));
  return 0;
}
