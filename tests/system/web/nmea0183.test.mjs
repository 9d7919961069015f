// NMEA 0183 of the real server, read by Signal K's own parser. SKERRYD names the program.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

const Parser = createRequire(import.meta.url)('@signalk/nmea0183-signalk');
if (!process.env.SKERRYD) throw new Error('SKERRYD must name the program to test, such as build/bin/skerryd');

const KNOT = 1852 / 3600, DEG = Math.PI / 180;
const near = (value, expected, tolerance, what) =>
  assert.ok(Math.abs(value - expected) <= tolerance, `${what}: ${value}, expected ${expected}`);

let folder, server, plain, tagged;
// The parser's results, by sentence or, of AIS, by context; and the lines it did not know.
const heard = { own: {}, ais: {}, tagged: {}, unknown: new Set() };

function take(parser, line, into) {
  const delta = parser.parse(line);
  if (!delta) {
    if (!line.includes('!')) heard.unknown.add(line.slice(3, 6));
    return;
  }
  for (const { source, values } of delta.updates) {
    const target = source.sentence === 'VDM' ? (heard.ais[delta.context] ??= {}) : (into[source.sentence] ??= {});
    for (const { path, value } of values) {
      if (path === '') Object.assign(target, value);
      else target[path] = value;
    }
  }
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-nmea-'));
  plain = createSocket('udp4').bind(0, '127.0.0.1');
  tagged = createSocket('udp4').bind(0, '127.0.0.1');
  await Promise.all([once(plain, 'listening'), once(tagged, 'listening')]);
  const write = (name, text) => {
    writeFileSync(join(folder, name), text);
    return join(folder, name);
  };
  const scenario = write('scenario.yaml', `
name: Navigation
own_ships:
  - {name: Tern, mmsi: 257000111, position: {lat: 60.425, lon: 5.040}, course_deg: 335, speed_kn: 12,
     radars: [{name: Radar, spokes: 512, cells: 512, bits: 8, rpm: 60, range_nm: 6}]}
targets:
  - {name: Tanker, mmsi: 257000222, ship_type: tanker, position: {lat: 60.445, lon: 5.020}, course_deg: 160,
     speed_kn: 10, length_m: 182, beam_m: 32, height_m: 22}
  - {name: Angler, kind: small_craft, mmsi: 257000224, position: {lat: 60.43, lon: 5.03}}
  - {name: Hjeltefjorden north, kind: reflector_buoy, mmsi: 992570001, position: {lat: 60.4840, lon: 5.0190}}
`);
  const config = write('server.yaml', `
exact_sensors: true
outputs:
  - {kind: nmea0183, port: ${plain.address().port}, static_period_s: 1, sentences: [rmc=0.2, gga=0.2, vtg=0.2,
     zda=0.2, hdt=0.2, ths=0.2, rot=0.2, vhw=0.2, vbw=0.2, rsd=0.2, osd=0.2, vdm=0.2, ttm=0.2, tll=0.2, ttd=0.2], targets: truth}
  - {kind: iec61162_450, address: 127.0.0.1, port: ${tagged.address().port}, source: HE0042, static_period_s: 1,
     sentences: [hdt=0.2, rmc=0.2, vdm=0.2]}
`);
  const parser = new Parser(), tagParser = new Parser();
  plain.on('message', (data) => {
    for (const line of data.toString('latin1').split('\r\n').filter(Boolean)) take(parser, line, heard.own);
  });
  tagged.on('message', (data) => {
    assert.equal(data.subarray(0, 6).toString('latin1'), 'UdPbC\0');
    for (const line of data.subarray(6).toString('latin1').split('\r\n').filter(Boolean)) {
      assert.match(line, /^\\(g:\d-\d-\d+,)?s:HE0042,n:\d+\*[0-9A-F]{2}\\[$!]/);
      take(tagParser, line, heard.tagged);
    }
  });
  server = spawn(process.env.SKERRYD, ['--tcp-port', '0', '--http-port', '0', '--no-udp', '--no-cat240',
    '--scenario', scenario, '--config', config]);
  let log = '';
  server.stderr.on('data', (data) => { log = (log + data).slice(-4000); });
  const all = () => ['RMC', 'GGA', 'VTG', 'ZDA', 'HDT', 'ROT', 'VHW'].every((name) => heard.own[name]) &&
    ['257000222', '257000224', '992570001'].every((mmsi) =>
      Object.values(heard.ais).some((one) => one.mmsi === mmsi && one['navigation.position'] && one.name)) &&
    heard.tagged.HDT && heard.tagged.RMC && heard.unknown.size > 0;
  const exited = once(server, 'exit');
  for (const end = Date.now() + 120000; !all();) {
    assert.equal(server.exitCode, null, `skerryd ended:\n${log}`);
    assert.ok(Date.now() < end, `not all came: ${JSON.stringify(heard)}\n${log}`);
    await Promise.race([once(plain, 'message'), exited]);
  }
}, { timeout: 180000 });

after(async () => {
  if (server && server.exitCode === null) {
    server.kill('SIGINT');
    await once(server, 'exit');
  }
  plain?.close();
  tagged?.close();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

test('own ship is where she is, heads and goes where she does', () => {
  const { RMC, GGA, VTG, ZDA, HDT, ROT, VHW } = heard.own;
  for (const position of [RMC['navigation.position'], GGA['navigation.position']]) {
    near(position.latitude, 60.425, 0.05, 'latitude');
    near(position.longitude, 5.04, 0.05, 'longitude');
  }
  for (const motion of [RMC, VTG]) {
    near(motion['navigation.courseOverGroundTrue'], 335 * DEG, 0.1 * DEG, 'course');
    near(motion['navigation.speedOverGround'], 12 * KNOT, 0.01, 'speed');
  }
  near(HDT['navigation.headingTrue'], 335 * DEG, 0.01 * DEG, 'heading');
  near(VHW['navigation.headingTrue'], 335 * DEG, 0.01 * DEG, 'heading of the log');
  near(VHW['navigation.speedThroughWater'], 12 * KNOT, 0.01, 'speed through the water');
  near(ROT['navigation.rateOfTurn'], 0, 1e-4, 'rate of turn');
  assert.equal(GGA['navigation.gnss.methodQuality'], 'GNSS Fix');
  for (const { 'navigation.datetime': time } of [RMC, ZDA]) {
    near(Date.parse(time), Date.now(), 10 * 60000, 'date and time');
  }
});

test('AIS has ships, boats and marks as they are', () => {
  const by = (mmsi) => Object.values(heard.ais).find((one) => one.mmsi === mmsi);
  const tanker = by('257000222');
  assert.equal(tanker.name, 'TANKER');
  near(tanker['navigation.speedOverGround'], 10 * KNOT, 0.03, 'speed');
  near(tanker['navigation.courseOverGroundTrue'], 160 * DEG, 0.1 * DEG, 'course');
  assert.equal(tanker['sensors.ais.class'], 'A');
  assert.equal(tanker['design.length'].overall, 182);
  assert.equal(tanker['design.beam'], 32);
  assert.equal(tanker['design.aisShipType'].id, 80);
  const boat = by('257000224');
  assert.equal(boat.name, 'ANGLER');
  assert.equal(boat['sensors.ais.class'], 'B');
  const mark = by('992570001');
  assert.equal(mark.name, 'HJELTEFJORDEN NORTH');
  assert.equal(mark['sensors.ais.class'], 'ATON');
  near(mark['navigation.position'].latitude, 60.484, 2e-6, 'latitude of the mark');
});

test('IEC 61162-450 has the same behind its TAG blocks', () => {
  near(heard.tagged.HDT['navigation.headingTrue'], 335 * DEG, 0.01 * DEG, 'heading');
  near(heard.tagged.RMC['navigation.position'].latitude, 60.425, 0.05, 'latitude');
});

test('the parser refuses no sentence that it knows', () => {
  for (const name of heard.unknown) assert.ok(['THS', 'VBW', 'RSD', 'OSD', 'TTM', 'TLL'].includes(name), name);
});
