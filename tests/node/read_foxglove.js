// SPDX-License-Identifier: MIT
// node read_foxglove.js FILE: what the Protobuf channels of an MCAP log, and the JSON channels of its view, say to a reader that knows nothing but the schemas in the
// file itself. Prints {TOPIC: {schema, messages: […]}} as JSON: messages in the order of their log times, each with `log_time_ns` (a
// text) and `sequence`; bytes are base64, and the points of a cloud are unpacked by its own fields as `points`, and what else each has as `numbers`, by name. Infinity is "inf", NaN null. Exit status 1 for a schema that does
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

const kNumbers = {3: [2, 'getUint16'], 5: [4, 'getUint32'], 7: [4, 'getFloat32'], 8: [8, 'getFloat64']};

/// [[x, y, z], …], or the numbers of other names.
function unpack(cloud, names) {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  if (view.byteLength % cloud.point_stride !== 0) throw new Error('half a point');
  const fields = names.map((name) => cloud.fields.find((field) => field.name === name));
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

/// Throws where a value is not of the type that a JSON Schema has for it.
function check(schema, value, where) {
  const type = Number.isInteger(value) && schema.type === 'integer' ? 'integer' : typeof value;
  if (type !== schema.type) throw new Error(`${where}: a ${type} in the place of ${schema.type}`);
  for (const name of schema.required || []) if (!(name in value)) throw new Error(`${where}: no ${name}`);
  for (const name in schema.properties || {}) if (name in value) check(schema.properties[name], value[name], `${where}.${name}`);
}

function decodeJson(schema, data) {
  if (schema.encoding !== 'jsonschema') throw new Error(`${schema.name}: encoding ${schema.encoding}`);
  const value = JSON.parse(new TextDecoder().decode(data));
  check(JSON.parse(new TextDecoder().decode(schema.data)), value, schema.name);
  return value;
}

/// The message as a plain object. Written again it has as many bytes, so that nothing was passed over.
function decode(type, data) {
  const message = type.decode(data);
  const again = type.encode(message).finish().byteLength;
  if (again !== data.byteLength) throw new Error(`${type.fullName}: ${data.byteLength} bytes, of which ${again} are known`);
  const plain = type.toObject(message, {longs: String, bytes: String, defaults: true});
  if (type.name === 'PointCloud') {
    const place = ['x', 'y', 'z'];
    plain.points = unpack(message, place);
    plain.numbers = {};
    for (const {name} of message.fields) {
      if (!place.includes(name)) plain.numbers[name] = unpack(message, [name]).flat();
    }
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
    const isJson = channel.messageEncoding === 'json' && channel.topic.startsWith('/foxglove/');
    if (channel.messageEncoding !== 'protobuf' && !isJson) continue;
    const schema = reader.schemasById.get(channel.schemaId);
    if (!isJson && !types.has(schema.id)) types.set(schema.id, typeOf(schema));
    topics[channel.topic] = topics[channel.topic] || {schema: schema.name, messages: []};
    const content = isJson ? decodeJson(schema, message.data) : decode(types.get(schema.id), message.data);
    topics[channel.topic].messages.push({log_time_ns: message.logTime.toString(), sequence: message.sequence, ...content});
  }
  process.stdout.write(JSON.stringify(topics, (key, value) => value === Infinity ? 'inf' : value));
}

main().catch((problem) => {
  console.error(problem);
  process.exitCode = 1;
});
