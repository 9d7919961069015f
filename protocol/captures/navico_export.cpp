#include "protocol/captures/navico_export.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/navico/locator.hpp"
#include "protocol/navico/report.hpp"

namespace skerry::captures {
namespace {

using navico::kSpokeCells;

// Documentation addresses (RFC 5737): nobody's.
constexpr Ipv4Endpoint kRadar{ipv4(192, 0, 2, 1), 1024};
constexpr std::string_view kSerial = "1400000000";
constexpr Duration kReportsEvery = std::chrono::seconds(2);
// A frame does not wait for spokes that come so much later.
constexpr Duration kPause = std::chrono::milliseconds(500);
constexpr double kMaxCells = 8192.0;

// How much further than the set range spokes reach.  Source: protocol/navico/spoke_range.cpp.
double exported_reach_per_range(navico::Model model) {
  return model == navico::Model::g4 ? 1000.0 / 512.0 : 880.0 / 512.0;
}

std::uint8_t level(double percent) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(percent * 2.55 + 0.5), 0.0, 255.0));
}
std::uint8_t step(double percent, int most) {
  return static_cast<std::uint8_t>(
      std::clamp(std::floor(percent * most / 100.0 + 0.5), 0.0, static_cast<double>(most)));
}

navico::ControlReport controls_of(navico::Model model, const wire::Settings& settings,
                                  std::uint32_t range_dm) {
  navico::ControlReport report;
  report.range_dm = range_dm;
  report.mode = static_cast<std::uint8_t>(settings.mode());
  report.gain_auto = settings.gain_auto();
  report.gain = level(settings.gain());
  report.sea_auto = settings.sea_auto() ? 1 : 0;
  report.sea = level(settings.sea());
  report.rain = level(settings.rain());
  report.interference = step(settings.interference_rejection(), 3);
  report.expansion = step(settings.echo_stretch(), navico::is_halo(model) ? 3 : 1);
  report.boost = step(settings.target_boost(), 2);
  return report;
}

navico::AdvancedReport advanced_of(navico::Model model, const wire::Settings& settings) {
  navico::AdvancedReport report;
  report.side_lobe_auto = settings.side_lobe_auto();
  report.side_lobe = level(settings.side_lobe_suppression());
  report.noise_rejection = step(settings.noise_rejection(), 3);
  report.target_separation = step(settings.target_separation(), 3);
  const double sea = std::clamp(settings.sea(), 0.0, 100.0);
  report.halo_sea = static_cast<std::uint8_t>(std::lround(sea));
  report.halo_sea_adjust =
      static_cast<std::int8_t>(settings.sea_auto() ? std::lround(sea - 50.0) : 0);
  if (navico::has_doppler(model)) {
    report.doppler = static_cast<std::uint8_t>(settings.doppler());
    report.doppler_threshold_cms = static_cast<std::uint16_t>(
        std::clamp(settings.doppler_threshold_mps() * 100.0, 0.0, 65535.0));
  }
  return report;
}

void put_doppler(std::span<const DopplerClass> doppler,
                 std::span<std::uint8_t, kSpokeCells / 2> nibbles) {
  for (std::size_t i = 0; i < kSpokeCells; ++i) {
    const int shift = i % 2 == 0 ? 0 : 4;
    std::uint8_t& octet = nibbles[i / 2];
    std::uint8_t cell = std::min<std::uint8_t>(octet >> shift & 0x0F, navico::kMostBesideDoppler);
    if (cell > 0 && doppler[i] == DopplerClass::approaching) cell = navico::kApproaching;
    if (cell > 0 && doppler[i] == DopplerClass::receding) cell = navico::kReceding;
    octet = static_cast<std::uint8_t>((octet & (0xF0 >> shift)) | cell << shift);
  }
}

}  // namespace

NavicoExport::NavicoExport(navico::Model model, pcap::PcapWriter& out)
    : model_(model), out_(out), resampler_(navico::kTurnSpokes, std::uint32_t{kSpokeCells}) {}

void NavicoExport::write_reports(UtcTime time) {
  if (reported_ && time - *reported_ < kReportsEvery && time >= *reported_) return;
  reported_ = time;
  const navico::Addresses& at = navico::kAddressesA;
  const auto groups_b =
      navico::has_two_ranges(model_) ? std::optional(navico::kAddressesB) : std::nullopt;
  out_.add(time, kRadar, navico::kLocatorGroup,
           encode_locator(navico::make_locator(std::string(kSerial), kRadar, at, groups_b)));
  const auto report = [&](const Bytes& bytes) { out_.add(time, kRadar, at.report, bytes); };
  report(encode(model_, navico::StateReport{navico::RadarState::transmit}));
  report(encode(model_, controls_of(model_, settings_, range_dm_)));
  navico::IdentityReport identity;
  identity.type = navico::identity_type(model_);
  report(encode(model_, identity));
  report(encode(model_, advanced_of(model_, settings_)));
}

void NavicoExport::fit_range(const Spoke& spoke) {
  const double reach_m = spoke.header.reach().in_metres();
  if (reach_m == reach_m_) return;
  reach_m_ = reach_m;
  const double dm = std::floor(reach_m / exported_reach_per_range(model_) * 10.0 + 0.5);
  range_dm_ = static_cast<std::uint32_t>(std::clamp(
      dm, double{navico::kMinRangeDm}, static_cast<double>(navico::max_range_dm(model_))));
  range_ = navico::spoke_range(model_, range_dm_);
  resampler_ = SpokeResampler(navico::kTurnSpokes, std::uint32_t{kSpokeCells});
}

// Ends the spoke where the model's does.  Error: half a cell.
const Spoke& NavicoExport::fit_cells(const Spoke& spoke) {
  const double wanted =
      std::floor(spoke.header.geometry.cells * (range_.reach / spoke.header.reach()) + 0.5);
  const auto cells = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, kMaxCells));
  if (cells == spoke.header.geometry.cells) return spoke;
  if (cells < spoke.header.geometry.cells) ++cut_;
  fitted_ = spoke;
  fitted_.header.geometry.cells = cells;
  fitted_.cells.resize(cells);
  if (!fitted_.doppler.empty()) fitted_.doppler.resize(cells);
  return fitted_;
}

void NavicoExport::add(const Spoke& spoke) {
  if (held_ > 0 && spoke.header.utc - last_ > kPause) write_frame();
  fit_range(spoke);
  write_reports(spoke.header.utc);
  const Spoke& fitted = fit_cells(spoke);
  const ScanGeometry& geometry = fitted.header.geometry;
  if (geometry.spokes_per_turn == navico::kTurnSpokes && geometry.cells == kSpokeCells) {
    return append(fitted.header, fitted.cells, fitted.doppler);
  }
  resampler_.add(fitted, [this](const ResampledSpoke& each) {
    append(each.header, each.cells, each.doppler);
  });
}

void NavicoExport::append(const SpokeHeader& header, std::span<const std::uint8_t> cells,
                          std::span<const DopplerClass> doppler) {
  navico::SpokeFields fields;
  // Spokes that are not in the recording are missing in the counter too, where none are resampled.
  fields.scan = static_cast<std::uint16_t>(
      (header.geometry.spokes_per_turn == navico::kTurnSpokes ? header.sequence : rotation_) %
      navico::kTurnUnits);
  fields.angle = static_cast<std::uint16_t>(header.index * 2);
  fields.heading = navico::heading_field(header.heading);
  fields.rotation = rotation_++;
  std::array<std::uint8_t, kSpokeCells / 2> nibbles;
  const std::span<const std::uint8_t, kSpokeCells> all(cells);
  header.geometry.bits == 4 ? navico::pack_nibbles(all, nibbles) : navico::pack_cells(all, nibbles);
  if (navico::has_doppler(model_) && !doppler.empty()) put_doppler(doppler, nibbles);
  navico::append_spoke(spokes_, fields, range_, model_, nibbles);
  last_ = header.utc;
  if (++held_ == navico::kFrameSpokes) write_frame();
}

void NavicoExport::write_frame() {
  Bytes frame;
  navico::append_frame_header(frame, held_);
  frame.insert(frame.end(), spokes_.begin(), spokes_.end());
  out_.add(last_, kRadar, navico::kAddressesA.data, frame);
  spokes_.clear();
  held_ = 0;
}

void NavicoExport::finish() {
  if (held_ > 0) write_frame();
}

}  // namespace skerry::captures
