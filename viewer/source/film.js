// A film as data: what there is at a time. Nothing here draws.
import {compose, inverse, lerp, lerpAll} from './pose.js';

/// The share of a rest-to-rest motion that is done at the share u of its time.
function restToRest(u) {
  return u * u * u * (10 + u * (-15 + 6 * u));
}

/// The share of the time at which the share s of the way is done.
function restToRestInverse(s) {
  let low = 0;
  let high = 1;
  for (let i = 0; i < 40; ++i) {
    const middle = 0.5 * (low + high);
    if (restToRest(middle) < s) low = middle;
    else high = middle;
  }
  return 0.5 * (low + high);
}

/// Pads are written at every frame or at every few, places only where they change, forces of the
/// second pad only where they are not those of the first.
function fillPads(push) {
  const places = [[], []];
  let last = null;
  for (const frame of push.frames) {
    frame.pads?.forEach((pad, jaw) => {
      places[jaw] = pad.places ??= places[jaw];
      pad.forces ??= frame.pads[0].forces;
    });
    last = frame.pads ??= last;
  }
}

/// Index of the last frame at or before the share s.
function frameBefore(frames, s) {
  let low = 0;
  let high = frames.length - 1;
  while (low < high) {
    const middle = Math.ceil(0.5 * (low + high));
    if (frames[middle].s <= s) low = middle;
    else high = middle - 1;
  }
  return low;
}

export class Film {
  constructor(data) {
    this.data = data;
    data.pushes.forEach(fillPads);
    this.duration = data.phases.length > 0 ? data.phases.at(-1).end : 0;
    this.mostForce = this.#mostForce();
    this.mostPressure = this.#mostPressure();
  }

  /// Whether there is anything of a layer.
  has(layer) {
    const {outcomes, obstacles, limits, pushes} = this.data;
    if (layer === 'outcomes') return outcomes.length > 0;
    return layer === 'confines' ? obstacles !== null || limits !== null : pushes.length > 0;
  }

  #mostForce() {
    let most = 0;
    for (const push of this.data.pushes) {
      for (const frame of push.frames) {
        for (const load of frame.pusher) most = Math.max(most, Math.hypot(...load.force));
      }
    }
    return most || 1;
  }

  /// Full colour: the load of a pad point that one in twenty exceeds.
  #mostPressure() {
    const loads = [];
    for (const push of this.data.pushes) {
      for (const frame of push.frames) {
        for (const pad of frame.pads) {
          for (let i = 0; i < pad.forces.length; i += 3) loads.push(pad.forces[i]);
        }
      }
    }
    loads.sort((a, b) => a - b);
    return loads[Math.floor(0.95 * loads.length)] || 1;
  }

  phaseAt(time) {
    const {phases} = this.data;
    return phases.find((phase) => time < phase.end) ?? phases.at(-1) ?? null;
  }

  /// Everything that is drawn at a time.
  stateAt(time) {
    const phase = this.phaseAt(time);
    if (!phase) return this.#still();
    const length = phase.end - phase.begin;
    const u = length > 0 ? Math.min(1, Math.max(0, (time - phase.begin) / length)) : 1;
    const done = restToRest(u);
    const push = this.data.pushes[phase.push];
    if (phase.kind === 'push') return this.#pushing(phase, push, done);
    const {frames} = push;
    const after = phase.kind === 'retreat' || this.#wasPushed(phase);
    const frame = after ? frames.at(-1) : frames[0];
    return {
      ...posesOf(frame),
      phase,
      push,
      frame: null,
      X_WH: lerpAll(phase.from, phase.to, done),
      z_WH: lerp(...phase.z, done),
    };
  }

  #pushing(phase, push, done) {
    const {frames} = push;
    const s = done * frames.at(-1).s;
    const i = frameBefore(frames, s);
    const frame = frames[i];
    const next = frames[Math.min(i + 1, frames.length - 1)];
    const share = next.s > frame.s ? (s - frame.s) / (next.s - frame.s) : 0;
    const poses = mixedPoses(posesOf(frame), posesOf(next), share);
    const X_WP = compose(phase.from, frames[0].X_HP);
    return {
      ...poses,
      phase,
      push,
      frame: share < 0.5 ? frame : next,
      s,
      X_WH: compose(X_WP, inverse(poses.X_HP)),
      z_WH: lerp(...phase.z, done),
    };
  }

  #wasPushed(phase) {
    const {phases} = this.data;
    const at = phases.indexOf(phase);
    return phases.slice(0, at).some((p) => p.kind === 'push' && p.push === phase.push);
  }

  #still() {
    const {start, object} = this.data;
    return {
      phase: null,
      push: null,
      frame: null,
      X_HO: start,
      X_HP: start,
      z_HO: 0,
      z_HP: 0,
      jaw_z: [-object.half_thickness, object.half_thickness],
      X_WH: inverse(start),
      z_WH: 0,
    };
  }

  /// When each push begins and ends: [{push, begin, end}].
  pushTimes() {
    return this.data.phases
      .filter((phase) => phase.kind === 'push')
      .map(({push, begin, end}) => ({push, begin, end}));
  }

  /// A curve over time, one list of points per push: [[time, value], ...].
  curve(valueOf) {
    return this.data.phases
      .filter((phase) => phase.kind === 'push')
      .map((phase) => {
        const {frames} = this.data.pushes[phase.push];
        const last = frames.at(-1).s || 1;
        return frames.map((frame) => {
          const u = restToRestInverse(frame.s / last);
          return [lerp(phase.begin, phase.end, u), valueOf(frame)];
        });
      });
  }
}

function posesOf(frame) {
  const {X_HO, X_HP, jaw_z} = frame;
  return {X_HO, X_HP, jaw_z, z_HO: frame.z_HO ?? 0, z_HP: frame.z_HP ?? 0};
}

function mixedPoses(a, b, share) {
  return {
    X_HO: lerpAll(a.X_HO, b.X_HO, share),
    X_HP: lerpAll(a.X_HP, b.X_HP, share),
    jaw_z: lerpAll(a.jaw_z, b.jaw_z, share),
    z_HO: lerp(a.z_HO, b.z_HO, share),
    z_HP: lerp(a.z_HP, b.z_HP, share),
  };
}
