// Outputs from the command line and the configuration file.
#include "server/app/options/outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "server/app/options/inputs.hpp"
#include "server/app/options/options.hpp"
#include "server/app/options/output_text.hpp"
#include "server/displays/emulated_radars.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

NetConfig config_with(const std::vector<app::Output>& outputs) {
  app::ServerConfig file;
  for (const app::Output& output : outputs) *file.add_outputs() = output;
  NetConfig net;
  add_outputs(file, net);
  return net;
}

NetConfig config_of(const std::vector<std::string>& texts) {
  std::vector<app::Output> outputs;
  for (const std::string& text : texts) outputs.push_back(parse_output(text));
  return config_with(outputs);
}

template <class Configure>
std::string refusal_of(Configure configure) {
  try {
    configure();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}
std::string refusal(const std::string& text) {
  return refusal_of([&] { config_with({parse_output(text)}); });
}

std::vector<LiveSource> live_of(const std::vector<std::string>& inputs,
                                const std::vector<std::string>& outputs = {}) {
  app::ServerConfig file;
  for (const std::string& text : inputs) *file.add_inputs() = parse_input(text);
  for (const std::string& text : outputs) *file.add_outputs() = parse_output(text);
  NetConfig net;
  add_inputs(file, net);
  return live_sources(file);
}

TEST(Inputs, ARealRadarHasItsKindNumberAndNetwork) {
  const auto sources =
      live_of({"navico_halo:interface_address=192.0.2.1,from=192.0.2.7,radar=1,"
               "second_range=true",
               "cat240:radar=2,address=239.192.43.78", "nmea0183:port=10111"});
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[0].kind->name, "navico_halo");
  EXPECT_EQ(sources[0].radar, 1u);
  EXPECT_EQ(sources[0].from, ipv4(192, 0, 2, 7));
  EXPECT_TRUE(sources[0].second_range);
  EXPECT_EQ(sources[0].interface_address, "192.0.2.1");
  EXPECT_EQ(text_of(*sources[1].at), "239.192.43.78:8600");
  EXPECT_EQ(text_of(*live_of({"cat240:port=4378"})[0].at), "127.0.0.1:4378");
}

TEST(Inputs, SayWhatIsWrong) {
  const auto refused = [](const std::vector<std::string>& inputs,
                          const std::vector<std::string>& outputs = {}) {
    return refusal_of([&] { live_of(inputs, outputs); });
  };
  EXPECT_THAT(refused({"nmea0183"}), HasSubstr("port is missing"));
  EXPECT_THAT(refused({"garmin_xhd:port=5"}), HasSubstr("unknown key 'port'"));
  EXPECT_THAT(refused({"navico_br24:second_range=true"}), HasSubstr("unknown key 'second_range'"));
  EXPECT_THAT(refused({"nmea0183:port=10111,from=192.0.2.7"}), HasSubstr("unknown key 'from'"));
  EXPECT_THAT(refused({"garmin_xhd:from=radar"}), HasSubstr("'radar' is not an IPv4 address"));
  EXPECT_THAT(refused({"cat240:address=group"}), HasSubstr("'group' is not an IPv4 address"));
  EXPECT_THAT(refused({"garmin_xhd", "navico_halo"}), HasSubstr("radar 0 has an input already"));
  EXPECT_THAT(refused({"navico_halo"}, {"navico_4g"}), HasSubstr("from=ADDRESS"));
  EXPECT_EQ(refused({"navico_halo:from=127.0.0.9"}, {"navico_4g"}), "accepted");
  EXPECT_EQ(refused({"navico_halo"}, {"garmin_xhd"}), "accepted");
  EXPECT_EQ(refused({"navico_halo"}, {"navico_4g:interface_address=192.0.2.1"}), "accepted");
}

// Each emulation but the outputs' own kinds can be listened to by its own name.
TEST(Inputs, EveryEmulatedRadarIsAKindOfInput) {
  for (const EmulatedRadar& radar : emulated_radars()) {
    EXPECT_NE(find_live_kind(radar.name), nullptr) << radar.name;
  }
  for (int kind = 0; kind < app::Input::Kind_ARRAYSIZE; ++kind) {
    const std::string& name = app::Input::Kind_Name(static_cast<app::Input::Kind>(kind));
    EXPECT_EQ(find_live_kind(name) != nullptr, name != "nmea0183") << name;
  }
  EXPECT_EQ(live_kinds().size() + 1, static_cast<std::size_t>(app::Input::Kind_ARRAYSIZE));
}

TEST(Outputs, AStreamHasItsDestinationAndShape) {
  const NetConfig net = config_of(
      {"cat240:radar=2,address=239.192.43.78,port=4378,interface_address=192.0.2.7,spokes=720,"
       "cells=512,bits=16,sac=25,compressed=true,blocks=high,records=4,view=own",
       "native"});
  ASSERT_EQ(net.streams.size(), 2u);
  const StreamOutputConfig& stream = net.streams[0];
  EXPECT_EQ(stream.to.radar, 2u);
  EXPECT_EQ(stream.to.address, "239.192.43.78");
  EXPECT_EQ(stream.to.port, 4378);
  EXPECT_EQ(stream.to.multicast_ttl, 1) << "another interface is meant to be left by";
  EXPECT_TRUE(stream.own_view);
  const auto& shape = std::get<Cat240StreamShape>(stream.shape);
  EXPECT_EQ(shape.options.source, (Cat240Source{25, 2}));
  EXPECT_EQ(shape.options.bits, 16);
  EXPECT_TRUE(shape.options.compressed);
  EXPECT_EQ(shape.options.blocks, Cat240Blocks::high);
  EXPECT_EQ(shape.turn_spokes, 720u);
  EXPECT_EQ(shape.records, 4u);
  EXPECT_EQ(net.streams[1].to.address, "127.0.0.1");
  EXPECT_EQ(net.streams[1].to.port, 7411);
  EXPECT_EQ(net.streams[1].to.multicast_ttl, 0);
}

TEST(Outputs, OfPlotsAndTracksHaveTheirCategoryPortAndSource) {
  const NetConfig net = config_of({"cat048", "cat062:radar=3,sac=25,sic=9",
                                   "cat010:radar=300,address=239.1.2.3,port=4379,"
                                   "interface_address=192.0.2.7,max_datagram=512"});
  ASSERT_EQ(net.target_outputs.size(), 3u);
  const auto& [first, second, third] =
      std::tie(net.target_outputs[0], net.target_outputs[1], net.target_outputs[2]);
  EXPECT_EQ(first.category, TargetCategory::cat048);
  EXPECT_EQ(first.to.address, "127.0.0.1");
  EXPECT_EQ(first.to.port, 8602);
  EXPECT_EQ(first.to.multicast_ttl, 0);
  EXPECT_EQ(second.category, TargetCategory::cat062);
  EXPECT_EQ(second.to.radar, 3u);
  EXPECT_EQ(second.to.port, 8603);
  EXPECT_EQ(second.source, (AsterixSource{25, 9}));
  EXPECT_EQ(third.category, TargetCategory::cat010);
  EXPECT_EQ(config_of({"cat010"}).target_outputs[0].to.port, 8604);
  EXPECT_EQ(third.to.port, 4379);
  EXPECT_EQ(third.to.multicast_ttl, 1);
  EXPECT_EQ(third.to.max_datagram, 512u);
  EXPECT_EQ(third.source, (AsterixSource{0, 300 % 256}));
  EXPECT_THAT(refusal("cat048:port=0"), HasSubstr("port 0 cannot be sent to"));
  EXPECT_THAT(refusal("cat062:sac=256"),
              HasSubstr("sac: 256 is out of range; allowed: at most 255"));
  EXPECT_THAT(refusal("cat010:records=4"), HasSubstr("'records' is a key of cat240"));
}

TEST(Outputs, EmulatedRadarsStayOnThisHostUntilAnInterfaceIsGiven) {
  const NetConfig net = config_of({"navico_4g:dual_range=true,obeys=false",
                                   "garmin_xhd:interface_address=172.16.2.1,radar=1,obeys=true",
                                   "raymarine_quantum:ttl=3,view=own"});
  ASSERT_EQ(net.displays.size(), 3u);
  EXPECT_EQ(net.displays[0].interface_address, "127.0.0.1");
  EXPECT_EQ(net.displays[0].ttl, 0);
  EXPECT_FALSE(net.displays[0].obeys);
  ASSERT_EQ(net.displays[0].sources.size(), 2u);
  EXPECT_FALSE(net.displays[0].sources[0].own_view);
  EXPECT_TRUE(net.displays[0].sources[1].own_view) << "range B has a range of its own";
  EXPECT_EQ(net.displays[0].make()->channels().size(), 2u);
  EXPECT_EQ(net.displays[1].interface_address, "172.16.2.1");
  EXPECT_EQ(net.displays[1].ttl, 1);
  EXPECT_EQ(net.displays[1].sources[0].radar, 1u);
  EXPECT_GT(net.displays[1].burst, Duration::zero());
  EXPECT_EQ(net.displays[2].ttl, 3);
  EXPECT_TRUE(net.displays[2].sources[0].own_view);
}

TEST(Outputs, WhetherAnEmulatedRadarObeysIsSaidWhereOtherHostsReachIt) {
  const std::string refused =
      refusal_of([] { config_of({"garmin_xhd:interface_address=172.16.2.1"}); });
  EXPECT_THAT(refused, HasSubstr("add obeys: true"));
  EXPECT_THAT(refused, HasSubstr("172.16.2.1"));
  EXPECT_EQ(refusal_of([] { config_of({"garmin_xhd:interface_address=172.16.2.1,obeys=false"}); }),
            "accepted");
  EXPECT_EQ(refusal_of([] { config_of({"garmin_xhd:interface_address=127.0.0.2"}); }), "accepted");
}

// A HALO and a Quantum say where they are, so that any number fits on one address.
TEST(Outputs, RadarsThatAnnounceTheirAddressesKeepOutOfEachOthersWay) {
  const NetConfig net = config_of(
      {"navico_br24", "navico_halo", "navico_halo20", "raymarine_quantum", "raymarine_quantum"});
  std::vector<Ipv4Endpoint> all;
  for (const DisplayOutputConfig& display : net.displays) {
    for (const Ipv4Endpoint& one : display.identity.fixed_addresses) {
      EXPECT_EQ(std::count(all.begin(), all.end(), one), 0) << text_of(one);
    }
    const auto& mine = display.identity.fixed_addresses;
    all.insert(all.end(), mine.begin(), mine.end());
  }
  const NetConfig alone = config_of({"navico_halo"});
  EXPECT_EQ(alone.displays[0].make()->data_address(RangeChannel::a),
            (Ipv4Endpoint{ipv4(236, 6, 7, 8), 6678}))
      << "where displays that do not ask look";
}

TEST(Outputs, AddressesOfAHaloMayBeGiven) {
  const NetConfig net =
      config_of({"navico_halo:addresses=239.255.75.1:7101,addresses=239.255.75.2:7102,"
                 "addresses=239.255.75.3:7103"});
  EXPECT_EQ(net.displays[0].make()->data_address(RangeChannel::a),
            (Ipv4Endpoint{ipv4(239, 255, 75, 1), 7101}));
  EXPECT_THAT(refusal("navico_halo:addresses=239.255.75.1:7101"),
              HasSubstr("addresses are 3 groups"));
  EXPECT_THAT(refusal("navico_halo:addresses=239.255.75:7101"), HasSubstr("as 236.6.7.8:6678"));
  EXPECT_THAT(refusal("navico_halo:addresses=239.255.75.1:71010"), HasSubstr("as 236.6.7.8:6678"));
}

TEST(Outputs, SentencesAreGivenWithTheirPeriods) {
  const NetConfig net = config_of(
      {"nmea0183:port=2947,sentences=hdt=0.1,sentences=vdm=0", "iec61162_450:source=RA0002"});
  ASSERT_EQ(net.navigation_outputs.size(), 2u);
  const NavigationOutputConfig& out = net.navigation_outputs[0];
  EXPECT_EQ(out.port, 2947);
  ASSERT_EQ(out.plan.periods.size(), 2u);
  EXPECT_EQ(out.plan.periods.at(NavigationSentence::hdt), std::chrono::milliseconds(100));
  EXPECT_EQ(net.navigation_outputs[1].transport, NavigationTransport::iec450);
  EXPECT_EQ(net.navigation_outputs[1].source, "RA0002");
  EXPECT_THAT(refusal("nmea0183:sentences=hdt"), HasSubstr("no period"));
  EXPECT_THAT(refusal("nmea0183:sentences=hdt=fast"), HasSubstr("the period is no number"));
}

TEST(Outputs, KeysOfAnotherKindAreRefusedByName) {
  EXPECT_THAT(
      refusal("native:compressed=true"),
      HasSubstr("outputs[0] (native): 'compressed' is not a key of this kind; it takes kind, "
                "radar, interface_address, ttl, address, port, max_datagram, view, spokes, "
                "cells, bits. 'compressed' is a key of cat240"));
  EXPECT_THAT(refusal("navico_4g:radar_b=1"), HasSubstr("add dual_range: true"));
  EXPECT_THAT(refusal("navico_4g:radar=one"), HasSubstr("radar"));
  EXPECT_THAT(refusal("navico_4g:radar=1,radar=2"), HasSubstr("'radar' is given twice"));
  EXPECT_THAT(refusal("navico_4g:serial=12345678901234567"), HasSubstr("more than 16 characters"));
  EXPECT_EQ(parse_output("navico_4g:serial=\"\\]: #").serial(), "\"\\]: #") << "text is text";
}

std::vector<std::string> keys_of_the_schema() {
  std::vector<std::string> keys;
  for (int i = 0; i < app::Output::descriptor()->field_count(); ++i) {
    keys.push_back(app::Output::descriptor()->field(i)->name());
  }
  return keys;
}

TEST(OutputKinds, AreThoseOfTheSchemaAndTakeEachOfItsKeys) {
  const auto& schema = *app::Output::Kind_descriptor();
  ASSERT_EQ(output_kinds().size(), static_cast<std::size_t>(schema.value_count()));
  std::set<std::string> taken;
  for (std::size_t i = 0; i < output_kinds().size(); ++i) {
    const OutputKind& kind = output_kinds()[i];
    EXPECT_EQ(kind.name, schema.value(static_cast<int>(i))->name());
    taken.insert(kind.keys.begin(), kind.keys.end());
  }
  const auto keys = keys_of_the_schema();
  EXPECT_EQ(taken, std::set<std::string>(keys.begin(), keys.end()));
}

// An output of that kind with a value of that key; whether the value is any good does not matter.
app::Output with_key(const std::string& kind, const google::protobuf::FieldDescriptor& key) {
  using google::protobuf::FieldDescriptor;
  app::Output output = parse_output(kind);
  const auto& reflection = *output.GetReflection();
  if (key.is_repeated()) {
    reflection.AddString(&output, &key, "1");
  } else if (key.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    reflection.SetString(&output, &key, "1");
  } else if (key.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) {
    reflection.SetBool(&output, &key, true);
  } else if (key.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
    reflection.SetDouble(&output, &key, 60.0);
  } else if (key.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    reflection.SetEnumValue(&output, &key, 1);
  } else {
    reflection.SetUInt32(&output, &key, 1);
  }
  return output;
}

std::string documentation() {
  std::ifstream page(SKERRY_SOURCE_DIR "/server/displays/README.md");
  return {std::istreambuf_iterator<char>(page), {}};
}

std::string help() {
  testing::internal::CaptureStdout();
  const char* const arguments[] = {"skerryd", "--help"};
  EXPECT_FALSE(read_options(2, arguments));
  return testing::internal::GetCapturedStdout();
}

// A row is enough: configuration, checks, status, help and documentation follow it.
TEST(EmulatedRadars, EachRowIsAnOutputWithItsKeysNumbersHelpAndDocumentation) {
  const std::string manual = documentation(), printed = help();
  const auto& schema = *app::Output::descriptor();
  const std::vector<std::string> common = {"radar", "view", "interface_address", "ttl", "obeys"};
  for (const EmulatedRadar& radar : emulated_radars()) {
    const std::string name(radar.name);
    SCOPED_TRACE(name);
    const NetConfig net = config_of({name, name});
    ASSERT_EQ(net.displays.size(), 2u);
    for (const DisplayOutputConfig& display : net.displays) {
      EXPECT_EQ(display.name, name) << "its name in the status";
      EXPECT_EQ(display.burst, radar.burst);
      EXPECT_THAT(display.make()->channels(), Not(IsEmpty()));
      EXPECT_THAT(display.identity.fixed_addresses, Not(IsEmpty()));
    }
    EXPECT_EQ(net.displays[0].identity.fixed_addresses == net.displays[1].identity.fixed_addresses,
              radar.fixed_addresses)
        << "two on one host are in each other's way if displays know the addresses beforehand";
    for (int i = 0; i < schema.field_count(); ++i) {
      const std::string& key = schema.field(i)->name();
      if (key == "kind" || std::count(common.begin(), common.end(), key) > 0) continue;
      const std::string outcome =
          refusal_of([&] { config_with({with_key(name, *schema.field(i))}); });
      const bool takes = std::count(radar.keys.begin(), radar.keys.end(), key) > 0;
      EXPECT_EQ(outcome.find("is not a key of this kind") == std::string::npos, takes) << outcome;
    }
    EXPECT_THAT(printed, HasSubstr(name));
    EXPECT_THAT(manual, HasSubstr("`" + name + "`"));
    for (const std::string_view key : radar.keys) {
      EXPECT_THAT(manual, HasSubstr("`" + std::string(key) + "`"));
    }
  }
}

}  // namespace
}  // namespace skerry::server
