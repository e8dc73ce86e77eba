// SPDX-License-Identifier: MIT
// node read_foxglove.js FILE: what the Protobuf channels of an MCAP log say to a reader that knows nothing but the schemas in the
// file itself. Prints {TOPIC: {schema, messages: […]}} as JSON: messages in the order of their log times, each with `log_time_ns` (a
// text) and `sequence`; bytes are base64, and the points of a cloud are unpacked by its own fields as `points`. Exit status 1 for a schema that does
// not hold what it needs, or a message that holds a field which its schema does not have. Run it in a folder in which `npm ci` was run with the
// package.json that stands beside this file.
'use strict';
const fs = require('fs');
const {createRequire} = require('module');
const packages = createRequire(process.cwd() + '/package.json');
const {McapIndexedReader} = packages('@mcap/core');
const fzstd = packages('fzstd');
const protobuf = packages('protobufjs');
const {FileDescriptorSet} = packages('protobufjs/ext/descriptor');

/// The type of a schema record. Types that it does not hold are an error.
function typeOf(schema) {
  if (schema.encoding !== 'protobuf') throw new Error(`${schema.name}: encoding ${schema.encoding}`);
  const root = protobuf.Root.fromDescriptor(FileDescriptorSet.decode(schema.data));
  root.resolveAll();
  return root.lookupType(schema.name);
}

const kNumbers = {7: [4, 'getFloat32'], 8: [8, 'getFloat64']};

/// [[x, y, z], …], by name.
function unpackPoints(cloud) {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  if (view.byteLength % cloud.point_stride !== 0) throw new Error('half a point');
  const fields = ['x', 'y', 'z'].map((name) => cloud.fields.find((field) => field.name === name));
  const points = [];
  for (let at = 0; at < view.byteLength; at += cloud.point_stride) {
    points.push(fields.map(({offset, type}) => {
      const [size, get] = kNumbers[type];
      if (offset + size > cloud.point_stride) throw new Error('a field beyond its point');
      return view[get](at + offset, true);
    }));
  }
  return points;
}

/// The message as a plain object. Written again it has as many bytes, so that nothing was passed over.
function decode(type, data) {
  const message = type.decode(data);
  const again = type.encode(message).finish().byteLength;
  if (again !== data.byteLength) throw new Error(`${type.fullName}: ${data.byteLength} bytes, of which ${again} are known`);
  const plain = type.toObject(message, {longs: String, bytes: String, defaults: true});
  if (type.name === 'PointCloud') {
    plain.points = unpackPoints(message);
    delete plain.data;
  }
  return plain;
}

async function main() {
  const bytes = new Uint8Array(fs.readFileSync(process.argv[2]));
  const readable = {
    size: async () => BigInt(bytes.byteLength),
    read: async (offset, size) => bytes.slice(Number(offset), Number(offset + size)),
  };
  const decompressHandlers = {zstd: (packed) => fzstd.decompress(packed)};
  const reader = await McapIndexedReader.Initialize({readable, decompressHandlers});
  const types = new Map();
  const topics = {};
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    if (channel.messageEncoding !== 'protobuf') continue;
    const schema = reader.schemasById.get(channel.schemaId);
    if (!types.has(schema.id)) types.set(schema.id, typeOf(schema));
    topics[channel.topic] = topics[channel.topic] || {schema: schema.name, messages: []};
    topics[channel.topic].messages.push(
        {log_time_ns: message.logTime.toString(), sequence: message.sequence, ...decode(types.get(schema.id), message.data)});
  }
  process.stdout.write(JSON.stringify(topics));
}

main().catch((problem) => {
  console.error(problem);
  process.exitCode = 1;
});
