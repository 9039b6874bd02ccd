// The page: reads the data, builds its parts and keeps them at the same time.
import {Chart} from './charts.js';
import {element, mm} from './elements.js';
import {Film} from './film.js';
import {kKeys, listen} from './keyboard.js';
import {Moment, PushList, verdictBox} from './panel.js';
import {kViewNames, Stage} from './stage.js';
import {Theme} from './theme.js';
import {Transport} from './transport.js';

const kLayers = {
  forces: 'forces',
  cones: 'friction and motion cones',
  pads: 'pressure of the pads',
  traces: 'path of the pads',
  outcomes: 'sampled ends',
  confines: 'obstacles and limits',
};

/// A mesh of too many triangles is drawn by fewer, and says so.
function drawnWithin({mesh}) {
  return mesh?.off > 0 ? ` (its mesh drawn within ${mm(mesh.off)})` : '';
}

class Viewer {
  constructor(films) {
    this.films = films;
    this.isWorld = false;
    this.duration = Math.max(...films.map((film) => film.duration));
    this.theme = new Theme(() => this.recolour());
    this.transport = new Transport(this.duration, films[0].pushTimes(), (time) => this.show(time));
    this.parts = films.map((film, i) => this.#part(film, i));
    this.charts = this.#charts();
    this.help = element('details', {class: 'help'}, element('summary', {}, 'keys'),
      element('dl', {}, ...kKeys.flatMap(([key, what]) => [element('dt', {}, key), element('dd', {}, what)])));
    this.#assemble();
    listen(this);
  }

  #part(film, i) {
    const canvas = element('canvas', {tabindex: 0, role: 'img', 'aria-label': `${film.data.name}: object, jaws and pushers in three dimensions`});
    const part = {film, canvas, stage: null};
    try {
      part.stage = new Stage(canvas, film, this.theme.colours());
    } catch (error) {
      part.failure = element('p', {class: 'failure', role: 'alert'},
        'This browser draws no WebGL, so there is no picture; numbers and curves are complete.');
      console.info(String(error));
    }
    part.list = new PushList(film, (push) => {
      const begin = film.pushTimes().find((times) => times.push === push)?.begin;
      if (begin !== undefined) this.transport.seek(begin);
    });
    part.moment = new Moment(film);
    const letter = this.films.length > 1 ? `${'AB'[i]}: ` : '';
    part.figure = element('figure', {class: 'stage'}, part.failure ?? canvas,
      part.stage && film.data.g_W.some((g) => g !== 0) ? element('span', {class: 'gravity'}, 'gravity') : null,
      element('figcaption', {}, `${letter}${film.data.name}${drawnWithin(film.data.object)}`));
    part.side = element('section', {class: 'side', 'aria-label': `${letter}${film.data.name}`},
      this.films.length > 1 ? element('h2', {}, `${letter}${film.data.name}`) : null,
      verdictBox(film.data), part.list.root, part.moment.root);
    return part;
  }

  #charts() {
    const classes = ['a', 'b'];
    const letter = (i) => (this.films.length > 1 ? ` ${'AB'[i]}` : '');
    const onTime = (time) => this.transport.seek(time);
    const force = this.films.map((film, i) => ({label: `push force${letter(i)}`, className: classes[i], curves: film.curve((frame) => frame.push_force)}));
    const slack = this.films.flatMap((film, i) => [
      {label: `nominal${letter(i)}`, className: classes[i], curves: film.curve((frame) => frame.slack)},
      {label: `over the margin${letter(i)}`, className: `${classes[i]} dashed`, curves: film.curve((frame) => frame.robust_slack)},
    ]);
    const charts = [
      {chart: new Chart('Push force [N]', force, this.duration, onTime), value: (frame) => frame.push_force},
      {chart: new Chart('Slack of sticking', slack, this.duration, onTime), value: (frame) => frame.slack},
    ];
    return charts.filter(({chart}) => !chart.isEmpty);
  }

  #assemble() {
    const layers = Object.entries(kLayers)
      .filter(([layer]) => this.films.some((film) => film.has(layer)))
      .map(([layer, words]) => this.#layerBox(layer, words));
    this.worldBox = element('select', {'aria-label': 'What stands still'},
      element('option', {value: 'hand'}, 'hand stands still'), element('option', {value: 'world'}, 'world stands still'));
    this.worldBox.addEventListener('change', () => this.setWorld(this.worldBox.value === 'world'));
    const views = kViewNames.map((view) =>
      element('button', {onclick: () => this.look(view)}, view));
    const {data} = this.films[0];
    document.getElementById('viewer').append(
      element('header', {}, element('h1', {}, this.films.map((film) => film.data.name).join('  |  ')),
        data.origin && this.films.length === 1 ? element('details', {}, element('summary', {}, 'origin'), element('p', {}, data.origin)) : null,
        this.help,
        element('button', {onclick: () => this.theme.toggle(), 'aria-label': 'Dark or light'}, '◐')),
      element('div', {class: 'stages'}, ...this.parts.map((part) => part.figure)),
      element('div', {class: 'tools', role: 'group', 'aria-label': 'What is shown'}, this.worldBox,
        element('span', {class: 'views', role: 'group', 'aria-label': 'View'}, ...views), ...layers),
      this.duration > 0 ? this.transport.root : '',
      element('div', {class: 'sides'}, ...this.parts.map((part) => part.side)),
      element('div', {class: 'charts'}, ...this.charts.map(({chart}) => chart.root)));
  }

  #layerBox(layer, words) {
    const box = element('input', {type: 'checkbox', checked: true});
    box.addEventListener('change', () => {
      for (const {stage} of this.parts) if (stage) stage.layers[layer] = box.checked;
      this.show(this.transport.time);
    });
    return element('label', {class: `layer ${layer}`}, box, element('i', {}), words);
  }

  show(time) {
    this.parts.forEach(({film, stage, list, moment}) => {
      const state = film.stateAt(time);
      stage?.show(state, time);
      list.show(state.phase?.push ?? -1);
      moment.show(state);
    });
    for (const {chart, value} of this.charts) chart.show(time, this.#valuesAt(time, value));
  }

  #valuesAt(time, value) {
    const values = this.films.map((film) => film.stateAt(time).frame).map((frame) => (frame ? value(frame) : null));
    return values.map((number) => (number === null ? '–' : number.toFixed(3))).join('  |  ');
  }

  setWorld(isWorld) {
    this.isWorld = isWorld;
    this.worldBox.value = isWorld ? 'world' : 'hand';
    for (const {stage} of this.parts) if (stage) stage.isWorld = isWorld;
    this.show(this.transport.time);
  }

  look(view) {
    for (const {stage} of this.parts) stage?.look(view);
  }

  recolour() {
    for (const {stage} of this.parts) stage?.setColours(this.theme.colours());
  }

  resize() {
    for (const {stage} of this.parts) stage?.resize();
  }
}

/// "#t=1.5&push=2&frame=world&view=front&theme=dark": a link to a moment.
function applyAddress(viewer) {
  const wanted = new URLSearchParams(location.hash.slice(1));
  if (['dark', 'light'].includes(wanted.get('theme'))) viewer.theme.set(wanted.get('theme'));
  if (wanted.get('frame') === 'world') viewer.setWorld(true);
  if (kViewNames.includes(wanted.get('view'))) viewer.look(wanted.get('view'));
  const times = viewer.films[0].pushTimes();
  const push = times[Number(wanted.get('push')) - 1];
  const share = Number(wanted.get('share') ?? 0.5);
  if (push) viewer.transport.seek(push.begin + share * (push.end - push.begin));
  else viewer.transport.seek(Number(wanted.get('t')) || 0);
}

function start() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const viewer = new Viewer(data.map((film) => new Film(film)));
  applyAddress(viewer);
  viewer.resize();
  window.addEventListener('resize', () => viewer.resize());
  window.addEventListener('hashchange', () => applyAddress(viewer));
  requestAnimationFrame(() => {
    document.documentElement.dataset.firstFrameMs = performance.now().toFixed(0);
  });
}

window.addEventListener('error', (event) => {
  document.documentElement.dataset.error = event.message;
});
start();
