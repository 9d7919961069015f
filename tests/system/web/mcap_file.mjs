// Recordings as an independent reader sees them: @mcap/core, which checks every CRC, and protobufjs with
// the schemas that the file itself holds. Packed spokes are unpacked as protocol/RECORDING.md says, by
// none of the project's own code.
import { createRequire } from 'node:module';
import { open, readFile } from 'node:fs/promises';
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { decompress as zstd } from 'fzstd';
import protobuf from 'protobufjs';

const require = createRequire(import.meta.url);
const lz4 = require('lz4js');
const descriptor = require('protobufjs/ext/descriptor');

const decompressHandlers = {
  lz4: (bytes, size) => Uint8Array.from(lz4.decompress(bytes, Number(size))),
  zstd: (bytes, size) => zstd(bytes, new Uint8Array(Number(size))),
};

// Reads by the index: { reader, messages: [{ topic, schema, time, data }] in the order of time, attachments }.
export async function readByIndex(path) {
  const file = await open(path);
  try {
    const readable = {
      size: async () => BigInt((await file.stat()).size),
      read: async (offset, length) => {
        const bytes = new Uint8Array(Number(length));
        const { bytesRead } = await file.read(bytes, 0, bytes.length, Number(offset));
        if (bytesRead !== bytes.length) throw new Error(`${bytesRead} of ${bytes.length} bytes at ${offset}`);
        return bytes;
      },
    };
    const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
    const messages = [], attachments = [];
    for await (const { channelId, logTime, data } of reader.readMessages({ validateCrcs: true })) {
      const channel = reader.channelsById.get(channelId);
      messages.push({ topic: channel.topic, schema: channel.schemaId, time: logTime, data });
    }
    for await (const attachment of reader.readAttachments({ validateCrcs: true })) attachments.push(attachment);
    return { reader, messages, attachments };
  } finally {
    await file.close();
  }
}

// From the begin to the end, as a pipe would be read: the kinds of records, in order.
export async function readAsStream(path) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true, includeChunks: true });
  reader.append(await readFile(path));
  const records = [];
  for (let record; (record = reader.nextRecord());) records.push(record);
  return { records, done: reader.done() };
}

// schema id: the protobufjs type of its messages, made of the file's own FileDescriptorSet.
export function typesOf(reader) {
  const types = new Map();
  for (const [id, schema] of reader.schemasById) {
    if (schema.encoding !== 'protobuf') throw new Error(`schema ${schema.name} is ${schema.encoding}`);
    const root = protobuf.Root.fromDescriptor(descriptor.FileDescriptorSet.decode(schema.data));
    root.resolveAll();
    types.set(id, root.lookupType(schema.name));
  }
  return types;
}

class Varints {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  next() {
    let value = 0n;
    for (let shift = 0n; ; shift += 7n) {
      const byte = this.bytes[this.at++];
      value |= BigInt(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
  }
}

const RADAR = 0, VIEW = 1, SEQUENCE = 2, SCAN = 3, INDEX = 4, SPOKES_PER_TURN = 5, CELL_SIZE = 9, HEADING = 10, LATITUDE = 11, LONGITUDE = 12,
  UTC = 13, SCENARIO = 14, FIELDS = 15;
const LINEAR = [HEADING, LATITUDE, LONGITUDE, UTC, SCENARIO];
const ORDER = [RADAR, VIEW, SEQUENCE, INDEX, SCAN, SPOKES_PER_TURN, 6, 7, 8, CELL_SIZE, HEADING, LATITUDE, LONGITUDE, UTC, SCENARIO];
const wrap = (value) => BigInt.asUintN(64, value);

function foretold(field, spoke, b, a) {
  if (field === SEQUENCE) return b[SEQUENCE] + 1n;
  if (field === INDEX) return b[INDEX] + 1n === b[SPOKES_PER_TURN] ? 0n : b[INDEX] + 1n;
  if (field === SCAN) return spoke[INDEX] < b[INDEX] ? b[SCAN] + 1n : b[SCAN];
  return LINEAR.includes(field) ? 2n * b[field] - a[field] : b[field];
}

function rowsOf(differences, count, width) {
  const rows = Array.from({ length: count }, () => new Uint8Array(width));
  const at = (row, column) => (row < 0 || column < 0 ? 0 : rows[row][column]);
  for (let j = 0; j < width; ++j) {
    for (let i = 0; i < count; ++i) {
      const w = at(i, j - 1), n = at(i - 1, j), d = at(i - 1, j - 1);
      const median = Math.max(Math.min(w, n), Math.min(Math.max(w, n), w + n - d));
      rows[i][j] = differences[j * count + i] + median;
    }
  }
  return rows;
}

// The bytes of a wire::Spoke: the fields in their order, those that are 0 left out.
function spokeBytes(numbers, cells, doppler) {
  const writer = protobuf.Writer.create();
  numbers.forEach((value, i) => {
    if (value === 0n) return;
    const long = protobuf.util.Long.fromBits(Number(value & 0xffffffffn), Number(value >> 32n), true);
    if (i === HEADING) writer.uint32(((i + 1) << 3) | 5).fixed32(Number(value));
    else if (i === CELL_SIZE || i > HEADING) writer.uint32(((i + 1) << 3) | 1).fixed64(long);
    else writer.uint32((i + 1) << 3).uint64(long);
  });
  if (cells.length > 0) writer.uint32((16 << 3) | 2).bytes(cells);
  if (doppler.length > 0) writer.uint32((17 << 3) | 2).bytes(doppler);
  return writer.finish();
}

// The bytes of each of `count` spokes.
export function unpackSpokes({ count, data }) {
  const head = new Varints(data);
  const cellBytes = Number(head.next()), dopplerBytes = Number(head.next()), numberBytes = Number(head.next());
  const numbers = new Varints(data.subarray(head.at, head.at + numberBytes));
  const video = data.subarray(head.at + numberBytes);
  const cells = rowsOf(video.subarray(0, count * cellBytes), count, cellBytes);
  const doppler = rowsOf(video.subarray(count * cellBytes), count, dopplerBytes);
  let b = Array(FIELDS).fill(0n), a = b;
  const spokes = [];
  for (let i = 0; i < count; ++i) {
    const mask = numbers.next();
    const spoke = Array(FIELDS).fill(0n);
    for (const field of ORDER) {
      let difference = 0n;
      if ((mask >> BigInt(field)) & 1n) {
        const z = numbers.next();
        difference = z & 1n ? -(z >> 1n) - 1n : z >> 1n;
      }
      spoke[field] = wrap(foretold(field, spoke, b, a) + difference);
    }
    [a, b] = [b, spoke];
    spokes.push(spokeBytes(spoke, cells[i], doppler[i]));
  }
  if (numbers.at !== numberBytes) throw new Error(`${numbers.at} of ${numberBytes} bytes of numbers`);
  return spokes;
}
