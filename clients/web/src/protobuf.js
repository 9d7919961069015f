// The protobuf wire format: bytes <-> fields, and the tables that turn fields into messages.
// Everything read here comes from outside: every length is checked before it is believed, and the
// only error ever thrown is WireError.

export class WireError extends Error {
  // kind: 'truncated' | 'oversized' | 'malformed' | 'out_of_range'; offset: byte within the input.
  constructor(kind, offset, text) {
    super(`${kind} at byte ${offset}: ${text}`);
    this.name = 'WireError';
    this.kind = kind;
    this.offset = offset;
  }
}

const VARINT = 0, FIXED64 = 1, LENGTH = 2, GROUP_START = 3, GROUP_END = 4, FIXED32 = 5;
const MAX_GROUP_DEPTH = 32;
// Messages of one repeated field: the ships of an exercise are the most.  Numbers are bounded by their frame.
const MAX_REPEATED = 8192;
const utf8 = new TextDecoder('utf-8', { fatal: true });
const utf8Encoder = new TextEncoder();

export class Reader {
  constructor(bytes, begin = 0, end = bytes.length) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = begin;
    this.end = end;
  }

  done() {
    return this.at >= this.end;
  }

  need(count) {
    if (count > this.end - this.at) {
      throw new WireError('truncated', this.at, `${count} bytes wanted, ${this.end - this.at} left`);
    }
  }

  // Both halves of a varint, as unsigned 32-bit numbers.
  varint() {
    let low = 0, high = 0;
    for (let i = 0; i < 10; ++i) {
      this.need(1);
      const byte = this.bytes[this.at++];
      const bits = byte & 0x7f;
      if (i < 4) low |= bits << (7 * i);
      else if (i === 4) { low |= bits << 28; high = bits >>> 4; }
      else if (i < 9) high |= bits << (7 * i - 32);
      else if (bits > 1) throw new WireError('malformed', this.at - 1, 'varint above 64 bits');
      else high |= bits << 31;
      if (byte < 0x80) return { low: low >>> 0, high: high >>> 0 };
    }
    throw new WireError('malformed', this.at, 'varint of more than 10 bytes');
  }

  // A longer varint in a 32-bit field keeps its low bits, as protobuf has it.
  uint32() {
    return this.varint().low;
  }

  // Zigzag: small numbers of either sign are short.
  sint32() {
    const { low } = this.varint();
    return (low >>> 1) ^ -(low & 1);
  }

  // Exact, or refused: no JavaScript number is exact above 2^53.
  uint64() {
    const at = this.at;
    const { low, high } = this.varint();
    if (high > 0x1fffff) throw new WireError('out_of_range', at, 'number above 2^53');
    return high * 4294967296 + low;
  }

  fixed32() {
    this.need(4);
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }

  // Error: up to 2^-53 of the value.
  fixed64() {
    this.need(8);
    this.at += 8;
    return this.view.getUint32(this.at - 4, true) * 4294967296 + this.view.getUint32(this.at - 8, true);
  }

  double() {
    this.need(8);
    this.at += 8;
    return this.view.getFloat64(this.at - 8, true);
  }

  // End of the length-delimited field that begins here.
  limit() {
    const at = this.at;
    const { low, high } = this.varint();
    if (high !== 0 || low > this.end - this.at) {
      throw new WireError('truncated', at, `length ${high * 4294967296 + low} in ${this.end - this.at} bytes`);
    }
    return this.at + low;
  }

  skip(wireType, field, depth = 0) {
    switch (wireType) {
      case VARINT: this.varint(); return;
      case FIXED64: this.need(8); this.at += 8; return;
      case LENGTH: this.at = this.limit(); return;
      case FIXED32: this.need(4); this.at += 4; return;
      case GROUP_START:
        if (depth >= MAX_GROUP_DEPTH) throw new WireError('malformed', this.at, 'groups too deep');
        for (;;) {
          const tag = this.tag();
          if (tag.wireType === GROUP_END) {
            if (tag.field !== field) throw new WireError('malformed', this.at, 'group ends another');
            return;
          }
          this.skip(tag.wireType, tag.field, depth + 1);
        }
      default: throw new WireError('malformed', this.at, `wire type ${wireType}`);
    }
  }

  tag() {
    const at = this.at;
    const { low, high } = this.varint();
    const field = low >>> 3;
    if (high !== 0 || field === 0) throw new WireError('malformed', at, 'no field number');
    return { field, wireType: low & 7 };
  }
}

// How a scalar type is read, what it is when absent, and its wire type.
const SCALARS = {
  uint32: { wireType: VARINT, zero: 0, read: (r) => r.uint32() },
  sint32: { wireType: VARINT, zero: 0, read: (r) => r.sint32() },
  uint64: { wireType: VARINT, zero: 0, read: (r) => r.uint64() },
  bool: { wireType: VARINT, zero: false, read: (r) => { const { low, high } = r.varint(); return low !== 0 || high !== 0; } },
  fixed32: { wireType: FIXED32, zero: 0, read: (r) => r.fixed32() },
  fixed64: { wireType: FIXED64, zero: 0, read: (r) => r.fixed64() },
  double: { wireType: FIXED64, zero: 0, read: (r) => r.double() },
  bytes: {
    wireType: LENGTH, zero: new Uint8Array(0),
    read: (r) => {
      const end = r.limit();
      const bytes = r.bytes.subarray(r.at, end);
      r.at = end;
      return bytes;
    },
  },
  string: {
    wireType: LENGTH, zero: '',
    read: (r) => {
      const at = r.at;
      const bytes = SCALARS.bytes.read(r);
      try {
        return utf8.decode(bytes);
      } catch {
        throw new WireError('malformed', at, 'text is not UTF-8');
      }
    },
  },
};

// message({ fieldNumber: [name, type] }): type is the name of a scalar, another message, or
// [type] for repeated. Absent scalars are zero, absent messages null, as in proto3; a scalar whose name
// ends in "?" is undefined when it is absent.
export function message(fields) {
  const table = new Map();
  const blank = {};
  for (const [number, [name, declared]] of Object.entries(fields)) {
    const repeated = Array.isArray(declared);
    const named = repeated ? declared[0] : declared;
    const optional = typeof named === 'string' && named.endsWith('?');
    const type = optional ? named.slice(0, -1) : named;
    const scalar = typeof type === 'string' ? SCALARS[type] : null;
    table.set(Number(number), { name, repeated, scalar, type, wireType: scalar ? scalar.wireType : LENGTH });
    blank[name] = repeated || !scalar ? null : optional ? undefined : scalar.zero;
  }
  const lists = [...table.values()].filter((f) => f.repeated).map((f) => f.name);

  function decode(reader) {
    const out = { ...blank };
    for (const name of lists) out[name] = [];
    while (!reader.done()) {
      const { field, wireType } = reader.tag();
      const known = table.get(field);
      if (!known) {
        reader.skip(wireType, field);
      } else if (wireType === known.wireType) {
        store(out, known, value(reader, known), reader.at);
      } else if (known.repeated && known.scalar && wireType === LENGTH) {  // packed
        const end = reader.limit();
        const part = new Reader(reader.bytes, reader.at, end);
        while (!part.done()) store(out, known, known.scalar.read(part), part.at);
        reader.at = end;
      } else {
        reader.skip(wireType, field);
      }
    }
    return out;
  }

  function value(reader, known) {
    if (known.scalar) return known.scalar.read(reader);
    const end = reader.limit();
    const inner = known.type.decode(new Reader(reader.bytes, reader.at, end));
    reader.at = end;
    return inner;
  }

  function store(out, known, value, at) {
    if (!known.repeated) { out[known.name] = value; return; }
    if (!(known.scalar && known.wireType === VARINT) && out[known.name].length >= MAX_REPEATED) {
      throw new WireError('oversized', at, `more than ${MAX_REPEATED} of ${known.name}`);
    }
    out[known.name].push(value);
  }

  return { decode };
}

// Grows as it is written to. Fields of value zero are written too: presence matters to Set.
export class Writer {
  constructor() {
    this.out = [];
  }

  varint(value) {
    while (value >= 0x80) {
      this.out.push((value % 0x80) | 0x80);
      value = Math.floor(value / 0x80);
    }
    this.out.push(value);
    return this;
  }

  uint32(field, value) {
    return this.varint(field * 8 + VARINT).varint(value);
  }

  sint32(field, value) {
    return this.uint32(field, value < 0 ? -2 * value - 1 : 2 * value);
  }

  double(field, value) {
    this.varint(field * 8 + FIXED64);
    const bytes = new Uint8Array(8);
    new DataView(bytes.buffer).setFloat64(0, value, true);
    this.out.push(...bytes);
    return this;
  }

  bytes(field, bytes) {
    this.varint(field * 8 + LENGTH).varint(bytes.length);
    this.out.push(...bytes);
    return this;
  }

  string(field, text) {
    return this.bytes(field, utf8Encoder.encode(text));
  }

  finish() {
    return Uint8Array.from(this.out);
  }
}
