// Bodies that nothing may hit, and limits of grasp and hand.
import {LineBasicMaterial, LineSegments} from 'three';

import {geometryOf, triangles} from './shapes.js';
import {solid} from './solid.js';

const kArcStep = 0.05;  // [rad]
const kOpenArc = 0.35;  // [rad] of a limit to one side
const kPerTurn = 0.06;  // by which an arc widens per turn, so that turns can be told apart

function lines(points, colour) {
  const drawn = new LineSegments(geometryOf(points), new LineBasicMaterial({color: colour, depthTest: false}));
  drawn.renderOrder = 3;
  return drawn;
}

/// The sides that are set of a rectangle; what is not set goes on for `far`.
function rectangle([low, high], far, z) {
  const [x0, y0] = low ?? [-far, -far];
  const [x1, y1] = high ?? [far, far];
  const points = [];
  if (low) points.push(x0, y0, z, x0, y1, z, x0, y0, z, x1, y0, z);
  if (high) points.push(x1, y0, z, x1, y1, z, x0, y1, z, x1, y1, z);
  return points;
}

/// From one angle to the other, with a line from the centre to each end that is set.
function sector([low, high], radius) {
  const from = low ?? high - kOpenArc;
  const to = high ?? low + kOpenArc;
  const at = (angle) => {
    const r = radius * (1 + (kPerTurn * (angle - from)) / (2 * Math.PI));
    return [r * Math.cos(angle), r * Math.sin(angle), 0];
  };
  const points = [];
  const steps = Math.max(1, Math.ceil((to - from) / kArcStep));
  for (let i = 0; i < steps; ++i) {
    points.push(...at(from + ((to - from) * i) / steps), ...at(from + ((to - from) * (i + 1)) / steps));
  }
  if (low !== null) points.push(0, 0, 0, ...at(low));
  if (high !== null) points.push(0, 0, 0, ...at(high));
  return points;
}

const isSet = (ends) => ends.some((end) => end !== null);

export class Confines {
  /// `frames` has the groups world, hand and object.
  constructor(frames, {obstacles, limits, object}, reach, colours) {
    const {world, hand} = frames;
    this.groups = [];
    const add = (parent, child) => {
      parent.add(child);
      this.groups.push(child);
      return child;
    };
    for (const {surface} of obstacles?.fixture ?? []) add(world, solid(triangles(surface), colours.body, 0.22, colours.faint));
    for (const {surface} of obstacles?.hand ?? []) add(hand, solid(triangles(surface), colours.pad, 0.22, colours.faint));
    if (!limits) return;
    const {theta, finger, hand: place, hand_angle: angle} = limits;
    if (isSet(finger)) add(frames.object, lines(rectangle(finger, 1.2 * reach, object.half_thickness), colours.limit));
    if (isSet(place)) add(world, lines(rectangle(place, 8 * reach, 0), colours.limit));
    if (isSet(theta)) {
      add(hand, lines(sector(theta, 0.5 * reach), colours.limit));
      this.needle = add(hand, lines([0, 0, 0, 0.5 * reach, 0, 0], colours.ink));
    }
    if (isSet(angle)) {
      this.angle = add(world, lines(sector(angle, 0.7 * reach), colours.limit));
      add(hand, lines([0, 0, 0, 0.7 * reach, 0, 0], colours.ink));
    }
  }

  show(visible, {X_HO, X_WH}) {
    for (const group of this.groups) group.visible = visible;
    this.needle?.rotation.set(0, 0, X_HO[2]);
    this.angle?.position.set(X_WH[0], X_WH[1], 0);
  }
}
