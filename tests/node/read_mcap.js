// SPDX-License-Identifier: MIT
// node read_mcap.js FILE: what Foxglove's own reader finds in an MCAP log, read twice: from start to end with all check sums,
// and by its index. One line for each channel, `TOPIC MESSAGES BYTES CRC`, where CRC is that of all its messages' bytes in
// the order of the file; then one line for each metadata record. Exit status 1 where the two ways differ or a JSON message is
// none. Run it in a folder in which `npm ci` was run with the package.json that stands beside this file.
'use strict';
const fs = require('fs');
const {createRequire} = require('module');
const packages = createRequire(process.cwd() + '/package.json');
const {McapIndexedReader, McapStreamReader} = packages('@mcap/core');
const fzstd = packages('fzstd');

const kCrcTable = Array.from({length: 256}, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

function crc32(bytes, before) {
  let c = ~before >>> 0;
  for (const byte of bytes) c = kCrcTable[(c ^ byte) & 0xff] ^ (c >>> 8);
  return ~c >>> 0;
}

const decompressHandlers = {zstd: (bytes) => fzstd.decompress(bytes)};

class Counts {
  constructor() {
    this.channels = new Map();
  }
  add(topic, encoding, data) {
    const entry = this.channels.get(topic) || {messages: 0, bytes: 0, crc: 0};
    ++entry.messages;
    entry.bytes += data.byteLength;
    entry.crc = crc32(data, entry.crc);
    this.channels.set(topic, entry);
    if (encoding === 'json') JSON.parse(new TextDecoder('utf-8', {fatal: true}).decode(data));
  }
  lines() {
    return [...this.channels].sort().map(([topic, e]) => `${topic} ${e.messages} ${e.bytes} ${e.crc}`);
  }
}

function readStream(bytes) {
  const reader = new McapStreamReader({validateCrcs: true, decompressHandlers});
  reader.append(bytes);
  const channels = new Map();
  const counts = new Counts();
  for (let record; (record = reader.nextRecord());) {
    if (record.type === 'Channel') channels.set(record.id, record);
    if (record.type !== 'Message') continue;
    const channel = channels.get(record.channelId);
    counts.add(channel.topic, channel.messageEncoding, record.data);
  }
  if (!reader.done()) throw new Error('the stream reader wants more');
  return counts;
}

async function readIndexed(bytes) {
  const readable = {
    size: async () => BigInt(bytes.byteLength),
    read: async (offset, size) => bytes.slice(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({readable, decompressHandlers});
  const counts = new Counts();
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    counts.add(channel.topic, channel.messageEncoding, message.data);
  }
  const metadata = [];
  for await (const record of reader.readMetadata()) metadata.push(`metadata ${record.name} ${[...record.metadata.keys()]}`);
  let sum = 0n;
  for (const count of reader.statistics.channelMessageCounts.values()) sum += count;
  if (sum !== reader.statistics.messageCount) throw new Error('the statistics contradict themselves');
  return {counts, metadata, messages: sum};
}

async function main() {
  const bytes = new Uint8Array(fs.readFileSync(process.argv[2]));
  const streamed = readStream(bytes).lines();
  const {counts, metadata} = await readIndexed(bytes);
  const indexed = counts.lines();
  console.log(streamed.concat(metadata).join('\n'));
  if (streamed.join() !== indexed.join()) {
    console.log('by index:\n' + indexed.join('\n'));
    process.exitCode = 1;
  }
}

main().catch((problem) => {
  console.error(problem);
  process.exitCode = 1;
});
