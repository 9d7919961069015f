// What decoding a second of a radar costs the page, beside what it would cost to have it decoded in a worker: the messages
// would be handed over, which is as much work again. Ratios hold on a busy machine, too; medians.
//   node decode_cost.mjs [rounds]
import { decodeFrames } from '../../../clients/web/src/messages.js';
import { ScanStore } from '../../../clients/web/src/scan_store.js';
import { ServerMessage } from './mock_server.mjs';

const SPOKES_PER_SECOND = 1638, CELLS = 1024, BATCH = 16;  // 24 rpm of 4096 spokes
const rounds = Number(process.argv[2] ?? 40);
const median = (list) => list.sort((a, b) => a - b)[list.length >> 1];

const spoke = (index) => ({
  radar: 0, view: 0, sequence: index, scan: 3, index, spokesPerTurn: 4096, rangeScale: 6, bits: 8, cellCount: CELLS, cellSizeM: 10.8,
  heading: 12345678, latitudeDeg: 60, longitudeDeg: 5, utcNs: 1.7e18, scenarioNs: 1e9, cells: new Uint8Array(CELLS).map((_, cell) => cell),
});
const frames = Array.from({ length: Math.floor(SPOKES_PER_SECOND / BATCH) }, (_, batch) => Buffer.concat(Array.from({ length: BATCH },
  (_u, k) => Buffer.from(ServerMessage.encodeDelimited(ServerMessage.fromObject({ spoke: spoke(batch * BATCH + k) })).finish()))));

const took = { decode: [], handOver: [], keep: [] };
const time = (what, run) => {
  const from = performance.now(), made = run();
  took[what].push(performance.now() - from);
  return made;
};
const store = new ScanStore();
for (let round = 0; round < rounds; ++round) {
  const received = frames.map((frame) => new Uint8Array(frame));
  const decoded = time('decode', () => received.map((bytes) => {
    const messages = [];
    decodeFrames(bytes, (message) => messages.push(message));
    return messages;
  }));
  const arrived = time('handOver', () => decoded.map((messages, i) => structuredClone(messages, { transfer: [received[i].buffer] })));
  time('keep', () => arrived.flat().forEach((message) => store.put(message.spoke, 100 + round, true)));
}
const [decode, handOver, keep] = ['decode', 'handOver', 'keep'].map((what) => median(took[what]));
console.log(`a second of spokes: decoded in ${decode.toFixed(1)} ms; handed over by a worker in ${handOver.toFixed(1)} ms, both sides (${(handOver / decode).toFixed(2)} times that); ` +
  `put into the picture's memory in ${keep.toFixed(1)} ms`);
