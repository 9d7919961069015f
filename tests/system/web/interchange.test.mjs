// Recordings exported for Foxglove and ROS 2, read by @mcap/core with nothing of the project's own: the schemas
// in the files against those that Foxglove and ROS publish, field by field, and the values against the recording.
// SKERRYD and SKERRY name the two programs.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { existsSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import { PNG } from 'pngjs';
import protobuf from 'protobufjs';
import { readByIndex, typesOf } from './mcap_file.mjs';

const require = createRequire(import.meta.url);
const { generateProto, foxgloveMessageSchemas, foxgloveEnumSchemas } = require('@foxglove/schemas/internal');
const { ros2humble } = require('@foxglove/rosmsg-msgs-common');

for (const name of ['SKERRYD', 'SKERRY']) {
  if (!process.env[name])
    throw new Error(`${name} must name the program to test, such as build/bin/${name.toLowerCase()}`);
}
const HALO20 = fileURLToPath(new URL('../../../../shared/data/radar/halo20-ranges.pcap.gz', import.meta.url));

const SCENARIO = `name: Small
own_ships:
  - name: Tern
    position: {lat: 60.425, lon: 5.040}
    course_deg: 335
    speed_kn: 12
    radars:
      - {name: Radar, spokes: 512, cells: 512, rpm: 60, range_nm: 6}
targets:
  - {name: Tanker, position: {lat: 60.445, lon: 5.020}, course_deg: 160, speed_kn: 10, length_m: 182}
  - {name: Ferry, position: {lat: 60.42, lon: 5.03}, course_deg: 80, speed_kn: 11}
`;

let folder, recording;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-interchange-'));
  recording = await recorded();
});
after(() => folder && rmSync(folder, { recursive: true }));

function run(program, args) {
  return new Promise((resolve, reject) => {
    const child = spawn(program, args);
    let text = '';
    for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => { text += data; });
    child.on('error', reject);
    child.on('exit', (code) => (code === 0 ? resolve(text)
      : reject(new Error(`${program} ${args.join(' ')}: ${code}\n${text}`))));
  });
}

// Four turns of it, in as many seconds.
async function recorded() {
  const into = join(folder, 'recorded');
  writeFileSync(join(folder, 'small.yaml'), SCENARIO);
  const server = spawn(process.env.SKERRYD, [
    '--tcp-port', '0', '--http-port', '0', '--no-udp', '--no-cat240', '--print-ports',
    '--scenario', join(folder, 'small.yaml'), '--record', '--record-folder', into]);
  let log = '';
  server.stderr.on('data', (data) => { log = (log + data).slice(-4000); });
  const ended = new Promise((resolve) => server.on('exit', resolve));
  await new Promise((resolve, reject) => {
    server.on('exit', (code) => reject(new Error(`skerryd ended with ${code}:\n${log}`)));
    server.stdout.on('data', (data) => /tcp \d+/.test(data) && resolve());
  });
  await new Promise((resolve) => { setTimeout(resolve, 5000); });
  server.kill('SIGTERM');
  await ended;
  return join(into, readdirSync(into).find((file) => file.endsWith('.mcap')));
}

async function exported(tool, source = recording) {
  const path = join(folder, `${tool}${source === recording ? '' : '-capture'}.mcap`);
  await run(process.env.SKERRY, ['recording', 'export', source, '--for', tool, '-o', path, '--force', '--size', '512']);
  return readByIndex(path);
}

const byTopic = ({ messages }, topic) => messages.filter((message) => message.topic === topic);
const ns = ({ seconds, nanos }) => BigInt(seconds.toString()) * 1000000000n + BigInt(nanos ?? 0);
const rosNs = ({ sec, nanosec, nsec }) => BigInt(sec) * 1000000000n + BigInt(nanosec ?? nsec);

// The recording's own messages of radar 0.
async function source() {
  const file = await readByIndex(recording);
  const types = typesOf(file.reader);
  return (topic) => byTopic(file, topic).map(({ time, schema, data }) => ({ time,
    ...types.get(schema).toObject(types.get(schema).decode(data), { defaults: true }) }));
}

test('Foxglove: every field of a schema has the number, type and label that Foxglove publishes', async (t) => {
  const { reader } = await exported('foxglove');
  const types = typesOf(reader);
  assert.deepEqual([...reader.channelsById.values()]
    .map(({ topic, messageEncoding }) => `${topic} ${messageEncoding}`).sort(),
    ['/radar_0/position protobuf', '/radar_0/ppi protobuf', '/radar_0/ships protobuf']);
  let fields = 0;
  for (const type of types.values()) {
    const published = foxgloveMessageSchemas[type.name];
    assert.equal(type.fullName, `.foxglove.${type.name}`);
    const theirs = protobuf.parse(generateProto(published, Object.values(foxgloveEnumSchemas)
      .filter(({ parentSchemaName }) => parentSchemaName === type.name)),
      { keepCase: true }).root.lookupType(`foxglove.${type.name}`);
    for (const field of type.fieldsArray) {
      const other = theirs.fields[field.name];
      assert.ok(other, `${type.name}.${field.name}`);
      assert.equal(field.id, other.id, field.name);
      assert.equal(field.repeated, other.repeated, field.name);
      assert.equal(field.type.split('.').at(-1), other.type.split('.').at(-1), field.name);
      ++fields;
    }
    for (const own of type.nestedArray.filter((nested) => nested instanceof protobuf.Enum)) {
      assert.deepEqual({ ...own.values }, { ...theirs.nested[own.name].values }, own.name);
    }
  }
  assert.equal(types.size, 3);
  t.diagnostic(`${fields} fields of ${types.size} schemas`);
});

test('Foxglove: pictures, positions and tracks are those of the recording', async (t) => {
  const file = await exported('foxglove');
  const types = typesOf(file.reader);
  const decoded = (topic) => byTopic(file, topic)
    .map(({ time, schema, data }) => ({ time, ...types.get(schema).decode(data) }));
  const of = await source();

  const fixes = decoded('/radar_0/position'), ships = of('radar/0/own_ship');
  assert.ok(fixes.length >= 3 && fixes.length <= ships.length);
  fixes.forEach((fix, i) => {
    assert.equal(fix.latitude, ships[i].latitude_deg);
    assert.equal(fix.longitude, ships[i].longitude_deg);
    assert.ok(Math.abs(fix.heading - ships[i].heading_deg * Math.PI / 180) < 1e-12);
    assert.equal(fix.time, ships[i].time);
    assert.equal(ns(fix.timestamp), fix.time);
    assert.equal(fix.frame_id, 'radar_0');
  });

  const images = decoded('/radar_0/ppi');
  assert.ok(images.length >= 3);
  for (const image of images) {
    assert.equal(image.format, 'png');
    assert.equal(ns(image.timestamp), image.time);
    const { width, height, data } = PNG.sync.read(Buffer.from(image.data));
    assert.deepEqual([width, height], [512, 512]);
    assert.ok(new Set(new Uint32Array(data.buffer, data.byteOffset, data.length / 4)).size > 20,
      'the picture has echoes');
  }

  const tracks = decoded('/radar_0/ships').map(({ geojson }) => JSON.parse(geojson));
  const last = tracks.at(-1).features, points = last.filter(({ geometry }) => geometry.type === 'Point');
  const traffic = of('traffic').at(-1).items.filter(({ radars }) => !radars.includes(0));
  assert.equal(points.length, traffic.length + 1);
  const own = points.find(({ properties }) => properties.own_ship);
  assert.equal(own.properties.name, ships[0].name);
  for (const { name, mmsi } of traffic)
    assert.ok(points.some(({ properties }) => properties.name === name && (properties.mmsi ?? 0) === mmsi), name);
  const [first] = last.filter(({ geometry, properties }) => geometry.type === 'LineString' && properties.own_ship);
  assert.deepEqual(first.geometry.coordinates[0], [ships[0].longitude_deg, ships[0].latitude_deg]);
  t.diagnostic(`${images.length} pictures, ${fixes.length} positions, ${points.length} ships`);
});

// As marine_sensor_msgs 2.1.0 has it; the others are in @foxglove/rosmsg-msgs-common.
const RADAR = {
  'marine_sensor_msgs/RadarSector': ['std_msgs/Header header', 'float32 angle_start', 'float32 angle_increment',
    'duration time_increment',
    'duration scan_time', 'float32 range_min', 'float32 range_max', 'marine_sensor_msgs/RadarEcho[] intensities'],
  'marine_sensor_msgs/RadarEcho': ['float32[] echoes'],
};
const fieldTexts = (definitions) => definitions.map(({ type, name, isArray, arrayLength, isConstant, value }) =>
  `${type}${isArray ? `[${arrayLength ?? ''}]` : ''} ${name}${isConstant ? `=${value}` : ''}`);
const unqualified = (name) => name?.replace('/msg/', '/');

test('ROS 2: every field of every definition is as ROS publishes it', async (t) => {
  const { reader } = await exported('ros2');
  assert.equal(reader.header.profile, 'ros2');
  const channels = [...reader.channelsById.values()].map(({ topic, messageEncoding, schemaId }) => {
    const { name, encoding } = reader.schemasById.get(schemaId);
    return `${topic} ${name} ${messageEncoding} ${encoding}`;
  }).sort();
  assert.deepEqual(channels, ['/radar_0/position sensor_msgs/msg/NavSatFix cdr ros2msg',
    '/radar_0/sectors marine_sensor_msgs/msg/RadarSector cdr ros2msg', '/tf tf2_msgs/msg/TFMessage cdr ros2msg']);
  const compared = new Set();
  for (const { name, data } of reader.schemasById.values()) {
    for (const definition of parse(new TextDecoder().decode(data), { ros2: true })) {
      const type = unqualified(definition.name ?? name);
      const published = RADAR[type] ?? fieldTexts((ros2humble[type] ?? assert.fail(type)).definitions);
      assert.deepEqual(fieldTexts(definition.definitions).map(unqualified).sort(), [...published].sort(), type);
      if (!type.endsWith('NavSatStatus') && !type.endsWith('NavSatFix'))
        assert.deepEqual(fieldTexts(definition.definitions).map(unqualified), published, type);
      compared.add(type);
    }
  }
  assert.ok(compared.has('geometry_msgs/Quaternion') && compared.has('marine_sensor_msgs/RadarEcho'));
  t.diagnostic([...compared].join(', '));
});

test('ROS 2: sectors, positions and headings are those of the recording', async (t) => {
  const file = await exported('ros2');
  const readers = new Map([...file.reader.schemasById]
    .map(([id, { data }]) => [id, new MessageReader(parse(new TextDecoder().decode(data), { ros2: true }))]));
  const decoded = (topic) => byTopic(file, topic)
    .map(({ time, schema, data }) => ({ time, ...readers.get(schema).readMessage(data) }));
  const of = await source();

  const spokes = of('radar/0/view/0/spokes');
  let next = 0;
  const sectors = decoded('/radar_0/sectors');
  for (const sector of sectors) {
    const first = spokes[next];
    assert.equal(rosNs(sector.header.stamp), first.time);
    assert.equal(sector.header.frame_id, 'radar_0');
    const step = -2 * Math.PI / first.spokes_per_turn;
    assert.ok(Math.abs(sector.angle_increment - step) < 1e-9);
    assert.ok(Math.abs(sector.angle_start - first.index * step) < 1e-6);
    assert.ok(Math.abs(sector.range_min - first.cell_size_m / 2) < 1e-3 &&
      Math.abs(sector.range_max - first.cell_size_m * (first.cell_count - 0.5)) < 1e-2);
    assert.ok(Math.abs(Number(rosNs(sector.scan_time)) / 1e9 - 1) < 0.01, `${Number(rosNs(sector.scan_time))}`);
    for (const { echoes } of sector.intensities) {
      assert.deepEqual(Array.from(echoes), Array.from(spokes[next].cells));
      ++next;
    }
  }
  assert.equal(next, spokes.length);

  const ships = of('radar/0/own_ship');
  const fixes = decoded('/radar_0/position'), turns = decoded('/tf');
  assert.ok(fixes.length >= 3 && fixes.length === turns.length);
  fixes.forEach((fix, i) => {
    assert.deepEqual([fix.latitude, fix.longitude], [ships[i].latitude_deg, ships[i].longitude_deg]);
    assert.ok(Number.isNaN(fix.altitude));
    assert.deepEqual([fix.position_covariance_type, fix.status.status, fix.status.service], [0, 0, 1]);
    const { header, child_frame_id: child, transform: { rotation } } = turns[i].transforms[0];
    assert.deepEqual([header.frame_id, child], ['radar_0_enu', 'radar_0']);
    // What points over the bow in radar_0 points there in radar_0_enu: east, north.
    const bow = [1 - 2 * rotation.z ** 2, 2 * rotation.z * rotation.w], heading = ships[i].heading_deg * Math.PI / 180;
    assert.ok(Math.hypot(bow[0] - Math.sin(heading), bow[1] - Math.cos(heading)) < 1e-12);
  });
  t.diagnostic(`${sectors.length} sectors of ${next} spokes, ${fixes.length} positions`);
});

test('ROS 2: no spoke of a HALO20 is lost where its capture has gaps and ranges change', {
  skip: existsSync(HALO20) ? false : 'no captures of real radars beside the repository',
}, async () => {
  const capture = join(folder, 'halo20.mcap');
  await run(process.env.SKERRY, ['recording', 'import', HALO20, '-o', capture]);
  const file = await exported('ros2', capture);
  const id = file.messages[0].schema;
  const reader = new MessageReader(parse(new TextDecoder().decode(file.reader.schemasById.get(id).data),
    { ros2: true }));
  let spokes = 0;
  for (const { data } of byTopic(file, '/radar_0/sectors')) spokes += reader.readMessage(data).intensities.length;
  assert.equal(spokes, 43874);
});

test('what cannot be exported is said, and no file is left', async () => {
  for (const [args, why] of [[['--for', 'foxglove', '--radar', '7'], /no spokes of radar 7/],
    [['--for', 'ros2', '--view', '9'], /no spokes of radar 0 view 9/],
    [['--for', 'ros2', '--csv'], /exactly one/], [['--for', 'rviz'], /foxglove/]]) {
    const path = join(folder, 'nothing.mcap');
    await assert.rejects(run(process.env.SKERRY, ['recording', 'export', recording, ...args, '-o', path]), why);
    assert.ok(!readdirSync(folder).some((file) => file.startsWith('nothing')));
  }
});
