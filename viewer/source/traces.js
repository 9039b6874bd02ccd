// The marks that the pads rub on the object: the path of the finger axis in O.
import {Group, Line, LineBasicMaterial} from 'three';

import {inverse} from './pose.js';
import {geometryOf, rollAxis} from './shapes.js';

function line(points, colour, opacity) {
  const trace = new Line(geometryOf(points), new LineBasicMaterial({color: colour, transparent: true, opacity, depthTest: false}));
  trace.renderOrder = 4;
  return trace;
}

export class Traces {
  constructor(parent, film, colours) {
    this.group = new Group();
    parent.add(this.group);
    this.counts = [];  // frames before each push
    const points = [];
    const z = film.data.object.half_thickness;
    // An object that can roll turns its faces away: its path is none in the pad plane.
    const canRoll = rollAxis(film.data.object) !== undefined;
    for (const push of film.data.pushes) {
      this.counts.push(points.length / 3);
      if (canRoll) continue;
      for (const frame of push.frames) points.push(...inverse(frame.X_HO).slice(0, 2), z);
    }
    this.whole = line(points, colours.trace, 0.35);
    this.done = line(points, colours.trace, 1);
    this.group.add(this.whole, this.done);
  }

  show(visible, state, film) {
    this.group.visible = visible;
    if (!state.phase) return;
    const {push: index, kind} = state.phase;
    const {frames} = film.data.pushes[index];
    let count = this.counts[index];
    if (kind === 'push') count += frames.filter((frame) => frame.s <= state.s).length;
    if (kind === 'retreat') count += frames.length;
    this.done.geometry.setDrawRange(0, count);
  }
}
