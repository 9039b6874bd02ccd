// How long pages take to draw their first picture, and each picture while they play, in headless
// Chromium with GL drawn by the processor:
//   node viewer/measure.mjs page.html...
// First picture: performance.now() after its pixels were read back, so that nothing is still to be
// drawn. Playing: the time between pictures, each of them read back, too. Exit code 1: a page drew
// nothing or met an error.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const kFlags = ['--headless', '--no-sandbox', '--no-first-run', '--disable-background-networking',
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--window-size=1280,900', '--remote-debugging-pipe'];
const kPictures = 120;

/// Runs in the page, before its own scripts.
function watch() {
  const draw = window.requestAnimationFrame.bind(window);
  const times = [];
  window.watched = times;
  const readBack = () => {
    const pixel = new Uint8Array(4);
    for (const canvas of document.querySelectorAll('canvas')) {
      const gl = canvas.getContext('webgl2');
      gl?.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    }
    return pixel[3] > 0;
  };
  window.requestAnimationFrame = (callback) => draw((now) => {
    callback(now);
    if (readBack()) times.push([now, performance.now()]);
  });
}

class Browser {
  constructor() {
    this.profile = mkdtempSync(join(tmpdir(), 'viewer-'));
    this.process = spawn('chromium', [...kFlags, `--user-data-dir=${this.profile}`], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.waiting = new Map();
    this.count = 0;
    let text = '';
    this.process.stdio[4].on('data', (part) => {
      text += part;
      for (let end; (end = text.indexOf('\0')) >= 0; text = text.slice(end + 1)) {
        const message = JSON.parse(text.slice(0, end));
        this.waiting.get(message.id)?.(message.result ?? {error: message.error});
      }
    });
  }

  send(method, params = {}, sessionId = undefined) {
    const id = ++this.count;
    this.process.stdio[3].write(`${JSON.stringify({id, method, params, sessionId})}\0`);
    return new Promise((done) => this.waiting.set(id, done));
  }

  close() {
    this.process.once('exit', () => rmSync(this.profile, {recursive: true, force: true}));
    return this.send('Browser.close');
  }
}

async function measured(browser, file) {
  const {targetId} = await browser.send('Target.createTarget', {url: 'about:blank'});
  const {sessionId} = await browser.send('Target.attachToTarget', {targetId, flatten: true});
  const ask = async (expression) =>
    (await browser.send('Runtime.evaluate', {expression, returnByValue: true}, sessionId)).result?.value;
  await browser.send('Page.enable', {}, sessionId);
  await browser.send('Page.addScriptToEvaluateOnNewDocument', {source: `(${watch})()`}, sessionId);
  await browser.send('Page.navigate', {url: pathToFileURL(resolve(file)).href}, sessionId);
  const wait = () => new Promise((done) => setTimeout(done, 100));
  for (let tries = 0; tries < 300 && !(await ask('window.watched?.length > 0')); ++tries) await wait();
  const first = await ask('watched[0][1]');
  await wait();
  await ask('watched.length = 0; document.querySelector(".play")?.click()');
  for (let tries = 0; tries < 100 && (await ask('watched.length')) < kPictures; ++tries) await wait();
  const begins = await ask('watched.map(([now]) => now)');
  const error = await ask('document.documentElement.dataset.error ?? ""');
  await browser.send('Target.closeTarget', {targetId});
  const steps = begins.slice(1).map((now, i) => now - begins[i]).sort((a, b) => a - b);
  return {first, steps, error};
}

const ms = (value) => (value === undefined ? '-' : value.toFixed(0));
const browser = new Browser();
let failed = false;
console.log('first ms  median ms  95 % ms  pictures  page');
for (const file of process.argv.slice(2)) {
  const {first, steps, error} = await measured(browser, file);
  failed ||= first === undefined || error !== '';
  const at = (share) => steps[Math.floor(share * steps.length)];
  console.log([ms(first).padStart(8), ms(at(0.5)).padStart(9), ms(at(0.95)).padStart(7), String(steps.length).padStart(8), ` ${file}${error && `: ${error}`}`].join('  '));
}
await browser.close();
process.exitCode = failed ? 1 : 0;
