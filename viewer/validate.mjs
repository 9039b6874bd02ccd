// What the Khronos validator says about GLB files: node viewer/validate.mjs FILE...
// Exit code 1 if any has an error or a warning.
import {readFileSync} from 'node:fs';

import validator from 'gltf-validator';

for (const file of process.argv.slice(2)) {
  const {issues} = await validator.validateBytes(new Uint8Array(readFileSync(file)), {uri: file});
  console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos`);
  for (const {severity, code, message, pointer} of issues.messages) {
    if (severity < 2) console.log(`  ${code} ${pointer ?? ''}: ${message}`);
  }
  if (issues.numErrors + issues.numWarnings > 0) process.exitCode = 1;
}
