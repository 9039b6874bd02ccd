// Arrows, friction cones and motion cones.
import {
  BufferGeometry, ConeGeometry, CylinderGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Vector3,
} from 'three';

import {geometryOf} from './shapes.js';

const kUp = new Vector3(0, 1, 0);

/// Drawn over everything else: what is inside the object should be seen.
export function overlay(colour, opacity = 1) {
  return new MeshBasicMaterial({
    color: colour, opacity, transparent: true, depthTest: false, depthWrite: false, side: DoubleSide,
  });
}

/// An arrow of unit thickness whose tail stands at a point.
export class Arrow extends Group {
  constructor(material, thickness) {
    super();
    this.thickness = thickness;
    this.shaft = new Mesh(new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0), material);
    this.head = new Mesh(new ConeGeometry(2.6, 6, 16).translate(0, 3, 0), material);
    this.add(this.shaft, this.head);
    this.renderOrder = this.shaft.renderOrder = this.head.renderOrder = 5;
  }

  /// From `tail` along `vector`, as long as that.
  point(tail, vector) {
    const length = vector.length();
    this.visible = length > 1e-9;
    if (!this.visible) return;
    const width = Math.min(this.thickness, length / 8);
    const shaft = Math.max(length - 6 * width, 1e-9);
    this.position.copy(tail);
    this.quaternion.setFromUnitVectors(kUp, vector.clone().divideScalar(length));
    this.shaft.scale.set(width, shaft, width);
    this.head.scale.setScalar(width);
    this.head.position.set(0, shaft, 0);
  }

  /// A force where it acts, to the one scale of its film.
  pointForce({p, force}, film) {
    const scale = (0.8 * film.data.object.reach) / film.mostForce;
    this.point(new Vector3(...p), new Vector3(...force).multiplyScalar(scale));
  }
}

/// The cone of friction: apex at a contact, about its normal.
export class FrictionCone extends Mesh {
  constructor(material) {
    super(new ConeGeometry(1, 1, 40, 1, true).translate(0, -0.5, 0).rotateX(Math.PI), material);
    this.renderOrder = 3;
  }

  place(apex, normal, mu, height) {
    this.visible = mu > 0;
    this.position.copy(apex);
    this.quaternion.setFromUnitVectors(kUp, normal);
    this.scale.set(mu * height, height, mu * height);
  }
}

/// Sectors of directions in the pad plane.
export class MotionCone extends Mesh {
  constructor(material) {
    super(new BufferGeometry(), material);
    this.renderOrder = 2;
  }

  /// `ranges` are angles from `angle` [rad].
  place(centre, angle, ranges, radius) {
    const positions = [];
    for (const [low, high] of ranges) {
      const steps = Math.max(1, Math.ceil((high - low) / 0.05));
      for (let i = 0; i < steps; ++i) {
        const a = angle + low + ((high - low) * i) / steps;
        const b = angle + low + ((high - low) * (i + 1)) / steps;
        positions.push(0, 0, 0, radius * Math.cos(a), radius * Math.sin(a), 0,
          radius * Math.cos(b), radius * Math.sin(b), 0);
      }
    }
    this.geometry.dispose();
    this.geometry = geometryOf(positions);
    this.position.copy(centre);
    this.visible = positions.length > 0;
  }
}
