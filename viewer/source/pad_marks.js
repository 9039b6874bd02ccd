// Pressure and friction of the pads, point by point, on the outside of each jaw.
import {
  BufferGeometry, CircleGeometry, Color, Group, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4,
  MeshBasicMaterial, Vector3,
} from 'three';

import {Arrow, overlay} from './arrows.js';
import {geometryOf} from './shapes.js';

const kMost = 96;  // points of a pad

export class PadMarks {
  constructor(parent, film, reach, colours) {
    this.film = film;
    // Mixed as the eye sees them, not as light adds up.
    this.low = new Color(colours.pressureLow).convertLinearToSRGB();
    this.high = new Color(colours.pressureHigh).convertLinearToSRGB();
    this.group = new Group();
    parent.add(this.group);
    this.size = this.#sizeOfPad();
    this.jaws = [-1, 1].map((side) => this.#makeJaw(side, reach, colours));
  }

  #sizeOfPad() {
    const {pad} = this.film.data.gripper;
    return Math.max(...pad.map(([x, y]) => Math.hypot(x, y)));
  }

  #makeJaw(side, reach, colours) {
    const material = new MeshBasicMaterial({transparent: true, opacity: 0.95, depthWrite: false});
    const discs = new InstancedMesh(new CircleGeometry(0.1 * this.size, 20), material, kMost);
    const lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({color: colours.friction}));
    discs.renderOrder = 1;
    lines.renderOrder = 2;
    discs.frustumCulled = lines.frustumCulled = false;
    const arrow = new Arrow(overlay(colours.force), 0.01 * reach);
    this.group.add(discs, lines, arrow);
    return {side, discs, lines, arrow, lift: 0.065 * reach};
  }

  show({frame, jaw_z}) {
    this.group.visible = Boolean(frame);
    if (!frame) return;
    this.jaws.forEach((jaw, i) => {
      this.#showJaw(jaw, frame.pads[i], jaw_z[i]);
      this.#showResultant(jaw, frame.pads[i].load);
    });
  }

  /// The force of a pad that touches along a line, to the scale of the pusher's.
  #showResultant({arrow}, load) {
    arrow.visible = false;
    if (!load) return;
    arrow.pointForce(load, this.film);
  }

  #showJaw({side, discs, lines, lift}, {places, forces}, z) {
    const count = Math.min(kMost, places.length / 2);
    const most = this.film.mostPressure;
    const height = z + side * lift;
    const matrix = new Matrix4();
    const ends = [];
    for (let i = 0; i < count; ++i) {
      const x = 1e-6 * places[2 * i];
      const y = 1e-6 * places[2 * i + 1];
      const [normal, fx, fy] = forces.slice(3 * i, 3 * i + 3);
      if (side < 0) matrix.makeRotationX(Math.PI);
      matrix.setPosition(new Vector3(x, y, height));
      discs.setMatrixAt(i, matrix);
      const share = Math.min(1, normal / most);
      discs.setColorAt(i, this.low.clone().lerp(this.high, share).convertSRGBToLinear());
      const scale = (0.55 * this.size) / most;
      ends.push(x, y, height, x + scale * fx, y + scale * fy, height);
    }
    discs.count = count;
    discs.instanceMatrix.needsUpdate = true;
    if (discs.instanceColor) discs.instanceColor.needsUpdate = true;
    lines.geometry.dispose();
    lines.geometry = geometryOf(ends);
  }
}
