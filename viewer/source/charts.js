// Curves over time, one chart below the other, with a cursor at the time that is shown.
import {element, svg} from './elements.js';

const kWidth = 640;
const kHeight = 118;
const kLeft = 52;
const kRight = 8;
const kTop = 8;
const kBottom = 18;

/// Round values, `least` of them or up to thrice as many.
function ticks(low, high, least) {
  const raw = (high - low) / (least + 1) || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [5, 2, 1].map((m) => m * power).find((s) => s <= raw * (1 + 1e-9));
  const out = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) out.push(Number((i * step).toPrecision(12)));
  return out;
}

export class Chart {
  /// series: [{label, className, curves: [[[time, value], ...], ...]}]
  constructor(title, series, duration, onTime) {
    this.duration = duration || 1;
    const values = series.flatMap(({curves}) => curves.flat().map(([, value]) => value)).filter((value) => value !== null);
    this.isEmpty = values.length === 0;
    const spread = Math.max(...values) - Math.min(...values, 0);
    this.low = Math.min(0, ...values);
    this.high = Math.max(...values, this.low + 1e-9) + 0.06 * (spread || 1);
    this.plot = svg('svg', {viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'img', 'aria-label': `${title} over time`, preserveAspectRatio: 'none'});
    this.#drawAxes();
    for (const one of series) this.#drawSeries(one);
    this.cursor = svg('line', {class: 'cursor', y1: kTop, y2: kHeight - kBottom});
    this.plot.append(this.cursor);
    this.plot.addEventListener('pointerdown', (event) => this.#scrub(event, onTime));
    this.plot.addEventListener('pointermove', (event) => event.buttons && this.#scrub(event, onTime));
    this.values = element('span', {class: 'values'});
    this.root = element('figure', {class: 'chart'},
      element('figcaption', {}, element('b', {}, title), ...series.map(({label, className}) =>
        element('span', {class: `key ${className}`}, label)), this.values),
      this.plot);
  }

  #x(time) {
    return kLeft + ((kWidth - kLeft - kRight) * time) / this.duration;
  }

  #y(value) {
    const share = (value - this.low) / (this.high - this.low);
    return kHeight - kBottom - (kHeight - kBottom - kTop) * share;
  }

  #drawAxes() {
    for (const value of ticks(this.low, this.high, 3)) {
      const y = this.#y(value);
      this.plot.append(svg('line', {class: value === 0 ? 'zero' : 'grid', x1: kLeft, x2: kWidth - kRight, y1: y, y2: y}),
        svg('text', {x: kLeft - 6, y: y + 4, class: 'tick end'}, String(value)));
    }
    for (const time of ticks(0, this.duration, 3)) {
      this.plot.append(svg('text', {x: this.#x(time), y: kHeight - 4, class: 'tick middle'}, `${time} s`));
    }
  }

  #drawSeries({className, curves}) {
    for (const curve of curves) {
      let data = '';
      let isDown = false;
      for (const [time, value] of curve) {
        if (value !== null) data += `${isDown ? 'L' : 'M'}${this.#x(time).toFixed(1)},${this.#y(value).toFixed(1)}`;
        isDown = value !== null;
      }
      if (data) this.plot.append(svg('path', {d: data, class: `curve ${className}`}));
    }
  }

  #scrub(event, onTime) {
    const box = this.plot.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * kWidth;
    onTime(((x - kLeft) / (kWidth - kLeft - kRight)) * this.duration);
  }

  show(time, text) {
    const x = this.#x(time);
    this.cursor.setAttribute('x1', x);
    this.cursor.setAttribute('x2', x);
    this.values.textContent = text;
  }
}
