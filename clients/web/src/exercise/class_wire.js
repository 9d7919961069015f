// The messages of protocol/wire/class_codes.proto: codes by which a class signs in.
import { message, Writer } from '../protobuf.js';

const ClassCode = message({
  1: ['ship', 'string'],
  2: ['code', 'string'],
  3: ['endsUtcNs', 'fixed64'],
  4: ['trainees', ['string']],
  5: ['wrong', 'uint32'],
  6: ['wrongMost', 'uint32'],
});
export const ClassList = message({ 1: ['codes', [ClassCode]] });

// order: { make: { ship, minutes } }, { end: ship }, or {}: what there is.
export function encodeClassOrderBody({ make, end }, token) {
  const writer = new Writer();
  if (make) writer.bytes(1, new Writer().string(1, make.ship).uint32(2, make.minutes).finish());
  else if (end !== undefined) writer.string(2, end);
  if (token) writer.string(3, token);
  return writer.finish();
}
