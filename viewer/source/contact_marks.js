// What happens where the pusher touches: forces, friction cones, the motion cone, slip.
import {Group, Mesh, RingGeometry, Vector3} from 'three';

import {Arrow, FrictionCone, MotionCone, overlay} from './arrows.js';

const kMost = 8;  // contact points of a pusher
const kZ = new Vector3(0, 0, 1);

export class ContactMarks {
  constructor(parent, reach, colours) {
    this.reach = reach;
    this.group = new Group();
    parent.add(this.group);
    const force = overlay(colours.force);
    const cone = overlay(colours.cone, 0.16);
    const slip = overlay(colours.slip);
    const make = (create) => Array.from({length: kMost}, () => {
      const mark = create();
      this.group.add(mark);
      return mark;
    });
    this.arrows = make(() => new Arrow(force, 0.014 * reach));
    this.cones = make(() => new FrictionCone(cone));
    this.slips = make(() => new Arrow(slip, 0.008 * reach));
    this.rings = make(() => new Mesh(new RingGeometry(0.03 * reach, 0.045 * reach, 32), slip));
    this.motionCone = new MotionCone(overlay(colours.motion, 0.25));
    this.motion = new Arrow(overlay(colours.motion), 0.009 * reach);
    this.group.add(this.motionCone, this.motion);
  }

  show(state, film, layers) {
    const loads = state.frame?.pusher ?? [];
    for (let i = 0; i < kMost; ++i) this.#showLoad(i, loads[i], film, layers);
    this.#showMotion(state, loads, layers);
  }

  #showLoad(i, load, film, {forces, cones}) {
    for (const mark of [this.arrows[i], this.cones[i], this.slips[i], this.rings[i]]) mark.visible = false;
    if (!load || load.mode === 'open') return;
    const p = new Vector3(...load.p);
    const n = new Vector3(...load.n);
    if (forces) this.arrows[i].pointForce(load, film);
    if (cones) this.cones[i].place(p, n, load.mu, 0.45 * this.reach);
    if (load.mode === 'stick') return;
    const slip = new Vector3(...load.slip);
    this.rings[i].visible = true;
    this.rings[i].position.copy(p);
    if (slip.length() > 0) this.slips[i].point(p, slip.setLength(0.3 * this.reach));
  }

  /// The directions that would stick, and the one that the pusher takes, at its middle.
  #showMotion({frame, push}, loads, {cones}) {
    this.motionCone.visible = this.motion.visible = false;
    if (!cones || frame?.direction === undefined || loads.length === 0) return;
    const centre = new Vector3();
    for (const load of loads) centre.add(new Vector3(...load.p));
    centre.divideScalar(loads.length);
    const angle = Math.atan2(push.n_P[1], push.n_P[0]) + frame.X_HP[2];
    const radius = 0.6 * this.reach;
    this.motionCone.place(centre, angle, frame.cone, radius);
    const way = new Vector3(1, 0, 0).applyAxisAngle(kZ, angle + frame.direction);
    this.motion.point(centre, way.multiplyScalar(1.12 * radius));
  }
}
