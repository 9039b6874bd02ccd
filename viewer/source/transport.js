// Playing, scrubbing, stepping.
import {element, svg} from './elements.js';

// Drawn, since not every font has these signs.
const kIcons = {
  play: 'M4 2v12l10-6z',
  pause: 'M3 2h4v12H3zM9 2h4v12H9z',
  before: 'M3 2h2v12H3zM14 2v12L6 8z',
  next: 'M11 2h2v12h-2zM2 2v12l8-6z',
};

function icon(name) {
  return svg('svg', {viewBox: '0 0 16 16', class: 'icon', 'aria-hidden': 'true'}, svg('path', {d: kIcons[name]}));
}

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10];

export class Transport {
  /// times: [{push, begin, end}], of the film that is stepped through.
  constructor(duration, times, onTime) {
    this.duration = duration;
    this.times = times;
    this.onTime = onTime;
    this.time = 0;
    this.isPlaying = false;
    this.playButton = element('button', {class: 'play', 'aria-label': 'Play', title: 'Play or pause (space)', onclick: () => this.toggle()}, icon('play'));
    this.scrubber = element('input', {type: 'range', min: 0, max: duration || 1, step: 'any', value: 0, 'aria-label': 'Time in seconds'});
    this.scrubber.addEventListener('input', () => this.seek(Number(this.scrubber.value)));
    this.clock = element('output', {class: 'clock'});
    this.speed = element('select', {'aria-label': 'Speed'}, ...kSpeeds.map((speed) =>
      element('option', {value: speed, selected: speed === 1}, `${speed}×`)));
    this.root = element('div', {class: 'transport', role: 'group', 'aria-label': 'Playback'},
      element('button', {'aria-label': 'Push before', title: 'Push before ([)', onclick: () => this.step(-1)}, icon('before')),
      this.playButton,
      element('button', {'aria-label': 'Next push', title: 'Next push (])', onclick: () => this.step(1)}, icon('next')),
      this.scrubber, this.clock, this.speed);
  }

  seek(time) {
    this.time = Math.min(this.duration, Math.max(0, time));
    this.scrubber.value = this.time;
    this.clock.textContent = `${this.time.toFixed(2)} / ${this.duration.toFixed(2)} s`;
    this.onTime(this.time);
  }

  toggle() {
    this.isPlaying = !this.isPlaying && this.duration > 0;
    this.playButton.replaceChildren(icon(this.isPlaying ? 'pause' : 'play'));
    this.playButton.setAttribute('aria-label', this.isPlaying ? 'Pause' : 'Play');
    if (!this.isPlaying) return;
    if (this.time >= this.duration) this.time = 0;
    let last = performance.now();
    const tick = (now) => {
      if (!this.isPlaying) return;
      const seconds = (Number(this.speed.value) * (now - last)) / 1000;
      last = now;
      this.seek(this.time + seconds);
      if (this.time >= this.duration) this.toggle();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  faster(by) {
    const at = Math.min(kSpeeds.length - 1, Math.max(0, this.speed.selectedIndex + by));
    this.speed.selectedIndex = at;
  }

  /// To the beginning of another push; past the last one, to the end.
  step(by) {
    const begins = this.times.map(({begin}) => begin);
    const next = by > 0
      ? begins.find((begin) => begin > this.time + 1e-3) ?? this.duration
      : begins.findLast((begin) => begin < this.time - 1e-3) ?? 0;
    this.seek(next);
  }
}
