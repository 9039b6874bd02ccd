// Makes bundle/viewer.js of the sources and three.js. The bundle is kept with the sources, so
// that building the program needs no Node; its first line is the digest of what it is made of.
import {createHash} from 'node:crypto';
import {readFileSync, readdirSync, writeFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';

import {build} from 'esbuild';

const here = fileURLToPath(new URL('.', import.meta.url));
const kUrl = /(?:https?|wss?|ftp):\/\/[^\s"'`)\\]+/g;
const kAllowed = ['http://www.w3.org/1999/xhtml', 'http://www.w3.org/2000/svg'];

/// The same as in bundle_matches_sources.cmake: digests of the files, in order of their names.
function digestOfSources() {
  const files = ['build.mjs', 'package-lock.json', ...readdirSync(`${here}source`).sort().map((name) => `source/${name}`)];
  const digests = files.map((file) => createHash('sha256').update(readFileSync(here + file)).digest('hex'));
  return createHash('sha256').update(digests.join('')).digest('hex');
}

const result = await build({
  absWorkingDir: here,
  entryPoints: ['source/main.js'],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  legalComments: 'none',
  charset: 'ascii',
  write: false,
});

let text = result.outputFiles[0].text;
for (const url of text.match(kUrl) ?? []) {
  if (!kAllowed.includes(url)) text = text.replaceAll(url, 'three.js');
}
if (/<\/script|<!--/i.test(text)) throw new Error('the bundle would end the element that holds it');
const outputs = process.argv[2] ?? `${here}bundle/viewer.js`;
writeFileSync(outputs, `/* sources ${digestOfSources()}; three.js: MIT licence, see LICENSE.three.txt */\n${text}`);
console.log(`${outputs}: ${text.length} bytes`);
