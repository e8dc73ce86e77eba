// SPDX-License-Identifier: MIT
// node validate.js FILE…: what the Khronos glTF validator finds, one issue a line; exit status 1 for an error or a warning.
// Run it in a folder in which `npm ci` was run with the package.json that stands beside this file.
'use strict';
const fs = require('fs');
const validator = require(process.cwd() + '/node_modules/gltf-validator');

const kNames = ['error', 'warning', 'information', 'hint'];

async function validate(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {uri: file});
  for (const issue of report.issues.messages) {
    console.log(`${file}: ${kNames[issue.severity]}: ${issue.code}: ${issue.message} ${issue.pointer || ''}`);
  }
  return report.issues.numErrors + report.issues.numWarnings;
}

async function main() {
  let found = 0;
  for (const file of process.argv.slice(2)) found += await validate(file);
  process.exitCode = found > 0 ? 1 : 0;
}

main().catch((problem) => {
  console.error(problem);
  process.exitCode = 2;
});
