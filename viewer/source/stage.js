// One film on one canvas: the scene graph is that of the frames, W > H > O, and the whole of
// it is turned so that either the world or the hand stands still.
import {
  Color, DirectionalLight, Group, HemisphereLight, LineBasicMaterial, LineSegments, Matrix4, PerspectiveCamera,
  Quaternion, Scene, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {Arrow, overlay} from './arrows.js';
import {Confines} from './confines.js';
import {ContactMarks} from './contact_marks.js';
import {PadMarks} from './pad_marks.js';
import {inverse} from './pose.js';
import {edgesOf, geometryOf, objectGeometries, plainGeometries, prism, pusherGeometry, rollAxis} from './shapes.js';
import {solid} from './solid.js';
import {Traces} from './traces.js';

const kZ = new Vector3(0, 0, 1);
const kAxes = {x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1)};

const kFieldOfView = 28;  // [deg]

const kViews = {
  free: [0.3, 0.32, 1.68],
  front: [0, 0, 1.8],
  side: [1.8, 0.25, 0.25],
};
export const kViewNames = Object.keys(kViews);

function setPose(group, [x, y, theta], z = 0) {
  group.position.set(x, y, z);
  group.quaternion.setFromAxisAngle(kZ, theta);
}

export class Stage {
  constructor(canvas, film, colours) {
    this.film = film;
    this.canvas = canvas;
    this.isWorld = false;
    this.layers = {forces: true, cones: true, pads: true, traces: true, outcomes: true, confines: true};
    this.reach = film.data.object.reach;
    this.renderer = new WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.camera = new PerspectiveCamera(kFieldOfView, 1, 0.05 * this.reach, 100 * this.reach);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.render());
    this.axis = kAxes[rollAxis(film.data.object) ?? 'z'];  // about which psi turns
    this.setColours(colours);
    this.look('free');
  }

  /// Builds everything anew in these colours.
  setColours(colours) {
    this.colours = colours;
    this.scene?.traverse((node) => {
      node.geometry?.dispose();
      node.material?.dispose();
    });
    this.scene = new Scene();
    this.scene.background = new Color(colours.stage);
    this.scene.add(new HemisphereLight('#ffffff', colours.shade, 2.6));
    const lamp = new DirectionalLight('#ffffff', 1.4);
    lamp.position.set(0.4, 0.8, 1.2);
    this.scene.add(lamp);
    this.world = new Group();
    this.hand = new Group();
    this.object = new Group();
    this.scene.add(this.world);
    this.world.add(this.hand);
    this.hand.add(this.object);
    this.#addObject();
    this.#addGripper();
    this.#addPushers();
    this.#addGhosts();
    this.confines = new Confines(this, this.film.data, this.reach, colours);
    this.contacts = new ContactMarks(this.hand, this.reach, colours);
    this.pads = new PadMarks(this.hand, this.film, this.reach, colours);
    this.traces = new Traces(this.object, this.film, colours);
    this.gravity = new Arrow(overlay(colours.gravity), 0.006);
    this.scene.add(this.gravity);
    if (this.state) this.show(this.state, this.time);
  }

  #addObject() {
    const {object, ink} = this.colours;
    for (const geometry of objectGeometries(this.film.data.object)) {
      this.object.add(solid(geometry, object, 0.82, ink));
    }
  }

  #addGripper() {
    const {gripper} = this.film.data;
    this.thickPad = 0.06 * this.reach;
    this.jaws = [0, 1].map((jaw) => {
      const gap = 0.003 * this.reach;  // two faces at one depth would flicker
      const [low, high] = jaw === 0 ? [-this.thickPad, -gap] : [gap, this.thickPad];
      const pad = solid(prism(gripper.pad, low, high), this.colours.pad, 0.4, this.colours.ink);
      this.hand.add(pad);
      return pad;
    });
  }

  #addPushers() {
    this.pushers = this.film.data.pushers.map((pusher) => {
      const group = solid(pusherGeometry(pusher, this.reach), this.colours.pusher, 0.55, this.colours.ink);
      setPose(group, [pusher.p_WP[0], pusher.p_WP[1], pusher.normal_angle], pusher.p_WP[2]);
      this.world.add(group);
      return group;
    });
  }

  /// Outlines of the start, the goal and the sampled ends, in H.
  #addGhosts() {
    const {start, goal, outcomes} = this.film.data;
    this.ghosts = new Group();
    this.outcomes = new Group();
    this.hand.add(this.ghosts, this.outcomes);
    this.ghosts.add(this.#outline(start, this.colours.faint, 0.8));
    const last = this.film.data.pushes.at(-1)?.frames.at(-1).X_HO ?? start;
    if (goal) {
      const pose = goal.map((value, i) => value ?? last[i]);
      this.ghosts.add(this.#outline(pose, this.colours.goal, 1));
    }
    if (outcomes.length === 0) return;
    const opacity = Math.max(0.03, Math.min(0.35, 12 / outcomes.length));
    this.outcomes.add(this.#outlines(outcomes, this.colours.sample, opacity));
  }

  #outline(X_HO, colour, opacity) {
    return this.#outlines([X_HO], colour, opacity);
  }

  /// The object at all these poses, drawn at one go.
  #outlines(poses, colour, opacity) {
    this.edges ??= plainGeometries(this.film.data.object).map((geometry) => edgesOf(geometry).getAttribute('position'));
    const count = this.edges.reduce((sum, edges) => sum + edges.count, 0);
    const points = new Float32Array(3 * count * poses.length);
    const place = new Group();
    const p = new Vector3();
    let at = 0;
    for (const X_HO of poses) {
      this.#poseObject(place, X_HO, 0);
      place.updateMatrix();
      for (const edges of this.edges) {
        for (let i = 0; i < edges.count; ++i, at += 3) {
          p.fromBufferAttribute(edges, i).applyMatrix4(place.matrix).toArray(points, at);
        }
      }
    }
    return new LineSegments(geometryOf(points), new LineBasicMaterial({color: colour, transparent: true, opacity}));
  }

  #poseObject(group, [x, y, theta, psi], z) {
    setPose(group, [x, y, theta], z);
    group.quaternion.multiply(new Quaternion().setFromAxisAngle(this.axis, psi));
  }

  look(view) {
    const [x, y, z] = kViews[view].map((value) => 3.3 * this.#seen() * value);
    this.controls.target.set(0, 0, 0);
    this.camera.position.set(x * this.#sideOfPusher(), y, z);
    this.controls.update();
    this.render();
  }

  /// -1 where the first pusher stands at smaller x: a short one would be hidden from the other side.
  #sideOfPusher() {
    const {pushes: [push], pushers: [pusher]} = this.film.data;
    const angle = push ? Math.atan2(push.n_P[1], push.n_P[0]) + push.frames[0].X_HP[2] : pusher?.normal_angle ?? 0;
    return Math.cos(angle) > 0.1 ? -1 : 1;
  }

  /// How far the picture reaches: around the object, or, where nothing is pushed, all pushers.
  #seen() {
    const {pushes, pushers, start} = this.film.data;
    if (pushes.length > 0) return this.reach;
    const far = pushers.map(({p_WP}) => Math.hypot(p_WP[0] - start[0], p_WP[1] - start[1]));
    return Math.max(this.reach, 0.75 * Math.max(...far));
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // In a narrow picture the width decides how much is seen.
    const half = Math.tan((0.5 * kFieldOfView * Math.PI) / 180);
    this.camera.fov = (360 / Math.PI) * Math.atan(half * Math.max(1, 1.4 / this.camera.aspect));
    this.camera.updateProjectionMatrix();
    this.render();
  }

  show(state, time) {
    this.state = state;
    this.time = time;
    this.#poseObject(this.object, state.X_HO, state.z_HO);
    this.jaws.forEach((pad, jaw) => pad.position.setZ(state.jaw_z[jaw]));
    setPose(this.hand, state.X_WH, state.z_WH);
    this.#standStill(state);
    const active = state.push?.pusher ?? -1;
    this.pushers.forEach((group, i) => {
      const isActive = i === active;
      group.visible = isActive || this.isWorld || active < 0;
      group.children[0].material.opacity = isActive ? 0.6 : 0.18;
    });
    const {forces, cones, pads, traces, outcomes, confines} = this.layers;
    this.contacts.show(state, this.film, {forces, cones});
    this.pads.show(pads ? state : {...state, frame: null});
    this.traces.show(traces, state, this.film);
    this.outcomes.visible = outcomes;
    this.confines.show(confines, state);
    this.render();
  }

  /// The frame that stands still is the one that the page shows upright and in the middle.
  #standStill({X_WH, z_WH}) {
    if (this.isWorld) {
      const [x, y] = this.#middleOfWorld();
      setPose(this.world, [-x, -y, 0], 0);
      return;
    }
    setPose(this.world, inverse(X_WH), -z_WH);
  }

  /// Where the hand is at the push that is shown: the world is too wide to see all of it.
  #middleOfWorld() {
    const {phases} = this.film.data;
    if (phases.length === 0) return this.state.X_WH;
    const push = this.state.phase?.push ?? 0;
    const pushing = phases.find((phase) => phase.kind === 'push' && phase.push === push);
    const before = phases.find((phase) => phase.push === push);
    if (!pushing) return before.to;
    if (this.state.phase.kind !== 'transit') return pushing.from;
    const earlier = phases.findLast((phase) => phase.kind === 'push' && phase.push === push - 1);
    if (!earlier) return pushing.from;
    const {begin, end} = this.state.phase;
    const share = (this.time - begin) / (end - begin || 1);
    return [0, 1].map((i) => earlier.from[i] + share * (pushing.from[i] - earlier.from[i]));
  }

  /// Gravity stands in a corner, in the directions of the scene.
  #placeGravity() {
    const g = new Vector3(...this.film.data.g_W);
    this.gravity.visible = g.length() > 0;
    if (!this.gravity.visible) return;
    this.world.updateMatrixWorld();
    const direction = g.normalize().applyMatrix4(new Matrix4().extractRotation(this.world.matrixWorld));
    const corner = new Vector3(-0.86, 0.74, 0.5).unproject(this.camera).sub(this.camera.position).normalize();
    const distance = this.camera.position.distanceTo(this.controls.target);
    const tail = this.camera.position.clone().addScaledVector(corner, distance);
    const length = 0.07 * distance;
    this.gravity.thickness = 0.05 * length;
    this.gravity.point(tail.addScaledVector(direction, -0.5 * length), direction.multiplyScalar(length));
  }

  /// However often it is asked for, once per picture of the screen.
  render() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.#placeGravity();
      this.renderer.render(this.scene, this.camera);
    });
  }
}
