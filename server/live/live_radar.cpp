#include "server/live/live_radar.hpp"

#include <algorithm>

namespace skerry::server {

using captures::PictureKey;

LiveRadar::LiveRadar(const LiveSource& source) : source_(source), groups_(source) { look_anew(); }

bool LiveRadar::is_wanted(const PictureKey& key) const {
  return key.family == source_.kind->family && (!source_.from || *source_.from == key.from) &&
         groups_.is_picture(key.to) &&
         (key.family != captures::Family::furuno || (key.source != 0) == source_.second_range);
}

void LiveRadar::take(const pcap::Datagram& datagram, News& news) {
  news.groups |= groups_.hear(datagram);
  const auto key = captures::picture_of(datagram);
  if (picture_) {
    if (key && *key == picture_->traits.key) {
      decode(datagram, news);
    } else if (key) {
      ++others_;
    } else {
      hear(datagram, news);
    }
    return;
  }
  if (key && !is_wanted(*key)) {
    ++others_;
    return;
  }
  hold(datagram, key.has_value());
  // A clock that was set back begins the survey anew.
  if (since_) since_ = std::min(*since_, datagram.time);
  const bool enough = since_ && datagram.time - *since_ >= kSurvey;
  if (enough || held_bytes_ >= kMostHeld) adopt(news);
}

void LiveRadar::look(UtcTime now, News& news) {
  if (!picture_) {
    if (since_ && now - *since_ >= kSurvey) adopt(news);
    return;
  }
  heard_ = std::min(heard_, now);  // as a clock that was set back says
  if (now - heard_ < kSilence) return;
  settings_.set_standby(true);
  news.settings = true;
  news.lost = true;
  groups_.begin_anew();
  news.groups = true;
  look_anew();
}

void LiveRadar::hold(const pcap::Datagram& datagram, bool is_picture) {
  survey_->take(datagram);
  if (is_picture && !since_) since_ = datagram.time;
  held_.push_back({datagram.time,
                   datagram.from,
                   datagram.to,
                   {datagram.payload.begin(), datagram.payload.end()}});
  held_bytes_ += datagram.payload.size();
  while (!since_ && held_.size() > kMostReports) {
    held_bytes_ -= held_.front().payload.size();
    held_.pop_front();
  }
}

void LiveRadar::look_anew() {
  survey_ = std::make_unique<captures::Surveyor>();
  held_.clear();
  held_bytes_ = 0;
  since_.reset();
  picture_.reset();
  decoder_.reset();
  fitter_.reset();
  last_.reset();
}

void LiveRadar::adopt(News& news) {
  const auto pictures = survey_->pictures();
  if (pictures.empty()) {
    look_anew();  // nothing of it could be read
    news.refusal = "no spoke in the radar's datagrams can be read";
    return;
  }
  picture_ = pictures.front();
  settle_model();
  decoder_ = captures::make_picture(picture_->traits);
  fitter_ = std::make_unique<captures::SpokeFitter>(source_.radar, picture_->traits.turn,
                                                    survey_->begin());
  survey_.reset();
  told_.clear();
  news.anew = true;
  const std::deque<Held> held = std::move(held_);
  held_.clear();
  held_bytes_ = 0;
  for (const Held& each : held) {
    const pcap::Datagram datagram = each.datagram();
    const auto key = captures::picture_of(datagram);
    if (key && *key == picture_->traits.key) {
      decode(datagram, news);
    } else if (!key) {
      hear(datagram, news);
    }
  }
}

void LiveRadar::settle_model() {
  if (source_.kind->family != captures::Family::navico) return;
  const navico::Model wanted = source_.kind->model;
  navico::Model& found = picture_->traits.model;
  const bool same = navico::is_first_generation(wanted) == navico::is_first_generation(found) &&
                    navico::is_halo(wanted) == navico::is_halo(found);
  if ((picture_->certain && !same) || wanted == found) return;
  found = wanted;
  picture_->name = navico::name_of(wanted);
}

void LiveRadar::decode(const pcap::Datagram& datagram, News& news) {
  captured_.clear();
  if (const auto fault = decoder_->decode(datagram, captured_)) {
    news.refusal = fault->text;
    return;
  }
  const std::size_t before = news.spokes.size();
  for (captures::CapturedSpoke& each : captured_) {
    if (each.heading) heading_ = each.heading;
    fitter_->take(std::move(each), ship_, news.spokes);
  }
  heard_ = datagram.time;
  // A datagram that comes late, across the bow, does not make turns go back.
  for (std::size_t i = before; i < news.spokes.size(); ++i) {
    SpokeHeader& header = news.spokes[i].header;
    if (last_) header.scan = std::max(header.scan, last_->scan);
    last_ = header;
  }
  tell_settings(news);
}

void LiveRadar::hear(const pcap::Datagram& datagram, News& news) {
  // Own ship's data come from other devices, too.
  if (datagram.from.address == picture_->traits.key.from) decoder_->hear(datagram);
  ship_.hear(datagram);
  tell_settings(news);
}

void LiveRadar::tell_settings(News& news) {
  if (!last_) return;
  wire::Settings settings =
      captures::told_settings(*decoder_, source_.radar, *last_, picture_->rpm);
  std::string told = settings.SerializeAsString();
  if (told == told_) return;
  settings_ = std::move(settings);
  told_ = std::move(told);
  news.settings = true;
}

wire::OwnShip LiveRadar::own_ship(UtcTime now) const {
  wire::OwnShip ship = ship_.own_ship(source_.radar, now);
  if (heading_ && ship.no_heading()) {
    ship.set_heading_deg(heading_->in_degrees());
    ship.set_no_heading(false);
  }
  return ship;
}

}  // namespace skerry::server
